#include "places/dressing/wall_panels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/gtc/constants.hpp>
#include <map>
#include <span>
#include <unordered_map>

#include "places/dressing/round_walls.h"

namespace parvis::dressing {
namespace {

constexpr float same_plane_m = 0.25f;
constexpr long distinct_headings = 180;  // that count as different, around the circle
constexpr float side_by_side_m = 0.3f;   // surfaces that overlap less are neighbours
constexpr float narrow_m = 2.4f;         // a strip of wall that is no house: it belongs to its neighbour
constexpr float max_top_step_m = 0.6f;   // of the top between two houses
constexpr float foot_step_m = 1.0f;      // of the foot, where the wall stands on a lower roof
constexpr float tiny_m = 0.02f;
constexpr float party_gap_m = 1.2f, party_overlap_m = 0.3f;  // between walls of two houses
constexpr float roof_foot_m = 2.2f;  // a wall whose foot is so far above others nearby stands on a roof
constexpr float min_width_m = 1.6f, min_wall_m = 2.2f;  // of a wall with openings
constexpr float thinnest_m = 2.4f;                      // diameter of a round tower with openings
constexpr float before_wall_m = 0.6f;                   // an opening so near belongs to the wall
constexpr float hash_cell_m = 6.0f;
constexpr std::size_t max_panels = 4000;  // of one wall: triangles may cross all of them

/// A connected part of a wall in the file.
struct Surface {
  std::vector<std::size_t> triangles;
  glm::vec3 normal{0.0f};
  float low = 1e30f, high = -1e30f;        ///< along the wall
  float bottom_m = 1e30f, top_m = -1e30f;  ///< its lowest and its highest point
};

glm::vec3 along_of(glm::vec3 normal) { return glm::normalize(glm::vec3(-normal.y, normal.x, 0.0f)); }

float doubled_area(const ModelTriangle& wall) {
  return glm::length(glm::cross(wall.corners[1] - wall.corners[0], wall.corners[2] - wall.corners[0]));
}

void measure(Surface& surface, const std::vector<ModelTriangle>& walls, glm::vec3 along) {
  for (const std::size_t i : surface.triangles)
    for (const glm::vec3& corner : walls[i].corners) {
      const float place = glm::dot(corner, along);
      surface.low = std::min(surface.low, place), surface.high = std::max(surface.high, place);
      surface.bottom_m = std::min(surface.bottom_m, corner.z);
      surface.top_m = std::max(surface.top_m, corner.z);
    }
}

/// Surfaces by building and plane.
std::vector<std::vector<Surface>> planes_of(const std::vector<ModelTriangle>& walls) {
  std::map<std::size_t, Surface> surfaces;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    Surface& surface = surfaces[walls[i].surface];
    surface.triangles.push_back(i);
    surface.normal += doubled_area(walls[i]) * walls[i].normal;
  }
  std::map<std::pair<std::array<long, 3>, scene::BuildingKind>, std::vector<Surface>> planes;
  const auto file = [&](Surface surface, glm::vec3 normal) {
    const ModelTriangle& first = walls[surface.triangles.front()];
    const float turn = std::atan2(normal.y, normal.x) / glm::two_pi<float>();  // -0.5 and 0.5 both face west
    surface.normal = normal;
    const std::array<long, 3> plane{
        long(first.building),
        (std::lround(turn * float(distinct_headings)) + distinct_headings) % distinct_headings,
        std::lround(glm::dot(normal, first.corners[0]) / same_plane_m)};
    planes[{plane, first.kind}].push_back(std::move(surface));
  };
  for (auto& [id, surface] : surfaces) {
    const float length = glm::length(surface.normal);
    const glm::vec3 mean = length > 0.0f ? surface.normal / length : glm::vec3(0.0f);
    const bool is_plane = std::ranges::all_of(
        surface.triangles, [&](std::size_t i) { return glm::dot(walls[i].normal, mean) > 0.995f; });
    if (is_plane) {
      file(std::move(surface), mean);
    } else {  // several walls that share their corners
      for (const std::size_t i : surface.triangles) file({{i}}, walls[i].normal);
    }
  }
  std::vector<std::vector<Surface>> result;
  result.reserve(planes.size());
  for (auto& [key, plane] : planes) result.push_back(std::move(plane));
  return result;
}

/// Surfaces one above the other, and narrow strips beside as high ones, are one wall.
std::vector<Surface> joined(std::vector<Surface> plane, const std::vector<ModelTriangle>& walls) {
  const glm::vec3 along = along_of(plane.front().normal);
  for (Surface& surface : plane) measure(surface, walls, along);
  std::ranges::sort(plane, {}, &Surface::low);
  std::vector<Surface> result;
  for (Surface& surface : plane) {
    if (!result.empty()) {
      Surface& last = result.back();
      const float overlap_m = std::min(last.high, surface.high) - surface.low;
      const bool is_strip = std::min(last.high - last.low, surface.high - surface.low) < narrow_m &&
                            std::abs(last.top_m - surface.top_m) < 0.5f * max_top_step_m &&
                            overlap_m > -0.05f;
      if (overlap_m > std::min(side_by_side_m, 0.5f * (surface.high - surface.low)) || is_strip) {
        last.triangles.insert(last.triangles.end(), surface.triangles.begin(), surface.triangles.end());
        last.high = std::max(last.high, surface.high), last.top_m = std::max(last.top_m, surface.top_m);
        continue;
      }
    }
    result.push_back(std::move(surface));
  }
  return result;
}

/// Foot and top of a wall at a place along it.
struct Span {
  float low = 1e30f, high = -1e30f;

  bool is_empty() const { return low > high; }
};

/// One span for each place, which ascend.
std::vector<Span> spans_at(const std::vector<float>& places, const Surface& surface,
                           const std::vector<ModelTriangle>& walls, glm::vec3 along) {
  std::vector<Span> spans(places.size());
  for (const std::size_t i : surface.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec3 &a = walls[i].corners[k], &b = walls[i].corners[(k + 1) % 3];
      const float from = glm::dot(a, along), to = glm::dot(b, along);
      const auto first = std::ranges::lower_bound(places, std::min(from, to)),
                 end = std::ranges::lower_bound(places, std::max(from, to));
      for (auto place = first; place != end; ++place) {
        const float z = glm::mix(a.z, b.z, (*place - from) / (to - from));
        Span& span = spans[std::size_t(place - places.begin())];
        span.low = std::min(span.low, z), span.high = std::max(span.high, z);
      }
    }
  return spans;
}

/// Where the outline of a wall has corners.
std::vector<float> break_points(const Surface& surface, const std::vector<ModelTriangle>& walls,
                                glm::vec3 along) {
  std::vector<float> places;
  for (const std::size_t i : surface.triangles)
    for (const glm::vec3& corner : walls[i].corners) places.push_back(glm::dot(corner, along));
  std::ranges::sort(places);
  std::vector<float> kept;
  for (const float place : places)
    if (kept.empty() || place - kept.back() > 2.5f * tiny_m) kept.push_back(place);
  return kept;
}

/// Places just after and just before each two neighbours of break points.
std::vector<float> beside(const std::vector<float>& break_points) {
  std::vector<float> places;
  for (std::size_t i = 0; i + 1 < break_points.size(); ++i)
    places.insert(places.end(), {break_points[i] + tiny_m, break_points[i + 1] - tiny_m});
  return places;
}

/// Gives each panel of a wall, from its low end on, the triangles that it crosses.
void distribute(const Surface& surface, const std::vector<ModelTriangle>& walls, glm::vec3 along,
                std::span<WallPanel> panels) {
  for (const std::size_t i : surface.triangles) {
    const auto [low, high] =
        std::minmax({glm::dot(walls[i].corners[0], along), glm::dot(walls[i].corners[1], along),
                     glm::dot(walls[i].corners[2], along)});
    const auto begin = [](const WallPanel& panel) { return panel.low.x; };
    auto panel = std::ranges::upper_bound(panels.subspan(1), low, {}, begin) - 1;
    panel->triangles.push_back(i);
    for (++panel; panel != panels.end() && panel->low.x < high; ++panel) panel->triangles.push_back(i);
  }
}

/// The wall between two steps of its outline; the whole wall where it has more steps than any house.
void add_panels(Surface surface, const std::vector<ModelTriangle>& walls, std::vector<WallPanel>& panels) {
  const glm::vec3 along = along_of(surface.normal);
  surface.low = 1e30f, surface.high = -1e30f;  // until now along the plane's first surface
  measure(surface, walls, along);
  const std::vector<float> places = break_points(surface, walls, along);
  const std::vector<Span> spans = spans_at(beside(places), surface, walls, along);
  const std::size_t first_panel = panels.size();
  const auto begin = [&](float place) {
    WallPanel& panel = panels.emplace_back();
    panel.normal = glm::normalize(glm::vec3(glm::vec2(surface.normal), 0.0f)), panel.along = along;
    panel.building = walls[surface.triangles.front()].building;
    panel.kind = walls[surface.triangles.front()].kind;
    panel.offset_m = glm::dot(panel.normal, walls[surface.triangles.front()].corners[0]);
    panel.low = {place, 1e30f}, panel.high = {surface.high, -1e30f}, panel.eaves_m = 1e30f;
  };
  Span before;
  const auto lay_out = [&](bool has_steps) {
    panels.erase(panels.begin() + std::ptrdiff_t(first_panel), panels.end());
    begin(surface.low);
    before = {};
    for (std::size_t i = 0; i + 1 < places.size(); ++i) {
      Span left = spans[2 * i], right = spans[2 * i + 1];
      if (left.is_empty()) left = right;  // a gap between surfaces
      if (right.is_empty()) right = left;
      if (left.is_empty()) continue;
      const bool is_step = has_steps && !before.is_empty() &&
                           (std::abs(left.high - before.high) > max_top_step_m ||
                            std::abs(left.low - before.low) > foot_step_m);
      if (is_step) panels.back().high.x = places[i], begin(places[i]);
      WallPanel& panel = panels.back();
      for (const Span& span : {left, right}) {
        panel.low.y = std::min(panel.low.y, span.low), panel.high.y = std::max(panel.high.y, span.high);
        panel.eaves_m = std::min(panel.eaves_m, span.high);
      }
      before = right;
    }
  };
  lay_out(true);
  if (panels.size() - first_panel > max_panels) lay_out(false);
  if (before.is_empty()) {  // narrower than what steps are sought with
    WallPanel& panel = panels.back();
    panel.low.y = surface.bottom_m, panel.high.y = panel.eaves_m = surface.top_m;
  }
  distribute(surface, walls, along, std::span(panels).subspan(first_panel));
}

/// A place on a panel, in plan.
glm::vec2 spot(const WallPanel& panel, float place) {
  return glm::vec2(panel.along) * place + glm::vec2(panel.normal) * panel.offset_m;
}

/// Number of the cell of the plan that a spot lies in.
std::int64_t cell_at(glm::vec2 at) {
  const glm::ivec2 cell(glm::floor(at / hash_cell_m));
  return std::int64_t(cell.x) * 4'000'037 + cell.y;
}

/// Calls see(cell) for the cells that a panel crosses, for some of them more than once.
template <class See>
void for_cells_along(const WallPanel& panel, See&& see) {
  const float length_m = panel.high.x - panel.low.x;
  const int steps = 1 + int(std::min(length_m, 5000.0f) / (0.5f * hash_cell_m));
  for (int step = 0; step <= steps; ++step)
    see(cell_at(spot(panel, glm::mix(panel.low.x, panel.high.x, float(step) / float(steps)))));
}

/// Calls see(cell) for a spot's cell and those around it.
template <class See>
void for_cells_around(glm::vec2 at, See&& see) {
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) see(cell_at(at + hash_cell_m * glm::vec2(x, y)));
}

/// Panels by the cells that they cross.
class PanelPlan {
 public:
  void add(const WallPanel& panel, std::size_t index) {
    for_cells_along(panel, [&](std::int64_t at) {
      std::vector<std::size_t>& cell = cells_[at];
      if (cell.empty() || cell.back() != index) cell.push_back(index);
    });
  }

  /// Calls see(index) for the panels within a cell of a spot, for some of them more than once.
  template <class See>
  void near(glm::vec2 at, See&& see) const {
    for_cells_around(at, [&](std::int64_t around) {
      if (const auto cell = cells_.find(around); cell != cells_.end())
        for (const std::size_t i : cell->second) see(i);
    });
  }

 private:
  std::unordered_map<std::int64_t, std::vector<std::size_t>> cells_;
};

/// A panel stands on the ground if nothing of its building near it stands much lower.
void find_ground(std::vector<WallPanel>& panels) {
  std::map<std::pair<std::int64_t, std::size_t>, float> feet_m;  // the lowest by cell and building
  for (const WallPanel& panel : panels)
    for_cells_along(panel, [&](std::int64_t cell) {
      float& foot_m = feet_m.try_emplace({cell, panel.building}, panel.low.y).first->second;
      foot_m = std::min(foot_m, panel.low.y);
    });
  for (WallPanel& panel : panels) {
    float nearby_m = panel.low.y;
    for_cells_around(spot(panel, 0.5f * (panel.low.x + panel.high.x)), [&](std::int64_t cell) {
      if (const auto foot_m = feet_m.find({cell, panel.building}); foot_m != feet_m.end())
        nearby_m = std::min(nearby_m, foot_m->second);
    });
    panel.stands_on_ground = panel.low.y < nearby_m + roof_foot_m;
  }
}

bool is_on(glm::vec3 opening, const WallPanel& panel) {
  const float place = glm::dot(opening, panel.along);
  return std::abs(glm::dot(opening, panel.normal) - panel.offset_m) < before_wall_m && place > panel.low.x &&
         place < panel.high.x && opening.z > panel.low.y && opening.z < panel.high.y;
}

void find_openings(std::vector<WallPanel>& panels, const std::vector<glm::vec3>& openings) {
  PanelPlan plan;
  for (std::size_t i = 0; i < panels.size(); ++i)
    if (is_large(panels[i])) plan.add(panels[i], i);
  for (const glm::vec3 opening : openings)
    plan.near(glm::vec2(opening), [&](std::size_t i) {
      panels[i].has_openings = panels[i].has_openings || is_on(opening, panels[i]);
    });
  for (const WallPanel& panel : panels)
    if (panel.has_openings) panels[panel.run.first].has_openings = true;
  for (WallPanel& panel : panels) panel.has_openings = panels[panel.run.first].has_openings;
}

/// True if another house's wall stands before most of the panel's lowest storey.
bool is_party_wall(const WallPanel& panel, const std::vector<WallPanel>& panels, const PanelPlan& plan) {
  constexpr int samples = 5;
  const float z = panel.low.y + std::min(1.5f, 0.5f * (panel.high.y - panel.low.y));
  int covered = 0;
  for (int i = 0; i < samples; ++i) {
    const float place = glm::mix(panel.low.x, panel.high.x, (float(i) + 0.5f) / float(samples));
    const glm::vec2 at = spot(panel, place);
    bool is_covered = false;
    plan.near(at, [&](std::size_t k) {
      const WallPanel& other = panels[k];
      if (is_covered || glm::dot(other.normal, panel.normal) > -0.94f) return;
      const float before_m = other.offset_m - glm::dot(glm::vec2(other.normal), at);
      const float beside = glm::dot(at, glm::vec2(other.along));
      is_covered = before_m > -party_gap_m && before_m < party_overlap_m && beside > other.low.x &&
                   beside < other.high.x && z > other.low.y - 1.5f && z < other.high.y;
    });
    covered += is_covered;
  }
  return 2 * covered > samples;
}

void find_party_walls(std::vector<WallPanel>& panels) {
  PanelPlan plan;
  for (std::size_t i = 0; i < panels.size(); ++i) plan.add(panels[i], i);
  for (WallPanel& panel : panels) panel.is_party_wall = is_large(panel) && is_party_wall(panel, panels, plan);
}

}  // namespace

bool is_large(const WallPanel& panel) {
  const float needed_m = panel.run.is_ring ? glm::pi<float>() * thinnest_m : min_width_m;
  return panel.run.length_m >= needed_m && panel.eaves_m - panel.low.y >= min_wall_m;
}

std::vector<WallPanel> wall_panels(const std::vector<ModelTriangle>& walls,
                                   const std::vector<glm::vec3>& openings) {
  std::vector<WallPanel> panels;
  for (std::vector<Surface>& plane : planes_of(walls))
    for (Surface& surface : joined(std::move(plane), walls)) add_panels(std::move(surface), walls, panels);
  find_ground(panels);
  find_runs(panels, walls);
  find_openings(panels, openings);
  find_party_walls(panels);
  return panels;
}

}  // namespace parvis::dressing
