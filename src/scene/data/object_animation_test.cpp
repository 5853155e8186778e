#include "scene/data/object_animation.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "base/test_data.h"
#include "formats/gltf/gltf_reader.h"
#include "formats/meshes/material_change.h"
#include "formats/meshes/material_mask.h"
#include "formats/meshes/model_assembly.h"
#include "scene/data/test_scene.h"

namespace parvis::scene {
namespace {

constexpr float quarter_turn = 1.57079633f;

/// A strip from (0,0,0) to (2,0,0); its far half hangs on a joint at (1,0,0) that turns a quarter turn about
/// z in two seconds.
Model elbow() {
  Model model;
  model.materials.push_back(matt(glm::vec3(0.5f)));
  model.nodes.push_back({"elbow", 0, {1, 0, 0}});
  auto arm = std::make_shared<Deformation>();
  const Mesh strip = quad({0, 0, 0}, {2, 0, 0}, {2, 0, 1}, {0, 0, 1});
  arm->positions = strip.positions;
  arm->normals = strip.normals;
  arm->skin.joints = {0, 1};
  arm->skin.joint_from_mesh = {glm::mat4(1.0f), glm::translate(glm::mat4(1.0f), {-1, 0, 0})};
  arm->skin.joints_of_vertex.assign(4, glm::uvec4(0, 1, 0, 0));
  arm->skin.weights = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}};
  Part part{"arm", strip, 0, 0, true};
  part.deformation = arm;
  model.parts.push_back(part);
  Animation deforming{"deform", {}, {}, 2.0f};
  const glm::quat turned = glm::angleAxis(quarter_turn, glm::vec3(0, 0, 1));
  deforming.channels.push_back({1,
                                AnimationChannel::Property::rotation,
                                Interpolation::linear,
                                {0, 2},
                                {{0, 0, 0, 1}, {turned.x, turned.y, turned.z, turned.w}}});
  model.animations.push_back(deforming);
  return model;
}

/// A level square whose only target lifts it by 1; its weight goes from 0 to 1 in one second.
Model lift(Interpolation interpolation) {
  Model model;
  model.materials.push_back(matt(glm::vec3(0.5f)));
  auto lifting = std::make_shared<Deformation>();
  const Mesh square = ground(1);
  lifting->positions = square.positions;
  lifting->normals = square.normals;
  lifting->targets.push_back({std::vector<glm::vec3>(4, {0, 0, 1}), {}});
  lifting->weights = {0.25f};
  lifting->weights_node = 0;
  Part part{"square", square, 0, 0, true};
  part.deformation = lifting;
  model.parts.push_back(part);
  WeightChannel weights{0, interpolation, {0, 1}, {{0}, {1}}};
  if (interpolation == Interpolation::cubic) weights.values = {{0}, {0}, {0}, {0}, {1}, {0}};
  model.animations.push_back({"lift", {}, {weights}, 1.0f});
  return model;
}

Scene playing(Model model, PlayedAnimation played = {.animation = 0}) {
  Scene scene;
  add(scene, std::make_shared<const Model>(std::move(model)));
  play(scene.objects[0], played);
  return scene;
}

glm::vec3 corner(const Scene& scene, std::size_t vertex) {
  return scene.objects[0].mesh(0).positions[vertex];
}

TEST(ObjectAnimation, ASkinnedCornerGoesRoundItsJoint) {
  Scene scene = playing(elbow());
  EXPECT_TRUE(scene.objects[0].is_dynamic);
  for (const float time_s : {0.0f, 0.5f, 1.0f, 1.75f}) {
    animate(scene, double(time_s));
    const float angle = quarter_turn * time_s / 2.0f;
    EXPECT_LT(glm::distance(corner(scene, 1), {1.0f + std::cos(angle), std::sin(angle), 0.0f}), 1e-5f);
    EXPECT_LT(glm::distance(corner(scene, 0), glm::vec3(0.0f)), 1e-6f);
    const glm::vec3 normal = scene.objects[0].mesh(0).normals[1];
    EXPECT_LT(glm::distance(normal, {std::sin(angle), -std::cos(angle), 0.0f}), 1e-5f);
  }
}

TEST(ObjectAnimation, AnimationsRepeatBeginAndHastenAsAsked) {
  Scene plain = playing(elbow()), started = playing(elbow(), {0, 1.0f, 0.5}),
        fast = playing(elbow(), {0, 2.0f}), backward = playing(elbow(), {0, -1.0f});
  animate(plain, 0.7 + 2.0 * 1000.0);
  const glm::vec3 late = corner(plain, 1);
  animate(plain, 0.7);
  EXPECT_LT(glm::distance(late, corner(plain, 1)), 1e-4f);
  animate(started, 0.2);
  EXPECT_LT(glm::distance(corner(started, 1), corner(plain, 1)), 1e-5f);
  animate(fast, 0.35);
  EXPECT_LT(glm::distance(corner(fast, 1), corner(plain, 1)), 1e-5f);
  animate(backward, 1.3);
  EXPECT_LT(glm::distance(corner(backward, 1), corner(plain, 1)), 1e-5f);
}

TEST(ObjectAnimation, TargetsAreAddedByTheirWeights) {
  for (const auto& [interpolation, expected] :
       {std::pair(Interpolation::linear, 0.25f), std::pair(Interpolation::step, 0.0f),
        std::pair(Interpolation::cubic, 0.15625f)}) {  // 3 t^2 - 2 t^3
    Scene scene = playing(lift(interpolation));
    animate(scene, 0.25);
    EXPECT_NEAR(corner(scene, 2).z, expected, 1e-6f);
    EXPECT_EQ(scene.objects[0].mesh(0).normals[2], glm::vec3(0, 0, 1));
  }
}

TEST(ObjectAnimation, WhatPlaysNothingStands) {
  Scene scene;
  add(scene, std::make_shared<const Model>(elbow()));
  animate(scene, 1.0);
  EXPECT_TRUE(scene.objects[0].pose.empty());
  EXPECT_EQ(corner(scene, 1), glm::vec3(2, 0, 0));
}

TEST(ObjectAnimation, AModelThatIsPutIntoAnotherBendsThere) {
  Scene scene = playing(placed(elbow(), {5, 0, 0}, glm::angleAxis(quarter_turn, glm::vec3(0, 0, 1)), 2.0f));
  animate(scene, 1.0);
  const Object& object = scene.objects[0];
  const glm::vec3 in_model =
      object.pose[std::size_t(object.model->parts[0].node)] * glm::vec4(corner(scene, 1), 1.0f);
  const float reach = std::sqrt(0.5f);  // the elbow stands at (5, 2); its forearm points at 90 + 45 degrees
  EXPECT_LT(glm::distance(in_model, {5.0f - 2.0f * reach, 2.0f + 2.0f * reach, 0.0f}), 1e-5f);
}

TEST(ObjectAnimation, HalvesOfDifferentMaterialBendAlike) {
  Model model = elbow();
  const std::size_t parts[]{0};
  const Result<MaterialMask> mask = parse_mask("box 0.5 0 1 1", {});
  ASSERT_TRUE(mask) << to_string(mask.errors());
  MaterialChange change;
  change.roughness = 0.1f;
  change_material(model, parts, std::span(&*mask, 1), change, "smooth");
  Scene scene = playing(model);
  animate(scene, 1.0);
  ASSERT_EQ(model.parts.size(), 2u);
  for (std::size_t p = 0; p < model.parts.size(); ++p)
    EXPECT_EQ(scene.objects[0].mesh(p).positions.size(), 4u) << "their deformation counts all four";
}

/// Bounds of all parts in the world, as they are deformed now.
Bounds bounds_now(const Scene& scene) {
  const Object& object = scene.objects[0];
  Bounds all;
  for (std::size_t p = 0; p < object.model->parts.size(); ++p)
    all.add(transformed(object.pose[std::size_t(object.model->parts[p].node)], object.mesh(p).bounds()));
  return all;
}

TEST(ObjectAnimation, FiguresWalkAndStayFigures) {
  for (const char* name : {"CesiumMan/CesiumMan.gltf", "RiggedFigure/RiggedFigure.gltf", "Fox/Fox.gltf"}) {
    const auto file = shared_data(std::string("gltf_animated/") + name);
    if (!file) GTEST_SKIP() << "skipped: shared data absent";
    Errors warnings;
    Result<Model> model = read_gltf(*file, warnings);
    ASSERT_TRUE(model) << to_string(model.errors());
    const Bounds rest = bounds(*model);
    const float height_m = rest.size().z;
    Scene scene = playing(*std::move(model));
    const Animation& animation = scene.objects[0].model->animations[0];
    float max_m = 0.0f;
    std::vector<glm::vec3> before;
    for (int step = 0; step <= 20; ++step) {
      animate(scene, double(animation.duration_s) * step / 20.0);
      const std::vector<glm::vec3>& now = scene.objects[0].mesh(0).positions;
      for (std::size_t v = 0; v < before.size(); ++v)
        max_m = std::max(max_m, glm::distance(before[v], now[v]));
      before = now;
      EXPECT_NEAR(bounds_now(scene).size().z, height_m, 0.35f * height_m) << name;
      EXPECT_TRUE(check(scene.objects[0].mesh(0), name));
    }
    EXPECT_GT(max_m, 0.01f * height_m) << name;
    EXPECT_LT(max_m, 0.5f * height_m) << name;
  }
}

}  // namespace
}  // namespace parvis::scene
