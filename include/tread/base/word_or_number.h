// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_word_or_number_h
#define tread_base_word_or_number_h

#include <deal.II/base/patterns.h>

#include <memory>
#include <string>

namespace tread
{
  /// The pattern of a parameter that is a word, or a number in a range.
  class WordOrNumber : public dealii::Patterns::PatternBase
  {
  public:
    WordOrNumber(const std::string &word, const dealii::Patterns::Double &range)
      : word(word)
      , range(range)
    {
    }
    bool match(const std::string &text) const override
    {
      return text == word || range.match(text);
    }
    std::string description(const OutputStyle style) const override
    {
      return "'" + word + "' or a number from " + range.description(style);
    }
    std::unique_ptr<PatternBase> clone() const override
    {
      return std::make_unique<WordOrNumber>(word, range);
    }

  private:
    const std::string              word;
    const dealii::Patterns::Double range;
  };
} // namespace tread

#endif
