#include "life/propagation/scene_site.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/parallel.h"
#include "graphics/reference/ray_scene.h"
#include "land/roads/road_data.h"
#include "scene/data/surroundings.h"

namespace parvis::propagation {
namespace {

constexpr float margin_m = 20.0f, roof_cell_m = 1.0f, max_roof_cells = 16e6f;
constexpr float min_roof_m = 2.0f;  // over the ground: lower things are no buildings
constexpr double min_wall_m = 1.5, min_wall_length_m = 1.0;
constexpr float max_slope = 0.26f;  // of a wall's normal: 15 degrees
constexpr double same_line_m = 0.25, same_angle = 1.5 * 3.14159265358979 / 180.0;
constexpr float head_m = 1.2f, min_opening_m = 2.0f;  // over the ground: what begins higher is open below
constexpr double ground_step_m = 4.0, ground_tolerance_m = 0.3;

std::vector<scene::Road> roads_of(const scene::Scene& scene) {
  std::vector<scene::Road> roads;
  for (const scene::PlannedRoad& planned : scene.items<scene::PlannedRoad>()) roads.push_back(planned.road);
  return roads;
}

bool stands(const scene::Scene& scene, const scene::Object& object) {
  return !object.is_dynamic && object.is_visible && !scene::surrounds_place(scene, object);
}

scene::Scene standing(const scene::Scene& scene) {
  scene::Scene still = scene;
  for (scene::Object& object : still.objects) object.is_visible = stands(scene, object);
  return still;
}

bool is_solid_part(const scene::Model& model, const scene::Part& part) {
  return model.materials[std::size_t(part.material)].alpha_mode == scene::Alpha::opaque && !part.is_backdrop;
}

/// G by what a surface is called: CNOSSOS-EU, table 2.5.a.
float factor_named(const std::string& part, const std::string& material) {
  static constexpr const char* loose[]{"gravel", "sand"};
  static constexpr const char* porous[]{"lawn", "grass", "park",  "meadow", "garden", "forest",
                                        "wood", "soil",  "earth", "field",  "hedge",  "plant"};
  std::string words = part + " " + material;
  std::ranges::transform(words, words.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  const auto is_named = [&](const char* word) { return words.find(word) != std::string::npos; };
  return std::ranges::any_of(loose, is_named)    ? float(gravel_factor)
         : std::ranges::any_of(porous, is_named) ? 1.0f
                                                 : 0.0f;
}

std::optional<double> value_at(const scene::HeightRaster& heights, glm::dvec2 place) {
  const glm::ivec2 cell = heights.cell_at(glm::vec2(place));
  if (!heights.contains(cell.x, cell.y) || std::isnan(heights.at(cell.x, cell.y))) return std::nullopt;
  return double(heights.at(cell.x, cell.y));
}

/// Height of the underside over somebody's head, where there is one: the first surface above, if it looks
/// down. NaN in closed buildings, whose roofs look up.
float ceiling_over(const reference::RayScene& rays, glm::vec3 ground) {
  const auto hit = rays.nearest_hit({ground + glm::vec3(0, 0, head_m), {0, 0, 1}, 1e-3f, 1e30f});
  const bool looks_down = hit && reference::facet_normal(*hit->place, hit->triangle).z < 0.0f;
  return looks_down && hit->distance_m > min_opening_m - head_m ? ground.z + head_m + hit->distance_m
                                                                : std::numeric_limits<float>::quiet_NaN();
}

/// A plane in which upright triangles lie: heading of its line in plan, distance from the origin.
using PlaneKey = std::pair<int, int>;

/// A triangle's extent along the line.
struct Span {
  glm::dvec2 a, b;
  double from, to, top, bottom;
};

/// Joins spans that touch and have about the same top, and the same opening below.
void add_walls(std::vector<Span>& spans, const SceneTerrain& terrain, std::vector<Wall>& walls) {
  constexpr double gap_m = 0.3, step_m = 0.5, bin_m = 1.0;
  std::ranges::sort(spans, {}, &Span::from);
  for (std::size_t first = 0; first < spans.size();) {
    std::size_t end = first + 1;
    double to = spans[first].to;
    while (end < spans.size() && spans[end].from <= to + gap_m) to = std::max(to, spans[end++].to);
    const auto run = std::span(spans).subspan(first, end - first);
    first = end;
    const double from = run.front().from, length_m = to - from;
    if (length_m < min_wall_length_m) continue;
    const int bins = std::max(1, int(std::ceil(length_m / bin_m)));
    std::vector<double> tops(std::size_t(bins), -1e30), bottoms(std::size_t(bins), 1e30);
    for (const Span& span : run)
      for (int i = std::max(0, int((span.from - from) / length_m * bins)); i < bins; ++i) {
        const double at = from + length_m * i / bins, next = from + length_m * (i + 1) / bins;
        if (at > span.to - 0.05) break;
        if (next <= span.from + 0.05) continue;
        tops[std::size_t(i)] = std::max(tops[std::size_t(i)], span.top);
        bottoms[std::size_t(i)] = std::min(bottoms[std::size_t(i)], span.bottom);
      }
    const glm::dvec2 begin = run.front().a, last = std::ranges::max_element(run, {}, &Span::to)->b;
    const glm::dvec2 along = glm::normalize(last - begin), aside = 0.7 * glm::dvec2(-along.y, along.x);
    for (int i = 0; i < bins; ++i) {
      const glm::dvec2 middle = glm::mix(begin, last, (i + 0.5) / bins);
      const double head_z = terrain.ground_z(middle) + double(min_opening_m);
      if (bottoms[std::size_t(i)] < head_z || terrain.is_built(middle + aside, head_z) ||
          terrain.is_built(middle - aside, head_z))
        bottoms[std::size_t(i)] = -1e9;
    }
    for (int i = 0; i < bins;) {
      int k = i;
      double top = tops[std::size_t(i)];
      while (k < bins && std::abs(tops[std::size_t(k)] - tops[std::size_t(i)]) < step_m &&
             std::abs(bottoms[std::size_t(k)] - bottoms[std::size_t(i)]) < step_m)
        top = std::max(top, tops[std::size_t(k++)]);
      if (top > -1e29)
        walls.push_back({glm::mix(begin, last, double(i) / bins), glm::mix(begin, last, double(k) / bins),
                         top, top, std::nullopt, bottoms[std::size_t(i)]});
      i = k;
    }
  }
}

}  // namespace

SceneTerrain::SceneTerrain(const scene::Scene& scene) : heights_(scene, roads_of(scene), margin_m) {
  const scene::HeightRaster& ground = heights_.heights();
  const glm::vec2 size = ground.cell_m * glm::vec2(float(ground.width), float(ground.height));
  const float cell_m = std::max(roof_cell_m, std::sqrt(size.x * size.y / max_roof_cells));
  const scene::GroundGrid grid{std::max(1, int(size.x / cell_m)), std::max(1, int(size.y / cell_m)), cell_m,
                               ground.origin};
  constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
  roofs_m_ = ceilings_m_ = scene::HeightRaster(grid, unknown),
  factors_ = scene::GroundRaster<float>(grid, 0.0f);

  const scene::Scene still = standing(scene);
  const reference::RayScene rays(still);
  constexpr float above_m = 3000.0f;
  parallel_for(
      roofs_m_.cells.size(),
      [&](std::size_t i) {
        const glm::vec2 at = grid.centre_of({int(i) % grid.width, int(i) / grid.width});
        reference::Ray ray{glm::vec3(at, above_m), {0, 0, -1}, 1e-4f, 1e30f};
        for (int passed = 0; passed < 64; ++passed) {
          const auto hit = rays.nearest_hit(ray);
          if (!hit) return;
          ray.min_m = hit->distance_m + 1e-3f;
          const reference::PlacedPart& place = *hit->place;
          if (place.is_backdrop || place.material->alpha_mode != scene::Alpha::opaque) continue;
          const float floor_z = heights_.at(at);
          if (const float z = above_m - hit->distance_m; z > floor_z + min_roof_m)
            roofs_m_.cells[i] = z, ceilings_m_.cells[i] = ceiling_over(rays, glm::vec3(at, floor_z));
          else if (std::size_t(place.object) < still.objects.size())
            factors_.cells[i] = factor_named(
                still.objects[std::size_t(place.object)].model->parts[std::size_t(place.part)].object,
                place.material->name);
          return;
        }
      },
      256);
}

double SceneTerrain::ground_factor(glm::dvec2 place) const {
  const glm::ivec2 cell = factors_.cell_at(glm::vec2(place));
  return factors_.contains(cell.x, cell.y) ? double(factors_.at(cell.x, cell.y)) : 0.0;
}

std::optional<double> SceneTerrain::roof_z(glm::dvec2 place) const { return value_at(roofs_m_, place); }

std::optional<double> SceneTerrain::ceiling_z(glm::dvec2 place) const { return value_at(ceilings_m_, place); }

void SceneTerrain::add_breaks(glm::dvec2 from, glm::dvec2 to, std::vector<double>& distances_m) const {
  const double length_m = glm::distance(from, to);
  const int steps = std::clamp(int(std::ceil(length_m / ground_step_m)), 1, 256);
  const auto place = [&](int i) { return glm::mix(from, to, double(i) / steps); };
  // Slope changes where the line would be more than the tolerance off (Douglas and Peucker 1973).
  std::vector<double> heights;
  for (int i = 0; i <= steps; ++i) heights.push_back(ground_z(place(i)));
  const auto split = [&](const auto& self, int first, int last) -> void {
    int farthest = first;
    double off_m = ground_tolerance_m;
    for (int i = first + 1; i < last; ++i) {
      const double on_line = glm::mix(heights[std::size_t(first)], heights[std::size_t(last)],
                                      double(i - first) / (last - first));
      if (const double off = std::abs(heights[std::size_t(i)] - on_line); off > off_m)
        off_m = off, farthest = i;
    }
    if (farthest == first) return;
    distances_m.push_back(length_m * farthest / steps);
    self(self, first, farthest), self(self, farthest, last);
  };
  split(split, 0, steps);
  for (int i = 1; i < steps; ++i)
    if (ground_factor(place(i)) != ground_factor(place(i - 1)))
      distances_m.push_back(length_m * (i - 0.5) / steps);
}

glm::dvec4 SceneTerrain::area() const {
  const scene::HeightRaster& ground = heights_.heights();
  const glm::dvec2 low(ground.origin), size = double(ground.cell_m) * glm::dvec2(ground.width, ground.height);
  return {low + double(margin_m), low + size - double(margin_m)};
}

std::vector<Wall> walls_of(const scene::Scene& scene, const SceneTerrain& terrain) {
  std::map<PlaneKey, std::vector<Span>> planes;
  for (const scene::Object& object : scene.objects) {
    if (!stands(scene, object)) continue;
    const std::vector<glm::mat4> pose = object.pose.empty() ? scene::rest_pose(*object.model) : object.pose;
    for (std::size_t p = 0; p < object.model->parts.size(); ++p) {
      const scene::Part& part = object.model->parts[p];
      if (!is_solid_part(*object.model, part)) continue;
      const glm::mat4 world_from_mesh = object.world_from_model * pose[std::size_t(part.node)];
      const Mesh& mesh = object.mesh(p);
      for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        glm::dvec3 corners[3];
        for (std::size_t k = 0; k < 3; ++k)
          corners[k] = glm::dvec3(world_from_mesh * glm::vec4(mesh.positions[mesh.indices[i + k]], 1.0f));
        const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const double area = glm::length(normal);
        if (!(area > 1e-4) || std::abs(normal.z) > double(max_slope) * area) continue;
        // The line's direction, of one of the two headings.
        glm::dvec2 along = glm::normalize(glm::dvec2(-normal.y, normal.x));
        if (along.x < 0.0 || (along.x == 0.0 && along.y < 0.0)) along = -along;
        Span span{glm::dvec2(corners[0]), glm::dvec2(corners[0]), 1e30, -1e30, -1e30, 1e30};
        for (const glm::dvec3& corner : corners) {
          const double at = glm::dot(along, glm::dvec2(corner));
          if (at < span.from) span.from = at, span.a = corner;
          if (at > span.to) span.to = at, span.b = corner;
          span.top = std::max(span.top, corner.z), span.bottom = std::min(span.bottom, corner.z);
        }
        const double off_m = along.x * span.a.y - along.y * span.a.x;
        planes[{int(std::lround(std::atan2(along.y, along.x) / same_angle)),
                int(std::lround(off_m / same_line_m))}]
            .push_back(span);
      }
    }
  }
  std::vector<Wall> walls;
  for (auto& [key, spans] : planes) add_walls(spans, terrain, walls);
  std::erase_if(walls, [&](const Wall& wall) {
    const glm::dvec2 middle = 0.5 * (wall.a + wall.b);
    return glm::distance(wall.a, wall.b) < 0.5 || wall.top_a < terrain.ground_z(middle) + min_wall_m;
  });
  for (Wall& wall : walls) {
    const glm::dvec2 middle = 0.5 * (wall.a + wall.b), along = glm::normalize(wall.b - wall.a),
                     aside = 1.2 * glm::dvec2(-along.y, along.x);
    const double z = std::max(wall.bottom, terrain.ground_z(middle)) + double(head_m);
    if (!terrain.is_built(middle + aside, z) || !terrain.is_built(middle - aside, z)) {
      Octaves absorption;
      absorption.fill(facade_absorption);
      wall.absorption = absorption;
    }
  }
  return walls;
}

SceneSite site_of(const scene::Scene& scene) {
  SceneSite result;
  result.terrain = std::make_unique<SceneTerrain>(scene);
  result.site = std::make_unique<Site>(*result.terrain, walls_of(scene, *result.terrain));
  return result;
}

}  // namespace parvis::propagation
