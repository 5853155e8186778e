// The kitchen as a script: light, models, cameras.
#pragma once

#include <span>
#include <string>

#include "places/kitchen/kitchen_mirrors.h"

namespace parvis::kitchen {

std::string kitchen_script(std::span<const KitchenMirror> mirrors);

/// The same kitchen with bodies of glass on its worktop; the mirrors mirror the sky alone, and what lies in
/// the way is put away.
std::string kitchen_glass_script(std::span<const KitchenMirror> mirrors,
                                 std::span<const KitchenMirror> glass);

}  // namespace parvis::kitchen
