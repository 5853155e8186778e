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
class OwnFaces;
class Packet;

/// The irradiance of vertices, traced progressively: each call adds rays, and what was traced counts on.
class VertexLight {
 public:
  explicit VertexLight(std::vector<LitVertex> vertices);

  /// The object has moved: what was traced no longer counts.
  void restart(std::vector<LitVertex> vertices);
  /// Restarts for the same vertices.
  void restart();
  /// The object has moved without being turned or changed: as `restart`, but what rays hit of the object
  /// itself is kept.
  void shift(std::vector<LitVertex> vertices);
  /// The light has changed and nothing has moved. What rays found of the sky, and of its light that surfaces
  /// give back, is known under the new sky at once, without a ray; the sun and what surfaces give back of it
  /// are found by the next rays, and the latter is estimated until then.
  void follow(const SkyTable& sky);

  /// Adds `rays` directions of low discrepancy per vertex, cosine-weighted about its normal, and a quarter as
  /// many to the sun's disc; after `follow` those come first that bring the sun. Same result for any number
  /// of threads, and however rays are divided into calls of whole fours.
  ///
  /// With `own`, the faces of the vertices' object as it stands now, which `scene` has set apart, and with
  /// bounces: what a ray hits of the object is found once and kept by `shift`, all rays that hit it bring
  /// the light of its faces, and the others are traced among other things alone. If some calls have `own` and
  /// some have not, what was traced before no longer counts.
  void refine(const reference::RayScene& scene, const SkyTable& sky, int rays,
              Blocked blocked = Blocked::dark, const OwnFaces* own = nullptr);

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
  /// Of sky and sun, over the rays of a vertex, or over those of them that bring bounces.
  struct Sums {
    glm::vec3 sky{0.0f}, sun{0.0f};
    float odd_sky = 0.0f, odd_sun = 0.0f;  ///< green of odd rays
    void add_sky(std::size_t ray, glm::vec3 light) {
      sky += light;
      if (ray % 2 == 1) odd_sky += light.y;
    }
    void add_sun(std::size_t ray, glm::vec3 light) {
      sun += light;
      if (ray % 2 == 1) odd_sun += light.y;
    }
  };
  /// By what each harmonic of a sky's irradiance is multiplied in the sum of what surfaces give back of it.
  using Transfer = std::array<glm::vec3, 9>;
  /// What surfaces give back to a vertex.
  struct Bounces {
    Sums sums;
    Transfer transfer{};
  };
  /// What of the object itself a ray hits first.
  struct OwnHit {
    std::uint32_t face;  ///< OwnFaces::number, or `no_face`
    float distance_m;
  };
  static constexpr std::uint32_t no_face = ~0u;
  enum class Finds : unsigned char { all, sun };  ///< what of the light of its rays a call finds

  void add_rays(const reference::RayScene& scene, const SkyTable& sky, int first, int count, Blocked blocked,
                const OwnFaces* own, Finds finds);
  void find_own(const reference::RayScene& scene, const OwnFaces& own, int rays);
  class Turn;
  void open(std::size_t vertex, std::size_t ray, glm::vec3 radiance);
  const OwnHit& own_hit(std::size_t vertex, std::size_t ray) const {
    return own_hits_[ray * vertices_.size() + vertex];
  }
  bool is_open(std::size_t vertex, std::size_t ray) const;
  glm::vec3 unshadowed(std::size_t vertex) const;
  glm::vec3 mean_bounced_sun(std::size_t vertex) const;
  std::vector<glm::vec3> bounced_sun() const;
  glm::vec2 halves_of_bounced_sun(std::size_t vertex) const;
  float share_in_sun() const;

  std::vector<LitVertex> vertices_;
  std::vector<Sums> sums_;           ///< of what arrives straight
  std::vector<std::uint64_t> open_;  ///< a bit for each ray: 64 rays of all vertices, then the next 64
  std::vector<Bounces> bounces_;     ///< by rays that bring them; none before the first
  std::vector<Bounces> own_;         ///< by all rays, of the object itself; none without OwnFaces
  std::vector<OwnHit> own_hits_;     ///< a ray of all vertices, then the next
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
