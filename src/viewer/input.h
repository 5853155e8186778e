// User input from a GLFW window (keyboard, mouse, controller), translated into navigation, scene events and
// panel actions.
#pragma once

#include <array>
#include <vector>

#include "viewer/panel.h"
#include "viewer/planning.h"
#include "viewer/visit.h"

struct GLFWwindow;

namespace parvis::viewer {

/// Handles the input of one window. Install Dear ImGui's callbacks after it: they chain to these. Input that
/// the panel captures does not reach the visit.
class Input {
 public:
  Input(GLFWwindow* window, Visit& visit, Panel& panel, Planning& planning, Hearing& hearing);
  Input(const Input&) = delete;
  ~Input();

  /// Processes pending events and returns the controls since the last call, `seconds` ago.
  Controls poll(double seconds);

  /// Handles a GLFW key event: an event of the scene, else a command of the viewer.
  void on_key(int place, int scancode, int action, int modifiers);
  /// Handles a character: of a number that is typed while a thing moves.
  void on_character(unsigned character);
  /// Handles a GLFW mouse button event: an event of the scene, else dragging or selecting with the left
  /// button.
  void on_button(int button, int action);
  /// Handles cursor motion, in the window's units: dragging turns the view.
  void on_cursor(double x, double y);
  /// Handles the mouse wheel, unless the panel captures it.
  void on_wheel(double steps);

 private:
  bool tell_scene(const std::string& key, int action);
  void press(int key);
  void choose_what_is_below_the_cursor();
  void poll_controller();
  void poll_events();
  void close_when_asked_twice();
  bool press_planning(int key, int modifiers);
  bool press_with_control(int key, bool has_shift);
  std::optional<planner::Pointer> pointer() const;
  bool is_held(int key) const;
  float share_of_picture(double x) const;

  GLFWwindow* window_;
  static constexpr std::size_t movement_keys = 6;
  /// Whether each of W, S, A, D, E and Q was pressed since the last poll, if only for a moment.
  std::array<bool, movement_keys> was_pressed_{};
  /// Keys that were pressed since the last poll, and those that Dear ImGui has learnt of in it.
  std::vector<int> tapped_, told_;
  Visit& visit_;
  Panel& panel_;
  Planning& planning_;
  Hearing& hearing_;
  Controls controls_;
  bool is_dragging_ = false, is_panning_ = false, is_sliding_ = false;
  bool has_moved_ = false;                    ///< the cursor, since the last poll
  glm::dvec2 cursor_{0.0}, pressed_at_{0.0};  ///< in the window's units
  double asked_to_close_s_ = -1e9;            ///< when Esc asked for it last, by GLFW's clock
  std::array<unsigned char, 15> controller_buttons_{};
};

}  // namespace parvis::viewer
