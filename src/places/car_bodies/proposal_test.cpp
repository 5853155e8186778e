// Proposals as the scene language carries them out: a model is written, its script is read, and the surfaces
// of the car in the scene are looked at.
#include <gtest/gtest.h>

#include "base/files.h"
#include "base/test_data.h"
#include "formats/gltf/gltf_writer.h"
#include "formats/readers/readers.h"
#include "life/traffic/demand.h"
#include "life/traffic/vehicle_shape.h"
#include "places/car_bodies/car_copy.h"
#include "places/car_bodies/car_script.h"
#include "places/car_bodies/test_car.h"
#include "scene/script/test_registries.h"
#include "scene/script/test_script.h"

namespace parvis::car_bodies {
namespace {

using namespace test;

class CarProposal : public scene::ScriptTest<> {
 protected:
  CarProposal() : ScriptTest(scene::test_registries()) {}

  scene::Model read(const std::string& file) {
    Errors warnings;
    Result<scene::Model> model =
        registries_.get<formats::Readers>().read(folder_.path() / file, {}, warnings);
    EXPECT_TRUE(model) << (model ? "" : to_string(model.errors()));
    return model ? *std::move(model) : scene::Model();
  }

  /// The model after its file's script; as one that was written as glTF first.
  scene::Model proposed(const scene::Model& model) {
    EXPECT_TRUE(scene::write_gltf(folder_.path() / "car.glb", model));
    return proposed_of_file("car.glb");
  }

  scene::Model proposed_of_file(const std::string& file) {
    const Result<std::string> script = car_script(read(file), file);
    EXPECT_TRUE(script) << (script ? "" : to_string(script.errors()));
    script_ = script ? *script : "";
    const auto loaded = load(script_);
    EXPECT_TRUE(loaded) << (loaded ? "" : to_string(loaded.errors())) << script_;
    if (!loaded) return {};
    EXPECT_TRUE(loaded->warnings.empty()) << to_string(loaded->warnings) << script_;
    placed_ = loaded->scene.objects.at(0).world_from_model;
    return *loaded->scene.objects.at(0).model;
  }

  bool says(const std::string& piece) const { return holds(script_, piece); }

  std::string script_;
  glm::mat4 placed_{1.0f};
};

/// Area of the triangles with a material, square metres.
double area_of(const scene::Model& model, const std::string& material) {
  double area = 0.0;
  const std::vector<glm::mat4> pose = scene::rest_pose(model);
  for (const scene::Part& part : model.parts) {
    if (model.materials[std::size_t(part.material)].name != material) continue;
    Mesh mesh;
    append(mesh, part.mesh, pose[std::size_t(part.node)]);
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      const auto at = [&](std::size_t k) { return mesh.positions[mesh.indices[i + k]]; };
      area += 0.5 * double(glm::length(glm::cross(at(1) - at(0), at(2) - at(0))));
    }
  }
  return area;
}

const scene::Material& material_called(const scene::Model& model, const std::string& name) {
  for (const scene::Material& material : model.materials)
    if (material.name == name) return material;
  ADD_FAILURE() << "no material " << name;
  return model.materials.at(0);
}

constexpr double panes_m2 = 2.0 * 2.6 * 0.55;  // of the cabin's two sides

TEST_F(CarProposal, OnePictureIsDividedByMasks) {
  const scene::Model model = proposed(bare_body());
  EXPECT_NEAR(area_of(model, "glass"), panes_m2, 0.01) << script_;
  EXPECT_GT(area_of(model, "paint"), 4.0) << script_;
}

TEST_F(CarProposal, PanesOfPaleBlueAreGlass) {
  scene::Model body = bare_body();
  body.textures[0] = picture("body", {222, 60, 40, 255}, {230, 243, 255, 255});
  const scene::Model model = proposed(body);
  EXPECT_NEAR(area_of(model, "glass"), panes_m2, 0.01) << script_;
  EXPECT_GT(area_of(model, "paint"), 4.0) << script_;
}

TEST_F(CarProposal, EachOfFourPicturesHasItsMasks) {
  scene::Model body = bare_body();
  // Quarters of the length with pictures of their own; in the last two the halves of the picture are
  // exchanged.
  for (int quarter = 1; quarter < 4; ++quarter) {
    const float begin = -2.2f + 1.1f * float(quarter);
    scene::Part& part = set_apart(body, "shell", [&](glm::vec3 at) { return at.x > begin; });
    body.textures.push_back(quarter == 1 ? picture("second", blue, grey) : picture("other", grey, blue));
    body.materials.push_back({.name = "side " + std::to_string(quarter),
                              .base_colour = glm::vec3(1.0f),
                              .base_colour_texture = quarter});
    part.material = quarter;
    if (quarter == 2)
      for (glm::vec2& uv : part.mesh.uvs) uv.x = 1.0f - uv.x;
    std::swap(body.parts[0], body.parts.back());  // the next quarter is taken from this one
  }
  const scene::Model model = proposed(body);
  EXPECT_NEAR(area_of(model, "glass"), panes_m2, 0.02) << script_;
  EXPECT_NEAR(area_of(model, "glass") + area_of(model, "paint"),
              panes_m2 + area_of(proposed(bare_body()), "paint"), 0.02);
}

TEST_F(CarProposal, AMaterialCalledGlassIsGlassAsAWhole) {
  const scene::Model model =
      proposed(body_with_panes({.name = "Window Glass", .base_colour = glm::vec3(0.1f, 0.4f, 0.1f)}));
  EXPECT_NEAR(area_of(model, "glass"), panes_m2, 0.01) << script_;
  EXPECT_TRUE(says("material(target=\"Window Glass\", preset=\"glass\")")) << script_;
  EXPECT_FALSE(says("mask=")) << script_;
}

TEST_F(CarProposal, AMaterialThatLetsLightThroughBecomesOpaqueGlass) {
  const scene::Model model = proposed(body_with_panes({.name = "Material.003",
                                                       .base_colour = glm::vec3(0.2f, 0.9f, 0.3f),
                                                       .alpha = 0.3f,
                                                       .alpha_mode = scene::Alpha::blend}));
  EXPECT_NEAR(area_of(model, "glass"), panes_m2, 0.01) << script_;
  EXPECT_EQ(material_called(model, "glass").alpha, 1.0f);
  EXPECT_TRUE(says("clear_glass")) << script_;
}

TEST_F(CarProposal, ADarkMaterialInThePlaceOfPanesIsGlass) {
  const scene::Model model =
      proposed(body_with_panes({.name = "Material.003", .base_colour = glm::vec3(0.01f)}));
  EXPECT_NEAR(area_of(model, "glass"), panes_m2, 0.01) << script_;
}

TEST_F(CarProposal, APaneThatIsAnObjectNeedsNoMask) {
  scene::Model body = bare_body();  // one material and one picture for both objects
  set_apart(body, "WISIDE", is_above_shoulder);
  const scene::Model model = proposed(body);
  EXPECT_TRUE(says("material(target=\"WISIDE\", preset=\"glass\")")) << script_;
  EXPECT_FALSE(says("mask=")) << script_;
  EXPECT_NEAR(area_of(model, "glass"), panes_m2, 0.01) << script_;
}

/// Adds quads across the front and the rear, between heights in metres, to a part, in steps of 0.05 m. They
/// have the grey of the panes in the picture, at a place of their own.
void add_bumpers(scene::Part& part, float low_m, float high_m) {
  constexpr float step_m = 0.05f, half_m = 0.6f;
  const int steps = int(std::lround((high_m - low_m) / step_m));
  for (int i = 0; i < steps; ++i)
    for (const float x : {-2.2f, 2.2f}) {
      const float z = low_m + float(i) * step_m;
      add_quad(part, {{x, -half_m, z}, {x, half_m, z}, {x, half_m, z + step_m}, {x, -half_m, z + step_m}},
               {0.88f, 0.85f}, {0.95f, 0.92f});
    }
}

TEST_F(CarProposal, BumpersInTheGreyOfPanesAreNone) {
  for (const float low_m : {0.45f, 0.8f}) {  // mostly below half of the height, or all of it above
    scene::Model body = bare_body();
    add_bumpers(body.parts[0], low_m, 0.9f);
    EXPECT_NEAR(area_of(proposed(body), "glass"), panes_m2, 0.01) << low_m << script_;
  }
}

TEST_F(CarProposal, ABumperThatIsAnObjectIsNoPane) {
  scene::Model body = bare_body();
  scene::Part bumper;
  bumper.object = "STOSS";
  add_bumpers(bumper, 0.8f, 0.9f);
  body.parts.push_back(bumper);
  EXPECT_NEAR(area_of(proposed(body), "glass"), panes_m2, 0.01) << script_;
}

TEST_F(CarProposal, AGreyThatLiesMostlyBelowIsNoPaneAtTheRoof) {
  scene::Model body = bare_body();
  add_bumpers(body.parts[0], 0.3f, 0.6f);
  // A frame above the rear pane, of the bumpers' plastic.
  add_quad(body.parts[0],
           {{-1.9f, -0.6f, 1.3f}, {-1.9f, 0.6f, 1.3f}, {-1.9f, 0.6f, 1.4f}, {-1.9f, -0.6f, 1.4f}},
           {0.88f, 0.85f}, {0.95f, 0.92f});
  EXPECT_NEAR(area_of(proposed(body), "glass"), panes_m2, 0.01) << script_;
}

TEST_F(CarProposal, TheRearOfARedCarIsNoLamp) {
  scene::Model body = bare_body();
  body.textures[0] = picture("body", {200, 20, 20, 255}, grey);
  EXPECT_EQ(area_of(proposed(body), "lamp"), 0.0);
  EXPECT_FALSE(says("preset=\"lamp\"")) << script_;
  body.textures[0] = picture("body", blue, grey);
  scene::Part lamps;
  lamps.object = "rear", lamps.material = 1;
  body.materials.push_back({.name = "red", .base_colour = glm::vec3(0.8f, 0.01f, 0.01f)});
  add_quad(lamps, {{-2.2f, -0.5f, 0.6f}, {-2.2f, 0.5f, 0.6f}, {-2.2f, 0.5f, 0.7f}, {-2.2f, -0.5f, 0.7f}});
  body.parts.push_back(lamps);
  EXPECT_NEAR(area_of(proposed(body), "lamp"), 0.1, 0.001) << script_;
}

TEST_F(CarProposal, AColourThatStripesHaveTooIsNoLamp) {
  scene::Model body = bare_body();
  for (int y = 0; y < 8; ++y) {
    std::uint8_t* red = body.textures[0].image.at(7, y);
    red[0] = 200, red[1] = red[2] = 20;
  }
  scene::Part& shell = body.parts[0];
  const glm::vec2 low(0.9f, 0.1f), high(0.97f, 0.9f);
  add_quad(shell, {{-2.2f, -0.5f, 0.6f}, {-2.2f, 0.5f, 0.6f}, {-2.2f, 0.5f, 0.7f}, {-2.2f, -0.5f, 0.7f}}, low,
           high);
  EXPECT_NEAR(area_of(proposed(body), "lamp"), 0.1, 0.001) << script_;
  for (const float y : {-half_width - 0.01f, half_width + 0.01f})
    add_quad(shell, {{-0.8f, y, 0.5f}, {0.8f, y, 0.5f}, {0.8f, y, 0.7f}, {-0.8f, y, 0.7f}}, low, high);
  EXPECT_EQ(area_of(proposed(body), "lamp"), 0.0) << script_;
}

TEST_F(CarProposal, ASpareWheelIsNotPainted) {
  scene::Model car = car_with_wheels();
  scene::Part spare;
  spare.object = "spare_wheel";
  add_disc(spare, {-2.2f, 0.0f, 0.9f}, wheel_radius, wheel_width);
  car.parts.push_back(spare);
  const scene::Model model = proposed(car);
  EXPECT_FALSE(says("target=\"spare_wheel\"")) << script_;
  EXPECT_TRUE(says("material(target=\"shell\", preset=\"paint\")")) << script_;
}

TEST_F(CarProposal, PanesCutOutOfThePictureAreFilled) {
  scene::Model body = bare_body();
  body.textures[0] = picture("body", blue, {255, 0, 255, 0});
  body.materials[0].alpha_mode = scene::Alpha::cutout;
  const scene::Model model = proposed(body);
  EXPECT_NEAR(area_of(model, "glass"), panes_m2, 0.01) << script_;
  const scene::Material& glass = material_called(model, "glass");
  const Image8& image = model.textures.at(std::size_t(glass.base_colour_texture)).image;
  EXPECT_EQ(image.at(5, 4)[3], 255);  // a texel of the panes
  EXPECT_LT(image.at(5, 4)[0], 60);
}

TEST_F(CarProposal, WhitePaintBetweenPanesStaysPaint) {
  scene::Model body = bare_body();
  body.textures[0] = picture("body", {245, 245, 245, 255}, {60, 62, 64, 255});
  // A white pillar in the middle of the panes, in their region of the picture.
  for (int y = 0; y < 8; ++y) std::fill_n(body.textures[0].image.at(5, y), 3, std::uint8_t(245));
  Mesh& mesh = body.parts[0].mesh;
  constexpr float pillar_begin = -0.72f, pillar_end = -0.48f;
  for (std::size_t i = 0; i < mesh.positions.size(); i += 4) {
    const bool is_pillar = mesh.positions[i].x > pillar_begin && mesh.positions[i + 1].x < pillar_end;
    if (mesh.uvs[i].x < 0.5f) continue;
    for (std::size_t k = 0; k < 4; ++k)
      mesh.uvs[i + k].x = is_pillar ? 0.7f : mesh.uvs[i + k].x < 0.6f ? 0.55f : 0.6f;
    if (mesh.positions[i].x > pillar_end)
      for (std::size_t k = 0; k < 4; ++k) mesh.uvs[i + k].x += 0.25f;
  }
  const scene::Model model = proposed(body);
  EXPECT_LT(area_of(model, "glass"), panes_m2 - 0.2) << script_;
  EXPECT_GT(area_of(model, "glass"), panes_m2 - 0.5) << script_;
}

TEST_F(CarProposal, GlassNearTheRoadAtTheEndsIsALamp) {
  scene::Model body = body_with_panes({.name = "Glass", .base_colour = glm::vec3(0.1f)});
  body.materials.push_back({.name = "Glass.001",
                            .base_colour = glm::vec3(1.0f),
                            .alpha = 0.4f,
                            .alpha_mode = scene::Alpha::blend});
  scene::Part lamps;
  lamps.object = "lamps", lamps.material = 2;
  for (const float y : {-0.6f, 0.6f})
    add_quad(
        lamps,
        {{2.2f, y - 0.1f, 0.5f}, {2.2f, y + 0.1f, 0.5f}, {2.2f, y + 0.1f, 0.6f}, {2.2f, y - 0.1f, 0.6f}});
  body.parts.push_back(lamps);
  const scene::Model model = proposed(body);
  EXPECT_NEAR(area_of(model, "lamp"), 0.04, 0.001) << script_;
  EXPECT_NEAR(area_of(model, "glass"), panes_m2, 0.01) << script_;
}

TEST_F(CarProposal, NamesThatOthersHaveAreNoTargets) {
  // The material of the panes has the name of the body's object, and a name that a script has to quote.
  scene::Model body = body_with_panes({.name = "shell", .base_colour = glm::vec3(0.02f)});
  body.parts[1].object = "the \"big\" pane";
  body.nodes.push_back({.name = "panes", .parent = 0});
  const scene::Model model = proposed(body);
  EXPECT_NEAR(area_of(model, "glass"), panes_m2, 0.01) << script_;
  EXPECT_GT(area_of(model, "paint"), 4.0) << script_;
  EXPECT_TRUE(says("target=\"the \\\"big\\\" pane\"")) << script_;
}

TEST_F(CarProposal, WhatIsNeitherPaintNorGlassStays) {
  scene::Model body = bare_body();
  body.materials.push_back({.name = "seats", .base_colour = glm::vec3(0.4f, 0.2f, 0.1f)});
  scene::Part seats;
  seats.object = "seats", seats.material = 1;
  add_quad(seats, {{-1, -0.5f, 0.5f}, {0, -0.5f, 0.5f}, {0, 0.5f, 0.5f}, {-1, 0.5f, 0.5f}});
  body.parts.push_back(seats);
  const scene::Model model = proposed(body);
  EXPECT_NEAR(area_of(model, "seats"), 1.0, 0.01) << script_;
  EXPECT_TRUE(says("As the file has them: \"seats\"")) << script_;
}

/// The text of an OBJ with y up: a part is an object.
std::string obj_of(const scene::Model& model) {
  std::string text = "mtllib car.mtl\n";
  std::size_t first = 1;
  for (const scene::Part& part : model.parts) {
    text += fmt::format("o {}\n", part.object);
    for (const glm::vec3& at : part.mesh.positions) text += fmt::format("v {} {} {}\n", at.x, at.z, -at.y);
    text += fmt::format("usemtl {}\n", model.materials[std::size_t(part.material)].name);
    for (std::size_t i = 0; i < part.mesh.indices.size(); i += 3)
      text += fmt::format("f {} {} {}\n", first + part.mesh.indices[i], first + part.mesh.indices[i + 1],
                          first + part.mesh.indices[i + 2]);
    first += part.mesh.positions.size();
  }
  return text;
}

TEST_F(CarProposal, AnObjAlongZInCentimetresGetsACopyWithWheels) {
  scene::Model body = body_with_panes({.name = "Pane"});
  body = moved(body, scaled(100.0f) * turned_about({0, 0, 1}, 90.0f));
  folder_.write("car.obj", obj_of(body));
  folder_.write("car.mtl", "newmtl body\nKd 0.1 0.1 0.8\nnewmtl Pane\nKd 0.5 0.6 0.5\nd 0.3\n");
  const auto copy = car_copy(read("car.obj"), "car.obj");
  ASSERT_TRUE(copy && *copy) << (copy ? "" : to_string(copy.errors()));
  EXPECT_NE((*copy)->remark.find("centimetres"), std::string::npos) << (*copy)->remark;
  const scene::Model model = proposed((*copy)->model);
  EXPECT_TRUE(says("  wheels(front_axle_x=1.30, rear_axle_x=-1.30")) << script_;
  EXPECT_NEAR(area_of(model, "glass"), panes_m2, 0.01) << script_;
  const Bounds box = transformed(placed_, scene::bounds(model));
  EXPECT_NEAR(box.size().x, 4.4f, 0.02f);
  EXPECT_NEAR(box.min.z, 0.0f, 0.02f);
}

TEST_F(CarProposal, AnObjWithZUpIsReadSo) {
  // bare_body's z is written as the file's z, which an OBJ's reader takes for the depth.
  scene::Model body = moved(bare_body(), turned_about({1, 0, 0}, 90.0f));
  folder_.write("car.obj", obj_of(body));
  folder_.write("car.mtl", "newmtl body\nKd 0.1 0.1 0.8\n");
  const scene::Model model = proposed_of_file("car.obj");
  EXPECT_TRUE(says("up=\"z\"")) << script_;
  EXPECT_TRUE(says("  wheels(front_axle_x=1.30")) << script_;
  EXPECT_NEAR(transformed(placed_, scene::bounds(model)).min.z, 0.0f, 0.02f);
}

TEST_F(CarProposal, WheelsOfAnyNameTurnInTheCopy) {
  const auto copy = car_copy(car_with_wheels(), "car.obj");
  ASSERT_TRUE(copy && *copy) << (copy ? "" : to_string(copy.errors()));
  const auto model = std::make_shared<const scene::Model>(proposed((*copy)->model));
  EXPECT_FALSE(says("With -o")) << script_;
  const traffic::VehicleShape shape = traffic::vehicle_shape(model);
  ASSERT_EQ(shape.wheels.size(), 4u) << script_;
  for (const traffic::Wheel& wheel : shape.wheels) {
    EXPECT_NEAR(std::abs(wheel.centre_in_model.x), axle_x, 0.01f);
    EXPECT_EQ(wheel.is_front, wheel.centre_in_model.x > 0.0f);
    EXPECT_NEAR(wheel.radius_m, wheel_radius, 0.01f);
  }
  EXPECT_NEAR(shape.front_axle_m, axle_x, 0.01f);
  EXPECT_FALSE(car_copy(*model, "car.glb")->has_value());  // a copy needs none
  EXPECT_FALSE(car_copy(*model, "cars/car.glb")->has_value());
  EXPECT_TRUE(car_copy(*model, "../car.glb")->has_value()) << "scripts do not read there";
}

TEST_F(CarProposal, ATurnedGltfWithWheelNodesNeedsNoCopy) {
  scene::Model car = moved(car_with_wheels(), turned_about({0, 0, 1}, -90.0f));
  for (std::size_t i = 1; i < car.parts.size(); ++i) {
    car.parts[i].node = int(car.nodes.size());
    car.nodes.push_back({.name = "wheel " + std::to_string(i), .parent = 0});
  }
  EXPECT_FALSE(car_copy(car, "car.glb")->has_value());
  proposed(car);
  EXPECT_TRUE(says("heading_deg=-90")) << script_;
}

TEST_F(CarProposal, OfTheBodyAmongTheScenesIsTheOneBesideIt) {
  const std::filesystem::path folder = source_folder() / "scenes";
  Errors warnings;
  const Result<scene::Model> body =
      registries_.get<formats::Readers>().read(folder / "bare_saloon.glb", {}, warnings);
  ASSERT_TRUE(body) << to_string(body.errors());
  EXPECT_TRUE(warnings.empty()) << to_string(warnings);
  const Result<std::string> script = car_script(*body, "bare_saloon.glb"),
                            beside = read_file(folder / "bare_saloon.xp");
  ASSERT_TRUE(script && beside);
  EXPECT_EQ(*script, *beside) << "parvis car scenes/bare_saloon.glb -o scenes/bare_saloon.xp";
  EXPECT_NE(script->find("preset=\"glass\""), std::string::npos);
  EXPECT_NE(script->find("  wheels(front_axle_x=1."), std::string::npos);
}

}  // namespace
}  // namespace parvis::car_bodies
