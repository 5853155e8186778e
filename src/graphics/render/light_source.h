// What lights the pictures, as one seam of the renderer: sun, sky, air, and what of them each place sees.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "graphics/render/drawable.h"
#include "graphics/render/frame.h"
#include "graphics/render/gpu_scene.h"
#include "graphics/shading/drawn_light.h"
#include "graphics/shading/sky.h"
#include "scene/data/sun_shadows.h"

namespace parvis::render {

/// Draws a view of all drawables, for those who make shadow maps.
using DrawView = std::function<void(const View&)>;

/// The sun of each pixel of a main view, found by other means than maps: texels of two floats, the share of
/// the sun and the distance of the surface from the viewer, bottom row first. 0: there is none.
using TracedSun = GLuint;

/// The fraction of the sun that each point sees, by maps that are drawn for the viewer; sun_lookup.glsl looks
/// them up.
class ShadowMethod {
 public:
  virtual ~ShadowMethod() = default;
  /// Static things appeared, vanished or moved in this frame; `fixed` bounds all of them, hidden ones
  /// included.
  virtual void renew(const FixedChange& change, const Bounds& fixed) = 0;
  /// Draws what a viewer needs; everything when the sun has moved. `moving` bounds each dynamic caster.
  virtual void update(const Camera& camera, const scene::SunLight& sun, std::span<const Bounds> moving,
                      const DrawView& draw) = 0;
  /// Draws things that are held into the maps of the last update: they shade each other and themselves until
  /// the next call. `casters` bounds them.
  virtual void cast_held(const Bounds& /*casters*/, const DrawView& /*draw*/) {}
  /// A main view of an eye is about to be drawn, of so many pixels. Its sun, where the method finds it pixel
  /// by pixel: good until the next call.
  virtual TracedSun trace_view(const Camera& /*camera*/, int /*width*/, int /*height*/) { return 0; }
  /// Binds the maps at `shadow_unit`.
  virtual void bind() const = 0;
  /// Matrices and texel sizes for the shaders' uniform block.
  virtual const shading::ShadowMaps& maps() const = 0;
  /// A copy for the ray tracer; waits for the GPU.
  virtual shading::SunShadow read_back() const = 0;
  /// The ray tracer is to trace the sun by itself: this method has no errors to agree with.
  virtual bool is_exact() const { return false; }
};

class LightSource;

/// Makes the light of a scene; `fixed` bounds all static things. Needs a current OpenGL context.
using MakeLight =
    std::function<Result<std::unique_ptr<LightSource>>(const scene::Scene& scene, const Bounds& fixed)>;
/// Registry of light: the one source that lights all scenes. The room light sets it; a room that knows more
/// replaces it or lays its own light over it.
struct Lights {
  MakeLight make;
};

/// Light of a scene. Sun and sky may change in every frame; static geometry, too.
class LightSource {
 public:
  virtual ~LightSource() = default;
  /// First of a frame: takes over the scene's light. True where it differs from that of the last frame: what
  /// has been kept of pictures of the surroundings is then out of date.
  virtual bool update(const scene::Scene& scene) = 0;
  /// Static things appeared, vanished or moved in this frame: `change`, which `gpu` has taken over as far as
  /// they are the scene's. `fixed` bounds all of them.
  virtual void renew(const scene::Scene& scene, const GpuScene& gpu, const FixedChange& change,
                     const Bounds& fixed) = 0;
  /// Draws shadow maps for a viewer.
  virtual void draw_shadows(const Camera& camera, std::span<const Bounds> moving, const DrawView& draw) = 0;
  /// See ShadowMethod::cast_held.
  virtual void cast_held(const Bounds& /*casters*/, const DrawView& /*draw*/) {}
  /// See ShadowMethod::trace_view.
  virtual TracedSun trace_view(const Camera& /*camera*/, int /*width*/, int /*height*/) { return 0; }

  /// The sky's levels, its visibility and the shadow maps, at their units of bindings.h.
  virtual void bind() const = 0;
  /// Its members of the block that all views share.
  virtual void fill(Frame& frame) const = 0;
  /// The sky where the view's depth is empty.
  virtual void draw_sky(const View& view) const = 0;

  // What the ray tracer needs to agree with the picture.
  /// Sky radiance, its mipmap levels and its irradiance, as the renderer uses them.
  virtual const shading::SkyLight& sky() const = 0;
  /// The sky that the static scene leaves visible at each place.
  virtual const shading::SkyVisibility& sky_visibility() const = 0;
  /// The lamps that are lit; null where there are none.
  virtual const shading::LampTable* lamps() const { return nullptr; }
  /// Light that surfaces reflect onto each other; null where there is none.
  virtual const shading::BouncedLight* bounced() const { return nullptr; }
  /// Waits for the GPU. Points to the source's own, and to `body_shade`: good until the next frame begins.
  virtual shading::DrawnLight drawn_light(const shading::BodyShade& body_shade) const = 0;
};

}  // namespace parvis::render
