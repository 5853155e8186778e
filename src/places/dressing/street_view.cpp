#include "places/dressing/street_view.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/bounds.h"
#include "base/parallel.h"
#include "land/roads/road_from_polygons.h"
#include "scene/data/model_parts.h"
#include "scene/data/path.h"

namespace parvis::dressing {
namespace {

constexpr float below_ground_m = 0.5f;  // of a road: there it runs in a tunnel or in a trench
constexpr float eye_m = 1.7f, target_above_eye_m = 1.0f, target_m = 40.0f;
constexpr float blocked_m = 0.9f;        // above the ground: nobody looks over it for long
constexpr float longest_m = 120.0f;      // of a view: farther adds nothing
constexpr float side_m = 25.0f;          // within which a house lines the street
constexpr float closest_m = 2.5f;        // of the eye to a wall
constexpr float shortest_m = 12.0f;      // of a view: else a wall is all there is
constexpr float near_built_m = 30.0f;    // of a spot in the open to what is built
constexpr std::size_t max_spots = 4000;  // in the open
constexpr float road_step_m = 6.0f, open_step_m = 5.0f;
constexpr float max_cells = 4e6f, finest_cell_m = 0.5f;
constexpr float centre_m = 1000.0f;   // of a larger place, where its street is looked for
constexpr float wall_cell_m = 50.0f;  // of the plan on which that part is looked for
constexpr float upright = 0.3f;       // cosine of the normals of walls
constexpr float overview_radius_m = 130.0f;
constexpr int headings = 24;
const glm::vec2 to_sun(-0.6f, -0.8f);  // in the afternoon

/// Obstacles to the view of a person, in plan, and how high they reach.
struct Obstacles {
  scene::Mask mask;
  scene::GroundRaster<float> tops;  ///< of the mask's cells

  void add(glm::ivec2 cell, float top_m) {
    if (!mask.contains(cell.x, cell.y)) return;
    mask.at(cell.x, cell.y) = 1;
    tops.at(cell.x, cell.y) = std::max(tops.at(cell.x, cell.y), top_m);
  }
};

/// A part of the plan, metres.
struct Window {
  glm::vec2 origin, size;
};

/// Square metres of walls in each cell of `grid`, and of the cells before it in both directions (Crow 1984:
/// Summed-area tables). Plants have no walls.
scene::GroundRaster<double> sums_of_walls(const scene::Scene& scene, const scene::GroundGrid& grid) {
  scene::GroundRaster<double> sums({grid.width + 1, grid.height + 1, grid.cell_m, grid.origin}, 0.0);
  for (const scene::Object& object : scene.objects) {
    const std::vector<glm::mat4> pose = scene::rest_pose(*object.model);
    for (const scene::Part& part : object.model->parts) {
      const std::string& name = object.model->materials[std::size_t(part.material)].name;
      if (name == "SolitaryVegetationObject" || name == "PlantCover") continue;
      const glm::mat4 world_from_mesh = object.world_from_model * pose[std::size_t(part.node)];
      const auto corner = [&](std::size_t i) {
        return glm::vec3(world_from_mesh * glm::vec4(part.mesh.positions[part.mesh.indices[i]], 1.0f));
      };
      for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
        const glm::vec3 a = corner(i), area = 0.5f * glm::cross(corner(i + 1) - a, corner(i + 2) - a);
        const glm::ivec2 cell = grid.cell_at(glm::vec2(a));
        if (std::abs(area.z) < upright * glm::length(area) && grid.contains(cell.x, cell.y))
          sums.at(cell.x + 1, cell.y + 1) += double(glm::length(area));
      }
    }
  }
  for (int y = 1; y <= grid.height; ++y)
    for (int x = 1; x <= grid.width; ++x)
      sums.at(x, y) += sums.at(x - 1, y) + sums.at(x, y - 1) - sums.at(x - 1, y - 1);
  return sums;
}

/// The part of a place, a town's centre wide, with the most walls of houses. A smaller place as a whole.
Window window_of_houses(const scene::Scene& scene, const scene::PlaceHeights& place) {
  const scene::GroundGrid& plan = place.heights();
  const glm::vec2 size = plan.cell_m * glm::vec2(plan.width, plan.height);
  if (std::max(size.x, size.y) <= centre_m) return {plan.origin, size};
  const scene::GroundGrid grid{int(std::ceil(size.x / wall_cell_m)), int(std::ceil(size.y / wall_cell_m)),
                               wall_cell_m, plan.origin};
  const scene::GroundRaster<double> sums = sums_of_walls(scene, grid);
  const glm::ivec2 window =
      glm::min(glm::ivec2(int(centre_m / wall_cell_m)), glm::ivec2(grid.width, grid.height));
  glm::ivec2 best(0);
  double most = -1.0;
  for (int y = 0; y + window.y <= grid.height; ++y)
    for (int x = 0; x + window.x <= grid.width; ++x) {
      const double walls = sums.at(x + window.x, y + window.y) - sums.at(x, y + window.y) -
                           sums.at(x + window.x, y) + sums.at(x, y);
      if (walls > most) most = walls, best = {x, y};
    }
  return {grid.origin + wall_cell_m * glm::vec2(best), wall_cell_m * glm::vec2(window)};
}

Obstacles obstacles(const scene::Scene& scene, const scene::PlaceHeights& place) {
  const auto [origin, size] = window_of_houses(scene, place);
  const float cell_m = std::max(finest_cell_m, std::sqrt(size.x * size.y / max_cells));
  const glm::ivec2 cells(glm::ceil(size / cell_m));
  Obstacles found{scene::Mask(cells.x, cells.y, cell_m, origin, 0),
                  scene::GroundRaster<float>(cells.x, cells.y, cell_m, origin, -1e9f)};
  const scene::Mask& mask = found.mask;
  for (const scene::Object& object : scene.objects) {
    const std::vector<glm::mat4> pose = scene::rest_pose(*object.model);
    for (const scene::Part& part : object.model->parts) {
      const glm::mat4 world_from_mesh = object.world_from_model * pose[std::size_t(part.node)];
      for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
        std::vector<glm::vec3> ring(3);
        for (std::size_t k = 0; k < 3; ++k)
          ring[k] =
              glm::vec3(world_from_mesh * glm::vec4(part.mesh.positions[part.mesh.indices[i + k]], 1.0f));
        const float top_m = std::max({ring[0].z, ring[1].z, ring[2].z});
        if (top_m < place.at(glm::vec2(ring[0])) + blocked_m) continue;
        for (std::size_t k = 0; k < 3; ++k) {  // walls have no area in plan
          const glm::vec2 from(ring[k]), to(ring[(k + 1) % 3]);
          const int steps = 1 + int(glm::distance(from, to) / cell_m);
          for (int step = 0; step <= steps; ++step)
            found.add(mask.cell_at(glm::mix(from, to, float(step) / float(steps))), top_m);
        }
        const std::vector<std::vector<glm::vec3>> rings{ring};
        for (const glm::ivec2 cell : scene::cells_inside(mask, rings)) found.add(cell, top_m);
      }
    }
  }
  return found;
}

/// A spot on the ground and a heading.
struct Stand {
  glm::vec2 spot, ahead;
};

class Judge {
 public:
  Judge(const scene::Scene& scene, const scene::PlaceHeights& place)
      : obstacles_(obstacles(scene, place)), to_obstacle_(scene::distances_to(mask_, 1)) {}

  /// Larger is better; negative where nobody can stand.
  float score(const Stand& stand) const {
    const glm::ivec2 cell = mask_.cell_at(stand.spot);
    if (!mask_.contains(cell.x, cell.y) || to_obstacle_.at(cell.x, cell.y) < closest_m) return -1.0f;
    const float length_m = free_m(stand.spot, stand.ahead, longest_m);
    if (length_m < shortest_m) return -1.0f;
    const float lit = 0.5f - 0.5f * glm::dot(stand.ahead, to_sun);
    return std::min(length_m, 80.0f) / 80.0f * (0.02f + lined(stand, length_m) + 0.5f * shown(stand)) *
           (0.6f + 0.4f * lit);
  }

  /// A view from this stand toward the middle of the visible part, as high as to show it whole where
  /// possible.
  View aimed(const Stand& stand, const glm::vec3& eye) const {
    constexpr int rays = 41;
    constexpr float half_angle = 0.6f;
    constexpr float steepest =
        0.13f;  // of a view of 36 degrees in height: the horizon stays in its lower third
    glm::vec2 sum(0.0f);
    float low = 0.0f, high = 0.0f;  // slopes from the eye
    for (int i = 0; i < rays; ++i) {
      const glm::vec2 direction =
          turned(stand.ahead, half_angle * (2.0f * float(i) / float(rays - 1) - 1.0f));
      const float distance = free_m(stand.spot, direction, longest_m);
      const glm::ivec2 cell = mask_.cell_at(stand.spot + distance * direction);
      if (distance >= longest_m || !mask_.contains(cell.x, cell.y)) continue;
      sum += direction / std::max(distance, 10.0f);
      high = std::max(high, (obstacles_.tops.at(cell.x, cell.y) - eye.z) / std::max(distance, 1.0f));
      low = std::min(low, -eye_m / std::max(distance, 1.0f));
    }
    const glm::vec2 ahead = glm::length(sum) > 0.0f ? glm::normalize(sum) : stand.ahead;
    const float slope = std::clamp(0.5f * (low + high), -steepest, steepest);
    return {eye, glm::vec3(stand.spot + target_m * ahead, eye.z + target_m * slope)};
  }

 private:
  static glm::vec2 turned(glm::vec2 direction, float angle) {
    return {direction.x * std::cos(angle) - direction.y * std::sin(angle),
            direction.x * std::sin(angle) + direction.y * std::cos(angle)};
  }

  /// How much of the street ahead has houses, 1: on both sides.
  float lined(const Stand& stand, float length_m) const {
    constexpr std::array looks_m{8.0f, 20.0f, 35.0f, 55.0f};
    const glm::vec2 aside(-stand.ahead.y, stand.ahead.x);
    float fraction = 0.0f;
    for (const float ahead_m : looks_m) {
      if (ahead_m > length_m) break;
      const glm::vec2 at = stand.spot + ahead_m * stand.ahead;
      for (const float side : {-1.0f, 1.0f})
        if (free_m(at, side * aside, side_m) < side_m) fraction += 0.5f / float(looks_m.size());
    }
    return fraction;
  }

  /// How much of the view ends at something near.
  float shown(const Stand& stand) const {
    constexpr int rays = 9;
    constexpr float half_angle = 0.5f;
    int hits = 0;
    for (int i = 0; i < rays; ++i) {
      const glm::vec2 direction =
          turned(stand.ahead, half_angle * (2.0f * float(i) / float(rays - 1) - 1.0f));
      hits += free_m(stand.spot, direction, longest_m) < longest_m;
    }
    return float(hits) / float(rays);
  }

  float free_m(glm::vec2 from, glm::vec2 direction, float up_to_m) const {
    const int steps = int(std::ceil(up_to_m / mask_.cell_m));
    for (int step = 0; step < steps; ++step) {
      const float at = float(step) * mask_.cell_m;
      const glm::ivec2 cell = mask_.cell_at(from + at * direction);
      if (!mask_.contains(cell.x, cell.y)) return up_to_m;
      if (mask_.at(cell.x, cell.y)) return at;
    }
    return up_to_m;
  }

  Obstacles obstacles_;
  const scene::Mask& mask_ = obstacles_.mask;
  scene::GroundRaster<float> to_obstacle_;
};

std::vector<Stand> stands_on(std::span<const scene::Road> roads, const scene::PlaceHeights& place) {
  std::vector<Stand> stands;
  for (const scene::Road& road : roads) {
    if (road.path.size() < 2) continue;
    const scene::MeasuredPath path(road.path);
    const int steps = int(std::lround(path.length() / road_step_m));
    for (int step = 0; step < steps; ++step) {
      const float at = (float(step) + 0.5f) * road_step_m;
      const glm::vec2 ahead(path.direction_at(at)), spot(path.at(at));
      if (!(glm::length(ahead) > 0.5f) || path.at(at).z < place.at(spot) - below_ground_m) continue;
      const glm::vec2 unit = glm::normalize(ahead), right(unit.y, -unit.x);
      stands.push_back({spot + 1.2f * right, unit});
      stands.push_back({spot - 1.2f * right, -unit});
    }
  }
  return stands;
}

/// Spots near what is built, each with all headings.
std::vector<Stand> stands_in_the_open(const scene::PlaceHeights& place) {
  const scene::GroundGrid& plan = place.heights();
  const glm::vec2 size = plan.cell_m * glm::vec2(plan.width, plan.height);
  const scene::GroundRaster<float> to_built = scene::distances_to(place.built(), 1);
  std::vector<glm::vec2> spots;
  const glm::ivec2 steps(glm::ceil(size / open_step_m));
  for (int y = 0; y < steps.y; ++y)
    for (int x = 0; x < steps.x; ++x) {
      const glm::vec2 spot = plan.origin + open_step_m * glm::vec2(x, y);
      const glm::ivec2 cell = to_built.cell_at(spot);
      if (to_built.contains(cell.x, cell.y) && to_built.at(cell.x, cell.y) < near_built_m)
        spots.push_back(spot);
    }
  const std::size_t stride = 1 + spots.size() / max_spots;
  std::vector<Stand> stands;
  for (std::size_t spot = 0; spot < spots.size(); spot += stride)
    for (int i = 0; i < headings; ++i) {
      const float angle = 2.0f * 3.14159265f * float(i) / float(headings);
      stands.push_back({spots[spot], {std::cos(angle), std::sin(angle)}});
    }
  return stands;
}

View view_of(const Stand& stand, const scene::PlaceHeights& place) {
  const glm::vec3 eye(stand.spot, place.at(stand.spot) + eye_m);
  const glm::vec2 ahead = stand.spot + target_m * stand.ahead;
  // Along the street, whether it climbs or falls, but not steeply.
  const float target_z = std::clamp(place.at(ahead) + eye_m, eye.z - 3.0f, eye.z + 3.0f) + target_above_eye_m;
  return {eye, glm::vec3(ahead, target_z)};
}

/// How much detail a house or a thing shows to those who stand in this direction from it: triangles that face
/// them.
std::size_t detail_toward(const scene::Scene& scene, glm::vec2 direction) {
  std::size_t facing = 0;
  for (const scene::Object& object : scene.objects) {
    const std::vector<glm::mat4> pose = scene::rest_pose(*object.model);
    for (const scene::Part& part : object.model->parts) {
      const glm::mat4 world_from_mesh = object.world_from_model * pose[std::size_t(part.node)];
      const auto corner = [&](std::size_t i) {
        return glm::vec3(world_from_mesh * glm::vec4(part.mesh.positions[part.mesh.indices[i]], 1.0f));
      };
      for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
        const glm::vec3 area = glm::cross(corner(i + 1) - corner(i), corner(i + 2) - corner(i));
        facing += glm::dot(glm::vec2(area), direction) > 0.6f * glm::length(area);
      }
    }
  }
  return facing;
}

/// The directions of a box's corners from the eye: the widest to the side of its middle, and the lowest and
/// highest elevation, radians.
struct Extent {
  float aside, low, high;
};

Extent extent_of(const Bounds& bounds, glm::vec3 eye) {
  const glm::vec2 ahead = glm::normalize(glm::vec2(bounds.centre()) - glm::vec2(eye));
  Extent extent{0.0f, 1.5f, -1.5f};
  for (int i = 0; i < 8; ++i) {
    const glm::vec3 corner(i & 1 ? bounds.max.x : bounds.min.x, i & 2 ? bounds.max.y : bounds.min.y,
                           i & 4 ? bounds.max.z : bounds.min.z);
    const glm::vec2 to(glm::vec2(corner) - glm::vec2(eye));
    const float along = glm::dot(to, ahead), across = ahead.x * to.y - ahead.y * to.x;
    const float elevation = std::atan2(corner.z - eye.z, glm::length(to));
    extent.aside = std::max(extent.aside, std::abs(std::atan2(across, along)));
    extent.low = std::min(extent.low, elevation), extent.high = std::max(extent.high, elevation);
  }
  return extent;
}

constexpr float half_width = 0.5f, half_height = 0.3f;  // radians: of 65 degrees at 16:9, less a margin

/// True if a box is in the picture of a camera with the usual field of view.
bool fits(const Bounds& bounds, const View& view) {
  const glm::vec3 ahead = glm::normalize(view.target - view.eye),
                  right = glm::normalize(glm::cross(ahead, glm::vec3(0, 0, 1))),
                  up = glm::cross(right, ahead);
  for (int i = 0; i < 8; ++i) {
    const glm::vec3 to = glm::vec3(i & 1 ? bounds.max.x : bounds.min.x, i & 2 ? bounds.max.y : bounds.min.y,
                                   i & 4 ? bounds.max.z : bounds.min.z) -
                         view.eye;
    const float along = glm::dot(to, ahead);
    if (along <= 0.0f || std::abs(glm::dot(to, right)) > std::tan(half_width) * along ||
        std::abs(glm::dot(to, up)) > std::tan(half_height) * along)
      return false;
  }
  return true;
}

/// A view from this direction in plan, down onto a spot.
View view_from_above(glm::vec3 spot, glm::vec2 toward, float radius_m) {
  return {spot + radius_m * glm::vec3(1.3f * toward, 0.75f), spot};
}

/// A view from so far away in this direction that the whole, from its foot to its top, is in the picture of a
/// camera with the usual field of view.
View facing_view(const Bounds& bounds, glm::vec2 toward, const scene::PlaceHeights& place) {
  constexpr float step = 1.06f;
  constexpr int steps = 40;  // up to twelve radii
  const float radius_m = std::max(0.25f, bounds.radius());
  View view;
  float radii = 1.2f;
  for (int i = 0; i < steps; ++i, radii *= step) {
    const glm::vec2 spot = glm::vec2(bounds.centre()) + radii * radius_m * toward;
    const float height_m = std::min(eye_m, std::max(1.5f * bounds.size().z, 0.3f));
    view.eye = glm::vec3(spot, place.at(spot) + height_m);
    const Extent extent = extent_of(bounds, view.eye);
    const float middle = 0.5f * (extent.low + extent.high);
    view.target = glm::vec3(glm::vec2(bounds.centre()),
                            view.eye.z + radii * radius_m * std::tan(std::clamp(middle, -1.0f, 1.0f)));
    if (extent.aside < half_width && extent.high - extent.low < 2.0f * half_height) break;
  }
  return view;
}

Bounds bounds_of(const scene::Scene& scene) {
  Bounds bounds;
  for (const scene::Object& object : scene.objects)
    bounds.add(transformed(object.world_from_model, scene::bounds(*object.model)));
  return bounds;
}

/// The nearest view from above a spot, in this direction, that shows all of the bounds.
View view_of_all(const Bounds& bounds, glm::vec3 spot, glm::vec2 toward, float smallest_radius_m) {
  constexpr int steps = 90;  // up to four times the radius of a large place
  View view;
  float radius_m = smallest_radius_m;
  for (int i = 0; i < steps; ++i, radius_m *= 1.06f) {
    view = view_from_above(spot, toward, radius_m);
    if (fits(bounds, view)) break;
  }
  return view;
}

}  // namespace

View outside_view(const scene::Scene& scene, const scene::PlaceHeights& place) {
  constexpr int directions = 8;
  const Bounds bounds = bounds_of(scene);
  glm::vec2 toward(0.0f);
  float best = -1.0f;
  for (int i = 0; i < directions; ++i) {
    const float angle = 2.0f * 3.14159265f * (float(i) + 0.5f) / float(directions);
    const glm::vec2 direction(std::cos(angle), std::sin(angle));
    const float lit = 1.0f + 0.5f * glm::dot(direction, to_sun);
    if (const float score = lit * (1.0f + float(detail_toward(scene, direction))); score > best)
      best = score, toward = direction;
  }
  return facing_view(bounds, toward, place);
}

View street_view(const scene::Scene& scene, const scene::PlaceHeights& place,
                 std::span<const scene::Road> roads) {
  constexpr float good_enough = 0.05f;
  const Judge judge(scene, place);
  const std::vector<Stand> stands = roads.empty() ? stands_in_the_open(place) : stands_on(roads, place);
  std::vector<float> scores(stands.size());
  parallel_for(
      stands.size(), [&](std::size_t i) { scores[i] = judge.score(stands[i]); }, 16);
  const auto highest = std::ranges::max_element(scores);
  const float best = scores.empty() ? 0.0f : *highest;
  const Stand* chosen = best > 0.0f ? &stands[std::size_t(highest - scores.begin())] : nullptr;
  if (chosen == nullptr || (roads.empty() && best < good_enough)) return outside_view(scene, place);
  const View along = view_of(*chosen, place);
  return roads.empty() ? judge.aimed(*chosen, along.eye) : along;
}

View overview(const scene::Scene& scene, const scene::PlaceHeights& place, const View& street) {
  const scene::GroundGrid& plan = place.heights();
  Bounds built;
  for (int y = 0; y < plan.height; ++y)
    for (int x = 0; x < plan.width; ++x)
      if (place.built().at(x, y)) built.add(glm::vec3(plan.centre_of({x, y}), place.heights().at(x, y)));
  if (built.empty()) built.add(street.target);
  constexpr float smallest_m = 4.0f;
  const float whole_m = 0.5f * glm::length(glm::vec2(built.size()));
  if (whole_m > overview_radius_m)
    return view_from_above(street.target, glm::normalize(to_sun), overview_radius_m);
  for (const scene::Object& object : scene.objects)  // towers are higher than their plan is wide
    built.max.z =
        std::max(built.max.z, transformed(object.world_from_model, scene::bounds(*object.model)).max.z);
  // Who looks at a house from outside has chosen its richest side.
  const glm::vec3 eye = street.eye;
  const bool is_outside =
      eye.x < built.min.x || eye.x > built.max.x || eye.y < built.min.y || eye.y > built.max.y;
  const glm::vec2 toward = glm::normalize(is_outside ? glm::vec2(eye - built.centre()) : to_sun);
  return view_of_all(built, built.centre(), toward, std::max(whole_m, smallest_m));
}

View land_view(const scene::Scene& scene) {
  const Bounds land = bounds_of(scene);
  return view_of_all(land, land.centre(), glm::normalize(to_sun),
                     0.25f * glm::length(glm::vec2(land.size())));
}

View view_on_land(const scene::Scene& scene, const scene::PlaceHeights& place) {
  const Bounds land = bounds_of(scene);
  const glm::vec2 middle(land.centre()),
      spot = middle + 0.25f * glm::vec2(land.size()) * glm::normalize(to_sun);
  return {glm::vec3(spot, place.at(spot) + eye_m), glm::vec3(middle, place.at(middle) + eye_m)};
}

std::vector<scene::Road> road_surfaces(const scene::Model& model) {
  const std::vector<glm::mat4> model_from_node = scene::rest_pose(model);
  std::vector<scene::RoadPolygon> polygons;
  for (const std::size_t index : scene::matching_parts(model, "*Road*")) {
    const scene::Part& part = model.parts[index];
    const glm::mat4& model_from_mesh = model_from_node[std::size_t(part.node)];
    for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
      scene::RoadPolygon polygon{{{}}, part.object};
      for (std::size_t k = 0; k < 3; ++k)
        polygon.rings[0].emplace_back(model_from_mesh *
                                      glm::vec4(part.mesh.positions[part.mesh.indices[i + k]], 1.0f));
      polygons.push_back(std::move(polygon));
    }
  }
  return scene::roads_from_polygons(polygons);
}

}  // namespace parvis::dressing
