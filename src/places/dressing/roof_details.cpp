#include "places/dressing/roof_details.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "base/random.h"
#include "places/dressing/brick_texture.h"

namespace parvis::dressing {
namespace {

using glm::vec2, glm::vec3;

constexpr float same_height_m = 0.3f;
constexpr float min_roof_m2 = 20.0f, large_roof_m2 = 400.0f;  // a shed; an office
constexpr float parapet_m = 0.22f, overhang_m = 0.05f, eaves_fascia_m = 0.12f;

const std::array<vec3, 4> edge_colours{
    {{0.72f, 0.7f, 0.66f}, {0.5f, 0.49f, 0.47f}, {0.3f, 0.31f, 0.33f}, {0.1f, 0.1f, 0.11f}}};
const vec3 pot_colour{0.45f, 0.19f, 0.11f}, plant_colour{0.42f, 0.44f, 0.45f};

vec2 left_of(vec2 along) { return {-along.y, along.x}; }

float area_of(const ModelTriangle& triangle) {
  const auto& c = triangle.corners;
  return 0.5f * glm::length(glm::cross(c[1] - c[0], c[2] - c[0]));
}

/// Roofs by squares of the plan.
class RoofFinder {
 public:
  explicit RoofFinder(const std::vector<ModelTriangle>& roofs) : roofs_(roofs) {
    for (std::size_t i = 0; i < roofs.size(); ++i) {
      const auto& c = roofs[i].corners;
      const glm::ivec2 low = cell_of(glm::min(vec2(c[0]), glm::min(vec2(c[1]), vec2(c[2])))),
                       high = cell_of(glm::max(vec2(c[0]), glm::max(vec2(c[1]), vec2(c[2]))));
      if (long(high.x - low.x + 1) * long(high.y - low.y + 1) > max_cells) continue;  // no roof is so large
      for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) at_[key(x, y)].push_back(i);
    }
  }

  /// Height of the highest roof above or below a point; none where there is no roof.
  std::optional<float> height(vec2 point) const {
    std::optional<float> highest;
    const glm::ivec2 cell = cell_of(point);
    const auto here = at_.find(key(cell.x, cell.y));
    if (here == at_.end()) return highest;
    for (const std::size_t i : here->second)
      if (const std::optional<float> z = height_on(roofs_[i], point); z && (!highest || *z > *highest))
        highest = z;
    return highest;
  }

 private:
  static constexpr float cell_m = 8.0f;
  static constexpr long max_cells = 10'000;

  static glm::ivec2 cell_of(vec2 point) { return glm::ivec2(glm::floor(point / cell_m)); }
  static std::uint64_t key(int x, int y) { return std::uint64_t(std::uint32_t(x)) << 32 | std::uint32_t(y); }

  static std::optional<float> height_on(const ModelTriangle& triangle, vec2 point) {
    const auto& c = triangle.corners;
    const vec2 a(c[0]), u = vec2(c[1]) - a, v = vec2(c[2]) - a, p = point - a;
    const float area = u.x * v.y - u.y * v.x;
    if (std::abs(area) < 1e-6f) return std::nullopt;
    const float s = (p.x * v.y - p.y * v.x) / area, t = (u.x * p.y - u.y * p.x) / area;
    if (s < 0.0f || t < 0.0f || s + t > 1.0f) return std::nullopt;
    return c[0].z + s * (c[1].z - c[0].z) + t * (c[2].z - c[0].z);
  }

  const std::vector<ModelTriangle>& roofs_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> at_;
};

/// The roof on the other side of a flat roof's edge.
enum class Beside { nothing, equal, higher };

/// An edge of a flat roof; the roof is on its left.
struct RoofEdge {
  vec3 from, to;
  Beside beside = Beside::nothing;
  vec2 along() const { return glm::normalize(vec2(to - from)); }
  float length() const { return glm::distance(vec2(from), vec2(to)); }
};

/// The top of a sloping roof.
struct Ridge {
  vec3 from, to;
};

/// Data of the roofs of one building.
struct BuildingRoofs {
  std::vector<RoofEdge> edges;
  Ridge ridge{};  ///< the longest
  float flat_m2 = 0.0f;
  std::size_t largest = 0;  ///< its largest flat triangle
  float largest_m2 = 0.0f;
  int node = 0;
};

using RoundedCorner = std::tuple<long, long, long>;

RoundedCorner corner_of(vec3 p) {
  return {std::lround(p.x / same_point_m), std::lround(p.y / same_point_m), std::lround(p.z / same_point_m)};
}

/// A side of a triangle, as it runs when the roof is seen from above.
struct Side {
  std::size_t triangle;
  vec3 from, to, opposite;
};

std::array<Side, 3> sides_of(const ModelTriangle& triangle, std::size_t index) {
  std::array<vec3, 3> c = triangle.corners;
  if (triangle.normal.z < 0.0f) std::swap(c[1], c[2]);
  return {{{index, c[0], c[1], c[2]}, {index, c[1], c[2], c[0]}, {index, c[2], c[0], c[1]}}};
}

Beside beside(const RoofEdge& edge, const RoofFinder& finder) {
  constexpr float aside_m = 0.15f;
  const vec3 middle = 0.5f * (edge.from + edge.to);
  const std::optional<float> height = finder.height(vec2(middle) - aside_m * left_of(edge.along()));
  if (!height || *height < middle.z - same_height_m) return Beside::nothing;
  return *height > middle.z + same_height_m ? Beside::higher : Beside::equal;
}

std::map<std::size_t, BuildingRoofs> buildings_of(const std::vector<ModelTriangle>& roofs,
                                                  const RoofFinder& finder) {
  std::map<std::pair<RoundedCorner, RoundedCorner>, std::vector<Side>> sides;
  std::map<std::size_t, BuildingRoofs> buildings;
  for (std::size_t i = 0; i < roofs.size(); ++i) {
    BuildingRoofs& building = buildings[roofs[i].building];
    building.node = roofs[i].node;
    if (is_flat(roofs[i])) {
      const float area = area_of(roofs[i]);
      building.flat_m2 += area;
      if (area > building.largest_m2) building.largest = i, building.largest_m2 = area;
    }
    for (const Side& side : sides_of(roofs[i], i))
      sides[std::minmax(corner_of(side.from), corner_of(side.to))].push_back(side);
  }
  constexpr float min_edge_m = 0.3f;
  for (const auto& [ends, shared] : sides) {
    const Side& side = shared.front();
    const ModelTriangle& roof = roofs[side.triangle];
    const float length = glm::distance(vec2(side.from), vec2(side.to));
    if (length < min_edge_m) continue;
    BuildingRoofs& building = buildings[roof.building];
    if (shared.size() == 1 && is_flat(roof)) {
      RoofEdge edge{side.from, side.to};
      edge.beside = beside(edge, finder);
      building.edges.push_back(edge);
    }
    const bool is_ridge =
        shared.size() == 2 && std::ranges::all_of(shared, [&](const Side& s) {
          return !is_flat(roofs[s.triangle]) && s.opposite.z < std::min(s.from.z, s.to.z) - same_height_m;
        });
    if (is_ridge && std::abs(side.from.z - side.to.z) < 0.05f * length &&
        length > glm::distance(building.ridge.from, building.ridge.to))
      building.ridge = {side.from, side.to};
  }
  return buildings;
}

/// Adds flat faces in the model's frame to the parts of one name.
class Builder {
 public:
  Builder(scene::Model& model, const char* object) : parts_(model, object), poses_(scene::rest_pose(model)) {}

  void quad(int node, int material, const std::array<vec3, 4>& corners) {
    const vec3 along = glm::normalize(corners[1] - corners[0]), up = glm::normalize(corners[3] - corners[0]);
    const glm::mat4 node_from_model = glm::inverse(poses_[std::size_t(node)]);
    for (const auto& pick : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
      ModelTriangle triangle;
      std::array<vec2, 3> uvs;
      for (std::size_t k = 0; k < 3; ++k) {
        const vec3 p = corners[std::size_t(pick[k])];
        triangle.corners[k] = p, triangle.corners_in_node[k] = vec3(node_from_model * glm::vec4(p, 1.0f));
        uvs[k] = vec2(glm::dot(p - corners[0], along), -glm::dot(p - corners[0], up)) / uv_m_;
      }
      triangle.node = node;
      parts_.add(triangle, material, uvs);
    }
  }

  /// An upright box without a bottom: its middle in plan, half sizes along `along` and across it.
  void box(int node, int material, vec2 middle, vec2 along, vec2 half, float low, float high) {
    const vec2 u = half.x * along, v = half.y * left_of(along);
    const std::array<vec2, 4> plan{middle - u - v, middle + u - v, middle + u + v, middle - u + v};
    for (std::size_t k = 0; k < 4; ++k) {
      const vec2 a = plan[k], b = plan[(k + 1) % 4];
      quad(node, material, {vec3(a, low), vec3(b, low), vec3(b, high), vec3(a, high)});
    }
    quad(node, material,
         {vec3(plan[0], high), vec3(plan[1], high), vec3(plan[2], high), vec3(plan[3], high)});
  }

  /// Metres that a texture covers.
  void set_sheet(vec2 metres) { uv_m_ = metres; }

 private:
  DressedParts parts_;
  std::vector<glm::mat4> poses_;
  vec2 uv_m_{1.0f};
};

int add_plain_material(scene::Model& model, const char* name, vec3 colour, float roughness) {
  scene::Material material;
  material.name = name, material.base_colour = colour;
  material.roughness = roughness, material.metallic = 0.0f;
  model.materials.push_back(std::move(material));
  return int(model.materials.size()) - 1;
}

/// Materials of what stands on roofs; bricks, which have pictures, where something asks for them.
class Materials {
 public:
  explicit Materials(scene::Model& model) : model_(model) {
    edges = int(model.materials.size());
    for (const vec3 colour : edge_colours) add_plain_material(model, "roof edge", colour, 0.7f);
    pots = add_plain_material(model, "chimney pot", pot_colour, 0.9f);
    plant = add_plain_material(model, "roof plant", plant_colour, 0.5f);
  }

  int bricks() {
    if (bricks_ != scene::no_index) return bricks_;
    BrickWalls walls = brick_wall_pictures(BrickSheet::plain, 5);
    scene::Material material;
    material.name = "chimney", material.roughness = 1.0f, material.metallic = 1.0f;
    material.base_colour_texture = add_texture(model_, "chimney", std::move(walls.colours[0]), true);
    material.normal_texture = add_texture(model_, "chimney", std::move(walls.normal), false);
    material.surface_texture = add_texture(model_, "chimney", std::move(walls.surface), false);
    bricks_ = int(model_.materials.size());
    model_.materials.push_back(std::move(material));
    return bricks_;
  }

  int edges, pots, plant;

 private:
  scene::Model& model_;
  int bricks_ = scene::no_index;
};

/// How far a corner of the parapet's inside lies from the roof's, where one edge comes and another goes.
vec2 mitre(vec2 incoming, vec2 outgoing, float width_m) {
  const vec2 a = left_of(incoming), b = left_of(outgoing);
  const float cosine = glm::dot(a, b);
  return cosine < -0.5f ? width_m * b : width_m * (a + b) / (1.0f + cosine);
}

void add_parapets(const BuildingRoofs& building, float height_m, int material, Builder& builder) {
  std::map<RoundedCorner, vec2> leaving, arriving;  // along the free edges at each corner
  for (const RoofEdge& edge : building.edges)
    if (edge.beside == Beside::nothing)
      leaving.emplace(corner_of(edge.from), edge.along()), arriving.emplace(corner_of(edge.to), edge.along());
  for (const RoofEdge& edge : building.edges) {
    if (edge.beside != Beside::nothing) continue;
    const vec2 along = edge.along();
    const auto before = arriving.find(corner_of(edge.from)), after = leaving.find(corner_of(edge.to));
    const vec2 coming = before == arriving.end() ? along : before->second,
               going = after == leaving.end() ? along : after->second;
    const auto at = [&](const vec3& corner, vec2 in, vec2 out, float inward_m, float up_m) {
      return corner + vec3(mitre(in, out, inward_m), up_m);
    };
    const auto pair = [&](float inward_m, float up_m) {
      return std::pair{at(edge.from, coming, along, inward_m, up_m),
                       at(edge.to, along, going, inward_m, up_m)};
    };
    const auto [a_low, b_low] = pair(-overhang_m, -eaves_fascia_m);
    const auto [a_wall, b_wall] = pair(0.0f, -eaves_fascia_m);
    const auto [a_top, b_top] = pair(-overhang_m, height_m);
    const auto [a_inside, b_inside] = pair(parapet_m, height_m);
    const auto [a_roof, b_roof] = pair(parapet_m, 0.0f);
    builder.quad(building.node, material, {a_wall, b_wall, b_low, a_low});
    builder.quad(building.node, material, {a_low, b_low, b_top, a_top});
    builder.quad(building.node, material, {a_top, b_top, b_inside, a_inside});
    builder.quad(building.node, material, {b_roof, a_roof, a_inside, b_inside});
  }
}

void add_chimney(int node, Materials& materials, vec2 middle, vec2 along, float low, float high,
                 Random& random, Builder& builder) {
  const int flues = 1 + random.index(3);
  const vec2 half(0.22f + 0.17f * float(flues), 0.28f);
  builder.set_sheet(brick_sheet_m(BrickSheet::plain));
  builder.box(node, materials.bricks(), middle, along, half, low, high);
  builder.box(node, materials.edges + 1, middle, along, half + 0.06f, high - 0.02f, high + 0.07f);
  for (int i = 0; i < flues; ++i) {
    const float aside = 0.34f * (float(i) - 0.5f * float(flues - 1));
    builder.box(node, materials.pots, middle + aside * along, along, vec2(0.1f), high + 0.07f, high + 0.45f);
  }
}

/// A place on a flat roof that is roof all round.
bool has_room(vec2 middle, float around_m, float height, const RoofFinder& finder) {
  for (const vec2 step : {vec2(1, 0), vec2(-1, 0), vec2(0, 1), vec2(0, -1)}) {
    const std::optional<float> z = finder.height(middle + around_m * step);
    if (!z || std::abs(*z - height) > same_height_m) return false;
  }
  return true;
}

/// Adds a chimney by the party wall where there is one, else by the longest edge.
void add_flat_chimney(const BuildingRoofs& building, Materials& materials, const RoofFinder& finder,
                      Random& random, Builder& builder) {
  const RoofEdge* best = nullptr;
  const auto rank = [](const RoofEdge& edge) {
    return edge.length() + (edge.beside == Beside::nothing ? 0.0f : 100.0f);
  };
  for (const RoofEdge& edge : building.edges)
    if (edge.length() > 2.0f && (!best || rank(edge) > rank(*best))) best = &edge;
  if (!best) return;
  const float fraction = random.uniform(0.3f, 0.7f), aside_m = best->beside == Beside::nothing ? 1.4f : 0.4f;
  const vec3 at = glm::mix(best->from, best->to, fraction);
  const vec2 middle = vec2(at) + aside_m * left_of(best->along());
  const std::optional<float> z = finder.height(middle);
  if (!z || std::abs(*z - at.z) > same_height_m) return;
  const float high = at.z + random.uniform(0.9f, 1.5f);
  add_chimney(building.node, materials, middle, best->along(), at.z - 0.05f, high, random, builder);
}

/// Adds chimneys by the gable, and on long ridges where the party walls of a row of houses would be.
void add_ridge_chimneys(const BuildingRoofs& building, Materials& materials, Random& random,
                        Builder& builder) {
  vec3 from = building.ridge.from, to = building.ridge.to;
  const float length = glm::distance(from, to), house_m = random.uniform(7.0f, 9.5f);
  if (length < 3.0f) return;
  if (random.chance(0.5f)) std::swap(from, to);
  const vec2 across = left_of(glm::normalize(vec2(to - from)));
  const float first_m = random.uniform(0.7f, 1.1f);
  const int houses = 1 + int(std::max(length - 0.6f - first_m, 0.0f) / house_m);
  for (int house = 0; house < houses; ++house) {
    const vec3 at = glm::mix(from, to, (first_m + float(house) * house_m) / length);
    const float high = at.z + random.uniform(0.6f, 1.1f);
    add_chimney(building.node, materials, vec2(at), across, at.z - 1.2f, high, random, builder);
  }
}

/// Boxes of ventilation.
void add_plant(const BuildingRoofs& building, const ModelTriangle& roof, const Materials& materials,
               const RoofFinder& finder, Random& random, Builder& builder) {
  const vec2 along = glm::normalize(vec2(roof.corners[1] - roof.corners[0]));
  for (int i = 0; i < 3; ++i) {
    const float s = random.uniform(0.15f, 0.45f), t = random.uniform(0.15f, 0.45f);
    const vec3 at = (1.0f - s - t) * roof.corners[0] + s * roof.corners[1] + t * roof.corners[2];
    const float length = random.uniform(0.9f, 2.2f), width = random.uniform(0.7f, 1.3f);
    const float height = random.uniform(0.9f, 1.9f);
    if (has_room(vec2(at), 3.0f, at.z, finder))
      builder.box(building.node, materials.plant, vec2(at), along, {length, width}, at.z - 0.05f,
                  at.z + height);
  }
}

}  // namespace

bool is_flat(const ModelTriangle& roof) {
  constexpr float flattest_tiles_z = 0.985f;  // cosine of 10 degrees
  return std::abs(roof.normal.z) > flattest_tiles_z;
}

void add_roof_details(scene::Model& model, const std::vector<ModelTriangle>& roofs) {
  const RoofFinder finder(roofs);
  const std::map<std::size_t, BuildingRoofs> buildings = buildings_of(roofs, finder);
  if (std::ranges::none_of(buildings, [](const auto& entry) {
        return entry.second.flat_m2 >= min_roof_m2 ||
               glm::distance(entry.second.ridge.from, entry.second.ridge.to) > 0.0f;
      }))
    return;
  Materials materials(model);
  Builder edges(model, "RoofEdge"), chimneys(model, "Chimney"), plant(model, "RoofPlant");
  for (const auto& [number, building] : buildings) {
    Random random(number + 17);
    if (building.flat_m2 >= min_roof_m2) {
      const bool is_large = building.flat_m2 > large_roof_m2;
      const float height = is_large ? random.uniform(0.7f, 1.0f) : random.uniform(0.15f, 0.5f);
      const int colour = random.index(int(edge_colours.size()));
      add_parapets(building, height, materials.edges + colour, edges);
      if (is_large)
        add_plant(building, roofs[building.largest], materials, finder, random, plant);
      else if (random.chance(0.7f))
        add_flat_chimney(building, materials, finder, random, chimneys);
    } else if (random.chance(0.75f)) {
      add_ridge_chimneys(building, materials, random, chimneys);
    }
  }
}

}  // namespace parvis::dressing
