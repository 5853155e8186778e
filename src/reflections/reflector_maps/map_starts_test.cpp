#include "reflections/reflector_maps/map_starts.h"

#include "base/test_directions.h"
#include "reflections/reflection_search/reflection_search.h"
#include "reflections/reflector_maps/test_reflectors.h"

namespace parvis::reflector_maps {
using namespace reflection_search;
namespace {

TEST(MapStarts, KnowHowTheSurfaceCurves) {
  const Reflector ball = reflector(ellipsoid_mesh(glm::vec3(2.0f)));
  for (std::size_t i = 0; i < start_count; ++i) {
    const MapStart start = ball.maps[0].starts[i];
    EXPECT_NEAR(glm::length(start.position), 2.0f, 0.005f);
    EXPECT_NEAR(glm::dot(start.normal, start.u), 0.0f, 1e-4f);
    // 1 / radius all round; the mesh's interpolated normals turn by a few hundredths more here, less there.
    EXPECT_LT(glm::distance(start.curvature, glm::vec3(0.5f, 0.0f, 0.5f)), 0.02f);
  }
}

/// A map that counts how often it is looked into.
struct Counting {
  const ReflectorMap& map;
  MapWindow window = map.window;
  bool is_convex = map.is_convex, shows_once = map.shows_once;
  const MapStarts& starts = map.starts;
  mutable int lookups = 0;

  bool is_whole_body() const { return map.is_whole_body(); }
  MapPoint sample(glm::vec3 direction) const {
    ++lookups;
    return map.sample(direction);
  }
};

TEST(MapStarts, SearchesBeginNextToTheirPoint) {
  const Reflector ellipsoid = reflector(ellipsoid_mesh({1, 0.6f, 0.8f}));
  const Counting counting{ellipsoid.maps[0]};
  ReflectionSearch<Counting> search{counting};
  Random random(7);
  constexpr int tasks = 1000;
  int found = 0;
  for (int i = 0; i < tasks; ++i) {  // hidden vertices, too
    const glm::vec3 viewer = random.uniform(2.0f, 6.0f) * random_direction(random),
                    vertex = random.uniform(1.2f, 4.0f) * random_direction(random);
    const auto point = search.search_patch({viewer, vertex, counting.window.centre}, search.patch_kind(), -1);
    found += search.is_found(point) ? 1 : 0;
  }
  EXPECT_GT(found, 998);
  EXPECT_LT(counting.lookups, 5 * tasks) << "8 before searches had places to choose from";
}

}  // namespace
}  // namespace parvis::reflector_maps
