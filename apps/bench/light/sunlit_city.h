// A city in the light of the sun alone, drawn by the renderer: what each technique of shadowMap leaves of the
// sun in each pixel.
#pragma once

#include <memory>

#include "bench/light/exact_sun.h"
#include "graphics/light/shadow_settings.h"
#include "graphics/render/frame_views.h"

namespace parvis::bench {

/// The pictures of SunlitCity. They are as large as a window that is kept fluent, because the share of pixels
/// that lie at an edge grows as pictures shrink; every fourth pixel each way is judged: the other tracer
/// takes its time.
inline constexpr JudgedPixels sunlit_pixels{640, 360, 4};

/// The light of each pixel: of its four samples as they are resolved for the eye, and of its very middle,
/// which at edges shows one surface where the samples show two.
struct DrawnSun {
  SunShares resolved, middle;
};

/// A target of one sample per pixel, which lies in the pixel's middle.
class MiddleTarget {
 public:
  MiddleTarget();
  /// The main view as the renderer drew it last, once more.
  ImageF drawn(render::Renderer& renderer) const;

 private:
  gl::Texture colour_, depth_;
  gl::Framebuffer framebuffer_;
};

/// Counts the views of shadow maps that a renderer draws. Draws nothing.
class ShadowViewCounter final : public render::Drawable {
 public:
  render::Extents extents() const override { return {}; }
  void prepare(const render::View& view, const render::Culling& /*culling*/) override {
    count_ += view.kind == render::ViewKind::shadow ? 1 : 0;
  }
  void draw(const render::View& /*view*/, render::Pass /*pass*/) override {}
  /// Shadow views that were prepared.
  int count() const { return count_; }

 private:
  int count_ = 0;
};

/// With and without shadows: the quotient of both pictures is what shadows leave.
class SunlitCity {
 public:
  /// `twin` is an opaque_twin. Fails if a shader does.
  static Result<std::unique_ptr<SunlitCity>> create(const scene::Scene& twin);

  /// Of both scenes: a unit vector.
  void set_sun(glm::vec3 to_sun);
  /// The view that is drawn next. Fails as render::draw_frame.
  Status look(const Camera& camera);
  /// The shares of the sun in the view that was set. Rays go to the middle of the sun, as those of a view
  /// that moves do with any settings. Fails as render::draw_frame.
  Result<DrawnSun> sun(light::ShadowTechnique technique);
  /// Begins a frame of a view by the technique, and draws nothing of the view itself. True where that has
  /// drawn shadow maps.
  bool draws_maps(const Camera& camera, light::ShadowTechnique technique);
  /// Views of shadow maps that were drawn for all frames so far.
  int map_views() const { return map_views_.count(); }

 private:
  struct Pictures {
    ImageF resolved, middle;
  };
  Status draw(render::Renderer& renderer, const scene::Scene& scene, Pictures& pictures) const;

  void set_technique(light::ShadowTechnique technique);

  scene::Scene shaded_, open_;
  ShadowViewCounter map_views_;
  std::unique_ptr<render::Renderer> renderer_, open_renderer_;
  MiddleTarget middles_;
  Camera camera_;
  Pictures unshaded_;
};

}  // namespace parvis::bench
