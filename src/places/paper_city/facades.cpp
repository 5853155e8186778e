#include "places/paper_city/facades.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/parallel.h"
#include "base/random.h"
#include "places/paper_city/brick_texture.h"
#include "places/paper_city/model_triangles.h"

namespace parvis::city {

namespace {

constexpr float steepest_roof_z = 0.34f;  // cosine of 70 degrees: above it a surface is roof
constexpr float same_plane_m = 0.25f, same_heading = 0.035f;
constexpr float narrowest_m = 1.6f, lowest_m = 2.3f;  // of a wall with windows

/// Walls of one building in one plane.
using Panel = std::vector<std::size_t>;

std::vector<Panel> panels_of(const std::vector<ModelTriangle>& walls) {
  std::map<std::array<long, 3>, Panel> panels;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const float heading = std::atan2(walls[i].normal.y, walls[i].normal.x);
    const float offset_m = glm::dot(walls[i].normal, walls[i].corners[0]);
    panels[{long(walls[i].building), std::lround(heading / same_heading),
            std::lround(offset_m / same_plane_m)}]
        .push_back(i);
  }
  std::vector<Panel> result;
  result.reserve(panels.size());
  for (auto& [key, panel] : panels) result.push_back(std::move(panel));
  return result;
}

/// Materials 2 i (with windows) and 2 i + 1 (plain) from the first index, of brick colour i.
int add_wall_materials(scene::Model& model) {
  const int first = int(model.materials.size());
  model.materials.resize(model.materials.size() + std::size_t(2 * brick_colour_count));
  std::array<BrickWalls, 2> sheets;
  parallel_for(sheets.size(), [&](std::size_t i) { sheets[i] = brick_wall_pictures(i == 0, 1); });
  for (std::size_t plain = 0; plain < 2; ++plain) {
    const char* name = plain ? "brick wall" : "facade";
    const int normal = add_texture(model, name, std::move(sheets[plain].normal), false);
    const int surface = add_texture(model, name, std::move(sheets[plain].surface), false);
    for (std::size_t i = 0; i < brick_colour_count; ++i) {
      scene::Material& material = model.materials[std::size_t(first) + 2 * i + plain];
      material.name = name;
      material.base_colour = glm::vec3(1.0f), material.roughness = 1.0f, material.metallic = 1.0f;
      material.base_colour_texture = add_texture(model, name, std::move(sheets[plain].colours[i]), true);
      material.normal_texture = normal, material.surface_texture = surface;
      material.relief_m = plain ? 0.0f : canvas_relief_m;
      material.is_double_sided = true;
    }
  }
  return first;
}

void add_panel(DressedParts& parts, const std::vector<ModelTriangle>& walls, const Panel& panel,
               int first_material) {
  const glm::vec3 normal = walls[panel.front()].normal;
  const glm::vec3 along = glm::normalize(glm::vec3(-normal.y, normal.x, 0.0f));
  glm::vec2 low(1e30f), high(-1e30f);
  for (const std::size_t i : panel)
    for (const glm::vec3& corner : walls[i].corners) {
      const glm::vec2 place(glm::dot(corner, along), corner.z);
      low = glm::min(low, place), high = glm::max(high, place);
    }
  const glm::vec2 size = high - low;
  const bool has_windows = size.x >= narrowest_m && size.y >= lowest_m;
  const glm::vec2 fitting =
      glm::max(glm::round(size / glm::vec2(brick_bay_m, brick_storey_m)), glm::vec2(1.0f));
  const glm::vec2 bays = has_windows ? fitting : size / glm::vec2(brick_bay_m, brick_storey_m);

  Random random(walls[panel.front()].building + 1);
  const int colour = random.index(brick_colour_count);
  const glm::vec2 start(float(random.index(brick_bays)),
                        0.0f);  // so that not all begin with the same window
  for (const std::size_t i : panel) {
    const ModelTriangle& wall = walls[i];
    std::array<glm::vec2, 3> uvs;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec2 place = (glm::vec2(glm::dot(wall.corners[k], along), wall.corners[k].z) - low) / size;
      const glm::vec2 in_bays = start + place * bays;
      uvs[k] = {in_bays.x / float(brick_bays), -in_bays.y / float(brick_storeys)};
    }
    parts.add(wall, first_material + 2 * colour + (has_windows ? 0 : 1), uvs);
  }
}

}  // namespace

std::size_t add_facades(scene::Model& model, std::string_view target) {
  const std::vector<ModelTriangle> walls =
      take_triangles(model, target, [](glm::vec3 normal) { return std::abs(normal.z) < steepest_roof_z; });
  if (walls.empty()) return 0;
  const int first_material = add_wall_materials(model);
  DressedParts parts(model, "facade");
  for (const Panel& panel : panels_of(walls)) add_panel(parts, walls, panel, first_material);
  return walls.size();
}

}  // namespace parvis::city
