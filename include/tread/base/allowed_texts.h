// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_allowed_texts_h
#define tread_base_allowed_texts_h

#include <deal.II/base/patterns.h>

#include <nlohmann/json_fwd.hpp>

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace tread
{
  /// The texts that a parameter may have: a pattern of deal.II that also says what it allows.
  class AllowedTexts : public dealii::Patterns::PatternBase
  {
  public:
    /// For a message to the user, as in "0 to 2".
    virtual std::string in_words() const = 0;
    /// JSON schema (draft 2020-12) of a value in place of the text.
    virtual nlohmann::ordered_json schema() const = 0;
    /// A text as such a value. @pre match(text)
    virtual nlohmann::ordered_json              value(const std::string &text) const;
    virtual std::shared_ptr<const AllowedTexts> copy() const = 0;

    bool match(const std::string &text) const override
    {
      return pattern->match(text);
    }
    std::string description(const OutputStyle style) const override
    {
      return pattern->description(style);
    }

  protected:
    explicit AllowedTexts(const PatternBase &pattern)
      : pattern(pattern.clone())
    {
    }

  private:
    std::shared_ptr<const PatternBase> pattern;
  };

  /// What a kind of texts has beside its words and its schema. @tparam Kind derived from it
  template <typename Kind>
  class AllowedTextsOf : public AllowedTexts
  {
  public:
    std::unique_ptr<PatternBase> clone() const override
    {
      return std::make_unique<Kind>(static_cast<const Kind &>(*this));
    }
    std::shared_ptr<const AllowedTexts> copy() const override
    {
      return std::make_shared<Kind>(static_cast<const Kind &>(*this));
    }

  protected:
    using AllowedTexts::AllowedTexts;
  };

  /// A number between two, both of which are allowed.
  class Number : public AllowedTextsOf<Number>
  {
  public:
    explicit Number(const double least   = std::numeric_limits<double>::lowest(),
                    const double largest = std::numeric_limits<double>::max())
      : AllowedTextsOf(dealii::Patterns::Double(least, largest))
      , least(least)
      , largest(largest)
    {
    }
    std::string            in_words() const override;
    nlohmann::ordered_json schema() const override;
    nlohmann::ordered_json value(const std::string &text) const override;

  private:
    double least, largest;
  };

  /// A whole number between two, both of which are allowed.
  class WholeNumber : public AllowedTextsOf<WholeNumber>
  {
  public:
    explicit WholeNumber(const int least, const int largest = std::numeric_limits<int>::max())
      : AllowedTextsOf(dealii::Patterns::Integer(least, largest))
      , least(least)
      , largest(largest)
    {
    }
    std::string            in_words() const override;
    nlohmann::ordered_json schema() const override;
    nlohmann::ordered_json value(const std::string &text) const override;

  private:
    int least, largest;
  };

  /// A word that leaves a number open, or the number.
  class WordOrNumber : public AllowedTextsOf<WordOrNumber>
  {
  public:
    WordOrNumber(const std::string &word, const Number &number)
      : AllowedTextsOf(dealii::Patterns::Anything())
      , word(word)
      , number(number)
    {
    }
    bool match(const std::string &text) const override
    {
      return text == word || number.match(text);
    }
    std::string description(const OutputStyle style) const override
    {
      return "'" + word + "' or a number from " + number.description(style);
    }
    std::string            in_words() const override;
    nlohmann::ordered_json schema() const override;
    nlohmann::ordered_json value(const std::string &text) const override;

  private:
    std::string word;
    Number      number;
  };

  /// Several of one kind, separated by commas.
  class ListOf : public AllowedTextsOf<ListOf>
  {
  public:
    ListOf(const AllowedTexts &each, const unsigned int at_least, const unsigned int at_most)
      : AllowedTextsOf(dealii::Patterns::List(each, at_least, at_most))
      , each(each.copy())
      , at_least(at_least)
      , at_most(at_most)
    {
    }
    std::string            in_words() const override;
    nlohmann::ordered_json schema() const override;
    nlohmann::ordered_json value(const std::string &text) const override;

  private:
    std::shared_ptr<const AllowedTexts> each;
    unsigned int                        at_least, at_most;
  };

  /// One of some words.
  class OneOf : public AllowedTextsOf<OneOf>
  {
  public:
    explicit OneOf(const std::vector<std::string> &words);
    std::string            in_words() const override;
    nlohmann::ordered_json schema() const override;

  private:
    std::vector<std::string> words;
  };

  class TrueOrFalse : public AllowedTextsOf<TrueOrFalse>
  {
  public:
    TrueOrFalse()
      : AllowedTextsOf(dealii::Patterns::Bool())
    {
    }
    std::string            in_words() const override;
    nlohmann::ordered_json schema() const override;
    nlohmann::ordered_json value(const std::string &text) const override;
  };

  /// Any text, or one of a form that whoever reads it checks.
  class AnyText : public AllowedTextsOf<AnyText>
  {
  public:
    /// @param form what is allowed, in words; @param expression the same as regular expression of ECMA 262
    explicit AnyText(const std::string &form = "", const std::string &expression = "")
      : AllowedTextsOf(dealii::Patterns::Anything())
      , form(form)
      , expression(expression)
    {
    }
    std::string            in_words() const override;
    nlohmann::ordered_json schema() const override;

    /// A number in such an expression, with or without a sign; blanks may stand around it.
    static std::string number(const bool may_be_negative = true);

  private:
    std::string form, expression;
  };
} // namespace tread

#endif
