// Diffuse light of sky and sun at the vertices of virtual objects (thesis, section 5.3.4 and appendix A.2.2),
// traced progressively. What rays found of the sky is kept as the directions that are open, so that it holds
// for any other sky.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "graphics/light/estimate_weights.h"
#include "graphics/light/lit_vertex.h"
#include "graphics/light/sky_table.h"
#include "graphics/light/visibility_places.h"
#include "graphics/reference/ray_scene.h"

namespace parvis::light {

class DiscPatterns;
class Packet;

/// The irradiance of vertices, traced progressively: each call adds rays, and what was traced counts on.
class VertexLight {
 public:
  explicit VertexLight(std::vector<LitVertex> vertices);

  /// The object has moved: what was traced no longer counts.
  void restart(std::vector<LitVertex> vertices);
  /// Restarts for the same vertices.
  void restart();
  /// The light has changed and nothing has moved. What rays found of the sky, and of its light that surfaces
  /// give back, is known under the new sky at once, without a ray; the sun and what surfaces give back of it
  /// are found by the next rays, and the latter is estimated until then.
  void follow(const SkyTable& sky);

  /// Adds `rays` directions of low discrepancy per vertex, cosine-weighted about its normal, and a quarter as
  /// many to the sun's disc; after `follow` those come first that bring the sun. Same result for any number
  /// of threads, and however rays are divided into calls of whole fours.
  void refine(const reference::RayScene& scene, const SkyTable& sky, int rays,
              Blocked blocked = Blocked::dark);

  /// Of each vertex, linear Rec. 709 in W/m2; zero before the first rays.
  std::vector<glm::vec3> irradiance() const;
  /// The same without the sun that comes straight.
  std::vector<glm::vec3> sky_irradiance() const;
  /// Of the sun that comes straight.
  std::vector<glm::vec3> sun_irradiance() const;
  /// sky_irradiance by rays of even and by those of odd numbers.
  Halves halves_of_sky() const;
  /// The same of sun_irradiance.
  Halves halves_of_sun() const;
  /// Rays that each vertex has had under this sky and sun.
  int rays() const { return sunlit_rays_; }
  /// Rays whose directions are known to be open or not, under any sky.
  int sky_rays() const { return rays_; }
  /// As given.
  const std::vector<LitVertex>& vertices() const { return vertices_; }

 private:
  /// Over the rays of a vertex.
  struct Sums {
    glm::vec3 sky{0.0f}, bounced{0.0f}, bounced_sun{0.0f}, sun{0.0f};  ///< bounced: that of the sky
    float odd_sky = 0.0f, odd_bounced = 0.0f, odd_bounced_sun = 0.0f, odd_sun = 0.0f;  ///< odd rays' green
  };
  /// By what each harmonic of a sky's irradiance is multiplied in the sum of what surfaces give back of it.
  using Transfer = std::array<glm::vec3, 9>;
  enum class Finds : unsigned char { all, sun };  ///< what of the light of its rays a call finds

  void add_rays(const reference::RayScene& scene, const SkyTable& sky, int first, int count, Blocked blocked,
                Finds finds);
  void add_to_sky(const reference::RayScene& scene, const SkyTable& sky, std::size_t begin, std::size_t end,
                  const DiscPatterns& disc, Blocked blocked, Finds finds);
  void add_open(Packet& packet, const SkyTable& sky);
  void add_seen(const reference::RayScene& scene, Packet& packet, const SkyTable& sky, Finds finds);
  void open(std::size_t vertex, std::size_t ray, glm::vec3 radiance);
  void add_from_sky(std::size_t vertex, std::size_t ray, glm::vec3 radiance);
  bool is_open(std::size_t vertex, std::size_t ray) const;
  glm::vec3 unshadowed(std::size_t vertex) const;
  std::vector<glm::vec3> bounced_sun() const;
  float share_in_sun() const;

  std::vector<LitVertex> vertices_;
  std::vector<Sums> sums_;
  std::vector<std::uint64_t> open_;  ///< a bit for each ray: 64 rays of all vertices, then the next 64
  std::vector<Transfer> transfers_;  ///< none before the first bounces
  int rays_ = 0;                     ///< whose directions are known to be open or not
  int sunlit_rays_ = 0;              ///< of them, under this sun
  int sun_rays_ = 0;
  Transfer sun_harmonics_{};          ///< of the irradiance of this sun
  float former_share_in_sun_ = 0.5f;  ///< share_in_sun under the sun before
};

/// Irradiance of the sun at vertices by `rays` to its disc each, all of them in common packets.
std::vector<glm::vec3> traced_sun(const std::vector<LitVertex>& vertices, const reference::RayScene& scene,
                                  const SkyTable& sky, int rays);

/// A vertex interpolates in the time of about so many.
inline constexpr double rays_per_interpolation = 2.0;

/// How an object that has moved is lit again.
enum class Relighting : unsigned char { traced, interpolated, open };

/// The best that a time budget allows for so many vertices, given how many rays a millisecond traces; `rays`
/// is how many each vertex gets when it is traced, and of interpolated ones how many go to the sun.
struct RelightingPlan {
  Relighting method;
  int rays;
};
/// Chooses tracing while at least one round of rays fits the budget, else interpolation where there are
/// places.
RelightingPlan plan_relighting(std::size_t vertices, double budget_ms, double rays_per_ms, bool has_places);

}  // namespace parvis::light
