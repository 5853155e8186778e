// A running scene and its renderer: script, traffic, reflections and rendering combined. Used by every
// command that renders.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>

#include "base/registries.h"
#include "graphics/gl/pass_times.h"
#include "graphics/realism/edge_lines.h"
#include "graphics/reference/tracer.h"
#include "graphics/render/drawables.h"
#include "graphics/render/frame_views.h"
#include "graphics/render/picture_scale.h"
#include "graphics/render/renderer.h"
#include "machines/processes.h"
#include "reflections/methods/reflections.h"
#include "reflections/methods/settings.h"
#include "scene/action/actions.h"
#include "scene/action/scene_clock.h"
#include "scene/script/scene_loader.h"
#include "stage/scene_camera.h"
#include "stage/shared_budget.h"
#include "stage/shown_radiance.h"

namespace parvis::stage {

class KeptRays;
class Refinement;

/// A running scene: data and the clock that drives its processes.
struct Simulation {
  const Registries*
      registries;  ///< not owned: the rooms whose nodes, processes, drawables and methods it uses
  scene::Scene scene;
  action::SceneClock clock;

  scene::LiveScene& live() { return clock.live(); }                            ///< the nodes of its script
  const scene::LiveScene& live() const { return clock.live(); }                ///< the same, for reading
  action::Actions& actions() const { return *clock.find<action::Actions>(); }  ///< its messages and events

  /// Advances all processes by `seconds`. `visitor` is the eye's position, for processes near it. Returns the
  /// warnings, which are also printed on standard error.
  Errors advance(double seconds, const std::optional<glm::vec3>& visitor = std::nullopt);
  /// Completes the present moment for a picture: SceneClock::settle. Warnings are printed on standard error.
  void settle();

  /// The present pose of the named camera (it may follow an object). Without a name: that of a running tour,
  /// else the one chosen by a message, else the scene's first, else an overview. Errors list the existing
  /// cameras.
  Result<Camera> camera(const std::string& name) const;
};
/// Starts the processes of a scene; `live` holds the nodes of its script. Warnings are written to standard
/// error. `registries` must live as long as the simulation.
Simulation make_simulation(const Registries& registries, scene::Scene scene, scene::LiveScene live);
/// The same of a scene without a script.
Simulation make_simulation(const Registries& registries, scene::Scene scene);
/// The same of a script, which may use the node types of `registries`.
Result<Simulation> open_simulation(const Registries& registries, const std::filesystem::path& script,
                                   std::span<const std::filesystem::path> data_folders);

/// Renders a simulation. Needs a current OpenGL context.
class Stage {
 public:
  /// Prepares the scene's reflection method, uploads the scene and compiles the shaders. Errors: those of the
  /// method's preparation, or of a shader.
  static Result<std::unique_ptr<Stage>> create(Simulation simulation);
  Stage(const Stage&) = delete;
  ~Stage();

  Simulation& simulation() { return simulation_; }  ///< the running scene
  /// The rooms whose nodes, processes, drawables and methods the stage uses.
  const Registries& registries() const { return *simulation_.registries; }
  const scene::Scene& scene() const { return simulation_.scene; }  ///< as of the last step
  render::Renderer& renderer() { return *renderer_; }              ///< for other views and readbacks
  const methods::Reflections& reflections() const { return *reflections_; }  ///< the active reflection method
  /// Times of the passes of a frame: shadows, reflections, picture; callers may add passes.
  gl::PassTimes& pass_times() { return pass_times_; }

  /// Activates another scenario (empty: the base scene) from the next frame on; loads nothing.
  Status choose_scenario(const std::string& name) {
    Status status = simulation_.live().choose(simulation_.scene, name);
    simulation_.clock.follow(simulation_.scene);
    return status;
  }
  /// Replaces the reflection method. Fails if its shaders or its data cannot be prepared.
  Status set_reflection(const methods::Settings& reflection);

  /// The rate that `follow_clock` holds, frames per second; 0: none but the scene's own time budget.
  void hold_rate(double frames_per_second) {
    held_ms_ = frames_per_second > 0.0 ? 1e3 / frames_per_second : 0.0;
  }
  /// Keeps frames within the budget of the held rate and the scene's, whichever is less, through the
  /// resolution of the picture and, for the scene's or where the resolution is at its lowest, the levels of
  /// detail of reflections. By measured times
  /// of the passes; on a software renderer, which times the passes of few frames, by `frame_ms`: what the
  /// last frame took by the clock, all of it. For windows: the result depends on the machine.
  void follow_clock(double frame_ms);
  /// The shares of pixels, reflections, people and sound that are left so that frames hold their budget;
  /// `follow_clock` lowers the first three itself.
  const SharedBudget& shared_budget() const { return shared_; }
  /// The fraction of the last frame's displayed pixels that was drawn.
  double drawn_share() const;

  /// See Simulation::camera.
  Result<Camera> camera(const std::string& name) const { return simulation_.camera(name); }

  /// Renders the present frame: shadows, reflections, picture. Applies the changes of scenarios and messages
  /// first.
  void draw(const Camera& camera, int width, int height) {
    draw(camera, {width, height}, scale_.drawn_size(width, height), nullptr, holds_rate_by_pixels());
  }

  /// The same for several eyes, in full resolution: walls of a room, a stereo pair. Each is displayed and
  /// read after Renderer::select_eye; width and height are the first one's.
  Status draw(std::span<const render::EyeView> eyes);

  /// Replaces `draw` while a person holds things: draws the frame without the objects and things that `shown`
  /// leaves out (a flag for each, as View::shown_objects), and over it those of `held`, a scene of their own,
  /// in full resolution where the eye rests. While view, size, scene and `shown` stay as they are, the frame
  /// below is drawn once: then a thing can be moved about at many frames per second. `held` as
  /// Renderer::draw_over has it.
  void draw_held(const Camera& camera, int width, int height, const std::vector<std::uint8_t>& shown,
                 const scene::Scene& held);

  /// Replaces `draw` where neither view nor scene has changed since the last frame: draws it once more in
  /// full resolution if it was not, then refines it by the ray tracer, on other threads, and displays that
  /// picture from as many samples per pixel on as drawn ones have. `draw` ends it. Pictures with lines
  /// (scene::Realism) are not refined.
  void refine(const Camera& camera, int width, int height);
  /// Samples per pixel of the refined picture that is displayed; 0: the drawn picture is.
  int refined_samples() const { return refined_samples_; }

  /// Displays the last frame in a framebuffer (0: the window's).
  void display(GLuint framebuffer) const;
  /// Width of the last frame as displayed, pixels.
  int width() const { return width_; }
  int height() const { return height_; }  ///< of the last frame as displayed, pixels
  /// The last frame as displayed, tone-mapped with the scene's exposure; as drawn, where it was drawn
  /// smaller.
  Image8 picture();
  /// The same in full resolution and with all levels of detail: drawn once more where the last frame was not.
  Image8 whole_picture();
  /// The same view by the ray tracer, with the renderer's shadow maps; completely or a window of it.
  reference::TracedPicture trace(const Camera& camera, int width, int height, int samples_per_pixel,
                                 const reference::PixelWindow& window = {});
  /// The same, its rows divided among the processes: all of them call it, the first has the picture.
  reference::TracedPicture trace(const Camera& camera, int width, int height, int samples_per_pixel,
                                 const machines::Processes& processes);

 private:
  void end_refinement();
  void begin_drawing(std::span<const render::EyeView> eyes);
  void adapt_to(std::span<const glm::vec3> eyes);
  bool has_new_mirrors();
  Stage(Simulation simulation, std::unique_ptr<render::Renderer> renderer,
        std::unique_ptr<realism::EdgeLines> lines, ShownRadiance refined);
  void draw(const Camera& camera, glm::ivec2 size, glm::ivec2 drawn,
            const std::vector<std::uint8_t>* shown = nullptr, bool has_one_sample = false);
  bool holds_rate_by_pixels() const;

  Simulation simulation_;
  std::unique_ptr<render::Renderer> renderer_;
  std::unique_ptr<realism::EdgeLines> lines_;  ///< that it draws
  std::unique_ptr<methods::Reflections> reflections_;
  methods::Settings shown_reflection_;
  std::set<const scene::Model*>
      mirrors_;                    ///< models of objects that take reflections, as the method knows them
  std::size_t known_objects_ = 0;  ///< of the scene
  gl::PassTimes pass_times_;
  double held_ms_ = 0.0;  ///< 0: no rate is held
  render::PictureScale scale_;
  SharedBudget shared_;
  Camera drawn_from_;  ///< the last frame
  int width_ = 0, height_ = 0;
  ShownRadiance refined_;
  int refined_samples_ = 0;
  std::uint64_t below_held_ = 0;  ///< what the frame below things that are held shows
  bool is_held_frame_kept_ = false;
  std::unique_ptr<KeptRays> kept_rays_;     ///< of the pictures at rest
  std::unique_ptr<Refinement> refinement_;  ///< last: it reads the renderer's light
};

}  // namespace parvis::stage
