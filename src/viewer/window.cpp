#include "viewer/window.h"

#include <epoxy/gl.h>
// after epoxy, which brings the declarations of OpenGL
#include <GLFW/glfw3.h>

#include <array>
#include <chrono>

#include "base/image_io.h"
#include "viewer/key_names.h"
#include "viewer/navigation.h"

namespace parvis::viewer {
namespace {

constexpr float radians_a_pixel = 0.0025f;
constexpr double title_interval_s = 0.5;
constexpr float longest_step_s = 0.1f;  // after a halt, life goes on where it stopped

constexpr const char* help =
    "W A S D move, Q E down and up, Shift hurries, drag turns, wheel changes speed or distance\n"
    "1 walk, 2 fly, 3 follow the next vehicle, Tab next scenario, P picture, Esc closes\n";

/// What GLFW tells through callbacks between two frames.
struct Input {
  action::Actions* actions = nullptr;
  Controls controls;
  bool is_dragging = false;
  glm::dvec2 cursor{0.0};
  bool wants_next_vehicle = false, wants_next_scenario = false, wants_picture = false;
  int wanted_mode = -1;
};

Input& input_of(GLFWwindow* window) { return *static_cast<Input*>(glfwGetWindowUserPointer(window)); }

/// Tells the scene of a key; false where nothing in it waits for that.
bool tell_scene(action::Actions& actions, const std::string& key, int glfw_action) {
  if (!actions.uses_key(key)) return false;
  if (glfw_action == GLFW_PRESS) actions.press(key);
  if (glfw_action == GLFW_RELEASE) actions.release(key);
  return true;
}

void on_key(GLFWwindow* window, int key, int, int action, int) {
  Input& input = input_of(window);
  if (tell_scene(*input.actions, key_name(key), action) || action != GLFW_PRESS) return;
  if (key == GLFW_KEY_ESCAPE) glfwSetWindowShouldClose(window, GLFW_TRUE);
  if (key == GLFW_KEY_1) input.wanted_mode = int(Mode::walk);
  if (key == GLFW_KEY_2) input.wanted_mode = int(Mode::fly);
  if (key == GLFW_KEY_3) input.wanted_mode = int(Mode::follow), input.wants_next_vehicle = true;
  if (key == GLFW_KEY_P) input.wants_picture = true;
  if (key == GLFW_KEY_TAB) input.wants_next_scenario = true;
}

void on_button(GLFWwindow* window, int button, int action, int) {
  if (tell_scene(*input_of(window).actions, mouse_button_name(button), action)) return;
  if (button == GLFW_MOUSE_BUTTON_LEFT) input_of(window).is_dragging = action == GLFW_PRESS;
}

void on_cursor(GLFWwindow* window, double x, double y) {
  Input& input = input_of(window);
  const glm::dvec2 moved = glm::dvec2(x, y) - input.cursor;
  input.cursor = {x, y};
  if (input.is_dragging) input.controls.turn -= radians_a_pixel * glm::vec2(moved);
}

void on_wheel(GLFWwindow* window, double, double steps) { input_of(window).controls.zoom += float(steps); }

glm::vec3 pressed_direction(GLFWwindow* window) {
  const auto is_down = [&](int key) { return glfwGetKey(window, key) == GLFW_PRESS ? 1.0f : 0.0f; };
  return {is_down(GLFW_KEY_W) - is_down(GLFW_KEY_S), is_down(GLFW_KEY_A) - is_down(GLFW_KEY_D),
          is_down(GLFW_KEY_E) - is_down(GLFW_KEY_Q)};
}

/// Ends GLFW and its window when it goes.
struct Glfw {
  GLFWwindow* window = nullptr;
  ~Glfw() {
    if (window) glfwDestroyWindow(window);
    glfwTerminate();
  }
};

/// The vehicle after `previous` in the scene, or -1 where there is none.
int next_vehicle(const scene::Scene& scene, int previous) {
  const int count = int(scene.objects.size());
  for (int step = 1; step <= count; ++step) {
    const int index = (std::max(previous, 0) + step) % count;
    const scene::Object& object = scene.objects[std::size_t(index)];
    if (object.is_dynamic && object.is_visible) return index;
  }
  return -1;
}

void show_statistics(GLFWwindow* window, const render::DrawStatistics& drawn, int frames, double seconds) {
  const std::string title = fmt::format(
      "Parvis: {:.1f} ms a frame, {} triangles in {} draws, {} of {} parts hidden", 1000.0 * seconds / frames,
      drawn.triangles, drawn.draws, drawn.items_hidden, drawn.items_in_frustum);
  glfwSetWindowTitle(window, title.c_str());
}

/// One visit: the loop over frames.
class Visit {
 public:
  Visit(GLFWwindow* window, stage::Stage& stage, const Camera& start)
      : window_(window), stage_(stage), navigation_(start) {
    input_.actions = &stage.play().actions;
    glfwSetWindowUserPointer(window, &input_);
    glfwSetKeyCallback(window, on_key);
    glfwSetMouseButtonCallback(window, on_button);
    glfwSetCursorPosCallback(window, on_cursor);
    glfwSetScrollCallback(window, on_wheel);
  }

  Status run(const WindowOptions& options) {
    using Clock = std::chrono::steady_clock;
    Clock::time_point last = Clock::now(), last_title = last;
    int frames = 0, frames_of_title = 0;
    while (!glfwWindowShouldClose(window_) && (options.most_frames == 0 || frames < options.most_frames)) {
      const Clock::time_point now = Clock::now();
      step(std::min(std::chrono::duration<float>(now - last).count(), longest_step_s));
      last = now;
      draw();
      ++frames, ++frames_of_title;
      if (const double since = std::chrono::duration<double>(now - last_title).count();
          since > title_interval_s) {
        show_statistics(window_, stage_.renderer().statistics(), frames_of_title, since);
        last_title = now, frames_of_title = 0;
      }
      if (std::exchange(input_.wants_picture, false))
        if (Status status = write_image(fmt::format("parvis-{}.png", ++pictures_), stage_.picture()); !status)
          return status;
    }
    return options.screenshot.empty() ? Status(Done{}) : write_image(options.screenshot, stage_.picture());
  }

 private:
  void step(float seconds) {
    glfwPollEvents();
    if (std::exchange(input_.wants_next_vehicle, false)) followed_ = next_vehicle(stage_.scene(), followed_);
    if (const int mode = std::exchange(input_.wanted_mode, -1); mode >= 0)
      navigation_.set_mode(Mode(mode) == Mode::follow && followed_ < 0 ? Mode::fly : Mode(mode));
    if (std::exchange(input_.wants_next_scenario, false)) show_next_scenario();
    poll_controller();
    stage_.play().advance(double(seconds), navigation_.camera().position_in_world());
    input_.controls.move = pressed_direction(window_);
    follow_guidance();
    input_.controls.hurries = glfwGetKey(window_, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS;
    const glm::mat4 target =
        followed_ >= 0 ? stage_.scene().objects[std::size_t(followed_)].world_from_model : glm::mat4(1.0f);
    navigation_.step(input_.controls, seconds, target);
    input_.controls = {};
  }

  /// The view goes where a tour or a message leads it, until the visitor moves.
  void follow_guidance() {
    action::Actions& actions = *input_.actions;
    const bool moves = input_.controls.move != glm::vec3(0.0f) || input_.controls.turn != glm::vec2(0.0f);
    if (moves) actions.release_view();
    if (const std::optional<Camera> camera = actions.camera(stage_.scene())) navigation_.go_to(*camera);
  }

  /// Through the scene's scenarios in their order, then the base scene.
  void show_next_scenario() {
    const std::vector<const scene::Node*> scenarios = input_.actions->live().scenarios();
    std::size_t next = 0;
    for (std::size_t i = 0; i < scenarios.size(); ++i)
      if (scenarios[i]->text("name") == input_.actions->live().scenario()) next = i + 1;
    const std::string name = next < scenarios.size() ? scenarios[next]->text("name") : "";
    if (const Status status = stage_.choose_scenario(name); !status)
      fmt::print(stderr, "{}", to_string(status.errors()));
    else if (!scenarios.empty())
      fmt::print("{}\n", name.empty() ? "the base scene" : "scenario " + name);
  }

  void poll_controller() {
    GLFWgamepadstate state{};
    if (glfwGetGamepadState(GLFW_JOYSTICK_1, &state) != GLFW_TRUE) return;
    for (std::size_t i = 0; i < controller_buttons_.size(); ++i)
      if (const unsigned char is_down = state.buttons[i];
          std::exchange(controller_buttons_[i], is_down) != is_down)
        tell_scene(*input_.actions, controller_button_name(int(i)), is_down ? GLFW_PRESS : GLFW_RELEASE);
  }

  void draw() {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    if (width == 0 || height == 0) return;  // an icon
    stage_.draw(navigation_.camera(), width, height);
    stage_.renderer().display(0, stage_.scene().exposure);
    glfwSwapBuffers(window_);
  }

  GLFWwindow* window_;
  stage::Stage& stage_;
  Navigation navigation_;
  Input input_;
  std::array<unsigned char, GLFW_GAMEPAD_BUTTON_LAST + 1> controller_buttons_{};
  int followed_ = -1;
  int pictures_ = 0;
};

}  // namespace

Status show(stage::Play play, const WindowOptions& options) {
  if (!glfwInit())
    return error("no window can be opened: there is no display; parvis render makes pictures without one");
  Glfw glfw;
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfw.window = glfwCreateWindow(options.width, options.height, "Parvis", nullptr, nullptr);
  if (!glfw.window) return error("no window can be opened: the display offers no OpenGL 4.5");
  glfwMakeContextCurrent(glfw.window);
  if (Status status = gl::check_current(); !status) return status;

  Result<std::unique_ptr<stage::Stage>> stage = stage::Stage::create(std::move(play));
  if (!stage) return stage.errors();
  const Result<Camera> start = (*stage)->camera(options.camera);
  if (!start) return start.errors();
  fmt::print("{}", help);
  return Visit(glfw.window, **stage, *start).run(options);
}

}  // namespace parvis::viewer
