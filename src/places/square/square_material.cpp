#include "places/square/square_material.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/colour.h"
#include "base/parallel.h"
#include "base/random.h"
#include "synthesis/ground_texture.h"
#include "synthesis/noise.h"
#include "synthesis/shop_texture.h"
#include "synthesis/trim_texture.h"
#include "synthesis/wall_texture.h"
#include "synthesis/window_texture.h"

namespace parvis::square {
namespace {

using synthesis::SurfaceCanvas, synthesis::SurfacePictures, synthesis::Texel;

constexpr float wall_sheet_m = 8.16f, setts_sheet_m = 2.4f;  // 24 courses of ashlar; 20 rows of setts
constexpr float window_m = 1.2f, window_height_m = 2.4f;     // as painted

SurfacePictures wall_sheet(synthesis::Wall wall, std::uint32_t seed) {
  SurfaceCanvas canvas(1024, 1024, wall_sheet_m, wall_sheet_m);
  synthesis::paint_wall(canvas, wall, glm::vec3(sheet_albedo), seed);
  return canvas.pictures(2, 4);
}

SurfacePictures window_sheet(std::uint32_t seed) {
  Random random(seed);
  SurfaceCanvas canvas(2048, 512, window_m * float(window_variants), window_height_m);
  for (int i = 0; i < window_variants; ++i) {
    const float x = window_m * float(i);
    synthesis::paint_casement(canvas, {x, 0.0f, x + window_m, window_height_m}, 2, 4,
                              linear_from_srgb8(0xD8, 0xD2, 0xC4) * random.uniform(0.8f, 1.0f), 0.02f,
                              random);
  }
  return canvas.pictures(2, 2);
}

/// A leaf of louvres, grey.
SurfacePictures shutter_sheet(std::uint32_t seed) {
  constexpr float width_m = 0.6f, height_m = 2.2f, stile_m = 0.07f;
  SurfaceCanvas canvas(128, 512, width_m, height_m, synthesis::matt(glm::vec3(sheet_albedo), 0.0f, 0.6f));
  canvas.paint({stile_m, 0.1f, width_m - stile_m, height_m - 0.1f}, [&](float, float y, Texel& t) {
    if (std::abs(y - 0.45f * height_m) < 0.06f) return;
    const float slat = y / 0.05f - std::floor(y / 0.05f);
    t.colour *= 0.42f + 0.62f * slat;
    t.height_m = -0.016f * (1.0f - slat);
  });
  canvas.paint_all([&](float x, float y, Texel& t) {
    t.colour *= 0.86f + 0.28f * synthesis::fractal_noise(
                                    glm::vec2(x, y) / glm::vec2(width_m, height_m) * glm::vec2(4, 14),
                                    {4, 14}, 3, seed);
  });
  return canvas.pictures(1, 2);
}

/// Small stones in rows, each with its own tone, grey.
SurfacePictures setts_sheet(std::uint32_t seed) {
  constexpr int rows = 20, stones = 16;
  SurfaceCanvas canvas(1024, 1024, setts_sheet_m, setts_sheet_m);
  canvas.paint_all([&](float x, float y, Texel& t) {
    const float row = y / setts_sheet_m * rows,
                along = x / setts_sheet_m * stones + (int(row) & 1 ? 0.5f : 0.0f);
    const float ty = row - std::floor(row), tx = along - std::floor(along);
    const float joint = std::min(std::min(tx, 1.0f - tx) * setts_sheet_m / stones,
                                 std::min(ty, 1.0f - ty) * setts_sheet_m / rows);
    const float own = synthesis::lattice_value(int(along) % stones, int(row) % rows, seed);
    const float grain = synthesis::noise(glm::vec2(x, y) / setts_sheet_m * 220.0f, {220, 220}, seed + 1);
    const float in_joint = glm::smoothstep(0.012f, 0.004f, joint);
    t.colour = glm::mix(glm::vec3(sheet_albedo * (0.72f + 0.34f * own) * (0.85f + 0.3f * grain)),
                        glm::vec3(0.3f, 0.28f, 0.25f), in_joint);
    t.height_m = -0.01f * in_joint;
    t.roughness = 0.75f + 0.15f * own;
  });
  return canvas.pictures(2, 4);
}

struct Sheet {
  const char* name;  ///< streets are known by theirs to people who walk (life/crowd)
  glm::vec2 size_m;  ///< that the sheet covers; 0: texture coordinates are its own
  std::function<SurfacePictures(std::uint32_t seed)> paint;
};

std::vector<Sheet> all_sheets() {
  using namespace synthesis;
  const auto square_m = [](float side) { return glm::vec2(side); };
  return {{"plaster", square_m(wall_sheet_m), [](auto seed) { return wall_sheet(Wall::plaster, seed); }},
          {"ashlar", square_m(wall_sheet_m), [](auto seed) { return wall_sheet(Wall::ashlar, seed); }},
          {"window", square_m(0), window_sheet},
          {"shutter", square_m(0), shutter_sheet},
          {"railing", {railing_sheet_m, 1.0f}, [](auto) { return railing_pictures(); }},
          {"shops", square_m(0), ground_floor_pictures},
          {"cloth", square_m(0), trim_pictures},
          {"roof tiles", square_m(roof_sheet_m), roof_tile_pictures},
          {"paving", square_m(paving_sheet_m), paving_pictures},
          {"setts", square_m(setts_sheet_m), setts_sheet},
          {"asphalt", square_m(asphalt_sheet_m), asphalt_pictures},
          {"road_square",
           {carriageway_m, road_sheet_length_m},
           [](auto seed) { return road_pictures(carriageway_m, false, seed); }},
          {"zebra_square", {carriageway_m, zebra_length_m}, [](auto seed) {
             return zebra_pictures(carriageway_m, seed);
           }}};
}

int add_texture(scene::Model& model, std::string name, Image8 image, bool is_srgb) {
  scene::Texture texture;
  texture.name = std::move(name), texture.image = std::move(image), texture.is_srgb = is_srgb;
  model.textures.push_back(std::move(texture));
  return int(model.textures.size()) - 1;
}

}  // namespace

void add_square_materials(scene::Model& model, std::uint64_t seed) {
  const std::vector<Sheet> sheets = all_sheets();
  std::vector<SurfacePictures> painted(sheets.size());
  parallel_for(sheets.size(),
               [&](std::size_t i) { painted[i] = sheets[i].paint(std::uint32_t(seed * 131 + i)); });
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    const std::string name = sheets[i].name;
    scene::Material m;
    m.name = name, m.base_colour = glm::vec3(1.0f), m.roughness = 1.0f, m.metallic = 1.0f;
    m.base_colour_texture = add_texture(model, name, std::move(painted[i].colour), true);
    m.normal_texture = add_texture(model, name + "_normal", std::move(painted[i].normal), false);
    m.surface_texture = add_texture(model, name + "_surface", std::move(painted[i].surface), false);
    if (sheets[i].size_m.x > 0.0f)
      m.texture_from_mesh_uv =
          glm::mat3(1.0f / sheets[i].size_m.x, 0, 0, 0, 1.0f / sheets[i].size_m.y, 0, 0, 0, 1);
    if (name == "shops") m.relief_m = synthesis::canvas_relief_m;
    if (name == "railing") m.alpha_mode = scene::Alpha::cutout;
    m.is_double_sided = name == "railing" || name == "cloth";
    model.materials.push_back(std::move(m));
    if (name == "roof tiles") {
      scene::Material iron;
      iron.name = "iron", iron.base_colour = glm::vec3(0.022f, 0.026f, 0.024f), iron.roughness = 0.45f;
      model.materials.push_back(std::move(iron));
    }
  }
}

}  // namespace parvis::square
