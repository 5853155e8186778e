#include "graphics/render/fixed_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "scene/data/test_scene.h"

namespace parvis::render {
namespace {

class Plain final : public scene::TracedSurface {
  scene::TracedPoint point(const scene::TracedHit&) const override { return {}; }
};

const Mesh house = scene::box({-2, -6, 0}, {5, 6, 9}), slab = scene::box({-90, -90, 49}, {90, 90, 50});

/// A house of 9 m that a room draws, and a slab 40 m above it.
scene::Scene traced_house_below(const scene::TracedPlacing& slab_placing) {
  scene::Scene scene;
  const auto trace = [slab_placing](const scene::Scene&, scene::TracedScene& traced) {
    const auto add = [&](const Mesh& mesh, const scene::TracedPlacing& placing) {
      traced.add(std::make_shared<const Mesh>(mesh), std::make_shared<const Plain>(), glm::mat4(1.0f),
                 placing);
    };
    add(house, {}), add(slab, slab_placing);
  };
  scene.traced_kinds.push_back({"captured", [](const scene::Scene&) { return 1; }, trace});
  return scene;
}

/// The same as an object of two parts.
scene::Scene modelled_house_below(bool is_backdrop) {
  const std::shared_ptr<scene::Model> model = scene::model_of(house, scene::matt(glm::vec3(0.5f)));
  model->parts.push_back({.object = "slab", .mesh = slab, .is_backdrop = is_backdrop});
  scene::Scene scene;
  scene::add(scene, model);
  return scene;
}

/// The same as a model that a room draws.
scene::Scene traced_model_below(bool is_backdrop) {
  const std::shared_ptr<const scene::Model> model = modelled_house_below(is_backdrop).objects.front().model;
  scene::Scene scene;
  const auto trace = [model](const scene::Scene&, scene::TracedScene& traced) {
    traced.add(model, glm::mat4(1.0f), {});
  };
  scene.traced_kinds.push_back({"placed", [](const scene::Scene&) { return 1; }, trace});
  return scene;
}

float highest_of(const scene::Scene& scene) {
  shading::Heightfield heights({{-20, -20, 0}, {20, 20, 60}});
  add_fixed_parts(scene, heights);
  return *std::ranges::max_element(heights.heights().pixels);
}

TEST(FixedParts, ABackdropHidesNoSky) {
  for (const scene::Scene& open : {traced_house_below({.casts_shadow = false, .is_backdrop = true}),
                                   modelled_house_below(true), traced_model_below(true)}) {
    const Bounds below = bounds_of_fixed_parts(open, true);
    EXPECT_EQ(below.min, glm::vec3(-2, -6, 0));
    EXPECT_EQ(below.max, glm::vec3(5, 6, 9));
    EXPECT_NEAR(highest_of(open), 9.0f, 0.01f);
  }
  // What pictures are to show without its shadow stands there all the same.
  for (const scene::Scene& covered : {traced_house_below({}), traced_house_below({.casts_shadow = false}),
                                      modelled_house_below(false), traced_model_below(false)}) {
    EXPECT_EQ(bounds_of_fixed_parts(covered, true).max.z, 50.0f);
    EXPECT_NEAR(highest_of(covered), 50.0f, 0.01f);
  }
}

}  // namespace
}  // namespace parvis::render
