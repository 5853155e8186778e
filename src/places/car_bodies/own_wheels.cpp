#include "places/car_bodies/own_wheels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtx/hash.hpp>
#include <tuple>
#include <unordered_map>

#include "base/disjoint_sets.h"
#include "places/car_bodies/names.h"

namespace parvis::car_bodies {
namespace {

constexpr float min_diameter_m = 0.4f, max_diameter_m = 1.4f;
constexpr float max_width_fraction = 0.9f;  // width over diameter
constexpr float max_oval = 1.12f;           // length over height of a wheel's box
constexpr float min_roundness = 0.82f;      // smallest over largest radius: a hexagon has 0.87, a square 0.71
constexpr float road_fraction = 0.25f;      // of the diameter, within which the lowest points of wheels lie
constexpr float place_fraction = 0.3f;      // of the radius, by which the two of a pair may differ
constexpr float max_radius_ratio = 1.15f;   // of the two of a pair
constexpr float min_wheelbase_fraction = 0.25f;  // of the car's length
constexpr float cylinder_slack = 1.03f;          // of the cylinder in which a wheel's other pieces lie

/// Triangles of a part that hang together by the places of their corners.
struct ConnectedPiece {
  std::size_t part = 0;
  std::vector<std::uint32_t> triangles = {};
  Bounds bounds = {};
};

void add_pieces(const Body& body, std::size_t part, std::vector<ConnectedPiece>& pieces) {
  const Mesh& mesh = body.model().parts[part].mesh;
  // Corners at one place are one: texture and normals divide the vertices of a seam.
  std::unordered_map<glm::vec3, std::uint32_t> first_at;
  std::vector<std::uint32_t> place;
  place.reserve(mesh.positions.size());
  for (std::uint32_t i = 0; i < mesh.positions.size(); ++i)
    place.push_back(first_at.try_emplace(mesh.positions[i], i).first->second);
  DisjointSets groups(mesh.positions.size());
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    for (const std::size_t k : {1u, 2u}) groups.join(place[mesh.indices[i]], place[mesh.indices[i + k]]);
  std::unordered_map<std::size_t, std::size_t> piece_of;
  for (std::uint32_t triangle = 0; triangle < mesh.triangle_count(); ++triangle) {
    const std::size_t root = groups.root(place[mesh.indices[3 * std::size_t(triangle)]]);
    const auto [found, is_new] = piece_of.try_emplace(root, pieces.size());
    if (is_new) pieces.push_back({.part = part});
    ConnectedPiece& piece = pieces[found->second];
    piece.triangles.push_back(triangle);
    for (const glm::vec3& corner : body.corners(part, triangle)) piece.bounds.add(corner);
  }
}

/// Calls `visit` with the distance and the direction (0 to 1, once about) from the axle of points of a piece.
template <class Visit>
void visit_radii(const Body& body, const ConnectedPiece& piece, glm::vec3 centre, const Visit& visit) {
  constexpr float min_step_m = 1e-3f;
  const float step = std::max(0.05f * std::max(piece.bounds.size().x, piece.bounds.size().z), min_step_m);
  for (const std::uint32_t triangle : piece.triangles)
    visit_points(body.corners(piece.part, triangle), step, [&](glm::vec3 at) {
      const glm::vec2 off(at.x - centre.x, at.z - centre.z);
      visit(glm::length(off), std::atan2(off.y, off.x) / glm::two_pi<float>() + 0.5f);
    });
}

/// The smallest and the largest distance of the outline from the middle, over all directions.
struct Outline {
  float min_radius, max_radius;
};

Outline outline_of(const Body& body, const ConnectedPiece& piece) {
  std::array<float, 24> reach{};
  visit_radii(body, piece, piece.bounds.centre(), [&](float radius, float direction) {
    float& here = reach[std::min(std::size_t(direction * float(reach.size())), reach.size() - 1)];
    here = std::max(here, radius);
  });
  const auto [low, high] = std::ranges::minmax(reach);
  return {low, high};
}

bool looks_like_a_wheel(const Body& body, const ConnectedPiece& piece) {
  const glm::vec3 size = piece.bounds.size();
  const float diameter = std::max(size.x, size.z);
  if (diameter < min_diameter_m || diameter > max_diameter_m || size.y > max_width_fraction * diameter ||
      diameter > max_oval * std::min(size.x, size.z) ||
      piece.bounds.min.z > body.bounds().min.z + road_fraction * diameter)
    return false;
  const Outline outline = outline_of(body, piece);
  return outline.min_radius >= min_roundness * outline.max_radius;
}

/// The largest round pieces: those about the axle of a larger one on the same side are its rim or its twin.
std::vector<OwnWheel> round_places(const Body& body, std::vector<ConnectedPiece> pieces) {
  std::erase_if(pieces, [&](const ConnectedPiece& piece) { return !looks_like_a_wheel(body, piece); });
  std::ranges::sort(pieces, std::greater(), [](const ConnectedPiece& piece) {
    const glm::vec3 centre = piece.bounds.centre();
    return std::tuple(piece.bounds.size().z, centre.x, centre.y, centre.z);
  });
  std::vector<OwnWheel> wheels;
  for (const ConnectedPiece& piece : pieces) {
    const glm::vec3 centre = piece.bounds.centre();
    const bool is_inside = std::ranges::any_of(wheels, [&](const OwnWheel& wheel) {
      const glm::vec2 off(centre.x - wheel.centre.x, centre.z - wheel.centre.z);
      return glm::length(off) < wheel.radius &&
             (centre.y > body.middle_y()) == (wheel.centre.y > body.middle_y());
    });
    if (!is_inside) wheels.push_back({centre, outline_of(body, piece).max_radius, piece.bounds.size().y, {}});
  }
  return wheels;
}

/// Leaves those that have an equal on the other side of the car, as pairs.
std::vector<OwnWheel> pairs_of(const Body& body, std::vector<OwnWheel> wheels) {
  std::ranges::sort(wheels, {}, [](const OwnWheel& wheel) {
    return std::tuple(wheel.centre.x, wheel.centre.y, wheel.centre.z);
  });
  const auto is_left = [&](const OwnWheel& wheel) { return wheel.centre.y > body.middle_y(); };
  std::vector<OwnWheel> pairs;
  for (const OwnWheel& left : wheels) {
    if (!is_left(left)) continue;
    const glm::vec3 mirrored(left.centre.x, 2.0f * body.middle_y() - left.centre.y, left.centre.z);
    const auto right = std::ranges::find_if(wheels, [&](const OwnWheel& other) {
      return !is_left(other) && glm::distance(other.centre, mirrored) < place_fraction * left.radius &&
             std::max(left.radius, other.radius) <= max_radius_ratio * std::min(left.radius, other.radius);
    });
    if (right != wheels.end()) pairs.push_back(left), pairs.push_back(*right);
  }
  return pairs;
}

bool lies_in(const Body& body, const ConnectedPiece& piece, const OwnWheel& wheel) {
  const float reach_y = 0.5f * wheel.width + 0.25f * wheel.radius;  // hubs stand out
  if (piece.bounds.min.y < wheel.centre.y - reach_y || piece.bounds.max.y > wheel.centre.y + reach_y)
    return false;
  if (std::abs(piece.bounds.centre().x - wheel.centre.x) > wheel.radius) return false;
  float radius = 0.0f;
  visit_radii(body, piece, wheel.centre, [&](float here, float) { radius = std::max(radius, here); });
  return radius <= cylinder_slack * wheel.radius;
}

}  // namespace

std::vector<OwnWheel> find_own_wheels(const Body& body) {
  std::vector<ConnectedPiece> pieces;
  for (std::size_t part = 0; part < body.model().parts.size(); ++part) add_pieces(body, part, pieces);
  std::vector<OwnWheel> wheels = pairs_of(body, round_places(body, pieces));
  if (wheels.size() < 4 ||
      wheels.back().centre.x - wheels.front().centre.x < min_wheelbase_fraction * body.bounds().size().x)
    return {};
  for (const ConnectedPiece& piece : pieces)
    for (OwnWheel& wheel : wheels)
      if (lies_in(body, piece, wheel)) {
        std::vector<std::uint32_t>& taken = wheel.triangles[piece.part];
        taken.insert(taken.end(), piece.triangles.begin(), piece.triangles.end());
        break;
      }
  return wheels;
}

bool turns_in_traffic(const scene::Model& model, const OwnWheel& wheel) {
  return std::ranges::all_of(wheel.triangles, [&](const auto& of_part) {
    const scene::Part& part = model.parts[of_part.first];
    if (of_part.second.size() < part.mesh.triangle_count()) return false;
    for (int node = part.node; node != scene::no_index; node = model.nodes[std::size_t(node)].parent)
      if (names_a_wheel(model.nodes[std::size_t(node)].name)) return true;
    return false;
  });
}

}  // namespace parvis::car_bodies
