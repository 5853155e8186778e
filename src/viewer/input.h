// What a person does in a window: GLFW's keys, mouse and controller, as controls of the visit, happenings of
// the scene and words to the panel.
#pragma once

#include <array>

#include "viewer/panel.h"
#include "viewer/visit.h"

struct GLFWwindow;

namespace parvis::viewer {

/// Listens to one window. Dear ImGui's own callbacks are to be installed after it: they pass on what they
/// hear. What the panel is pointed at or written into does not reach the visit.
class Input {
 public:
  Input(GLFWwindow* window, Visit& visit, Panel& panel);
  Input(const Input&) = delete;
  ~Input();

  /// Lets things happen, and gives the controls since the last call.
  Controls poll();

  void on_key(int key, int action);
  void on_button(int button, int action);
  void on_cursor(double x, double y);
  void on_wheel(double steps);

 private:
  bool tell_scene(const std::string& key, int action);
  void press(int key);
  void choose_what_is_below_the_cursor();
  void poll_controller();

  GLFWwindow* window_;
  Visit& visit_;
  Panel& panel_;
  Controls controls_;
  bool is_dragging_ = false;
  glm::dvec2 cursor_{0.0}, pressed_at_{0.0};  ///< in the window's units
  std::array<unsigned char, 15> controller_buttons_{};
};

}  // namespace parvis::viewer
