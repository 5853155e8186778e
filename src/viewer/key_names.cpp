#include "viewer/key_names.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace parvis::viewer {

std::string key_name(int key) {
  constexpr std::array<std::pair<int, const char*>, 16> named{{{GLFW_KEY_SPACE, "space"},
                                                               {GLFW_KEY_ENTER, "enter"},
                                                               {GLFW_KEY_TAB, "tab"},
                                                               {GLFW_KEY_BACKSPACE, "backspace"},
                                                               {GLFW_KEY_DELETE, "delete"},
                                                               {GLFW_KEY_INSERT, "insert"},
                                                               {GLFW_KEY_HOME, "home"},
                                                               {GLFW_KEY_END, "end"},
                                                               {GLFW_KEY_UP, "up"},
                                                               {GLFW_KEY_DOWN, "down"},
                                                               {GLFW_KEY_LEFT, "left"},
                                                               {GLFW_KEY_RIGHT, "right"},
                                                               {GLFW_KEY_COMMA, "comma"},
                                                               {GLFW_KEY_PERIOD, "period"},
                                                               {GLFW_KEY_PAGE_UP, "page_up"},
                                                               {GLFW_KEY_PAGE_DOWN, "page_down"}}};
  for (const auto& [code, name] : named)
    if (code == key) return name;
  if (key >= GLFW_KEY_A && key <= GLFW_KEY_Z) return std::string(1, char('a' + key - GLFW_KEY_A));
  if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9) return std::string(1, char('0' + key - GLFW_KEY_0));
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) return fmt::format("f{}", 1 + key - GLFW_KEY_F1);
  return "";
}

std::string mouse_button_name(int button) { return fmt::format("mouse{}", button + 1); }
std::string controller_button_name(int button) { return fmt::format("button{}", button + 1); }

}  // namespace parvis::viewer
