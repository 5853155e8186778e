#include "reflections/reflector_maps/reflector_sources.h"

#include <gtest/gtest.h>

#include "scene/data/test_scene.h"

namespace parvis::reflector_maps {
namespace {

scene::Material glass() {
  scene::Material material;
  material.ior = 1.5f;
  material.is_mirror_like = true;
  return material;
}

GlassSource source_of(const Mesh& mesh) {
  scene::Object object;
  object.model = scene::model_of(mesh, glass());
  std::vector<GlassSource> sources = glass_sources(object);
  EXPECT_EQ(sources.size(), 1u);
  GlassSource source = std::move(sources.at(0));
  source.material = nullptr;  // of the model, which ends here
  return source;
}

TEST(GlassSources, OfConcaveBodiesAreAsThickAsTheirWalls) {
  EXPECT_NEAR(source_of(scene::box({0, 0, 0}, {1, 1, 0.01f})).thickness, 0.01f, 3e-4f);
  for (const bool is_turned : {false, true}) {
    Mesh ball = scene::sphere(glm::vec3(0.0f), 0.1f, 32), inside = scene::sphere(glm::vec3(0.0f), 0.095f, 32);
    for (std::size_t i = 0; is_turned && i < inside.indices.size(); i += 3)
      std::swap(inside.indices[i], inside.indices[i + 1]);
    append(ball, inside);
    const GlassSource source = source_of(ball);
    EXPECT_TRUE(source.is_closed);
    EXPECT_NEAR(source.thickness, 0.005f, 1e-4f);
  }
}

/// A centimetre's drop, 3 m out, with a seam that rounding has opened.
TEST(GlassSources, AreClosedAsTheModelsGlassIs) {
  Mesh drop = scene::sphere({3, 3, 3}, 0.005f, 16);
  for (int ring = 0; ring <= 16; ++ring)
    for (int axis = 0; axis < 3; ++axis) {
      float& along = drop.positions[std::size_t(33 * ring)][axis];
      along = std::nextafter(along, 4.0f);
    }
  EXPECT_TRUE(source_of(drop).is_closed);
  drop.indices.resize(drop.indices.size() / 2);
  const GlassSource open = source_of(drop);
  EXPECT_FALSE(open.is_closed);
  EXPECT_EQ(open.thickness, glass().thickness_m);
}

}  // namespace
}  // namespace parvis::reflector_maps
