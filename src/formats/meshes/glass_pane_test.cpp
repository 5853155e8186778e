#include "formats/meshes/glass_pane.h"

#include <gtest/gtest.h>

#include "scene/data/test_scene.h"

namespace parvis::scene {
namespace {

Material glass() {
  Material material;
  material.name = "glass", material.base_colour = glm::vec3(1.0f);
  material.ior = 1.5f, material.is_mirror_like = true;
  return material;
}

TEST(GlassPane, LetsThroughWhatItsThicknessLeavesAndNoMoreThanClearGlass) {
  EXPECT_FLOAT_EQ(pane_of(glass()).alpha, 0.25f);
  Material green = glass();
  green.absorption_per_m = {300.0f, 20.0f, 200.0f};
  const Material thin = pane_of(green);
  green.thickness_m *= 10.0f;
  const Material thick = pane_of(green);
  EXPECT_GT(thin.alpha, 0.25f);
  EXPECT_GT(thick.alpha, thin.alpha);
  EXPECT_LE(thick.alpha, 1.0f);
  EXPECT_GT(thin.base_colour.y, 2.0f * thin.base_colour.x);
  for (const Material& pane : {thin, thick}) {
    EXPECT_FALSE(pane.refracts());
    EXPECT_TRUE(pane.is_mirror_like && pane.is_double_sided);
    EXPECT_EQ(pane.alpha_mode, Alpha::blend);
    EXPECT_NEAR(pane.alpha * pane.base_colour.x, 0.08f, 1e-3f) << "what both faces of a sheet mirror";
  }
}

TEST(GlassPane, OpenSheetsBecomePanesBodiesStay) {
  Mesh mesh = sphere({0, 0, 0}, 1.0f, 8);
  append(mesh, quad({2, 0, 0}, {3, 0, 0}, {3, 0, 1}, {2, 0, 1}));
  Model model = *model_of(mesh, glass());
  model.parts[0].object = "";
  model.parts.push_back({.object = "window", .mesh = quad({5, 0, 0}, {6, 0, 0}, {6, 0, 1}, {5, 0, 1})});
  EXPECT_EQ(settle_glass(model), (std::set<std::string>{"glass", "window"}));
  ASSERT_EQ(model.parts.size(), 3u);
  for (const Part& part : model.parts) {
    const bool is_ball = part.mesh.bounds().min.x < 0.0f;
    const Material& material = model.materials[std::size_t(part.material)];
    EXPECT_EQ(material.refracts(), is_ball);
    EXPECT_EQ(material.alpha_mode, is_ball ? Alpha::opaque : Alpha::blend);
  }
  EXPECT_EQ(model.materials.size(), 2u) << "one pane for both";
  EXPECT_TRUE(settle_glass(model).empty());
}

}  // namespace
}  // namespace parvis::scene
