// Light along paths through the scene, as a photograph gathers it: sun, sky, emission, over any number of
// surfaces. Unbiased: the mean over all samples is the light that arrives (Veach 1997, chapters 8 to 10).
// Shared with the renderer: surfaces and their BRDF, the sky picture, haze. Not shared: shadow maps, sky
// visibility, baked occlusion, painted contact shadows; the scene itself throws those.
#pragma once

#include <cstdint>
#include <optional>

#include "graphics/reference/ray_scene.h"
#include "graphics/reference/sample_sequence.h"
#include "graphics/reference/scatter.h"
#include "graphics/reference/shading_point.h"
#include "graphics/reference/sky_sampler.h"
#include "graphics/reference/sun_disc.h"

namespace parvis::reference {

/// How paths meet the sun and the sky. Each finds the same mean; both together, weighed by the power
/// heuristic, with the least noise. (Smooth mirrors are always followed, and find no light but by their one
/// direction.)
enum class LightStrategy : std::uint8_t { both, chosen_lights, scattered_rays };

struct PathOptions {
  std::optional<int>
      bounces;  ///< maximum number of scattering surfaces; none: paths end by Russian roulette alone
  /// The most radiance, before exposure, that one path may bring from beyond its first bounce. None:
  /// unbiased.
  std::optional<float> clamp;
  LightStrategy strategy = LightStrategy::both;
};

class PathTracer {
 public:
  /// All must outlive this.
  PathTracer(const RayScene& rays, const scene::Scene& scene, const shading::SkyLight& sky,
             const PathOptions& options);

  struct Sample {
    glm::vec3 radiance;
    bool meets_scene;    ///< else the sky alone
    std::uint64_t rays;  ///< of all kinds
  };
  /// One path that begins with a camera's ray; `spread` (radians) is the width of what its sample stands for.
  Sample sample(const Ray& ray, float spread, SampleSequence& numbers, std::uint64_t chance_seed) const;

 private:
  struct Path;
  glm::vec3 surroundings(const Path& path) const;
  glm::vec3 light_at(const ShadingPoint& point, const Scatter& scatter, Path& path) const;
  glm::vec3 light_from(glm::vec3 direction, glm::vec3 radiance, float density, const ShadingPoint& point,
                       const Scatter& scatter, Path& path) const;
  bool goes_on(const ShadingPoint& point, const Scatter& scatter, float width_m, Path& path) const;
  bool passes_glass(const ShadingPoint& point, float ior, float width_m, Path& path) const;
  float weight(float density, float other_density, bool is_chosen_light) const;

  const RayScene& rays_;
  const shading::SkyLight& sky_;
  SunDisc sun_;
  SkySampler sky_sampler_;
  float haze_per_m_;
  PathOptions options_;
};

}  // namespace parvis::reference
