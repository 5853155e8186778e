#include "places/paper_city/city_material.h"

#include <functional>
#include <string>
#include <utility>

#include "base/parallel.h"
#include "base/random.h"
#include "places/paper_city/street_plan.h"
#include "synthesis/ground_texture.h"
#include "synthesis/shop_texture.h"
#include "synthesis/trim_texture.h"

namespace parvis::city {
namespace {

struct Sheet {
  std::string name;
  std::function<synthesis::SurfacePictures(std::uint32_t seed)> paint;
};

/// All sheets in the order of `first_texture` below.
std::vector<Sheet> all_sheets() {
  std::vector<Sheet> sheets;
  for (const FacadeStyle& style : facade_styles())
    sheets.push_back({style.name, [&style](std::uint32_t seed) { return facade_pictures(style, seed); }});
  const auto road = [](float width_m, bool parking) {
    return [=](std::uint32_t seed) { return synthesis::road_pictures(width_m, parking, seed); };
  };
  const auto zebra = [](float width_m) {
    return [=](std::uint32_t seed) { return synthesis::zebra_pictures(width_m, seed); };
  };
  sheets.push_back({"ground_floor", synthesis::ground_floor_pictures});
  sheets.push_back({"trim", synthesis::trim_pictures});
  sheets.push_back({"roof_tile", synthesis::roof_tile_pictures});
  sheets.push_back({"roof_zinc", synthesis::roof_zinc_pictures});
  sheets.push_back({"blank_wall", synthesis::blank_wall_pictures});
  sheets.push_back({"railing", [](std::uint32_t) { return synthesis::railing_pictures(); }});
  sheets.push_back({"road_wide", road(wide_road.carriageway_m, true)});
  sheets.push_back({"road_narrow", road(narrow_road.carriageway_m, false)});
  sheets.push_back({"zebra_wide", zebra(wide_road.carriageway_m)});
  sheets.push_back({"zebra_narrow", zebra(narrow_road.carriageway_m)});
  sheets.push_back({"asphalt", synthesis::asphalt_pictures});
  sheets.push_back({"paving", synthesis::paving_pictures});
  sheets.push_back({"lawn", synthesis::lawn_pictures});
  sheets.push_back({"gravel", synthesis::gravel_pictures});
  sheets.push_back({"courtyard", synthesis::courtyard_pictures});
  return sheets;
}

scene::Texture texture(std::string name, Image8 image, bool is_srgb) {
  scene::Texture result;
  result.name = std::move(name), result.image = std::move(image), result.is_srgb = is_srgb;
  return result;
}

/// A material that shows sheet number `sheet`.
scene::Material material(std::string name, int sheet, glm::vec3 tint = glm::vec3(1.0f)) {
  scene::Material m;
  m.name = std::move(name), m.base_colour = tint;
  m.base_colour_texture = 3 * sheet, m.normal_texture = 3 * sheet + 1, m.surface_texture = 3 * sheet + 2;
  m.roughness = 1.0f, m.metallic = 1.0f;  // factors of the texture
  return m;
}

/// The same, of a sheet with windows.
scene::Material recessed(scene::Material m) {
  m.relief_m = synthesis::canvas_relief_m;
  return m;
}

constexpr std::array<glm::vec3, facade_style_count> second_tints{{{1.0f, 0.82f, 0.66f},
                                                                  {0.86f, 0.88f, 0.92f},
                                                                  {1.0f, 0.93f, 0.8f},
                                                                  {0.86f, 0.82f, 0.8f},
                                                                  {0.92f, 0.84f, 0.68f},
                                                                  {0.95f, 1.0f, 0.95f},
                                                                  {1.0f, 0.93f, 0.82f},
                                                                  {0.88f, 0.95f, 0.98f}}};

std::vector<scene::Material> all_materials(const std::vector<Sheet>& sheets) {
  std::vector<scene::Material> materials;
  for (std::size_t style = 0; style < facade_style_count; ++style)
    for (int tint = 0; tint < wall_tints; ++tint)
      materials.push_back(recessed(material(sheets[style].name + (tint == 0 ? "" : "_aged"), int(style),
                                            tint == 0 ? glm::vec3(1.0f) : second_tints[style])));
  int sheet = facade_style_count;
  const auto add_next = [&](const char* name) { materials.push_back(material(name, sheet++)); };
  materials.push_back(recessed(material("ground_floor", sheet++)));
  add_next("trim");
  materials.push_back(material("cloth", sheet - 1));
  materials.back().is_double_sided = true;
  add_next("roof_tile");
  materials.push_back(material("roof_slate", sheet, glm::vec3(0.42f, 0.45f, 0.5f)));
  for (const char* name : {"roof_zinc", "blank_wall", "railing"}) add_next(name);
  materials.back().alpha_mode = scene::Alpha::cutout;
  materials.back().is_double_sided = true;
  for (const char* name : {"road_wide", "road_narrow", "zebra_wide", "zebra_narrow", "asphalt", "paving",
                           "lawn", "gravel", "courtyard"})
    add_next(name);
  return materials;
}

}  // namespace

CityMaterial wall_material(int style, int tint) { return CityMaterial(style * wall_tints + tint); }

std::vector<std::uint32_t> wall_sheet_seeds(std::uint64_t seed) {
  Random random(seed, 11);
  std::vector<std::uint32_t> seeds(facade_style_count + 1);
  for (std::uint32_t& sheet_seed : seeds) sheet_seed = random.next();
  return seeds;
}

void add_city_materials(scene::Model& model, std::uint64_t seed) {
  const std::vector<Sheet> sheets = all_sheets();
  Random random(seed, 11);
  std::vector<std::uint32_t> seeds(sheets.size());
  for (std::uint32_t& sheet_seed : seeds) sheet_seed = random.next();
  std::vector<synthesis::SurfacePictures> painted(sheets.size());
  parallel_for(sheets.size(), [&](std::size_t i) { painted[i] = sheets[i].paint(seeds[i]); });
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    model.textures.push_back(texture(sheets[i].name, std::move(painted[i].colour), true));
    model.textures.push_back(texture(sheets[i].name + "_normal", std::move(painted[i].normal), false));
    model.textures.push_back(texture(sheets[i].name + "_surface", std::move(painted[i].surface), false));
  }
  model.materials = all_materials(sheets);
}

}  // namespace parvis::city
