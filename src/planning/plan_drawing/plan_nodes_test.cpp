#include <gtest/gtest.h>

#include "base/image_io.h"
#include "base/registries.h"
#include "formats/drawings/test_drawing.h"
#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/reference/tracer.h"
#include "graphics/render/frame_views.h"
#include "graphics/render/test_renderer.h"
#include "planning/plan_drawing/placed_blocks.h"
#include "planning/plan_drawing/text_outlines.h"
#include "room_list.h"
#include "scene/data/test_scene.h"
#include "scene/script/live_scene.h"
#include "scene/script/test_script.h"

namespace parvis::plan_drawing {
namespace {

using formats::TestDrawing;

Registries test_registries() {
  Registries registries;
  script::register_room(registries), register_room(registries);
  return registries;
}

class PlanNodes : public scene::ScriptTest<gl::ContextTest> {
 protected:
  PlanNodes() : ScriptTest(test_registries()) {}

  /// Two layers, one of them off, near Lambert-93's coordinates of a town.
  void write_drawing(const std::string& unit = "6") const {
    TestDrawing file;
    file.header = "9 $ACADVER|1 AC1015|9 $INSUNITS|70 " + unit;
    file.layers = "0 LAYER|2 BATI|70 0|62 1|0 LAYER|2 AIDE|70 0|62 -3";
    file.entities =
        "0 LINE|5 A|8 BATI|10 1043000|20 6298000|11 1043010|21 6298000|"
        "0 LINE|5 B|8 AIDE|10 1043000|20 6298010|11 1043010|21 6298010";
    folder_.write("square.dxf", file.text());
  }
  static const scene::Object* find(const scene::Scene& scene, const std::string& name) {
    const auto found = std::ranges::find(scene.objects, name, &scene::Object::name);
    return found == scene.objects.end() ? nullptr : &*found;
  }
};

Bounds bounds_of(const scene::Object& object) {
  return transformed(object.world_from_model, scene::bounds(*object.model));
}

TEST_F(PlanNodes, ADrawingStandsWhereItsCoordinatesSay) {
  write_drawing();
  const scene::Scene scene = scene_of("planDrawing(name=\"survey\", file=\"square.dxf\", line_width=0.1)");
  ASSERT_EQ(scene.objects.size(), 2u);
  const glm::dvec3 expected_origin(1043005, 6298005, 0);
  EXPECT_EQ(scene.origin, expected_origin) << "the first georeferenced thing gives the scene its origin";
  const scene::Object* bati = find(scene, "survey BATI");
  ASSERT_TRUE(bati);
  const Bounds bounds = bounds_of(*bati);
  EXPECT_NEAR(bounds.min.x, -5.05f, 1e-4f);
  EXPECT_NEAR(bounds.max.x, 5.05f, 1e-4f);
  EXPECT_NEAR(bounds.min.y, -5.05f, 1e-4f);
  EXPECT_NEAR(bounds.max.y, -4.95f, 1e-4f);
  EXPECT_GT(bounds.min.z, 0.019f) << "above the ground";
  EXPECT_LT(bounds.max.z, 0.04f);
  EXPECT_TRUE(bati->is_visible);
  EXPECT_FALSE(find(scene, "survey AIDE")->is_visible) << "its layer is off";
  EXPECT_EQ(bati->model->materials.at(0).base_colour, glm::vec3(1, 0, 0));
  EXPECT_TRUE(bati->model->parts.at(0).is_backdrop) << "light passes it, no ground is found on it";
  const std::vector<PlacedDrawing>& placed = scene.items<PlacedDrawing>();
  ASSERT_EQ(placed.size(), 1u);
  const glm::vec3 end = placed[0].in_world({1043010, 6298000, 0});
  EXPECT_NEAR(end.x, 5.0f, 1e-4f);
  EXPECT_NEAR(end.y, -5.0f, 1e-4f);
}

TEST_F(PlanNodes, LayersAreShownAndHiddenWhileTheSceneRuns) {
  write_drawing();
  auto loaded = load("planDrawing(name=\"survey\", file=\"square.dxf\")");
  ASSERT_TRUE(loaded);
  scene::LiveScene live(std::move(loaded->script));
  const auto set = [&](const std::string& layers) {
    live.set(*live.find("survey"), "layers", layers);
    return to_string(live.refresh(loaded->scene));
  };
  const auto shown = [&] {
    std::string names;
    for (const scene::Object& object : loaded->scene.objects)
      if (object.is_visible) names += object.name + ";";
    return names;
  };
  EXPECT_EQ(set("AIDE"), "");
  EXPECT_EQ(shown(), "survey BATI;survey AIDE;");
  EXPECT_EQ(set("-*, A*"), "");
  EXPECT_EQ(shown(), "survey AIDE;");
  EXPECT_EQ(loaded->scene.items<PlacedDrawing>().at(0).shows_layer, (std::vector<bool>{false, true}));
  EXPECT_NE(set("BAT").find("BATI"), std::string::npos) << "names the layers that there are";
  EXPECT_EQ(shown(), "survey AIDE;") << "and changes nothing";
}

TEST_F(PlanNodes, BlocksStandForObjectsByATable) {
  TestDrawing file;
  file.blocks =
      "0 BLOCK|8 0|2 BANC|70 0|10 0|20 0|0 LWPOLYLINE|8 0|90 4|70 1|10 0|20 0|10 2|20 0|10 2|20 0.5|10 0|20 "
      "0.5|0 "
      "ENDBLK|0 BLOCK|8 0|2 ARBRE_GRILLE|70 0|10 0|20 0|0 CIRCLE|8 0|10 0|20 0|40 1|0 ENDBLK";
  file.entities =
      "0 INSERT|5 A|8 MOBILIER|2 BANC|10 10|20 5|50 90|0 INSERT|5 B|8 ARBRES|66 1|2 ARBRE_GRILLE|10 3|20 "
      "4|41 2.5|42 2.5|0 "
      "ATTRIB|8 0|10 0|20 0|40 1|1 A8|2 NUM|0 ATTRIB|8 0|10 0|20 0|40 1|1 11.5|2 HAUTEUR_M|0 SEQEND|8 0|0 "
      "INSERT|5 C|8 "
      "ARBRES|2 UNKNOWN|10 0|20 0";
  folder_.write("square.dxf", file.text());
  const scene::Scene scene = scene_of(
      "planDrawing(name=\"survey\", file=\"square.dxf\", position=\"100 0 0\", heading_deg=90, "
      "blocks=\"ARBRE*=tree_lime, BANC = bench\")");
  const std::vector<design::PlacedObject> objects = placed_blocks(scene.items<PlacedDrawing>().at(0));
  ASSERT_EQ(objects.size(), 2u);
  const design::PlacedObject &bench = objects[0], &tree = objects[1];
  EXPECT_EQ(bench.kind, "bench");
  EXPECT_EQ(bench.name, "bench_1");
  EXPECT_EQ(bench.design, "survey");
  // In the drawing it reaches from (9.5, 5) to (10, 7); the drawing is turned clockwise by 90 degrees.
  EXPECT_NEAR(bench.position.x, 106.0, 1e-4);
  EXPECT_NEAR(bench.position.y, -9.75, 1e-4);
  EXPECT_NEAR(bench.heading_deg, 0.0, 1e-3);
  EXPECT_NEAR(bench.size_m.x, 2.0, 1e-6);
  EXPECT_NEAR(bench.size_m.y, 0.5, 1e-6);
  EXPECT_EQ(tree.name, "A8");
  EXPECT_TRUE(tree.is_round);
  EXPECT_NEAR(tree.size_m.x, 5.0, 0.002);
  EXPECT_NEAR(tree.size_m.z, 11.5, 1e-9);
  EXPECT_TRUE(holds(errors_of("planDrawing(file=\"square.dxf\", blocks=\"BANC\")"), "NAME=KIND"));
}

TEST_F(PlanNodes, ADrawingWithoutAUnitIsRefusedUntilTheScriptSaysIt) {
  write_drawing("0");
  EXPECT_TRUE(holds(errors_of("planDrawing(file=\"square.dxf\")"), "unit="));
  const scene::Scene scene = scene_of("planDrawing(file=\"square.dxf\", unit=\"cm\")");
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_NEAR(bounds_of(scene.objects[0]).size().x, 0.15f, 1e-3f);
}

TEST_F(PlanNodes, APictureLiesWhereItsWorldFileSays) {
  Image8 image(4, 2, 4, 255);
  ASSERT_TRUE(write_image(folder_.path() / "aerial.png", image));
  EXPECT_TRUE(holds(errors_of("planPicture(file=\"aerial.png\")"), "aerial.pgw"));
  folder_.write("aerial.PGW", "0.5\n0\n0\n-0.5\n1043000.25\n6298000.75\n");
  const scene::Scene scene = scene_of("planPicture(file=\"aerial.png\", height=0)");
  ASSERT_EQ(scene.objects.size(), 1u);
  const Bounds bounds = bounds_of(scene.objects[0]);
  const glm::dvec3 min = scene.origin + glm::dvec3(bounds.min), max = scene.origin + glm::dvec3(bounds.max);
  EXPECT_NEAR(min.x, 1043000.0, 1e-4);
  EXPECT_NEAR(max.x, 1043002.0, 1e-4);
  EXPECT_NEAR(min.y, 6298000.0, 1e-4);
  EXPECT_NEAR(max.y, 6298001.0, 1e-4);
  folder_.write("aerial.PGW", "0.5\n0\n0\n-0.5\n1043000.25\n");
  EXPECT_TRUE(holds(errors_of("planPicture(file=\"aerial.png\")"), "six numbers"));
  folder_.write("aerial.PGW", "0.5 0 0 0 1 2");
  EXPECT_TRUE(holds(errors_of("planPicture(file=\"aerial.png\")"), "no area"));
}

TEST_F(PlanNodes, RenderersAndRaysSeeTheSameLinesFromAbove) {
  TestDrawing file;
  file.layers = "0 LAYER|2 BATI|70 0|62 1";
  file.entities =
      "0 LWPOLYLINE|5 A|8 BATI|90 4|70 1|43 0.4|10 -3|20 -2|10 3|20 -2|10 3|20 2|10 -3|20 2|0 CIRCLE|5 B|8 "
      "BATI|10 0|20 "
      "0|40 1|0 TEXT|5 C|8 BATI|10 -2|20 -1|40 0.6|1 R+4";
  folder_.write("square.dxf", file.text());
  const scene::Scene scene = scene_of(
      "planDrawing(file=\"square.dxf\", line_width=0.2)\ncamera(name=\"above\", position=\"0 0 12\", "
      "target=\"0 0.01 0\")");
  ASSERT_EQ(scene.cameras.size(), 1u);
  constexpr int width = 160, height = 90;
  const Camera camera = scene.cameras[0].camera;
  const auto renderer = render::renderer_of(scene, light::sun_and_sky);
  ASSERT_TRUE(render::draw_frame(*renderer, scene, {camera, width, height}));
  const ImageF drawn = renderer->read_radiance();
  const reference::RayScene rays(scene);
  const shading::SkyLight sky = shading::make_sky_light(scene.sky.picture, 1.0f, 0.0f);
  const ImageF traced = reference::trace_picture(rays, scene, sky, camera, width, height, {}).radiance;
  const auto is_red = [](const float* pixel) { return pixel[0] > 1.5f * pixel[2]; };
  int red = 0, differ = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      red += is_red(traced.at(x, y)), differ += is_red(traced.at(x, y)) != is_red(drawn.at(x, y));
  EXPECT_GT(red, 500);
  EXPECT_LT(differ, red / 20) << "pixels at edges, which both average over samples of their own";
}

TEST(TextOutlines, HaveEveryLetterAtItsHeightAndPlace) {
  formats::DrawingText text;
  text.text = std::string(60, 'H'), text.height_m = 0.5, text.position = {100, 200, 0};
  const auto letters = text_outlines(text);
  EXPECT_EQ(letters.size(), 60u) << "far letters, too";
  double top = 0.0, left = 1e9;
  for (const auto& ring : letters.front())
    for (const glm::dvec3& corner : ring) top = std::max(top, corner.y), left = std::min(left, corner.x);
  EXPECT_NEAR(top, 200.5, 0.03) << "of capitals; fonts differ a little";
  EXPECT_NEAR(left, 100.0, 0.1);
  text.text = "A\nB", text.angle_deg = 90.0, text.anchor = {0.0, 1.0};
  for (const auto& letter : text_outlines(text))
    for (const auto& ring : letter)
      for (const glm::dvec3& corner : ring) {
        EXPECT_GT(corner.x, 99.97) << "turned: below its top is to the east";
        EXPECT_GT(corner.y, 199.9);
      }
}

}  // namespace
}  // namespace parvis::plan_drawing
