// Follows rays: what one that leaves the eye shows, with what mirrors and glass on its way show.
#pragma once

#include <optional>
#include <span>

#include "graphics/reference/glass_walk.h"
#include "graphics/reference/lobe_points.h"
#include "graphics/reference/surface_light.h"
#include "graphics/reference/tracer.h"

namespace parvis::reference {

/// Follows the rays of one pixel, or of a packet of pixels.
class PixelTracer {
 public:
  /// Keeps all that it is given but the options.
  PixelTracer(const RayScene& rays, const scene::Scene& scene, const shading::SkyLight& sky,
              const TraceOptions& options);

  /// Light that comes along a cone from the eye's surroundings. `is_mirror`: set where its first surface is
  /// one.
  glm::vec3 radiance(const Cone& cone, LobePoints& lobe_points, std::uint64_t& ray_count,
                     bool& is_mirror) const;

  /// Finds the light of mirrors in drawn pixels that lie side by side, at most RayScene::packet_size of them.
  void find_light_of_mirrors(std::span<const MirrorPixel> pixels, glm::vec3 eye, float spread,
                             std::span<std::optional<MirrorLight>> light) const;

 private:
  struct FirstHit;
  struct MirrorPoint;
  struct MirrorRay;

  glm::vec3 followed(Cone cone, int bounce, int hidden_object, LobePoints& lobe_points,
                     std::uint64_t& ray_count, bool* is_mirror, const FirstHit& first) const;
  glm::vec3 shade(const ShadingPoint& point, const Hit& hit, const Cone& cone, int bounce, float sun,
                  LobePoints& lobe_points, std::uint64_t& ray_count) const;
  glm::vec3 light_through(const ShadingPoint& point, const Hit& hit, const Cone& cone, int bounce,
                          LobePoints& lobe_points, std::uint64_t& ray_count) const;
  void find_mirror_light(std::span<MirrorPoint> mirrors, int bounce, std::uint64_t& ray_count) const;
  MirrorLight mirror_light(const ShadingPoint& point, const Hit& hit, const Cone& cone, int bounce,
                           LobePoints& lobe_points, std::uint64_t& ray_count) const;
  template <class DirectionOf, class Take>
  void trace_from(std::span<MirrorPoint> mirrors, int bounce, std::uint64_t& ray_count,
                  const DirectionOf& direction_of, const Take& take) const;
  void look_ahead(std::span<const MirrorRay> mirror_rays, std::span<FirstHit> first,
                  std::uint64_t& ray_count) const;
  std::optional<Hit> mirror_near(Ray ray, std::optional<Hit> hit, int object) const;
  std::optional<Hit> nearest_hit_but(Ray ray, int hidden_object) const;
  int hidden_from(const Hit& hit) const { return mirrors_see_themselves_ ? -1 : hit.place->object; }

  MirrorPoint mirror_in(const MirrorPixel& pixel, const Cone& cone, const Hit& hit) const;
  static Cone mirrored_cone(const MirrorPoint& mirror, glm::vec3 direction);

  const RayScene& rays_;
  SurfaceLight light_;
  int mirror_bounces_;
  bool mirrors_see_themselves_;
  glm::vec4 realism_;  ///< shading::realism_at
};

}  // namespace parvis::reference
