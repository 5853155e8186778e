#include "places/paper_city/night_lights.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "base/random.h"
#include "places/paper_city/city_buildings.h"
#include "places/paper_city/facade_texture.h"
#include "places/paper_city/ground.h"
#include "places/paper_city/street_furniture.h"
#include "places/paper_city/street_plan.h"
#include "synthesis/shop_texture.h"

namespace parvis::city {
namespace {

constexpr float lit_windows_probability = 0.32f, lit_shops_probability = 0.8f;
constexpr float before_wall_m = 0.012f;
constexpr float lit_shop_reach_m = 130.0f;  // from the main crossing: shops there light the pavement
constexpr int window_tints = 3, shop_sheet = facade_style_count;
/// Radiance of a lit wall behind glass, W/m2/sr weighted by the eye: 12 to 40 cd/m2. Incandescent light, a
/// shaded lamp, daylight tubes.
constexpr std::array<glm::vec3, window_tints> window_light{
    {{0.05f, 0.031f, 0.0135f}, {0.032f, 0.0155f, 0.0055f}, {0.036f, 0.0325f, 0.0265f}}};
constexpr glm::vec3 shop_light{0.036f, 0.0265f, 0.0165f};

/// A lit cell of one side of a house by night; shared by the model and by the lamps before its shops.
struct LitCell {
  const Building* building;
  const Face* face;
  float x0, x1, low, high;  ///< on the face, metres
  glm::vec2 foot, top;      ///< texture coordinates
  bool is_shop;
  int tint;
};

void add_ground_floor(std::vector<LitCell>& cells, const Building& b, std::size_t face_index,
                      Random& random) {
  const Face& face = b.faces[face_index];
  const int shops = (b.shop_strip + int(face_index)) % synthesis::shop_strips;
  const glm::vec2 strip = synthesis::ground_floor_strip(b.has_shops ? shops : synthesis::house_strip);
  const int modules = modules_along(face.width_m, synthesis::shop_module_m),
            first = b.module_offset + 2 * int(face_index);
  for (int i = 0; i < modules; ++i) {
    if (!random.chance(b.has_shops ? lit_shops_probability : lit_windows_probability)) continue;
    const float step = face.width_m / float(modules);
    cells.push_back({&b,
                     &face,
                     step * float(i),
                     step * float(i + 1),
                     0.0f,
                     b.ground_m,
                     {float(first + i) / float(synthesis::shop_modules), strip.x},
                     {float(first + i + 1) / float(synthesis::shop_modules), strip.y},
                     b.has_shops,
                     0});
  }
}

void add_upper_floors(std::vector<LitCell>& cells, const Building& b, const Face& face, Random& random) {
  const float step = face.width_m / float(face.bays);
  for (int floor = 0; floor < b.upper_floors; ++floor)
    for (int bay = 0; bay < face.bays; ++bay) {
      if (!random.chance(lit_windows_probability)) continue;
      const float low = b.ground_m + b.floor_m * float(floor);
      const float u = float(b.bay_offset + bay) / float(facade_bays);
      cells.push_back({&b,
                       &face,
                       step * float(bay),
                       step * float(bay + 1),
                       low,
                       low + b.floor_m,
                       {u, 1.0f - float(floor) / float(facade_floors)},
                       {u + 1.0f / float(facade_bays), 1.0f - float(floor + 1) / float(facade_floors)},
                       false,
                       random.index(window_tints)});
    }
}

std::vector<LitCell> lit_cells(const std::vector<Building>& buildings, std::uint64_t seed) {
  Random random(seed, 23);
  std::vector<LitCell> cells;
  for (const Building& b : buildings)
    for (std::size_t i = 0; i < b.faces.size(); ++i) {
      add_ground_floor(cells, b, i, random);
      add_upper_floors(cells, b, b.faces[i], random);
    }
  return cells;
}

/// Material of sheet `sheet` in tint `tint`; the ground floors' sheet has shops, and rooms behind.
int material_of(int sheet, int tint) { return sheet * window_tints + tint; }

void add_materials(scene::Model& model, std::uint64_t seed) {
  const std::vector<std::uint32_t> seeds = wall_sheet_seeds(seed);
  struct Sheet {
    Image8 glass, normal;
  };
  std::vector<Sheet> sheets(seeds.size());
  parallel_for(sheets.size(), [&](std::size_t i) {
    const bool is_ground = int(i) == shop_sheet;
    const synthesis::SurfaceCanvas canvas =
        is_ground ? synthesis::ground_floor_canvas(seeds[i]) : facade_canvas(facade_styles()[i], seeds[i]);
    sheets[i] = {canvas.lit_glass(2), canvas.pictures(is_ground ? 4 : 2, 8).normal};
  });
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    const std::string name =
        int(i) == shop_sheet ? std::string("lit_ground_floor") : "lit_" + facade_styles()[i].name;
    model.textures.push_back({name, std::move(sheets[i].glass), true});
    model.textures.push_back({name + "_normal", std::move(sheets[i].normal), false});
    for (int tint = 0; tint < window_tints; ++tint) {
      scene::Material m;
      m.name = fmt::format("{}_{}", name, tint);
      m.base_colour = glm::vec3(0.04f), m.roughness = 0.06f;
      m.base_colour_texture = m.emission_texture = int(2 * i);
      m.normal_texture = int(2 * i) + 1, m.relief_m = synthesis::canvas_relief_m;
      m.emission = int(i) == shop_sheet && tint == 0 ? shop_light : window_light[std::size_t(tint)];
      m.alpha_mode = scene::Alpha::cutout;
      model.materials.push_back(std::move(m));
    }
  }
}

/// A tapered tube about the z axis; flat sides would show against the sky.
Mesh post_tube(float low, float high, float low_radius, float high_radius) {
  constexpr std::uint32_t sides = 10;
  Mesh mesh;
  for (std::uint32_t i = 0; i <= sides; ++i) {
    const float turn = 6.2831853f * float(i) / float(sides);
    const glm::vec3 out(std::cos(turn), std::sin(turn), 0.0f);
    const glm::vec3 normal = glm::normalize(out + glm::vec3(0, 0, (low_radius - high_radius) / (high - low)));
    mesh.positions.push_back(low_radius * out + glm::vec3(0, 0, low));
    mesh.positions.push_back(high_radius * out + glm::vec3(0, 0, high));
    for (const float v : {0.0f, 1.0f})
      mesh.normals.push_back(normal), mesh.uvs.push_back({float(i) / float(sides), v});
    if (i < sides)
      mesh.indices.insert(mesh.indices.end(), {2 * i, 2 * i + 2, 2 * i + 3, 2 * i, 2 * i + 3, 2 * i + 1});
  }
  return mesh;
}

constexpr float lantern_m = 4.45f;  // height of its middle, as of the lamps that the city has itself

std::string lamp_at(const char* kind, glm::vec3 at, const char* more) {
  return fmt::format("lamp(position=\"{:.2f} {:.2f} {:.2f}\", {}{})\n", at.x, at.y, at.z, kind, more);
}

std::string street_lamps(const StreetPlan& plan) {
  constexpr const char* lantern = "flux_lm=8000, colour=\"1 0.66 0.3\", reach=24, radius=0.34";
  const std::size_t furnished = furnished_lamps(furniture_triangles(plan));
  std::string text = fmt::format("lamp(of=\"street lamp *\", position=\"0 0 {}\", {})\n", lantern_m, lantern);
  int number = 0;
  for (const glm::vec3& foot : street_lamp_places()) {
    if (std::size_t(number++) < furnished)
      text += lamp_at(lantern, foot + glm::vec3(0, 0, lantern_m), "");
    else
      text += fmt::format(
          "model(name=\"street lamp {}\", file=\"street_lamp.glb\", position=\"{:.2f} {:.2f} {:.2f}\")\n",
          number, foot.x, foot.y, foot.z);
  }
  return text + "\n";
}

std::string shop_lamps(const std::vector<LitCell>& cells) {
  std::string text;
  for (const LitCell& cell : cells) {
    if (!cell.is_shop) continue;
    const Frame& f = cell.face->frame;
    const glm::vec3 at = f.point(0.5f * (cell.x0 + cell.x1), -0.35f, 2.3f);
    if (glm::distance(glm::vec2(at), main_crossing()) > lit_shop_reach_m) continue;
    const glm::vec3 out = -f.inward;
    text += lamp_at("flux_lm=1400, colour=\"1 0.76 0.48\", reach=9, radius=0, angle_deg=170, ", at,
                    fmt::format("direction=\"{:.2f} {:.2f} -0.6\"", out.x, out.y).c_str());
  }
  return text + "\n";
}

}  // namespace

scene::Model make_lit_windows(std::uint64_t seed) {
  const StreetPlan plan = make_street_plan(seed);
  const std::vector<Building> buildings = plan_buildings(plan, seed);
  CityMesh mesh;
  for (const LitCell& cell : lit_cells(buildings, seed)) {
    const Block& block = plan.blocks[std::size_t(cell.building->plot.block)];
    mesh.begin_group(fmt::format("windows {}{}", block.column, block.row));
    const Frame& f = cell.face->frame;
    const bool is_ground = cell.low == 0.0f;
    const int sheet = is_ground ? shop_sheet : cell.building->style;
    const int tint = is_ground && !cell.is_shop ? 1 : cell.tint;
    mesh.quad(CityMaterial(material_of(sheet, tint)), f.point(cell.x0, -before_wall_m, cell.low),
              f.point(cell.x1, -before_wall_m, cell.low), f.point(cell.x1, -before_wall_m, cell.high),
              f.point(cell.x0, -before_wall_m, cell.high), cell.foot, cell.top);
  }
  scene::Model model;
  model.name = "lit_windows";
  add_materials(model, seed);
  mesh.move_into(model);
  for (scene::Part& part : model.parts) part.casts_shadow = false;
  return model;
}

scene::Model make_street_lamp() {
  scene::Model model;
  model.name = "street_lamp";
  scene::Material iron, glass;
  iron.name = "iron", iron.base_colour = {0.02f, 0.028f, 0.024f}, iron.roughness = 0.45f;
  glass.name = "glass", glass.base_colour = {0.62f, 0.6f, 0.55f}, glass.roughness = 0.3f;
  model.materials = {iron, glass};
  const auto add = [&](const char* name, const Mesh& mesh, int material) {
    scene::Part part;
    part.object = name, part.mesh = mesh, part.material = material;
    model.parts.push_back(std::move(part));
  };
  Mesh post = post_tube(0.0f, 0.5f, 0.14f, 0.11f);
  append(post, post_tube(0.5f, 4.1f, 0.065f, 0.05f));
  append(post, post_tube(4.1f, 4.2f, 0.05f, 0.13f));
  append(post, post_tube(4.7f, 4.8f, 0.27f, 0.2f));
  append(post, post_tube(4.8f, 5.05f, 0.2f, 0.02f));
  add("post", post, 0);
  add("lantern", post_tube(4.2f, 4.7f, 0.12f, 0.23f), 1);
  return model;
}

std::string night_script(std::uint64_t seed) {
  const StreetPlan plan = make_street_plan(seed);
  const std::vector<Building> buildings = plan_buildings(plan, seed);
  return "// The lamps of the paper's city, generated by `parvis city paper`. They are lit at dusk.\n"
         "model(name=\"lit windows\", file=\"lit_windows.glb\", visible=0)\n\n" +
         street_lamps(plan) +
         "// Vehicles of the traffic have their lights on.\n"
         "lamp(of=\"vehicle *\", part=\"lamp\", direction=\"1 0 -0.07\", angle_deg=50, flux_lm=900, "
         "colour=\"1 0.88 0.68\", reach=32, radius=0.26, shows=\"lit windows\")\n"
         "lamp(of=\"vehicle *\", part=\"tail_lamp\", direction=\"-1 0 -0.1\", angle_deg=150, flux_lm=40, "
         "colour=\"1 0.03 0.01\", reach=6, radius=0.22)\n\n" +
         shop_lamps(lit_cells(buildings, seed));
}

}  // namespace parvis::city
