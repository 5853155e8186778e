#include "viewer/window.h"

#include <epoxy/gl.h>
// after epoxy, which brings the declarations of OpenGL
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>

#include <array>
#include <chrono>

#include "base/image_io.h"
#include "graphics/gl/context.h"
#include "graphics/render/picture_target.h"
#include "reflections/methods/settings.h"
#include "stage/refinement.h"
#include "stage/stillness.h"
#include "viewer/feeling.h"
#include "viewer/input.h"
#include "viewer/keys.h"
#include "viewer/panel.h"
#include "viewer/planning_bars.h"
#include "viewer/study_desk.h"
#include "viewer/window_hearing.h"

namespace parvis::viewer {
namespace {

/// Ends GLFW and its window when it goes.
struct Glfw {
  GLFWwindow* window = nullptr;
  ~Glfw() {
    if (window) glfwDestroyWindow(window);
    glfwTerminate();
  }
};

std::string title_of(const WindowOptions& options) { return "Parvis: " + options.title; }

Status open_window(Glfw& glfw, const WindowOptions& options) {
  if (!glfwInit())
    return error("no window can be opened: there is no display; parvis render makes pictures without one");
  const std::string title = title_of(options);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfw.window = glfwCreateWindow(options.width, options.height, title.c_str(), nullptr, nullptr);
  if (!glfw.window) {  // what is there instead?
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    glfw.window = glfwCreateWindow(1, 1, title.c_str(), nullptr, nullptr);
  }
  if (!glfw.window) return error("no window can be opened: the display offers no OpenGL");
  glfwMakeContextCurrent(glfw.window);
  return gl::check_current();
}

/// How large things are drawn on the window's screen, in the window's units, and pixels a unit.
struct Scale {
  float interface, pixels_per_point;
  bool operator==(const Scale&) const = default;
};

/// The screen's own scale times the size of text that the visitor wants, as far as the tools fit the window.
Scale scale_of(GLFWwindow* window, float text_factor) {
  constexpr float tools_height = 340.0f, bars_width = 400.0f;  // at scale 1
  float asked = 1.0f, ignored = 1.0f;
  glfwGetWindowContentScale(window, &asked, &ignored);
  int points = 0, height = 0, pixels = 0, ignored_height = 0;
  glfwGetWindowSize(window, &points, &height);
  glfwGetFramebufferSize(window, &pixels, &ignored_height);
  const float pixels_per_point = points > 0 && pixels > 0 ? float(pixels) / float(points) : 1.0f;
  const float usual = std::max(asked / pixels_per_point, 0.5f);
  const float fitting = std::min(float(height) / tools_height, float(points) / bars_width);
  return {std::clamp(text_factor * usual, usual, std::max(fitting, usual)), pixels_per_point};
}

/// GLFW's part of Dear ImGui; after the window's own callbacks, which it calls.
struct ImguiInput {
  explicit ImguiInput(GLFWwindow* window) { ImGui_ImplGlfw_InitForOpenGL(window, true); }
  ImguiInput(const ImguiInput&) = delete;
  ~ImguiInput() { ImGui_ImplGlfw_Shutdown(); }
};

/// Says in the window what is done until the first picture is there: a black window looks as if it hung.
void show_opening(GLFWwindow* window, const WindowOptions& options) {
  const Scale scale = scale_of(window, options.text_size);
  ImguiContext imgui(scale.interface, scale.pixels_per_point);
  const ImguiInput input(window);
  for (int buffer = 0; buffer < 2; ++buffer) {  // both of them: the window may be mapped after the first
    glfwPollEvents();
    ImGui_ImplGlfw_NewFrame();
    imgui.begin_frame();
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * size.x, 0.5f * size.y}, 0, {0.5f, 0.5f});
    ImGui::Begin("opening", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::PushFont(imgui.fonts().heading);
    ImGui::Text("%s is being prepared", options.title.c_str());
    ImGui::PopFont();
    ImGui::TextUnformatted(
        gl::is_software() ? "Shaders, light and reflections; without a graphics card this can take a minute."
                          : "Shaders, light and reflections.");
    ImGui::End();
    glClear(GL_COLOR_BUFFER_BIT);
    imgui.draw();
    glfwSwapBuffers(window);
  }
  glfwSetWindowTitle(window, (title_of(options) + ": is being prepared").c_str());
  glfwPollEvents();
}

Image8 read_window(int width, int height) {
  Image8 picture(width, height, 3);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, picture.pixels.data());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  render::flip_rows(picture);
  return picture;
}

void print_keys() {
  for (const KeyHelp& help : key_help) fmt::print("  {:<8} {}\n", help.keys, help.does);
}

/// The loop over frames.
class Frames {
 public:
  Frames(GLFWwindow* window, stage::Stage& stage, const Camera& start, const WindowOptions& options)
      : window_(window),
        options_(options),
        scale_(scale_of(window, options.text_size)),
        visit_(stage, start, options.pictures),
        imgui_(scale_.interface, scale_.pixels_per_point),
        hearing_(options.sound),
        panel_(imgui_, options.title, options.language),
        planning_(visit_, options.language),
        bars_(imgui_, planning_, options.kept_pictures),
        input_(window, visit_, panel_, planning_, hearing_),
        imgui_input_(window) {
    panel_.is_open = options.has_panel, panel_.text_size = options.text_size;
    if (options.plans) planning_.turn_on(true);
    if (options.study) {
      panel_.shows_design_alone = true;
      study_.emplace(*options.study, planning_, imgui_);
    }
    if (!planning_.is_on()) visit_.notice("F1 shows the keys, F2 the panel, K what can be placed");
    stage.hold_rate(rate_of(options, gl::is_software()));
    open_devices();
    // A camera that follows takes the view along until the visitor moves.
    if (!options.camera.empty() && !visit_.actions().camera(visit_.scene())) visit_.look_from(options.camera);
  }

  Status run() {
    Clock::time_point last = Clock::now(), settled = last;
    for (int frame = 1;; ++frame) {
      const Clock::time_point now = Clock::now();
      const float seconds = std::chrono::duration<float>(now - last).count();
      last = now;
      statistics_.add(double(seconds), visit_.stage().pass_times().latest());
      const bool held = planning_.holds_things();
      if (!rests_ && !held) visit_.stage().follow_clock(1e3 * double(seconds));
      if (study_) study_->begin_frame();
      Controls controls = input_.poll(double(seconds));
      if (devices_) move_by_devices(controls, double(seconds));
      const glm::vec3 stood = visit_.camera().position_in_world();
      const Clock::time_point stepped = Clock::now();
      visit_.step(controls, seconds, planning_.holds_things());
      const Clock::time_point moved = Clock::now();
      feeling_.step(visit_, planning_, controls, stood, seconds, devices_ ? &*devices_ : nullptr);
      if (study_) study_->add_frame(double(seconds));
      const Clock::time_point listened = Clock::now();
      hearing_.set_share(visit_.stage().shared_budget().share(stage::Lowered::sound));
      hear(double(seconds));
      statistics_.add_on_processor(std::array{pass_of("people, traffic, events", stepped, moved),
                                              pass_of("sound", listened, Clock::now())});
      draw(double(seconds));
      const bool is_last =
          glfwWindowShouldClose(window_) || frame == options_.max_frames || (study_ && study_->has_ended());
      if (is_last && !options_.screenshot.empty())
        if (Status status = write_image(options_.screenshot, read_window(width_, height_)); !status)
          return status;
      glfwSwapBuffers(window_);
      if (frame == 1) glfwSetWindowTitle(window_, title_of(options_).c_str());
      show_refinement();
      if (frame == settling_frames) settled = Clock::now();
      if (is_last) {
        print_rate(frame - settling_frames, std::chrono::duration<double>(Clock::now() - settled).count());
        return Ok{};
      }
      if (rests_) glfwWaitEventsTimeout(rest_s);
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr int settling_frames = 30;
  static constexpr double rest_s = 0.1;  ///< between frames at rest: the ray tracer needs the processor

  static gl::PassTime pass_of(const char* name, Clock::time_point begin, Clock::time_point end) {
    return {name, std::chrono::duration<double>(end - begin).count()};
  }

  /// A scene that can be felt needs a gamepad; a file of devices may ask for more.
  void open_devices() {
    if (!options_.devices && (options_.max_frames > 0 || !Feeling::is_in(visit_.scene()))) return;
    devices::DeviceSettings settings = options_.devices.value_or(devices::DeviceSettings());
    settings.osc_port = 0;  // trackers are for displays
    if (Result<devices::Devices> opened = devices::Devices::open(settings))
      devices_.emplace(*std::move(opened));
  }

  /// Sticks and 3D mice move the visitor.
  void move_by_devices(Controls& controls, double passed_s) {
    constexpr double radians_per_s = 1.2;
    devices_->poll(devices_s_ += passed_s);
    for (const std::string& note : devices_->take_notes()) visit_.notice(note);
    devices_->state().take_buttons();  // GLFW reports them
    const glm::dvec2 stick = devices_->state().stick(devices_->settings().buttons_of);
    const std::array<double, 5> motion = devices_->state().motion();
    controls.move += glm::vec3(stick.y + motion[1], -motion[0], motion[2]);
    controls.move = glm::clamp(controls.move, -1.0f, 1.0f);
    controls.turn += glm::vec2(radians_per_s * passed_s * glm::dvec2(motion[3] - stick.x, motion[4]));
  }

  void hear(double passed_s) {
    hearing_.step(visit_.scene(), visit_.camera(), visit_.stage().simulation().clock.time_s(), passed_s);
    if (const std::string message = hearing_.take_message(); !message.empty()) visit_.notice(message);
  }

  void draw(double passed_s) {
    glfwGetFramebufferSize(window_, &width_, &height_);
    if (width_ == 0 || height_ == 0) return;  // an icon
    if (const Scale scale = scale_of(window_, panel_.text_size); scale != scale_) {
      scale_ = scale;
      imgui_.rescale(scale.interface, scale.pixels_per_point);
    }
    ImGui_ImplGlfw_NewFrame();
    imgui_.begin_frame();
    if (planning_.is_on() != bool(panel_.design_page))
      panel_.design_page = planning_.is_on() ? [this](PanelRows& rows) { bars_.draw_inspector(rows); }
                                             : std::function<void(PanelRows&)>();
    panel_.notices_foot = bars_.height_below();
    panel_.draw(visit_, statistics_, &hearing_);
    bars_.draw(ImGui::GetIO().DisplaySize.x - panel_.width());
    if (study_) study_->draw(ImGui::GetIO().DisplaySize.x - panel_.width());

    stage::Stage& stage = visit_.stage();
    const int covered = int(panel_.width() * scale_.pixels_per_point);
    const int shown_width = std::max(width_ - covered, 1);
    stillness_.add_frame(stage.scene(), visit_.camera(), shown_width, height_, passed_s);
    const bool held = planning_.holds_things();
    rests_ = options_.max_frames == 0 && stillness_.rests() && !held;
    if (held)
      planning_.draw_held(shown_width, height_);
    else if (planning_.compares_pictures())
      planning_.draw_compared(shown_width, height_, 0);
    else if (rests_)
      stage.refine(visit_.camera(), shown_width, height_);
    else
      stage.draw(visit_.camera(), shown_width, height_);
    if (held || !planning_.compares_pictures()) stage.display(0);
    if (held && planning_.compares_pictures() && planning_.compared_view() == ComparedView::slider)
      planning_.display_other(0);
    stage.pass_times().end_pass("display");
    glViewport(0, 0, width_, height_);
    imgui_.draw();
    stage.pass_times().end_pass("panel");
  }

  /// Prints the rate for measurements: frames of the visit, those apart in which shaders are made and the
  /// resolution found.
  void print_rate(int frames, double seconds) {
    if (frames < 1) return;
    fmt::print("{} frames, once settled {:.2f} per second; the last one drew {:.0f} % of its pixels\n",
               frames, frames / seconds, 100.0 * visit_.stage().drawn_share());
    for (const gl::PassTime& pass : visit_.stage().pass_times().latest())
      fmt::print("  {}: {:.0f} ms\n", pass.name, 1e3 * pass.seconds);
    for (const gl::PassTime& pass : statistics_.passes_on_processor())
      fmt::print("  {}: {:.1f} ms\n", pass.name, 1e3 * pass.seconds);
    if (const auto [core_fraction, voices] = hearing_.cost(); voices > 0)
      fmt::print("  mixing beside: {:.1f} % of a core, {} voices, {:.4f} ms per second and voice\n",
                 100.0 * core_fraction, voices, 1e3 * core_fraction / double(voices));
  }

  /// Says in the window's title how far the picture at rest is refined.
  void show_refinement() {
    const int samples = visit_.stage().refined_samples();
    if (samples == told_samples_) return;
    told_samples_ = samples;
    const std::string refined =
        samples == 0 ? ""
        : samples == stage::Refinement::max_samples
            ? fmt::format(": reference picture, {} rays per pixel", samples)
            : fmt::format(": refining, {} of {} rays per pixel", samples, stage::Refinement::max_samples);
    glfwSetWindowTitle(window_, (title_of(options_) + refined).c_str());
  }

  GLFWwindow* window_;
  const WindowOptions& options_;
  stage::Stillness stillness_;
  bool rests_ = false;  ///< in the last frame
  int told_samples_ = 0;
  Scale scale_;
  Visit visit_;
  ImguiContext imgui_;
  Hearing hearing_;
  Panel panel_;
  Planning planning_;
  PlanningBars bars_;
  std::optional<StudyDesk> study_;
  std::optional<devices::Devices> devices_;
  double devices_s_ = 0.0;  ///< since the first frame
  Feeling feeling_;
  Input input_;
  ImguiInput imgui_input_;
  FrameStatistics statistics_;
  int width_ = 0, height_ = 0;
};

}  // namespace

double rate_of(const WindowOptions& options, bool is_software) {
  constexpr double software_rate = 15.0, gpu_rate = 60.0;
  if (options.frames_per_second) return *options.frames_per_second;
  if (options.max_frames > 0 && !options.always_holds_rate) return 0.0;
  return is_software ? software_rate : gpu_rate;
}

bool begins_at_once(const WindowOptions& options) {
  return options.max_frames == 0 || options.always_holds_rate;
}

Status show(stage::Simulation simulation, const WindowOptions& options) {
  Glfw glfw;
  if (Status status = open_window(glfw, options); !status) return status;
  show_opening(glfw.window, options);
  print_keys();
  for (;;) {
    simulation.scene.data<methods::Pace>().begins_at_once = begins_at_once(options);
    Result<std::unique_ptr<stage::Stage>> stage = stage::Stage::create(std::move(simulation));
    if (!stage) return stage.errors();
    const Result<Camera> start = (*stage)->camera(options.camera);
    if (!start) return start.errors();
    if (Status status = Frames(glfw.window, **stage, *start, options).run(); !status) return status;
    if (!options.next_scene || options.max_frames > 0 || glfwWindowShouldClose(glfw.window)) return Ok{};
    Result<std::optional<stage::Simulation>> next = options.next_scene();
    if (!next) return next.errors();
    if (!*next) return Ok{};
    simulation = **std::move(next);
    show_opening(glfw.window, options);
  }
}

}  // namespace parvis::viewer
