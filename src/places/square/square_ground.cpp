#include "places/square/square_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "places/square/layout.h"
#include "synthesis/ground_texture.h"
#include "synthesis/round_mesh.h"

namespace parvis::square {
namespace {

constexpr float half = 0.5f * carriageway_m, corner_m = 3.0f;  // of kerbs where streets meet
constexpr float kerb_stone_m = 0.28f;

struct Area {
  float x0, x1, y0, y1;
};

/// A level rectangle; texture coordinates are its place.
void lay(ReliefMesh& mesh, Surface surface, const Area& a, float z) {
  if (a.x1 - a.x0 < 1e-3f || a.y1 - a.y0 < 1e-3f) return;
  mesh.quad(surface, {a.x0, a.y0, z}, {a.x1, a.y0, z}, {a.x1, a.y1, z}, {a.x0, a.y1, z});
}

/// The paving of the square: fields of large stones in a grid of bands of small ones.
void lay_fields(ReliefMesh& mesh, const Area& area) {
  constexpr float field_m = 5.4f, band_m = 0.6f, module_m = field_m + band_m;
  const int columns = int(std::ceil((area.x1 - area.x0) / module_m)),
            rows = int(std::ceil((area.y1 - area.y0) / module_m));
  const auto edges = [&](float from, float to, int i) {
    const float a = from + module_m * float(i);
    return std::array{std::min(a + band_m, to), std::min(a + module_m, to), a};
  };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const auto x = edges(area.x0, area.x1, column), y = edges(area.y0, area.y1, row);
      const float tone = (row + column) % 2 == 0 ? 1.0f : 0.93f;
      mesh.set_colour(tone * glm::vec3(sheet_albedo) * glm::vec3(1.16f, 1.1f, 0.98f));
      lay(mesh, Surface::paving, {x[0], x[1], y[0], y[1]}, kerb_m);
      mesh.set_colour({0.34f, 0.32f, 0.3f});
      lay(mesh, Surface::setts, {x[2], x[1], y[2], y[0]}, kerb_m);
      lay(mesh, Surface::setts, {x[2], x[0], y[0], y[1]}, kerb_m);
    }
}

/// A pavement of plain slabs.
void lay_pavement(ReliefMesh& mesh, const Area& area) {
  mesh.set_colour(glm::vec3(sheet_albedo) * glm::vec3(1.0f, 0.98f, 0.94f));
  lay(mesh, Surface::paving, area, kerb_m);
}

/// Kerb stones along a line on the left of which the pavement lies.
void lay_kerb(ReliefMesh& mesh, const std::vector<glm::vec2>& line) {
  mesh.set_colour({0.5f, 0.48f, 0.45f});
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const glm::vec2 p = line[i], q = line[i + 1], along = glm::normalize(q - p), left(-along.y, along.x);
    const glm::vec2 pi = p + kerb_stone_m * left, qi = q + kerb_stone_m * left;
    const float top = kerb_m + 0.004f;
    mesh.quad(Surface::ashlar, {p, 0.0f}, {q, 0.0f}, {q, top}, {p, top});
    mesh.quad(Surface::ashlar, {p, top}, {q, top}, {qi, top}, {pi, top});
  }
}

/// A stretch of carriageway from `from` to `to`.
void lay_road(ReliefMesh& mesh, glm::vec2 from, glm::vec2 to) {
  const glm::vec2 along = glm::normalize(to - from), right(along.y, -along.x);
  const float length = glm::distance(from, to);
  const auto at = [&](float across, float run) {
    return glm::vec3(from + across * right + run * along, 0.0f);
  };
  mesh.set_colour(glm::vec3(sheet_albedo));
  mesh.quad(Surface::road, {at(half, 0), at(half, length), at(-half, length), at(-half, 0)},
            {{carriageway_m, 0}, {carriageway_m, -length}, {0, -length}, {0, 0}});
}

/// A crossing for people: `mouth` is where the street meets another one, `away` leads out of it.
void lay_zebra(ReliefMesh& mesh, glm::vec2 mouth, glm::vec2 away) {
  const glm::vec2 left(-away.y, away.x);  // on the right of traffic toward the mouth
  const auto at = [&](float across, float run) {
    return glm::vec3(mouth + across * left + run * away, 0.0f);
  };
  const float w = carriageway_m, l = synthesis::zebra_length_m;
  mesh.set_colour(glm::vec3(sheet_albedo));
  mesh.quad(Surface::zebra, {at(half, 0), at(-half, 0), at(-half, l), at(half, l)},
            {{w, l}, {0, l}, {0, 0}, {w, 0}});
}

/// The piece of pavement that rounds the corner where two kerbs meet at `corner`; `into` points diagonally
/// onto the pavement.
void lay_corner(ReliefMesh& mesh, glm::vec2 corner, glm::vec2 into) {
  constexpr int pieces = 8;
  const glm::vec2 centre = corner + corner_m * into;
  std::vector<glm::vec2> arc;
  for (int i = 0; i <= pieces; ++i) {
    const float angle = 0.5f * std::numbers::pi_v<float> * float(i) / float(pieces);
    arc.push_back(centre - corner_m * into * glm::vec2(std::cos(angle), std::sin(angle)));
  }
  mesh.set_colour(glm::vec3(sheet_albedo) * glm::vec3(1.0f, 0.98f, 0.94f));
  const bool turns_left = into.x * into.y < 0.0f;
  for (int i = 0; i < pieces; ++i) {
    const glm::vec3 p(arc[std::size_t(i)], kerb_m), q(arc[std::size_t(i + 1)], kerb_m), c(centre, kerb_m);
    turns_left ? mesh.triangle(Surface::paving, c, q, p) : mesh.triangle(Surface::paving, c, p, q);
  }
  if (turns_left) std::ranges::reverse(arc);
  lay_kerb(mesh, arc);
}

void add_bollards(ReliefMesh& mesh) {
  const Mesh bollard = synthesis::turned(synthesis::smooth({{0.1f, 0.0f},
                                                            {0.1f, 0.08f},
                                                            {0.065f, 0.12f},
                                                            {0.06f, 0.7f},
                                                            {0.08f, 0.76f},
                                                            {0.085f, 0.84f},
                                                            {0.05f, 0.92f},
                                                            {0.0f, 0.94f}},
                                                           2),
                                         10);
  mesh.set_colour(glm::vec3(sheet_albedo));
  const auto stand = [&](glm::vec2 at) {
    Mesh moved = bollard;
    for (glm::vec3& p : moved.positions) p += glm::vec3(at, kerb_m);
    mesh.mesh(Surface::iron, moved);
  };
  for (float x = -45.0f; x < 30.0f; x += 2.6f)
    if (std::abs(x - lane_x) > 6.0f) stand({x, avenue_y + half + 0.55f});
  for (float y = -14.0f; y < 33.0f; y += 2.6f) stand({street_x - half - 0.55f, y});
}

}  // namespace

void add_square_ground(ReliefMesh& mesh) {
  mesh.begin_group("ground", {});
  const float south_kerb = avenue_y - half, north_kerb = avenue_y + half;  // of the avenue
  const float west_kerb = street_x - half, east_kerb = street_x + half;    // of the street
  const float lane_west = lane_x - half, lane_east = lane_x + half;        // of the lane
  const float out = reach_m, inside = gallery_m, c = corner_m, z = synthesis::zebra_length_m;
  // The square and the galleries about it.
  lay_fields(mesh, {west_m, west_kerb - kerb_stone_m, north_kerb + kerb_stone_m, north_m});
  lay_pavement(mesh, {west_m - inside, west_m, avenue_north_line_m, north_m + inside});
  lay_pavement(mesh, {west_m, street_west_line_m, north_m, north_m + inside});
  // The tram's streets.
  mesh.set_colour({0.44f, 0.42f, 0.39f});
  lay(mesh, Surface::setts, {-out, west_m - inside, tram_y - tram_half_m, tram_y + tram_half_m}, kerb_m);
  lay(mesh, Surface::setts, {tram_x - tram_half_m, tram_x + tram_half_m, north_m + inside, out}, kerb_m);
  // Pavements of the avenue: south of it up to the lane and from it, north of it outside the square.
  const float lane_left = lane_x - lane_half_m, lane_right = lane_x + lane_half_m;
  lay_pavement(mesh, {-out, lane_left, south_m - inside, south_kerb - kerb_stone_m});
  lay_pavement(mesh, {lane_right, out, south_m - inside, south_kerb - kerb_stone_m});
  lay_pavement(mesh, {-out, west_m, north_kerb + kerb_stone_m, avenue_north_line_m});
  lay_pavement(mesh, {east_kerb + kerb_stone_m, out, north_kerb + kerb_stone_m, avenue_north_line_m});
  // Of the street northward, and of the lane.
  lay_pavement(mesh, {street_west_line_m, west_kerb - kerb_stone_m, north_m, out});
  lay_pavement(mesh, {east_kerb + kerb_stone_m, east_m + inside, avenue_north_line_m, out});
  for (const auto& [x0, x1] :
       {std::pair{lane_left, lane_west - kerb_stone_m}, std::pair{lane_east + kerb_stone_m, lane_right}})
    lay_pavement(mesh, {x0, x1, -out, south_kerb - c});
  lay_pavement(mesh, {lane_left, lane_west - c, south_kerb - c, south_kerb - kerb_stone_m});
  lay_pavement(mesh, {lane_east + c, lane_right, south_kerb - c, south_kerb - kerb_stone_m});
  lay_corner(mesh, {lane_west, south_kerb}, {-1, -1});
  lay_corner(mesh, {lane_east, south_kerb}, {1, -1});
  // Kerbs, with the pavement on their left.
  lay_kerb(mesh, {{lane_west - c, south_kerb}, {-out, south_kerb}});
  lay_kerb(mesh, {{out, south_kerb}, {lane_east + c, south_kerb}});
  lay_kerb(mesh, {{-out, north_kerb}, {west_kerb, north_kerb}, {west_kerb, out}});
  lay_kerb(mesh, {{east_kerb, out}, {east_kerb, north_kerb}, {out, north_kerb}});
  lay_kerb(mesh, {{lane_west, south_kerb - c}, {lane_west, -out}});
  lay_kerb(mesh, {{lane_east, -out}, {lane_east, south_kerb - c}});
  // Carriageways: two junctions of three streets.
  const float north_mouth = north_kerb + 0.3f;
  mesh.set_colour(glm::vec3(sheet_albedo));
  lay(mesh, Surface::asphalt, {lane_west - c, lane_east + c, south_kerb, north_kerb}, 0.0f);
  lay(mesh, Surface::asphalt, {lane_west - c, lane_east + c, south_kerb - c, south_kerb}, 0.0f);
  lay(mesh, Surface::asphalt, {west_kerb - c, east_kerb + c, south_kerb, north_kerb}, 0.0f);
  lay(mesh, Surface::asphalt, {west_kerb, east_kerb, north_kerb, north_mouth}, 0.0f);
  lay_zebra(mesh, {lane_west - c, avenue_y}, {-1, 0}),
      lay_road(mesh, {lane_west - c - z, avenue_y}, {-out, avenue_y});
  lay_zebra(mesh, {lane_east + c, avenue_y}, {1, 0}), lay_zebra(mesh, {west_kerb - c, avenue_y}, {-1, 0});
  lay_road(mesh, {lane_east + c + z, avenue_y}, {west_kerb - c - z, avenue_y});
  lay_zebra(mesh, {east_kerb + c, avenue_y}, {1, 0}),
      lay_road(mesh, {east_kerb + c + z, avenue_y}, {out, avenue_y});
  lay_zebra(mesh, {street_x, north_mouth}, {0, 1}),
      lay_road(mesh, {street_x, north_mouth + z}, {street_x, out});
  lay_zebra(mesh, {lane_x, south_kerb - c}, {0, -1}),
      lay_road(mesh, {lane_x, south_kerb - c - z}, {lane_x, -out});
  add_bollards(mesh);
}

}  // namespace parvis::square
