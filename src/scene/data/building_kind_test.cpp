#include "scene/data/building_kind.h"

#include <gtest/gtest.h>

namespace parvis::scene {
namespace {

TEST(BuildingKind, ItsWordsGiveItBack) {
  EXPECT_EQ(words_of({}), "");
  EXPECT_EQ(kind_of_words("WallSurface"), BuildingKind{});
  for (int use = 0; use < 7; ++use)
    for (int epoch = 0; epoch < 7; ++epoch)
      for (int finish = 0; finish < 7; ++finish)
        for (int tint = 0; tint < 9; ++tint)
          for (const std::uint8_t storeys : {0, 1, 255}) {
            const BuildingKind kind{BuildingUse(use), BuildingEpoch(epoch), WallFinish(finish),
                                    WallTint(tint), storeys};
            EXPECT_EQ(kind_of_words("WallSurface " + words_of(kind)), kind) << words_of(kind);
          }
}

TEST(BuildingKind, OtherWordsCountForNothing) {
  const BuildingKind kind = kind_of_words("  Wall  offices 300-storeys x-storeys -storeys office whitewash");
  EXPECT_EQ(kind, BuildingKind{.use = BuildingUse::office});
}

TEST(BuildingKind, EpochsBeginWithTheirYears) {
  EXPECT_EQ(epoch_of(1200), BuildingEpoch::before_1870);
  EXPECT_EQ(epoch_of(1869), BuildingEpoch::before_1870);
  EXPECT_EQ(epoch_of(1870), BuildingEpoch::to_1918);
  EXPECT_EQ(epoch_of(1945), BuildingEpoch::to_1945);
  EXPECT_EQ(epoch_of(1974), BuildingEpoch::to_1974);
  EXPECT_EQ(epoch_of(1999), BuildingEpoch::to_1999);
  EXPECT_EQ(epoch_of(2026), BuildingEpoch::since_2000);
}

TEST(BuildingKind, APartHasWhatItDoesNotSayFromItsWhole) {
  const BuildingKind whole{.use = BuildingUse::church, .epoch = BuildingEpoch::to_1918, .storeys = 2};
  const BuildingKind part = completed({.use = BuildingUse::office, .tint = WallTint::red}, whole);
  EXPECT_EQ(words_of(part), "office 1870-1918 red 2-storeys");
}

}  // namespace
}  // namespace parvis::scene
