// Light that reaches a surface which rays have found, but for what its mirror rays show: the sun, lamps, the
// sky and bounced light as the renderer has them, light that is kept at vertices.
#pragma once

#include <optional>

#include "graphics/reference/ray_scene.h"
#include "graphics/reference/shading_point.h"
#include "graphics/reference/sun_disc.h"
#include "graphics/reference/tracer.h"
#include "graphics/shading/lighting.h"
#include "scene/data/sun_shadows.h"
#include "scene/data/vertex_irradiance.h"

namespace parvis::reference {

/// Light about a place, where no ray is traced for it: by default an open sky alone.
struct Surroundings {
  glm::vec4 sky_cell{0.5f, 0.5f, 0.5f, 1.0f};  ///< shading/sky_visibility.glsl
  shading::BouncedCell bounced{glm::vec4(0.0f), glm::vec3(0.0f), glm::vec3(1.0f)};
};

/// A ray toward the sun, where one decides whether it is seen.
struct SunRay {
  float let_in;  ///< of the sun, where nothing blocks the ray; where there is none, all that is known
  std::optional<Ray> ray;
};

/// The light of a scene, by the renderer's own functions.
class SurfaceLight {
 public:
  /// Keeps all that it is given; `drawn_light` as TraceOptions has it.
  SurfaceLight(const RayScene& rays, const scene::Scene& scene, const shading::SkyLight& sky,
               const shading::DrawnLight* drawn_light);
  SurfaceLight(const SurfaceLight&) = delete;
  SurfaceLight& operator=(const SurfaceLight&) = delete;

  /// Radiance along a ray that hits nothing; the sun's disc only where it is looked at directly.
  glm::vec3 behind_all(glm::vec3 direction, bool is_direct) const;
  /// The radiance of a surface so far away, through the haze.
  glm::vec3 through_haze(glm::vec3 radiance, float distance_m) const;

  /// How much of the sun a surface that `hit` has found sees. None is asked for where it shows nothing of it.
  SunRay ray_to_sun(const ShadingPoint& point, const Hit& hit) const;
  /// The same with its ray traced, which is counted.
  float sun_visible(const ShadingPoint& point, const Hit& hit, std::uint64_t& ray_count) const;

  /// The renderer's data of a place.
  Surroundings surroundings_at(const ShadingPoint& point, int object) const;
  /// Radiance in a direction for which no ray is traced: the sky where it is open, else surfaces as bright as
  /// the light that they reflect.
  glm::vec3 unmapped_radiance(const Surroundings& around, glm::vec3 direction, float roughness) const;
  /// Mirrored light where no ray is traced, attenuated by leaves before the surface.
  MirrorLight unmapped_light(const shading::Surface& s, glm::vec3 direction, const Surroundings& around,
                             float openness) const;

  /// The light that is kept at the vertices of what `hit` has found, or null.
  const scene::LitVertices* lit_vertices(const Hit& hit) const {
    return lit_->of(std::size_t(hit.place->object));
  }
  /// Light toward the viewer of the surface `s` at `point`, which mirrors `mirrored`. `sun`: share of it that
  /// is seen.
  glm::vec3 radiance(const ShadingPoint& point, const Hit& hit, shading::Surface s, glm::vec3 to_viewer,
                     float sun, const Surroundings& around, const MirrorLight& mirrored,
                     std::uint64_t& ray_count) const;

 private:
  glm::vec3 lamp_radiance_at(const ShadingPoint& point, const shading::Surface& s, glm::vec3 to_viewer,
                             std::uint64_t& ray_count) const;
  float kept_of_recorded(const ShadingPoint& point, std::uint64_t& ray_count) const;
  glm::vec3 to_sun_at(glm::vec3 position) const;
  Ray ray_to_sun_from(const ShadingPoint& point, glm::vec3 to_sun) const;

  const RayScene& rays_;
  const shading::SkyLight& sky_;
  const shading::DrawnLight* drawn_light_;
  shading::LampTable own_lamps_;  ///< where nothing was drawn
  const shading::LampTable* lamps_ = nullptr;
  SunDisc sun_disc_;
  shading::SceneLight light_;
  std::optional<scene::Spot> spot_;
  const scene::VertexIrradiance* lit_ = nullptr;
};

}  // namespace parvis::reference
