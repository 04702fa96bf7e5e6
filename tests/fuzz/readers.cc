// SPDX-License-Identifier: LGPL-2.1-or-later
#include "readers.h"

#include <tread/base/archive.h>
#include <tread/base/input_error.h>
#include <tread/geometry/defect.h>
#include <tread/geometry/height_map.h>
#include <tread/geometry/measured_line.h>
#include <tread/geometry/rail_slices.h>
#include <tread/geometry/wheel_deviation.h>
#include <tread/mesh/mesh_rail.h>
#include <tread/scene/assumptions.h>
#include <tread/scene/recorded.h>
#include <tread/scene/scene.h>
#include <tread/scene/surface_laws.h>
#include <tread/scene/track_parts.h>
#include <tread/scene/wheelset_motion.h>
#include <tread/tools/batch_files.h>

#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>

namespace tread::fuzz
{
  namespace
  {
    /// Not an InputError: what was read must be usable.
    void require_finite(const double value)
    {
      if (!std::isfinite(value))
        throw std::logic_error("a number that is not finite was made of the file");
    }

    void require_finite(const MeasuredLine &line)
    {
      constexpr int n = 50;
      for (int i = 0; i <= n; ++i)
        require_finite(line(line.begin() + (line.end() - line.begin()) * i / n));
    }

    void require_finite(const std::vector<dealii::Point<2>> &points)
    {
      for (const dealii::Point<2> &p : points)
        require_finite(p[0] + p[1]);
    }

    /// Profiles are refused by a std::runtime_error to which the sections add the name of the parameter.
    template <typename Read>
    bool is_read(const Read &read, std::string &refusal)
    {
      try
        {
          require_finite(read());
          return true;
        }
      catch (const std::runtime_error &error)
        {
          refusal = error.what();
          return false;
        }
    }

    /// All that the program makes of a profile: any of it may refuse the file.
    void read_profile(const std::string &file)
    {
      constexpr double half_width = 25e-3; // m
      std::string      refusal;
      const bool any = is_read([&] { return read_rail_head(file, half_width, 0.5 * half_width); }, refusal) +
                       is_read([&] { return read_wheel_tread(file, half_width); }, refusal) +
                       is_read([&] { return read_rail_points(file); }, refusal) +
                       is_read([&] { return read_wheel_points(file); }, refusal);
      require(any, refusal);
    }

    void read_defect(const std::string &file)
    {
      std::string refusal;
      const auto  depth = [&](const bool reversed) {
        const Defect defect = defect_along(read_longitudinal_profile(file), LineDatum::chord, reversed);
        require_finite(defect.length);
        return defect.height(0.3 * defect.length, 0.);
      };
      require(is_read([&] { return depth(false) + depth(true); }, refusal), refusal);
    }

    void read_map(const std::string &file)
    {
      const HeightMap map(file);
      for (const double u : {-1., 0., 0.3, 1., 2.})
        for (const double v : {-1., 0., 0.7, 1., 2.})
          require_finite(map.height((1. - u) * map.x_begin() + u * map.x_end(),
                                    (1. - v) * map.y_begin() + v * map.y_end()));
      require_finite(map.lowest() + map.highest() + map.largest_on_ends() + map.largest_on_sides());
    }

    void read_slices(const std::string &file)
    {
      const SlicedRail rail(read_rail_slices(file));
      rail.doubts();
      const Surface::Extent extent = rail.extent();
      for (const double u : {0., 0.3, 0.5, 1.})
        for (const double v : {0., 0.2, 0.7, 1.})
          {
            const double along = (1. - u) * extent.along_begin + u * extent.along_end,
                         y     = (1. - v) * extent.y_begin + v * extent.y_end;
            if (const auto height = rail.height(along, y))
              require_finite(height->z);
            rail.body(along, y);
          }
    }

    void read_deviation(const std::string &file)
    {
      constexpr double       radius = 0.46, smoothing = 2e-3;
      const ScannedDeviation scan(read_deviation_lines(file, [] { return wheel_curve("cylinder"); }), radius,
                                  smoothing);
      for (const double angle : {-4., -0.02, 0., 0.5, 3.})
        for (const double y : {-80e-3, -20e-3, 0., 7e-3})
          {
            const WheelDeviation::Value value = scan.at(angle, y);
            require_finite(value.dz + value.by_angle + value.by_y);
          }
    }

    void read_mesh(const std::string &file)
    {
      const MeshRail            rail(read_mesh_file(file, 1e-3));
      const FacetSurface::Range along = rail.surface.along(), lateral = rail.surface.lateral();
      for (const double u : {-0.1, 0., 0.3, 0.5, 1., 1.1})
        for (const double v : {-0.1, 0., 0.2, 0.7, 1., 1.1})
          {
            const double x = (1. - u) * along.begin + u * along.end,
                         y = (1. - v) * lateral.begin + v * lateral.end;
            if (const auto height = rail.surface.height(x, y))
              require_finite(*height);
            const FacetSurface::Facet facet = rail.surface.facet(x, y);
            require_finite(facet.z + facet.smooth_above);
          }
    }

    void read_guidance(const std::string &file)
    {
      const WheelsetMotion motion(file);
      constexpr int        n = 20;
      for (int i = 0; i <= n; ++i)
        {
          const Across now = motion.at(motion.end() * i / n, Across());
          require_finite(now.y + now.yaw + now.roll + now.angular_velocity.value_or(0.));
        }
    }

    void read_supports(const std::string &file)
    {
      Scene scene;
      scene.read_surfaces("", {"Track/Foundation=two-layer", "Track/Support file=" + file});
      track_parameters(scene);
    }

    void read_parameters(const std::string &file)
    {
      Scene::parameters_in(file);
    }

    /// With all that the program asks of a scene before it makes a mesh.
    void read_scene(const std::string &file)
    {
      Scene scene;
      scene.read(file, {});
      std::ostringstream text;
      scene.parameters().print(text, true);
      scene.unused_parameters();
      assumptions(scene);
      friction_law(scene);
      track_parameters(scene);
      recorded_supports(scene);
      recorded_cells(scene);
    }

    /// Each line as an option -s.
    void read_settings(const std::string &file)
    {
      std::ifstream            stream(file);
      std::vector<std::string> settings;
      for (std::string line; std::getline(stream, line);)
        settings.push_back(line);
      Scene scene;
      scene.read_surfaces("", settings);
      scene.parameters().changed_values();
    }

    void read_batch(const std::string &file)
    {
      // Each case is work, and many of them are no hang.
      std::ifstream stream(file);
      require(std::count(std::istreambuf_iterator<char>(stream), {}, '\n') < 20, "too many cases");
      // Cases that cannot be solved end it with a std::runtime_error after all others have their answers.
      std::string refusal;
      const auto  solve = [&] {
        write_batch(file, "/dev/null", MPI_COMM_WORLD);
        return 0.;
      };
      require(is_read(solve, refusal), refusal);
    }

    /// The kinds of values that classes keep.
    struct State
    {
      struct Record
      {
        Archive::Key key;
        double       value[2];
      };
      double                                   number = 0., share = 0., largest = 0.;
      bool                                     is_so = false;
      std::vector<double>                      numbers{1., 2., 3.};
      std::vector<std::vector<unsigned int>>   lists{{1, 2}, {}, {3}};
      std::map<unsigned int, std::vector<int>> by_number{{1, {1}}, {7, {2, 3}}};
      std::vector<char>                        own{1, 0, 1};
      std::vector<Record>                      records{{{{0, 1, 2, 3}}, {4., 5.}}};

      void serialize(Archive &archive)
      {
        archive.same(number, numbers, lists, by_number, is_so);
        archive.shares(share);
        archive.largest(largest);
        archive.own(own);
        archive.records(records);
      }
    };

    void read_archive(const std::string &file)
    {
      std::ifstream     stream(file, std::ios::binary);
      const std::string content{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
      try
        {
          Archive archive(MPI_COMM_WORLD, content);
          State   state;
          state.serialize(archive);
          require(archive.found_all(), "something is left over");
        }
      catch (const OtherStoredLayout &error)
        {
          throw InputError(error.what());
        }
    }

    /// The folder of this process, in memory where there is a folder for that. It stays when the process
    /// aborts.
    class OwnFolder
    {
    public:
      OwnFolder()
      {
        const std::filesystem::path shared = "/dev/shm";
        path = (std::filesystem::is_directory(shared) ? shared : std::filesystem::temp_directory_path()) /
               ("tread-fuzz-" + std::to_string(getpid()));
        std::filesystem::create_directory(path);
      }
      ~OwnFolder()
      {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
      }
      std::filesystem::path path;
    };

    const std::filesystem::path &folder()
    {
      static const OwnFolder own;
      return own.path;
    }

    /// A file that takes longer ends the process by a signal: so much time of the processor, or, where it
    /// waits for something, a multiple of it.
    void limit_time(const bool on)
    {
      constexpr unsigned int seconds = 60, waiting = 10;
      itimerval              limit{};
      limit.it_value.tv_sec = on ? seconds : 0;
      setitimer(ITIMER_PROF, &limit, nullptr);
      alarm(on ? waiting * seconds : 0);
    }

    [[noreturn]] void fail(const Reader &reader, const std::string &what)
    {
      std::fprintf(stderr, "FINDING: reader %s: %s; the file is %s\n", reader.name.c_str(), what.c_str(),
                   file_given_to(reader).c_str());
      std::abort();
    }
  } // namespace


  const std::vector<Reader> &readers()
  {
    static const std::vector<Reader> list{{"parameters", ".prm", read_parameters},
                                          {"scene", ".prm", read_scene},
                                          {"settings", ".txt", read_settings},
                                          {"simpack", ".prr", read_profile},
                                          {"miniprof", ".ban", read_profile},
                                          {"two-columns", ".txt", read_profile},
                                          {"defect", ".txt", read_defect},
                                          {"map", ".csv", read_map},
                                          {"slices", ".csv", read_slices},
                                          {"deviation", ".csv", read_deviation},
                                          {"guidance", ".csv", read_guidance},
                                          {"supports", ".csv", read_supports},
                                          {"batch", ".csv", read_batch},
                                          {"archive", "", read_archive},
                                          {"gmsh", ".msh", read_mesh},
                                          {"abaqus", ".inp", read_mesh},
                                          {"ls-dyna", ".k", read_mesh}};
    return list;
  }


  const Reader &reader_named(const std::string &name)
  {
    std::string names;
    for (const Reader &reader : readers())
      {
        if (reader.name == name)
          return reader;
        names += " " + reader.name;
      }
    throw std::runtime_error("no reader '" + name + "'; there are" + names);
  }


  std::string file_given_to(const Reader &reader)
  {
    return folder() / (reader.name + reader.ending);
  }


  bool accepts(const Reader &reader, const std::string &content)
  {
    constexpr std::size_t longest_line = 3000; // bytes of a message
    const std::string     file         = file_given_to(reader);
    if (!(std::ofstream(file, std::ios::binary) << content))
      throw std::runtime_error("cannot write " + file);
    try
      {
        limit_time(true);
        reader.read(file);
        limit_time(false);
        return true;
      }
    catch (const InputError &error)
      {
        limit_time(false);
        const std::string line = error.what();
        if (line.empty() || line.find('\n') != line.npos || line.size() > longest_line)
          fail(reader, "refused by '" + line + "', which is not one line");
        return false;
      }
    catch (const std::exception &error)
      {
        fail(reader, std::string("another exception escaped: ") + typeid(error).name() + ": " + error.what());
      }
  }
} // namespace tread::fuzz
