#include "viewer/walls.h"

#include <epoxy/gl.h>
// after epoxy, which brings the declarations of OpenGL
#include <GLFW/glfw3.h>

#include <chrono>
#include <fstream>

#include "base/content_hash.h"
#include "graphics/display/room_overlay.h"
#include "graphics/gl/context.h"
#include "stage/walls.h"
#include "viewer/feeling.h"
#include "viewer/frame_statistics.h"
#include "viewer/key_names.h"
#include "viewer/panel.h"
#include "viewer/planning.h"
#include "viewer/planning_bars.h"
#include "viewer/visit_keys.h"
#include "viewer/window_hearing.h"

namespace parvis::viewer {
namespace {

using Steady = std::chrono::steady_clock;

constexpr std::size_t keys = GLFW_KEY_LAST + 1, max_processes = display::max_walls + 1;

/// The part of a frame that the processes tell each other. All are numbers that are added up: what one
/// process alone knows is zero in the others.
struct Told {
  double ends = 0.0;
  double seconds = 0.0;  ///< of the first process's clock
  double move[3]{}, turn[2]{}, zoom = 0.0, hurries = 0.0;
  double eye[3]{}, eye_right[3]{};
  double has_wand = 0.0, wand[3]{}, wand_turn[4]{};
  double buttons_down[devices::DeviceSettings::wand_buttons]{},
      buttons_up[devices::DeviceSettings::wand_buttons]{};
  double touches_down = 0.0, touches_up = 0.0;  ///< a finger has come, has gone
  double pressed[keys]{}, released[keys]{};
  double states[max_processes]{};  ///< what each has shown, as a number: they are to agree
};
static_assert(std::is_trivially_copyable_v<Told> && sizeof(Told) % sizeof(double) == 0);

/// A window of one wall. The first one's context draws; the others show its textures.
class WallWindow {
 public:
  static Result<WallWindow> open(const display::Display& display, const display::Wall& wall,
                                 const std::string& title, GLFWwindow* shares) {
    const bool has_buffers = display.stereo == display::Stereo::quad_buffer && wall.eye == display::Eye::both;
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_DECORATED, wall.window.has_border ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);
    glfwWindowHint(GLFW_STEREO, has_buffers ? GLFW_TRUE : GLFW_FALSE);
    WallWindow result;
    result.window_ =
        glfwCreateWindow(wall.pixels.x, wall.pixels.y, (title + ": " + wall.name).c_str(), nullptr, shares);
    if (!result.window_)
      return error("wall \"{}\": no window of {} x {} pixels{} can be opened there", wall.name, wall.pixels.x,
                   wall.pixels.y,
                   has_buffers ? " with stereo by two buffers (--stereo side_by_side needs none)" : "");
    result.has_buffers_ = has_buffers;
    if (wall.window.at) glfwSetWindowPos(result.window_, wall.window.at->x, wall.window.at->y);
    if (wall.window.is_full_screen) result.fill_screen();
    glfwMakeContextCurrent(result.window_);
    glfwSwapInterval(shares ? 0 : 1);  // waiting for each screen in turn would add up
    return result;
  }
  WallWindow(WallWindow&& other) noexcept
      : window_(std::exchange(other.window_, nullptr)), has_buffers_(other.has_buffers_) {}
  WallWindow& operator=(WallWindow&&) = delete;
  ~WallWindow() {
    if (window_) glfwDestroyWindow(window_);
  }

  GLFWwindow* window() const { return window_; }
  bool has_buffers() const { return has_buffers_; }
  /// Puts a wall's texture into the window's back buffer, or into that of an eye.
  void put(GLuint texture, glm::ivec2 size, display::Eye eye) {
    glfwMakeContextCurrent(window_);
    GLuint framebuffer = 0;  // framebuffers are not shared between contexts, and are cheap
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    if (has_buffers_) glDrawBuffer(eye == display::Eye::right ? GL_BACK_RIGHT : GL_BACK_LEFT);
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    glBlitFramebuffer(0, 0, size.x, size.y, 0, 0, width, height, GL_COLOR_BUFFER_BIT,
                      size == glm::ivec2(width, height) ? GL_NEAREST : GL_LINEAR);
    glDeleteFramebuffers(1, &framebuffer);
  }
  void swap() {
    glfwMakeContextCurrent(window_);
    glfwSwapBuffers(window_);
  }

 private:
  WallWindow() = default;
  /// Fills the screen that holds the window's corner.
  void fill_screen() {
    int count = 0, x = 0, y = 0;
    GLFWmonitor** const monitors = glfwGetMonitors(&count);
    glfwGetWindowPos(window_, &x, &y);
    for (int i = 0; i < count; ++i) {
      int left = 0, top = 0;
      glfwGetMonitorPos(monitors[i], &left, &top);
      const GLFWvidmode* const mode = glfwGetVideoMode(monitors[i]);
      if (x >= left && y >= top && x < left + mode->width && y < top + mode->height)
        return glfwSetWindowMonitor(window_, monitors[i], 0, 0, mode->width, mode->height, mode->refreshRate);
    }
  }

  GLFWwindow* window_ = nullptr;
  bool has_buffers_ = false;
};

/// Keyboard and mouse of all windows of this process.
struct WindowInput {
  Told told;
  glm::dvec2 cursor{0.0};
  bool is_dragging = false;

  void listen_to(GLFWwindow* window) {
    glfwSetWindowUserPointer(window, this);
    glfwSetKeyCallback(window, [](GLFWwindow* of, int key, int, int action, int) {
      if (key < 0 || action == GLFW_REPEAT) return;
      Told& into = static_cast<WindowInput*>(glfwGetWindowUserPointer(of))->told;
      (action == GLFW_PRESS ? into.pressed : into.released)[key] += 1.0;
    });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* of, int button, int action, int) {
      if (button == GLFW_MOUSE_BUTTON_LEFT)
        static_cast<WindowInput*>(glfwGetWindowUserPointer(of))->is_dragging = action == GLFW_PRESS;
    });
    glfwSetCursorPosCallback(window, [](GLFWwindow* of, double x, double y) {
      constexpr double radians_per_pixel = 0.0025;
      WindowInput& input = *static_cast<WindowInput*>(glfwGetWindowUserPointer(of));
      const glm::dvec2 moved = glm::dvec2(x, y) - input.cursor;
      input.cursor = {x, y};
      if (!input.is_dragging) return;
      input.told.turn[0] -= radians_per_pixel * moved.x, input.told.turn[1] -= radians_per_pixel * moved.y;
    });
    glfwSetScrollCallback(window, [](GLFWwindow* of, double, double steps) {
      static_cast<WindowInput*>(glfwGetWindowUserPointer(of))->told.zoom += steps;
    });
  }
};

/// The walls of this process, by their indices; also the operator's, which it adds.
Result<std::vector<std::size_t>> own_walls(display::Display& display, const machines::Processes& processes) {
  const std::size_t count = display.walls.size();
  const std::size_t processes_count = std::size_t(processes.count());
  if (processes_count > count + 1)
    return error("{} processes for {} walls; a display takes one for each, and one more for who operates it",
                 processes_count, count);
  std::vector<std::size_t> own;
  const bool has_operator = processes_count == count + 1;
  for (std::size_t i = 0; i < count; ++i)
    if (has_operator ? std::size_t(processes.rank()) == i + 1 : processes.has(i)) own.push_back(i);
  if (has_operator) {
    // As wide as a screen before the eye.
    display::Wall desk;
    desk.name = "operator";
    desk.lower_left = display.eye + glm::dvec3(-0.8, 1.0, -0.45);
    desk.lower_right = desk.lower_left + glm::dvec3(1.6, 0.0, 0.0);
    desk.upper_left = desk.lower_left + glm::dvec3(0.0, 0.0, 0.9);
    desk.pixels = {960, 540};
    desk.eye = display::Eye::left;
    if (Status status = display::set_keystone(desk, {glm::dvec2(0, 0), {1, 0}, {1, 1}, {0, 1}}); !status)
      return status.errors();
    display.walls.push_back(desk);
    if (processes.is_first()) own.push_back(count);
  }
  return own;
}

/// The loop over frames.
class WallFrames {
 public:
  WallFrames(std::vector<WallWindow>& windows, stage::Stage& stage, const Camera& start,
             const WallsOptions& options, const display::Display& display, std::vector<std::size_t> own,
             display::RoomOverlay overlay, std::optional<devices::Devices> devices)
      : windows_(windows),
        options_(options),
        display_(display),
        own_(std::move(own)),
        visit_(stage, start, {}),
        imgui_(1.0f),
        hearing_(options.processes.is_first() ? options.sound : "off"),
        panel_(imgui_, options.title),
        planning_(visit_, design::Language::english),
        bars_(imgui_, planning_, options.kept_pictures),
        overlay_(std::move(overlay)),
        devices_(std::move(devices)) {
    planning_.keeps_files = options.processes.is_first();
    if (options.plans) planning_.turn_on(true);
    for (WallWindow& window : windows) input_.listen_to(window.window());
    head_.position = options.eye;
    panel_.is_open = true;
    ImGui::GetIO().DisplaySize = {panel_size.x, panel_size.y};
    glfwMakeContextCurrent(windows.front().window());
    panel_texture_ = gl::texture_2d(GL_RGBA8, int(panel_size.x), int(panel_size.y));
    panel_framebuffer_ = gl::Framebuffer::create();
    glNamedFramebufferTexture(panel_framebuffer_.name(), GL_COLOR_ATTACHMENT0, panel_texture_.name(), 0);
    if (!options.frame_log.empty())
      log_.open(options.frame_log.string() + fmt::format(".{}.csv", options.processes.rank()));
    if (!options.camera.empty() && !visit_.actions().camera(visit_.scene())) visit_.look_from(options.camera);
  }

  Status run() {
    const Steady::time_point began = Steady::now();
    Steady::time_point last = began;
    double scene_s = 0.0;
    for (int frame = 1;; ++frame) {
      Told told = gathered(std::chrono::duration<double>(Steady::now() - began).count());
      const Steady::time_point now = Steady::now();
      told.seconds = options_.processes.is_first() ? std::chrono::duration<double>(now - last).count() : 0.0;
      last = now;
      wait_for_all();
      options_.processes.sum(std::span(reinterpret_cast<double*>(&told), sizeof told / sizeof(double)));
      compare_states(told);
      const bool ends = told.ends > 0.0 || frame == options_.max_frames;
      scene_s += told.seconds;
      step(told);
      if (Status status = draw(told.seconds); !status) return status;
      glFinish();
      wait_for_all();
      has_begun_ = true;
      for (WallWindow& window : windows_) window.swap();
      if (log_)
        log_ << fmt::format("{},{},{:.6f}\n", frame, Steady::now().time_since_epoch().count(), scene_s)
             << std::flush;
      glfwMakeContextCurrent(windows_.front().window());
      if (ends)
        return options_.screenshots.empty()
                   ? Status(Ok{})
                   : stage::write_walls(display_, pictures_, *screens_, options_.screenshots);
    }
  }

 private:
  static constexpr glm::vec2 panel_size{900.0f, 600.0f};

  /// Names the walls of processes that hang, and ends the show where they go on to once all have shown a
  /// frame: how long loading takes differs between machines.
  void wait_for_all() const {
    constexpr double longest_s = 30.0;
    options_.processes.wait_for_all([&](std::span<const int> missing, double seconds) {
      for (const int process : missing)
        fmt::print(stderr, "process {} has not answered for {:.0f} s: {}\n", process, seconds,
                   seconds < longest_s || !has_begun_ ? "the walls wait for it" : "the show ends");
      if (seconds >= longest_s && has_begun_) options_.processes.give_up();
    });
  }

  /// The part of the frame to come that this process knows.
  Told gathered(double now_s) {
    glfwPollEvents();
    Told told = std::exchange(input_.told, Told());
    for (const WallWindow& window : windows_) {
      if (glfwWindowShouldClose(window.window())) told.ends += 1.0;
      const auto held = [&](int key) { return glfwGetKey(window.window(), key) == GLFW_PRESS ? 1.0 : 0.0; };
      told.move[0] += held(GLFW_KEY_W) - held(GLFW_KEY_S),
          told.move[1] += held(GLFW_KEY_A) - held(GLFW_KEY_D);
      told.move[2] += held(GLFW_KEY_E) - held(GLFW_KEY_Q), told.hurries += held(GLFW_KEY_LEFT_SHIFT);
    }
    told.ends += told.pressed[GLFW_KEY_ESCAPE];
    told.states[options_.processes.rank()] = state_;
    if (!devices_) return told;
    devices_->poll(now_s);
    devices::InputState& state = devices_->state();
    for (const std::string& note : devices_->take_notes()) fmt::print(stderr, "{}\n", note);
    const auto put = [](glm::dvec3 value, double* into) {
      into[0] = value.x, into[1] = value.y, into[2] = value.z;
    };
    const devices::Pose head = state.pose(display_.head, now_s).value_or(devices::Pose{options_.eye});
    put(head.position, told.eye), put(head.turn * glm::dvec3(1, 0, 0), told.eye_right);
    if (const std::optional<devices::Pose> wand = state.pose(display_.wand, now_s)) {
      told.has_wand = 1.0;
      put(wand->position, told.wand);
      told.wand_turn[0] = wand->turn.x, told.wand_turn[1] = wand->turn.y, told.wand_turn[2] = wand->turn.z,
      told.wand_turn[3] = wand->turn.w;
    }
    point_with_finger(state.fingers(), head.position, told);
    for (const devices::ButtonEvent& event : state.take_buttons())
      if (event.device == devices_->settings().buttons_of &&
          event.number <= int(devices::DeviceSettings::wand_buttons))
        (event.is_pressed ? told.buttons_down : told.buttons_up)[event.number - 1] += 1.0;
    const glm::dvec2 stick = state.stick(devices_->settings().buttons_of);
    told.move[0] += stick.y, told.turn[0] -= stick_radians_per_frame * stick.x;
    const std::array<double, 5> motion = state.motion();
    told.move[0] += motion[1], told.move[1] -= motion[0], told.move[2] += motion[2];
    told.turn[0] += stick_radians_per_frame * motion[3], told.turn[1] += stick_radians_per_frame * motion[4];
    return told;
  }

  /// The moment that is shown, as a number. Levels of detail, which each process has by its own eyes, are no
  /// part of it.
  double state() {
    ContentHash hash;
    const action::SceneClock& clock = visit_.stage().simulation().clock;
    hash.add(clock.time_s());
    hash.add(visit_.camera().world_from_camera);
    for (const action::Process* process : clock.processes()) hash.add_text(process->status());
    if (planning_.session()) hash.add(planning_.session()->done().size());
    return double(std::uint32_t(hash.value()));  // it passes through sums of doubles unchanged
  }

  /// A finger on the first wall, a table say, is a rod from the eye that clicks.
  void point_with_finger(const std::map<int, glm::dvec2>& fingers, glm::dvec3 eye, Told& told) {
    const display::Wall& wall = display_.walls.front();
    const bool touches = !fingers.empty() && !wall.is_curved;
    if (!touches && !touched_) return;
    const glm::dvec2 at = touches ? fingers.begin()->second : *touched_;
    const glm::dvec3 point = wall.lower_left + at.x * (wall.lower_right - wall.lower_left) +
                             (1.0 - at.y) * (wall.upper_left - wall.lower_left);
    const glm::dquat turn(glm::dvec3(0, 1, 0), glm::normalize(point - eye));
    told.has_wand = 1.0;
    for (int axis = 0; axis < 3; ++axis) told.wand[axis] = eye[axis];
    told.wand_turn[0] = turn.x, told.wand_turn[1] = turn.y, told.wand_turn[2] = turn.z,
    told.wand_turn[3] = turn.w;
    if (touches != touched_.has_value()) (touches ? told.touches_down : told.touches_up) += 1.0;
    touches ? touched_ = at : touched_ = std::nullopt;
  }

  /// Says where processes differ: a library or a machine that rounds otherwise.
  void compare_states(const Told& told) {
    if (has_differed_) return;
    for (int i = 1; i < options_.processes.count(); ++i)
      if (told.states[i] != told.states[0]) {
        has_differed_ = true;
        if (options_.processes.is_first())
          fmt::print(stderr, "warning: process {} shows another state of the scene than the first\n", i);
      }
  }

  void step(const Told& told) {
    const auto point = [](const double* at) { return glm::dvec3(at[0], at[1], at[2]); };
    if (glm::length(point(told.eye_right)) > 0.5)
      head_ = {point(told.eye), glm::normalize(point(told.eye_right))};
    wand_.reset();
    if (told.has_wand > 0.0)
      wand_ = devices::Pose{point(told.wand), glm::dquat(told.wand_turn[3], told.wand_turn[0],
                                                         told.wand_turn[1], told.wand_turn[2])};
    for (std::size_t key = 0; key < keys; ++key) {
      const std::string name = told.pressed[key] + told.released[key] > 0.0 ? key_name(int(key)) : "";
      const bool is_for_scene = !name.empty() && visit_.actions().uses_key(name);
      if (told.pressed[key] > 0.0 && is_for_scene) visit_.actions().press(name);
      if (told.released[key] > 0.0 && is_for_scene) visit_.actions().release(name);
      if (told.pressed[key] > 0.0 && !is_for_scene && !press_visit_key(visit_, int(key)) &&
          key == GLFW_KEY_F3)
        planning_.turn_on(!planning_.is_on());
    }
    use_buttons(told.buttons_down, told.touches_down, true);
    Controls controls;
    for (int axis = 0; axis < 3; ++axis)
      controls.move[axis] = std::clamp(float(told.move[axis]), -1.0f, 1.0f);
    controls.turn = {float(told.turn[0]), float(told.turn[1])};
    controls.zoom = float(told.zoom), controls.hurries = told.hurries > 0.0;
    const glm::vec3 stood = visit_.camera().position_in_world();
    planning_.step(float(told.seconds), wand_.has_value());
    visit_.step(controls, float(told.seconds));
    point_with_rod();
    clicks_panel_ = is_clicking_;
    // A slow frame may hold the whole of a click.
    use_buttons(told.buttons_up, told.touches_up, false);
    if (has_clicked_) point_with_rod();
    feeling_.step(visit_, planning_, controls, stood, float(told.seconds), devices_ ? &*devices_ : nullptr);
    statistics_.add(told.seconds, visit_.stage().pass_times().latest());
    if (options_.processes.is_first()) {
      hearing_.step(visit_.scene(), visit_.camera(), visit_.stage().simulation().clock.time_s(),
                    told.seconds);
      if (const std::string message = hearing_.take_message(); !message.empty()) visit_.notice(message);
      for (const Notice& notice : visit_.notices())
        if (notice.is_error && notice.text != told_error_)
          fmt::print(stderr, "{}\n", told_error_ = notice.text);
    }
  }

  /// Does what buttons of the wand are for that were pressed or let go; a finger is one for clicks.
  void use_buttons(std::span<const double> counts, double touches, bool is_pressed) {
    for (std::size_t i = 0; i < counts.size(); ++i)
      if (counts[i] > 0.0) use(options_.devices.buttons[i], is_pressed);
    if (touches > 0.0) use({devices::ButtonUse::Kind::action, ""}, is_pressed);
  }

  /// Does what a button of the wand is for.
  void use(const devices::ButtonUse& use, bool is_pressed) {
    using Kind = devices::ButtonUse::Kind;
    if (use.kind == Kind::key) {
      if (visit_.actions().uses_key(use.text))
        is_pressed ? visit_.actions().press(use.text) : visit_.actions().release(use.text);
      return;
    }
    if (use.kind == Kind::action) is_clicking_ = is_pressed, has_clicked_ = true;
    if (!is_pressed) return;
    if (use.kind == Kind::menu) shows_panel_ = !shows_panel_;
    if (use.kind == Kind::view || use.kind == Kind::command) {
      if (!planning_.is_on()) planning_.turn_on(true);
      if (!planning_.is_on()) return;
    }
    if (use.kind == Kind::view)
      planning_.look(use.text == "plan"     ? PlanningView::plan
                     : use.text == "street" ? PlanningView::street
                                            : PlanningView::balcony);
    if (use.kind == Kind::command) static_cast<void>(planning_.run(use.text));
  }

  /// The panel in the room, before the eye at arm's length and a little below.
  display::RoomPanel room_panel() const {
    return {display_.eye + glm::dvec3(-0.45, 0.9, -0.75), {0.9, 0.0, 0.0}, {0.0, 0.2, 0.566}};
  }

  /// The rod points: at the panel, else into the scene.
  void point_with_rod() {
    const bool clicks = std::exchange(has_clicked_, false);
    rod_end_.reset(), panel_cursor_.reset();
    if (!wand_) return;
    const glm::dvec3 ahead = wand_->turn * glm::dvec3(0, 1, 0);
    if (shows_panel_) panel_cursor_ = room_panel().hit(wand_->position, ahead);
    rod_end_ = wand_->position + rod_m * ahead;
    if (panel_cursor_ || !planning_.is_on()) return;
    const glm::dmat4 from_room = display::world_from_room(display_, visit_.camera());
    const auto world = [&](glm::dvec3 at) { return glm::dvec3(from_room * glm::dvec4(at, 1.0)); };
    const glm::dvec3 from = world(wand_->position), to = world(wand_->position + ahead);
    planner::Pointer pointer;
    pointer.camera = visit_.camera();
    pointer.camera.parallel.reset(), pointer.camera.off_axis.reset();
    const bool is_steep = std::abs(glm::normalize(to - from).z) > 0.99;
    pointer.camera.world_from_camera = look_at(from, to, is_steep ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1));
    pointer.size = {1280, 720}, pointer.pixel = {640.0, 360.0};
    planner::Tool& tool = *planning_.tool();
    tool.point(pointer);
    if (const std::optional<glm::dvec3> place = tool.place()) {
      const glm::dvec3 at = glm::dvec3(glm::inverse(from_room) * glm::dvec4(*place, 1.0));
      if (glm::dot(at - wand_->position, ahead) > 0.0) rod_end_ = at;
    }
    if (clicks && is_clicking_) static_cast<void>(tool.press(pointer));
    if (clicks && !is_clicking_ && tool.is_dragging()) planning_.tell(tool.release(pointer));
  }

  /// The panel and the planner's bars as a texture.
  void draw_panel(double seconds) {
    ImGuiIO& io = ImGui::GetIO();
    io.DeltaTime = std::max(float(seconds), 1e-4f);
    io.MousePos = panel_cursor_
                      ? ImVec2(float(panel_cursor_->x) * panel_size.x, float(panel_cursor_->y) * panel_size.y)
                      : ImVec2(-1e6f, -1e6f);
    io.MouseDown[0] = clicks_panel_ && panel_cursor_;
    imgui_.begin_frame();
    if (planning_.is_on() != bool(panel_.design_page))
      panel_.design_page = planning_.is_on() ? [this](PanelRows& rows) { bars_.draw_inspector(rows); }
                                             : std::function<void(PanelRows&)>();
    panel_.draw(visit_, statistics_, &hearing_);
    bars_.draw(panel_size.x - panel_.width());
    panel_.is_open = true;  // the wand's button closes it
    glBindFramebuffer(GL_FRAMEBUFFER, panel_framebuffer_.name());
    glViewport(0, 0, int(panel_size.x), int(panel_size.y));
    constexpr std::array clear{0.0f, 0.0f, 0.0f, 0.0f};
    glClearBufferfv(GL_COLOR, 0, clear.data());
    imgui_.draw();
  }

  Status draw(double seconds) {
    glfwMakeContextCurrent(windows_.front().window());
    if (shows_panel_) draw_panel(seconds);
    pictures_ = display::pictures_of(display_, head_, visit_.camera(), own_);
    if (!screens_) {
      Result<display::Screens> screens = display::Screens::create(display_, pictures_);
      if (!screens) return screens.errors();
      screens_.emplace(*std::move(screens));
    }
    const auto draw_room = [&](std::size_t i) {
      const GLuint framebuffer = screens_->framebuffer_of(i);
      if (shows_panel_) overlay_.draw_panel(pictures_[i], framebuffer, room_panel(), panel_texture_.name());
      if (wand_ && rod_end_)
        overlay_.draw_rod(pictures_[i], framebuffer, head_.position, wand_->position, *rod_end_,
                          {0.91f, 0.2f, 0.12f});
    };
    if (Status status = stage::draw_walls(visit_.stage(), display_, pictures_, *screens_, draw_room); !status)
      return status;
    glFinish();  // before other contexts read the textures
    state_ = state();
    for (std::size_t i = 0; i < windows_.size(); ++i) {
      const glm::ivec2 size = display_.walls[own_[i]].pixels;
      windows_[i].put(screens_->texture_of(own_[i], display::Eye::left), size, display::Eye::left);
      if (windows_[i].has_buffers())
        windows_[i].put(screens_->texture_of(own_[i], display::Eye::right), size, display::Eye::right);
    }
    return Ok{};
  }

  static constexpr double stick_radians_per_frame = 0.02, rod_m = 8.0;

  std::vector<WallWindow>& windows_;
  const WallsOptions& options_;
  const display::Display& display_;
  std::vector<std::size_t> own_;
  Visit visit_;
  ImguiContext imgui_;
  Hearing hearing_;
  Panel panel_;
  Planning planning_;
  PlanningBars bars_;
  display::RoomOverlay overlay_;
  std::optional<devices::Devices> devices_;  ///< of the first process
  std::optional<display::Screens> screens_;
  std::vector<display::WallPicture> pictures_;
  gl::Texture panel_texture_;
  gl::Framebuffer panel_framebuffer_;
  WindowInput input_;
  FrameStatistics statistics_;
  display::Head head_;
  std::optional<devices::Pose> wand_;
  std::optional<glm::dvec2> touched_;       ///< where the finger is, or was in the last frame
  std::optional<glm::dvec3> rod_end_;       ///< in the room
  std::optional<glm::dvec2> panel_cursor_;  ///< of the rod: shares from the upper left
  bool clicks_panel_ = false, shows_panel_ = false, is_clicking_ = false, has_clicked_ = false,
       has_differed_ = false, has_begun_ = false;
  Feeling feeling_;
  double state_ = 0.0;
  std::string told_error_;
  std::ofstream log_;
};

}  // namespace

Status show_walls(stage::Simulation simulation, const WallsOptions& options) {
  display::Display display = options.display;
  const Result<std::vector<std::size_t>> own = own_walls(display, options.processes);
  if (!own) return own.errors();
  const std::string& x_display = display.walls[own->front()].window.x_display;
  for (const std::size_t wall : *own)
    if (display.walls[wall].window.x_display != x_display)
      return error(
          "walls \"{}\" and \"{}\" are on two X displays: start a process for each wall (mpirun -n {})",
          display.walls[own->front()].name, display.walls[wall].name, display.walls.size());
  if (!x_display.empty()) setenv("DISPLAY", x_display.c_str(), 1);
  struct Glfw {
    ~Glfw() { glfwTerminate(); }
  } glfw;
  if (!glfwInit())
    return error(
        "no window can be opened: there is no display; parvis render --display writes the walls' pictures "
        "without one");
  std::vector<WallWindow> windows;
  for (const std::size_t wall : *own) {
    Result<WallWindow> window = WallWindow::open(display, display.walls[wall], "Parvis: " + options.title,
                                                 windows.empty() ? nullptr : windows.front().window());
    if (!window) return window.errors();
    windows.push_back(*std::move(window));
  }
  glfwMakeContextCurrent(windows.front().window());
  if (Status status = gl::check_current(); !status) return status;
  Result<std::unique_ptr<stage::Stage>> stage = stage::Stage::create(std::move(simulation));
  if (!stage) return stage.errors();
  const Result<Camera> start = (*stage)->camera(options.camera);
  if (!start) return start.errors();
  Result<display::RoomOverlay> overlay = display::RoomOverlay::create();
  if (!overlay) return overlay.errors();
  std::optional<devices::Devices> devices;
  if (options.processes.is_first()) {
    Result<devices::Devices> opened =
        devices::Devices::open(options.devices, options.recording, options.replayed);
    if (!opened) return opened.errors();
    devices.emplace(*std::move(opened));
  }
  for (const std::size_t wall : *own)
    fmt::print(stderr, "process {} shows wall \"{}\"\n", options.processes.rank(), display.walls[wall].name);
  Status shown =
      WallFrames(windows, **stage, *start, options, display, *own, *std::move(overlay), std::move(devices))
          .run();
  stage->reset();  // while its context is there
  return shown;
}

}  // namespace parvis::viewer
