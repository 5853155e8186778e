// Path tracer for reference photographs: sun, sky and emission over any number of bounces. Unbiased: the mean
// over all samples converges to the incident radiance (Veach 1997, chapters 8 to 10). Shared with the
// renderer: surfaces and their BRDF, the sky image, haze. Not shared: shadow maps, sky visibility, baked
// occlusion, painted contact shadows; here the geometry itself casts those. The backdrop of a captured place
// is seen by the camera, through glass and in smooth mirrors; what lies before it is lit by the sky.
#pragma once

#include <cstdint>
#include <optional>

#include "graphics/reference/ray_scene.h"
#include "graphics/reference/sample_sequence.h"
#include "graphics/reference/scatter.h"
#include "graphics/reference/scene_lamps.h"
#include "graphics/reference/shading_point.h"
#include "graphics/reference/sky_sampler.h"
#include "graphics/reference/sun_disc.h"

namespace parvis::reference {

/// How paths sample sun and sky: next-event estimation, BSDF sampling, or both weighted by the power
/// heuristic, which has the least noise. All converge to the same mean. (Smooth mirrors have one direction:
/// they are always followed and find no light by next-event estimation.)
enum class LightStrategy : std::uint8_t { both, chosen_lights, scattered_rays };

/// Limits of the paths and the sampling strategy.
struct PathOptions {
  std::optional<int>
      bounces;  ///< maximum number of scattering surfaces; none: paths end by Russian roulette alone
  /// Maximum radiance, before exposure, that one path may contribute beyond its first bounce. Unset:
  /// unbiased.
  std::optional<float> clamp;
  LightStrategy strategy = LightStrategy::both;
};

/// Estimates radiance along camera rays. Safe to use from many threads: `sample` changes only its arguments.
class PathTracer {
 public:
  /// `rays`, `scene` and `sky` must outlive the tracer.
  PathTracer(const RayScene& rays, const scene::Scene& scene, const shading::SkyLight& sky,
             const PathOptions& options);

  /// Result of one path.
  struct Sample {
    glm::vec3 radiance;
    bool meets_scene;    ///< false if the camera's ray sees only the sky
    std::uint64_t rays;  ///< camera, scattered and shadow rays
  };
  /// Traces one path from a camera ray. `spread` (radians) is the angular width of the sample's footprint;
  /// `chance_seed` seeds the random passage through blended surfaces.
  Sample sample(const Ray& ray, float spread, SampleSequence& numbers, std::uint64_t chance_seed) const;

 private:
  struct Path;
  glm::vec3 surroundings(const Path& path) const;
  glm::vec3 light_at(const ShadingPoint& point, const Scatter& scatter, Path& path) const;
  glm::vec3 light_from(glm::vec3 direction, glm::vec3 radiance, float density, const ShadingPoint& point,
                       const Scatter& scatter, Path& path) const;
  glm::vec3 lamps_at(const ShadingPoint& point, const Scatter& scatter, Path& path) const;
  float kept_of_recorded(const ShadingPoint& point, Path& path) const;
  bool extend_path(const ShadingPoint& point, const Scatter& scatter, float width_m, Path& path) const;
  bool passes_glass(const ShadingPoint& point, float ior, float width_m, Path& path) const;
  float weight(float density, float other_density, bool is_chosen_light) const;

  const RayScene& rays_;
  const shading::SkyLight& sky_;
  SunDisc sun_;
  SkySampler sky_sampler_;
  shading::LampTable lamps_;
  float haze_per_m_;
  PathOptions options_;
};

}  // namespace parvis::reference
