#include "land/roads/segment_finder.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace parvis::scene {
namespace {

TEST(SegmentFinder, FindsWhatEveryPairByItselfWouldSay) {
  Random random(3);
  std::vector<PlanBox> boxes;
  for (int i = 0; i < 300; ++i) {
    const float x = random.uniform(0.0f, 100.0f);
    const float y = random.uniform(0.0f, 100.0f);
    const float width = random.uniform(0.0f, 9.0f);
    boxes.push_back({{x, y}, {x + width, y + (i % 3 == 0 ? 0.0f : 5.0f)}});
  }
  boxes.push_back(boxes.front());
  const SegmentFinder finder(boxes);
  std::vector<std::size_t> found;
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    std::vector<std::size_t> expected;
    for (std::size_t j = i + 1; j < boxes.size(); ++j)
      if (glm::all(glm::lessThanEqual(boxes[i].min, boxes[j].max)) &&
          glm::all(glm::lessThanEqual(boxes[j].min, boxes[i].max)))
        expected.push_back(j);
    finder.find(boxes[i], i, found);
    EXPECT_EQ(found, expected);
    pairs += found.size();
  }
  EXPECT_GT(pairs, 200u);
}

}  // namespace
}  // namespace parvis::scene
