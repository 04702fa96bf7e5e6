// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/allowed_texts.h>
#include <tread/base/format.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/join.hpp>
#include <nlohmann/json.hpp>

#include <cmath>

namespace tread
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    /// Whole numbers without a point.
    Json plain(const double value)
    {
      constexpr double exact = 1e15;
      if (value == std::trunc(value) && std::abs(value) < exact)
        return std::int64_t(value);
      return value;
    }

    /// A range of which a limit may be open, with the numbers as a message has them.
    std::string range_in_words(const std::string &least, const std::string &largest)
    {
      if (least.empty())
        return largest.empty() ? "a finite number" : "at most " + largest;
      return least + (largest.empty() ? " or more" : " to " + largest);
    }
  } // namespace


  Json AllowedTexts::value(const std::string &text) const
  {
    return text;
  }


  std::string Number::in_words() const
  {
    return range_in_words(least == std::numeric_limits<double>::lowest() ? "" : format("%g", least),
                          largest == std::numeric_limits<double>::max() ? "" : format("%g", largest));
  }


  Json Number::schema() const
  {
    Json schema{{"type", "number"}};
    if (least != std::numeric_limits<double>::lowest())
      schema["minimum"] = plain(least);
    if (largest != std::numeric_limits<double>::max())
      schema["maximum"] = plain(largest);
    return schema;
  }


  Json Number::value(const std::string &text) const
  {
    return plain(dealii::Utilities::string_to_double(text));
  }


  std::string WholeNumber::in_words() const
  {
    return range_in_words(std::to_string(least),
                          largest == std::numeric_limits<int>::max() ? "" : std::to_string(largest));
  }


  Json WholeNumber::schema() const
  {
    Json schema{{"type", "integer"}, {"minimum", least}};
    if (largest != std::numeric_limits<int>::max())
      schema["maximum"] = largest;
    return schema;
  }


  Json WholeNumber::value(const std::string &text) const
  {
    return dealii::Utilities::string_to_int(text);
  }


  std::string WordOrNumber::in_words() const
  {
    const std::string range = number.in_words(), any = Number().in_words();
    return "'" + word + "' or " + (range == any ? "" : "a number from ") + range;
  }


  Json WordOrNumber::schema() const
  {
    return {{"anyOf", {Json{{"const", word}}, number.schema()}}};
  }


  Json WordOrNumber::value(const std::string &text) const
  {
    return text == word ? Json(text) : number.value(text);
  }


  std::string ListOf::in_words() const
  {
    return format("up to %u numbers from ", at_most) + each->in_words() + ", separated by commas";
  }


  Json ListOf::schema() const
  {
    Json schema{{"type", "array"}, {"items", each->schema()}, {"maxItems", at_most}};
    if (at_least > 0)
      schema["minItems"] = at_least;
    return schema;
  }


  Json ListOf::value(const std::string &text) const
  {
    Json list = Json::array();
    for (const std::string &part : dealii::Utilities::split_string_list(text))
      list.push_back(each->value(part));
    return list;
  }


  OneOf::OneOf(const std::vector<std::string> &words)
    : AllowedTextsOf(dealii::Patterns::Selection(boost::algorithm::join(words, "|")))
    , words(words)
  {
  }


  std::string OneOf::in_words() const
  {
    return boost::algorithm::join(words, " or ");
  }


  Json OneOf::schema() const
  {
    return {{"enum", words}};
  }


  std::string TrueOrFalse::in_words() const
  {
    return "true or false";
  }


  Json TrueOrFalse::schema() const
  {
    return {{"type", "boolean"}};
  }


  Json TrueOrFalse::value(const std::string &text) const
  {
    return text == "true";
  }


  std::string AnyText::in_words() const
  {
    return form.empty() ? "any text" : form;
  }


  Json AnyText::schema() const
  {
    Json schema{{"type", "string"}};
    if (!expression.empty())
      {
        schema["pattern"]  = expression;
        schema["$comment"] = form;
      }
    return schema;
  }


  std::string AnyText::number(const bool may_be_negative)
  {
    return std::string(R"(\s*)") + (may_be_negative ? "[-+]?" : "[+]?") +
           R"((\d+\.?\d*|\.\d+)([eE][-+]?\d+)?\s*)";
  }
} // namespace tread
