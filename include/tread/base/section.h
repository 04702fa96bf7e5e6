// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_section_h
#define tread_base_section_h

#include <tread/base/format.h>
#include <tread/base/input_error.h>
#include <tread/base/parameter_table.h>

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace tread
{
  /// A value of an enumeration, its name in a parameter file and what it means.
  template <typename Enum>
  struct Choice
  {
    Enum        value;
    std::string name, meaning;
  };

  /// All values that a parameter may have, in the order in which they are shown. Each enumeration that a
  /// parameter takes its values from has a specialisation; nothing else needs to know the names.
  template <typename Enum>
  const std::vector<Choice<Enum>> &choices();

  template <typename Enum>
  const std::string &name_of(const Enum value)
  {
    for (const Choice<Enum> &choice : choices<Enum>())
      if (choice.value == value)
        return choice.name;
    throw std::logic_error("a choice without a name");
  }

  template <typename Enum>
  Enum choice_named(const std::string &name)
  {
    for (const Choice<Enum> &choice : choices<Enum>())
      if (choice.name == name)
        return choice.value;
    throw std::logic_error("no choice has the name '" + name + "'");
  }


  /// Declares the parameters of one section of the parameter file. Numbers are kept in SI units: the factor
  /// follows from the unit at the end of the parameter's name, as in "Radius (mm)".
  class Section
  {
  public:
    Section(ParameterTable &table, const std::string &name);
    ~Section();
    Section(const Section &)            = delete;
    Section &operator=(const Section &) = delete;

    /// Section/Name of one of its parameters.
    std::string path(const std::string &parameter) const
    {
      return name + "/" + parameter;
    }
    /// What all parameters need that are declared from here on, in place of what was said before.
    void all_need(const std::vector<Need> &needs)
    {
      of_all = needs;
    }
    /// What the next parameter needs besides.
    Section &needs(const Need &need)
    {
      of_next.push_back(need);
      return *this;
    }

    /// @param value in SI units; what it is now is the default. @param range in the unit of the file.
    void add(const std::string &name, double &value, const std::string &meaning, const Number &range);
    /// A list of numbers, separated by commas; it may be empty if it is so by default. @param range of each
    /// of them; @param at_most so many
    void add(const std::string   &name,
             std::vector<double> &values,
             const std::string   &meaning,
             const Number        &range,
             unsigned int         at_most);
    void add(const std::string &name,
             std::vector<int>  &values,
             const std::string &meaning,
             const WholeNumber &range,
             unsigned int       at_most);
    /// A number, or a word that leaves it open.
    void add(const std::string     &name,
             std::optional<double> &value,
             const std::string     &word,
             const std::string     &meaning,
             const Number          &range);
    void add(const std::string &name,
             unsigned int      &value,
             const std::string &meaning,
             const WholeNumber &range);
    void add(const std::string &name, bool &value, const std::string &meaning);
    void add(const std::string  &name,
             std::string        &value,
             const std::string  &meaning,
             const AllowedTexts &allowed = AnyText());
    /// One of the choices of an enumeration, which are explained one after the other.
    template <typename Enum>
    void choose(const std::string &name,
                Enum              &value,
                const std::string &introduction = "",
                const std::string &remark       = "")
    {
      std::vector<std::string> names;
      std::string              meaning = introduction;
      for (const Choice<Enum> &choice : choices<Enum>())
        {
          names.push_back(choice.name);
          if (!choice.meaning.empty())
            meaning += (meaning.empty() ? "" : " ") + choice.name + ": " + choice.meaning;
        }
      if (!remark.empty())
        meaning += " " + remark;
      declare(name, name_of(value), OneOf(names), meaning,
              [&value](const std::string &text) { value = choice_named<Enum>(text); });
    }

    /// One of the entries of a registry, which have a name and a description.
    template <typename Entry>
    void choose(const std::string        &name,
                std::string              &value,
                const std::vector<Entry> &entries,
                const std::string        &introduction = "")
    {
      std::vector<std::string> names;
      std::string              meaning = introduction;
      for (const Entry &entry : entries)
        {
          names.push_back(entry.name);
          meaning += (meaning.empty() ? "" : " ") + entry.name + ": " + entry.description + ".";
        }
      add(name, value, meaning, OneOf(names));
    }

    /// A parameter whose value is taken from the table later, or handed to `take`. @param value the default,
    /// as in the file
    void declare(const std::string                              &name,
                 const std::string                              &value,
                 const AllowedTexts                             &allowed,
                 const std::string                              &meaning,
                 const std::function<void(const std::string &)> &take = {});

  private:
    ParameterTable   &table;
    const std::string name;
    std::vector<Need> of_all, of_next;
  };
} // namespace tread

#endif
