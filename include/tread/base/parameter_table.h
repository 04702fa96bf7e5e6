// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_parameter_table_h
#define tread_base_parameter_table_h

#include <tread/base/allowed_texts.h>

#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tread
{
  /// What a parameter needs to have an effect: that others, whose paths are Section/Name, have some values.
  /// Where there are no values to choose from, any is meant but that which a parameter has if nothing is
  /// said.
  struct Need
  {
    /// @param path of the parameter that decides; @param values one of which it must have; @param words for
    /// them, by default the values themselves
    Need(const std::string &path, const std::vector<std::string> &values, const std::string &words = "");
    /// What does not follow from values alone. @param words what the parameter that decides must be; @param
    /// fact the name of what must be true instead, @see ParameterTable::unmet_need()
    static Need of_fact(const std::string &path, const std::string &words, const std::string &fact);

    /// Another parameter must have one of these values, too. The words say so.
    Need &and_has(const std::string &path, const std::vector<std::string> &values);
    /// Or another parameter has one of these values, in place of what was said last. The words say so.
    Need &or_has(const std::string &path, const std::vector<std::string> &values);
    /// Or another need is met, in place of all this. The words do not say so.
    Need &or_else(const Need &other);

    /// For a message, as in "'Track/Foundation' one-layer or two-layer".
    std::string in_words() const;
    /// The same with what may take its place.
    std::string in_full() const;

    struct Value
    {
      std::string              path;
      std::vector<std::string> values;
    };
    std::string                     path, words;
    std::vector<std::vector<Value>> all;  ///< one of each is needed
    std::string                     fact; ///< empty: none is needed
    std::vector<Need>               others;
  };

  /// A parameter as it was declared.
  struct Parameter
  {
    std::string                         section, name; ///< with its unit
    std::string                         normal;        ///< value if nothing is said
    std::string                         meaning;
    std::shared_ptr<const AllowedTexts> allowed;
    std::vector<Need>                   needs; ///< all of them; @see unmet_need()

    /// What it means and what it needs; of several needs of one parameter the last, which is the narrowest.
    std::string documentation() const;
    std::string path() const
    {
      return section + "/" + name;
    }
  };

  /// The parameters of a file, which sections declare (@see Section), with their values.
  class ParameterTable
  {
  public:
    /// In the order of their declaration.
    const std::vector<Parameter> &parameters() const
    {
      return declared;
    }
    /// Null: there is none of this path, Section/Name.
    const Parameter *find(const std::string &path) const;
    /// @pre no section is open
    std::string value(const Parameter &parameter) const;
    /// @returns false, and changes nothing, where the text is not allowed. @pre no section is open
    bool set(const Parameter &parameter, const std::string &text);
    /// Whether two texts are the same, or the same number.
    static bool same_value(const std::string &a, const std::string &b);
    /// Whether it has another value than if nothing is said. @pre no section is open
    bool is_changed(const Parameter &parameter) const
    {
      return !same_value(value(parameter), parameter.normal);
    }
    /// The first need of a parameter that is not met, of several of one path the last, which is the
    /// narrowest; null: it has an effect. @param is_true whether a fact of this name is. @pre no section is
    /// open @throws std::logic_error for a need of what there is not
    const Need *unmet_need(const Parameter                                &parameter,
                           const std::function<bool(const std::string &)> &is_true) const;

    /// deal.II's own table of them, which prints them, and from which laws take the values of the section
    /// that is open.
    const dealii::ParameterHandler &handler() const
    {
      return values;
    }

  private:
    friend class Section;

    std::vector<Parameter>   declared;
    dealii::ParameterHandler values;
  };
} // namespace tread

#endif
