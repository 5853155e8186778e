// The devices of a person who stands in front of a display: trackers, wand, gamepads, 3D mice, fingers.
#pragma once

#include <array>
#include <filesystem>
#include <fstream>
#include <memory>
#include <vector>

#include "life/sound/sound_server.h"
#include "planning/devices/haptic.h"
#include "planning/devices/input_state.h"
#include "planning/devices/sdl_module.h"

namespace parvis::devices {

/// The use of a button of the wand, as a file of devices writes it.
struct ButtonUse {
  enum class Kind : unsigned char {
    none,
    action,  ///< "action": a click of the rod
    menu,    ///< "menu": the panel comes and goes
    view,    ///< "view plan", "view street", "view balcony"
    key,     ///< "key space": a key of the scene
    command  ///< "do undo": a command of the design
  };
  Kind kind = Kind::none;
  std::string text;  ///< the view, the key or the command
};

/// A file of devices.
struct DeviceSettings {
  static constexpr std::size_t wand_buttons = 12;
  int osc_port = 7771;  ///< 0: none
  bool is_public = false;
  bool has_gamepads = true, has_3d_mice = true;
  std::string buttons_of = "gamepad1";  ///< the device that is the wand in the hand
  std::array<ButtonUse, wand_buttons> buttons{{{ButtonUse::Kind::action, ""},
                                               {ButtonUse::Kind::menu, ""},
                                               {ButtonUse::Kind::view, "plan"},
                                               {ButtonUse::Kind::view, "street"},
                                               {ButtonUse::Kind::view, "balcony"},
                                               {ButtonUse::Kind::command, "undo"}}};
};

/// Reads such a file: JSON, docs/devices.schema.json. Errors name the value that is wrong.
Result<DeviceSettings> read_devices(const std::string& text, const std::string& file);

/// Splits an OSC packet into its messages, those of bundles, too. Errors are left out of it and counted.
std::vector<sound::OscMessage> messages_of(std::string_view packet, Errors& errors);

/// Writes a message as a line of a recording, and reads one: "12.250 tracker@host /parvis/tracker head 0
/// 0 1.7".
struct RecordedMessage {
  double at_s = 0.0;
  std::string sender;
  sound::OscMessage message;

  std::string line() const;  ///< with its end
  /// Errors: the line is none.
  static Result<RecordedMessage> read(const std::string& line, const FileLocation& where);
};

/// All devices. What is wrong with one is a note; the others go on.
class Devices {
 public:
  /// Opens what the settings ask for. `recording`: everything that devices say is written there; empty:
  /// nowhere. `replayed`: such a file in place of the devices; empty: none. Errors: the port cannot be
  /// listened at, or a file cannot be used.
  static Result<Devices> open(const DeviceSettings& settings, const std::filesystem::path& recording = {},
                              const std::filesystem::path& replayed = {});
  Devices(Devices&&) = default;

  /// Takes in what has been said since the last call; `now_s` never goes back.
  void poll(double now_s);
  InputState& state() { return state_; }                          ///< after the last `poll`
  const DeviceSettings& settings() const { return settings_; }    ///< as given
  int osc_port() const { return socket_ ? socket_->port() : 0; }  ///< that is listened at; 0: none
  /// Lets a hand feel it; returns how many devices did.
  int pulse(const Pulse& pulse);
  /// Notes since the last call.
  std::vector<std::string> take_notes();

 private:
  Devices() = default;
  void take(const sound::OscMessage& message, const std::string& sender, double now_s);
  void note(std::string text);

  DeviceSettings settings_;
  InputState state_;
  std::optional<sound::Datagrams> socket_;
  bool has_sdl_ = false, has_spnav_ = false;
  std::unique_ptr<std::ofstream> recording_;
  std::vector<RecordedMessage> replayed_;
  std::size_t next_replayed_ = 0;
  std::optional<double> began_s_;
  std::vector<std::string> notes_;
  std::size_t refused_ = 0;
};

}  // namespace parvis::devices
