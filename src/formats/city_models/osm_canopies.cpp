#include "formats/city_models/osm_canopies.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/city_models/osm_measures.h"
#include "formats/city_models/osm_shapes.h"

namespace parvis::scene {
namespace {

using glm::dvec2, glm::dvec3;

constexpr double inset_m = 0.4;                  // of posts from the edge
constexpr double bay_m = 6.0;                    // between posts along an edge, at most
constexpr double near_post_m = 1.2;              // a corner so near to the post before has none
constexpr double small_m2 = 60.0;                // a canopy of no larger plan has slim posts
constexpr double slim_m = 0.06, stout_m = 0.16;  // half the width of a post
constexpr double max_bays = 60.0;                // along an edge: longer ones have wider bays
constexpr double sharp = 0.2;  // of 1 + cosine between two edges' normals: sharper corners count as this
constexpr std::size_t max_posts = 20'000;

dvec2 left_of(dvec2 along) { return {-along.y, along.x}; }

dvec2 direction(dvec2 from, dvec2 to) {
  const double length_m = glm::distance(from, to);
  return length_m > 0.0 ? (to - from) / length_m : dvec2(1.0, 0.0);
}

/// The place of a corner's post, inside both of its edges.
dvec2 inside_corner(const OsmRing& ring, std::size_t i) {
  const std::size_t n = ring.size();
  const dvec2 a = left_of(direction(ring[(i + n - 1) % n], ring[i])),
              b = left_of(direction(ring[i], ring[(i + 1) % n]));
  return ring[i] + inset_m * (a + b) / std::max(1.0 + glm::dot(a, b), sharp);
}

bool stands_open(const std::string& value) {
  return value == "roof" || value == "carport" || value == "canopy";
}

}  // namespace

bool is_osm_canopy(const OsmTags& tags) {
  if (tag(tags, "wall") == "no" || tag(tags, "walls") == "no") return true;
  if (stands_open(tag(tags, "building"))) return true;
  return stands_open(tag(tags, "building:part")) &&
         metres_or(tags, "min_height", "building:min_level", 0.0) < headroom_m;
}

void OsmPosts::add(dvec2 foot, dvec2 along, double half_m, double top_m) {
  const double foot_m = ground_ ? ground_(foot) : 0.0;
  if (!(top_m - foot_m > 0.0)) return;
  const std::vector<dvec3> line{{foot - half_m * along, top_m}, {foot + half_m * along, top_m}};
  add_block(sides_of(line, -half_m, half_m, 0.0), top_m - foot_m, steel_, city_);
  ++count_;
}

void OsmPosts::add(const std::vector<OsmRing>& rings, double top_m) {
  const double half_m = std::abs(area_m2(rings[0])) > small_m2 ? stout_m : slim_m;
  const bool has_bays = count_ < max_posts;
  if (!has_bays)
    city_.warn(fmt::format("its canopies have more than {} posts: others have none between their corners",
                           max_posts));
  for (const OsmRing& ring : rings) {
    dvec2 last = inside_corner(ring, 0);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const dvec2 from = inside_corner(ring, i), to = inside_corner(ring, (i + 1) % ring.size());
      const double length_m = glm::distance(from, to);
      if (i == 0 || glm::distance(last, from) >= near_post_m)
        add(last = from, direction(from, to), half_m, top_m);
      const int bays = has_bays ? int(std::ceil(std::clamp(length_m / bay_m, 1.0, max_bays))) : 1;
      for (int bay = 1; bay < bays; ++bay)
        add(last = glm::mix(from, to, double(bay) / double(bays)), direction(from, to), half_m, top_m);
    }
  }
}

}  // namespace parvis::scene
