// What places of a region see of the sky, traced once and interpolated for vertices that have no time for
// rays of their own.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "base/bounds.h"
#include "graphics/light/lit_vertex.h"
#include "graphics/light/sky_table.h"
#include "graphics/reference/ray_scene.h"

namespace parvis::light {

/// What places of a region see of the sky, traced once: 64 directions each, a bit per direction.
class VisibilityPlaces {
 public:
  /// A place every `spacing_m` in `region`, or farther apart, so that there are no more than `max_places`.
  /// Those inside of things see nothing.
  VisibilityPlaces(const reference::RayScene& scene, const Bounds& region, float spacing_m,
                   std::size_t max_places = 1'000'000);

  /// The share of the light of each direction that arrives at a point, between the eight places around it.
  void interpolate(glm::vec3 point, float (&shares)[64]) const;
  /// Evenly over the upper hemisphere; each stands for 2 pi / 64 steradians.
  static const std::vector<glm::vec3>& directions();
  /// How far the share of directions that are open at a place is off what its neighbours on both sides of it
  /// have in the mean: what interpolation is off by, in the root of the mean square over all places.
  float uncertainty() const;
  /// Number of places.
  std::size_t size() const { return masks_.size(); }

 private:
  std::uint64_t mask(glm::ivec3 place) const;
  glm::vec3 origin_;
  glm::ivec3 counts_;
  float spacing_m_;
  std::vector<std::uint64_t> masks_;
};

/// Irradiance of the sky without the sun at vertices, with interpolated visibility: no rays at all. Here and
/// in open_irradiance `Blocked::bounces` has the sky's own ground shine from below, where `dark` leaves out
/// all that is below.
std::vector<glm::vec3> interpolated_irradiance(const std::vector<LitVertex>& vertices,
                                               const VisibilityPlaces& places, const SkyTable& sky,
                                               Blocked blocked = Blocked::dark);

/// Of sky and sun, as if nothing stood in the way.
std::vector<glm::vec3> open_irradiance(const std::vector<LitVertex>& vertices, const SkyTable& sky,
                                       Blocked blocked = Blocked::dark);
/// Of the sky alone.
std::vector<glm::vec3> open_sky_irradiance(const std::vector<LitVertex>& vertices, const SkyTable& sky,
                                           Blocked blocked = Blocked::dark);

}  // namespace parvis::light
