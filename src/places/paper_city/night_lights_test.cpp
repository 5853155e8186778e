#include "places/paper_city/night_lights.h"

#include <gtest/gtest.h>

#include "places/paper_city/facade_texture.h"
#include "places/paper_city/ground.h"
#include "places/paper_city/street_furniture.h"
#include "places/paper_city/street_plan.h"

namespace parvis::city {
namespace {

TEST(NightLights, GlassAloneIsLit) {
  const synthesis::SurfaceCanvas canvas = facade_canvas(facade_styles()[0], 3);
  const Image8 lit = canvas.lit_glass(4);
  const Image8 colour = canvas.pictures(4, 4).colour;
  ASSERT_EQ(4 * lit.width, colour.width);
  int glass = 0, bright_walls = 0;
  for (int y = 0; y < lit.height; ++y)
    for (int x = 0; x < lit.width; ++x) {
      const std::uint8_t* texel = lit.at(x, y);
      glass += texel[3] > 200;
      if (texel[3] == 0) bright_walls += texel[0] + texel[1] + texel[2] > 0;
      if (texel[3] == 255) {
        EXPECT_GT(texel[0], 60);
      }
    }
  const double fraction = double(glass) / double(lit.width * lit.height);
  EXPECT_GT(fraction, 0.06) << "twelve windows of 2 m2 on 130 m2, less frames and closed shutters";
  EXPECT_LT(fraction, 0.2);
  EXPECT_EQ(bright_walls, 0);
}

TEST(NightLights, WindowsLieBeforeTheirWallsAndAreSoundMeshes) {
  const scene::Model windows = make_lit_windows(1);
  EXPECT_GT(windows.triangle_count(), 5000u);
  EXPECT_LT(windows.triangle_count(), 60000u);
  for (const scene::Part& part : windows.parts) {
    EXPECT_TRUE(check(part.mesh, part.object));
    const scene::Material& material = windows.materials[std::size_t(part.material)];
    EXPECT_EQ(material.alpha_mode, scene::Alpha::cutout);
    EXPECT_GT(material.emission.x, 0.0f);
    for (const glm::vec3 normal : part.mesh.normals) EXPECT_NEAR(normal.z, 0.0f, 1e-5f);
  }
  EXPECT_EQ(make_lit_windows(1).parts.front().mesh.positions, windows.parts.front().mesh.positions);
}

TEST(NightLights, LampsStandBesideCarriageways) {
  const StreetPlan plan = make_street_plan(1);
  const std::vector<glm::vec3> places = street_lamp_places();
  EXPECT_GT(places.size(), 80u);
  for (const glm::vec3& place : places)
    for (const Road& road : plan.roads) {
      const float off = std::abs((road.runs_north ? place.x : place.y) - road.offset_m);
      EXPECT_GT(off, 0.5f * road.profile.carriageway_m + 0.3f);
    }
  EXPECT_LE(furnished_lamps(furniture_triangles(plan)), 12u);
  EXPECT_GT(furnished_lamps(furniture_triangles(plan)), 0u);
}

TEST(NightLights, TheScriptHasALampForEachPlace) {
  const std::string script = night_script(1);
  std::size_t posts = 0;
  for (std::size_t at = 0; (at = script.find("street_lamp.glb", at)) != script.npos; ++at) ++posts;
  EXPECT_EQ(posts + furnished_lamps(furniture_triangles(make_street_plan(1))), street_lamp_places().size());
  EXPECT_EQ(night_script(1), script);
}

}  // namespace
}  // namespace parvis::city
