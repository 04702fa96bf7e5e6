// SPDX-License-Identifier: LGPL-2.1-or-later
// What parameters need to have an effect: that all deciding parameters and their values exist, and which
// need is told in which case, as the records of the parameters say it; facts of scenes that were read.
#include <tread/scene/scene.h>

#include "check.h"

#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace tread;

namespace scene_needs
{
  using Values = std::vector<std::pair<std::string, std::string>>; // paths and texts

  /// What is told of a parameter where others have these values, as facts are.
  std::string told(const std::string &path, const Values &values, const bool facts_are_true = false)
  {
    const Scene     scene;
    ParameterTable &table = scene.parameters().table();
    for (const auto &[name, text] : values)
      if (!table.set(*table.find(name), text))
        throw std::logic_error("'" + name + "' cannot be '" + text + "'");
    const Need *const need =
      table.unmet_need(*table.find(path), [&](const std::string &) { return facts_are_true; });
    return need ? need->in_words() : "";
  }


  void check_records(tests::Check &check)
  {
    const Scene           scene;
    const ParameterTable &table = scene.parameters().table();
    std::set<std::string> facts;
    unsigned int          n_needs = 0;
    const auto check_need = [&](const std::string &path, const Need &need, const auto &again) -> void {
      ++n_needs;
      bool is_right = table.find(need.path) && !need.words.empty() && need.all.empty() != need.fact.empty();
      for (const auto &wanted : need.all)
        for (const auto &[decides, values] : wanted)
          {
            is_right = is_right && table.find(decides);
            for (const std::string &value : values)
              is_right = is_right && table.find(decides)->allowed->match(value);
          }
      check.that(path + " needs what there is: " + need.in_words(), is_right);
      if (!need.fact.empty())
        facts.insert(need.fact);
      for (const Need &other : need.others)
        again(path, other, again);
    };
    for (const Parameter &parameter : table.parameters())
      for (const Need &need : parameter.needs)
        check_need(parameter.path(), need, check_need);
    check.that("many have needs", n_needs > 100);
    check.that("each fact is tried below",
               facts == std::set<std::string>{"memory of friction", "scan", "traction", "window"});
  }


  void check_values(tests::Check &check)
  {
    struct Case
    {
      std::string path;
      Values      values;
      std::string needed; ///< empty: it has an effect
    };
    const Values      one_layer{{"Track/Foundation", "one-layer"}}, beam{{"Track/Foundation", "beam"}};
    const std::string hardening = "'Rail/Hardening' Armstrong-Frederick, with a yield stress",
                      defect    = "'Defect/Shape' dip, profile, corrugation or map",
                      sleepers  = "'Track/Sleepers' solid, on two layers",
                      track     = "'Track/Foundation' one-layer, two-layer, co-running or beam";
    for (const auto &[path, values, needed] : std::vector<Case>{
           {"Wheel/Radius (mm)", {}, ""},
           {"Wheel/Rim width (mm)", {}, "'Wheel/Shape' full"},
           {"Wheel/Rim width (mm)", {{"Wheel/Shape", "full"}}, ""},
           {"Wheel/Sector width (mm)", {}, ""},
           {"Wheel/Sector width (mm)", {{"Wheel/Shape", "full"}}, "'Wheel/Shape' sector"},
           {"Wheel/Sector width (mm)", {{"Wheel/Shape", "full"}, {"Wheelset/Lateral shift (mm)", "0"}}, ""},
           {"Wheel/Deviation pitch (deg)", {}, "'Wheel/Deviation' a file or a rule"},
           {"Wheel/Deviation pitch (deg)", {{"Wheel/Deviation", "waves: 3=0.1@0"}}, ""},
           // A position.
           {"Wheelset/Both wheels", {}, "'Wheelset/Lateral shift (mm)' a number"},
           {"Wheelset/Both wheels",
            {{"Wheelset/Yaw (mrad)", "0.0"}},
            "'Wheelset/Lateral shift (mm)' a number"},
           {"Wheelset/Both wheels", {{"Wheelset/Yaw (mrad)", "2"}}, ""},
           {"Wheelset/Both wheels", {{"Wheelset/Roll (mrad)", "2"}}, ""},
           {"Wheelset/Both wheels", {{"Motion/Angular velocity (rad per s)", "84"}}, ""},
           {"Wheelset/Both wheels", {{"Guidance/Kind", "file"}}, ""},
           {"Wheelset/Track gauge (mm)",
            {{"Rail/Shape", "slices"}},
            "'Wheelset/Lateral shift (mm)' a number"},
           {"Wheelset/Track gauge (mm)",
            {{"Rail/Shape", "slices"}, {"Wheelset/Lateral shift (mm)", "0"}},
            "'Rail/Shape' head"},
           {"Guidance/Yaw inertia (kg m2)", {}, "'Guidance/Kind' springs, or both wheels"},
           {"Guidance/Yaw inertia (kg m2)", {{"Wheelset/Both wheels", "true"}}, ""},
           {"Guidance/Yaw inertia (kg m2)", {{"Guidance/Kind", "springs"}}, ""},
           // Rail and track.
           {"Rail/Begin (mm)", {{"Rail/Shape", "mesh"}}, "'Rail/Shape' head, full section, block or slices"},
           {"Rail/Profile", {{"Rail/Shape", "block"}}, "'Rail/Shape' head or full section"},
           {"Rail/Spans beyond", one_layer, "'Rail/Ends' endless, or on a beam"},
           {"Rail/Spans beyond", beam, ""},
           {"Track/Pad stiffness (MN per m)", {}, "'Track/Foundation' one-layer, two-layer or beam"},
           {"Track/Pad stiffness (MN per m)",
            {{"Track/Foundation", "co-running"}},
            "'Track/Foundation' one-layer, two-layer or beam"},
           {"Track/Pad stiffness (MN per m)", beam, ""},
           {"Track/Pads pull", beam, "'Track/Foundation' one-layer or two-layer"},
           {"Track/Sleeper length (m)", {}, track},
           {"Track/Sleeper length (m)", {{"Track/Foundation", "two-layer"}}, sleepers},
           {"Track/Sleeper length (m)", {one_layer[0], {"Track/Sleepers", "solid"}}, sleepers},
           {"Track/Sleeper length (m)", {{"Track/Foundation", "two-layer"}, {"Track/Sleepers", "solid"}}, ""},
           {"Track/Stiffness along the rail (MN per m)", {}, "'Rail/Ends' endless"},
           {"Track/Stiffness along the rail (MN per m)", {{"Rail/Ends", "endless"}}, track},
           {"Track/Stiffness along the rail (MN per m)", {one_layer[0], {"Rail/Ends", "endless"}}, ""},
           // Steel.
           {"Rail/Tangent modulus (GPa)",
            {{"Rail/Hardening", "Armstrong-Frederick"}},
            "'Rail/Yield stress (MPa)' above 0"},
           {"Rail/Tangent modulus (GPa)",
            {{"Wheel/Yield stress (MPa)", "500"}},
            "'Rail/Yield stress (MPa)' above 0"},
           {"Rail/Tangent modulus (GPa)", {{"Rail/Plastic zones", "0:9:8:400:21"}}, ""},
           {"Rail/Tangent modulus (GPa)",
            {{"Rail/Yield stress (MPa)", "500"}, {"Rail/Hardening", "Armstrong-Frederick"}},
            "'Rail/Hardening' isotropic or kinematic"},
           {"Rail/Backstress recoveries", {{"Rail/Yield stress (MPa)", "500"}}, hardening},
           {"Rail/Backstress recoveries", {{"Rail/Hardening", "Armstrong-Frederick"}}, hardening},
           {"Rail/Backstress recoveries",
            {{"Rail/Plastic zones", "0:9:8:400:21"}, {"Rail/Hardening", "Armstrong-Frederick"}},
            ""},
           // The defect, whose place counts without it.
           {"Defect/Length (mm)", {}, ""}, // of a smooth twin
           {"Defect/Position (mm)", {}, defect},
           {"Defect/Position (mm)", {{"Peak stress/Region", "trailing edge"}}, ""},
           {"Defect/Position (mm)", {{"Mesh/Fine to (mm)", "20"}}, ""},
           {"Defect/Width (mm)", {{"Defect/Shape", "profile"}}, ""},
           {"Defect/Width (mm)",
            {{"Defect/Shape", "profile"}, {"Defect/Lateral law", "uniform"}},
            "'Defect/Lateral law' parabola"},
           {"Defect/Width (mm)", {{"Defect/Shape", "map"}, {"Defect/Lateral law", "uniform"}}, ""},
           {"Defect/Depth (mm)", {{"Peak stress/Region", "trailing edge"}}, defect},
           {"Defect/Ramp (mm)", {}, "'Defect/Shape' profile, corrugation or map"}, // the narrower need
           {"Defect/Ramp (mm)", {{"Defect/Shape", "dip"}}, "'Defect/Shape' profile, corrugation or map"},
           {"Defect/Ramp (mm)", {{"Defect/Shape", "map"}}, ""},
           // Laws.
           {"Contact/Kinetic friction coefficient", {}, "'Contact/Friction law' one that falls"},
           {"Contact/Kinetic friction coefficient", {{"Contact/Friction law", "Stribeck"}}, ""},
           {"Contact/Least speed of memory (m per s)", {}, "'Contact/Friction law' one that falls"},
           {"Contact/Least speed of memory (m per s)",
            {{"Contact/Friction law", "linear"}},
            "'Contact/Friction memory (mm)' above 0"},
           {"Damage/Hardness (MPa)", {{"Damage/Wear law", "Archard"}}, "'Damage/Record' true"},
           {"Damage/Hardness (MPa)", {{"Damage/Record", "true"}}, "'Damage/Wear law' Archard or Archard map"},
           {"Damage/Hardness (MPa)", {{"Damage/Record", "true"}, {"Damage/Wear law", "Archard map"}}, ""},
           {"Damage/Wear coefficient",
            {{"Damage/Record", "true"}, {"Damage/Wear law", "Archard map"}},
            "'Damage/Wear law' Archard"},
           {"Damage/Shear strength (MPa)", {}, ""},
           {"Damage/Rail temperature (C)", {}, "'Contact/Friction temperatures (C)' given"},
           // The rest.
           {"Solid/Hourglass coefficient",
            {{"Solid/Element", "fully-integrated"}},
            "'Solid/Element' one-point"},
           {"Vehicle/Sprung mass (kg)",
            {{"Vehicle/Wheel load (kN)", "140"}},
            "'Vehicle/Wheel load (kN)' masses"},
           {"Vehicle/Sprung mass (kg)", {{"Vehicle/Axle load (t)", "20"}}, "'Vehicle/Axle load (t)' none"},
           {"Vehicle/Sprung mass (kg)", {}, ""},
           {"Motion/Traction coefficient", {}, "'Motion/Creepage' predicted"},
           {"Motion/Traction coefficient", {{"Motion/Drive", "torque"}}, ""},
           {"Further wheels/Traction coefficients",
            {{"Motion/Creepage", "0.001"}},
            "'Motion/Creepage' predicted"},
           {"Further wheels/Traction coefficients",
            {{"Motion/Creepage", "0.001"}, {"Motion/Drive", "torque"}},
            ""},
           {"Peak stress/To (mm)", {}, "'Peak stress/Region' range"},
           {"Peak stress/To (mm)", {{"Peak stress/Region", "trailing edge"}}, "'Peak stress/Region' range"},
           {"Output/Volume interval (mm)", {{"Output/Write volume", "false"}}, "'Output/Write volume' true"}})
      {
        std::string with;
        for (const auto &[name, text] : values)
          with += (with.empty() ? " with " : ", ") + name + " = " + text;
        check.that(path + with + ": " + (needed.empty() ? "has an effect" : needed),
                   told(path, values) == needed);
      }
    check.that("a fact that is true", told("Mesh/Window length (mm)", {}, true).empty());
    check.that("and one that is not", told("Mesh/Window length (mm)", {}) ==
                                        "'Mesh/Window' true, or automatic on a way that is long enough");
  }


  void check_facts(tests::Check &check)
  {
    const std::vector<std::string> falling{"Contact/Friction law=falling",
                                           "Contact/Friction coefficient=0.3",
                                           "Contact/Kinetic friction coefficient=0.1",
                                           "Motion/Traction coefficient=0.1",
                                           "Contact/Falling slip speed (m per s)=1",
                                           "Contact/Least speed of memory (m per s)=0.1"};
    const auto                     unused = [](std::vector<std::string> settings, const std::string &last) {
      settings.push_back(last);
      Scene scene;
      scene.read("", settings);
      return scene.unused_parameters();
    };
    using Lines             = std::vector<std::string>;
    const std::string begin = "' has no effect: it needs '";
    check.that("what smooths a scan, on a wheel with waves",
               unused({"Wheel/Deviation smoothing (mm)=5"}, "Wheel/Deviation=waves: 3=0.1@0") ==
                 Lines{"'Wheel/Deviation smoothing (mm)" + begin + "Wheel/Deviation' a file"});
    check.that("a window that there is", unused({"Mesh/Window length (mm)=20"}, "Mesh/Window=true").empty());
    check.that("and one that there is not", unused({}, "Mesh/Window length (mm)=20").size() == 1);
    check.that("friction with a memory", unused(falling, "Contact/Friction memory (mm)=0.07").empty());
    check.that("and without one", unused(falling, "Contact/Friction memory (mm)=0") ==
                                    Lines{"'Contact/Least speed of memory (m per s)" + begin +
                                          "Contact/Friction memory (mm)' above 0"});
    check.that("free rolling, said twice",
               unused({"Motion/Creepage=0"}, "Motion/Traction coefficient=0").empty());
    check.that("a traction beside a creepage",
               unused({"Motion/Creepage=0.001"}, "Motion/Traction coefficient=0.1") ==
                 Lines{"'Motion/Traction coefficient" + begin + "Motion/Creepage' predicted"});
  }
} // namespace scene_needs


TREAD_TEST(scene_needs)(tests::Check &check, const tests::Arguments &)
{
  scene_needs::check_records(check);
  scene_needs::check_values(check);
  scene_needs::check_facts(check);
}
