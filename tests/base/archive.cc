// SPDX-License-Identifier: LGPL-2.1-or-later
// What is stored comes back; what was forged is refused before room is made for it.
#include <tread/base/archive.h>

#include "check.h"

#include <cstdint>
#include <cstring>

using namespace tread;

namespace base_archive
{
  /// As a class names what it keeps.
  struct State
  {
    std::vector<double>                      numbers{1., 2., 3.}, fixed{4., 5.};
    std::vector<std::vector<unsigned int>>   lists{{1, 2}, {}, {3}};
    std::map<unsigned int, std::vector<int>> by_number{{1, {1}}, {7, {2, 3}}};
    bool                                     is_so = true;

    void serialize(Archive &archive)
    {
      archive.same(numbers);
      archive.same_number(fixed);
      archive.same(lists, by_number, is_so);
    }
  };

  std::string stored(State state)
  {
    Archive archive(MPI_COMM_SELF);
    state.serialize(archive);
    return archive.stored();
  }

  /// What restoring says.
  std::string answer(const std::string &bytes, State &state)
  {
    return tests::complaint<OtherStoredLayout>([&] {
      Archive archive(MPI_COMM_SELF, bytes);
      state.serialize(archive);
      if (!archive.found_all())
        throw OtherStoredLayout();
    });
  }

  std::string with(std::string bytes, const std::size_t place, const std::uint64_t value)
  {
    std::memcpy(bytes.data() + place, &value, sizeof value);
    return bytes;
  }

  struct OtherState : State
  {
  };

  /// As a run keeps its parts and recorders.
  template <typename Kind>
  void keep(Archive &archive)
  {
    Kind state;
    archive.kind(typeid(state));
    state.serialize(archive);
  }
} // namespace base_archive

TREAD_TEST(base_archive)(tests::Check &check, const tests::Arguments &)
{
  const std::string good = stored(State());
  State             back;
  back.numbers = {9.};
  back.is_so   = false;
  back.by_number.clear();
  check.that("what was stored is read", answer(good, back).empty());
  check.that("and is the same", stored(back) == good);

  // The size of the part, then number and size of the values of each group.
  constexpr std::size_t number = 8, size = 16, lists = number + 16 + 3 * 8 + 16 + 2 * 8;
  const auto            refused = [&](const std::string &what, const std::string &bytes) {
    State state;
    check.that(what + ": refused", !answer(bytes, state).empty());
  };
  refused("nothing", "");
  refused("a part longer than the file", with(good, 0, ~std::uint64_t(0)));
  refused("more values than bytes", with(good, number, std::uint64_t(1) << 40));
  refused("as many values as there are bytes", with(good, number, good.size()));
  refused("a number that wraps around with its size", with(good, number, std::uint64_t(1) << 61));
  refused("fewer values than follow", with(good, number, 2));
  refused("values of another size", with(good, size, 4));
  refused("as many lists as there are bytes", with(good, lists, good.size() - lists));
  for (std::size_t length = 0; length < good.size(); ++length)
    {
      State state;
      // The size says that all is there, and that it is not.
      const std::string cut = good.substr(0, length);
      if (answer(cut, state).empty() || (length >= 8 && answer(with(cut, 0, length - 8), state).empty()))
        check.that("cut off after " + std::to_string(length) + " bytes: refused", false);
    }
  refused("something left over", with(good + '\0', 0, good.size() - 7));
  std::string neither = good;
  neither.back()      = 2;
  refused("a truth value that is neither", neither);
  State longer;
  longer.fixed.push_back(6.);
  refused("another number of values than the scene has", stored(longer));

  Archive kept(MPI_COMM_SELF);
  keep<State>(kept);
  Archive found(MPI_COMM_SELF, kept.stored());
  keep<State>(found);
  check.that("what a kind has stored it finds again", found.found_all());
  check.that("another kind with the same numbers is refused", !tests::complaint<OtherStoredLayout>([&] {
                                                                 Archive others(MPI_COMM_SELF, kept.stored());
                                                                 keep<OtherState>(others);
                                                               }).empty());
}
