#include "places/dressing/lit_windows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>

#include "base/mesh.h"
#include "base/test_folder.h"
#include "places/dressing/facades.h"
#include "places/dressing/test_walls.h"
#include "rooms/rooms.h"
#include "scene/data/lamp.h"
#include "scene/script/scene_loader.h"

namespace parvis::dressing {
namespace {

/// A wall of 60 x 18 m that faces south.
scene::Model wall() {
  scene::Model model = no_walls();
  Mesh& mesh = model.parts.front().mesh;
  add_quad(mesh, {0, 0, 0}, {60, 0, 0}, {60, 0, 18}, {0, 0, 18});
  fill_normals(mesh);
  mesh.uvs.resize(mesh.positions.size());
  return model;
}

double area_m2(const Mesh& mesh) {
  double area = 0.0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const auto at = [&](std::size_t k) { return mesh.positions[mesh.indices[i + k]]; };
    area += 0.5 * double(glm::length(glm::cross(at(1) - at(0), at(2) - at(0))));
  }
  return area;
}

TEST(LitWindows, SomeOfTheWindowsOfFacadesAreLitJustBeforeTheWall) {
  scene::Model model = wall();
  ASSERT_GT(add_facades(model, "*"), 0u);
  const std::optional<scene::Model> lit = lit_windows(model);
  ASSERT_TRUE(lit);
  ASSERT_GE(lit->parts.size(), 3u) << "three colours of light, of the street level and of the storeys";
  double area = 0.0;
  for (const scene::Part& part : lit->parts) {
    EXPECT_TRUE(check(part.mesh, "windows").ok());
    EXPECT_FALSE(part.casts_shadow);
    const scene::Material& material = lit->materials[std::size_t(part.material)];
    EXPECT_GT(material.emission.x, 0.0f);
    EXPECT_EQ(material.alpha_mode, scene::Alpha::cutout);
    area += area_m2(part.mesh);
    for (const glm::vec3& corner : part.mesh.positions) {
      EXPECT_GT(corner.y, -0.05f);
      EXPECT_LT(corner.y, -0.001f) << "before the wall, which faces south";
      EXPECT_GT(corner.x, 0.0f);
      EXPECT_LT(corner.x, 60.0f);
      EXPECT_LT(corner.z, 18.0f);
    }
  }
  // 20 bays and 6 storeys of windows of some 1.2 x 1.85 m, a third of them.
  EXPECT_GT(area, 0.1 * 120 * 1.2 * 1.85);
  EXPECT_LT(area, 0.7 * 120 * 1.2 * 1.85);
  const std::optional<scene::Model> again = lit_windows(model);
  EXPECT_EQ(again->parts.front().mesh.positions, lit->parts.front().mesh.positions);
}

TEST(LitWindows, AWindowIsLitAsAWholeWhereverItsWallIsCut) {
  scene::Model model = wall();
  add_facades(model, "*");
  const std::optional<scene::Model> whole = lit_windows(model);
  for (scene::Part& part : model.parts) {  // each triangle in two
    Mesh cut;
    for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
      const auto first = std::uint32_t(cut.positions.size());
      for (std::size_t k = 0; k < 3; ++k) append_vertex(cut, part.mesh, part.mesh.indices[i + k]);
      append_vertex(cut, part.mesh, part.mesh.indices[i]);
      cut.positions.back() = 0.5f * (cut.positions[first] + cut.positions[first + 1]);
      cut.uvs.back() = 0.5f * (cut.uvs[first] + cut.uvs[first + 1]);
      cut.indices.insert(cut.indices.end(), {first, first + 3, first + 2, first + 3, first + 1, first + 2});
    }
    if (!part.mesh.indices.empty()) part.mesh = cut;
  }
  const std::optional<scene::Model> pieces = lit_windows(model);
  ASSERT_EQ(pieces->parts.size(), whole->parts.size());
  for (std::size_t i = 0; i < whole->parts.size(); ++i)
    EXPECT_NEAR(area_m2(pieces->parts[i].mesh), area_m2(whole->parts[i].mesh), 1e-3);
}

TEST(LitWindows, WallsWithoutFacadesHaveNone) {
  EXPECT_FALSE(lit_windows(wall()));
  scene::Model bricks = wall();
  add_facades(bricks, "*", 1, false);
  EXPECT_FALSE(lit_windows(bricks));
}

TEST(LitWindows, AreSeenWhileALampBurns) {
  const TestFolder folder;
  folder.write("wall.obj", "v 0 0 0\nv 60 0 0\nv 60 0 18\nv 0 0 18\nf 1 2 3 4\n");
  const auto shown = [&](const std::string& burns) {
    folder.write("wall.xp",
                 "model(name=\"place\", file=\"wall.obj\", up=z) { facades() }\n"
                 "litWindows(of=\"place\")\n"
                 "lamp(position=\"9 -9 5\", flux_lm=5000, shows=\"lit windows\", burns=" +
                     burns + ")\n");
    Result<scene::LoadedScene> loaded = scene::load_scene(folder.path() / "wall.xp", rooms::node_registry());
    EXPECT_TRUE(loaded) << to_string(loaded.errors());
    EXPECT_TRUE(loaded->warnings.empty()) << to_string(loaded->warnings);
    scene::show_what_lamps_show(loaded->scene);
    const auto found = std::ranges::find(loaded->scene.objects, "lit windows", &scene::Object::name);
    EXPECT_NE(found, loaded->scene.objects.end());
    return found != loaded->scene.objects.end() && found->is_visible;
  };
  EXPECT_FALSE(shown("never"));
  EXPECT_TRUE(shown("always"));
}

}  // namespace
}  // namespace parvis::dressing
