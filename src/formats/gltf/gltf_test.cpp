#include <gtest/gtest.h>

#include <fstream>

#include "base/files.h"
#include "base/random.h"
#include "base/test_data.h"
#include "base/test_folder.h"
#include "formats/gltf/gltf_reader.h"
#include "formats/gltf/gltf_writer.h"
#include "formats/gltf/test_validator.h"
#include "formats/readers/test_packing.h"

namespace parvis::scene {
namespace {
namespace fs = std::filesystem;

/// Two parts on two nodes, with every property that the writer knows.
Model small_model() {
  Model model;
  model.textures.push_back({"colour", Image8(4, 4, 4, 200)});
  model.textures.back().image.pixels[3] = 10;
  Material paint;
  paint.name = "paint";
  paint.base_colour = {0.1f, 0.2f, 0.3f};
  paint.clear_coat = 0.9f;
  paint.is_mirror_like = true;
  paint.base_colour_texture = 0;
  paint.texture_from_mesh_uv = glm::mat3(2, 0, 0, 0, 3, 0, 0.25f, 0.5f, 1);
  Material leaf;
  leaf.name = "leaf";
  leaf.alpha_mode = Alpha::cutout;
  leaf.translucency = 0.5f;
  leaf.relief_m = 0.25f;
  leaf.is_double_sided = true;
  Material glass;
  glass.name = "glass";
  glass.ior = 1.75f;
  glass.absorption_per_m = {0.5f, 0.0f, 20.0f};
  glass.thickness_m = 0.02f;
  model.materials = {paint, leaf, glass};
  model.nodes.push_back({"wheel_left", 0, {1, 2, 3}, glm::angleAxis(0.5f, glm::vec3(0, 0, 1)), glm::vec3(2)});
  Mesh triangle;
  triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  triangle.normals.assign(3, {0, 0, 1});
  triangle.uvs = {{0, 0}, {1, 0}, {0, 1}};
  triangle.indices = {0, 1, 2};
  model.parts = {{"body", triangle, 0, 0, true}, {"leaves", triangle, 1, 1, false}};
  AnimationChannel spin{1, AnimationChannel::Property::rotation, Interpolation::linear, {0, 1}, {}};
  spin.values = {{0, 0, 0, 1}, {0, 0, 1, 0}};
  model.animations.push_back({"spin", {spin}, {}, 1.0f});
  return model;
}

Model read(const fs::path& file) {
  Errors warnings;
  Result<Model> model = read_gltf(file, warnings);
  EXPECT_TRUE(model) << to_string(model.errors());
  EXPECT_TRUE(warnings.empty()) << to_string(warnings);
  return model ? *std::move(model) : Model{};
}

std::vector<glm::vec3> world_positions(const Model& model, std::size_t part) {
  const glm::mat4 pose = rest_pose(model)[std::size_t(model.parts[part].node)];
  std::vector<glm::vec3> points;
  for (const glm::vec3& p : model.parts[part].mesh.positions) points.push_back(pose * glm::vec4(p, 1.0f));
  return points;
}

TEST(Gltf, PackedFilesAndNamesInCapitalsAreRead) {
  const TestFolder folder;
  ASSERT_TRUE(write_gltf(folder.path() / "small.glb", small_model()));
  const Result<std::string> bytes = read_file(folder.path() / "small.glb");
  ASSERT_TRUE(bytes);
  const Model packed = read(folder.write("packed.GLB.gz", formats::gzipped(*bytes)));
  EXPECT_EQ(packed.name, "packed");
  EXPECT_EQ(packed.parts.size(), 2u);
  Errors warnings;
  const Result<Model> text =
      read_gltf(folder.write("TEXT.GLB", "{\"asset\":{\"version\":\"2.0\"}}"), warnings);
  ASSERT_FALSE(text);
  EXPECT_NE(to_string(text.errors()).find("this is no .glb"), std::string::npos) << "as of small letters";
}

TEST(Gltf, WhatIsWrittenReadsTheSame) {
  const TestFolder folder;
  const Model model = small_model();
  ASSERT_TRUE(write_gltf(folder.path() / "small.glb", model));
  const Model again = read(folder.path() / "small.glb");
  ASSERT_EQ(again.parts.size(), 2u);
  for (std::size_t part = 0; part < 2; ++part) {
    EXPECT_EQ(again.parts[part].object, model.parts[part].object);
    EXPECT_EQ(again.parts[part].casts_shadow, model.parts[part].casts_shadow);
    const auto was = world_positions(model, part), is = world_positions(again, part);
    for (std::size_t i = 0; i < was.size(); ++i) EXPECT_LT(glm::distance(was[i], is[i]), 1e-5f);
  }
  const Material &paint = again.materials[0], &leaf = again.materials[1];
  EXPECT_EQ(paint.clear_coat, 0.9f);
  EXPECT_TRUE(paint.is_mirror_like);
  for (int column = 0; column < 3; ++column)
    EXPECT_LT(
        glm::distance(paint.texture_from_mesh_uv[column], model.materials[0].texture_from_mesh_uv[column]),
        1e-5f);
  EXPECT_EQ(leaf.alpha_mode, Alpha::cutout);
  EXPECT_EQ(leaf.translucency, 0.5f);
  EXPECT_EQ(leaf.relief_m, 0.25f);
  EXPECT_TRUE(leaf.is_double_sided);
  EXPECT_EQ(again.materials[2].ior, 1.75f);
  EXPECT_EQ(again.materials[2].thickness_m, 0.02f);
  EXPECT_LT(glm::distance(again.materials[2].absorption_per_m, model.materials[2].absorption_per_m), 1e-4f);
  EXPECT_FALSE(paint.refracts());
  EXPECT_EQ(again.textures[0].image.pixels, model.textures[0].image.pixels);
  ASSERT_EQ(again.animations.size(), 1u);
  EXPECT_EQ(again.nodes[std::size_t(again.animations[0].channels[0].node)].name, "wheel_left");
}

TEST(Gltf, AGlassBodyHasAVolumeAPaneHasNone) {
  const TestFolder folder;
  const auto material = [&](const std::string& extensions) {
    const fs::path file = folder.path() / "glass.gltf";
    EXPECT_TRUE(write_file(file, R"({"asset":{"version":"2.0"},"materials":[{"name":"pane","extensions":{)" +
                                     extensions + R"(}}],
      "scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
      "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
      "bufferViews":[{"buffer":0,"byteLength":36}],
      "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAAAA"}]})"));
    Errors warnings;
    Result<Model> model = read_gltf(file, warnings);
    EXPECT_TRUE(model) << to_string(model.errors());
    return std::pair(model ? model->materials.at(0) : Material(), to_string(warnings));
  };
  const std::string clear = R"("KHR_materials_transmission":{"transmissionFactor":1})",
                    thick = clear + R"(,"KHR_materials_volume":{"thicknessFactor":0.5})";
  EXPECT_FALSE(material(clear).first.refracts());
  EXPECT_TRUE(material(clear).first.is_mirror_like);
  EXPECT_EQ(material(thick).first.ior, 1.5f);
  EXPECT_EQ(material(thick + R"(,"KHR_materials_ior":{"ior":1.33})").first.ior, 1.33f);
  EXPECT_FALSE(material(thick + R"(,"KHR_materials_ior":{"ior":1})").first.refracts()) << "as air";
  for (const char* bad : {"0.5", "-1", "100"}) {
    const auto [glass, warning] = material(thick + R"(,"KHR_materials_ior":{"ior":)" + bad + "}");
    EXPECT_EQ(glass.ior, 1.5f);
    EXPECT_NE(warning.find("index of refraction"), std::string::npos) << warning;
  }
}

TEST(Gltf, MatrixNodesTurnAsTheirMatrixSays) {
  const TestFolder folder;
  // a quarter turn about y in glTF's frame, as a matrix; a triangle along +x then points along -z, which is
  // +y here
  ASSERT_TRUE(write_file(folder.path() / "m.gltf", R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],
    "nodes":[{"mesh":0,"matrix":[0,0,-1,0, 0,1,0,0, 1,0,0,0, 0,0,0,1]}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
    "bufferViews":[{"buffer":0,"byteLength":36}],
    "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAAAA"}]})"));
  const std::vector<glm::vec3> points = world_positions(read(folder.path() / "m.gltf"), 0);
  EXPECT_LT(glm::distance(points[0], glm::vec3(0, 1, 0)), 1e-5f);
  EXPECT_LT(glm::distance(points[1], glm::vec3(0, 0, 1)), 1e-5f);
}

/// The file with one change; expects an error that holds `expected`.
void expect_refused(const std::string& bytes, const std::string& expected) {
  const TestFolder folder;
  ASSERT_TRUE(write_file(folder.path() / "bad.glb", bytes));
  Errors warnings;
  const Result<Model> model = read_gltf(folder.path() / "bad.glb", warnings);
  ASSERT_FALSE(model) << "was read, but should be refused for: " << expected;
  EXPECT_NE(to_string(model.errors()).find(expected), std::string::npos) << to_string(model.errors());
}

std::string good_glb() {
  const TestFolder folder;
  Model model = small_model();
  model.textures.clear();
  model.materials[0].base_colour_texture = no_index;
  EXPECT_TRUE(write_gltf(folder.path() / "good.glb", model));
  return *read_file(folder.path() / "good.glb");
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  EXPECT_EQ(from.size(), to.size());
  return text.replace(at, from.size(), to);
}

TEST(Gltf, TheKhronosValidatorFindsNoErrorInWhatIsWritten) {
  const TestFolder folder;
  ASSERT_TRUE(write_gltf(folder.path() / "small.glb", small_model()));
  expect_valid_gltf(folder.path());
}

TEST(Gltf, HostileFilesAreRefusedByName) {
  const std::string good = good_glb();
  expect_refused("", "cut short");
  expect_refused("glTX" + good.substr(4), "first bytes");
  for (const std::size_t length : {11u, 19u, 40u, unsigned(good.size() - 4)})
    expect_refused(good.substr(0, length), "cut short");
  expect_refused(replaced(good, "\"count\":3", "\"count\":9"), "more than its buffer view has");
  expect_refused(replaced(good, "\"material\":0", "\"material\":7"), "out of range");
  expect_refused(replaced(good, "\"version\":\"2.0\"", "\"version\":\"1.0\""), "version");
  std::string nan = good;
  const std::size_t binary = nan.find(std::string("BIN\0", 4)) + 4;
  for (int i = 0; i < 4; ++i) nan[binary + std::size_t(i)] = char(0xFF);
  expect_refused(nan, "not a finite number");
}

TEST(Gltf, IndicesOutOfRangeAreRefused) {
  const TestFolder folder;
  Model model = small_model();
  model.parts[0].mesh.indices = {0, 1, 77};
  ASSERT_TRUE(write_gltf(folder.path() / "indices.glb", model));
  Errors warnings;
  const Result<Model> read_back = read_gltf(folder.path() / "indices.glb", warnings);
  ASSERT_FALSE(read_back);
  EXPECT_NE(to_string(read_back.errors()).find("index 77"), std::string::npos);
}

TEST(Gltf, MissingPictureIsNamedAndSeen) {
  const TestFolder folder;
  ASSERT_TRUE(write_gltf(folder.path() / "small.glb", small_model()));
  fs::remove(folder.path() / "small_colour.png");
  Errors warnings;
  const Result<Model> model = read_gltf(folder.path() / "small.glb", warnings);
  ASSERT_TRUE(model) << to_string(model.errors());
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].message.find("small_colour.png"), std::string::npos);
  EXPECT_FALSE(model->textures[0].image.empty());
}

TEST(Gltf, PicturesOutsideTheFolderAreNotRead) {
  const TestFolder folder;
  Model model = small_model();
  ASSERT_TRUE(write_gltf(folder.path() / "inner/small.glb", model));
  fs::rename(folder.path() / "inner/small_colour.png", folder.path() / "xx_colour.png");
  std::string bytes = *read_file(folder.path() / "inner/small.glb");
  bytes = replaced(bytes, "small_colour.png", "../xx_colour.png");
  ASSERT_TRUE(write_file(folder.path() / "inner/small.glb", bytes));
  Errors warnings;
  ASSERT_TRUE(read_gltf(folder.path() / "inner/small.glb", warnings));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].message.find("leads out"), std::string::npos);
}

/// A triangle on each of the nodes, which are given as JSON.
std::string graph_gltf(const std::string& scenes, const std::string& nodes) {
  return R"({"asset":{"version":"2.0"},)" + scenes + R"("nodes":[)" + nodes + R"(],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
    "bufferViews":[{"buffer":0,"byteLength":36}],
    "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAAAA"}]})";
}

/// How many parts the rest has, and what is reported.
std::pair<std::size_t, std::string> read_graph(const std::string& scenes, const std::string& nodes) {
  const TestFolder folder;
  Errors warnings;
  const Result<Model> model = read_gltf(folder.write("graph.gltf", graph_gltf(scenes, nodes)), warnings);
  EXPECT_TRUE(model) << to_string(model.errors());
  return {model ? model->parts.size() : 0, to_string(warnings)};
}

TEST(Gltf, ALinkThatClosesACircleIsLeftOutByName) {
  for (const char* scenes : {R"("scenes":[{"nodes":[0]}],)", ""}) {  // with a root, and with none
    const auto [parts, told] = read_graph(
        scenes, R"({"mesh":0,"children":[1]},{"mesh":0,"children":[2]},{"mesh":0,"children":[0]})");
    EXPECT_EQ(parts, 3u);
    EXPECT_NE(told.find("node 0 is its own ancestor through node 2"), std::string::npos) << told;
  }
  const auto [parts, told] = read_graph("", R"({"mesh":0,"children":[0]},{"mesh":0})");
  EXPECT_EQ(parts, 2u);
  EXPECT_NE(told.find("node 0 is its own ancestor through node 0"), std::string::npos) << told;
}

TEST(Gltf, ANodeKeepsItsFirstParent) {
  const auto [parts, told] = read_graph(
      R"("scenes":[{"nodes":[0]}],)",
      R"({"mesh":0,"children":[1,2]},{"mesh":0,"children":[3]},{"mesh":0,"children":[3]},{"mesh":0})");
  EXPECT_EQ(parts, 4u);
  EXPECT_NE(told.find("node 3 has two parents, node 2 and node 1"), std::string::npos) << told;
}

TEST(Gltf, DamagedBytesNeverCrash) {
  const std::string good = good_glb();
  const TestFolder folder;
  Random random(7);
  for (int round = 0; round < 400; ++round) {
    std::string bytes = good;
    for (int change = 0; change <= round % 5; ++change)
      bytes[std::size_t(random.index(int(bytes.size())))] = char(random.next());
    ASSERT_TRUE(write_file(folder.path() / "bad.glb", bytes));
    Errors warnings;
    static_cast<void>(read_gltf(folder.path() / "bad.glb", warnings));
  }
}

TEST(Gltf, SkinnedFiguresStandUprightInTheirRestPose) {
  for (const char* name : {"CesiumMan/CesiumMan.gltf", "RiggedFigure/RiggedFigure.gltf"}) {
    const auto file = shared_data(std::string("gltf_animated/") + name);
    if (!file) GTEST_SKIP() << "skipped: shared data absent";
    const Bounds box = bounds(read(*file));
    EXPECT_GT(box.size().z, 1.3f) << name;
    EXPECT_LT(box.size().z, 2.2f) << name;
    EXPECT_LT(box.size().x, box.size().z) << name;
    EXPECT_NEAR(box.min.z, 0.0f, 0.1f) << name;
  }
}

TEST(Gltf, ASkinWithMissingJointsIsNamed) {
  const TestFolder folder;
  const auto skin_errors = [&](const std::string& joints) {
    const auto file = folder.write("skin.gltf", R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],
      "nodes":[{"mesh":0,"skin":0},{}],"skins":[{"name":"legs","joints":)" +
                                                    joints + R"(}],
      "accessors":[{"count":3,"type":"VEC3","componentType":5126}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]})");
    Errors warnings;
    const Result<Model> model = read_gltf(file, warnings);
    return model ? std::string() : to_string(model.errors());
  };
  EXPECT_NE(skin_errors("[0,7]").find("skin \"legs\": joint 7 is missing"), std::string::npos);
  EXPECT_NE(skin_errors("[]").find("skin \"legs\" has no joints"), std::string::npos);
  EXPECT_NE(skin_errors("[1]").find("skin \"legs\": joint 1 is missing from the scene"), std::string::npos);
  EXPECT_NE(skin_errors("[0]").find("without joints or weights"), std::string::npos);
}

TEST(Gltf, ReadsTheCarsOfKenney) {
  const auto file = shared_data("gltf_kenney/vehicles/sedan-sports.glb");
  if (!file) GTEST_SKIP() << "skipped: shared data absent";
  const Model model = read(*file);
  const Bounds box = bounds(model);
  EXPECT_GT(model.triangle_count(), 1000u);
  EXPECT_GT(box.size().z, 0.5f);
  EXPECT_LT(box.size().z, box.size().y);  // longer than high, z up
}

}  // namespace
}  // namespace parvis::scene
