// Draws the scene: shadows, the main view at four samples per pixel, the sky, tone mapping; and small views
// for those rooms that ask for them. Everything that draws is a Drawable.
//
// A frame: begin_frame (what moved; shadows), prepare_main_view (culling), then a room makes reflections for
// visible_objects through draw_view, then draw_main_view and display.
#pragma once

#include <memory>
#include <vector>

#include "graphics/gl/context.h"
#include "graphics/render/drawables.h"
#include "graphics/render/light_source.h"
#include "graphics/render/picture_target.h"
#include "graphics/render/scene_drawable.h"
#include "graphics/render/scene_occluders.h"
#include "graphics/shading/drawn_light.h"

namespace parvis::render {

/// Which object each pixel shows: its index in the scene and 1; 0 where there is none. Things that rooms draw
/// by themselves are numbered behind the objects (scene::for_each_traced_kind). Top row first.
using ObjectPicture = BasicImage<std::uint32_t>;

class HeldDrawables;

/// Draws views of a scene and of what rooms draw by themselves, in one light.
class Renderer {
 public:
  /// Needs a current OpenGL 4.5 context for as long as it lives. Uploads the scene and what rooms draw by
  /// themselves in it: `drawables` is attached to it. Fails only if a shader does, or if a kind of
  /// Scene::traced_kinds is not among the drawables.
  static Result<std::unique_ptr<Renderer>> create(const scene::Scene& scene, const Drawables& drawables,
                                                  const MakeLight& make_light);
  Renderer(const Renderer&) = delete;
  ~Renderer();

  /// Adds a drawable, drawn after the scene's in every view. Not owned.
  void add(Drawable* drawable) { drawables_.push_back(drawable); }
  /// Sets how mirror-like parts of objects that take reflections are shaded; null: they reflect the sky
  /// alone. Not owned.
  Status set_reflection(SurfaceShader* shader) { return scene_.set_reflection(shader); }

  /// Time budget of a frame (ms) for the drawables' levels of detail; 0: none, all use their best.
  void set_budget(double budget_ms) { budget_ms_ = budget_ms; }

  /// Takes over transforms and light from the scene and renders the shadow maps for a viewer.
  void begin_frame(const scene::Scene& scene, const Camera& camera) { begin(scene, camera, true); }
  /// The same for pictures of the static scene: dynamic objects cast no shadow.
  void begin_still_frame(const scene::Scene& scene, const Camera& camera) { begin(scene, camera, false); }
  /// Main views that are prepared from now on have one sample per pixel, for pictures in motion, whose hidden
  /// surfaces a software renderer then leaves out; else they have `samples_per_pixel`.
  void set_one_sample(bool has_one_sample) { has_one_sample_ = has_one_sample; }
  bool has_one_sample() const { return target().has_one_sample(); }  ///< of the main view as prepared last
  /// Makes targets for so many eyes (frame_views.h); fails only if a shader does.
  Status reserve_eyes(std::size_t count);
  /// The eye whose main view is prepared, drawn, displayed and read from now on: below the count reserved.
  void select_eye(std::size_t eye) { eye_ = eye; }
  /// Culls for the main view: afterwards `visible_objects` lists the objects that may need reflections. A
  /// bench may leave out the static scene; `shown_objects` as View has it, until the view is drawn.
  void prepare_main_view(const Camera& camera, int width, int height, Subjects subjects = Subjects::all,
                         const std::vector<std::uint8_t>* shown_objects = nullptr);
  /// Indices of the scene objects in the main view, ascending.
  const std::vector<int>& visible_objects() const { return scene_.visible_objects(); }
  const View& main_view() const { return main_view_; }  ///< of the selected eye, as prepared last
  /// Makes the light that of the main view again, whose camera is given, where a frame was begun since.
  /// Frames that are begun for maps of reflections leave the light of another place, without shade of what
  /// moves.
  void relight_main_view(const scene::Scene& scene, const Camera& camera);
  /// Draws the prepared main view, with `samples_per_pixel` or one.
  void draw_main_view();
  /// Keeps the main view as drawn, for `draw_over`.
  void keep_main_view() { target().keep(); }
  /// Draws the things of another, small scene over the main view that was kept, or over the one that has just
  /// been drawn: hidden where it hides them, in its light, casting shadows on each other alone. The objects
  /// of `held` are those of the last call, and new ones behind them. Fails only if a shader does; the view is
  /// as it was then.
  Status draw_over(const scene::Scene& held, bool is_kept);
  /// Draws a view for another room, for example a cube face: linear radiance, with sky.
  void draw_view(const View& view);
  /// A readback: for tools and tests, not for frames.
  ObjectPicture pick(const Camera& camera, int width, int height, bool culls_hidden);

  /// Tone-maps the main view into the first `size` pixels of a framebuffer (0: the window's).
  void display(GLuint framebuffer, glm::ivec2 size, float exposure) const {
    target().display(framebuffer, size, exposure);
  }
  /// Tone-maps the main view and starts its copy into the bound pixel pack buffer; see PictureTarget.
  void start_reading(float exposure, GLsizeiptr bytes) const { target().start_reading(exposure, bytes); }
  /// Tone-mapped image, RGBA; waits for the GPU.
  Image8 read_picture(float exposure) const { return target().read_picture(exposure); }
  ImageF read_radiance() const { return target().read_radiance(); }  ///< linear RGBA; waits for the GPU

  int width() const { return target().width(); }    ///< of the selected eye's main view, pixels
  int height() const { return target().height(); }  ///< of the selected eye's main view, pixels
  float exposure() const { return exposure_; }      ///< the scene's, as of the last frame
  const DrawStatistics& statistics() const { return scene_.main_statistics(); }  ///< of the main view
  const GpuScene& gpu() const { return scene_.gpu(); }  ///< the scene's objects on the GPU
  /// How often fixed things have appeared, vanished or moved, or the sky has changed: what is kept of their
  /// pictures is then out of date.
  int fixed_changes() const { return fixed_changes_; }
  /// How many frames have begun: all eyes of a frame see the same number.
  int frames_begun() const { return frames_begun_; }

  // The light that the ray tracer needs to agree with the picture.
  const shading::SkyLight& sky() const { return light_->sky(); }  ///< sky of the present frame
  /// The same light without shadow maps, for exact shadow rays: no readback, so frames may use it. Good until
  /// the next frame begins.
  shading::DrawnLight drawn_light_without_shadows() const {
    return {{}, &light_->sky_visibility(), &body_shade_, true, light_->lamps(), light_->bounced()};
  }
  /// A readback: for pictures that are traced. Points to the renderer's own: good until the next frame
  /// begins.
  shading::DrawnLight drawn_light() const {
    shading::DrawnLight drawn = light_->drawn_light(body_shade_);
    drawn.lamps = light_->lamps(), drawn.bounced = light_->bounced();
    return drawn;
  }

 private:
  Renderer(const scene::Scene& scene, SceneDrawable drawable, Drawables kinds,
           std::vector<Drawables::Made> room_drawables, std::unique_ptr<LightSource> light,
           PictureTarget target);
  PictureTarget& target() { return targets_[eye_]; }
  const PictureTarget& target() const { return targets_[eye_]; }
  void follow_things(const scene::Scene& scene);
  void gather_extents();
  Culling cull(const View& view);
  void begin(const scene::Scene& scene, const Camera& camera, bool has_moving_shade);
  void begin_view(const View& view);
  void draw_prepared(const View& view, std::span<Drawable* const> drawables);
  void bind_frame(const View& view);

  std::unique_ptr<LightSource> light_;
  float exposure_ = 1.0f;
  float realism_ = 1.0f;         ///< scene::Realism
  double budget_ms_ = 0.0;       ///< of a frame; 0: none
  bool has_one_sample_ = false;  ///< of the next main view
  int fixed_changes_ = 0;
  int frames_begun_ = 0;
  int main_view_frame_ = 0;  ///< of `frames_begun_`, in which the main view was prepared
  SceneDrawable scene_;
  SceneOccluders occluders_;
  Drawables kinds_;
  std::vector<Drawables::Made> room_drawables_;
  std::vector<Drawable*> drawables_;     ///< all: the scene's, the rooms', and those that were added
  std::unique_ptr<HeldDrawables> held_;  ///< of `draw_over`
  std::size_t object_count_;             ///< of the scene, in the last frame

  // Extents of all drawables in this frame.
  Bounds fixed_bounds_;
  std::vector<Bounds> moving_bounds_;
  std::vector<shading::Body> bodies_;
  FixedChange fixed_change_;

  shading::BodyShade body_shade_{};
  StreamBuffer frame_blocks_, body_blocks_;
  std::vector<PictureTarget> targets_;  ///< of each eye
  std::size_t eye_ = 0;
  View main_view_;
  TracedSun traced_sun_ = 0;  ///< of the main view
};

}  // namespace parvis::render
