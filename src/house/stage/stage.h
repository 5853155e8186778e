// A scene in motion: script, traffic, renderer and reflections put together. What every command that shows
// something uses.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "base/house.h"
#include "graphics/gl/pass_times.h"
#include "graphics/reference/tracer.h"
#include "graphics/render/drawables.h"
#include "graphics/render/picture_scale.h"
#include "graphics/render/renderer.h"
#include "house/stage/scene_camera.h"
#include "reflections/methods/reflections.h"
#include "reflections/methods/settings.h"
#include "scene/action/actions.h"
#include "scene/action/scene_clock.h"
#include "scene/script/scene_loader.h"

namespace parvis::house {

/// A scene that runs: with its processes, which the clock drives.
struct Play {
  const House* house;  ///< not owned: the rooms whose nodes, processes, drawables and methods it uses
  scene::Scene scene;
  action::SceneClock clock;

  scene::LiveScene& live() { return clock.live(); }
  const scene::LiveScene& live() const { return clock.live(); }
  action::Actions& actions() const { return *clock.find<action::Actions>(); }

  /// Lets `seconds` pass. `visitor` is where the eye is, for what happens near it. Returns the warnings,
  /// which it also prints on standard error.
  Errors advance(double seconds, const std::optional<glm::vec3>& visitor = std::nullopt);

  /// The camera of that name where it is now (it may follow an object); an unnamed one: that of a tour that
  /// runs, or the one that a message chose, or the scene's first, or a view of the whole where it has none.
  /// Errors name the cameras that there are.
  Result<Camera> camera(const std::string& name) const;
};
/// Begins the processes of a scene; `live` holds the nodes of its script. Warnings are written to standard
/// error. `house` must live as long as the play.
Play make_play(const House& house, scene::Scene scene, scene::LiveScene live);
/// The same of a scene without a script.
Play make_play(const House& house, scene::Scene scene);
/// The same of a script, which may use the node types of `house`.
Result<Play> open_play(const House& house, const std::filesystem::path& script,
                       std::span<const std::filesystem::path> data_folders);

/// Draws a play with an OpenGL context that is current.
class Stage {
 public:
  static Result<std::unique_ptr<Stage>> create(Play play);
  Stage(const Stage&) = delete;

  Play& play() { return play_; }
  /// The rooms whose nodes, processes, drawables and methods the stage uses.
  const House& house() const { return *play_.house; }
  const scene::Scene& scene() const { return play_.scene; }
  render::Renderer& renderer() { return *renderer_; }
  const methods::Reflections& reflections() const { return *reflections_; }
  /// Of the passes of a frame: shadows, reflections, picture; those who draw more add theirs.
  gl::PassTimes& pass_times() { return pass_times_; }

  /// Shows another scenario (empty: the base scene) from the next frame on; loads nothing.
  Status choose_scenario(const std::string& name) { return play_.live().choose(play_.scene, name); }
  /// Changes the method of reflection.
  Status set_reflection(const methods::Settings& reflection);

  /// Holds the scene's budget by how long the passes of a frame took: by the levels of reflections, and by
  /// the size at which the picture is drawn. For windows: pictures that follow a clock cannot be repeated.
  void follow_clock();

  /// See Play::camera.
  Result<Camera> camera(const std::string& name) const { return play_.camera(name); }

  /// Draws the frame of now: shadows, reflections, picture. Takes over what scenarios and messages have
  /// changed.
  void draw(const Camera& camera, int width, int height);
  /// Shows what was drawn last in a framebuffer (0: the window's).
  void display(GLuint framebuffer) const {
    renderer_->display(framebuffer, {width_, height_}, play_.scene.exposure);
  }
  /// Of the picture that was drawn last, as it is shown.
  int width() const { return width_; }
  int height() const { return height_; }
  /// What was drawn last, tone-mapped with the scene's exposure.
  Image8 picture() { return renderer_->read_picture(play_.scene.exposure); }
  /// The same by the ray tracer, with the renderer's own shadow maps; all of it or a window.
  reference::TracedPicture trace(const Camera& camera, int width, int height, int samples_per_pixel,
                                 const reference::PixelWindow& window = {});

 private:
  Stage(Play play, std::unique_ptr<render::Renderer> renderer);

  Play play_;
  std::unique_ptr<render::Renderer> renderer_;
  std::unique_ptr<methods::Reflections> reflections_;
  methods::Settings shown_reflection_;
  gl::PassTimes pass_times_;
  render::PictureScale scale_;
  int width_ = 0, height_ = 0;
};

}  // namespace parvis::house
