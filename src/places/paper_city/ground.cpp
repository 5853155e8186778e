#include "places/paper_city/ground.h"

#include <array>
#include <cassert>
#include <cmath>

#include "places/paper_city/street_furniture.h"
#include "synthesis/ground_texture.h"

namespace parvis::city {
namespace {

constexpr float corner_radius_m = 4.0f;  // of the kerb

Corner flat(glm::vec2 p, float z, float sheet_m) { return {{p.x, p.y, z}, glm::vec2(p.x, -p.y) / sheet_m}; }

/// A flat polygon as a fan, its texture laid out over the whole city.
void add_flat(CityMesh& mesh, CityMaterial material, const std::vector<glm::vec2>& outline, float z,
              float sheet_m) {
  for (std::size_t i = 2; i < outline.size(); ++i)
    mesh.triangle(material, flat(outline[0], z, sheet_m), flat(outline[i - 1], z, sheet_m),
                  flat(outline[i], z, sheet_m));
}

void add_rectangle(CityMesh& mesh, CityMaterial material, glm::vec2 min, glm::vec2 max, float z,
                   float sheet_m) {
  add_flat(mesh, material, {min, {max.x, min.y}, max, {min.x, max.y}}, z, sheet_m);
}

/// Three points of the kerb round a corner, from the first of the two sides to the second. `out` and `in` are
/// unit directions along the sides: the kerb arrives along `in` and leaves along `out`.
std::array<glm::vec2, 3> kerb_arc(glm::vec2 corner, glm::vec2 in, glm::vec2 out) {
  const glm::vec2 centre = corner + corner_radius_m * (out - in);
  return {corner - corner_radius_m * in, centre - corner_radius_m * glm::normalize(out - in),
          corner + corner_radius_m * out};
}

glm::vec2 side_direction(int side) {
  constexpr std::array<glm::vec2, 4> directions{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  return directions[std::size_t(side % 4)];
}

float pavement_of(const Block& block, int side) {
  const Road* road = block.roads[std::size_t(side % 4)];
  return road ? road->profile.pavement_m : 0.0f;
}

/// Corner i of the kerb's rectangle.
glm::vec2 kerb_corner(const Block& block, int i) {
  const glm::vec2 outward_before = side_direction(i + 2);  // of side i - 1, turned right: away from the block
  const glm::vec2 outward_after = side_direction(i + 3);
  return block.corner(i) + outward_before * pavement_of(block, i + 3) + outward_after * pavement_of(block, i);
}

void add_kerb(CityMesh& mesh, glm::vec2 a, glm::vec2 b) {
  const float length = glm::length(b - a) / synthesis::paving_sheet_m;
  mesh.quad(CityMaterial::paving, glm::vec3(a, 0), glm::vec3(b, 0), glm::vec3(b, kerb_m),
            glm::vec3(a, kerb_m), {0.0f, 0.02f}, {length, 0.0f});
}

/// The pavement of one side of a block, and of the corner at its end.
void add_pavement(CityMesh& mesh, const Block& block, int side) {
  const glm::vec2 along = side_direction(side), next = side_direction(side + 1);
  const bool corner_before = block.has_corner(side), corner_after = block.has_corner(side + 1);
  const float cut = block.is_park ? 0.0f : corner_cut_m;
  const glm::vec2 start =
      corner_before ? kerb_corner(block, side) + corner_radius_m * along : kerb_corner(block, side);
  const glm::vec2 inner_start = block.corner(side) + (corner_before ? cut : 0.0f) * along;
  const glm::vec2 inner_end = block.corner(side + 1) - (corner_after ? cut : 0.0f) * along;
  const auto arc = kerb_arc(kerb_corner(block, side + 1), along, next);
  const glm::vec2 end = corner_after ? arc[0] : kerb_corner(block, side + 1);
  add_flat(mesh, CityMaterial::paving, {start, end, inner_end, inner_start}, kerb_m,
           synthesis::paving_sheet_m);
  add_kerb(mesh, start, end);
  if (!corner_after) return;
  std::vector<glm::vec2> outline{inner_end, arc[0], arc[1], arc[2]};
  if (cut > 0.0f) outline.push_back(block.corner(side + 1) + cut * next);
  add_flat(mesh, CityMaterial::paving, outline, kerb_m, synthesis::paving_sheet_m);
  add_kerb(mesh, arc[0], arc[1]);
  add_kerb(mesh, arc[1], arc[2]);
}

/// Gravel walks round four lawns that meet in the middle.
void add_park(CityMesh& mesh, const Block& block) {
  const float walk = 4.0f;
  const glm::vec2 centre = 0.5f * (block.min + block.max);
  const std::array<float, 6> x{block.min.x,     block.min.x + walk, centre.x - walk,
                               centre.x + walk, block.max.x - walk, block.max.x};
  const std::array<float, 6> y{block.min.y,     block.min.y + walk, centre.y - walk,
                               centre.y + walk, block.max.y - walk, block.max.y};
  for (std::size_t row : {0, 2, 4})
    add_rectangle(mesh, CityMaterial::gravel, {x[0], y[row]}, {x[5], y[row + 1]}, kerb_m,
                  synthesis::gravel_sheet_m);
  for (std::size_t row : {1, 3}) {
    for (std::size_t column : {0, 2, 4})
      add_rectangle(mesh, CityMaterial::gravel, {x[column], y[row]}, {x[column + 1], y[row + 1]}, kerb_m,
                    synthesis::gravel_sheet_m);
    for (std::size_t column : {1, 3})
      add_rectangle(mesh, CityMaterial::lawn, {x[column], y[row]}, {x[column + 1], y[row + 1]}, kerb_m,
                    synthesis::lawn_sheet_m);
  }
}

void add_block(CityMesh& mesh, const Block& block) {
  for (int side = 0; side < 4; ++side)
    if (block.roads[std::size_t(side)]) add_pavement(mesh, block, side);
  if (block.is_park) return add_park(mesh, block);
  // Below the houses the ground ends, out of sight.
  const auto inset = [&](int side) { return block.roads[std::size_t(side)] ? 4.0f : 0.0f; };
  add_rectangle(mesh, CityMaterial::courtyard, block.min + glm::vec2(inset(west), inset(south)),
                block.max - glm::vec2(inset(east), inset(north)), kerb_m, synthesis::courtyard_sheet_m);
}

/// A stretch of carriageway as a strip: `right` and `ahead` are unit vectors, u runs to the right, v
/// backward.
void add_strip(CityMesh& mesh, CityMaterial material, glm::vec2 middle, glm::vec2 right, glm::vec2 ahead,
               float width_m, float length_m, float sheet_length_m) {
  const glm::vec2 half = 0.5f * width_m * right, far = length_m * ahead;
  mesh.quad(material, glm::vec3(middle - half, 0), glm::vec3(middle + half, 0),
            glm::vec3(middle + half + far, 0), glm::vec3(middle - half + far, 0), {0.0f, 1.0f},
            {1.0f, 1.0f - length_m / sheet_length_m});
}

/// Where the roads that cross `road` take the ground: half the other carriageway and the round of the kerbs.
float crossing_reach(const Road& other) { return 0.5f * other.profile.carriageway_m + corner_radius_m; }

void add_road(CityMesh& mesh, const StreetPlan& plan, const Road& road) {
  const glm::vec2 ahead = road.runs_north ? glm::vec2(0, 1) : glm::vec2(1, 0), right(ahead.y, -ahead.x);
  const auto at = [&](float s) { return road.offset_m * glm::vec2(ahead.y, ahead.x) + s * ahead; };
  const bool is_wide = road.profile.has_parking;
  const CityMaterial surface = is_wide ? CityMaterial::road_wide : CityMaterial::road_narrow;
  const CityMaterial zebra = is_wide ? CityMaterial::zebra_wide : CityMaterial::zebra_narrow;
  const float width = road.profile.carriageway_m;
  float s = -city_half_m;
  const auto stretch = [&](float end) {
    add_strip(mesh, surface, at(s), right, ahead, width, end - s, synthesis::road_sheet_length_m);
  };
  for (const Road& other : plan.roads) {
    if (other.runs_north == road.runs_north) continue;
    const float begin = other.offset_m - crossing_reach(other), end = other.offset_m + crossing_reach(other);
    stretch(begin - synthesis::zebra_length_m);
    add_strip(mesh, zebra, at(begin), -right, -ahead, width, synthesis::zebra_length_m,
              synthesis::zebra_length_m);
    add_strip(mesh, zebra, at(end), right, ahead, width, synthesis::zebra_length_m,
              synthesis::zebra_length_m);
    s = end + synthesis::zebra_length_m;
  }
  stretch(city_half_m);
}

/// The ground between the four kerbs of a crossing, as a fan round its middle: the kerbs' rounds reach into
/// it.
void add_crossing(CityMesh& mesh, const Road& north_road, const Road& east_road) {
  const glm::vec2 half = 0.5f * glm::vec2(north_road.profile.carriageway_m, east_road.profile.carriageway_m);
  const glm::vec2 centre(north_road.offset_m, east_road.offset_m);
  std::vector<glm::vec2> outline{centre};
  constexpr std::array<glm::vec2, 4> quadrants{{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};
  for (std::size_t i = 0; i < quadrants.size(); ++i) {
    const glm::vec2 quadrant = quadrants[i], corner = centre + quadrant * half;
    const glm::vec2 east_kerb = corner + glm::vec2(quadrant.x * corner_radius_m, 0);
    const glm::vec2 north_kerb = corner + glm::vec2(0, quadrant.y * corner_radius_m);
    const glm::vec2 round = corner + corner_radius_m * (quadrant - glm::normalize(quadrant));
    if (i % 2 == 0)
      outline.insert(outline.end(), {east_kerb, round, north_kerb});
    else
      outline.insert(outline.end(), {north_kerb, round, east_kerb});
  }
  outline.push_back(outline[1]);
  add_flat(mesh, CityMaterial::asphalt, outline, 0.0f, synthesis::asphalt_sheet_m);
}

/// All but the furniture.
void add_ways(CityMesh& mesh, const StreetPlan& plan) {
  for (const Block& block : plan.blocks) {
    mesh.begin_group("block " + std::to_string(block.column) + std::to_string(block.row));
    add_block(mesh, block);
  }
  for (const Road& road : plan.roads) {
    mesh.begin_group((road.runs_north ? "road north " : "road east ") + std::to_string(int(road.offset_m)));
    add_road(mesh, plan, road);
  }
  mesh.begin_group("crossings");
  for (const Road& a : plan.roads)
    for (const Road& b : plan.roads)
      if (a.runs_north && !b.runs_north) add_crossing(mesh, a, b);
}

}  // namespace

std::size_t furniture_triangles(const StreetPlan& plan) {
  CityMesh mesh;
  add_ways(mesh, plan);
  return ground_triangles - mesh.triangle_count();
}

void add_ground(CityMesh& mesh, const StreetPlan& plan) {
  const std::size_t before = mesh.triangle_count();
  add_ways(mesh, plan);
  mesh.begin_group("furniture");
  add_street_furniture(mesh, ground_triangles - (mesh.triangle_count() - before));
  assert(mesh.triangle_count() - before == ground_triangles);
}

}  // namespace parvis::city
