// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_parameter_table_h
#define tread_base_parameter_table_h

#include <tread/base/allowed_texts.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>
#include <vector>

namespace tread
{
  /// A parameter as it was declared.
  struct Parameter
  {
    std::string                         section, name; ///< with its unit
    std::string                         normal;        ///< value if nothing is said
    std::string                         meaning;
    std::shared_ptr<const AllowedTexts> allowed;

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
