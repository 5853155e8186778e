#include "city/facades.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "base/parallel.h"
#include "base/random.h"
#include "city/brick_texture.h"
#include "scene/material_change.h"

namespace parvis::city {

namespace {

constexpr float steepest_roof_z = 0.34f;  // cosine of 70 degrees: above it a surface is roof
constexpr float same_point_m = 0.02f;
constexpr float same_plane_m = 0.25f, same_heading = 0.035f;
constexpr float narrowest_m = 1.6f, lowest_m = 2.3f;  // of a wall with windows

struct WallTriangle {
  std::array<glm::vec3, 3> corners;  ///< in the model's frame
  glm::vec3 normal{0.0f};            ///< unit
  int node = 0;
  std::array<glm::vec3, 3> corners_in_node;
  std::size_t building = 0;  ///< triangles that hang together have the same
};

/// Takes the wall triangles out of the parts.
std::vector<WallTriangle> take_walls(scene::Model& model, std::span<const std::size_t> parts) {
  const std::vector<glm::mat4> model_from_node = scene::rest_pose(model);
  std::vector<WallTriangle> walls;
  for (const std::size_t index : parts) {
    scene::Part& part = model.parts[index];
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
      WallTriangle wall;
      wall.node = part.node;
      for (std::size_t k = 0; k < 3; ++k) {
        wall.corners_in_node[k] = part.mesh.positions[part.mesh.indices[i + k]];
        wall.corners[k] =
            glm::vec3(model_from_node[std::size_t(part.node)] * glm::vec4(wall.corners_in_node[k], 1.0f));
      }
      const glm::vec3 area = glm::cross(wall.corners[1] - wall.corners[0], wall.corners[2] - wall.corners[0]);
      const float length = glm::length(area);
      if (length > 1e-8f && std::abs(area.z) < steepest_roof_z * length) {
        wall.normal = area / length;
        walls.push_back(wall);
      } else {
        kept.insert(kept.end(), part.mesh.indices.begin() + std::ptrdiff_t(i),
                    part.mesh.indices.begin() + std::ptrdiff_t(i) + 3);
      }
    }
    part.mesh.indices = std::move(kept);
  }
  return walls;
}

/// Numbers the buildings: walls that share a corner belong together.
void find_buildings(std::vector<WallTriangle>& walls) {
  std::vector<std::size_t> parents(walls.size());
  std::iota(parents.begin(), parents.end(), std::size_t(0));
  const auto root = [&](std::size_t i) {
    while (parents[i] != i) i = parents[i] = parents[parents[i]];
    return i;
  };
  std::map<std::array<int, 3>, std::size_t> wall_at;
  for (std::size_t i = 0; i < walls.size(); ++i)
    for (const glm::vec3& corner : walls[i].corners) {
      const glm::ivec3 key(glm::round(corner / same_point_m));
      const auto [known, is_new] = wall_at.try_emplace({key.x, key.y, key.z}, i);
      if (!is_new) parents[root(i)] = root(known->second);
    }
  for (std::size_t i = 0; i < walls.size(); ++i) walls[i].building = root(i);
}

/// Walls of one building in one plane.
using Panel = std::vector<std::size_t>;

std::vector<Panel> panels_of(const std::vector<WallTriangle>& walls) {
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

int add_texture(scene::Model& model, const char* name, Image8 image, bool is_srgb) {
  scene::Texture texture;
  texture.name = name, texture.image = std::move(image), texture.is_srgb = is_srgb;
  model.textures.push_back(std::move(texture));
  return int(model.textures.size()) - 1;
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

/// Parts by node and material.
class WallParts {
 public:
  explicit WallParts(scene::Model& model) : model_(model) {}

  Mesh& mesh(int node, int material) {
    const auto [known, is_new] = parts_.try_emplace({node, material}, model_.parts.size());
    if (is_new) {
      scene::Part part;
      part.object = "facade";
      part.node = node;
      part.material = material;
      model_.parts.push_back(std::move(part));
    }
    return model_.parts[known->second].mesh;
  }

 private:
  scene::Model& model_;
  std::map<std::pair<int, int>, std::size_t> parts_;
};

void add_panel(WallParts& parts, const std::vector<WallTriangle>& walls, const Panel& panel,
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
    const WallTriangle& wall = walls[i];
    Mesh& mesh = parts.mesh(wall.node, first_material + 2 * colour + (has_windows ? 0 : 1));
    const glm::vec3 normal_in_node =
        glm::normalize(glm::cross(wall.corners_in_node[1] - wall.corners_in_node[0],
                                  wall.corners_in_node[2] - wall.corners_in_node[0]));
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec2 place = (glm::vec2(glm::dot(wall.corners[k], along), wall.corners[k].z) - low) / size;
      const glm::vec2 in_bays = start + place * bays;
      mesh.indices.push_back(std::uint32_t(mesh.positions.size()));
      mesh.positions.push_back(wall.corners_in_node[k]);
      mesh.normals.push_back(normal_in_node);
      mesh.uvs.emplace_back(in_bays.x / float(brick_bays), -in_bays.y / float(brick_storeys));
    }
  }
}

}  // namespace

std::size_t add_facades(scene::Model& model, std::string_view target) {
  std::vector<WallTriangle> walls = take_walls(model, scene::matching_parts(model, target));
  if (walls.empty()) return 0;
  find_buildings(walls);
  const int first_material = add_wall_materials(model);
  WallParts parts(model);
  for (const Panel& panel : panels_of(walls)) add_panel(parts, walls, panel, first_material);
  std::erase_if(model.parts, [](const scene::Part& part) { return part.mesh.indices.empty(); });
  return walls.size();
}

}  // namespace parvis::city
