// Diffuse light of sky and sun at the vertices of virtual objects (thesis, section 5.3.4 and appendix A.2.2),
// traced progressively. What rays found of the sky is kept as the directions that are open, so that it holds
// for any other sky.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "graphics/light/lit_vertex.h"
#include "graphics/light/sky_table.h"
#include "graphics/reference/ray_scene.h"

namespace parvis::light {

/// The irradiance of vertices, traced progressively: each call adds rays, and what was traced counts on.
class VertexLight {
 public:
  explicit VertexLight(std::vector<LitVertex> vertices);

  /// The object has moved: what was traced no longer counts.
  void restart(std::vector<LitVertex> vertices);
  /// Restarts for the same vertices.
  void restart();
  /// The light has changed and nothing has moved. The sky that the rays found open is known under the new
  /// light at once, without a ray; the sun and what surfaces reflect are found by the next rays.
  void follow(const SkyTable& sky);

  /// Adds `rays` directions of low discrepancy per vertex, cosine-weighted about its normal, and a quarter as
  /// many to the sun's disc; after `follow` the first of them find the sun and what surfaces reflect alone.
  /// The result is the same for any number of threads, and however rays are divided into calls of whole
  /// fours.
  void refine(const reference::RayScene& scene, const SkyTable& sky, int rays,
              Blocked blocked = Blocked::dark);

  /// Irradiance of each vertex, linear Rec. 709 in W/m2; zero before the first rays.
  std::vector<glm::vec3> irradiance() const;
  /// The same without the sun that comes straight.
  std::vector<glm::vec3> sky_irradiance() const;
  /// Irradiance by the sun that comes straight.
  std::vector<glm::vec3> sun_irradiance() const;
  /// Rays that each vertex has had under this sky and sun.
  int rays() const { return relit_rays_; }
  /// Rays whose directions are known to be open or not, under any sky.
  int sky_rays() const { return rays_; }
  /// The vertices as given.
  const std::vector<LitVertex>& vertices() const { return vertices_; }

 private:
  /// Sums over the rays of a vertex.
  struct Sums {
    glm::vec3 sky{0.0f};        ///< radiance of the sky, over rays that found it
    glm::vec3 reflected{0.0f};  ///< radiance of surfaces, over rays that bring it (brings_bounce)
    glm::vec3 sun{0.0f};        ///< irradiance by the sun that comes straight, over rays to it
  };
  enum class Finds : unsigned char { all, reflected };  ///< what a call's rays find, beside the sun

  void add_rays(const reference::RayScene& scene, const SkyTable& sky, int first, int count, Blocked blocked,
                Finds finds);
  class Turn;
  void open(std::size_t vertex, std::size_t ray, glm::vec3 radiance);
  bool is_open(std::size_t vertex, std::size_t ray) const;
  glm::vec3 mean_reflected(std::size_t vertex) const;

  std::vector<LitVertex> vertices_;
  std::vector<Sums> sums_;
  std::vector<std::uint64_t> open_;  ///< a bit for each ray: 64 rays of all vertices, then the next 64
  int rays_ = 0;                     ///< whose directions are known to be open or not
  int relit_rays_ = 0;               ///< of them, under this light
  int sun_rays_ = 0;
};

}  // namespace parvis::light
