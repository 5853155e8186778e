#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/test_folder.h"
#include "formats/gltf/gltf_reader.h"

namespace parvis::scene {
namespace {

using Json = nlohmann::json;

const std::vector<glm::vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0.5f}};
const std::vector<std::uint32_t> order{0, 1, 2, 2, 1, 3};

/// A mesh of the four corners whose accessors are filled by `views`.
Json described() {
  return {
      {"asset", {{"version", "2.0"}}},
      {"scenes", {{{"nodes", {0}}}}},
      {"nodes", {{{"mesh", 0}}}},
      {"meshes", {{{"name", "leaf"}, {"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
      {"accessors",
       {{{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}},
        {{"componentType", 5125}, {"count", 6}, {"type", "SCALAR"}}}}};
}

Result<Model> read(const Json& json, const std::string& binary) {
  const TestFolder folder;
  folder.write("packed.bin", binary);
  Errors warnings;
  return read_gltf(folder.write("packed.gltf", json.dump()), warnings);
}

std::string packed_by_meshopt(Json& json) {
  std::string vertices(meshopt_encodeVertexBufferBound(4, 12), '\0'),
      indices(meshopt_encodeIndexBufferBound(6, 4), '\0');
  const auto bytes = [](std::string& text) { return reinterpret_cast<unsigned char*>(text.data()); };
  vertices.resize(meshopt_encodeVertexBuffer(bytes(vertices), vertices.size(), corners.data(), 4, 12));
  indices.resize(meshopt_encodeIndexBuffer(bytes(indices), indices.size(), order.data(), 6));
  const auto view = [](std::size_t at, std::size_t length, std::size_t count, std::size_t stride,
                       const char* mode) {
    return Json{{"buffer", 1},
                {"byteLength", count * stride},
                {"extensions",
                 {{"EXT_meshopt_compression",
                   {{"buffer", 0},
                    {"byteOffset", at},
                    {"byteLength", length},
                    {"byteStride", stride},
                    {"count", count},
                    {"mode", mode}}}}}};
  };
  json["extensionsRequired"] = {"EXT_meshopt_compression"};
  json["bufferViews"] = {view(0, vertices.size(), 4, 12, "ATTRIBUTES"),
                         view(vertices.size(), indices.size(), 6, 4, "TRIANGLES")};
  json["buffers"] = {
      {{"uri", "packed.bin"}, {"byteLength", vertices.size() + indices.size()}},
      {{"byteLength", 72}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
  json["accessors"][0]["bufferView"] = 0;
  json["accessors"][1]["bufferView"] = 1;
  return vertices + indices;
}

std::string packed_by_draco(Json& json) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(2);
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  for (std::uint32_t face = 0; face < 2; ++face)
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(face), &corners[order[3 * face]],
                                      &corners[order[3 * face + 1]], &corners[order[3 * face + 2]]);
  draco::EncoderBuffer packed;
  draco::Encoder encoder;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*builder.Finalize(), &packed).ok());
  json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  json["buffers"] = {{{"uri", "packed.bin"}, {"byteLength", packed.size()}}};
  json["bufferViews"] = {{{"buffer", 0}, {"byteLength", packed.size()}}};
  json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", 0}, {"attributes", {{"POSITION", 0}}}};
  return {packed.data(), packed.size()};
}

/// The corners of all triangles, one after the other: compression may number them again.
std::vector<std::vector<float>> triangles(const Mesh& mesh) {
  std::vector<std::vector<float>> all;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    glm::vec3 sum(0.0f);
    for (std::size_t k = 0; k < 3; ++k) sum += mesh.positions[mesh.indices[i + k]];
    all.push_back({sum.x, sum.y, sum.z});
  }
  std::sort(all.begin(), all.end());
  return all;
}

void expect_the_leaf(const Result<Model>& model) {
  ASSERT_TRUE(model) << to_string(model.errors());
  Mesh plain;
  plain.positions = corners;
  plain.indices = order;
  const auto expected = triangles(plain), found = triangles(model->parts.at(0).mesh);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[i][c], expected[i][c], 1e-5f);
}

TEST(GltfCompression, MeshoptBuffersReadAsPlainOnes) {
  Json json = described();
  const std::string binary = packed_by_meshopt(json);
  expect_the_leaf(read(json, binary));
}

TEST(GltfCompression, DracoMeshesReadAsPlainOnes) {
  Json json = described();
  const std::string binary = packed_by_draco(json);
  expect_the_leaf(read(json, binary));
}

std::string told(const Json& json, const std::string& binary) {
  const Result<Model> model = read(json, binary);
  return model ? "" : to_string(model.errors());
}

TEST(GltfCompression, DamagedStreamsAreRefusedByName) {
  Json meshopt = described(), draco = described();
  std::string packed = packed_by_meshopt(meshopt);
  packed[0] = '\x55';
  EXPECT_NE(told(meshopt, packed).find("buffer view 0: its compressed bytes"), std::string::npos);
  Json wrong = meshopt;
  wrong["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["byteStride"] = 13;
  EXPECT_NE(told(wrong, packed).find("4 elements of 13 bytes"), std::string::npos);
  wrong = meshopt;
  wrong["bufferViews"][1]["extensions"]["EXT_meshopt_compression"]["byteLength"] = 4000;
  wrong["bufferViews"].erase(0);
  wrong["accessors"][1]["bufferView"] = 0;
  EXPECT_NE(told(wrong, packed).find("beyond its buffer"), std::string::npos);

  packed = packed_by_draco(draco);
  EXPECT_NE(told(draco, std::string(packed.size(), 'x')).find("mesh \"leaf\": its compressed bytes"),
            std::string::npos);
  draco["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"]["POSITION"] =
      7;
  EXPECT_NE(told(draco, packed).find("no attribute 7"), std::string::npos);
}

TEST(GltfCompression, DamagedStreamsNeverCrash) {
  for (const bool by_draco : {false, true}) {
    Json json = described();
    const std::string packed = by_draco ? packed_by_draco(json) : packed_by_meshopt(json);
    for (std::size_t at = 0; at < packed.size(); ++at)
      for (const char flip : {'\x01', '\x10', '\xff'}) {
        std::string damaged = packed;
        damaged[at] = char(damaged[at] ^ flip);
        (void)read(json, damaged);
      }
  }
}

TEST(GltfCompression, BasisPicturesAreNamedWithWhatToDo) {
  Json json = described();
  const std::string packed = packed_by_meshopt(json);
  json["extensionsRequired"] = {"KHR_texture_basisu", "EXT_meshopt_compression"};
  json["images"] = {{{"uri", "data:image/ktx2;base64,q0tUWCAyMLsNChoK"}}};
  json["textures"] = {{{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}};
  json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  json["meshes"][0]["primitives"][0]["material"] = 0;
  const TestFolder folder;
  folder.write("packed.bin", packed);
  Errors warnings;
  const Result<formats::FileContent> content =
      read_gltf_content(folder.write("packed.gltf", json.dump()), warnings);
  ASSERT_TRUE(content) << to_string(content.errors());
  EXPECT_NE(to_string(warnings).find("PNG or JPEG"), std::string::npos) << to_string(warnings);
  EXPECT_EQ(content->account.count(Fate::left_out, "images"), 1u);
}

}  // namespace
}  // namespace parvis::scene
