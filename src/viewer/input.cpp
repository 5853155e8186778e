#include "viewer/input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <utility>

#include "viewer/key_names.h"

namespace parvis::viewer {
namespace {

constexpr float radians_per_pixel = 0.0025f;
constexpr double farthest_click = 4.0;  // from press to release, in the window's units: beyond, it is a drag

Input& input_of(GLFWwindow* window) { return *static_cast<Input*>(glfwGetWindowUserPointer(window)); }

}  // namespace

Input::Input(GLFWwindow* window, Visit& visit, Panel& panel) : window_(window), visit_(visit), panel_(panel) {
  static_assert(std::tuple_size_v<decltype(controller_buttons_)> == GLFW_GAMEPAD_BUTTON_LAST + 1);
  glfwSetWindowUserPointer(window, this);
  glfwSetKeyCallback(window,
                     [](GLFWwindow* in, int key, int, int action, int) { input_of(in).on_key(key, action); });
  glfwSetMouseButtonCallback(
      window, [](GLFWwindow* in, int button, int action, int) { input_of(in).on_button(button, action); });
  glfwSetCursorPosCallback(window, [](GLFWwindow* in, double x, double y) { input_of(in).on_cursor(x, y); });
  glfwSetScrollCallback(window, [](GLFWwindow* in, double, double steps) { input_of(in).on_wheel(steps); });
}

Input::~Input() {
  glfwSetKeyCallback(window_, nullptr);
  glfwSetMouseButtonCallback(window_, nullptr);
  glfwSetCursorPosCallback(window_, nullptr);
  glfwSetScrollCallback(window_, nullptr);
}

/// False where nothing in the scene waits for the key.
bool Input::tell_scene(const std::string& key, int action) {
  if (!visit_.actions().uses_key(key)) return false;
  if (action == GLFW_PRESS) visit_.actions().press(key);
  if (action == GLFW_RELEASE) visit_.actions().release(key);
  return true;
}

void Input::on_key(int key, int action) {
  if (ImGui::GetIO().WantTextInput && action == GLFW_PRESS) return;
  if (tell_scene(key_name(key), action) || action != GLFW_PRESS) return;
  press(key);
}

void Input::press(int key) {
  switch (key) {
    case GLFW_KEY_ESCAPE:
      if (!std::exchange(panel_.shows_keys, false)) glfwSetWindowShouldClose(window_, GLFW_TRUE);
      break;
    case GLFW_KEY_F1:
      panel_.shows_keys = !panel_.shows_keys;
      break;
    case GLFW_KEY_F2:
      panel_.is_open = !panel_.is_open;
      break;
    case GLFW_KEY_1:
      visit_.set_mode(Mode::walk);
      break;
    case GLFW_KEY_2:
      visit_.set_mode(Mode::fly);
      break;
    case GLFW_KEY_3:
      visit_.follow_next_vehicle();
      break;
    case GLFW_KEY_TAB:
      visit_.show_next_scenario();
      break;
    case GLFW_KEY_SPACE:
      visit_.halt(!visit_.is_halted());
      break;
    case GLFW_KEY_N:
      visit_.step_halted();
      break;
    case GLFW_KEY_P:
      visit_.take_picture();
      break;
    default:
      break;
  }
}

void Input::on_button(int button, int action) {
  if (ImGui::GetIO().WantCaptureMouse && action == GLFW_PRESS) return;
  if (tell_scene(mouse_button_name(button), action)) return;
  if (button != GLFW_MOUSE_BUTTON_LEFT) return;
  const bool was_dragging = std::exchange(is_dragging_, action == GLFW_PRESS);
  if (is_dragging_)
    pressed_at_ = cursor_;
  else if (was_dragging && glm::distance(cursor_, pressed_at_) < farthest_click)
    choose_what_is_below_the_cursor();
}

void Input::choose_what_is_below_the_cursor() {
  glm::ivec2 points(0), pixels(0);
  glfwGetWindowSize(window_, &points.x, &points.y);
  glfwGetFramebufferSize(window_, &pixels.x, &pixels.y);
  const glm::ivec2 pixel(glm::floor(cursor_ * glm::dvec2(pixels) / glm::dvec2(glm::max(points, 1))));
  if (panel_.is_open)
    if (const scene::Node* node = visit_.node_at(pixel)) panel_.choose(visit_.live(), *node);
  visit_.probe(pixel);
}

void Input::on_cursor(double x, double y) {
  const glm::dvec2 moved = glm::dvec2(x, y) - cursor_;
  cursor_ = {x, y};
  if (is_dragging_) controls_.turn -= radians_per_pixel * glm::vec2(moved);
}

void Input::on_wheel(double steps) {
  if (!ImGui::GetIO().WantCaptureMouse) controls_.zoom += float(steps);
}

void Input::poll_controller() {
  GLFWgamepadstate state{};
  if (glfwGetGamepadState(GLFW_JOYSTICK_1, &state) != GLFW_TRUE) return;
  for (std::size_t i = 0; i < controller_buttons_.size(); ++i)
    if (const unsigned char is_down = state.buttons[i];
        std::exchange(controller_buttons_[i], is_down) != is_down)
      tell_scene(controller_button_name(int(i)), is_down ? GLFW_PRESS : GLFW_RELEASE);
}

Controls Input::poll() {
  glfwPollEvents();
  poll_controller();
  Controls controls = std::exchange(controls_, {});
  const auto is_down = [&](int key) {
    const bool is_for_scene = visit_.actions().uses_key(key_name(key));
    const bool counts = !is_for_scene && !ImGui::GetIO().WantTextInput;
    return counts && glfwGetKey(window_, key) == GLFW_PRESS ? 1.0f : 0.0f;
  };
  controls.move = {is_down(GLFW_KEY_W) - is_down(GLFW_KEY_S), is_down(GLFW_KEY_A) - is_down(GLFW_KEY_D),
                   is_down(GLFW_KEY_E) - is_down(GLFW_KEY_Q)};
  controls.hurries = glfwGetKey(window_, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS;
  return controls;
}

}  // namespace parvis::viewer
