#include "capture/facades/visibility_layers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <set>
#include <span>

#include "base/random.h"
#include "capture/facades/item_buffer.h"
#include "capture/facades/newell_cut.h"
#include "capture/facades/test_model.h"

namespace parvis::facades {
namespace {

/// "A C|B|wall": names of the objects of each layer; faces with a number after the name.
std::string layers_as_text(const LayerModel& model, const VisibilityLayers& visibility) {
  std::string text;
  for (const auto& layer : visibility.layers) {
    if (!text.empty()) text += "|";
    std::multiset<std::string> names;
    for (const std::uint32_t item : layer)
      names.insert(model.objects[visibility.items[item].object].name +
                   (visibility.items[item].face < 0 ? "" : "'"));
    bool is_first = true;
    for (const std::string& name : names) text += (is_first ? "" : " ") + name, is_first = false;
  }
  return text;
}

std::string layers_of(const std::vector<NamedMesh>& meshes, const View& view = test_view()) {
  LayerModel model = model_of(meshes);
  return layers_as_text(model, visibility_layers(model, view, "test"));
}

/// The definition of layers: at no pixel does an item lie behind an item of its own or a later layer.
void expect_an_order(const LayerModel& model, const View& view, const VisibilityLayers& visibility) {
  const auto item_of = item_of_triangle(model, visibility.items);
  std::vector<std::size_t> layer_of(visibility.items.size(), visibility.layers.size());
  for (std::size_t l = 0; l < visibility.layers.size(); ++l)
    for (const std::uint32_t item : visibility.layers[l]) {
      EXPECT_EQ(layer_of[item], visibility.layers.size()) << "an item in two layers";
      layer_of[item] = l;
    }
  std::atomic<int> wrong{0}, lost{0};
  visit_stacks(model, view, false, {}, [&](int, int, std::span<const Fragment> stack) {
    if (item_of[stack[0].triangle] == no_item) ++lost;
    std::int64_t before = -1;
    for (const Fragment& fragment : stack) {
      const std::uint32_t item = item_of[fragment.triangle];
      if (item == no_item) continue;
      if (std::int64_t(layer_of[item]) <= before) ++wrong;
      before = std::int64_t(layer_of[item]);
    }
  });
  EXPECT_EQ(wrong, 0) << "pixels at which layers are not in the order of depth";
  EXPECT_EQ(lost, 0) << "visible pixels without an item";
}

TEST(VisibilityLayers, TheThesisFigure31) {
  EXPECT_EQ(layers_of({wall("background", 10, -9, 9, -9, 9), wall("B", 6, -2, 4, -1, 2),
                       wall("A", 3, -1, 1, -1, 1), wall("C", 4, 2.9f, 3.5f, -1, 1)}),
            "A C|B|background");
}

// B hides C and D where they lie one behind the other, and is itself hidden by A. The inverted passes take
// out D and B at once, and C is left alone at its pixels: only the comparison with the first pass finds that
// B hid it (figure 3.7).
TEST(VisibilityLayers, TheExtraComparisonLeavesAOnly) {
  const std::vector<Stack> stacks = {{'A', 'B'}, {'B', 'C', 'D'}, {'A'}, {'C'}, {'D'}};
  EXPECT_EQ(next_layer(stacks, 128), (std::vector<std::uint32_t>{'A'}));
  EXPECT_EQ(layers_of({wall("A", 2, -1, 0, -1, 1), wall("B", 3, -1, 1.5f, -1, 1), wall("C", 4, 1, 3, -1, 1),
                       wall("D", 5, 1.5f, 4.5f, -1, 1)}),
            "A|B|C|D");
}

// The definition itself: an item is in the first layer if it is first, and once, in all its stacks.
TEST(VisibilityLayers, ThePassesFindExactlyWhatIsNeverHidden) {
  Random random(7);
  for (int round = 0; round < 300; ++round) {
    std::vector<Stack> stacks;
    for (int s = 0; s < 12; ++s) {
      Stack stack;
      for (int i = 0; i < 1 + int(random.uniform(0, 4)); ++i) stack.push_back(char32_t(random.uniform(0, 8)));
      stacks.push_back(stack);
    }
    std::set<std::uint32_t> expected, present;
    for (const Stack& stack : stacks) present.insert(stack.begin(), stack.end());
    for (const std::uint32_t item : present)
      if (std::ranges::all_of(stacks, [&](const Stack& stack) {
            return stack.rfind(char32_t(item)) == Stack::npos || stack.rfind(char32_t(item)) == 0;
          }))
        expected.insert(item);
    const auto layer = next_layer(stacks, 8);
    ASSERT_EQ(std::set<std::uint32_t>(layer.begin(), layer.end()), expected);
  }
}

TEST(VisibilityLayers, WhatIsNotVisibleIsInNoLayer) {
  EXPECT_EQ(layers_of({wall("front", 2, -5, 5, -5, 5), wall("behind", 3, -1, 1, -1, 1),
                       wall("back", -3, -1, 1, -1, 1)}),
            "front");
}

TEST(VisibilityLayers, AnObjectThatHidesItselfIsSplitIntoFaces) {
  NamedMesh bent = wall("bent", 3, -1, 1, -1, 1);  // two walls, one behind the other, of one object
  append(bent.mesh, wall("", 4, 0, 2, -1, 1).mesh);
  LayerModel model = model_of({bent, wall("far", 8, -5, 5, -5, 5)});
  const VisibilityLayers visibility = visibility_layers(model, test_view(), "test");
  EXPECT_EQ(layers_as_text(model, visibility), "bent'|bent'|far'");
  EXPECT_EQ(visibility.cuts, 0u);
  expect_an_order(model, test_view(), visibility);
}

TEST(VisibilityLayers, AClosedBoxDoesNotHideItself) {
  EXPECT_EQ(layers_of({box("box", {-1, 3, -1}, {1, 4, 1}), wall("far", 8, -5, 5, -5, 5)}), "box|far");
}

// Objects in a cycle, whose faces are in none: an L around the end of a bar.
TEST(VisibilityLayers, ACycleOfObjectsIsSplitIntoFaces) {
  NamedMesh l = wall("L", 3, -2, 0, -1, 0);
  append(l.mesh, wall("", 5, -2, 2, 0.1f, 1).mesh);
  LayerModel model = model_of({l, wall("bar", 4, -1, 1, -2, 2)});
  const VisibilityLayers visibility = visibility_layers(model, test_view(), "test");
  EXPECT_EQ(layers_as_text(model, visibility), "L'|bar'|L'");
  EXPECT_EQ(visibility.cuts, 0u);
}

TEST(VisibilityLayers, IntersectingFacesAreCut) {
  // Two quads that cross like an X seen from above.
  LayerModel model = model_of({quad("rising", {-2, 3, -1}, {4, 2, 0}, {0, 0, 2}),
                               quad("falling", {-2, 5, -1}, {4, -2, 0}, {0, 0, 2})});
  const VisibilityLayers visibility = visibility_layers(model, test_view(), "test");
  EXPECT_GT(visibility.cuts, 0u);
  EXPECT_TRUE(visibility.warnings.empty()) << to_string(visibility.warnings);
  expect_an_order(model, test_view(), visibility);
  ASSERT_EQ(visibility.layers.size(), 2u) << layers_as_text(model, visibility);
}

/// Three bars, each before the next at one end and behind the one before it at the other; none intersects
/// another.
std::vector<NamedMesh> three_bars() {
  std::vector<NamedMesh> bars;
  for (int k = 0; k < 3; ++k) {
    const float angle = float(k) * 2.0f * glm::pi<float>() / 3.0f;
    const auto turned = [&](float along, float across, float y) {
      return glm::vec3(along * std::cos(angle) - across * std::sin(angle), y,
                       along * std::sin(angle) + across * std::cos(angle));
    };
    // A line at distance 1 from the centre, its ends beyond where it crosses the other two; the depth rises
    // along it.
    const glm::vec3 a = turned(-3, 0.8f, 4), b = turned(3, 0.8f, 6), c = turned(-3, 1.2f, 4);
    bars.push_back(quad("bar" + std::to_string(k), a, b - a, c - a));
  }
  return bars;
}

TEST(VisibilityLayers, ACycleOfFacesIsCut) {
  LayerModel model = model_of(three_bars());
  const auto hides = direct_occlusion(
      distinct_stacks(model, test_view(), std::vector<std::uint32_t>{0, 0, 1, 1, 2, 2}, 3).distinct, 3);
  ASSERT_EQ(cycles(hides).size(), 1u) << "the bars are no cycle: the test tests nothing";
  const VisibilityLayers visibility = visibility_layers(model, test_view(), "test");
  EXPECT_GT(visibility.cuts, 0u);
  EXPECT_TRUE(visibility.warnings.empty()) << to_string(visibility.warnings);
  expect_an_order(model, test_view(), visibility);
}

// Each bar lies entirely on the viewer's side of the plane of the next: Newell's planes separate nothing, and
// the outlines are cut along.
TEST(VisibilityLayers, ACycleThatNoPlaneSeparatesIsCutAlongOutlines) {
  std::vector<NamedMesh> bars;
  for (int k = 0; k < 3; ++k) {
    const double angle = k * 2.0 * glm::pi<double>() / 3.0;
    const auto turned = [&](double along, double across, double depth) {
      const double x = along * std::cos(angle) - across * std::sin(angle),
                   z = along * std::sin(angle) + across * std::cos(angle);
      return glm::vec3(glm::dvec3(x, 1.0, z) * depth);  // on the ray through (x, z) of the picture
    };
    NamedMesh bar{"bar" + std::to_string(k), {}};
    bar.mesh.positions = {turned(-0.6, 0.15, 4), turned(0.6, 0.15, 6), turned(0.6, 0.25, 6.05),
                          turned(-0.6, 0.25, 4.05)};
    bar.mesh.indices = {0, 1, 2, 0, 2, 3};
    fill_normals(bar.mesh);
    bar.mesh.uvs.assign(4, glm::vec2(0.0f));
    bars.push_back(bar);
  }
  LayerModel model = model_of(bars);
  const VisibilityLayers visibility = visibility_layers(model, test_view(512, 512), "test");
  EXPECT_GT(visibility.cuts, 0u);
  expect_an_order(model, test_view(512, 512), visibility);
}

TEST(VisibilityLayers, RandomTrianglesGetAnOrder) {
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
    Random random(seed);
    NamedMesh soup{"soup", {}};
    for (std::uint32_t i = 0; i < 24; ++i) {
      const glm::vec3 middle(random.uniform(-2, 2), random.uniform(3, 5), random.uniform(-2, 2));
      for (int k = 0; k < 3; ++k) {
        soup.mesh.positions.push_back(
            middle + glm::vec3(random.uniform(-2, 2), random.uniform(-1, 1), random.uniform(-2, 2)));
        soup.mesh.indices.push_back(3 * i + std::uint32_t(k));
      }
    }
    fill_normals(soup.mesh);
    soup.mesh.uvs.assign(soup.mesh.positions.size(), glm::vec2(0.0f));
    LayerModel model = model_of({soup});
    const VisibilityLayers visibility = visibility_layers(model, test_view(96, 96), "test");
    EXPECT_TRUE(visibility.warnings.empty()) << seed << ": " << to_string(visibility.warnings);
    EXPECT_GT(visibility.cuts, 0u);
    expect_an_order(model, test_view(96, 96), visibility);
  }
}

TEST(VisibilityLayers, CoplanarDuplicatesAreReportedAndOrdered) {
  const Result<LayerModelResult> twice =
      layer_model({wall("a", 3, -1, 1, -1, 1), wall("b", 3, -1, 1, -1, 1)});
  ASSERT_TRUE(twice);
  EXPECT_EQ(twice->model.triangles.size(), 2u);
  ASSERT_EQ(twice->warnings.size(), 1u);
  EXPECT_NE(to_string(twice->warnings).find("\"b\": 2 triangles lie exactly on triangles of \"a\""),
            std::string::npos);
  // In one plane, but not the same triangles: the first in the model is in front, everywhere.
  EXPECT_EQ(layers_of({wall("a", 3, -1, 1, -1, 1), wall("b", 3, -0.3f, 2, -0.7f, 1.3f)}), "a|b");
  EXPECT_EQ(layers_of({wall("b", 3, -0.3f, 2, -0.7f, 1.3f), wall("a", 3, -1, 1, -1, 1)}), "b|a");
}

TEST(VisibilityLayers, ACameraInsideAWallIsNamedAndSeesOut) {
  LayerModel model = model_of({box("thick wall", {-2, -1, -2}, {2, 1, 2}), wall("square", 8, -5, 5, -5, 5)});
  const VisibilityLayers visibility = visibility_layers(model, test_view(), "0001.jpg");
  EXPECT_EQ(layers_as_text(model, visibility), "square");
  ASSERT_EQ(visibility.warnings.size(), 1u);
  EXPECT_NE(to_string(visibility.warnings).find("0001.jpg: its camera lies inside the object \"thick wall\""),
            std::string::npos);
}

TEST(VisibilityLayers, ACameraThatSeesNothingIsNamed) {
  LayerModel model = model_of({wall("behind", -3, -1, 1, -1, 1)});
  const VisibilityLayers visibility = visibility_layers(model, test_view(), "0002.jpg");
  EXPECT_TRUE(visibility.layers.empty());
  EXPECT_NE(to_string(visibility.warnings).find("0002.jpg: its camera sees nothing"), std::string::npos);
}

TEST(VisibilityLayers, AllViewsShareTheCutModel) {
  LayerModel model =
      model_of({quad("rising", {-2, 3, -1}, {4, 2, 0}, {0, 0, 2}),
                quad("falling", {-2, 5, -1}, {4, -2, 0}, {0, 0, 2}), wall("far", 9, -9, 9, -9, 9)});
  const std::vector<View> views = {test_view(64, 64, {0, 0, 5}), test_view(), test_view(96, 96, {1, -1, 0})};
  const auto all = visibility_layers(model, views, {"a", "b", "c"});
  for (std::size_t i = 0; i < views.size(); ++i) expect_an_order(model, views[i], all[i]);
  double area = 0.0;  // nothing of the surfaces was lost or doubled by cutting
  for (const LayerTriangle& t : model.triangles)
    area += 0.5 * glm::length(glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]));
  EXPECT_NEAR(area, 2 * 2 * std::sqrt(20.0) + 18 * 18, 1e-4);
}

TEST(ItemBuffer, TrianglesThatShareEdgesCoverEachPixelOnce) {
  NamedMesh fan{"fan", {}};  // around a pixel centre, with edges through pixel centres
  fan.mesh.positions.push_back({0.5f / 32.0f, 1, 0.5f / 32.0f});
  for (int k = 0; k < 16; ++k) {
    const float angle = float(k) * glm::pi<float>() / 8.0f;
    fan.mesh.positions.push_back(fan.mesh.positions[0] +
                                 2.0f * glm::vec3(std::cos(angle), 0, std::sin(angle)));
  }
  for (std::uint32_t k = 0; k < 16; ++k)
    for (const std::uint32_t i : {0u, 1 + k, 1 + (k + 1) % 16}) fan.mesh.indices.push_back(i);
  fill_normals(fan.mesh);
  fan.mesh.uvs.assign(17, glm::vec2(0.0f));
  std::atomic<int> once{0}, more{0};
  visit_stacks(model_of({fan}), test_view(64, 64), false, {},
               [&](int, int, std::span<const Fragment> stack) { ++(stack.size() == 1 ? once : more); });
  EXPECT_EQ(once, 64 * 64);
  EXPECT_EQ(more, 0);
}

TEST(ItemBuffer, DepthIsExactAndAFloorIsClippedAtTheEye) {
  const LayerModel model = model_of({quad("floor", {-50, -50, -2}, {100, 0, 0}, {0, 100, 0})});
  const View view = test_view(64, 64);
  const ItemBuffer buffer = item_buffer(model, view);
  for (int y = 0; y < 64; ++y) {
    const double slope = (y + 0.5 - view.cy) / view.fy, depth = 2.0 / slope;
    const float seen = buffer.depths[buffer.index(31, y)];
    if (slope > 0 && depth < 50)
      EXPECT_NEAR(seen, depth, 1e-5 * depth) << y;
    else
      EXPECT_TRUE(std::isinf(seen)) << y;
  }
}

}  // namespace
}  // namespace parvis::facades
