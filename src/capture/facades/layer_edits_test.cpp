#include "capture/facades/layer_edits.h"

#include <gtest/gtest.h>

#include "base/test_folder.h"
#include "capture/facades/test_model.h"

namespace parvis::facades {
namespace {

struct Made {
  LayerModel model;
  View view;
  VisibilityLayers visibility;
  LayeredView layered;
  LayerPixels pixels;

  LayersOfModel layers() const { return {model, view, visibility, layered}; }
  std::size_t layer(const std::string& object) const {
    for (std::size_t i = 0; i < layered.layers.size(); ++i)
      if (layered.layers[i].name.ends_with(" " + object)) return i;
    ADD_FAILURE() << object;
    return 0;
  }
  std::uint8_t* at(const std::string& object, int x, int y) {
    const std::size_t i = layer(object);
    return pixels[i].at(x - layered.layers[i].box.x, y - layered.layers[i].box.y);
  }
};

Made made(const std::vector<NamedMesh>& meshes, const View& view = test_view(128, 128)) {
  Made m{model_of(meshes), view, {}, {}, {}};
  m.visibility = visibility_layers(m.model, m.view, "test");
  m.layered = image_layers(m.model, m.view, m.visibility, 32);
  m.pixels = original_pixels(Image8(view.width, view.height, 4, 90), m.layered);
  return m;
}

std::vector<NamedMesh> before() {
  return {wall("facade", 8, -5, 5, -5, 5), wall("post", 4, -0.5f, 0.5f, -3, 3)};
}

/// The facade behind the post is cloned over, and a hole is made in the post.
LayerEdits painted(Made& m) {
  const LayerPixels untouched = m.pixels;
  for (int y = 40; y < 60; ++y)
    for (int x = 60; x < 68; ++x) {
      std::uint8_t* p = m.at("facade", x, y);
      p[0] = std::uint8_t(x), p[1] = std::uint8_t(y), p[2] = 7;
    }
  m.at("post", 64, 70)[3] = 0;
  return edits_of(m.layers(), untouched, m.pixels);
}

TEST(LayerEdits, AreFoundByObject) {
  Made m = made(before());
  const LayerEdits edits = painted(m);
  ASSERT_EQ(edits.size(), 2u);
  EXPECT_EQ(edits[0].object, "facade");
  EXPECT_EQ(edits[0].pixels.size(), 20u * 8);
  EXPECT_EQ(edits[1].object, "post");
  EXPECT_EQ(edits[1].pixels.size(), 1u);
}

// The model gets a balcony and the facade is divided: its layers have other names, boxes and orders.
TEST(LayerEdits, SurviveAChangedModel) {
  Made m = made(before());
  const LayerEdits edits = painted(m);
  Made changed = made({wall("balcony", 6, -4, -2, -1, 0), wall("post", 4, -0.5f, 0.5f, -3, 3),
                       wall("awning", 5, -1, 3, 0, 0.8f), wall("facade", 8.2f, -5.5f, 5, -5, 6)});
  const AppliedEdits applied = apply(edits, changed.layers(), "0001.jpg", changed.pixels);
  EXPECT_EQ(applied.applied, 20u * 8 + 1);
  EXPECT_TRUE(applied.messages.empty()) << to_string(applied.messages);
  for (int y = 40; y < 60; ++y)
    for (int x = 60; x < 68; ++x) EXPECT_EQ(changed.at("facade", x, y)[1], y);
  EXPECT_EQ(changed.at("post", 64, 70)[3], 0);
}

TEST(LayerEdits, WhatNoLongerFitsIsReportedAndKept) {
  Made m = made(before());
  const LayerEdits edits = painted(m);
  // The post is gone; the facade ends at row 50 of the photograph, and is seen.
  Made changed = made({wall("facade", 8, -5, 5, -5, 1.75f)});
  const AppliedEdits applied = apply(edits, changed.layers(), "0001.jpg", changed.pixels);
  EXPECT_EQ(applied.applied, 10u * 8);
  ASSERT_EQ(applied.messages.size(), 2u);
  EXPECT_EQ(to_string(applied.messages[0]),
            "photograph 0001.jpg: 80 of 160 edited pixels of object \"facade\" (layer \"L01-000 facade\", 8 "
            "x 10 at 60,40) no longer "
            "fit: its surface has moved away from there; they are kept");
  EXPECT_NE(to_string(applied.messages[1]).find("\"post\""), std::string::npos);
  EXPECT_NE(to_string(applied.messages[1]).find("no such object any more"), std::string::npos);
  // With the old model again everything is back.
  Made rebuilt = made(before());
  LayerEdits all = applied.unplaced;
  const AppliedEdits rest = apply(edits, rebuilt.layers(), "0001.jpg", rebuilt.pixels);
  EXPECT_EQ(rest.applied, 20u * 8 + 1);
  EXPECT_EQ(apply(all, rebuilt.layers(), "0001.jpg", rebuilt.pixels).applied, 81u);
}

TEST(LayerEdits, SurviveACameraThatIsCalibratedAgain) {
  Made m = made(before());
  const LayerEdits edits = painted(m);
  View moved = test_view(128, 128, {0.05, -0.1, 0.02});
  moved.fx = moved.fy = 65.0;
  Made changed = made(before(), moved);
  EXPECT_EQ(apply(edits, changed.layers(), "0001.jpg", changed.pixels).applied, 20u * 8 + 1);
  EXPECT_EQ(changed.at("facade", 62, 45)[0], 62);
}

TEST(LayerEdits, ASurfaceFarFromThePaintedOneIsNotPainted) {
  Made m = made(before());
  const LayerEdits edits = painted(m);
  Made changed = made({wall("facade", 12, -9, 9, -9, 9), wall("post", 4, -0.5f, 0.5f, -3, 3)});
  EXPECT_EQ(apply(edits, changed.layers(), "0001.jpg", changed.pixels).applied, 1u);
}

TEST(LayerEdits, LaterOnesCoverEarlierOnes) {
  const LayerEdits first = {{"a", "l", {{1, 1, 5.0f, {1, 1, 1, 255}}, {2, 1, 5.0f, {2, 2, 2, 255}}}}};
  const LayerEdits second = {{"a", "l", {{2, 1, 5.1f, {9, 9, 9, 255}}}}};
  const LayerEdits both = joined(first, second);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].pixels.size(), 1u);
  EXPECT_EQ(both[1].pixels[0].rgba[0], 9);
}

TEST(LayerEdits, AreKeptInAFile) {
  const TestFolder folder;
  Made m = made(before());
  const LayerEdits edits = painted(m);
  ASSERT_TRUE(write_edits(folder.path() / "a.edits", edits));
  const Result<LayerEdits> read = read_edits(folder.path() / "a.edits");
  ASSERT_TRUE(read) << to_string(read.errors());
  ASSERT_EQ(read->size(), edits.size());
  EXPECT_EQ((*read)[0].object, "facade");
  EXPECT_EQ((*read)[0].pixels[17].rgba, edits[0].pixels[17].rgba);
  folder.write("b.edits", "something else");
  EXPECT_FALSE(read_edits(folder.path() / "b.edits"));
}

}  // namespace
}  // namespace parvis::facades
