// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mutate.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <iterator>

namespace tread::fuzz
{
  namespace
  {
    constexpr std::size_t longest = 1 << 16; // bytes of a mutated file

    constexpr const char *odd_numbers[] = {"0",
                                           "-0",
                                           "1",
                                           "-1",
                                           "2",
                                           "0.5",
                                           "1e-3",
                                           "-1e-3",
                                           "1e3",
                                           "1e6",
                                           "1e9",
                                           "1e18",
                                           "1e300",
                                           "-1e300",
                                           "1e308",
                                           "1e309",
                                           "1e-300",
                                           "4.9e-324",
                                           "nan",
                                           "-nan",
                                           "inf",
                                           "-inf",
                                           "2147483647",
                                           "2147483648",
                                           "-2147483649",
                                           "4294967296",
                                           "1e99999",
                                           "0x10",
                                           "1,000",
                                           "18446744073709551616",
                                           "1.0000000001",
                                           "+3",
                                           "3.",
                                           ".5",
                                           "",
                                           "1e",
                                           "--1",
                                           "0.0000001",
                                           "99999",
                                           "1:20",
                                           "none",
                                           "automatic"};

    std::size_t below(const std::size_t n, Random &random)
    {
      return n > 0 ? random() % n : 0;
    }

    /// A place and a length within a text; short ones are likelier than long ones.
    struct Span
    {
      std::size_t begin, length;
    };
    Span some_span(const std::string &text, Random &random)
    {
      const std::size_t begin = below(text.size() + 1, random), rest = text.size() - begin;
      return {begin, below(std::min<std::size_t>(rest, below(4, random) == 0 ? rest : 16) + 1, random)};
    }

    /// The pieces of a text between characters that separate() names, as spans. Never empty ones.
    template <typename IsPart>
    std::vector<Span> pieces(const std::string &text, const IsPart &is_part)
    {
      std::vector<Span> found;
      for (std::size_t begin = 0; begin < text.size();)
        {
          std::size_t end = begin;
          while (end < text.size() && is_part(text[end]))
            ++end;
          if (end > begin)
            found.push_back({begin, end - begin});
          begin = end + 1;
        }
      return found;
    }

    std::vector<Span> numbers(const std::string &text)
    {
      return pieces(text, [](const unsigned char c) {
        return std::isdigit(c) || c == '.' || c == '-' || c == '+' || c == 'e';
      });
    }

    std::vector<Span> words(const std::string &text)
    {
      return pieces(text, [](const unsigned char c) { return !std::isspace(c) && c != ',' && c != ';'; });
    }

    std::vector<Span> lines(const std::string &text)
    {
      return pieces(text, [](const unsigned char c) { return c != '\n'; });
    }

    template <typename Pieces>
    std::string some_piece(const std::string &text, const Pieces &pieces_of, Random &random)
    {
      const std::vector<Span> all = pieces_of(text);
      if (all.empty())
        return "";
      const Span chosen = all[below(all.size(), random)];
      return text.substr(chosen.begin, chosen.length);
    }

    using Change = void (*)(std::string &, const std::string &other, Random &);

    void flip_bit(std::string &text, const std::string &, Random &random)
    {
      if (!text.empty())
        text[below(text.size(), random)] ^= static_cast<char>(1 << below(8, random));
    }

    void change_byte(std::string &text, const std::string &, Random &random)
    {
      if (!text.empty())
        text[below(text.size(), random)] = static_cast<char>(below(256, random));
    }

    void insert_byte(std::string &text, const std::string &, Random &random)
    {
      static const std::string likely = " ,;=#!\n\t\r:\"'\\/(){}[]<>%$_\0\xff";
      text.insert(text.begin() + below(text.size() + 1, random), likely[below(likely.size(), random)]);
    }

    void erase(std::string &text, const std::string &, Random &random)
    {
      const Span span = some_span(text, random);
      text.erase(span.begin, span.length);
    }

    void cut_off(std::string &text, const std::string &, Random &random)
    {
      text.resize(below(text.size() + 1, random));
    }

    void copy_within(std::string &text, const std::string &, Random &random)
    {
      const Span span = some_span(text, random);
      text.insert(below(text.size() + 1, random), text.substr(span.begin, span.length));
    }

    void splice(std::string &text, const std::string &other, Random &random)
    {
      const Span from = some_span(other, random), to = some_span(text, random);
      text.replace(to.begin, to.length, other.substr(from.begin, from.length));
    }

    void change_number(std::string &text, const std::string &, Random &random)
    {
      const std::vector<Span> all = numbers(text);
      if (all.empty())
        return;
      const Span chosen = all[below(all.size(), random)];
      text.replace(chosen.begin, chosen.length, odd_numbers[below(std::size(odd_numbers), random)]);
    }

    void exchange_number(std::string &text, const std::string &other, Random &random)
    {
      const std::vector<Span> all = numbers(text);
      if (all.empty())
        return;
      const Span chosen = all[below(all.size(), random)];
      text.replace(chosen.begin, chosen.length, some_piece(other, numbers, random));
    }

    void exchange_word(std::string &text, const std::string &other, Random &random)
    {
      const std::vector<Span> all = words(text);
      if (all.empty())
        return;
      const Span chosen = all[below(all.size(), random)];
      text.replace(chosen.begin, chosen.length, some_piece(other, words, random));
    }

    void insert_line(std::string &text, const std::string &other, Random &random)
    {
      const std::vector<Span> all   = lines(text);
      const std::size_t       place = all.empty() ? 0 : all[below(all.size(), random)].begin;
      text.insert(place, some_piece(other, lines, random) + '\n');
    }

    void remove_line(std::string &text, const std::string &, Random &random)
    {
      const std::vector<Span> all = lines(text);
      if (all.empty())
        return;
      const Span chosen = all[below(all.size(), random)];
      text.erase(chosen.begin, chosen.length + 1);
    }

    void repeat_line(std::string &text, const std::string &, Random &random)
    {
      const std::vector<Span> all = lines(text);
      if (all.empty())
        return;
      const Span        chosen = all[below(all.size(), random)];
      const std::string line   = text.substr(chosen.begin, chosen.length) + '\n';
      for (std::size_t n = below(8, random) == 0 ? 200 : 1; n > 0; --n)
        text.insert(chosen.begin, line);
    }

    /// What a binary file counts or points with.
    void change_count(std::string &text, const std::string &, Random &random)
    {
      const std::array<std::uint64_t, 9> odd{{0, 1, 2, 0x7fffffff, 0xffffffff, 0x100000000,
                                              std::uint64_t(1) << 61, std::uint64_t(1) << 63,
                                              ~std::uint64_t(0)}};
      if (text.size() < sizeof(std::uint64_t))
        return;
      const std::size_t places = text.size() / sizeof(std::uint64_t);
      std::uint64_t     value;
      char *const       place = text.data() + sizeof value * below(places, random);
      std::memcpy(&value, place, sizeof value);
      const std::size_t kind = below(odd.size() + 3, random);
      value                  = kind < odd.size()        ? odd[kind]
                               : kind == odd.size()     ? value + 1
                               : kind == odd.size() + 1 ? value - 1
                                                        : value * 2;
      std::memcpy(place, &value, sizeof value);
    }

    // Those that leave the form of a file as it is stand twice: they reach further.
    constexpr Change changes[] = {flip_bit,      change_byte,     insert_byte,     erase,
                                  cut_off,       copy_within,     splice,          change_number,
                                  change_number, exchange_number, exchange_number, exchange_word,
                                  exchange_word, insert_line,     insert_line,     remove_line,
                                  remove_line,   repeat_line,     change_count};
  } // namespace


  std::string mutated(std::string content, const std::vector<std::string> &others, Random &random)
  {
    do
      {
        const std::string &other = others[below(others.size(), random)];
        changes[below(std::size(changes), random)](content, other, random);
      }
    while (below(3, random) != 0); // three changes in the mean
    content.resize(std::min(content.size(), longest));
    return content;
  }
} // namespace tread::fuzz
