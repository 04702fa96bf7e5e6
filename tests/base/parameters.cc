// SPDX-License-Identifier: LGPL-2.1-or-later
// Parameters as they are declared: what each may be, in words, as JSON schema and as values; their units and
// defaults.
#include <tread/base/section.h>

#include "check.h"
#include <nlohmann/json.hpp>

#include <memory>
#include <string>
#include <vector>

using namespace tread;

namespace base_parameters
{
  using Json = nlohmann::ordered_json;

  struct Case
  {
    std::shared_ptr<const AllowedTexts> allowed;
    std::string                         words;
    std::string                         schema;
    std::vector<std::string>            right, wrong;
    std::string                         value; ///< of the first of the right ones, as JSON
  };

  enum class Gauge
  {
    standard,
    broad
  };
} // namespace base_parameters


template <>
const std::vector<Choice<base_parameters::Gauge>> &tread::choices()
{
  static const std::vector<Choice<base_parameters::Gauge>> list{
    {base_parameters::Gauge::standard, "standard", "1435 mm."},
    {base_parameters::Gauge::broad, "broad", "1520 mm or more."}};
  return list;
}


namespace base_parameters
{
  void check_kinds(tests::Check &check)
  {
    const std::string each = "\"type\":\"number\",\"minimum\":0,\"maximum\":1";
    const auto        kept = [](const AllowedTexts &allowed) {
      return allowed.copy();
    };
    for (
      const auto &[allowed, words, schema, right, wrong, value] : std::vector<Case>{
        {kept(Number(0., 2.)),
         "0 to 2",
         R"({"type":"number","minimum":0,"maximum":2})",
         {"0.5", "0", "2"},
         {"", "x", "2.1", "-1e-9", "nan", "1 mm"},
         "0.5"},
        {kept(Number(-1e6, 0.5)),
         "-1e+06 to 0.5",
         R"({"type":"number","minimum":-1000000,"maximum":0.5})",
         {"-1e6"},
         {"0.6"},
         "-1000000"},
        {kept(Number(1e-12)), "1e-12 or more", R"({"type":"number","minimum":1e-12})", {"3"}, {"0"}, "3"},
        {kept(Number(std::numeric_limits<double>::lowest(), -1.)),
         "at most -1",
         R"({"type":"number","maximum":-1})",
         {"-1.5"},
         {"0"},
         "-1.5"},
        {kept(Number()), "a finite number", R"({"type":"number"})", {"1e300"}, {"infinite"}, "1e+300"},
        {kept(WholeNumber(1, 3)),
         "1 to 3",
         R"({"type":"integer","minimum":1,"maximum":3})",
         {"2", "1", "3"},
         {"", "0", "4", "1.5"},
         "2"},
        {kept(WholeNumber(0)), "0 or more", R"({"type":"integer","minimum":0})", {"7"}, {"-1"}, "7"},
        {kept(WordOrNumber("masses", Number(0.))),
         "'masses' or a number from 0 or more",
         R"({"anyOf":[{"const":"masses"},{"type":"number","minimum":0}]})",
         {"masses", "7.5"},
         {"-1", "mass", ""},
         "\"masses\""},
        {kept(WordOrNumber("none", Number())),
         "'none' or a finite number",
         R"({"anyOf":[{"const":"none"},{"type":"number"}]})",
         {"-7.5"},
         {""},
         "-7.5"},
        {kept(ListOf(Number(0., 1.), 0, 5)),
         "up to 5 numbers from 0 to 1, separated by commas",
         "{\"type\":\"array\",\"items\":{" + each + "},\"maxItems\":5}",
         {"0, 0.25,1", "", "1"},
         {"2", "0,0,0,0,0,0"},
         "[0,0.25,1]"},
        {kept(ListOf(WholeNumber(-2, 2), 1, 2)),
         "up to 2 numbers from -2 to 2, separated by commas",
         R"({"type":"array","items":{"type":"integer","minimum":-2,"maximum":2},"maxItems":2,"minItems":1})",
         {"-1,2"},
         {"0.5", "", "1,1,1"},
         "[-1,2]"},
        {kept(OneOf({"sector", "full wheel"})),
         "sector or full wheel",
         R"({"enum":["sector","full wheel"]})",
         {"full wheel", "sector"},
         {"full", ""},
         "\"full wheel\""},
        {kept(TrueOrFalse()), "true or false", R"({"type":"boolean"})", {"true", "false"}, {"1", ""}, "true"},
        {kept(AnyText()), "any text", R"({"type":"string"})", {"", "a"}, {}, "\"\""},
        {kept(AnyText("a:b", "^a:b$")),
         "a:b",
         R"({"type":"string","pattern":"^a:b$","$comment":"a:b"})",
         {"a:b"},
         {},
         "\"a:b\""}})
      {
        check.that(words + ": in words", allowed->in_words() == words);
        check.that(words + ": schema", allowed->schema() == Json::parse(schema));
        for (const std::string &text : right)
          check.that(words + ": takes '" + text + "'", allowed->match(text) && allowed->clone()->match(text));
        for (const std::string &text : wrong)
          check.that(words + ": refuses '" + text + "'", !allowed->match(text));
        check.that(words + ": value", allowed->value(right.front()) == Json::parse(value));
      }
    check.that("whole numbers have no point", Number().value("140.0").dump() == "140");
  }


  void check_section(tests::Check &check)
  {
    double                radius = 0.46, speed = 140. / 3.6, wear = 0.;
    std::vector<double>   moduli{60e9};
    std::vector<int>      supports;
    std::optional<double> load;
    unsigned int          passages = 1;
    bool                  writes   = false;
    std::string           title;
    Gauge                 gauge = Gauge::standard;
    ParameterTable        table;
    {
      Section section(table, "Wheel");
      section.add("Radius (mm)", radius, "Its radius.", Number(1., 5000.));
      section.add("Speed (km per h)", speed, "Its speed.", Number(0.));
      section.add("Moduli (GPa)", moduli, "Some.", Number(0.), 3);
      section.add("Supports", supports, "Under it.", WholeNumber(-9, 9), 4);
      section.add("Wheel load (kN)", load, "masses", "Its load.", Number(0.));
    }
    {
      Section section(table, "Output");
      section.add("Passages", passages, "How many.", WholeNumber(1, 100));
      section.add("Write", writes, "Whether.");
      section.add("Title", title, "Its name.");
      section.choose("Gauge", gauge, "Of the track.");
      section.declare("Wear (mm3 per kJ)", "1", Number(0.), "Of a law.",
                      [&](const std::string &text) { wear = 1e-12 * std::stod(text); });
      section.declare("Wear (mm3 per kJ)", "1", Number(0.), "Of a law."); // of another one, which shares it
    }
    std::string paths;
    for (const Parameter &parameter : table.parameters())
      paths += parameter.path() + "=" + parameter.normal + ";";
    check.that("defaults in the units of their names, in the order of declaration",
               paths ==
                 "Wheel/Radius (mm)=460;Wheel/Speed (km per h)=140;Wheel/Moduli (GPa)=60;Wheel/Supports=;"
                 "Wheel/Wheel load (kN)=masses;Output/Passages=1;Output/Write=false;Output/Title=;"
                 "Output/Gauge=standard;Output/Wear (mm3 per kJ)=1;");
    check.that("a choice has the meaning of each",
               table.find("Output/Gauge")->meaning ==
                 "Of the track. standard: 1435 mm. broad: 1520 mm or more.");
    check.that("a list that has numbers by default keeps one",
               !table.set(*table.find("Wheel/Moduli (GPa)"), "") &&
                 table.set(*table.find("Wheel/Supports"), ""));
    check.that("there is no other", !table.find("Wheel/Radius") && !table.find("Output/Radius (mm)"));
    for (const auto &[path, value] :
         std::vector<std::pair<std::string, std::string>>{{"Wheel/Radius (mm)", "500"},
                                                          {"Wheel/Speed (km per h)", "36"},
                                                          {"Wheel/Moduli (GPa)", "1, 2.5"},
                                                          {"Wheel/Supports", "-3,4"},
                                                          {"Wheel/Wheel load (kN)", "80"},
                                                          {"Output/Passages", "7"},
                                                          {"Output/Write", "true"},
                                                          {"Output/Title", "a, b"},
                                                          {"Output/Gauge", "broad"},
                                                          {"Output/Wear (mm3 per kJ)", "2"}})
      {
        check.that(path + " is set", table.set(*table.find(path), value));
        check.that(path + " is kept", table.value(*table.find(path)) == value);
      }
    check.that("what is not allowed changes nothing",
               !table.set(*table.find("Wheel/Radius (mm)"), "0") &&
                 table.value(*table.find("Wheel/Radius (mm)")) == "500");
    check.relative("mm", radius, 0.5, 1e-15);
    check.relative("km per h", speed, 10., 1e-15);
    check.relative("GPa", moduli.at(1), 2.5e9, 1e-15);
    check.relative("kN", load.value(), 80e3, 1e-15);
    check.relative("a unit of its own", wear, 2e-12, 1e-15);
    check.that("the others", supports == std::vector<int>{-3, 4} && passages == 7 && writes &&
                               title == "a, b" && gauge == Gauge::broad && moduli.size() == 2);
    table.set(*table.find("Wheel/Wheel load (kN)"), "masses");
    check.that("a word leaves the number open", !load);
    bool refused = false;
    try
      {
        Section section(table, "Wheel");
        section.add("Length (furlong)", radius, "Its length.", Number());
      }
    catch (const std::logic_error &)
      {
        refused = true;
      }
    check.that("a unit that nobody knows is refused", refused);
  }

  void check_needs(tests::Check &check)
  {
    double         a = 0., b = 1.;
    std::string    kind = "none";
    ParameterTable table;
    {
      Section section(table, "Own");
      section.add("Kind", kind, "One of some.", OneOf({"none", "round", "square", "long"}));
      section.add("Free", a, "Always.", Number());
      section.all_need({{"Own/Kind", {}, "a shape"}});
      section.needs(Need("Own/Kind", {"round", "square", "long"}).or_else({section.path("Free"), {"1"}}))
        .add("Size (mm)", a, "Of it.", Number());
      section.needs({"Other/Mass (kg)", {}, "above 0"}).add("Edges", b, "Of it.", Number());
      section.add("Colour", b, "Of it.", Number());
      section.all_need({});
      section
        .needs(Need("Own/Kind", {"round"}, "round, or 1, with a mass")
                 .or_has("Own/Free", {"1"})
                 .and_has("Other/Mass (kg)", {}))
        .add("Turns", b, "Of it.", Number());
      section.needs(Need::of_fact("Own/Kind", "that pleases", "pleases"))
        .add("Pleasure", b, "Of it.", Number());
      section.needs({"Own/Nothing", {"1"}}).add("Lost", b, "Of it.", Number());
    }
    {
      Section section(table, "Other");
      section.add("Mass (kg)", a, "Its mass.", Number());
    }
    const auto documented = [&](const std::string &path) {
      return table.find(path)->documentation();
    };
    check.that("what needs nothing says nothing", documented("Own/Free") == "Always.");
    check.that("the narrowest need of a parameter is said, with what may take its place",
               documented("Own/Size (mm)") ==
                 "Of it. Needs 'Own/Kind' round, square or long, or 'Own/Free' 1.");
    check.that("several are",
               documented("Own/Edges") == "Of it. Needs 'Own/Kind' a shape and 'Other/Mass (kg)' above 0.");
    check.that("those of all", documented("Own/Colour") == "Of it. Needs 'Own/Kind' a shape.");

    const auto unmet = [&](const std::string &path, const bool pleases = false) {
      const Need *const need = table.unmet_need(
        *table.find("Own/" + path), [&](const std::string &fact) { return fact == "pleases" && pleases; });
      return need ? need->in_words() : "";
    };
    const auto set = [&](const std::string &path, const std::string &value) {
      table.set(*table.find(path), value);
    };
    check.that("it has an effect without a need", unmet("Free").empty());
    check.that("the first unmet need is told", unmet("Edges") == "'Own/Kind' a shape");
    set("Own/Kind", "long");
    check.that("any other value than the usual one", unmet("Colour").empty());
    check.that("then the next one is", unmet("Edges") == "'Other/Mass (kg)' above 0");
    set("Other/Mass (kg)", "0.00");
    check.that("the same number is no other value", unmet("Edges") == "'Other/Mass (kg)' above 0");
    set("Other/Mass (kg)", "2");
    check.that("both are met", unmet("Edges").empty());
    check.that("one of two and a third: not yet", unmet("Turns") == "'Own/Kind' round, or 1, with a mass");
    set("Own/Free", "1");
    check.that("by the other one", unmet("Turns").empty());
    set("Other/Mass (kg)", "0");
    check.that("but not without the third", unmet("Turns") == "'Own/Kind' round, or 1, with a mass");
    set("Own/Kind", "none");
    check.that("what takes the place of a need leaves that of all",
               unmet("Size (mm)") == "'Own/Kind' a shape");
    check.that("a fact", unmet("Pleasure", true).empty() && unmet("Pleasure") == "'Own/Kind' that pleases");
    check.that("a parameter that there is not",
               !tests::complaint<std::logic_error>([&] { unmet("Lost"); }).empty());
    check.that("the same number in other words", ParameterTable::same_value("5", "5.0") &&
                                                   !ParameterTable::same_value("5", "5 a") &&
                                                   !ParameterTable::same_value("", "0"));
  }
} // namespace base_parameters


TREAD_TEST(base_parameters)(tests::Check &check, const tests::Arguments &)
{
  base_parameters::check_kinds(check);
  base_parameters::check_section(check);
  base_parameters::check_needs(check);
}
