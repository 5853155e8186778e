// Owns Dear ImGui and its OpenGL drawing. Its events come from elsewhere: GLFW in a window, a test.
#pragma once

#include "base/result.h"
#include "viewer/theme.h"

namespace parvis::viewer {

class ImguiContext {
 public:
  /// Needs a current OpenGL context for as long as it lives; there is one of it at a time. Sizes as in
  /// apply_theme.
  explicit ImguiContext(float scale, float pixels_per_point = 1.0f);
  ImguiContext(const ImguiContext&) = delete;
  ~ImguiContext();

  /// Takes another scale from the next frame on.
  void rescale(float scale, float pixels_per_point);

  /// Input is there: begins a frame of ImGui.
  void begin_frame();
  /// Draws what was asked for since into the framebuffer that is bound.
  void draw();

  const Fonts& fonts() const { return fonts_; }
  /// The factor of all sizes that are in ImGui's units.
  float scale() const { return scale_; }

 private:
  Fonts fonts_;
  float scale_;
};

}  // namespace parvis::viewer
