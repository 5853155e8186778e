#include "formats/city_models/osm_roofs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "formats/city_models/gables.h"

namespace parvis::scene {
namespace {

using glm::dvec2, glm::dvec3;
using Faces = std::vector<OsmRoofFace>;

constexpr double usual_slope = 0.6;  // of gables and hips without a height: 31 degrees
constexpr double skillion_slope = 0.25;
constexpr double straight_m = 0.01;  // edges that are shorter are none

/// A point of a profile: how far from the eaves (0) to the middle or the ridge (1), and how high, 0 to 1.
struct ProfilePoint {
  double in, up;
};
constexpr std::array<ProfilePoint, 4> mansard{{{0.0, 0.0}, {0.15, 0.7}, {0.55, 1.0}, {1.0, 1.0}}};
constexpr std::array<ProfilePoint, 7> onion{
    {{0.0, 0.0}, {-0.1, 0.15}, {-0.06, 0.3}, {0.25, 0.5}, {0.65, 0.65}, {0.9, 0.8}, {1.0, 1.0}}};
constexpr std::array<ProfilePoint, 3> gambrel{{{0.0, 0.0}, {0.35, 0.65}, {1.0, 1.0}}};
constexpr std::array<ProfilePoint, 2> gable{{{0.0, 0.0}, {1.0, 1.0}}};

/// A quarter of a circle in `steps` chords.
template <std::size_t steps>
std::array<ProfilePoint, steps + 1> quarter_circle() {
  std::array<ProfilePoint, steps + 1> points;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double angle = 0.5 * std::numbers::pi * double(i) / double(steps);
    points[i] = {1.0 - std::cos(angle), std::sin(angle)};
  }
  return points;
}

/// The wiki's names, and others for the same shape.
std::string plain_shape(const std::string& shape) {
  if (shape == "cone" || shape == "conical" || shape == "pyramid") return "pyramidal";
  if (shape == "lean_to" || shape == "mono_pitched") return "skillion";
  if (shape == "barrel") return "round";
  if (shape == "half_hipped" || shape == "half-hip") return "half-hipped";
  if (shape == "gable") return "gabled";
  if (shape == "hip") return "hipped";
  return shape;
}

bool is_one_of(const std::string& shape, std::initializer_list<const char*> names) {
  return std::ranges::find(names, shape) != names.end();
}

bool has_ridge(const std::string& shape) {
  return is_one_of(shape, {"gabled", "hipped", "half-hipped", "gambrel", "saltbox", "round"});
}

bool is_convex(const OsmRing& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const dvec2 in = ring[(i + 1) % ring.size()] - ring[i],
                out = ring[(i + 2) % ring.size()] - ring[(i + 1) % ring.size()];
    if (in.x * out.y - in.y * out.x < -1e-3 * glm::length(in) * glm::length(out)) return false;
  }
  return true;
}

/// Whether a roof that rises to the point has no face that leans outward.
bool sees_all(dvec2 point, const OsmRing& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const dvec2 a = ring[i] - point, b = ring[(i + 1) % ring.size()] - point;
    if (!(a.x * b.y - a.y * b.x > 0.0)) return false;
  }
  return true;
}

/// Adds a face without points that coincide with the one before; a face of fewer than three is none.
void add(Faces& faces, const char* semantics, const std::vector<dvec3>& points) {
  std::vector<dvec3> kept;
  for (const dvec3& point : points)
    if (kept.empty() || glm::distance(kept.back(), point) > straight_m) kept.push_back(point);
  while (kept.size() > 1 && glm::distance(kept.front(), kept.back()) <= straight_m) kept.pop_back();
  if (kept.size() >= 3) faces.push_back({semantics, std::move(kept)});
}

/// Rings that shrink towards the middle as they rise: pyramids, domes, onions, mansard roofs.
Faces stacked_rings(const OsmRing& corners, double eaves_m, double top_m,
                    std::span<const ProfilePoint> profile) {
  const dvec2 centre = middle(corners);
  const auto at = [&](std::size_t i, const ProfilePoint& point) {
    return dvec3(glm::mix(corners[i % corners.size()], centre, point.in), glm::mix(eaves_m, top_m, point.up));
  };
  Faces faces;
  for (std::size_t ring = 0; ring + 1 < profile.size(); ++ring)
    for (std::size_t i = 0; i < corners.size(); ++i)
      add(faces, "RoofSurface",
          {at(i, profile[ring]), at(i + 1, profile[ring]), at(i + 1, profile[ring + 1]),
           at(i, profile[ring + 1])});
  return faces;
}

dvec2 towards(double direction_deg) {
  const double angle = direction_deg * std::numbers::pi / 180.0;
  return {std::sin(angle), std::cos(angle)};
}

/// Where the side that begins at a corner looks, of a ring that runs counter-clockwise.
dvec2 outward(const OsmRing& ring, std::size_t corner) {
  const dvec2 side = ring[(corner + 1) % ring.size()] - ring[corner];
  return dvec2(side.y, -side.x) / std::max(glm::length(side), straight_m);
}

/// Four corners in the order in which the ridge runs from the middle of the last side to that of the second;
/// the main face rises from the third side. Without a direction the ridge runs along the longer sides.
std::array<dvec2, 4> along_ridge(const OsmRoofTags& tags, const OsmRing& ring) {
  const bool first_is_longer = glm::distance(ring[0], ring[1]) >= glm::distance(ring[1], ring[2]);
  std::size_t first = first_is_longer != tags.runs_across ? 0 : 1;
  if (tags.direction_deg) {
    const dvec2 main = towards(*tags.direction_deg);
    for (std::size_t i = 0; i < 4; ++i)
      if (glm::dot(outward(ring, (i + 2) % 4), main) > glm::dot(outward(ring, (first + 2) % 4), main) + 1e-9)
        first = i;
  }
  return {ring[first], ring[(first + 1) % 4], ring[(first + 2) % 4], ring[(first + 3) % 4]};
}

/// Roofs that have the same profile all along their ridge. `ridge_share`: where it lies across, 0.5 in the
/// middle.
Faces along_profile(const std::array<dvec2, 4>& c, double eaves_m, double top_m,
                    std::span<const ProfilePoint> profile, double ridge_share) {
  // from the first long side over the ridge to the other: places across and heights
  std::vector<dvec2> section;
  for (const ProfilePoint& p : profile) section.emplace_back(ridge_share * p.in, p.up);
  for (std::size_t i = profile.size() - 1; i-- > 0;)
    section.emplace_back(1.0 - (1.0 - ridge_share) * profile[i].in, profile[i].up);
  const auto at = [&](bool is_front, const dvec2& s) {
    return dvec3(is_front ? glm::mix(c[1], c[2], s.x) : glm::mix(c[0], c[3], s.x),
                 glm::mix(eaves_m, top_m, s.y));
  };
  Faces faces;
  std::vector<dvec3> front, back;
  for (std::size_t i = 0; i < section.size(); ++i) {
    front.push_back(at(true, section[section.size() - 1 - i])), back.push_back(at(false, section[i]));
    if (i + 1 < section.size())
      add(faces, "RoofSurface",
          {at(false, section[i]), at(true, section[i]), at(true, section[i + 1]), at(false, section[i + 1])});
  }
  add(faces, "WallSurface", back), add(faces, "WallSurface", front);
  return faces;
}

/// Hips from half of the height on; below, the ends are walls.
Faces half_hipped(const std::array<dvec2, 4>& c, double eaves_m, double top_m) {
  constexpr double hip_from = 0.5;
  const dvec2 back = 0.5 * (c[3] + c[0]), front = 0.5 * (c[1] + c[2]);
  const double length_m = std::max(glm::distance(back, front), straight_m);
  const double inset = std::min(0.45, (1.0 - hip_from) * glm::distance(c[1], c[2]) / (2.0 * length_m));
  const dvec3 ridge_back(glm::mix(back, front, inset), top_m),
      ridge_front(glm::mix(front, back, inset), top_m);
  const auto up = [&](const dvec2& corner, const dvec2& end) {  // on the slope, where the hip begins
    return dvec3(glm::mix(corner, end, hip_from), glm::mix(eaves_m, top_m, hip_from));
  };
  const auto eave = [&](const dvec2& corner) { return dvec3(corner, eaves_m); };
  Faces faces;
  add(faces, "RoofSurface",
      {eave(c[0]), eave(c[1]), up(c[1], front), ridge_front, ridge_back, up(c[0], back)});
  add(faces, "RoofSurface",
      {eave(c[2]), eave(c[3]), up(c[3], back), ridge_back, ridge_front, up(c[2], front)});
  add(faces, "RoofSurface", {up(c[1], front), up(c[2], front), ridge_front});
  add(faces, "RoofSurface", {up(c[3], back), up(c[0], back), ridge_back});
  add(faces, "WallSurface", {eave(c[1]), eave(c[2]), up(c[2], front), up(c[1], front)});
  add(faces, "WallSurface", {eave(c[3]), eave(c[0]), up(c[0], back), up(c[3], back)});
  return faces;
}

/// Faces of equal slope that rise from all edges; gables stand upright.
Faces along_skeleton(const StraightSkeleton& skeleton, const std::vector<bool>& is_gable, double eaves_m,
                     double top_m) {
  Faces faces;
  const double highest_m = skeleton.highest_m();
  for (std::size_t i = 0; i < skeleton.faces.size(); ++i) {
    std::vector<dvec3> points;
    for (const int point : skeleton.faces[i]) {
      const dvec3& at = skeleton.points[std::size_t(point)];
      points.emplace_back(at.x, at.y, glm::mix(eaves_m, top_m, at.z / highest_m));
    }
    faces.push_back({is_gable[i] ? "WallSurface" : "RoofSurface", std::move(points)});
  }
  return faces;
}

/// Where a skillion falls to: as tagged, else over the shorter way, to the first of the two longest sides.
dvec2 downhill(const OsmRoofTags& tags, const OsmRing& corners) {
  if (tags.direction_deg) return towards(*tags.direction_deg);
  dvec2 longest(0.0);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const dvec2 side = corners[(i + 1) % corners.size()] - corners[i];
    if (glm::length(side) > glm::length(longest) + straight_m) longest = side;
  }
  return glm::length(longest) > 0.0 ? glm::normalize(dvec2(longest.y, -longest.x)) : dvec2(1.0, 0.0);
}

/// How far the corners reach along a direction: the least and the greatest.
dvec2 reach(const OsmRing& corners, dvec2 direction) {
  dvec2 found(1e30, -1e30);
  for (const dvec2& corner : corners) {
    const double at = glm::dot(corner, direction);
    found = {std::min(found.x, at), std::max(found.y, at)};
  }
  return found;
}

/// One slope, and the walls that reach up to it.
Faces skillion(const OsmRoofTags& tags, const OsmRing& corners, double eaves_m, double top_m) {
  const dvec2 down = downhill(tags, corners), ends = reach(corners, down);
  const auto raised = [&](const dvec2& corner) {
    const double share = (glm::dot(corner, down) - ends.x) / std::max(ends.y - ends.x, straight_m);
    return dvec3(corner, glm::mix(top_m, eaves_m, share));
  };
  Faces faces;
  std::vector<dvec3> roof;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const dvec2 a = corners[i], b = corners[(i + 1) % corners.size()];
    roof.push_back(raised(a));
    add(faces, "WallSurface", {dvec3(a, eaves_m), dvec3(b, eaves_m), raised(b), raised(a)});
  }
  add(faces, "RoofSurface", roof);
  return faces;
}

/// Hips or gables over the straight skeleton.
std::optional<OsmRoof> along_ridges(OsmRoof roof, const std::vector<OsmRing>& rings, std::string& why_flat) {
  roof.skeleton = straight_skeleton(rings);
  if (!roof.skeleton) {
    std::size_t corners = 0;
    for (const OsmRing& ring : rings) corners += ring.size();
    why_flat =
        corners > max_skeleton_corners
            ? fmt::format("its outline has more than {} corners; draw it with fewer", max_skeleton_corners)
            : std::string("its outline crosses or touches itself or a courtyard; mend it in the map");
    return std::nullopt;
  }
  roof.is_gable.resize(roof.skeleton->faces.size(), false);
  if (roof.shape != "hipped") roof.is_gable = raise_gables(*roof.skeleton);
  return roof;
}

double shorter_side_m(const OsmRing& ring) {
  return std::min(glm::distance(ring[0], ring[1]), glm::distance(ring[1], ring[2]));
}

/// How far the eaves lie below the top where all faces rise as steeply: by their run in plan. Nothing for
/// roofs whose faces have several slopes.
std::optional<double> run_m(const OsmRoof& roof) {
  if (roof.skeleton) return roof.skeleton->highest_m();
  if (roof.shape == "skillion") {
    const dvec2 ends = reach(roof.corners, downhill(roof.tags, roof.corners));
    return ends.y - ends.x;
  }
  if (roof.shape == "gabled" || roof.shape == "half-hipped") {
    const std::array<dvec2, 4> c = along_ridge(roof.tags, roof.corners);
    const dvec2 ridge = glm::normalize(c[1] + c[2] - c[0] - c[3]), across = 0.5 * (c[2] + c[3] - c[0] - c[1]);
    return 0.5 * std::abs(ridge.x * across.y - ridge.y * across.x);
  }
  if (roof.shape != "pyramidal") return std::nullopt;
  double nearest_m = 1e30;
  const dvec2 centre = middle(roof.corners);
  for (std::size_t i = 0; i < roof.corners.size(); ++i)
    nearest_m = std::min(nearest_m, std::abs(glm::dot(centre - roof.corners[i], outward(roof.corners, i))));
  return nearest_m;
}

}  // namespace

std::optional<OsmRoof> find_osm_roof(const OsmRoofTags& tags, const std::vector<OsmRing>& rings,
                                     std::string& why_flat) {
  if (rings.empty() || rings[0].size() < 3) return std::nullopt;
  OsmRoof roof{plain_shape(tags.shape), tags, rings[0], {}, {}};
  const bool has_courtyards = rings.size() > 1, is_bulging = !has_courtyards && is_convex(rings[0]);
  if (has_ridge(roof.shape)) {
    if (roof.shape != "hipped" && is_bulging && rings[0].size() == 4) return roof;
    return along_ridges(std::move(roof), rings, why_flat);
  }
  if (roof.shape == "pyramidal") {
    if (!has_courtyards && sees_all(middle(rings[0]), rings[0])) return roof;
    roof.shape = "hipped";
    return along_ridges(std::move(roof), rings, why_flat);
  }
  const bool is_known = is_one_of(roof.shape, {"skillion", "dome", "onion", "mansard"});
  if (is_known && is_bulging) return roof;
  if (is_known)
    why_flat = "it stands on convex outlines without courtyards alone; \"hipped\" and \"gabled\" on any";
  else if (!roof.shape.empty() && roof.shape != "flat")
    why_flat = "this value of roof:shape is not known; those that are: docs/city-models.md";
  return std::nullopt;
}

double usual_osm_roof_m(const OsmRoof& roof) {
  constexpr double flattest_deg = 0.5, steepest_deg = 85.0;
  if (roof.tags.angle_deg >= flattest_deg && roof.tags.angle_deg <= steepest_deg)
    if (const auto run = run_m(roof)) return *run * std::tan(*roof.tags.angle_deg * std::numbers::pi / 180.0);
  const double side_m = std::sqrt(std::abs(area_m2(roof.corners)));
  if (roof.skeleton) return usual_slope * roof.skeleton->highest_m();
  if (roof.shape == "skillion") {
    const dvec2 ends = reach(roof.corners, downhill(roof.tags, roof.corners));
    return std::min(skillion_slope * (ends.y - ends.x), 4.0);
  }
  if (roof.shape == "dome") return 0.5 * side_m;
  if (roof.shape == "onion") return 1.1 * side_m;
  if (roof.shape == "mansard") return std::min(0.35 * side_m, 4.5);
  if (!has_ridge(roof.shape)) return 0.5 * usual_slope * side_m;
  const bool is_steep = roof.shape == "gambrel" || roof.shape == "round";
  return (is_steep ? 0.45 : 0.5 * usual_slope) * shorter_side_m(roof.corners);
}

Faces osm_roof_faces(const OsmRoof& roof, double eaves_m, double top_m) {
  const std::string& shape = roof.shape;
  if (roof.skeleton) return along_skeleton(*roof.skeleton, roof.is_gable, eaves_m, top_m);
  if (shape == "skillion") return skillion(roof.tags, roof.corners, eaves_m, top_m);
  if (shape == "dome") return stacked_rings(roof.corners, eaves_m, top_m, quarter_circle<6>());
  if (shape == "onion") return stacked_rings(roof.corners, eaves_m, top_m, onion);
  if (shape == "mansard") return stacked_rings(roof.corners, eaves_m, top_m, mansard);
  if (!has_ridge(shape)) return stacked_rings(roof.corners, eaves_m, top_m, gable);
  const std::array<dvec2, 4> c = along_ridge(roof.tags, roof.corners);
  if (shape == "half-hipped") return half_hipped(c, eaves_m, top_m);
  if (shape == "gambrel") return along_profile(c, eaves_m, top_m, gambrel, 0.5);
  if (shape == "round") return along_profile(c, eaves_m, top_m, quarter_circle<4>(), 0.5);
  return along_profile(c, eaves_m, top_m, gable, shape == "saltbox" ? 0.3 : 0.5);
}

}  // namespace parvis::scene
