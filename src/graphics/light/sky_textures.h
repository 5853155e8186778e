// The sky on the GPU: its picture with the blurred levels as mipmaps, how much of it each place sees, and the
// pass that draws it behind all else.
#pragma once

#include "graphics/gl/program.h"
#include "graphics/render/gpu_scene.h"
#include "graphics/render/view.h"
#include "graphics/shading/sky.h"
#include "graphics/shading/sky_visibility.h"
#include "scene/data/scene.h"

namespace parvis::light {

class SkyTextures {
 public:
  static Result<SkyTextures> create(const scene::Scene& scene);

  /// Takes over another sky: its picture (by its file and version), strength or heading; false where it is
  /// the same. Takes as long as when the scene was loaded.
  bool renew_light(const scene::Sky& sky);
  /// Takes over static things that appeared, vanished or moved in this frame: `change`, of which what is the
  /// scene's has been taken over by `gpu`.
  void renew_visibility(const scene::Scene& scene, const render::GpuScene& gpu,
                        const render::FixedChange& change);

  /// Texture units `sky_unit` and `sky_visibility_unit`.
  void bind() const;
  /// Fills what the depth buffer says is empty.
  void draw(const render::View& view) const;

  const shading::SkyLight& light() const { return light_; }
  const shading::SkyVisibility& visibility() const { return visibility_; }

 private:
  SkyTextures(const scene::Scene& scene, gl::Program program);

  /// The input that the light was made of.
  struct Source {
    int version;
    float intensity, heading;
    bool operator==(const Source&) const = default;
  };
  static Source source_of(const scene::Sky& sky) { return {sky.version, sky.intensity, sky.heading}; }

  Source source_;
  shading::SkyLight light_;
  shading::Heightfield heights_;  ///< of what is fixed and seen
  shading::SkyVisibility visibility_;
  gl::Program program_;
  gl::Texture picture_, cells_;
  gl::VertexArray no_attributes_;
};

}  // namespace parvis::light
