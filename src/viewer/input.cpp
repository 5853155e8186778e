#include "viewer/input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <utility>

#include "viewer/key_names.h"
#include "viewer/visit_keys.h"

namespace parvis::viewer {
namespace {

constexpr float radians_per_pixel = 0.0025f;
constexpr std::array movement{GLFW_KEY_W, GLFW_KEY_S, GLFW_KEY_A, GLFW_KEY_D, GLFW_KEY_E, GLFW_KEY_Q};
constexpr double tap_s =
    0.15;  // a key that was pressed and released while a frame was drawn was held so long
constexpr double farthest_click = 4.0;  // from press to release, in the window's units: beyond, it is a drag

/// Keys of the planner's tool that go on while they are held: others would switch to and fro.
bool repeats(int key) {
  constexpr std::array keys{GLFW_KEY_LEFT, GLFW_KEY_RIGHT, GLFW_KEY_UP, GLFW_KEY_DOWN,     GLFW_KEY_Q,
                            GLFW_KEY_E,    GLFW_KEY_Z,     GLFW_KEY_Y,  GLFW_KEY_BACKSPACE};
  return std::ranges::find(keys, key) != keys.end();
}

/// Does the mouse belong to panel and bars at a place of the window? ImGui's own answer is of the last frame:
/// on a slow machine the cursor has come to a button since.
bool belongs_to_widgets(glm::dvec2 cursor) {
  if (ImGui::GetIO().WantCaptureMouse) return true;
  const ImVec2 at(float(cursor.x), float(cursor.y));
  return std::ranges::any_of(ImGui::GetCurrentContext()->Windows, [&](const ImGuiWindow* window) {
    return window->WasActive && !window->Hidden && (window->Flags & ImGuiWindowFlags_NoMouseInputs) == 0 &&
           window->Rect().Contains(at);
  });
}

/// Keys that change the scene beside its design, or end the window: participants of a study have none of
/// them.
bool is_kept_from_participants(int key) {
  constexpr std::array keys{GLFW_KEY_TAB, GLFW_KEY_SPACE,   GLFW_KEY_N,         GLFW_KEY_P, GLFW_KEY_3,
                            GLFW_KEY_C,   GLFW_KEY_PAGE_UP, GLFW_KEY_PAGE_DOWN, GLFW_KEY_F3};
  return std::ranges::find(keys, key) != keys.end();
}

/// The key whose label on the keyboard in use is this key's name. GLFW names keys by their places on an
/// American keyboard: on a French one the key of undo would be the one labelled W. Without Ctrl the keys of
/// movement stay where the hand lies, and no other key becomes one of them.
int by_label(int key, int scancode, int modifiers) {
  const auto moves = [](int of) { return std::ranges::find(movement, of) != movement.end(); };
  const bool has_control = (modifiers & GLFW_MOD_CONTROL) != 0;
  if (!has_control && moves(key)) return key;
  const char* const name = glfwGetKeyName(key, scancode);
  if (!name || name[1] != 0 || name[0] < 'a' || name[0] > 'z') return key;
  const int labelled = GLFW_KEY_A + (name[0] - 'a');
  return !has_control && moves(labelled) ? key : labelled;
}

/// 1 for the keys of a larger text, -1 for those of a smaller one; 0: it is none of them.
int text_size_step(int key, int scancode) {
  if (key == GLFW_KEY_EQUAL || key == GLFW_KEY_KP_ADD) return 1;
  if (key == GLFW_KEY_MINUS || key == GLFW_KEY_KP_SUBTRACT) return -1;
  if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9) return 0;  // of views, whatever stands on them
  const char* const name = glfwGetKeyName(key, scancode);
  const std::string_view label = name ? name : "";
  return label == "+" ? 1 : label == "-" ? -1 : 0;
}

Input& input_of(GLFWwindow* window) { return *static_cast<Input*>(glfwGetWindowUserPointer(window)); }

}  // namespace

Input::Input(GLFWwindow* window, Visit& visit, Panel& panel, Planning& planning, Hearing& hearing)
    : window_(window), visit_(visit), panel_(panel), planning_(planning), hearing_(hearing) {
  static_assert(std::tuple_size_v<decltype(controller_buttons_)> == GLFW_GAMEPAD_BUTTON_LAST + 1);
  glfwSetWindowUserPointer(window, this);
  glfwSetKeyCallback(window, [](GLFWwindow* in, int key, int scancode, int action, int modifiers) {
    input_of(in).on_key(key, scancode, action, modifiers);
  });
  glfwSetCharCallback(window,
                      [](GLFWwindow* in, unsigned character) { input_of(in).on_character(character); });
  glfwSetMouseButtonCallback(
      window, [](GLFWwindow* in, int button, int action, int) { input_of(in).on_button(button, action); });
  glfwSetCursorPosCallback(window, [](GLFWwindow* in, double x, double y) { input_of(in).on_cursor(x, y); });
  glfwSetScrollCallback(window, [](GLFWwindow* in, double, double steps) { input_of(in).on_wheel(steps); });
  glfwSetDropCallback(window, [](GLFWwindow* in, int count, const char** files) {
    for (int i = 0; i < count; ++i) input_of(in).planning_.take_file(files[i]);
  });
}

Input::~Input() {
  glfwSetKeyCallback(window_, nullptr);
  glfwSetCharCallback(window_, nullptr);
  glfwSetMouseButtonCallback(window_, nullptr);
  glfwSetCursorPosCallback(window_, nullptr);
  glfwSetScrollCallback(window_, nullptr);
  glfwSetDropCallback(window_, nullptr);
}

/// False where nothing in the scene waits for the key.
bool Input::tell_scene(const std::string& key, int action) {
  if (!visit_.actions().uses_key(key)) return false;
  if (action == GLFW_PRESS) visit_.actions().press(key);
  if (action == GLFW_RELEASE) visit_.actions().release(key);
  if (planning_.study && action != GLFW_REPEAT)
    planning_.study->note(action == GLFW_PRESS ? "press" : "release", key);
  return true;
}

void Input::on_key(int place, int scancode, int action, int modifiers) {
  if (action == GLFW_PRESS && place >= 0) tapped_.push_back(place);
  const int key = by_label(place, scancode, modifiers);
  const bool saves = key == GLFW_KEY_S && (modifiers & GLFW_MOD_CONTROL) != 0;
  if ((ImGui::GetIO().WantTextInput || planning_.awaits_command_keys) && action == GLFW_PRESS && !saves)
    return;
  if (const auto moves = std::ranges::find(movement, key); moves != movement.end() && action == GLFW_PRESS)
    was_pressed_[std::size_t(moves - movement.begin())] = true;
  if (tell_scene(key_name(key), action) || action == GLFW_RELEASE) return;
  if (const int step = text_size_step(key, scancode); step != 0 && (modifiers & GLFW_MOD_CONTROL) != 0)
    return panel_.step_text_size(step);
  if (action == GLFW_REPEAT && !repeats(key)) return;
  if (planning_.study && is_kept_from_participants(key)) return;
  if (press_planning(key, modifiers) || action != GLFW_PRESS) return;
  if (planning_.study && key == GLFW_KEY_ESCAPE) return;
  press(key);
}

void Input::on_character(unsigned character) {
  if (ImGui::GetIO().WantTextInput || !planning_.is_on()) return;
  if (character < 128) planning_.tool()->type(char(character));
}

bool Input::is_held(int key) const { return glfwGetKey(window_, key) == GLFW_PRESS; }

/// Where the cursor stands in the picture; none: beside it, or over a bar.
std::optional<planner::Pointer> Input::pointer() const {
  glm::ivec2 points(0), pixels(0);
  glfwGetWindowSize(window_, &points.x, &points.y);
  glfwGetFramebufferSize(window_, &pixels.x, &pixels.y);
  const glm::dvec2 pixels_per_point = glm::dvec2(pixels) / glm::dvec2(glm::max(points, 1));
  planner::Pointer pointer;
  pointer.camera = visit_.camera();
  pointer.size = {std::max(pixels.x - int(double(panel_.width()) * pixels_per_point.x), 1),
                  std::max(pixels.y, 1)};
  pointer.pixel = cursor_ * pixels_per_point;
  pointer.adds = is_held(GLFW_KEY_LEFT_SHIFT) || is_held(GLFW_KEY_RIGHT_SHIFT);
  pointer.copies = is_held(GLFW_KEY_LEFT_ALT);
  pointer.is_free = is_held(GLFW_KEY_LEFT_CONTROL) || is_held(GLFW_KEY_RIGHT_CONTROL);
  const bool is_inside = pointer.pixel.x >= 0.0 && pointer.pixel.y >= 0.0 &&
                         pointer.pixel.x < pointer.size.x && pointer.pixel.y < pointer.size.y;
  const bool is_dragging = planning_.is_on() && planning_.tool()->is_dragging();
  // Side by side one looks and walks; a pointer would be in two pictures.
  if (planning_.compares_pictures() && planning_.compared_view() == ComparedView::side_by_side)
    return std::nullopt;
  if (!is_dragging && (!is_inside || belongs_to_widgets(cursor_))) return std::nullopt;
  return pointer;
}

/// The place as a fraction of the picture's width, which the panel leaves.
float Input::share_of_picture(double x) const {
  int width = 0, height = 0;
  glfwGetWindowSize(window_, &width, &height);
  return float(x / std::max(double(width) - double(panel_.width()), 1.0));
}

bool Input::press_with_control(int key, bool has_shift) {
  switch (key) {
    case GLFW_KEY_Z:
      has_shift ? planning_.redo() : planning_.undo();
      return true;
    case GLFW_KEY_Y:
      planning_.redo();
      return true;
    case GLFW_KEY_S:
      planning_.save();
      return true;
    case GLFW_KEY_A:
      return planning_.run("select all");
    case GLFW_KEY_D:
      return planning_.run("duplicate selected by 1,0");
    case GLFW_KEY_G:
      return planning_.group_selected();
    case GLFW_KEY_L:
      return planning_.run("lock selected");
    case GLFW_KEY_K:
      planning_.shows_commands = planning_.awaits_command_keys = true;
      return true;
    default:
      break;
  }
  if (key >= GLFW_KEY_1 && key <= GLFW_KEY_9) {
    planning_.keep_view(key - GLFW_KEY_0);
    return true;
  }
  return false;
}

/// Keys of the planner's tool; false: the key is another's.
bool Input::press_planning(int key, int modifiers) {
  if (key == GLFW_KEY_F3) {
    planning_.turn_on(!planning_.is_on());
    return true;
  }
  if (key == GLFW_KEY_K && modifiers == 0) {
    if (!planning_.is_on()) {
      planning_.turn_on(true);
      planning_.shows_catalogue = planning_.is_on();
    } else {
      planning_.shows_catalogue = !planning_.shows_catalogue;
    }
    return true;
  }
  if (!planning_.is_on()) return false;
  if ((modifiers & GLFW_MOD_CONTROL) != 0 && press_with_control(key, (modifiers & GLFW_MOD_SHIFT) != 0))
    return true;
  planner::Tool& tool = *planning_.tool();
  const bool has_selection = !planning_.session()->selected().empty();
  const double step_m = (modifiers & GLFW_MOD_CONTROL) != 0 ? 1.0
                        : (modifiers & GLFW_MOD_SHIFT) != 0 ? 0.1
                                                            : 0.01;
  const auto nudge = [&](double right, double ahead) {
    planning_.tell(tool.nudge(visit_.camera(), step_m * right, step_m * ahead));
    return true;
  };
  const bool turns = tool.mode() == planner::Mode::insert;
  switch (key) {
    case GLFW_KEY_V:
      tool.choose(planner::Mode::select);
      return true;
    case GLFW_KEY_U:
      tool.choose(planner::Mode::surface);
      return true;
    case GLFW_KEY_C:
      (modifiers & GLFW_MOD_SHIFT) != 0 ? planning_.next_compared_view() : planning_.compare_with_next();
      return true;
    case GLFW_KEY_M:
      tool.choose_measure();
      return true;
    case GLFW_KEY_4:
    case GLFW_KEY_5:
    case GLFW_KEY_6:
      if (!tool.typed().empty() || tool.action() != planner::Action::none) return true;  // a number is typed
      planning_.look(PlanningView(key - GLFW_KEY_4));
      return true;
    case GLFW_KEY_1:
    case GLFW_KEY_2:
    case GLFW_KEY_3:
      return tool.action() != planner::Action::none;
    case GLFW_KEY_Q:
    case GLFW_KEY_E:
      if (turns) planning_.tell(tool.turn(key == GLFW_KEY_Q ? -15.0 : 15.0));
      return turns;
    case GLFW_KEY_G:
      return has_selection && planning_.tell(tool.begin(planner::Action::move));
    case GLFW_KEY_R:
      return has_selection && planning_.tell(tool.begin(planner::Action::turn));
    case GLFW_KEY_Z:
      return has_selection && planning_.tell(tool.begin(planner::Action::resize));
    case GLFW_KEY_F:
      planning_.frame_selection();
      return true;
    case GLFW_KEY_DELETE:
      return planning_.run("delete selected");
    case GLFW_KEY_ENTER:
    case GLFW_KEY_KP_ENTER:
      planning_.tell(tool.confirm());
      return true;
    case GLFW_KEY_BACKSPACE:
      return tool.type('\b');
    case GLFW_KEY_LEFT:
      return has_selection && nudge(-1, 0);
    case GLFW_KEY_RIGHT:
      return has_selection && nudge(1, 0);
    case GLFW_KEY_UP:
      return has_selection && nudge(0, 1);
    case GLFW_KEY_DOWN:
      return has_selection && nudge(0, -1);
    case GLFW_KEY_ESCAPE:
      if (std::exchange(planning_.shows_commands, false) || tool.cancel()) return true;
      return std::exchange(planning_.shows_catalogue, false);
    default:
      break;
  }
  if (key < GLFW_KEY_KP_1 || key > GLFW_KEY_KP_9) return false;
  planning_.go_to_view(key - GLFW_KEY_KP_0);
  return true;
}

bool press_visit_key(Visit& visit, int key) {
  switch (key) {
    case GLFW_KEY_1:
      visit.set_mode(Mode::walk);
      return true;
    case GLFW_KEY_2:
      visit.set_mode(Mode::fly);
      return true;
    case GLFW_KEY_3:
      visit.follow_next_vehicle();
      return true;
    case GLFW_KEY_TAB:
      visit.show_next_scenario();
      return true;
    case GLFW_KEY_SPACE:
      visit.halt(!visit.is_halted());
      return true;
    case GLFW_KEY_N:
      visit.step_halted();
      return true;
    case GLFW_KEY_PAGE_UP:
    case GLFW_KEY_PAGE_DOWN:
      visit.step_realism(key == GLFW_KEY_PAGE_UP ? 1 : -1);
      return true;
    default:
      return false;
  }
}

/// While one plans, Esc ends what is under way: a second one within a few seconds closes the window.
void Input::close_when_asked_twice() {
  constexpr double twice_s = 4.0;
  const double now = glfwGetTime();
  if (planning_.is_on() && now - std::exchange(asked_to_close_s_, now) > twice_s)
    return visit_.notice("Esc once more closes the window; what was done is kept");
  glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

void Input::press(int key) {
  if (press_visit_key(visit_, key)) return;
  switch (key) {
    case GLFW_KEY_ESCAPE:
      if (!std::exchange(panel_.shows_keys, false)) close_when_asked_twice();
      break;
    case GLFW_KEY_F1:
      panel_.shows_keys = !panel_.shows_keys;
      break;
    case GLFW_KEY_F2:
      panel_.is_open = !panel_.is_open;
      break;
    case GLFW_KEY_P:
      visit_.take_picture();
      break;
    case GLFW_KEY_M:
      hearing_.mute(!hearing_.is_muted());
      if (hearing_.is_on()) visit_.notice(hearing_.is_muted() ? "The sound is muted" : "The sound is heard");
      break;
    default:
      break;
  }
}

void Input::on_button(int button, int action) {
  if (belongs_to_widgets(cursor_) && action == GLFW_PRESS) return;
  if (tell_scene(mouse_button_name(button), action)) return;
  const bool is_plan = visit_.mode() == Mode::plan;
  if (button == GLFW_MOUSE_BUTTON_MIDDLE || (button == GLFW_MOUSE_BUTTON_RIGHT && is_plan))
    is_panning_ = action == GLFW_PRESS && is_plan;
  if (button != GLFW_MOUSE_BUTTON_LEFT) return;
  if (action == GLFW_RELEASE && std::exchange(is_sliding_, false)) return;
  constexpr float reach = 0.012f;  // of the line between two designs, a share of the picture
  is_sliding_ = action == GLFW_PRESS && planning_.compares_pictures() &&
                planning_.compared_view() == ComparedView::slider &&
                std::abs(share_of_picture(cursor_.x) - planning_.split()) < reach;
  if (is_sliding_) return;
  if (planning_.is_on()) {
    const std::optional<planner::Pointer> at = pointer();
    planner::Tool& tool = *planning_.tool();
    if (action == GLFW_PRESS && at && planning_.waits_for_balcony()) {
      if (!planning_.stand_at(*at))
        visit_.notice_error(planning_.word("Click a window or a balcony to stand there."));
      return;
    }
    if (action == GLFW_PRESS && at && tool.press(*at)) {
      if (!planning_.session()->selected().empty()) panel_.turn_to_design();
      return;
    }
    if (action == GLFW_RELEASE && tool.is_dragging()) {
      if (at) planning_.tell(tool.release(*at));
      return;
    }
  }
  const bool was_dragging = std::exchange(is_dragging_, action == GLFW_PRESS);
  if (is_dragging_) {
    pressed_at_ = cursor_;
  } else if (was_dragging && glm::distance(cursor_, pressed_at_) < farthest_click) {
    if (planning_.is_on())
      planning_.session()->select({});
    else
      choose_what_is_below_the_cursor();
  }
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
  has_moved_ = true;
  if (is_sliding_) return planning_.set_split(share_of_picture(x));
  int width = 0, height = 1;
  glfwGetWindowSize(window_, &width, &height);
  if (is_panning_ || (is_dragging_ && visit_.mode() == Mode::plan))
    controls_.pan += glm::vec2(moved.x, -moved.y) / float(std::max(height, 1));
  else if (is_dragging_)
    controls_.turn -= radians_per_pixel * glm::vec2(moved);
}

void Input::on_wheel(double steps) {
  if (belongs_to_widgets(cursor_)) return;
  const bool turns =
      planning_.is_on() && is_held(GLFW_KEY_LEFT_ALT) && planning_.tool()->mode() == planner::Mode::insert;
  if (turns) return static_cast<void>(planning_.tell(planning_.tool()->turn(5.0 * steps)));
  controls_.zoom += float(steps);
  if (const std::optional<planner::Pointer> at = pointer())
    controls_.zoom_at =
        glm::vec2((at->pixel - 0.5 * glm::dvec2(at->size)) * glm::dvec2(1.0, -1.0) / double(at->size.y));
}

void Input::poll_controller() {
  GLFWgamepadstate state{};
  if (glfwGetGamepadState(GLFW_JOYSTICK_1, &state) != GLFW_TRUE) return;
  for (std::size_t i = 0; i < controller_buttons_.size(); ++i)
    if (const unsigned char is_down = state.buttons[i];
        std::exchange(controller_buttons_[i], is_down) != is_down)
      tell_scene(controller_button_name(int(i)), is_down ? GLFW_PRESS : GLFW_RELEASE);
}

/// Dear ImGui of this version knows of keys alone that are down as its frame begins: one that was pressed and
/// released while a frame was drawn is down for it until the next poll.
void Input::poll_events() {
  bool* const keys_down = ImGui::GetIO().KeysDown;
  for (const int key : told_) keys_down[key] = glfwGetKey(window_, key) == GLFW_PRESS;
  glfwPollEvents();
  told_ = std::exchange(tapped_, {});  // those too that came while the window waited at rest
  for (const int key : told_) keys_down[key] = true;
}

Controls Input::poll(double seconds) {
  poll_events();
  poll_controller();
  const bool has_moved = std::exchange(has_moved_, false);
  planning_.step(float(seconds), has_moved);
  if (planning_.is_on() && has_moved) {
    if (const std::optional<planner::Pointer> at = pointer())
      planning_.tool()->point(*at);
    else
      planning_.tool()->leave();
  }
  Controls controls = std::exchange(controls_, {});
  const std::array pressed = std::exchange(was_pressed_, {});
  const auto held = [&](std::size_t of) {
    const int key = movement[of];
    const bool is_for_scene = visit_.actions().uses_key(key_name(key));
    const bool turns = planning_.is_on() && planning_.tool()->mode() == planner::Mode::insert &&
                       (key == GLFW_KEY_Q || key == GLFW_KEY_E);
    const bool has_control = is_held(GLFW_KEY_LEFT_CONTROL) || is_held(GLFW_KEY_RIGHT_CONTROL);
    const bool counts = !is_for_scene && !turns && !has_control && !ImGui::GetIO().WantTextInput;
    if (counts && glfwGetKey(window_, key) == GLFW_PRESS) return 1.0f;
    return counts && pressed[of] ? float(std::min(tap_s / std::max(seconds, tap_s), 1.0)) : 0.0f;
  };
  controls.move = {held(0) - held(1), held(2) - held(3), held(4) - held(5)};
  controls.hurries = glfwGetKey(window_, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS;
  return controls;
}

}  // namespace parvis::viewer
