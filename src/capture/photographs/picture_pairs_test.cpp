#include "capture/photographs/picture_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace parvis::photographs {
namespace {

/// A descriptor of a feature of the world, with the noise of one photograph.
void add_feature(int feature, float noise, Random& photograph, PictureFeatures& to) {
  Random world(std::uint64_t(feature) + 1000);
  float squares = 0.0f;
  std::vector<float> values;
  for (std::size_t i = 0; i < descriptor_bytes; ++i) {
    const float value =
        std::pow(world.uniform(), 3.0f) + noise * std::abs(photograph.uniform() - photograph.uniform());
    values.push_back(value), squares += value * value;
  }
  for (const float value : values)
    to.descriptors.push_back(std::uint8_t(std::min(512.0f * value / std::sqrt(squares), 255.0f)));
  to.numbers.push_back(std::uint32_t(feature));
}

/// A photograph of features [first, last).
PictureFeatures photograph_of(int first, int last, int number) {
  Random random(std::uint64_t(number) + 1);
  PictureFeatures features{"p" + std::to_string(number), {}, {}, {}};
  for (int feature = first; feature < last; ++feature) add_feature(feature, 0.2f, random, features);
  return features;
}

TEST(PicturePairs, SharedFeaturesAgreeAndOthersDoNot) {
  const PictureFeatures a = photograph_of(0, 60, 1), b = photograph_of(40, 100, 2),
                        c = photograph_of(200, 260, 3);
  const std::vector<FeatureMatch> matches = matching_features(a, b);
  ASSERT_EQ(matches.size(), 20u);
  for (const auto& [of_a, of_b] : matches) EXPECT_EQ(of_a, of_b);
  EXPECT_EQ(matching_features(b, a).size(), 20u);
  EXPECT_EQ(matching_features(a, b, 45).size(), 5u) << "of the 45 largest of each five are the same";
  EXPECT_TRUE(matching_features(a, c).empty());
  EXPECT_TRUE(matching_features(a, {}).empty());
}

TEST(PicturePairs, AFeatureThatIsThereTwiceAgreesWithNone) {
  PictureFeatures windows = photograph_of(0, 30, 1);
  const PictureFeatures twice = windows;
  windows.descriptors.insert(windows.descriptors.end(), twice.descriptors.begin(), twice.descriptors.end());
  windows.numbers.insert(windows.numbers.end(), twice.numbers.begin(), twice.numbers.end());
  EXPECT_TRUE(matching_features(photograph_of(0, 30, 2), windows).empty());
}

TEST(PicturePairs, AWalkIsComparedWithItsNeighboursAlone) {
  std::vector<PictureFeatures> walk;
  for (int i = 0; i < 40; ++i) walk.push_back(photograph_of(10 * i, 10 * i + 40, i));
  const std::vector<PicturePair> pairs = promising_pairs(walk);
  for (std::size_t i = 0; i + 3 < walk.size(); ++i)
    for (std::size_t next = 1; next <= 3; ++next)
      EXPECT_TRUE(std::ranges::count(pairs, PicturePair(i, i + next)) > 0) << i << " + " << next;
  EXPECT_LT(pairs.size(), 40u * 6u);
  EXPECT_TRUE(std::ranges::is_sorted(pairs));
  EXPECT_TRUE(std::ranges::all_of(pairs, [](const PicturePair& p) { return p.first < p.second; }));
}

TEST(PicturePairs, FewPhotographsAreAllCompared) {
  std::vector<PictureFeatures> few;
  for (int i = 0; i < 5; ++i) few.push_back(photograph_of(100 * i, 100 * i + 30, i));
  EXPECT_EQ(promising_pairs(few).size(), 10u);
  EXPECT_TRUE(promising_pairs({}).empty());
}

}  // namespace
}  // namespace parvis::photographs
