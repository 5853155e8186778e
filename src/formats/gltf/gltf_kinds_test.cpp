// What people really hand over: each test is a kind of file that readers get wrong in silence.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/test_folder.h"
#include "formats/gltf/gltf_reader.h"
#include "formats/gltf/gltf_vertex_codec.h"
#include "formats/gltf/gltf_writer.h"
#include "formats/gltf/test_validator.h"
#include "scene/data/test_scene.h"

namespace parvis::scene {
namespace {

using Json = nlohmann::json;

/// A file of one buffer; accessors are added value by value.
class File {
 public:
  Json json{{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", {0}}}}}};

  /// An accessor to values of `type`, with the component type of T.
  template <class T>
  int add(const std::vector<T>& values, const char* type, int component, std::size_t count,
          bool is_normalised = false) {
    while (bytes_.size() % 4 != 0) bytes_.push_back('\0');
    json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", values.size() * sizeof(T)}});
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                 {"componentType", component},
                                 {"count", count},
                                 {"type", type}});
    if (is_normalised) json["accessors"].back()["normalized"] = true;
    return int(json["accessors"].size()) - 1;
  }
  int add_positions(const std::vector<float>& values) { return add(values, "VEC3", 5126, values.size() / 3); }

  Result<formats::FileContent> read() {
    json["buffers"] = {{{"uri", "data.bin"}, {"byteLength", bytes_.size()}}};
    folder_->write("data.bin", bytes_);
    warnings.clear();
    return read_gltf_content(folder_->write("file.gltf", json.dump()), warnings);
  }
  Model model() {
    Result<formats::FileContent> content = read();
    EXPECT_TRUE(content) << to_string(content.errors());
    return content ? std::move(content->model) : Model{};
  }

  Errors warnings;

 private:
  std::shared_ptr<const TestFolder> folder_ = std::make_shared<TestFolder>();
  std::string bytes_;
};

/// A triangle one wide and one high, in the file's plane z = 0, that faces +z.
File triangle() {
  File file;
  file.json["meshes"] = {
      {{"name", "leaf"},
       {"primitives", {{{"attributes", {{"POSITION", file.add_positions({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}}}}}};
  file.json["nodes"] = {{{"name", "stem"}, {"mesh", 0}}};
  return file;
}

Json& primitive(File& file) { return file.json["meshes"][0]["primitives"][0]; }

std::vector<glm::dvec3> corners_of_part(const Model& model, std::size_t part = 0) {
  const glm::mat4 pose = rest_pose(model)[std::size_t(model.parts[part].node)];
  std::vector<glm::dvec3> points;
  for (const std::uint32_t index : model.parts[part].mesh.indices)
    points.emplace_back(glm::dvec3(pose * glm::vec4(model.parts[part].mesh.positions[index], 1.0f)));
  return points;
}

/// Where the first triangle of a part faces, by its winding as the renderer sees it.
glm::dvec3 facing(const Model& model, std::size_t part = 0) {
  const std::vector<glm::dvec3> c = corners_of_part(model, part);
  const glm::mat4 pose = rest_pose(model)[std::size_t(model.parts[part].node)];
  const double side = glm::determinant(glm::mat3(pose)) < 0.0f ? -1.0 : 1.0;
  return side * glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
}

void expect_near(glm::dvec3 found, glm::dvec3 expected, double tolerance = 1e-5) {
  EXPECT_LT(glm::distance(found, expected), tolerance)
      << found.x << " " << found.y << " " << found.z << " in place of " << expected.x << " " << expected.y
      << " " << expected.z;
}

TEST(GltfKinds, NoPartStandsOnANodeThatMirrors) {
  File file = triangle();
  file.json["nodes"][0]["scale"] = {-1, 1, 1};
  const Model model = file.model();
  ASSERT_EQ(model.parts.size(), 1u);
  EXPECT_GT(glm::determinant(glm::mat3(rest_pose(model)[std::size_t(model.parts[0].node)])), 0.0f);
  expect_near(facing(model), {0, -1, 0});  // the file's +z, as the mesh on a node that does not mirror
  double least = 0.0;
  for (const glm::dvec3& corner : corners_of_part(model)) least = std::min(least, corner.x);
  EXPECT_NEAR(least, -1.0, 1e-6);
  const glm::mat3 pose(rest_pose(model)[std::size_t(model.parts[0].node)]);
  expect_near(glm::dvec3(glm::normalize(pose * model.parts[0].mesh.normals[0])), {0, -1, 0});
  // A mirror below a mirror mirrors nothing.
  file.json["nodes"] = {{{"children", {1}}, {"scale", {1, -1, 1}}}, {{"mesh", 0}, {"scale", {1, -1, 1}}}};
  const Model twice = file.model();
  EXPECT_EQ(twice.nodes.size(), 3u);
  expect_near(facing(twice), {0, -1, 0});
}

TEST(GltfKinds, AMatrixIsReadAtAnyScaleAndAFlatOneStaysFlat) {
  File file = triangle();
  file.json["nodes"][0]["matrix"] = {1e-5, 0, 0, 0, 0, 0, -1e-5, 0, 0, 1e-5, 0, 0, 2, 3, 4, 1};
  const Model small = file.model();
  ASSERT_EQ(small.parts.size(), 1u);
  expect_near(corners_of_part(small)[0], {2, -4, 3});
  EXPECT_NEAR(corners_of_part(small)[1].x - 2.0, 1e-5, 1e-6);  // floats at 2 are that far apart
  file.json["nodes"][0]["matrix"] = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
  const Model flat = file.model();
  ASSERT_EQ(flat.parts.size(), 1u);
  expect_near(corners_of_part(flat)[1], {2, 0, 0});
  expect_near(corners_of_part(flat)[2], {0, 0, 2});
}

TEST(GltfKinds, AMatrixThatShearsIsReadAsItStands) {
  File file = triangle();
  // The leaf's upper corner lies half a metre to the side; a mirror of the same; a node below; a flat one.
  const Json sheared = {1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 2, 3, 4, 1};
  file.json["nodes"] = {{{"name", "sheared"}, {"children", {1}}, {"matrix", sheared}},
                        {{"name", "leaf"}, {"mesh", 0}, {"translation", {0, 2, 0}}}};
  const Model model = file.model();
  ASSERT_EQ(model.parts.size(), 1u);
  expect_near(corners_of_part(model)[0], {3, -4, 5});
  expect_near(corners_of_part(model)[1], {4, -4, 5});
  expect_near(corners_of_part(model)[2], {3.5, -4, 6});
  expect_near(facing(model), {0, -1, 0});
  const auto named = [](const Model& read, const char* name) {
    return std::ranges::count_if(read.nodes, [&](const ModelNode& node) { return node.name == name; });
  };
  EXPECT_EQ(named(model, "sheared"), 1);
  const TestFolder folder;
  Errors warnings;
  ASSERT_TRUE(write_gltf(folder.path() / "again.glb", model));
  const Result<Model> again = read_gltf(folder.path() / "again.glb", warnings);
  ASSERT_TRUE(again) << to_string(again.errors());
  expect_near(corners_of_part(*again)[2], {3.5, -4, 6});
  file.json["nodes"] = {{{"mesh", 0}, {"matrix", {-1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}};
  const Model mirrored = file.model();
  expect_near(facing(mirrored), {0, -1, 0});
  EXPECT_TRUE(std::ranges::any_of(corners_of_part(mirrored), [](glm::dvec3 corner) {
    return glm::distance(corner, {0.5, 0, 1}) < 1e-5;
  }));
  file.json["nodes"] = {{{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0.5, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}};
  expect_near(corners_of_part(file.model())[2], {0.5, 0, 0});
}

TEST(GltfKinds, LargeTranslationsThatCancelLeaveMillimetres) {
  File file = triangle();
  const double half = std::sqrt(0.5);
  file.json["nodes"] = {{{"children", {1}}, {"translation", {-3512345.127, -40.0, 5687654.331}}},
                        {{"children", {2}}, {"translation", {3512345.127, 40.0, -5687654.331}}},
                        {{"mesh", 0}, {"translation", {0.625, 0, 0}}, {"rotation", {0, half, 0, half}}}};
  const Model model = file.model();
  EXPECT_EQ(model.origin, glm::dvec3(0.0));
  expect_near(corners_of_part(model)[0], {0.625, 0, 0});
  expect_near(corners_of_part(model)[1], {0.625, 1, 0});
}

TEST(GltfKinds, CoordinatesOfANationalGridAreGivenAboutALocalOrigin) {
  File file = triangle();
  file.json["nodes"] = {{{"mesh", 0}, {"translation", {458321.37, 35.25, -5431987.63}}}};
  const Result<formats::FileContent> content = file.read();
  ASSERT_TRUE(content) << to_string(content.errors());
  const Model& model = content->model;
  EXPECT_EQ(model.origin.z, 0.0);
  expect_near(corners_of_part(model)[0] + model.origin, {458321.37, 5431987.63, 35.25}, 1e-4);
  EXPECT_LT(glm::length(glm::dvec2(corners_of_part(model)[0])), 10.0);
  EXPECT_EQ(content->account.count(Fate::changed, "coordinates"), 1u);
}

TEST(GltfKinds, InstancesStandAtNodeTimesTranslationRotationAndScale) {
  File file = triangle();
  const float half = std::sqrt(0.5f);
  const int translation = file.add_positions({1, 0, 0, 5, 0, 0}),
            rotation = file.add(std::vector<float>{0, 0, 0, 1, 0, 0, half, half}, "VEC4", 5126, 2),
            scale = file.add_positions({1, 1, 1, 3, 3, -3});
  file.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  file.json["nodes"] = {
      {{"mesh", 0},
       {"translation", {0, 10, 0}},
       {"extensions",
        {{"EXT_mesh_gpu_instancing",
          {{"attributes", {{"TRANSLATION", translation}, {"ROTATION", rotation}, {"SCALE", scale}}}}}}}}};
  const Result<formats::FileContent> content = file.read();
  ASSERT_TRUE(content) << to_string(content.errors());
  ASSERT_EQ(content->model.parts.size(), 2u);
  expect_near(corners_of_part(content->model, 0)[1], {2, 0, 10});
  const std::vector<glm::dvec3> second = corners_of_part(content->model, 1);  // mirrored: wound the other way
  expect_near(second[0], {5, 0, 10});
  expect_near(second[1] + second[2], {7, 0, 23});  // 5 0 13 and 2 0 10
  EXPECT_EQ(content->account.count(Fate::used, "instances"), 2u);
  file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] =
      file.add_positions({1, 1, 1});
  EXPECT_FALSE(file.read()) << "fewer scales than places";
}

TEST(GltfKinds, HiddenNodesAreNotShown) {
  File file = triangle();
  const Json hidden{{"KHR_node_visibility", {{"visible", false}}}};
  file.json["extensionsUsed"] = {"KHR_node_visibility"};
  file.json["nodes"] = {
      {{"children", {1, 2}}}, {{"mesh", 0}}, {{"children", {3}}, {"extensions", hidden}}, {{"mesh", 0}}};
  EXPECT_EQ(file.model().parts.size(), 1u);
}

TEST(GltfKinds, LampsThatAreRequiredAreNamedAndTheRestIsShown) {
  File file = triangle();
  file.json["extensionsUsed"] = {"KHR_lights_punctual", "EXT_of_tomorrow"};
  file.json["extensionsRequired"] = {"KHR_lights_punctual"};
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"name", "Lamp"}}};
  const Result<formats::FileContent> content = file.read();
  ASSERT_TRUE(content) << to_string(content.errors());
  EXPECT_EQ(content->account.count(Fate::left_out, "lights"), 1u);
  EXPECT_EQ(content->account.count(Fate::left_out, "extensions"), 2u);
  EXPECT_NE(content->account.text().find("EXT_of_tomorrow"), std::string::npos);
  file.json["extensionsRequired"] = {"EXT_of_tomorrow"};
  const Result<formats::FileContent> refused = file.read();
  ASSERT_FALSE(refused);
  EXPECT_NE(to_string(refused.errors()).find("EXT_of_tomorrow"), std::string::npos);
}

TEST(GltfKinds, ColoursOfVerticesAreLinearAndNormalised) {
  File file = triangle();
  primitive(file)["attributes"]["COLOR_0"] = file.add(
      std::vector<std::uint8_t>{255, 0, 0, 255, 0, 51, 0, 255, 0, 0, 255, 102}, "VEC4", 5121, 3, true);
  const Model model = file.model();
  ASSERT_EQ(model.parts[0].mesh.colours.size(), 3u);
  EXPECT_NEAR(model.parts[0].mesh.colours[1].y, 0.2f, 1e-6f);
  EXPECT_NEAR(model.parts[0].mesh.colours[2].w, 0.4f, 1e-6f);
  primitive(file)["attributes"]["COLOR_0"] = file.add_positions({1, 0, 0, 0, 1, 0, 0, 0, 0.5f});
  EXPECT_EQ(file.model().parts[0].mesh.colours[2], glm::vec4(0, 0, 0.5f, 1));
}

/// Two sets of texture coordinates, and a white pixel as the picture of textures 0 and 1.
File textured() {
  File file = triangle();
  const std::vector<float> first{0, 0, 1, 0, 0, 1}, second{2, 2, 3, 2, 2, 3};
  primitive(file)["attributes"]["TEXCOORD_0"] = file.add(first, "VEC2", 5126, 3);
  primitive(file)["attributes"]["TEXCOORD_1"] = file.add(second, "VEC2", 5126, 3);
  primitive(file)["material"] = 0;
  file.json["images"] = {
      {{"uri",
        "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8/5+hHgAHggJ/"
        "PchI7wAAAABJRU5ErkJggg=="}}};
  file.json["samplers"] = {{{"wrapS", 33648}, {"wrapT", 33071}}};
  file.json["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 0}}};
  return file;
}

TEST(GltfKinds, EachTextureHasItsOwnCoordinatesTransformAndWraps) {
  File file = textured();
  file.json["extensionsUsed"] = {"KHR_texture_transform"};
  file.json["materials"] = {
      {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
       {"normalTexture", {{"index", 1}, {"extensions", {{"KHR_texture_transform", {{"scale", {8, 8}}}}}}}},
       {"occlusionTexture", {{"index", 1}, {"texCoord", 1}, {"strength", 0.5}}},
       {"alphaMode", "MASK"},
       {"alphaCutoff", 0.2}}};
  const Model model = file.model();
  const Material& m = model.materials[0];
  EXPECT_EQ(m.texture_from_mesh_uv, glm::mat3(1.0f)) << "the base colour has no transform";
  ASSERT_TRUE(m.own_mappings.has_value());
  EXPECT_EQ(m.own_mappings->normal.texture_from_uv[0].x, 8.0f);
  EXPECT_FALSE(m.own_mappings->normal.takes_second_uvs);
  EXPECT_TRUE(m.own_mappings->occlusion.takes_second_uvs);
  EXPECT_EQ(m.occlusion_strength, 0.5f);
  EXPECT_FLOAT_EQ(m.alpha_cutoff, 0.2f);
  ASSERT_EQ(model.parts[0].mesh.second_uvs.size(), 3u);
  EXPECT_EQ(model.parts[0].mesh.second_uvs[1], glm::vec2(3, 2));
  const Texture& base = model.textures[std::size_t(m.base_colour_texture)];
  EXPECT_EQ(base.wrap_u, Wrap::mirror);
  EXPECT_EQ(base.wrap_v, Wrap::clamp);
  EXPECT_EQ(model.textures[std::size_t(m.normal_texture)].wrap_v, Wrap::repeat);

  // What was read is written.
  const TestFolder folder;
  ASSERT_TRUE(write_gltf(folder.path() / "again.glb", model));
  expect_valid_gltf(folder.path());
  Errors warnings;
  const Result<Model> again = read_gltf(folder.path() / "again.glb", warnings);
  ASSERT_TRUE(again) << to_string(again.errors());
  const Material& n = again->materials[0];
  ASSERT_TRUE(n.own_mappings.has_value());
  EXPECT_NEAR(n.own_mappings->normal.texture_from_uv[0].x, 8.0f, 1e-5f);
  EXPECT_TRUE(n.own_mappings->occlusion.takes_second_uvs);
  EXPECT_FLOAT_EQ(n.alpha_cutoff, 0.2f);
  EXPECT_EQ(n.occlusion_strength, 0.5f);
  EXPECT_EQ(again->parts[0].mesh.second_uvs, model.parts[0].mesh.second_uvs);
  EXPECT_EQ(again->textures[std::size_t(n.base_colour_texture)].wrap_u, Wrap::mirror);
}

TEST(GltfKinds, TexelsOfASmallPictureHaveTheEdgesThatTheFileAsksFor) {
  File file = textured();
  file.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  EXPECT_EQ(file.model().textures[0].image.width, 1);
  file.json["samplers"][0]["magFilter"] = 9728;
  const Model model = file.model();
  EXPECT_EQ(model.textures[0].image.width, 256) << "each texel is a square";
  EXPECT_EQ(model.textures[0].image.at(0, 0)[0], model.textures[0].image.at(255, 255)[0]);
}

TEST(GltfKinds, TheBaseColourMayTakeTheSecondCoordinates) {
  File file = textured();
  file.json["materials"] = {
      {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 1}}}}}}};
  const Result<formats::FileContent> content = file.read();
  ASSERT_TRUE(content);
  EXPECT_EQ(content->model.parts[0].mesh.uvs[1], glm::vec2(3, 2));
  EXPECT_FALSE(content->model.materials[0].own_mappings.has_value());
  EXPECT_EQ(content->account.count(Fate::unneeded, "texture coordinates"), 1u);
}

TEST(GltfKinds, RedOfTheSurfaceTextureIsOcclusionOnlyWhereTheFileSaysSo) {
  File file = textured();
  const Json surface{{"metallicRoughnessTexture", {{"index", 1}}}};
  file.json["materials"] = {{{"pbrMetallicRoughness", surface}},
                            {{"pbrMetallicRoughness", surface}, {"occlusionTexture", {{"index", 1}}}}};
  const Model model = file.model();
  EXPECT_EQ(model.materials[0].occlusion_strength, 0.0f);
  EXPECT_EQ(model.materials[1].occlusion_strength, 1.0f);
  EXPECT_EQ(model.materials[1].occlusion_texture, no_index) << "it is the surface texture";
}

TEST(GltfKinds, StripsBeginAgainWhereTheFileSaysSo) {
  File file = triangle();
  primitive(file)["mode"] = 5;
  primitive(file)["indices"] =
      file.add(std::vector<std::uint16_t>{0, 1, 2, 65535, 2, 1, 0}, "SCALAR", 5123, 7);
  file.json["extensionsUsed"] = {"KHR_mesh_primitive_restart"};
  EXPECT_EQ(file.model().parts[0].mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 0}));
}

TEST(GltfKinds, ABufferThatNobodyNeedsMayBeMissing) {
  File file = triangle();
  Result<formats::FileContent> content = file.read();  // writes the buffers
  file.json["bufferViews"].push_back({{"buffer", 0}, {"byteLength", 4}});
  ASSERT_TRUE(file.read());
  primitive(file)["attributes"]["_LABEL"] = 0;
  content = file.read();
  ASSERT_TRUE(content);
  EXPECT_EQ(content->account.count(Fate::left_out, "vertex attributes"), 1u);
}

/// Forty vertices by meshoptimizer 1.0.1's encoder: versions of the codec 1, levels 2 and 3.
constexpr const char* by_level_2 =
    "oTpaWgAAAICAQEBAQCAgICAgICAgEBAQEBAQEBAQEBAQEBAQEAgICAgICAgBBgB9AQBisf+AgP+AgP9YLICA/4CA/"
    "xYAgID/AJxOgn4B/4J+Af+n04J+Af+CfgH/gn7pAAH/gn4BALjD39+/wODg398d7r/A4ODf37/A4OBwAN/"
    "fvxU4EgfgfHt8SB+BIHt8fgQAAHt8AAAAAAAAAAAAAAAAAAAAgL8AAAAAAQEA";
constexpr const char* by_level_3 =
    "oWhaWgECAQ8fGg//+Pj0xPTEoGAQMBj4HPJi4mLyYuJiPB7d3QAAfgMHAwBisf+AgP+AgP9YLICA/4CA/"
    "xYAgID/AJxOgn4B/4J+Af+n04J+Af+CfgH/gn7pAAH/gn4BALjD39+/wODg398d7r/A4ODf37/A4OBwAN/"
    "fvxU4EgfgfHt8SB+BIHt8fgQAAHt8AAAAAAAAAAAAAAAAAAAAgL8AAAAAYgEA";

TEST(GltfKinds, TheVertexCodecOfTodaysGltfpackIsRead) {
  for (const auto& [packed, length] : {std::pair(by_level_2, 174), std::pair(by_level_3, 168)}) {
    File file = triangle();
    file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"KHR_meshopt_compression"};
    primitive(file)["mode"] = 5;
    primitive(file)["attributes"]["POSITION"] = file.add_positions(std::vector<float>(120, 0.0f));
    Json& view = file.json["bufferViews"].back();
    view = {{"buffer", 1},
            {"byteLength", 480},
            {"extensions",
             {{"KHR_meshopt_compression",
               {{"buffer", 2},
                {"byteLength", length},
                {"byteStride", 12},
                {"count", 40},
                {"mode", "ATTRIBUTES"}}}}}};
    const TestFolder folder;
    file.json["buffers"] = {
        {{"uri", "absent.bin"}, {"byteLength", 36}},
        {{"uri", "fallback.bin"}, {"byteLength", 480}},
        {{"uri", std::string("data:application/octet-stream;base64,") + packed}, {"byteLength", length}}};
    file.json["bufferViews"].erase(0);  // of the plain triangle: no buffer but the packed one is needed
    file.json["accessors"] = {{{"bufferView", 0}, {"componentType", 5126}, {"count", 40}, {"type", "VEC3"}}};
    primitive(file)["attributes"]["POSITION"] = 0;
    Errors warnings;
    const Result<Model> model = read_gltf(folder.write("packed.gltf", file.json.dump()), warnings);
    ASSERT_TRUE(model) << to_string(model.errors());
    const std::vector<glm::vec3>& positions = model->parts[0].mesh.positions;
    ASSERT_EQ(positions.size(), 40u);
    for (int i = 0; i < 40; ++i)
      EXPECT_EQ(positions[std::size_t(i)],
                glm::vec3(float(i) * 0.25f, float(i % 7) * 0.5f - 1.0f, float(i * i % 11) * 0.125f))
          << i;
  }
}

TEST(GltfKinds, ColoursOfTodaysGltfpackAreRead) {
  std::array<std::uint8_t, 16> bytes{0x40, 0x7f, 0xc1, 0xff, 0x80, 0x81, 0x00, 0xc0,
                                     0x66, 0xcd, 0x00, 0xff, 0xff, 0x00, 0x00, 0xa0};
  decode_colours(bytes, 4, 4);
  EXPECT_EQ(bytes, (std::array<std::uint8_t, 16>{254, 1, 0, 255, 1, 128, 255, 128, 51, 102, 153, 255, 255,
                                                 255, 255, 64}));
}

TEST(GltfKinds, ObjectsOfASmallScaleAreWrittenWithTurnAndPlace) {
  const auto model = model_of(box(glm::vec3(0.0f), glm::vec3(1000.0f)), matt(glm::vec3(0.5f)));
  Object object;
  object.name = "bench", object.model = model;
  object.world_from_model =
      glm::scale(glm::rotate(glm::translate(glm::mat4(1.0f), glm::vec3(5, 7, 1)), 0.5f, glm::vec3(0, 0, 1)),
                 glm::vec3(0.001f));
  const TestFolder folder;
  const Object* const objects[]{&object};
  ASSERT_TRUE(write_gltf(folder.path() / "bench.glb", objects, {}));
  expect_valid_gltf(folder.path());
  Errors warnings;
  const Result<Model> again = read_gltf(folder.path() / "bench.glb", warnings);
  ASSERT_TRUE(again) << to_string(again.errors());
  Bounds is = bounds(*again), was = transformed(object.world_from_model, bounds(*model));
  expect_near(glm::dvec3(is.min), glm::dvec3(was.min));
  expect_near(glm::dvec3(is.max), glm::dvec3(was.max));
}

TEST(GltfKinds, AxesAreTurnedByExchangeOfCoordinates) {
  const auto far =
      model_of(box(glm::vec3(4000000.0f, 5000000.0f, 35.25f), glm::vec3(4000001.0f, 5000001.0f, 36.0f)),
               matt(glm::vec3(0.5f)));
  const TestFolder folder;
  ASSERT_TRUE(write_gltf(folder.path() / "far.glb", *far));
  Errors warnings;
  const Result<Model> again = read_gltf(folder.path() / "far.glb", warnings);
  ASSERT_TRUE(again) << to_string(again.errors());
  EXPECT_EQ(bounds(*again).min.z, 35.25f);
  EXPECT_EQ(bounds(*again).max.z, 36.0f);
}

}  // namespace
}  // namespace parvis::scene
