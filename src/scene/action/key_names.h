// The names of keys and buttons in scenes.
#pragma once

#include <string>
#include <vector>

namespace parvis::action {

/// The names that `keys` accepts: letters, digits, named keys, mouse1.. and button1.. of a game controller.
const std::vector<std::string>& key_names();

}  // namespace parvis::action
