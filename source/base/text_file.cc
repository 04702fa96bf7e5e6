// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/base/text_file.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace tread
{
  namespace
  {
    bool begins_with(const std::string &text, const std::string_view begin)
    {
      return text.compare(0, begin.size(), begin) == 0;
    }

    bool is_blank(const char c)
    {
      return c == ' ' || c == '\t' || c == '\r';
    }

    bool is_digit(const char c)
    {
      return c >= '0' && c <= '9';
    }

    bool is_letter(const char c)
    {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    }

    std::string lower(std::string text)
    {
      for (char &c : text)
        if (c >= 'A' && c <= 'Z')
          c += 'a' - 'A';
      return text;
    }

    void append_utf8(std::string &text, const std::uint32_t code)
    {
      if (code < 0x80)
        text += static_cast<char>(code);
      else if (code < 0x800)
        {
          text += static_cast<char>(0xC0 | (code >> 6));
          text += static_cast<char>(0x80 | (code & 0x3F));
        }
      else
        {
          if (code < 0x10000)
            text += static_cast<char>(0xE0 | (code >> 12));
          else
            {
              text += static_cast<char>(0xF0 | (code >> 18));
              text += static_cast<char>(0x80 | ((code >> 12) & 0x3F));
            }
          text += static_cast<char>(0x80 | ((code >> 6) & 0x3F));
          text += static_cast<char>(0x80 | (code & 0x3F));
        }
    }

    std::string from_utf16(const std::string &bytes, const std::size_t begin, const bool little_end_first)
    {
      const auto unit = [&](const std::size_t i) {
        const auto first  = static_cast<unsigned char>(bytes[i]),
                   second = static_cast<unsigned char>(bytes[i + 1]);
        return static_cast<std::uint32_t>(little_end_first ? first | second << 8 : first << 8 | second);
      };
      std::string text;
      for (std::size_t i = begin; i + 1 < bytes.size(); i += 2)
        {
          std::uint32_t code = unit(i);
          if (code >= 0xD800 && code < 0xDC00 && i + 3 < bytes.size())
            {
              const std::uint32_t low = unit(i + 2);
              if (low >= 0xDC00 && low < 0xE000)
                {
                  code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
                  i += 2;
                }
            }
          append_utf8(text, code);
        }
      return text;
    }

    /// Whether nearly every second byte is zero, beginning with the first (0) or the second (1): UTF-16 of
    /// Latin letters without a byte order mark.
    bool has_zeros_at(const std::string &bytes, const std::size_t begin)
    {
      std::size_t n = 0, zeros = 0;
      for (std::size_t i = begin; i < bytes.size(); i += 2)
        {
          ++n;
          zeros += bytes[i] == '\0';
        }
      return n > 1 && 10 * zeros > 9 * n;
    }

    void replace_all(std::string &text, const std::string_view from, const std::string_view to)
    {
      for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    }

    /// UTF-8 without a byte order mark.
    std::string decoded(const std::string &bytes)
    {
      using namespace std::string_view_literals;
      if (begins_with(bytes, "PK\x03\x04") || begins_with(bytes, "\xD0\xCF\x11\xE0"))
        throw TextError(0, "is a spreadsheet or an archive, and no text: export its table as text");
      if (begins_with(bytes, "\x1F\x8B") || begins_with(bytes, "BZh"))
        throw TextError(0, "is compressed: unpack it first");
      if (begins_with(bytes, "%PDF"))
        throw TextError(0, "is a PDF document, and no text: write its numbers as text");
      if (begins_with(bytes, "\xFF\xFE\0\0"sv) || begins_with(bytes, "\0\0\xFE\xFF"sv))
        throw TextError(0, "is written in UTF-32: write it as UTF-8");
      std::string text;
      if (begins_with(bytes, "\xFF\xFE"))
        text = from_utf16(bytes, 2, true);
      else if (begins_with(bytes, "\xFE\xFF"))
        text = from_utf16(bytes, 2, false);
      else if (has_zeros_at(bytes, 1) && bytes.find('\0') == 1)
        text = from_utf16(bytes, 0, true);
      else if (has_zeros_at(bytes, 0) && bytes.find('\0') == 0)
        text = from_utf16(bytes, 0, false);
      else
        text = begins_with(bytes, "\xEF\xBB\xBF") ? bytes.substr(3) : bytes;
      if (text.find('\0') != text.npos)
        throw TextError(0, "is no text: it has bytes that are zero");
      replace_all(text, "\xC2\xA0", " ");     // no-break space
      replace_all(text, "\xE2\x88\x92", "-"); // minus sign
      replace_all(text, "\xEF\xBB\xBF", "");  // byte order marks of files that were joined
      return text;
    }

    /// Where a comma or a semicolon stands outside of quotes.
    std::vector<std::size_t> places_of(const std::string &text, const char wanted)
    {
      std::vector<std::size_t> places;
      bool                     quoted = false;
      for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] == '"')
          quoted = !quoted;
        else if (!quoted && text[i] == wanted)
          places.push_back(i);
      return places;
    }

    /// Whether the comma there can only separate columns: it does not stand between digits.
    bool only_separates(const std::string &text, const std::size_t comma)
    {
      if (comma == 0 || comma + 1 == text.size() || !is_digit(text[comma + 1]))
        return true;
      const char before = text[comma - 1];
      return !is_digit(before) && before != '-' && before != '+';
    }

    std::string quoted(const std::string &text)
    {
      constexpr std::size_t longest = 40;
      return "'" + text.substr(0, longest) + (text.size() > longest ? "..." : "") + "'";
    }

    /// The decimal sign of entries that commas do not separate, which must be one for all of them.
    char decimal_sign(const std::vector<NumberedLine> &rows, const char separator, const std::size_t most)
    {
      unsigned int with_comma = 0, with_point = 0;
      for (const NumberedLine &row : rows)
        {
          const std::vector<std::string> entries = entries_of(row.text, separator);
          for (std::size_t i = 0; i < std::min(entries.size(), most); ++i)
            {
              const std::string &entry = entries[i];
              const bool         comma = entry.find(',') != entry.npos, point = entry.find('.') != entry.npos;
              // Words may have both.
              if (entry.find_first_not_of("+-.,0123456789eEdD") != entry.npos ||
                  entry.find_first_of("0123456789") == entry.npos)
                continue;
              if (comma && (point || std::count(entry.begin(), entry.end(), ',') > 1))
                throw TextError(row.number, quoted(entry) +
                                              " has more than one decimal sign; numbers are written without "
                                              "separators of thousands");
              if (comma && with_comma == 0)
                with_comma = row.number;
              if (point && with_point == 0)
                with_point = row.number;
              if (with_comma > 0 && with_point > 0)
                throw TextError(row.number, "decimal " + std::string(comma ? "commas" : "points") +
                                              ", where line " +
                                              std::to_string(comma ? with_point : with_comma) +
                                              " has decimal " + (comma ? "points" : "commas"));
            }
        }
      return with_comma > 0 ? ',' : '.';
    }
  } // namespace


  std::vector<std::string> read_lines(const std::string &file)
  {
    std::error_code cannot_tell;
    if (std::filesystem::is_directory(file, cannot_tell))
      throw TextError(0, "is a folder");
    std::ifstream in(file, std::ios::binary);
    if (!in)
      throw TextError(0, "cannot be read");
    const std::string text = decoded(std::string(std::istreambuf_iterator<char>(in), {}));
    // Line ends of old Macs only where no others are: a carriage return within a line of Unix is a blank.
    const bool               has_newlines = text.find('\n') != text.npos;
    std::vector<std::string> lines;
    for (std::size_t begin = 0; begin < text.size();)
      {
        const std::size_t end  = std::min(text.find(has_newlines ? '\n' : '\r', begin), text.size());
        std::string       line = text.substr(begin, end - begin);
        while (!line.empty() && line.back() == '\r')
          line.pop_back();
        lines.push_back(std::move(line));
        begin = end + 1;
      }
    return lines;
  }


  std::vector<std::string> entries_of(const std::string &line, const char separator)
  {
    std::vector<std::string> entries;
    std::string              entry;
    bool                     is_quoted = false, was_quoted = false;
    const auto               finish = [&] {
      const auto is_kept = [](const char c) {
        return !is_blank(c);
      };
      if (!was_quoted)
        {
          entry.erase(entry.begin(), std::find_if(entry.begin(), entry.end(), is_kept));
          entry.erase(std::find_if(entry.rbegin(), entry.rend(), is_kept).base(), entry.end());
        }
      if (separator != ' ' || !entry.empty() || was_quoted)
        entries.push_back(entry);
      entry.clear();
      was_quoted = false;
    };
    for (std::size_t i = 0; i < line.size(); ++i)
      {
        const char c = line[i];
        if (c == '"' && is_quoted && i + 1 < line.size() && line[i + 1] == '"')
          {
            entry += '"';
            ++i;
          }
        else if (c == '"' && (is_quoted || std::all_of(entry.begin(), entry.end(), is_blank)))
          {
            if (!is_quoted)
              entry.clear();
            is_quoted  = !is_quoted;
            was_quoted = true;
          }
        else if (!is_quoted && (c == separator || (separator == ' ' && is_blank(c))))
          finish();
        else if (!was_quoted || is_quoted || !is_blank(c))
          entry += c;
      }
    finish();
    return entries;
  }


  std::optional<double> number_in(std::string_view entry, const char decimal)
  {
    if (entry.size() > 1 && entry.front() == '+' && entry[1] != '-' && entry[1] != '+')
      entry.remove_prefix(1);
    std::string text(entry);
    for (char &c : text)
      if (c == decimal)
        c = '.';
      else if (c == '.')
        return {};
      else if (c == 'D' || c == 'd')
        c = 'e';
    double     value  = 0.;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    if (result.ec != std::errc() || result.ptr != text.data() + text.size())
      return {};
    return value;
  }


  std::string without_remark(const std::string &line)
  {
    for (std::size_t i = 0; i < line.size(); ++i)
      if ((is_letter(line[i]) || static_cast<unsigned char>(line[i]) >= 0x80 || line[i] == '(') &&
          (i == 0 || is_blank(line[i - 1]) || line[i - 1] == ',' || line[i - 1] == ';'))
        {
          const std::string word = lower(line.substr(i, line.find_first_of(" \t\r,;", i) - i));
          if (word != "nan" && word != "inf" && word != "infinity")
            return line.substr(0, i);
          i += word.size() - 1;
        }
    return line;
  }


  TableGrammar grammar_of(const std::vector<NumberedLine> &rows)
  {
    // Semicolons separate wherever they are.
    for (const NumberedLine &row : rows)
      if (!places_of(row.text, ';').empty())
        return {';', decimal_sign(rows, ';', row.text.npos)};
    bool         has_comma = false, has_point = false;
    unsigned int separating = 0, in_words = 0; // lines in which commas separate, and in which they cannot
    for (const NumberedLine &row : rows)
      {
        const std::vector<std::size_t> commas = places_of(row.text, ',');
        has_point                             = has_point || row.text.find('.') != row.text.npos;
        if (commas.empty())
          continue;
        has_comma = true;
        if (separating == 0 && std::any_of(commas.begin(), commas.end(), [&](const std::size_t comma) {
              return only_separates(row.text, comma);
            }))
          separating = row.number;
        // "-30,000 -2,072": two words, each a number of its own.
        if (in_words == 0 && entries_of(row.text, ' ').size() > 1 &&
            std::none_of(commas.begin(), commas.end(),
                         [&](const std::size_t comma) { return only_separates(row.text, comma); }))
          in_words = row.number;
      }
    if (!has_comma)
      return {' ', decimal_sign(rows, ' ', std::string::npos)};
    if (separating > 0 && in_words > 0)
      throw TextError(std::max(separating, in_words),
                      "a comma separates columns in line " + std::to_string(separating) +
                        " and stands within numbers in line " + std::to_string(in_words));
    if (in_words > 0)
      return {' ', decimal_sign(rows, ' ', std::string::npos)};
    for (const NumberedLine &row : rows)
      if (!has_point && entries_of(row.text, ',').size() > 2)
        throw TextError(row.number, "decimal commas cannot be told from commas between columns in " +
                                      quoted(row.text) + "; separate the columns by semicolons");
    return {',', decimal_sign(rows, ',', std::string::npos)};
  }


  TableGrammar grammar_below(const std::string &names, const std::vector<NumberedLine> &rows)
  {
    TableGrammar grammar;
    grammar.separator = !places_of(names, ';').empty()      ? ';'
                        : !places_of(names, '\t').empty()   ? '\t'
                        : !places_of(names, ',').empty()    ? ','
                        : entries_of(names, ' ').size() > 1 ? ' '
                                                            : ',';
    if (grammar.separator != ',')
      grammar.decimal = decimal_sign(rows, grammar.separator, std::string::npos);
    return grammar;
  }
} // namespace tread
