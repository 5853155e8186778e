#include "planning/study/questionnaire.h"

#include <gtest/gtest.h>

#include "planning/study/statistics.h"

namespace parvis::study {
namespace {

std::vector<SusAnswer> answers(std::initializer_list<double> numbers) {
  return {numbers.begin(), numbers.end()};
}

TEST(Sus, OddItemsAreAgreedWithAndEvenOnesDisagreedWith) {
  EXPECT_EQ(*sus_score(answers({3, 3, 3, 3, 3, 3, 3, 3, 3, 3})), 50.0);
  EXPECT_EQ(*sus_score(answers({5, 1, 5, 1, 5, 1, 5, 1, 5, 1})), 100.0);
  EXPECT_EQ(*sus_score(answers({5, 2, 4, 1, 3, 2, 5, 1, 4, 3})), 80.0) << "20: the items are shifted by one";
  const auto parts = sus_subscales(answers({5, 1, 5, 5, 5, 1, 5, 1, 5, 5}));
  ASSERT_TRUE(parts);
  EXPECT_EQ(*parts, std::pair(100.0, 0.0));
}

TEST(Sus, ASheetThatIsNotWholeHasNoScore) {
  std::vector<SusAnswer> missing = answers({3, 3, 3, 3, 3, 3, 3, 3, 3, 3});
  missing[4].reset();
  ASSERT_FALSE(sus_score(missing));
  EXPECT_EQ(sus_score(missing).errors().front().message, "item 5 is missing");
  EXPECT_FALSE(sus_score(answers({3, 3, 3})));
  EXPECT_FALSE(sus_score(answers({0, 3, 3, 3, 3, 3, 3, 3, 3, 3})));
  EXPECT_FALSE(sus_score(answers({3.5, 3, 3, 3, 3, 3, 3, 3, 3, 3})));
  EXPECT_FALSE(sus_score(answers({std::nan(""), 3, 3, 3, 3, 3, 3, 3, 3, 3})));
}

TEST(Sus, PercentilesAreThoseOfFiveHundredStudies) {
  EXPECT_EQ(sus_percentile(68), 50.0);
  EXPECT_EQ(sus_percentile(75), 73.0);
  EXPECT_NEAR(sus_percentile(52), 15.4, 1e-9);
  EXPECT_EQ(sus_percentile_text(20), "below 13");
  EXPECT_EQ(sus_percentile_text(95), "above 99.8");
}

TEST(Answers, OfAScaleAreItsWholeNumbers) {
  const Question question{"q", {}, 1, 7, {}, {}};
  for (const char* right : {"1", "7", ""}) EXPECT_TRUE(check_answer(question, right)) << right;
  for (const char* wrong : {"0", "8", "3.5", "-1", "seven", "4x", " 4"})
    EXPECT_FALSE(check_answer(question, wrong)) << wrong;
}

TEST(Answers, TextsAreUtf8AndBounded) {
  const Question question{"q", {}, 1, 1, {}, {}};
  EXPECT_TRUE(check_answer(question, "élégant, \"bien\""));
  EXPECT_FALSE(check_answer(question, "\xff\xfe"));
  EXPECT_FALSE(check_answer(question, std::string(max_answer_bytes + 1, 'x')));
}

TEST(Means, HaveStudentsInterval) {
  const std::array scores{72.5, 85.0, 60.0, 77.5, 90.0, 55.0, 67.5, 80.0};
  const Mean mean = mean_of(scores);
  EXPECT_NEAR(mean.value, 73.4375, 1e-9);
  EXPECT_NEAR(*mean.deviation, 12.0962, 1e-4);
  EXPECT_NEAR(*mean.half_width, 2.364624 * 4.2766, 1e-3);
  EXPECT_FALSE(mean_of(std::array{70.0}).half_width) << "one person has no interval";
  EXPECT_EQ(mean_of({}).count, 0);
}

}  // namespace
}  // namespace parvis::study
