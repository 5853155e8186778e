#include "formats/readers/isolated_reader.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "base/test_folder.h"
#include "formats/readers/model_bytes.h"
#include "formats/readers/texture_limit.h"

namespace parvis::formats {
namespace {

std::string bytes_of(const scene::Model& model) {
  std::string bytes(byte_count(model), '\0');
  put_bytes(model, std::as_writable_bytes(std::span(bytes)));
  return bytes;
}

/// A model with something in every list.
scene::Model full_model() {
  scene::Model model;
  model.name = "all";
  model.origin = {85000.0, 447000.0, 1.0};
  model.textures.push_back({"t", Image8(2, 1, 4, 7), false, scene::Wrap::mirror, scene::Wrap::clamp});
  model.materials.push_back(
      {.name = "m", .roughness = 0.3f, .base_colour_texture = 0, .is_mirror_like = true});
  model.materials[0].own_mappings.emplace().normal.takes_second_uvs = true;
  model.nodes.push_back({.name = "arm", .parent = 0, .translation = {1, 2, 3}});
  scene::Part part;
  part.object = "sail";
  part.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  part.mesh.normals.assign(3, {0, -1, 0});
  part.mesh.uvs.assign(3, {0.5f, 0.25f});
  part.mesh.second_uvs.assign(3, {2.0f, 1.0f});
  part.mesh.colours.assign(3, {1.0f, 0.5f, 0.25f, 1.0f});
  part.mesh.indices = {0, 1, 2};
  part.node = 1, part.is_backdrop = true;
  auto deformation = std::make_shared<scene::Deformation>();
  deformation->positions = part.mesh.positions, deformation->normals = part.mesh.normals;
  deformation->targets.push_back({part.mesh.positions, {}});
  deformation->weights = {0.5f};
  part.deformation = deformation;
  model.parts.push_back(part);
  scene::Animation animation{"wave", {}, {}, 2.0f};
  animation.channels.push_back({1,
                                scene::AnimationChannel::Property::scale,
                                scene::Interpolation::step,
                                {0, 2},
                                {glm::vec4(1), glm::vec4(2)}});
  animation.weights.push_back({1, scene::Interpolation::linear, {0}, {{0.5f}}});
  model.animations.push_back(animation);
  model.roads.push_back({{{0, 0, 0}, {9, 0, 0}}, 2, 3, true, 3.5f, 8.0f, {"a.osm", 7, 0}, "street"});
  return model;
}

TEST(ModelBytes, AModelComesBackWhole) {
  const std::string bytes = bytes_of(full_model());
  const Result<scene::Model> back = model_of(bytes, "file");
  ASSERT_TRUE(back.ok()) << to_string(back.errors());
  EXPECT_EQ(bytes_of(*back), bytes);
  EXPECT_EQ(back->roads[0].where.line, 7);
  EXPECT_TRUE(back->parts[0].is_backdrop);
  EXPECT_EQ(back->parts[0].deformation->targets.size(), 1u);
}

TEST(ModelBytes, CutShortAnywhereIsAnError) {
  const std::string bytes = bytes_of(full_model());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(model_of(std::string_view(bytes).substr(0, size), "file")) << size;
}

TEST(ModelBytes, IndicesAndCountsThatLieAreErrors) {
  const auto refuse = [](const char* what, const auto& spoil) {
    scene::Model model = full_model();
    spoil(model);
    EXPECT_FALSE(model_of(bytes_of(model), "file")) << what;
  };
  refuse("index", [](scene::Model& m) { m.parts[0].mesh.indices[1] = 3; });
  refuse("material", [](scene::Model& m) { m.parts[0].material = 1; });
  refuse("node", [](scene::Model& m) { m.parts[0].node = -1; });
  refuse("texture", [](scene::Model& m) { m.materials[0].normal_texture = 1; });
  refuse("circle", [](scene::Model& m) { m.nodes[0].parent = 1; });
  refuse("image", [](scene::Model& m) { m.textures[0].image.width = 1 << 30; });
  refuse("alpha", [](scene::Model& m) { m.materials[0].alpha_mode = scene::Alpha(77); });
  refuse("animated node", [](scene::Model& m) { m.animations[0].channels[0].node = 2; });
  refuse("wraps", [](scene::Model& m) { m.textures[0].wrap_u = scene::Wrap(7); });
  refuse("colours", [](scene::Model& m) { m.parts[0].mesh.colours.pop_back(); });
  refuse("keys", [](scene::Model& m) { m.animations[0].channels[0].times_s.push_back(3); });
  refuse("weights", [](scene::Model& m) { m.animations[0].weights[0].values.clear(); });
}

/// A reader that does whatever the file says.
Result<FileContent> obedient(const std::filesystem::path& file, const ModelReading& reading,
                             Errors& warnings) {
  std::string order;
  std::ifstream(file) >> order;
  if (order == "crash") std::abort();
  if (order == "exit") std::exit(0);
  if (order == "throw") throw std::runtime_error("thrown");
  if (order == "escape") {
    std::string secret;
    std::ifstream(file.parent_path().parent_path() / "secret") >> secret;
    if (!secret.empty()) return error("read {}", secret);
  }
  if (order == "write" && std::ofstream(file.parent_path() / "made")) return error("wrote");
  if (order == "refuse") return error_at({file.string(), 3, 4}, "no good");
  warnings.push_back({"a word", {file.string(), 5, 6}});
  scene::Model model = full_model();
  if (reading.cell_m) model.name = fmt::format("cells of {}", *reading.cell_m);
  scene::FileAccount account("X");
  account.used("sails", 3);
  account.left_out("oars", "they are not drawn", "port");
  account.left_out("oars", "they are not drawn", "starboard");
  return FileContent{std::move(model), std::move(account)};
}

TEST(TextureLimit, WhatNoDriverHoldsIsShownSmallerAndNamed) {
  scene::Model model;
  model.textures.push_back({"wide.png", Image8(max_texture_side * 2, 2, 4, 90)});
  model.textures.push_back({"small.png", Image8(4, 4, 4, 90)});
  scene::FileAccount account("X");
  limit_textures(model, account);
  EXPECT_EQ(model.textures[0].image.width, max_texture_side);
  EXPECT_EQ(model.textures[0].image.height, 1);
  EXPECT_EQ(model.textures[0].image.pixels[5], 90);
  EXPECT_EQ(model.textures[1].image.width, 4);
  EXPECT_NE(account.text().find("wide.png"), std::string::npos);
  EXPECT_EQ(account.count(scene::Fate::left_out), 1u);
}

TEST(IsolatedReader, WhateverAReaderDoesIsAModelOrAnError) {
  const TestFolder folder;
  folder.write("secret", "words");
  const ReadModel read = isolated<obedient>();
  const auto message = [&](const char* order) {
    Errors warnings;
    const Result<FileContent> content = read(folder.write("inner/file.x", order), {}, warnings);
    return content ? content->model.name : to_string(content.errors());
  };
  for (const char* order : {"crash", "exit", "throw"}) {  // the first of them starts the server, too
    EXPECT_NE(message(order).find("file.x"), std::string::npos) << message(order);
    EXPECT_NE(message(order).find(order == std::string("throw") ? "thrown" : "crashed"), std::string::npos);
  }
  EXPECT_NE(message("refuse").find("file.x:3:4: no good"), std::string::npos);
  EXPECT_EQ(message("write").find("wrote"), std::string::npos);
  EXPECT_EQ(message("escape"), "all") << "on a kernel without Landlock";
  Errors warnings;
  const Result<FileContent> content = read(folder.write("inner/file.x", "read"), {.cell_m = 2.5}, warnings);
  ASSERT_TRUE(content.ok());
  EXPECT_EQ(content->model.name, "cells of 2.5");
  const std::vector<scene::AccountLine>& lines = content->account.lines();
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].count, 3u);
  EXPECT_EQ(lines[1].fate, scene::Fate::left_out);
  EXPECT_EQ(lines[1].names, (std::vector<std::string>{"port", "starboard"}));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].where.line, 5);
}

}  // namespace
}  // namespace parvis::formats
