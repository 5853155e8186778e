#include "capture/trees/consistent_views.h"

#include <gtest/gtest.h>

#include "capture/trees/test_volume.h"

namespace parvis::trees {
namespace {

TEST(ConsistentViews, OneWrongCameraAmongTwentyIsNamedAndErased) {
  std::vector<TreeView> views = TestVolume(27, 0.05f).ring(20, 56);
  EXPECT_TRUE(leave_out_inconsistent(views, false).empty());
  EXPECT_EQ(views.size(), 20u);

  const std::string wrong = views[7].name, next = views[8].name;
  views[7].camera.position_in_world += glm::vec3(0.5f, 0.2f, 0.4f);
  const std::vector<std::string> kept = leave_out_inconsistent(views, true);
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_EQ(kept[0].rfind(wrong, 0), 0u) << kept[0];
  EXPECT_EQ(kept[0].find("left out"), std::string::npos) << kept[0];
  EXPECT_EQ(views.size(), 20u);

  const std::vector<std::string> notes = leave_out_inconsistent(views, false);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0].rfind(wrong, 0), 0u) << notes[0];
  EXPECT_NE(notes[0].find("left out"), std::string::npos) << notes[0];
  ASSERT_EQ(views.size(), 19u);
  EXPECT_EQ(views[7].name, next);
}

}  // namespace
}  // namespace parvis::trees
