// The kitchen as a script: light, models, cameras.
#pragma once

#include <span>
#include <string>

#include "city/kitchen_mirrors.h"

namespace parvis::city {

std::string kitchen_script(std::span<const KitchenMirror> mirrors);

}  // namespace parvis::city
