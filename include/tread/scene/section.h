// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_scene_section_h
#define tread_scene_section_h

#include <tread/base/format.h>
#include <tread/base/input_error.h>

#include <deal.II/base/parameter_handler.h>

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
    Section(dealii::ParameterHandler &handler, const std::string &name);
    ~Section();
    Section(const Section &)            = delete;
    Section &operator=(const Section &) = delete;

    /// @param value in SI units; what it is now is the default. @param range in the unit of the file.
    void add(const std::string              &name,
             double                         &value,
             const std::string              &meaning,
             const dealii::Patterns::Double &range);
    /// A list of numbers, separated by commas; it may be empty if it is so by default. @param range of each
    /// of them; @param at_most so many
    void add(const std::string              &name,
             std::vector<double>            &values,
             const std::string              &meaning,
             const dealii::Patterns::Double &range,
             unsigned int                    at_most);
    /// A number, or a word that leaves it open.
    void add(const std::string              &name,
             std::optional<double>          &value,
             const std::string              &word,
             const std::string              &meaning,
             const dealii::Patterns::Double &range);
    /// Texts, whole numbers and truth values.
    template <typename T>
    void add(
      const std::string                   &name,
      T                                   &value,
      const std::string                   &meaning,
      const dealii::Patterns::PatternBase &pattern = *dealii::Patterns::Tools::Convert<T>::to_pattern())
    {
      handler.add_parameter(name, value, meaning, pattern);
    }
    /// One of the choices of an enumeration, which are explained one after the other.
    template <typename Enum>
    void choose(const std::string &name,
                Enum              &value,
                const std::string &introduction = "",
                const std::string &remark       = "")
    {
      std::string names, meaning = introduction;
      for (const Choice<Enum> &choice : choices<Enum>())
        {
          names += (names.empty() ? "" : "|") + choice.name;
          if (!choice.meaning.empty())
            meaning += (meaning.empty() ? "" : " ") + choice.name + ": " + choice.meaning;
        }
      if (!remark.empty())
        meaning += " " + remark;
      declare(name, name_of(value), meaning, dealii::Patterns::Selection(names),
              [&value](const std::string &text) { value = choice_named<Enum>(text); });
    }

    /// One of the entries of a registry, which have a name and a description.
    template <typename Entry>
    void choose(const std::string        &name,
                std::string              &value,
                const std::vector<Entry> &entries,
                const std::string        &introduction = "")
    {
      std::string names, meaning = introduction;
      for (const Entry &entry : entries)
        {
          names += (names.empty() ? "" : "|") + entry.name;
          meaning += (meaning.empty() ? "" : " ") + entry.name + ": " + entry.description + ".";
        }
      add(name, value, meaning, dealii::Patterns::Selection(names));
    }

  private:
    void declare(const std::string                              &name,
                 const std::string                              &value,
                 const std::string                              &meaning,
                 const dealii::Patterns::PatternBase            &pattern,
                 const std::function<void(const std::string &)> &take);

    dealii::ParameterHandler &handler;
  };
} // namespace tread

#endif
