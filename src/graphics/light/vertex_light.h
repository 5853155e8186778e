// Diffuse light of sky and sun at the vertices of virtual objects (thesis, section 5.3.4 and appendix A.2.2):
// with the visibility of the sky by rays, interpolated between places where it was traced before, or not at
// all.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "base/bounds.h"
#include "graphics/light/sky_model.h"
#include "graphics/reference/ray_scene.h"

namespace parvis::light {

struct LitVertex {
  glm::vec3 position, normal;  ///< in the world; unit normal
};

/// A sky that is asked for many directions: its radiance in a table, linear Rec. 709.
class SkyTable {
 public:
  explicit SkyTable(const SkyModel& sky);
  /// Radiance of the sky without the sun's disc, from a unit direction.
  glm::vec3 radiance(glm::vec3 direction) const;
  /// Unit direction to the sun.
  glm::vec3 to_sun() const { return to_sun_; }
  /// Irradiance of the sun on a surface that faces it.
  glm::vec3 sun_irradiance() const { return sun_irradiance_; }

 private:
  static constexpr int side = 128;  ///< of an octahedral map
  glm::vec3 to_sun_, sun_irradiance_;
  std::vector<glm::vec3> texels_;
};

/// The irradiance of vertices, traced progressively: each call adds rays, and what was traced counts on.
class VertexLight {
 public:
  explicit VertexLight(std::vector<LitVertex> vertices);

  /// The object has moved, or the light has changed: what was traced no longer counts.
  void restart(std::vector<LitVertex> vertices);
  /// Restarts for the same vertices.
  void restart() { restart(std::move(vertices_)); }

  /// Adds `rays` directions of low discrepancy per vertex, cosine-weighted about its normal, and a quarter as
  /// many to the sun's disc. What stands in the way gives no light. Same result for any number of threads,
  /// and however rays are divided into calls of whole fours.
  void refine(const reference::RayScene& scene, const SkyTable& sky, int rays);

  /// Of each vertex, linear Rec. 709 in W/m2; zero before the first rays.
  std::vector<glm::vec3> irradiance() const;
  /// Rays that each vertex has had.
  int rays() const { return rays_; }

 private:
  std::vector<LitVertex> vertices_;
  std::vector<glm::vec3> sky_sums_, sun_sums_;
  int rays_ = 0, sun_rays_ = 0;
};

/// What places of a region see of the sky, traced once: 64 directions each, a bit per direction.
class VisibilityPlaces {
 public:
  /// A place every `spacing_m` in `region`; at most a million. Those inside of things see nothing.
  VisibilityPlaces(const reference::RayScene& scene, const Bounds& region, float spacing_m);

  /// The share of the light of each direction that arrives at a point, between the eight places around it.
  void interpolate(glm::vec3 point, float (&shares)[64]) const;
  /// Evenly over the upper hemisphere; each stands for 2 pi / 64 steradians.
  static const std::vector<glm::vec3>& directions();
  /// Number of places.
  std::size_t size() const { return masks_.size(); }

 private:
  std::uint64_t mask(glm::ivec3 place) const;
  glm::vec3 origin_;
  glm::ivec3 counts_;
  float spacing_m_;
  std::vector<std::uint64_t> masks_;
};

/// With interpolated visibility, no rays at all; the sun by one ray per vertex.
std::vector<glm::vec3> interpolated_irradiance(const std::vector<LitVertex>& vertices,
                                               const VisibilityPlaces& places,
                                               const reference::RayScene& scene, const SkyTable& sky);

/// How an object that has moved is lit again.
enum class Relighting : unsigned char { traced, interpolated, open };

/// The best that a time budget allows for so many vertices, given how many rays a millisecond traces; `rays`
/// is how many each vertex gets when it is traced.
struct RelightingPlan {
  Relighting method;
  int rays;
};
/// Chooses tracing while at least one round of rays fits the budget, else interpolation where there are
/// places.
RelightingPlan plan_relighting(std::size_t vertices, double budget_ms, double rays_per_ms, bool has_places);

/// As if nothing stood in the way.
std::vector<glm::vec3> open_irradiance(const std::vector<LitVertex>& vertices, const SkyTable& sky);

}  // namespace parvis::light
