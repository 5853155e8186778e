#include "planning/devices/sdl_module.h"

#include <SDL2/SDL.h>

#include <map>

namespace parvis::devices {
namespace {

/// An open gamepad or joystick.
struct Pad {
  std::string name;
  SDL_Joystick* joystick = nullptr;
  SDL_GameController* controller = nullptr;  ///< null: a joystick whose buttons have no agreed places
  SDL_Haptic* haptic = nullptr;              ///< null: no force feedback
  glm::dvec2 stick{0.0};
};

std::map<SDL_JoystickID, Pad>& pads() {
  static std::map<SDL_JoystickID, Pad> all;
  return all;
}

Status begin() {
  if (SDL_WasInit(SDL_INIT_JOYSTICK)) return Ok{};
  SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
  SDL_SetHint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");  // SDL has no window
  if (SDL_Init(SDL_INIT_JOYSTICK | SDL_INIT_GAMECONTROLLER | SDL_INIT_HAPTIC) != 0)
    return error("gamepads cannot be read: {}", SDL_GetError());
  return Ok{};
}

void open(int device) {
  Pad pad;
  if (SDL_IsGameController(device)) {
    pad.controller = SDL_GameControllerOpen(device);
    pad.joystick = SDL_GameControllerGetJoystick(pad.controller);
  } else {
    pad.joystick = SDL_JoystickOpen(device);
  }
  if (!pad.joystick) return;
  if (SDL_JoystickIsHaptic(pad.joystick) == 1) pad.haptic = SDL_HapticOpenFromJoystick(pad.joystick);
  int number = 1;  // the first that is free
  const auto is_taken = [&](const std::string& name) {
    return std::ranges::any_of(pads(), [&](const auto& it) { return it.second.name == name; });
  };
  while (is_taken(fmt::format("gamepad{}", number))) ++number;
  pad.name = fmt::format("gamepad{}", number);
  pads().try_emplace(SDL_JoystickInstanceID(pad.joystick), pad);
}

void close(SDL_JoystickID id) {
  const auto found = pads().find(id);
  if (found == pads().end()) return;
  if (found->second.haptic) SDL_HapticClose(found->second.haptic);
  found->second.controller ? SDL_GameControllerClose(found->second.controller)
                           : SDL_JoystickClose(found->second.joystick);
  pads().erase(found);
}

Result<std::vector<sound::OscMessage>> poll() {
  std::vector<sound::OscMessage> messages;
  SDL_Event event;
  const auto button = [&](SDL_JoystickID id, int number, int state) {
    if (const auto found = pads().find(id); found != pads().end())
      messages.push_back(
          {"/parvis/button", {0.0, number + 1.0, double(state)}, {found->second.name, "", ""}});
  };
  const auto is_controller = [&](SDL_JoystickID id) {
    const auto found = pads().find(id);
    return found != pads().end() && found->second.controller;
  };
  while (SDL_PollEvent(&event)) {
    if (event.type == SDL_JOYDEVICEADDED) open(event.jdevice.which);
    if (event.type == SDL_JOYDEVICEREMOVED) close(event.jdevice.which);
    if (event.type == SDL_CONTROLLERBUTTONDOWN || event.type == SDL_CONTROLLERBUTTONUP)
      button(event.cbutton.which, event.cbutton.button, event.cbutton.state);
    // Of a gamepad SDL reports each button twice, once by its agreed place.
    if ((event.type == SDL_JOYBUTTONDOWN || event.type == SDL_JOYBUTTONUP) &&
        !is_controller(event.jbutton.which))
      button(event.jbutton.which, event.jbutton.button, event.jbutton.state);
  }
  constexpr double full = 32'767.0, dead = 0.15;
  for (auto& [id, pad] : pads()) {
    const auto axis = [&](int number) {
      const double value = double(SDL_JoystickGetAxis(pad.joystick, number)) / full;
      return std::abs(value) < dead ? 0.0 : value;
    };
    if (const glm::dvec2 stick(axis(0), -axis(1)); stick != pad.stick) {
      pad.stick = stick;
      messages.push_back({"/parvis/stick", {0.0, stick.x, stick.y}, {pad.name, "", ""}});
    }
  }
  return messages;
}

Result<int> pulse(const Pulse& pulse) {
  constexpr float most = 65'535.0f, max_force = 32'767.0f;
  const auto milliseconds = Uint32(1e3f * pulse.seconds);
  int felt = 0;
  for (auto& [id, pad] : pads()) {
    const bool rumbles = SDL_JoystickRumble(pad.joystick, Uint16(most * pulse.low), Uint16(most * pulse.high),
                                            milliseconds) == 0;
    bool pushes = false;
    if (pad.haptic && pulse.force > 0.0f && (SDL_HapticQuery(pad.haptic) & SDL_HAPTIC_CONSTANT) != 0) {
      SDL_HapticEffect effect{};
      effect.type = SDL_HAPTIC_CONSTANT;
      effect.constant.direction.type = SDL_HAPTIC_CARTESIAN;
      effect.constant.direction.dir[1] = 1;  // towards the hand
      effect.constant.length = milliseconds;
      effect.constant.level = Sint16(max_force * pulse.force);
      if (const int made = SDL_HapticNewEffect(pad.haptic, &effect); made >= 0)
        pushes = SDL_HapticRunEffect(pad.haptic, made, 1) == 0;
    }
    felt += rumbles || pushes;
  }
  return felt;
}

}  // namespace
}  // namespace parvis::devices

PARVIS_MODULE(parvis::devices::SdlFunctions){parvis::devices::begin, parvis::devices::poll,
                                             parvis::devices::pulse};
