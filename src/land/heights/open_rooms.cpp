#include "land/heights/open_rooms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "base/bounds.h"
#include "base/cut_polygon.h"
#include "base/plan_polygon.h"
#include "land/heights/city_surfaces.h"
#include "scene/data/surroundings.h"

namespace parvis::scene {
namespace {

constexpr float room_m = 3.0f;            // height of a room, in which no land may be seen
constexpr float lies_on_m = 0.02f;        // below a floor: what is nearer would flicker through it
constexpr float min_floor_cos = 0.7f;     // cosine of 45 degrees: stairs and ramps are no floors
constexpr float largest_room_m = 500.0f;  // what is wider is no room's floor
constexpr float smallest_m2 = 1e-5f;      // of what is left beside a floor
constexpr float room_cell_m = 16.0f;
constexpr float farthest_cell = 1e8f;       // meshes may reach farther than cells have numbers
constexpr std::size_t max_floors = 20'000;  // over one triangle of land: more would take too long to cut out

/// A point of the land, in its mesh and in the world.
struct Corner {
  glm::vec3 position, world, normal;
  glm::vec2 uv;
};
using Polygon = std::vector<Corner>;

Corner mix(const Corner& a, const Corner& b, float weight) {
  return {glm::mix(a.position, b.position, weight), glm::mix(a.world, b.world, weight),
          glm::mix(a.normal, b.normal, weight), glm::mix(a.uv, b.uv, weight)};
}

/// A triangle of a floor or a ceiling, counter-clockwise in plan.
struct Level {
  std::array<glm::vec3, 3> corners;
  glm::vec3 normal;

  float height_at(glm::vec2 p) const {
    const glm::vec2 away = p - glm::vec2(corners[0]);
    return corners[0].z - (normal.x * away.x + normal.y * away.y) / normal.z;
  }
};

Bounds bounds_of(const Polygon& polygon) {
  Bounds box;
  for (const Corner& corner : polygon) box.add(corner.world);
  return box;
}

float plan_m2(const Polygon& polygon) {
  float sum = 0.0f;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const glm::vec2 a(polygon[0].world), ab = glm::vec2(polygon[i - 1].world) - a,
                                         ac = glm::vec2(polygon[i].world) - a;
    sum += 0.5f * std::abs(ab.x * ac.y - ab.y * ac.x);
  }
  return sum;
}

bool is_part_of_place(const Scene& scene, const Object& object) {
  return !object.is_dynamic && object.is_visible && !surrounds_place(scene, object);
}

bool is_floor(const std::string& name) {
  return name.starts_with("FloorSurface") || (name.starts_with("IfcSlab") && is_below_ground(name));
}

bool is_ceiling(const std::string& name) { return name.starts_with("CeilingSurface"); }

bool is_land(const Part& part) {
  const std::string name = part.object.substr(0, part.object.find(' '));
  return name == "TINRelief" || name == "LandUse";
}

std::vector<glm::mat4> world_from_parts(const Object& object) {
  const std::vector<glm::mat4> pose = object.pose.empty() ? rest_pose(*object.model) : object.pose;
  std::vector<glm::mat4> matrices;
  matrices.reserve(object.model->parts.size());
  for (const Part& part : object.model->parts)
    matrices.push_back(object.world_from_model * pose[std::size_t(part.node)]);
  return matrices;
}

/// The floors, or the ceilings, of a scene, by cells of the plan.
class Levels {
 public:
  Levels(const Scene& scene, bool (*is_level)(const std::string& name)) {
    for (const Object& object : scene.objects)
      if (is_part_of_place(scene, object)) note(object, is_level);
  }

  bool empty() const { return levels_.empty(); }
  const Level& operator[](std::uint32_t index) const { return levels_[index]; }

  /// Indices of those in the cells that a box touches, in order.
  std::vector<std::uint32_t> near(const Bounds& box) const {
    const glm::ivec2 low = cell_of(glm::vec2(box.min)), high = cell_of(glm::vec2(box.max));
    const glm::i64vec2 size = glm::i64vec2(high - low) + std::int64_t(1);
    std::vector<std::uint32_t> found;
    const auto take = [&](const std::vector<std::uint32_t>& here) {
      found.insert(found.end(), here.begin(), here.end());
    };
    if (size.x * size.y > std::int64_t(cells_.size())) {
      for (const auto& [cell, here] : cells_) take(here);
    } else {
      for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x)
          if (const auto cell = cells_.find(key({x, y})); cell != cells_.end()) take(cell->second);
    }
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

 private:
  static glm::ivec2 cell_of(glm::vec2 point) {
    return glm::ivec2(glm::clamp(glm::floor(point / room_cell_m), -farthest_cell, farthest_cell));
  }
  static std::uint64_t key(glm::ivec2 cell) {
    return std::uint64_t(std::uint32_t(cell.x)) << 32u | std::uint32_t(cell.y);
  }

  void note(const Object& object, bool (*is_level)(const std::string& name)) {
    const std::vector<glm::mat4> world_from_part = world_from_parts(object);
    for (std::size_t i = 0; i < object.model->parts.size(); ++i) {
      const Part& part = object.model->parts[i];
      if (!is_level(part.object)) continue;
      const auto corner = [&](std::size_t k) {
        return glm::vec3(world_from_part[i] * glm::vec4(part.mesh.positions[part.mesh.indices[k]], 1.0f));
      };
      for (std::size_t k = 0; k + 2 < part.mesh.indices.size(); k += 3)
        note({corner(k), corner(k + 1), corner(k + 2)});
    }
  }

  void note(std::array<glm::vec3, 3> corners) {
    glm::vec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    if (!(std::abs(normal.z) > min_floor_cos * glm::length(normal)) || normal.z == 0.0f) return;
    if (normal.z < 0.0f) std::swap(corners[1], corners[2]), normal = -normal;
    Bounds box;
    for (const glm::vec3& corner : corners) box.add(corner);
    if (!(std::max(box.size().x, box.size().y) < largest_room_m)) return;
    const glm::ivec2 low = cell_of(glm::vec2(box.min)), high = cell_of(glm::vec2(box.max));
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x) cells_[key({x, y})].push_back(std::uint32_t(levels_.size()));
    levels_.push_back({corners, normal});
  }

  std::vector<Level> levels_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

bool rises_through(const Polygon& land, const Level& floor) {
  return std::ranges::any_of(land, [&](const Corner& corner) {
    const float above_m = corner.world.z - floor.height_at(glm::vec2(corner.world));
    return above_m > -lies_on_m && above_m < room_m;
  });
}

/// Whether a ceiling lies between the floor and a piece of land above it.
bool is_above_ceiling(const Polygon& land, const Level& floor, const Levels& ceilings) {
  glm::vec3 middle(0.0f);
  for (const Corner& corner : land) middle += corner.world / float(land.size());
  const glm::vec2 place(middle);
  Bounds here;
  here.add(middle);
  return std::ranges::any_of(ceilings.near(here), [&](std::uint32_t index) {
    const Level& ceiling = ceilings[index];
    if (!is_in_triangle(ceiling.corners, place)) return false;
    const float height_m = ceiling.height_at(place);
    return height_m > floor.height_at(place) && height_m < middle.z;
  });
}

bool are_apart(const Bounds& a, const Bounds& b) {
  return a.min.x > b.max.x || a.max.x < b.min.x || a.min.y > b.max.y || a.max.y < b.min.y;
}

/// Divides a piece of land into what lies over a floor, which is returned, and what lies beside it.
Polygon part_over(const Level& floor, Polygon piece, std::vector<Polygon>& beside) {
  for (std::size_t k = 0; k < 3 && piece.size() >= 3; ++k) {
    const glm::vec2 from(floor.corners[k]), along = glm::vec2(floor.corners[(k + 1) % 3]) - from;
    const auto inward = [&](const Corner& corner) {
      const glm::vec2 away = glm::vec2(corner.world) - from;
      return along.x * away.y - along.y * away.x;
    };
    beside.push_back(cut(piece, [&](const Corner& corner) { return -inward(corner); }));
    piece = cut(piece, inward);
  }
  return piece;
}

/// Takes what rises through a floor away from pieces of land; true if that is anything.
bool take_away(std::vector<Polygon>& pieces, const Level& floor, const Levels& ceilings) {
  Bounds around;
  for (const glm::vec3& corner : floor.corners) around.add(corner);
  std::vector<Polygon> kept;
  bool is_changed = false;
  for (Polygon& piece : pieces) {
    std::vector<Polygon> beside;
    Polygon over;
    if (!are_apart(bounds_of(piece), around)) over = part_over(floor, piece, beside);
    if (plan_m2(over) < smallest_m2 || !rises_through(over, floor) ||
        is_above_ceiling(over, floor, ceilings)) {
      kept.push_back(std::move(piece));
      continue;
    }
    is_changed = true;
    for (Polygon& part : beside)
      if (plan_m2(part) > smallest_m2) kept.push_back(std::move(part));
  }
  pieces = std::move(kept);
  return is_changed;
}

void append(Mesh& mesh, const Polygon& piece, bool has_normals, bool has_uvs) {
  const auto first = std::uint32_t(mesh.positions.size());
  for (const Corner& corner : piece) {
    mesh.positions.push_back(corner.position);
    if (has_normals)
      mesh.normals.push_back(glm::length(corner.normal) > 0.0f ? glm::normalize(corner.normal)
                                                               : corner.normal);
    if (has_uvs) mesh.uvs.push_back(corner.uv);
  }
  for (std::uint32_t k = 2; k < piece.size(); ++k)
    mesh.indices.insert(mesh.indices.end(), {first, first + k - 1, first + k});
}

/// The land with the floors cut out; the same mesh where none is below it.
Mesh without_rooms(const Mesh& land, const glm::mat4& world_from_mesh, const Levels& floors,
                   const Levels& ceilings) {
  Mesh result = land;
  result.indices.clear();
  const bool has_normals = !land.normals.empty(), has_uvs = !land.uvs.empty();
  for (std::size_t i = 0; i + 2 < land.indices.size(); i += 3) {
    Polygon triangle;
    for (std::size_t k = i; k < i + 3; ++k) {
      const std::uint32_t index = land.indices[k];
      triangle.push_back(
          {land.positions[index], glm::vec3(world_from_mesh * glm::vec4(land.positions[index], 1.0f)),
           has_normals ? land.normals[index] : glm::vec3(0.0f), has_uvs ? land.uvs[index] : glm::vec2(0.0f)});
    }
    const std::vector<std::uint32_t> below = floors.near(bounds_of(triangle));
    std::vector<Polygon> pieces{std::move(triangle)};
    bool is_changed = false;
    if (below.size() <= max_floors)
      for (const std::uint32_t floor : below) is_changed |= take_away(pieces, floors[floor], ceilings);
    if (!is_changed) {
      result.indices.insert(result.indices.end(),
                            {land.indices[i], land.indices[i + 1], land.indices[i + 2]});
      continue;
    }
    for (const Polygon& piece : pieces) append(result, piece, has_normals, has_uvs);
  }
  return result;
}

}  // namespace

void open_rooms(Scene& scene) {
  const Levels floors(scene, is_floor);
  if (floors.empty()) return;
  const Levels ceilings(scene, is_ceiling);
  for (Object& object : scene.objects) {
    if (!is_part_of_place(scene, object) || std::ranges::none_of(object.model->parts, is_land)) continue;
    const std::vector<glm::mat4> world_from_part = world_from_parts(object);
    std::shared_ptr<Model> changed;
    for (std::size_t i = 0; i < object.model->parts.size(); ++i) {
      const Part& part = object.model->parts[i];
      if (!is_land(part) || floors.near(transformed(world_from_part[i], part.mesh.bounds())).empty())
        continue;
      Mesh opened = without_rooms(part.mesh, world_from_part[i], floors, ceilings);
      if (opened.indices.empty()) continue;  // all of it in rooms: this is no land
      if (!changed) changed = std::make_shared<Model>(*object.model);
      changed->parts[i].mesh = std::move(opened);
    }
    if (changed) object.model = std::move(changed);
  }
}

}  // namespace parvis::scene
