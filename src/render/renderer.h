// Draws the scene: shadows, the main view at four samples a pixel, the sky, tone mapping; and small views for
// those rooms that ask for them. Everything that draws is a Drawable.
#pragma once

#include <memory>
#include <vector>

#include "base/image.h"
#include "gl/context.h"
#include "render/scene_drawable.h"
#include "render/sun_shadow_maps.h"
#include "shading/sky.h"

namespace parvis::render {

class Renderer {
 public:
  /// Needs a current OpenGL 4.5 context for as long as it lives. Uploads the scene; fails only if a shader
  /// does.
  static Result<std::unique_ptr<Renderer>> create(const scene::Scene& scene);
  Renderer(const Renderer&) = delete;

  /// A room's own drawables, drawn after the scene's in every view. Not owned.
  void add(Drawable* drawable) { drawables_.push_back(drawable); }
  Status set_reflection(ReflectionSource* source) { return scene_.set_reflection(source); }

  /// Takes over what moved, and draws the shadow maps for a viewer.
  void begin_frame(const scene::Scene& scene, const Camera& camera);
  /// Culls for the main view: afterwards `visible_objects` tells what reflections are worth making for.
  void prepare_main_view(const Camera& camera, int width, int height);
  const std::vector<int>& visible_objects() const { return scene_.visible_objects(); }
  /// Draws the view that was prepared, four samples a pixel, into `radiance_texture`.
  void draw_main_view();
  /// Draws a view of another room: a cube face, say, in linear radiance, with sky.
  void draw_view(const View& view);
  /// Object indices of a view (a scene's object and 1; 0: none), as a picture from the top left. A readback:
  /// for tools and tests, not for frames.
  std::vector<std::uint32_t> pick(const Camera& camera, int width, int height, bool culls_hidden);

  /// Tone-maps the main view into a framebuffer of its size.
  void display(GLuint framebuffer, float exposure);
  Image8 read_picture(float exposure);
  ImageF read_radiance() const;

  GLuint radiance_texture() const { return target_.radiance.name(); }
  int width() const { return target_.width; }
  int height() const { return target_.height; }
  const DrawStatistics& statistics() const { return scene_.main_statistics(); }
  const GpuScene& gpu() const { return scene_.gpu(); }
  const shading::SkyLight& sky() const { return sky_; }
  shading::SunShadow sun_shadow() const { return shadows_.read_back(); }

 private:
  struct Target {
    int width = 0, height = 0;
    gl::Texture samples, sample_depth, radiance, picture;
    gl::Framebuffer multisampled, resolved, displayed;
  };
  struct Programs {
    gl::Program sky, display;
  };

  Renderer(const scene::Scene& scene, SceneDrawable drawable, Programs programs);
  void upload_sky();
  void resize(int width, int height);
  void begin_view(const View& view);
  void draw_prepared(const View& view);
  void bind_frame(const View& view);

  shading::SkyLight sky_;
  scene::Sun sun_;
  float haze_per_m_;
  SceneDrawable scene_;
  Programs programs_;
  SunShadowMaps shadows_;
  std::vector<Drawable*> drawables_;
  StreamBuffer frame_blocks_;
  gl::Texture sky_texture_;
  gl::VertexArray no_attributes_;
  Target target_;
  View main_view_;
};

}  // namespace parvis::render
