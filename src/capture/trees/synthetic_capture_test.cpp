#include "capture/trees/synthetic_capture.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "base/test_folder.h"
#include "capture/trees/sample_trees.h"
#include "scene/data/scene_key.h"

namespace parvis::trees {
namespace {

/// A bare tree, three places to photograph it from, and photographs of few pixels.
struct Sitting {
  scene::Model model = *make_sample_tree("winter", 1);
  std::vector<Camera> cameras = capture_cameras(scene::bounds(model), 3);
  CaptureLight light;
  CaptureOptions options;

  Sitting() { options.width = options.height = 24, options.samples_per_pixel = 2; }

  Result<std::vector<TreeView>> photographs(const KeptParts& checkpoint = KeptParts()) const {
    return photograph_tree(capture_scene(model, light), cameras, "tree", options, checkpoint);
  }
  /// Whether those with a checkpoint are those without.
  void expect_same(const KeptParts& checkpoint) const {
    const Result<std::vector<TreeView>> found = photographs(checkpoint), plain = photographs();
    ASSERT_TRUE(found.ok()) << to_string(found.errors());
    ASSERT_EQ(found->size(), plain->size());
    for (std::size_t i = 0; i < plain->size(); ++i) {
      EXPECT_EQ((*found)[i].name, (*plain)[i].name);
      EXPECT_EQ((*found)[i].camera.position_in_world, (*plain)[i].camera.position_in_world);
      EXPECT_EQ((*found)[i].picture.pixels, (*plain)[i].picture.pixels) << i;
    }
  }
};

TEST(SyntheticCapture, GoesOnFromThePhotographsThatWereTaken) {
  const TestFolder folder;
  const KeptParts checkpoint(folder.path() / "steps");
  const Sitting sitting;
  sitting.expect_same(checkpoint);
  // The second photograph is replaced by one that nobody would take: it is found, so the first was, too.
  CaptureOptions own = sitting.options;
  own.seed += 7919;
  const std::string black(4 * 24 * 24, '\0');
  const std::uint64_t shown = scene::scene_key(capture_scene(sitting.model, sitting.light));
  ASSERT_TRUE(
      checkpoint.keep("tree_001", photograph_key(shown, sitting.cameras[1], capture_exposure, own), black)
          .ok());
  const Result<std::vector<TreeView>> again = sitting.photographs(checkpoint);
  ASSERT_TRUE(again.ok()) << to_string(again.errors());
  EXPECT_EQ((*again)[1].picture.pixels, std::vector<std::uint8_t>(black.begin(), black.end()));
  EXPECT_EQ((*again)[2].picture.pixels, (*sitting.photographs())[2].picture.pixels);
  // One of another size is taken afresh.
  ASSERT_TRUE(
      checkpoint.keep("tree_001", photograph_key(shown, sitting.cameras[1], capture_exposure, own), "short")
          .ok());
  sitting.expect_same(checkpoint);
  checkpoint.remove();
  EXPECT_FALSE(std::filesystem::exists(checkpoint.folder()));
}

TEST(SyntheticCapture, PhotographsOfOtherOptionsLightOrTreesAreTakenAfresh) {
  const TestFolder folder;
  const KeptParts checkpoint(folder.path() / "steps");
  Sitting sitting;
  sitting.expect_same(checkpoint);
  sitting.options.samples_per_pixel = 3;
  sitting.expect_same(checkpoint);
  sitting.light.sun_azimuth_deg = 20.0f;
  sitting.expect_same(checkpoint);
  sitting.model = *make_sample_tree("winter", 2);
  sitting.expect_same(checkpoint);
}

TEST(SyntheticCapture, APhotographThatCannotBeKeptIsNamed) {
  const TestFolder folder;
  const KeptParts checkpoint(folder.path() / "steps");
  std::filesystem::create_directories(checkpoint.folder() / "tree_001.part");
  const Result<std::vector<TreeView>> ended = Sitting().photographs(checkpoint);
  ASSERT_FALSE(ended.ok());
  EXPECT_NE(to_string(ended.errors()).find("tree_001"), std::string::npos) << to_string(ended.errors());
  EXPECT_TRUE(std::filesystem::exists(checkpoint.folder() / "tree_000.part")) << "what was taken stays";
}

}  // namespace
}  // namespace parvis::trees
