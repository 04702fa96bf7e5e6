// SPDX-License-Identifier: LGPL-2.1-or-later
// How a recorder is added: power at the hub, as a table, in run.h5 and in the summary. Beside what stands
// here, a program that records it has a function in the list of recorders/on_demand.cc.
#include <tread/base/file_text.h>
#include <tread/base/hdf5_file.h>
#include <tread/model/model.h>
#include <tread/output/columns.h>
#include <tread/output/summary_keys.h>
#include <tread/recorders/pictures.h>
#include <tread/recorders/recorder.h>

#include "check.h"
#include "temporary_folder.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

using namespace tread;

namespace recorders_own_recorder
{
  // The recorder.

  struct HubPower
  {
    double x, power; ///< m, W
  };

  const Columns<HubPower> &hub_power_columns()
  {
    static const Columns<HubPower> columns{
      {"x", "mm", "Of the first wheel",
       [](const HubPower &row) {
         return row.x;
       }},
      {"power", "W", "Of the torque that drives it", [](const HubPower &row) {
         return row.power;
       }}};
    return columns;
  }

  /// Power of the torque that drives the first wheel, each millimetre.
  class HubPowerRecorder : public Recorder
  {
  public:
    explicit HubPowerRecorder(const Model &model)
      : model(model)
    {
    }

    void open(RunFolder &folder) override
    {
      folder.open_table("hub_power.csv", hub_power_columns());
    }
    void pass(const WayPassed &way, RunFolder &folder) override
    {
      if (!way.has_end_of(1e-3))
        return;
      const WheelHub &hub   = model.wheels.front().hub;
      const double    power = hub.drive_torque * hub.motion.angular_velocity;
      largest               = std::max(largest, power);
      folder.append("hub_power.csv", hub_power_columns(), {{model.position(), power}});
    }
    void finish(Report &report) override
    {
      report.summary.set("largest_hub_power_W", largest);
    }
    void serialize(Archive &archive) override
    {
      archive.same(largest);
    }

  private:
    const Model &model;
    double       largest = 0.; ///< W
  };

  const bool known = know_table(describe("hub_power.csv", hub_power_columns())) &&
                     know_summary_keys(SummaryGroup::recorded,
                                       {{"largest_hub_power_W", "Largest of the rows of hub_power.csv"}});


  /// Text of an attribute of a column in run.h5.
  std::string attribute_of(const std::string &file, const std::string &column, const std::string &name)
  {
    const hdf5::Handle open(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose),
      data(H5Dopen2(open, column.c_str(), H5P_DEFAULT), H5Dclose),
      attribute(H5Aopen(data, name.c_str(), H5P_DEFAULT), H5Aclose), type(H5Aget_type(attribute), H5Tclose);
    char *text = nullptr;
    hdf5::check(H5Aread(attribute, type, &text));
    const std::string found = text;
    H5free_memory(text);
    return found;
  }

  /// Numbers on nodes that somebody adds are in the pictures of bodies and surfaces.
  void check_pictures_of_fields(tests::Check &check, Model &model)
  {
    const auto temperature = [](const double y, const double z) { ///< C; places in m
      return 20. + 1e3 * y - 500. * z;
    };
    std::vector<double> &field = model.dynamics.state.fields["temperature_C"];
    for (const dealii::Point<3> &p : model.mesh.nodes)
      field.push_back(temperature(p[1], p[2]));
    const tests::TemporaryFolder temporary;
    const std::string            path = temporary.path + "/pictures";
    RunFolder                    folder(path, MPI_COMM_SELF, PictureFormat::xdmf);
    Pictures                     pictures(model, nullptr);
    static_cast<Recorder &>(pictures).take_solution(folder);
    for (const std::string name : {"volume", "surface"})
      {
        const hdf5::Handle        file(hdf5::open(path + "/" + name + "-0000.h5"), H5Fclose);
        const std::vector<double> places = hdf5::read(file, "points"),
                                  shown  = hdf5::read(file, "temperature_C");
        double off                       = 0.;
        for (std::size_t i = 0; i < shown.size(); ++i)
          off = std::max(off, std::abs(shown[i] - temperature(places[3 * i + 1], places[3 * i + 2])));
        check.that(name + ": a number for each point",
                   shown.size() > 100 && 3 * shown.size() == places.size());
        check.below(name + ": temperature of its points, C", off, 1e-4); // single precision
      }
  }
} // namespace recorders_own_recorder


TREAD_TEST(recorders_own_recorder)(tests::Check &check, const tests::Arguments &)
{
  Scene scene;
  scene.read("", {"Rail/Shape=block", "Mesh/Finest cell (mm)=2.5", "Mesh/Fine half width (mm)=10",
                  "Motion/Speed (km per h)=0.1", "Motion/Rolled distance (mm)=10"});
  Model                        model(scene, MPI_COMM_SELF, {});
  const tests::TemporaryFolder temporary;
  const std::string            path = temporary.path + "/results";
  {
    RunFolder        folder(path, MPI_COMM_SELF);
    HubPowerRecorder recorder(model);
    Recorder        &asked = recorder; // by the loop
    folder.write("parameters.prm", "");
    asked.open(folder);
    // 3.3 mm, with 100, 200, 300 N m at the ends of the millimetres and more in between.
    double at = scene.path_begin();
    for (const auto &[way, torque] : std::vector<std::pair<double, double>>{{0.4e-3, 900.},
                                                                            {1.1e-3, 100.},
                                                                            {2.05e-3, 200.},
                                                                            {2.9e-3, 900.},
                                                                            {3.3e-3, 300.}})
      {
        WheelHub &hub               = model.wheels.front().hub;
        hub.motion.x                = scene.path_begin() + way;
        hub.motion.angular_velocity = 80.;
        hub.drive_torque            = torque;
        asked.pass({scene.path_begin(), at, hub.motion.x}, folder);
        at = hub.motion.x;
      }
    Report report{folder, true};
    asked.finish(report);
    const auto figures = nlohmann::json::parse(report.summary.text());
    check.absolute("largest_hub_power_W", figures.value("largest_hub_power_W", 0.), 24e3, 1e-9);
    const std::string table = text_of_file(path + "/hub_power.csv");
    check.that("its table", table.starts_with("x_mm,power_W\n") &&
                              std::count(table.begin(), table.end(), '\n') == 4 &&
                              table.find(",8000\n") != table.npos && table.find(",16000\n") != table.npos);
    folder.write_hdf5(report.summary.text(), {});
    check.that("run.h5: unit and meaning of its column",
               attribute_of(path + "/run.h5", "hub_power/power_W", "unit") == "W" &&
                 attribute_of(path + "/run.h5", "hub_power/power_W", "meaning") ==
                   "Of the torque that drives it");
  }
  const std::vector<TableDescription> tables = tables_of_a_run();
  check.that("tread columns has it",
             known && std::any_of(tables.begin(), tables.end(),
                                  [](const auto &table) { return table.file == "hub_power.csv"; }));
  check.that("its key has a meaning", !about_summary_key("largest_hub_power_W").empty());
  RunFolder(path, MPI_COMM_SELF).remove_results();
  check.that("another run into the folder removes it", !std::filesystem::exists(path + "/hub_power.csv"));
  check_pictures_of_fields(check, model);
}
