#include "formats/meshes/material_change.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/data/model_parts.h"
#include "scene/data/name_pattern.h"

namespace parvis::scene {
namespace {

/// Four unit squares of two triangles beside each other, each over a quarter of a 2x2 picture: red, green /
/// blue, grey.
Model palette_model() {
  Model model;
  Texture texture{.name = "palette", .image = Image8(2, 2, 4, 255)};
  const std::uint8_t colours[4][3] = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {128, 128, 128}};
  for (int i = 0; i < 4; ++i) std::copy_n(colours[i], 3, texture.image.at(i % 2, i / 2));
  model.textures = {texture};
  model.materials = {{.name = "palette", .base_colour = glm::vec3(1.0f), .base_colour_texture = 0}};
  Part part;
  part.object = "body";
  for (std::uint32_t i = 0; i < 4; ++i) {
    const glm::vec2 corner = 0.5f * glm::vec2(i % 2, i / 2);
    for (const glm::vec2 step :
         {glm::vec2(0, 0), glm::vec2(0.5f, 0), glm::vec2(0.5f, 0.5f), glm::vec2(0, 0.5f)}) {
      part.mesh.positions.emplace_back(float(i) + 2 * step.x, 2 * step.y, 0);
      part.mesh.normals.emplace_back(0, 0, 1);
      part.mesh.uvs.push_back(corner + step);
    }
    for (const std::uint32_t index : {0u, 1u, 2u, 0u, 2u, 3u}) part.mesh.indices.push_back(4 * i + index);
  }
  model.parts = {part};
  return model;
}

MaterialMask mask(const char* text) {
  const auto parsed = parse_mask(text, {});
  EXPECT_TRUE(parsed) << text;
  return parsed ? *parsed : MaterialMask();
}

std::size_t change(Model& model, std::vector<MaterialMask> masks, const MaterialChange& how,
                   const char* target = "*") {
  return change_material(model, matching_parts(model, target), masks, how, "changed");
}

/// Area of the triangles whose material is called `name`.
float area_of(const Model& model, const std::string& name) {
  float area = 0.0f;
  for (const Part& part : model.parts) {
    if (model.materials[std::size_t(part.material)].name != name) continue;
    for (std::size_t i = 0; i < part.mesh.indices.size(); i += 3) {
      const glm::vec3 a = part.mesh.positions[part.mesh.indices[i]],
                      b = part.mesh.positions[part.mesh.indices[i + 1]],
                      c = part.mesh.positions[part.mesh.indices[i + 2]];
      area += 0.5f * glm::length(glm::cross(b - a, c - a));
    }
  }
  return area;
}

TEST(MaterialChange, SplitsAPartByColour) {
  Model model = palette_model();
  EXPECT_EQ(change(model, {mask("colour #00FF00 0.05")}, {.roughness = 0.1f}), 2u);
  EXPECT_FLOAT_EQ(area_of(model, "changed"), 1.0f);
  EXPECT_FLOAT_EQ(area_of(model, "palette"), 3.0f);
  EXPECT_EQ(model.triangle_count(), 8u);
  for (const Part& part : model.parts) EXPECT_TRUE(check(part.mesh, part.object));
  EXPECT_EQ(model.parts.size(), 2u);
  EXPECT_EQ(model.parts[0].mesh.positions.size() + model.parts[1].mesh.positions.size(), 16u);
}

TEST(MaterialChange, SplitsByBoxAndByBoxWithColour) {
  Model model = palette_model();
  EXPECT_EQ(change(model, {mask("box 0 0 1 0.5")}, {}), 4u);
  EXPECT_EQ(change(model, {mask("box 0 0 1 0.5 colour #FF0000 0")}, {}), 2u);
  EXPECT_EQ(change(model, {mask("box 0 0 0.5 0.5"), mask("box 0.5 0.5 1 1")}, {}), 4u);
  EXPECT_EQ(change(model, {mask("box 5 5 6 6")}, {}), 0u);
}

TEST(MaterialChange, ToleranceIsTheLargestDifferenceOfAChannel) {
  Model model = palette_model();
  EXPECT_EQ(change(model, {mask("colour #8A8080 0.03")}, {}), 0u);
  EXPECT_EQ(change(model, {mask("colour #8A8080 0.05")}, {}), 2u);
  EXPECT_EQ(change(model, {mask("grey")}, {}), 2u);
  EXPECT_EQ(change(model, {mask("grey 1 box 0 0 1 0.5")}, {}), 4u);
}

TEST(MaterialChange, KeepsThePictureUnlessAColourIsGiven) {
  Model model = palette_model();
  change(model, {}, {.clear_coat = 1.0f});
  EXPECT_EQ(model.materials[std::size_t(model.parts[0].material)].base_colour_texture, 0);
  change(model, {}, {.colour = glm::vec3(0.5f)});
  const Material& plain = model.materials[std::size_t(model.parts[0].material)];
  EXPECT_EQ(plain.base_colour_texture, no_index);
  EXPECT_EQ(plain.clear_coat, 1.0f);
  EXPECT_EQ(model.parts.size(), 1u);
}

TEST(MaterialChange, AMaskedColourIsPaintedTexelByTexel) {
  Model model = palette_model();
  change(model, {mask("colour #00FF00 0.05")}, {.colour = glm::vec3(0.0f), .roughness = 0.1f});
  for (const Part& part : model.parts) {
    const Material& material = model.materials[std::size_t(part.material)];
    const Image8& picture = model.textures[std::size_t(material.base_colour_texture)].image;
    EXPECT_EQ(picture.at(1, 0)[1], 0);    // the green texel is black on both sides of the split
    EXPECT_EQ(picture.at(0, 0)[0], 255);  // the red one as before
  }
  EXPECT_EQ(model.textures[0].image.at(1, 0)[1], 255);  // objects that were not meant keep their picture
  EXPECT_FLOAT_EQ(area_of(model, "changed"), 1.0f);
}

TEST(MaterialChange, APaneThatThePictureCutsOutBecomesGlass) {
  Model model = palette_model();
  model.materials[0].alpha_mode = Alpha::cutout;
  for (const int x : {0, 1}) model.textures[0].image.at(x, 0)[3] = 0;  // red and green are windows
  const MaterialPreset& glass = *std::ranges::find(material_presets(), "glass", &MaterialPreset::name);
  EXPECT_EQ(change(model, {mask("colour #FF0000 0.05")}, glass.change), 2u);
  const Material& pane = model.materials[std::size_t(model.parts[0].material)];
  EXPECT_EQ(pane.alpha_mode, Alpha::opaque);
  const Image8& picture = model.textures[std::size_t(pane.base_colour_texture)].image;
  EXPECT_EQ(picture.at(0, 0)[3], 255);
  EXPECT_EQ(picture.at(1, 0)[3], 0) << "the other window stays open";
  EXPECT_EQ(model.materials[std::size_t(model.parts[1].material)].alpha_mode, Alpha::cutout);
}

TEST(MaterialChange, WithoutAPictureTheMaterialsColourCounts) {
  Model model = palette_model();
  model.materials[0] = {.name = "plain", .base_colour = glm::vec3(1, 0, 0)};
  EXPECT_EQ(change(model, {mask("colour #0000FF")}, {}), 0u);
  EXPECT_EQ(change(model, {mask("colour #FF0000")}, {}), 8u);
}

TEST(MaterialChange, RepeatingPicturesAreFoldedIntoTheUnitSquare) {
  Model model = palette_model();
  for (glm::vec2& uv : model.parts[0].mesh.uvs) uv += glm::vec2(3.0f, -2.0f);
  EXPECT_EQ(change(model, {mask("box 0 0 0.5 0.5 colour #FF0000")}, {}), 2u);
}

TEST(MaterialChange, TargetsObjectsNodesAndMaterialsByPattern) {
  Model model = palette_model();
  model.nodes[0].name = "car-body";
  for (const char* target : {"body", "b?dy", "car-*", "pal*te", "*"})
    EXPECT_EQ(matching_parts(model, target).size(), 1u) << target;
  for (const char* target : {"Body", "bod", "", "body?"})
    EXPECT_TRUE(matching_parts(model, target).empty()) << target;
}

TEST(MaterialMask, RefusesWhatItCannotRead) {
  for (const char* text :
       {"", "  ", "box", "box 0 0 1", "box 1 0 0 1", "box 0 0 1 x", "colour", "colour red", "colour #12345",
        "colour #GG0000", "sphere 1 2 3", "grey 0.1 0.2", "grey grey", "object 3", "box 0 0 1 1 box 0 0 1 1"})
    EXPECT_FALSE(parse_mask(text, {})) << text;
}

TEST(NamePattern, HostilePatternsEnd) {
  std::string pattern, name(2000, 'a');
  for (int i = 0; i < 500; ++i) pattern += "*a";
  EXPECT_FALSE(matches(pattern + "b", name));
  EXPECT_TRUE(matches(pattern, name));
}

TEST(MaterialChange, SolidGlassIsMadeAndTakenAway) {
  Model model = palette_model();
  model.materials[0].alpha_mode = Alpha::blend;
  model.materials[0].base_colour = glm::vec3(0.02f);
  change(model, {}, {.ior = 1.4f, .absorption_per_m = glm::vec3(2.0f)});
  const Material& glass = model.materials[std::size_t(model.parts[0].material)];
  EXPECT_TRUE(glass.refracts());
  EXPECT_EQ(glass.ior, 1.4f);
  EXPECT_EQ(glass.absorption_per_m, glm::vec3(2.0f));
  EXPECT_EQ(glass.alpha_mode, Alpha::opaque);
  EXPECT_TRUE(glass.is_mirror_like);
  EXPECT_EQ(glass.base_colour, glm::vec3(1.0f)) << "where it is open, it is no darker a pane for what it was";
  Model green = palette_model();
  change(green, {}, {.colour = glm::vec3(0, 1, 0), .ior = 1.4f});
  EXPECT_EQ(green.materials[std::size_t(green.parts[0].material)].base_colour, glm::vec3(0, 1, 0));
  for (const MaterialPreset& preset : material_presets()) {
    Model other = model;
    change(other, {}, preset.change);
    EXPECT_EQ(other.materials[std::size_t(other.parts[0].material)].refracts(), preset.name == "solid_glass")
        << preset.name;
  }
}

}  // namespace
}  // namespace parvis::scene
