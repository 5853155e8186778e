#include "reflections/reference_maps/set_cover.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "base/random.h"

namespace parvis::reference_maps {
namespace {

using Chosen = SetCover::Chosen;

bool always(std::size_t, std::size_t) { return true; }

std::size_t covered(const std::vector<SetCover::Elements>& sets, const Chosen& chosen) {
  std::set<std::uint32_t> all;
  for (const std::size_t set : chosen) all.insert(sets[set].begin(), sets[set].end());
  return all.size();
}

TEST(SetCover, ExchangeFindsTheTwoSetsThatGreedChoosesThreeFor) {
  const SetCover cover({{0, 1, 2, 3}, {0, 1, 4}, {2, 3, 5}}, 6, always);
  const Chosen greedy = cover.greedy(9, 6);
  EXPECT_EQ(greedy, (Chosen{0, 1, 2}));
  EXPECT_EQ(cover.improved(greedy, 6), (Chosen{1, 2}));
}

TEST(SetCover, OneSetThatIsEnoughIsAllThatIsKept) {
  const SetCover cover({{0, 1}, {0, 1, 2}}, 3, always);
  EXPECT_EQ(cover.greedy(9, 3), Chosen{1});
  EXPECT_EQ(cover.improved({0, 1}, 3), Chosen{1});
}

TEST(SetCover, SetsThatDoNotGoTogetherAreNotChosenTogether) {
  const SetCover cover({{0, 1, 2}, {3, 4}, {3}}, 5,
                       [](std::size_t a, std::size_t b) { return a + b != 1; });  // 0 and 1 do not
  EXPECT_EQ(cover.greedy(9, 5), (Chosen{0, 2}));
}

TEST(SetCover, NothingToChooseFromGivesNothing) {
  EXPECT_TRUE(SetCover({}, 4, always).greedy(3, 4).empty());
  EXPECT_TRUE(SetCover({{}, {}}, 4, always).greedy(3, 4).empty()) << "empty sets add nothing";
  EXPECT_TRUE(SetCover({{0}}, 1, always).greedy(0, 1).empty());
  EXPECT_TRUE(SetCover({{0}}, 1, always).improved({}, 1).empty());
}

TEST(SetCover, ImprovementNeverCoversLessNorTakesMore) {
  Random random(4);
  for (int town = 0; town < 20; ++town) {
    std::vector<SetCover::Elements> sets(60);
    for (SetCover::Elements& set : sets) {
      const std::uint32_t first = std::uint32_t(random.index(280));
      for (std::uint32_t i = 0; i < 20; ++i)
        if (random.chance(0.7f)) set.push_back(first + i);
    }
    const SetCover cover(sets, 300, always);
    const Chosen few = cover.greedy(8, 300);
    EXPECT_GE(covered(sets, cover.improved(few, 300)), covered(sets, few));
    const Chosen whole = cover.greedy(60, 200), less = cover.improved(whole, 200);
    EXPECT_LE(less.size(), whole.size());
    EXPECT_GE(covered(sets, less), 200u);
  }
}

}  // namespace
}  // namespace parvis::reference_maps
