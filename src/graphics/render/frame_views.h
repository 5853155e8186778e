// The recipe of a frame for any number of eyes: one window, the two of a stereo pair, the walls of a room.
#pragma once

#include <functional>
#include <span>

#include "graphics/render/renderer.h"

namespace parvis::render {

/// One picture of a frame: its own frustum (off axis where the camera has one), size, target and draw list.
struct EyeView {
  Camera camera;
  int width, height;
};

/// The steps of a frame besides its views.
struct FrameSteps {
  Subjects subjects = Subjects::all;
  const std::vector<std::uint8_t>* shown_objects = nullptr;  ///< as View has it
  /// Makes reflections for one eye, whose view is prepared: Renderer::main_view, visible_objects. Empty:
  /// none.
  std::function<void(const Camera& eye)> reflect = {};
  /// Called after each pass with its name ("shadows" once, then "reflections" and "picture" for each eye),
  /// for those who time them.
  std::function<void(const char* pass)> end_pass = {};
};

/// Draws a frame: what does not depend on the view once (what moved, light, shadow maps for the middle of all
/// eyes), then each eye's picture into its own target (Renderer::select_eye). Fails only where a target's
/// shader does.
Status draw_frame(Renderer& renderer, const scene::Scene& scene, std::span<const EyeView> eyes,
                  const FrameSteps& steps = {});

/// The same for one eye.
inline Status draw_frame(Renderer& renderer, const scene::Scene& scene, const EyeView& eye,
                         const FrameSteps& steps = {}) {
  return draw_frame(renderer, scene, std::span(&eye, 1), steps);
}

/// Where all eyes are together: the position and direction midway between them. Of one eye: itself.
Camera middle_of(std::span<const EyeView> eyes);

}  // namespace parvis::render
