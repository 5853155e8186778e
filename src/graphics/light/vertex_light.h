// Diffuse light of sky and sun at the vertices of virtual objects (thesis, section 5.3.4 and appendix A.2.2):
// with the visibility of the sky by rays, interpolated between places where it was traced before, or not at
// all.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "base/bounds.h"
#include "graphics/light/sky_model.h"
#include "graphics/reference/ray_scene.h"
#include "scene/data/sun_shadows.h"

namespace parvis::light {

struct LitVertex {
  glm::vec3 position, normal;  ///< in the world; unit normal
};

/// A sky that is asked for many directions: its radiance in a table, linear Rec. 709.
class SkyTable {
 public:
  explicit SkyTable(const SkyModel& sky);
  /// Of a scene, as its renderer has them: Scene::sky, Scene::sun, and the lamp in the sun's place.
  explicit SkyTable(const scene::Scene& scene);
  /// Radiance of the sky without the sun's disc, from a unit direction.
  glm::vec3 radiance(glm::vec3 direction) const;
  /// Unit direction to the sun.
  glm::vec3 to_sun() const { return to_sun_; }
  /// Irradiance of the sun on a surface that faces it.
  glm::vec3 sun_irradiance() const { return sun_irradiance_; }
  /// A lamp in the sun's place, or none.
  const std::optional<scene::Spot>& spot() const { return spot_; }
  /// Irradiance of the open sky without the sun on a surface with unit `normal`.
  glm::vec3 irradiance(glm::vec3 normal) const;

 private:
  void fill(const std::function<glm::vec3(glm::vec3 direction)>& radiance);

  static constexpr int side = 128;  ///< of an octahedral map
  glm::vec3 to_sun_, sun_irradiance_;
  std::optional<scene::Spot> spot_;
  std::vector<glm::vec3> texels_;
  std::array<glm::vec3, 9> sh_{};  ///< shading/sky.glsl
};

/// What a ray that does not reach the sky brings.
enum class Blocked : std::uint8_t {
  dark,    ///< nothing: the sum of the thesis's appendix A.2, visibility alone
  bounces  ///< light that the surface it hits gives back of the sun, which a ray finds, and of half the sky
};

/// The irradiance of vertices, traced progressively: each call adds rays, and what was traced counts on.
class VertexLight {
 public:
  explicit VertexLight(std::vector<LitVertex> vertices);

  /// The object has moved, or the light has changed: what was traced no longer counts.
  void restart(std::vector<LitVertex> vertices);
  /// Restarts for the same vertices.
  void restart();

  /// Adds `rays` directions of low discrepancy per vertex, cosine-weighted about its normal, and a quarter as
  /// many to the sun's disc. Same result for any number of threads, and however rays are divided into calls
  /// of whole fours.
  void refine(const reference::RayScene& scene, const SkyTable& sky, int rays,
              Blocked blocked = Blocked::dark);

  /// Of each vertex, linear Rec. 709 in W/m2; zero before the first rays.
  std::vector<glm::vec3> irradiance() const;
  /// The same without the sun.
  std::vector<glm::vec3> sky_irradiance() const;
  /// Rays that each vertex has had.
  int rays() const { return rays_; }
  /// As given.
  const std::vector<LitVertex>& vertices() const { return vertices_; }

 private:
  void add_sky_light(const reference::RayScene& scene, const SkyTable& sky, std::size_t vertex,
                     std::span<const glm::vec2> disc, std::size_t bounces);
  glm::vec3 sun_light(const reference::RayScene& scene, const SkyTable& sky, std::size_t vertex,
                      std::span<const glm::vec2> disc) const;

  std::vector<LitVertex> vertices_;
  std::vector<glm::vec3> sky_sums_, bounced_sums_, sun_sums_;
  int rays_ = 0, sun_rays_ = 0;
};

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
  /// Number of places.
  std::size_t size() const { return masks_.size(); }

 private:
  std::uint64_t mask(glm::ivec3 place) const;
  glm::vec3 origin_;
  glm::ivec3 counts_;
  float spacing_m_;
  std::vector<std::uint64_t> masks_;
};

/// What interpolation finds for vertices: irradiance by the sky, and by the sun or the lamp in its place.
struct InterpolatedLight {
  std::vector<glm::vec3> sky, sun;
};

/// With interpolated visibility, no rays at all; the sun by one ray per vertex. Here and in open_irradiance
/// `Blocked::bounces` has the sky's own ground shine from below, where `dark` leaves out all that is below.
InterpolatedLight interpolated_irradiance(const std::vector<LitVertex>& vertices,
                                          const VisibilityPlaces& places, const reference::RayScene& scene,
                                          const SkyTable& sky, Blocked blocked = Blocked::dark);

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
std::vector<glm::vec3> open_irradiance(const std::vector<LitVertex>& vertices, const SkyTable& sky,
                                       Blocked blocked = Blocked::dark);

}  // namespace parvis::light
