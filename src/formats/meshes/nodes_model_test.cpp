#include <gtest/gtest.h>

#include "base/test_data.h"
#include "formats/gltf/gltf_writer.h"
#include "life/traffic/demand.h"
#include "scene/script/test_registries.h"
#include "scene/script/test_script.h"

namespace parvis::scene {
namespace {

/// Two upright squares of 1 m, side by side along x, each an object of its own.
Model two_squares() {
  Model model;
  model.materials = {{.name = "plain"}};
  for (const char* object : {"body", "pane"}) {
    const float x = model.parts.empty() ? 0.0f : 1.0f;
    Part part;
    part.object = object;
    part.mesh.positions = {{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 0, 1}, {x, 0, 1}};
    part.mesh.normals.assign(4, glm::vec3(0, -1, 0));
    part.mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    part.mesh.indices = {0, 1, 2, 0, 2, 3};
    part.node = int(model.nodes.size());
    model.nodes.push_back({.name = object, .parent = 0});
    model.parts.push_back(std::move(part));
  }
  return model;
}

class ModelNodes : public ScriptTest<> {
 protected:
  ModelNodes() : ScriptTest(test_registries()) {
    EXPECT_TRUE(write_gltf(folder_.path() / "two.glb", two_squares()));
  }

  const NodeRegistry& registry_ = registries_.get<NodeRegistry>();
};

const Material& material_of(const Model& model, const std::string& object) {
  for (const Part& part : model.parts)
    if (part.object == object) return model.materials[std::size_t(part.material)];
  ADD_FAILURE() << "no object " << object;
  return model.materials.front();
}

glm::vec3 placed(const Object& object, glm::vec3 point) {
  return glm::vec3(object.world_from_model * glm::vec4(point, 1.0f));
}

/// A square of 10 m whose middle lies at `east` in the country's coordinates.
std::string tile(int east) {
  return fmt::format(
      R"({{"type":"CityJSON","version":"2.0","transform":{{"scale":[1,1,1],"translate":[{},450000,0]}},
    "CityObjects":{{"square":{{"type":"LandUse","geometry":[{{"type":"MultiSurface","lod":"1","boundaries":[[[0,1,2,3]]]}}]}}}},
    "vertices":[[0,0,0],[10,0,0],[10,10,0],[0,10,0]]}})",
      east - 5);
}

TEST_F(ModelNodes, TilesOfOneCityMeet) {
  folder_.write("west.city.json", tile(80000));
  folder_.write("east.city.json", tile(80010));
  const Scene scene = scene_of("model(file=\"west.city.json\") {}\nmodel(file=\"east.city.json\")");
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(scene.origin, glm::dvec3(80000.0, 450005.0, 0.0));
  EXPECT_EQ(glm::vec3(scene.objects[0].world_from_model[3]), glm::vec3(0.0f));
  EXPECT_EQ(glm::vec3(scene.objects[1].world_from_model[3]), glm::vec3(10.0f, 0.0f, 0.0f));
}

TEST_F(ModelNodes, AScriptTakesTheGridOffWithItsDecimals) {
  folder_.write("west.city.json", tile(80000));
  for (const char* script : {"model(file=\"west.city.json\", position=\"-79999.37 -450004.63 0\")",
                             "group(position=\"-80000 -450004 0\") { model(file=\"west.city.json\") }"}) {
    const Scene scene = scene_of(script);
    ASSERT_EQ(scene.objects.size(), 1u);
    const glm::vec2 middle(scene.objects[0].world_from_model[3]);
    EXPECT_LT(glm::distance(middle, script[0] == 'm' ? glm::vec2(0.63f, 0.37f) : glm::vec2(0.0f, 1.0f)),
              1e-4f);
  }
}

TEST_F(ModelNodes, ACityElsewhereIsPutBesideTheFirstAndReported) {
  folder_.write("west.city.json", tile(80000));
  folder_.write("far.city.json", tile(2680000));
  const auto loaded = load("model(file=\"west.city.json\")\nmodel(file=\"far.city.json\")");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  ASSERT_EQ(loaded->warnings.size(), 1u);
  EXPECT_NE(loaded->warnings[0].message.find("2600 km"), std::string::npos) << loaded->warnings[0].message;
  EXPECT_EQ(loaded->warnings[0].where.line, 2);
  EXPECT_EQ(glm::vec3(loaded->scene.objects[1].world_from_model[3]), glm::vec3(0.0f));
}

TEST_F(ModelNodes, AreObjectsInTheirPlace) {
  const Scene scene = scene_of(
      "group(position=\"10 0 0\") { model(name=a, file=two.glb, position=\"0 5 0\", heading_deg=90, scale=2) "
      "}");
  ASSERT_EQ(scene.objects.size(), 1u);
  EXPECT_EQ(scene.objects[0].name, "a");
  EXPECT_FALSE(scene.objects[0].is_dynamic);
  const glm::vec3 east_end = placed(scene.objects[0], {1, 0, 0});
  EXPECT_LT(glm::length(east_end - glm::vec3(10, 3, 0)), 1e-4f);
}

TEST_F(ModelNodes, SayUpAndOthersShareModels) {
  const Scene scene = scene_of(
      "model(file=two.glb) model(file=two.glb, position=\"3 0 0\", reflective=1, dynamic=1)\n"
      "model(file=two.glb, positions=\"0 0, 1 0, 2 0\") model(file=two.glb, up=z)\n"
      "model(file=two.glb) { material(colour=\"1 0 0\") } model(file=two.glb) { material(colour=\"1 0 0\") "
      "}");
  ASSERT_EQ(scene.objects.size(), 8u);
  EXPECT_EQ(scene.objects[0].model, scene.objects[1].model);
  EXPECT_TRUE(scene.objects[1].takes_reflection && scene.objects[1].is_dynamic);
  EXPECT_EQ(scene.objects[4].model, scene.objects[0].model);
  EXPECT_NE(scene.objects[5].model, scene.objects[0].model);
  EXPECT_EQ(scene.objects[6].model, scene.objects[7].model);
  EXPECT_NE(scene.objects[6].model, scene.objects[0].model);
}

TEST_F(ModelNodes, MaterialsGoToTheirTarget) {
  const Scene scene = scene_of(
      "model(file=two.glb) { material(target=\"body\", preset=\"paint\", roughness=0.2)\n"
      "material(target=\"pan*\", preset=\"glass\", colour=\"#FFFFFF\") }");
  const Model& model = *scene.objects.at(0).model;
  EXPECT_FLOAT_EQ(material_of(model, "body").clear_coat, 1.0f);
  EXPECT_FLOAT_EQ(material_of(model, "body").roughness, 0.2f);
  EXPECT_TRUE(material_of(model, "pane").is_mirror_like);
  EXPECT_FLOAT_EQ(material_of(model, "pane").base_colour.x, 1.0f);
}

TEST_F(ModelNodes, AMaskThatMatchesNothingSaysWhatTheModelHas) {
  const auto loaded =
      load("model(file=two.glb) { material(target=\"body\", mask=\"box 5 5 6 6\", preset=\"glass\") }");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  const std::string warnings = to_string(loaded->warnings);
  EXPECT_TRUE(holds(warnings, "this material changes nothing; what target names ")) << warnings;
}

/// Windows of cars are such glass in files that give them a thickness.
TEST_F(ModelNodes, OpenSolidGlassIsAPane) {
  const auto expect_pane = [&](const char* script) {
    const auto loaded = load(script);
    ASSERT_TRUE(loaded) << to_string(loaded.errors());
    const Material& pane = material_of(*loaded->scene.objects.at(0).model, "pane");
    EXPECT_FALSE(pane.refracts());
    EXPECT_EQ(pane.alpha_mode, Alpha::blend);
    EXPECT_TRUE(holds(to_string(loaded->warnings), "scene.xp:1:")) << to_string(loaded->warnings);
    EXPECT_TRUE(holds(to_string(loaded->warnings), "solid glass of pane is open"));
  };
  expect_pane("model(file=two.glb) { material(target=\"pane\", preset=\"solid_glass\") }");
  Model squares = two_squares();
  squares.materials.push_back({.name = "glass", .ior = 1.5f});
  squares.parts[1].material = 1;
  ASSERT_TRUE(write_gltf(folder_.path() / "window.glb", squares));
  expect_pane("model(file=window.glb)");
}

TEST_F(ModelNodes, BadTargetsMasksAndFilesAreReported) {
  EXPECT_TRUE(holds(
      errors_of("model(file=two.glb) {\n material(target=\"bdy\") }"),
      "scene.xp:2:18: no object of the model is called \"bdy\"; did you mean \"body\"? There is also "));
  EXPECT_TRUE(
      holds(errors_of("model(file=two.glb) {\n material(mask=\"box 1 2\") }"), "scene.xp:2:16: mask="));
  EXPECT_TRUE(holds(errors_of("model(file=two.glb) { material(preset=glas) }"), "did you mean \"glass\"?"));
  EXPECT_TRUE(holds(errors_of("material()"), "material does not stand by itself but in model"));
  EXPECT_TRUE(holds(errors_of("model(file=absent.glb)"), "there is no file"));
  folder_.write("broken.glb", "glTF and no more");
  EXPECT_TRUE(holds(errors_of("\nmodel(file=broken.glb)"), "scene.xp:2:12: "));
}

TEST_F(ModelNodes, AMaskThatHoldsNothingIsAWarning) {
  const auto loaded = load("model(file=two.glb) { material(mask=\"box 5 5 6 6\") }");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  ASSERT_EQ(loaded->warnings.size(), 1u);
  EXPECT_TRUE(holds(loaded->warnings[0].message, "changes nothing"));
}

TEST_F(ModelNodes, WheelsStandAtTheirAxles) {
  const Scene scene = scene_of(
      "model(file=two.glb) { wheels(front_axle_x=2, rear_axle_x=-1, axle_z=0.4, track=1.6, radius=0.4) }");
  const Model& model = *scene.objects.at(0).model;
  int wheels = 0;
  for (const ModelNode& node : model.nodes) wheels += holds(node.name, "wheel_") ? 1 : 0;
  EXPECT_EQ(wheels, 4);
  const Bounds box = bounds(model);
  EXPECT_NEAR(box.min.z, 0.0f, 1e-4f);
  EXPECT_NEAR(box.max.x, 2.4f, 1e-4f);
  EXPECT_NEAR(box.min.x, -1.4f, 1e-4f);
  EXPECT_TRUE(holds(errors_of("model(file=two.glb) { wheels(rim_radius=0.5) }"), "smaller than the tyre"));
}

TEST_F(ModelNodes, TrafficTakesItsKindsFromItsChildren) {
  folder_.write("car.xp", "model(file=two.glb, heading_deg=-90)");
  const Scene scene = scene_of("traffic(vehicles=2) { include(file=car.xp) model(file=two.glb, scale=3) }");
  EXPECT_TRUE(scene.objects.empty());
  ASSERT_EQ(scene.data<traffic::TrafficDemand>().models.size(), 2u);
  EXPECT_NEAR(bounds(*scene.data<traffic::TrafficDemand>().models[0]).max.y, 2.0f, 1e-5f);
  EXPECT_NEAR(bounds(*scene.data<traffic::TrafficDemand>().models[1]).max.x, 6.0f, 1e-5f);
}

TEST_F(ModelNodes, RealCarsGetGlassByTheColourOfTheirPalette) {
  const auto car = shared_data("gltf_kenney/vehicles/van.glb");
  if (!car) GTEST_SKIP() << "skipped: shared data absent";
  const std::vector<std::filesystem::path> data{car->parent_path().parent_path().parent_path()};
  const std::filesystem::path scripts = source_folder() / "scenes/cars";
  for (const char* script : {"kenney_sedan.xp", "kenney_suv.xp", "kenney_van.xp"}) {
    const auto loaded = load_scene(scripts / script, registry_, data);
    ASSERT_TRUE(loaded) << to_string(loaded.errors());
    EXPECT_TRUE(loaded->warnings.empty()) << to_string(loaded->warnings);
    const Object& object = loaded->scene.objects.at(0);
    std::size_t panes = 0;
    for (const Part& part : object.model->parts)
      if (object.model->materials[std::size_t(part.material)].name == "glass")
        panes += part.mesh.triangle_count();
    EXPECT_GE(panes, 8u) << script;
    const Bounds box = transformed(object.world_from_model, bounds(*object.model));
    EXPECT_GT(box.size().x, box.size().y) << script << " does not look along x";
    EXPECT_NEAR(box.min.z, 0.0f, 0.05f) << script;
  }
}

TEST_F(ModelNodes, ARealCarGetsGlassPaintAndWheels) {
  const auto car = shared_data("cars/p406/p406.obj");
  if (!car) GTEST_SKIP() << "skipped: shared data absent";
  const std::vector<std::filesystem::path> data{car->parent_path().parent_path().parent_path()};
  const auto loaded = load_scene(source_folder() / "scenes/cars/p406.xp", registry_, data);
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  EXPECT_TRUE(loaded->warnings.empty()) << to_string(loaded->warnings);
  const Model& model = *loaded->scene.objects.at(0).model;
  float glass_area = 0.0f;
  Bounds glass;
  for (const Part& part : model.parts) {
    if (model.materials[std::size_t(part.material)].name != "glass") continue;
    glass.add(part.mesh.bounds());
    for (std::size_t i = 0; i < part.mesh.indices.size(); i += 3) {
      const auto corner = [&](std::size_t c) { return part.mesh.positions[part.mesh.indices[i + c]]; };
      glass_area += 0.5f * glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
    }
  }
  // Wind- and rear screen of about 0.9 m2 each, six side panes: 3.3 m2 by the car's picture.
  EXPECT_GT(glass_area, 2.7f);
  EXPECT_LT(glass_area, 4.0f);
  EXPECT_GT(glass.min.z, 0.6f);  // no pane below the shoulder
  const Bounds box = bounds(model);
  EXPECT_NEAR(box.size().x, 4.64f, 0.05f);
  EXPECT_NEAR(box.min.z, -0.11f, 0.01f);  // what the script's position lifts to the ground
}

}  // namespace
}  // namespace parvis::scene
