#include "planning/design/difference.h"

#include <gtest/gtest.h>

namespace parvis::design {
namespace {

PlacedObject object(const char* name, const char* kind, glm::dvec3 at, double heading = 0.0) {
  PlacedObject made;
  made.name = name, made.kind = kind, made.position = at, made.heading_deg = heading;
  made.size_m = glm::dvec3(1.0);
  return made;
}

TEST(Difference, OfADesignToItselfIsNothing) {
  const std::vector<PlacedObject> all{object("a", "bench", {0, 0, 0}),
                                      object("b", "tree", {3, 0, 0}, 359.999)};
  EXPECT_TRUE(differences(all, all).empty());
  std::vector<PlacedObject> renamed = all;
  renamed[0].name = "c", renamed[1].heading_deg = 0.0;
  EXPECT_TRUE(differences(all, renamed).empty()) << "another name in the same place is the same bench";
}

TEST(Difference, SaysWhatCameWentMovedAndChanged) {
  const std::vector<PlacedObject> before{object("a", "bench", {0, 0, 0}), object("b", "bench", {2, 0, 0}),
                                         object("c", "bin", {5, 0, 0}), object("d", "lamp", {7, 0, 0})};
  std::vector<PlacedObject> after{object("a", "bench", {0.3, 0.4, 0}), object("b", "bench", {2, 0, 0}, 90.0),
                                  object("d", "lamp", {7, 0, 0}), object("c", "tree", {5, 0, 0})};
  after[2].size_m.z = 2.0;
  const std::vector<Difference> found = differences(before, after);
  ASSERT_EQ(found.size(), 5u);
  EXPECT_EQ(found[0].how, Differs::removed);
  EXPECT_EQ(found[0].before.kind, "bin") << "a tree of that name is another object";
  EXPECT_EQ(found[1].how, Differs::moved);
  EXPECT_NEAR(found[1].moved_m, 0.5, 1e-12);
  EXPECT_EQ(found[2].how, Differs::moved);
  EXPECT_EQ(found[3].how, Differs::changed);
  EXPECT_EQ(found[4].how, Differs::added);
  EXPECT_NE(line_of(found[1]).find("by 0.50 m to 0.300,0.400"), std::string::npos) << line_of(found[1]);
}

}  // namespace
}  // namespace parvis::design
