// What is written reads the same: shapes, how they deform and move, and where objects stand.
#include "formats/gltf/gltf_writer.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>

#include "base/files.h"
#include "base/test_data.h"
#include "base/test_folder.h"
#include "formats/gltf/gltf_own_data.h"
#include "formats/gltf/gltf_reader.h"
#include "formats/gltf/test_validator.h"
#include "scene/data/object_animation.h"
#include "scene/data/test_scene.h"

namespace parvis::scene {
namespace {
namespace fs = std::filesystem;

Model read_back(const fs::path& file) {
  Errors warnings;
  Result<Model> model = read_gltf(file, warnings);
  EXPECT_TRUE(model) << to_string(model.errors());
  EXPECT_TRUE(warnings.empty()) << to_string(warnings);
  return model ? *std::move(model) : Model{};
}

/// A flag of two triangles: a joint turns its free edge, a morph target lifts it.
Model flag() {
  Model model = *model_of(quad({0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}), matt(glm::vec3(0.5f)));
  model.nodes.push_back({.name = "cloth", .parent = 0, .translation = {0, 0, 2}});
  model.nodes.push_back({.name = "pole", .parent = 0});
  model.nodes.push_back({.name = "edge", .parent = 2, .translation = {1, 0, 0}});
  Part& part = model.parts.front();
  Deformation deformation{part.mesh.positions, part.mesh.normals, {}, {0.25f}, 1, {}};
  deformation.targets.push_back({{{0, 0, 0}, {0, 0, 1}, {0, 0, 1}, {0, 0, 0}}, {}});
  deformation.skin.joints = {2, 3};
  deformation.skin.joint_from_mesh = {glm::mat4(1.0f), glm::translate(glm::mat4(1.0f), glm::vec3(-1, 0, 0))};
  deformation.skin.joints_of_vertex.assign(4, {0, 1, 1, 0});  // a joint twice, which glTF does not have
  deformation.skin.weights = {{1, 0, 0, 0}, {0, 0.5f, 0.5f, 0}, {0.25f, 0.5f, 0.25f, 0}, {1, 0, 0, 0}};
  part.deformation = std::make_shared<const Deformation>(deformation);
  deform(*part.deformation, deformation.weights, rest_pose(model), part.node, part.mesh);
  AnimationChannel turn{3, AnimationChannel::Property::rotation, Interpolation::linear, {0, 1, 1, 2}, {}};
  turn.values = {{0, 0, 0, 1}, {0, 0, 1, 0}, {0, 0, 0, 1}, {1, 0, 0, 0}};  // a jump after a second
  model.animations.push_back({"wave", {turn}, {{1, Interpolation::step, {0, 1}, {{0.0f}, {1.0f}}}}, 2.0f});
  return model;
}

/// All vertices in the frame of the object's model, as it is deformed `time_s` into an animation.
std::vector<glm::vec3> vertices_at(std::shared_ptr<const Model> model, int animation, double time_s) {
  Scene scene;
  Object& object = scene.objects.emplace_back();
  object.model = std::move(model);
  if (animation != no_index) play(object, {.animation = animation});
  animate(scene, time_s);
  const std::vector<glm::mat4> pose = object.pose.empty() ? rest_pose(*object.model) : object.pose;
  std::vector<glm::vec3> vertices;
  for (std::size_t p = 0; p < object.model->parts.size(); ++p)
    for (const glm::vec3& v : object.mesh(p).positions)
      vertices.emplace_back(pose[std::size_t(object.model->parts[p].node)] * glm::vec4(v, 1.0f));
  return vertices;
}

void expect_same_shape(const Model& written, const Model& read_back) {
  const auto was = std::make_shared<const Model>(written), is = std::make_shared<const Model>(read_back);
  ASSERT_EQ(is->animations.size(), was->animations.size());
  const float tolerance = 1e-5f * glm::length(bounds(written).size()) + 1e-5f;  // floats, turned and back
  for (int animation = no_index; animation < int(was->animations.size()); ++animation)
    for (const double time_s : {0.0, 0.4, 0.9, 1.3}) {
      const auto before = vertices_at(was, animation, time_s), after = vertices_at(is, animation, time_s);
      ASSERT_EQ(after.size(), before.size());
      float worst = 0.0f;
      for (std::size_t v = 0; v < before.size(); ++v)
        worst = std::max(worst, glm::distance(before[v], after[v]));
      EXPECT_LT(worst, tolerance) << "animation " << animation << " after " << time_s << " s";
    }
}

TEST(GltfWriter, SkinsMorphTargetsAndAnimationsReadTheSame) {
  const TestFolder folder;
  const Model model = flag();
  ASSERT_TRUE(write_gltf(folder.path() / "flag.glb", model));
  const Model again = read_back(folder.path() / "flag.glb");
  expect_same_shape(model, again);
  ASSERT_TRUE(again.parts.front().deformation);
  EXPECT_EQ(again.parts.front().deformation->weights, std::vector<float>{0.25f});
  EXPECT_EQ(again.animations.front().weights.size(), 1u);
  expect_valid_gltf(folder.path());
}

TEST(GltfWriter, FiguresThatMoveReadTheSame) {
  const TestFolder folder;
  for (const char* name : {"CesiumMan/CesiumMan", "RiggedFigure/RiggedFigure", "Fox/Fox"}) {
    const auto file = shared_data(std::string("gltf_animated/") + name + ".gltf");
    if (!file) GTEST_SKIP() << "skipped: shared data absent";
    const Model model = read_back(*file);
    const fs::path written = folder.path() / (model.name + ".glb");
    ASSERT_TRUE(write_gltf(written, model));
    expect_same_shape(model, read_back(written));
  }
  expect_valid_gltf(folder.path());
}

/// Two flags of one model, one of which plays, a moved box and a camera.
Scene small_square() {
  Scene scene;
  const auto model = std::make_shared<const Model>(flag());
  const int playing = add(scene, model), still = add(scene, model);
  scene.objects[std::size_t(playing)].name = "flag west";
  scene.objects[std::size_t(playing)].played.animation = 0;
  scene.objects[std::size_t(still)].name = "flag east";
  scene.objects[std::size_t(still)].world_from_model =
      glm::translate(glm::mat4(1.0f), glm::vec3(10, 0, 0)) * glm::scale(glm::mat4(1.0f), glm::vec3(2.0f));
  const int moved = add(scene, model_of(box(glm::vec3(0.0f), glm::vec3(1.0f)), matt(glm::vec3(0.7f))));
  scene.objects[std::size_t(moved)].name = "box";
  scene.objects[std::size_t(moved)].pose = {glm::translate(glm::mat4(1.0f), glm::vec3(0, 5, 0))};
  scene.cameras.push_back({"street", Camera{look_at({0, -9, 2}, {0, 0, 1})}, "", glm::vec3(0.0f)});
  return scene;
}

std::vector<const Object*> all_of(const Scene& scene) {
  std::vector<const Object*> objects;
  for (const Object& object : scene.objects) objects.push_back(&object);
  return objects;
}

TEST(GltfWriter, ObjectsStandWhereTheSceneHasThem) {
  const TestFolder folder;
  const Scene scene = small_square();
  ASSERT_TRUE(write_gltf(folder.path() / "square.glb", all_of(scene), scene.cameras));
  const Model again = read_back(folder.path() / "square.glb");
  Bounds expected;
  for (const Object& object : scene.objects) {
    const std::vector<glm::mat4> pose = object.pose.empty() ? rest_pose(*object.model) : object.pose;
    for (const Part& part : object.model->parts)
      for (const glm::vec3& v : part.mesh.positions)
        expected.add(object.world_from_model * pose[std::size_t(part.node)] * glm::vec4(v, 1.0f));
  }
  EXPECT_LT(glm::distance(bounds(again).min, expected.min), 1e-4f);
  EXPECT_LT(glm::distance(bounds(again).max, expected.max), 1e-4f);
  EXPECT_EQ(again.parts.size(), 3u);
  ASSERT_EQ(again.animations.size(), 2u);  // of each flag
  EXPECT_EQ(again.animations.front().name, "flag west: wave");
  expect_valid_gltf(folder.path());
}

TEST(GltfWriter, AnObjectThatTheSceneShearsStandsSo) {
  const TestFolder folder;
  Scene scene = small_square();
  Object& object = scene.objects.front();
  scene.objects.resize(1);
  object.world_from_model[2] = {0.5f, 0.0f, 1.0f, 0.0f};  // what is up leans east
  ASSERT_TRUE(write_gltf(folder.path() / "leaning.glb", all_of(scene), {}));
  const Model again = read_back(folder.path() / "leaning.glb");
  Bounds expected;
  const std::vector<glm::mat4> pose = object.pose.empty() ? rest_pose(*object.model) : object.pose;
  for (const Part& part : object.model->parts)
    for (const glm::vec3& v : part.mesh.positions)
      expected.add(object.world_from_model * pose[std::size_t(part.node)] * glm::vec4(v, 1.0f));
  EXPECT_LT(glm::distance(bounds(again).min, expected.min), 1e-4f);
  EXPECT_LT(glm::distance(bounds(again).max, expected.max), 1e-4f);
  expect_valid_gltf(folder.path());
}

TEST(GltfWriter, WhatIsABackdropAndWhatCastsNoShadowReadTheSame) {
  Model model = *model_of(ground(5), matt(glm::vec3(0.5f)));
  model.parts.push_back({.object = "marking", .mesh = ground(1), .casts_shadow = false});
  model.parts.push_back(
      {.object = "far away", .mesh = ground(90), .casts_shadow = false, .is_backdrop = true});
  const TestFolder folder;
  const fs::path file = folder.path() / "place.glb";
  ASSERT_TRUE(write_gltf(file, model));
  const Model found = read_back(file);
  ASSERT_EQ(found.parts.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(found.parts[i].casts_shadow, model.parts[i].casts_shadow) << found.parts[i].object;
    EXPECT_EQ(found.parts[i].is_backdrop, model.parts[i].is_backdrop) << found.parts[i].object;
  }
  // Other programs write what they like: a backdrop is what says so.
  std::string bytes = *read_file(file);
  const std::string mark = "\"backdrop\":true";
  ASSERT_NE(bytes.find(mark), std::string::npos);
  bytes.replace(bytes.find(mark), mark.size(), "\"backdrop\":\"ab\"");
  ASSERT_TRUE(write_file(file, bytes));
  EXPECT_FALSE(read_back(file).parts[2].is_backdrop);
}

TEST(GltfWriter, PaintedObjectsShareTheDataOfTheirMeshes) {
  const TestFolder folder;
  const auto model = model_of(sphere(glm::vec3(0.0f), 1.0f, 64), matt(glm::vec3(0.5f)));
  Object plain, red;
  plain.name = "plain", plain.model = red.model = model, red.name = "red";
  red.paint = std::make_shared<const std::vector<Material>>(1, matt({0.75f, 0.25f, 0.25f}));
  ASSERT_TRUE(write_gltf(folder.path() / "one.glb", std::vector<const Object*>{&plain}, {}));
  ASSERT_TRUE(write_gltf(folder.path() / "two.glb", std::vector<const Object*>{&plain, &red, &red}, {}));
  const Model again = read_back(folder.path() / "two.glb");
  ASSERT_EQ(again.parts.size(), 3u);
  const auto count = [&](glm::vec3 colour) {
    return std::ranges::count_if(again.parts, [&](const Part& part) {
      return again.materials[std::size_t(part.material)].base_colour == colour;
    });
  };
  EXPECT_EQ(count(glm::vec3(0.5f)), 1);
  EXPECT_EQ(count({0.75f, 0.25f, 0.25f}), 2);
  EXPECT_LT(fs::file_size(folder.path() / "two.glb"), fs::file_size(folder.path() / "one.glb") + 2000);
  expect_valid_gltf(folder.path());
}

TEST(GltfWriter, ASceneWithoutObjectsIsAFileToo) {
  const TestFolder folder;
  ASSERT_TRUE(write_gltf(folder.path() / "empty.glb", {}, small_square().cameras));
  expect_valid_gltf(folder.path());
}

TEST(GltfWriter, PicturesOfOneNameAreKeptApartAndEqualOnesAreOne) {
  const TestFolder folder;
  Model model = *model_of(box(glm::vec3(0.0f), glm::vec3(1.0f)), matt(glm::vec3(1.0f)));
  for (const std::uint8_t grey : {50, 50, 90})
    model.textures.push_back({"some where/a wall?.jpg", Image8(2, 2, 4, grey)});
  for (const int texture : {0, 1, 2}) {
    model.materials.push_back(matt(glm::vec3(1.0f)));
    model.materials.back().base_colour_texture = texture;
    model.parts.push_back(model.parts.front());
    model.parts.back().material = texture + 1;
  }
  ASSERT_TRUE(write_gltf(folder.path() / "wall.glb", model));
  const Model again = read_back(folder.path() / "wall.glb");
  ASSERT_EQ(again.textures.size(), 2u);
  EXPECT_EQ(again.materials[2].base_colour_texture, again.materials[1].base_colour_texture);
  EXPECT_EQ(again.textures[1].image.pixels.front(), 90);
  expect_valid_gltf(folder.path());
}

TEST(GltfWriter, PicturesOfLongAndEqualNamesAreWritten) {
  const TestFolder folder;
  Model model = *model_of(box(glm::vec3(0.0f), glm::vec3(1.0f)), matt(glm::vec3(1.0f)));
  const std::string name(400, 'n');
  for (const int grey : {10, 20, 30, 40})
    model.textures.push_back({grey < 40 ? name : name + "_2", Image8(2, 2, 4, std::uint8_t(grey))});
  for (int texture = 0; texture < 4; ++texture) {
    model.materials.push_back(matt(glm::vec3(1.0f)));
    model.materials.back().base_colour_texture = texture;
    model.parts.push_back(model.parts.front());
    model.parts.back().material = texture + 1;
  }
  const std::string file = std::string(251, 'f') + ".glb";
  const Status status = write_gltf(folder.path() / file, model);
  ASSERT_TRUE(status) << to_string(status.errors());
  const Model again = read_back(folder.path() / file);
  ASSERT_EQ(again.textures.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(again.textures[i].image.pixels.front(), 10 * (i + 1)) << "the picture of another";
}

TEST(GltfWriter, PicturesOfOthersAreNotWrittenOver) {
  const TestFolder folder;
  const auto painted = [](std::uint8_t grey) {
    Model model = *model_of(box(glm::vec3(0.0f), glm::vec3(1.0f)), matt(glm::vec3(1.0f)));
    model.textures.push_back({"wall.png", Image8(2, 2, 4, grey)});
    model.materials.front().base_colour_texture = 0;
    return model;
  };
  ASSERT_TRUE(write_gltf(folder.path() / "a b.glb", painted(50)));
  const Status other = write_gltf(folder.path() / "a_b.glb", painted(90));
  ASSERT_FALSE(other) << "both have a_b_wall.png";
  EXPECT_NE(to_string(other.errors()).find("a_b_wall.png"), std::string::npos) << to_string(other.errors());
  EXPECT_FALSE(fs::exists(folder.path() / "a_b.glb"));
  EXPECT_EQ(read_back(folder.path() / "a b.glb").textures.front().image.pixels.front(), 50);
  EXPECT_TRUE(write_gltf(folder.path() / "a b.glb", painted(90))) << "its own picture changes";
  EXPECT_TRUE(write_gltf(folder.path() / "a_b.glb", painted(90))) << "the same picture serves both";
  ASSERT_TRUE(write_file(folder.path() / "mine_wall.png", "somebody's"));
  EXPECT_FALSE(write_gltf(folder.path() / "mine.glb", painted(50)));
  EXPECT_EQ(*read_file(folder.path() / "mine_wall.png"), "somebody's");
}

TEST(GltfWriter, APipeInTheWayIsRefused) {
  const TestFolder folder;
  const fs::path pipe = folder.path() / "out.glb";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const Status written = write_gltf(pipe, flag());
  ASSERT_FALSE(written);
  EXPECT_NE(to_string(written.errors()).find("not a regular file"), std::string::npos);
}

TEST(GltfWriter, BlenderOpensWhatIsWritten) {
  if (std::system("command -v blender > /dev/null") != 0) GTEST_SKIP() << "skipped: blender is not installed";
  const TestFolder folder;
  const Scene scene = small_square();
  ASSERT_TRUE(write_gltf(folder.path() / "square.glb", all_of(scene), scene.cameras));
  const std::string script = folder.write("look.py", R"(
import numpy, sys
numpy.bool = bool
import bpy
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=sys.argv[-1])
objects = bpy.data.objects
assert {"flag west", "flag east", "box", "street"} <= {o.name.split(".")[0] for o in objects}, objects.keys()
assert sum(o.type == "MESH" for o in objects) == 3, [o.type for o in objects]
assert sum(o.type == "ARMATURE" for o in objects) == 2, [o.type for o in objects]
assert sum(o.type == "CAMERA" for o in objects) == 1, [o.type for o in objects]
assert any(m.shape_keys for m in bpy.data.meshes), "no morph target"
assert any("wave" in a.name for a in bpy.data.actions), bpy.data.actions.keys()
box = next(o for o in objects if o.type == "MESH" and not o.data.shape_keys)
low = [min((box.matrix_world @ v.co)[i] for v in box.data.vertices) for i in range(3)]
assert all(abs(a - b) < 1e-4 for a, b in zip(low, (0, 5, 0))), low
)");
  const std::string command = "blender --background --factory-startup --python-exit-code 1 --python '" +
                              script + "' -- '" + (folder.path() / "square.glb").string() + "' > '" +
                              (folder.path() / "log").string() + "' 2>&1";
  const int status = std::system(command.c_str());
  EXPECT_EQ(status, 0) << *read_file(folder.path() / "log");
}

TEST(GltfWriter, OwnDataIsReadBackAndOthersSeeTheModel) {
  const TestFolder folder;
  const fs::path file = folder.path() / "own.glb";
  const Model model = *model_of(quad({0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}), matt(glm::vec3(0.5f)));
  const GltfOwnData own{"PARVIS_test", R"({"version":3})", {{"a", "five!"}, {"b", std::string("\0\1\2", 3)}}};
  ASSERT_TRUE(write_gltf(file, model, own));
  EXPECT_EQ(read_back(file).triangle_count(), 2u);
  const Result<GltfOwnData> back = read_gltf_own_data(file, "PARVIS_test");
  ASSERT_TRUE(back) << to_string(back.errors());
  EXPECT_EQ(back->json, own.json);
  EXPECT_EQ(back->views, own.views);
  EXPECT_FALSE(read_gltf_own_data(file, "PARVIS_other"));
  EXPECT_FALSE(write_gltf(file, model, {"PARVIS_test", "no object", {}}));
  ASSERT_TRUE(write_gltf(file, model, {"PARVIS_test", R"({"views":{"a":99}})", {}}));
  EXPECT_NE(to_string(read_gltf_own_data(file, "PARVIS_test").errors()).find("the view \"a\" is 99"),
            std::string::npos);
}

}  // namespace
}  // namespace parvis::scene
