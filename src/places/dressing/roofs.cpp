#include "places/dressing/roofs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/random.h"
#include "places/dressing/cone_sides.h"
#include "places/dressing/cone_tiles.h"
#include "places/dressing/model_triangles.h"
#include "places/dressing/roof_details.h"
#include "synthesis/ground_texture.h"
#include "synthesis/trim_texture.h"

namespace parvis::dressing {
namespace {

using synthesis::SurfacePictures, synthesis::gravel_pictures, synthesis::gravel_sheet_m,
    synthesis::roof_sheet_m, synthesis::roof_tile_pictures;

struct Tint {
  float fraction;  ///< of roofs that have this one or an earlier one
  glm::vec3 colour;
};
constexpr std::array<Tint, 3> flat_tints{
    {{0.45f, {0.26f, 0.29f, 0.34f}}, {0.75f, {0.42f, 0.45f, 0.5f}}, {1.0f, {0.6f, 0.64f, 0.7f}}}};
constexpr std::array<Tint, 4> tile_tints{{{0.4f, {1.0f, 1.0f, 1.0f}},
                                          {0.6f, {0.78f, 0.84f, 0.86f}},
                                          {0.8f, {0.55f, 0.62f, 0.7f}},
                                          {1.0f, {0.36f, 0.5f, 0.66f}}}};

int chosen(std::span<const Tint> tints, float choice) {
  return int(std::find_if(tints.begin(), tints.end(), [&](const Tint& t) { return choice < t.fraction; }) -
             tints.begin());
}

void add_material(scene::Model& model, const char* name, const std::array<int, 3>& textures, glm::vec3 tint) {
  scene::Material material;
  material.name = name, material.base_colour = tint;
  material.roughness = 1.0f, material.metallic = 1.0f;  // factors of the picture
  material.base_colour_texture = textures[0], material.normal_texture = textures[1],
  material.surface_texture = textures[2];
  material.is_double_sided = true;
  model.materials.push_back(std::move(material));
}

std::array<int, 3> add_pictures(scene::Model& model, const char* name, SurfacePictures pictures) {
  return {add_texture(model, name, std::move(pictures.colour), true),
          add_texture(model, name, std::move(pictures.normal), false),
          add_texture(model, name, std::move(pictures.surface), false)};
}

/// Level and up the slope; east and north where there is none.
std::array<glm::vec2, 3> roof_uvs(const ModelTriangle& triangle, bool is_flat, float sheet_m) {
  glm::vec3 along(1.0f, 0.0f, 0.0f), up(0.0f, 1.0f, 0.0f);
  if (!is_flat) {
    const glm::vec3 outward = triangle.normal.z < 0.0f ? -triangle.normal : triangle.normal;
    along = glm::normalize(glm::vec3(-outward.y, outward.x, 0.0f));
    up = glm::cross(outward, along);
  }
  std::array<glm::vec2, 3> uvs;
  for (std::size_t k = 0; k < 3; ++k)
    uvs[k] = glm::vec2(glm::dot(triangle.corners[k], along), -glm::dot(triangle.corners[k], up)) / sheet_m;
  return uvs;
}

}  // namespace

std::size_t add_roofs(scene::Model& model, std::string_view target, bool has_details) {
  const std::vector<ModelTriangle> roofs =
      take_triangles(model, target, [](const scene::Part&, glm::vec3) { return true; });
  if (roofs.empty()) return 0;
  const std::array<int, 3> tiles = add_pictures(model, "roof tiles", roof_tile_pictures(1));
  const std::array<int, 3> gravel = add_pictures(model, "flat roof", gravel_pictures(2));
  const int first_tiled = int(model.materials.size());
  for (const Tint& tint : tile_tints) add_material(model, "roof tiles", tiles, tint.colour);
  const int first_flat = int(model.materials.size());
  for (const Tint& tint : flat_tints) add_material(model, "flat roof", gravel, tint.colour);

  DressedParts parts(model, "RoofSurface");
  const std::vector<std::optional<ConeSide>> cones = cone_sides(roofs);
  for (std::size_t i = 0; i < roofs.size(); ++i) {
    const ModelTriangle& roof = roofs[i];
    const bool flat = is_flat(roof);
    const float choice = Random(roof.building + 1).uniform();
    const int material =
        flat ? first_flat + chosen(flat_tints, choice) : first_tiled + chosen(tile_tints, choice);
    if (const std::optional<ConeSide>& cone = cones[i]; cone && !flat) {
      for (const TiledPiece& piece : cone_tiles(roof, *cone))
        parts.add(piece.triangle, material, piece.uvs, piece.normals);
      continue;
    }
    parts.add(roof, material, roof_uvs(roof, flat, flat ? gravel_sheet_m : roof_sheet_m));
  }
  if (has_details) add_roof_details(model, roofs);
  return roofs.size();
}

}  // namespace parvis::dressing
