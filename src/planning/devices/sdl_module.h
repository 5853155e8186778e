// The module `sdl`: what of this room knows SDL 2, for gamepads and joysticks with their rumble and force.
#pragma once

#include <vector>

#include "base/module.h"
#include "life/sound/liblo_module.h"

namespace parvis::devices {

/// A pulse that a hand feels.
struct Pulse {
  float low = 0.0f, high = 0.0f;  ///< rumble of the slow and of the fast motor, 0 to 1
  float force = 0.0f;             ///< of force feedback, 0 to 1 of the device's greatest
  float seconds = 0.1f;
};

/// The functions of the module.
struct SdlFunctions {
  /// Begins to look for gamepads; may be called again. Errors: SDL's.
  Status (*begin)();
  /// Messages of what gamepads have done since the last call, as messages of gamepad1, gamepad2 and so on;
  /// those that are plugged in meanwhile are taken up.
  Result<std::vector<sound::OscMessage>> (*poll)();
  /// Lets all gamepads feel a pulse. Returns how many have a motor.
  Result<int> (*pulse)(const Pulse& pulse);
};

/// Loaded when devices are first asked for gamepads.
inline constexpr Module<SdlFunctions> sdl("sdl");

}  // namespace parvis::devices
