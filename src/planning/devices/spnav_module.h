// The module `spnav`: what of this room knows libspnav, which asks spacenavd for 3D mice.
#pragma once

#include <vector>

#include "base/module.h"
#include "life/sound/liblo_module.h"

namespace parvis::devices {

/// The functions of the module.
struct SpnavFunctions {
  /// Connects to spacenavd. Errors: it does not run.
  Status (*begin)();
  /// Messages of what 3D mice have done since the last call.
  Result<std::vector<sound::OscMessage>> (*poll)();
};

/// Loaded when devices are first asked for 3D mice.
inline constexpr Module<SpnavFunctions> spnav("spnav");

/// The message of a motion as spacenavd gives it: x right, y up, z ahead, turns about them, 350 at most.
inline sound::OscMessage motion_message(const std::array<int, 6>& axes) {
  constexpr double full = 350.0;
  const auto share = [&](std::size_t axis) { return double(axes[axis]) / full; };
  // Twisting to the left is positive about y, tilting back about x.
  return {"/parvis/motion",
          {0.0, share(0), share(2), share(1), share(4), share(3)},
          {"mouse3d", "", "", "", "", ""}};
}

}  // namespace parvis::devices
