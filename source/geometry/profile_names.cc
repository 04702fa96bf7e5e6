// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tread/geometry/profile_names.h>

#include <cctype>
#include <utility>
#include <vector>

namespace tread
{
  namespace
  {
    /// Letters and digits of a name, in small letters: "AAR-1B" and "aar 1b" are the same.
    std::string bare(const std::string &name)
    {
      std::string letters;
      for (const unsigned char c : name)
        if (std::isalnum(c))
          letters += static_cast<char>(std::tolower(c));
      for (const std::string prefix : {"arema", "tbt449"})
        if (letters.rfind(prefix, 0) == 0)
          letters.erase(0, prefix.size());
      return letters;
    }

    using Names = std::vector<std::pair<std::vector<std::string>, std::string>>;

    /// @param names bare names, and what is called so here
    std::string called(const Names &names, const std::string &name)
    {
      for (const auto &[others, here] : names)
        for (const std::string &other : others)
          if (bare(name) == other)
            return here;
      return "";
    }
  } // namespace


  std::string advice_on_rail(const std::string &name)
  {
    // Former names, and other spellings.
    static const Names same{{{"54e1", "uic54", "uic54e"}, "54E1"},
                            {{"60e1", "uic60"}, "60E1"},
                            {{"49e1", "s49", "din49"}, "49E1"},
                            {{"cn60", "chn60", "60kgm"}, "CN60"}};
    static const Names missing{{{"115re", "11510"}, "115RE"},           {{"132re"}, "132RE"},
                               {{"136re", "13610"}, "136RE"},           {{"141re"}, "141RE"},
                               {{"bs113a", "113a", "56e1"}, "BS 113A"}, {{"60e2"}, "60E2"},
                               {{"60n", "cn60n", "chn60n"}, "60N"}};
    if (const std::string here = called(same, name); !here.empty())
      return "'" + name + "' is called " + here + " here";
    if (const std::string which = called(missing, name); !which.empty())
      return which + " is not built in, because no public sources agree on the arcs of its head: give it as "
                     "points in "
                     "'Rail/Measured head', which contrib/profile-from-arcs.py makes from a drawing "
                     "(doc/geometry.md)";
    return "";
  }


  std::string advice_on_tread(const std::string &name)
  {
    static const Names same{{{"s1002"}, "S1002"},
                            {{"140", "en140", "en13715140", "cone140", "conical140"}, "cone 1:40"},
                            {{"120", "en120", "cone120", "conical120"}, "cone 1:20"},
                            {{"cylinder", "cylindrical"}, "cylinder"}};
    static const Names missing{{{"p8", "brp8", "eps"}, "P8"},
                               {{"lm"}, "LM"},
                               {{"lma"}, "LMA"},
                               {{"lmb", "lmb10"}, "LMB"},
                               {{"aar1b", "aar1bnf", "aar1bwf"}, "AAR-1B"},
                               {{"s1002cn"}, "S1002CN"},
                               {{"xp55"}, "XP55"}};
    if (const std::string here = called(same, name); !here.empty())
      return "'" + name + "' is called '" + here + "' here" +
             (here.rfind("cone", 0) == 0 ? ", a tread without a flange" : "");
    if (const std::string which = called(missing, name); !which.empty())
      return which +
             " is not built in, because no public sources agree on its coordinates: give its file, which "
             "contrib/profile-from-arcs.py makes from a drawing (doc/geometry.md)";
    return "";
  }


  std::string refused_tread(const std::string &tread, const std::string &why)
  {
    const std::string missing = "cannot be read";
    const bool        is_no_file =
      why.size() >= missing.size() && why.compare(why.size() - missing.size(), missing.size(), missing) == 0;
    const std::string advice = is_no_file ? advice_on_tread(tread) : "";
    return why + "; allowed: cylinder, cone 1:40, cone 1:20, S1002 or a file" +
           (advice.empty() ? "" : ". " + advice);
  }
} // namespace tread
