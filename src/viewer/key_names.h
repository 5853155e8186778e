// What scripts call the keys and buttons of GLFW: the names of action::key_names.
#pragma once

#include <string>

namespace parvis::viewer {

/// Empty for a key that scripts cannot name.
std::string key_name(int glfw_key);
/// "mouse1" for the left button.
std::string mouse_button_name(int glfw_button);
/// "button1" for the first of a game controller.
std::string controller_button_name(int glfw_button);

}  // namespace parvis::viewer
