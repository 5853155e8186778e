// What devices say, whatever they are: places of trackers, buttons, sticks, fingers, by the name of the
// device. Everything comes as an OSC message, from the network, a file, a gamepad or a 3D mouse:
//
// /parvis/tracker NAME X Y Z [QX QY QZ QW]: a place in the room (metres, x right, y ahead, z up) and a turn
// from looking ahead. /parvis/button NAME NUMBER 0|1, from 1. /parvis/stick NAME RIGHT AHEAD, -1 to 1.
// /parvis/motion NAME RIGHT AHEAD UP TURN_LEFT TURN_UP, -1 to 1: a 3D mouse. /tuio/2Dcur: fingers (TUIO 1.1).
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "life/sound/liblo_module.h"

namespace parvis::devices {

/// A place in the room and a turn from looking ahead (y).
struct Pose {
  glm::dvec3 position{0.0};
  glm::dquat turn{1.0, 0.0, 0.0, 0.0};
};

/// A button that was pressed or let go.
struct ButtonEvent {
  std::string device;
  int number;
  bool is_pressed;
};

/// The state of all devices.
class InputState {
 public:
  static constexpr double stale_s = 0.5;   ///< after which a tracker that says nothing has stopped
  static constexpr double return_s = 0.5;  ///< in which a tracker that goes on is caught up with
  static constexpr std::size_t max_devices = 64;

  /// Takes a message that `sender` sent, at a time of the machine's clock. Errors say what is wrong with it;
  /// nothing is changed then.
  Status take(const sound::OscMessage& message, const std::string& sender, double now_s);

  /// Where a tracker is; nothing: it has never said. One that has stopped stays where it was, and returns
  /// smoothly when it sends again.
  std::optional<Pose> pose(const std::string& tracker, double now_s);
  /// Events of buttons since the last call.
  std::vector<ButtonEvent> take_buttons() { return std::exchange(buttons_, {}); }
  /// A stick: right and ahead; zero where there is none.
  glm::dvec2 stick(const std::string& device) const;
  /// All 3D mice together: right, ahead, up, turn left, turn up.
  std::array<double, 5> motion() const;
  /// Fingers on a table: 0 to 1 from the upper left, by number.
  const std::map<int, glm::dvec2>& fingers() const { return fingers_; }
  /// Notes for who shows the scene, once each: a tracker has stopped, or two have one name.
  std::vector<std::string> take_notes() { return std::exchange(notes_, {}); }

 private:
  struct Tracker {
    Pose said, shown;
    std::string sender;
    double said_s = 0.0;
    std::optional<double> returned_s;  ///< since when it is caught up with
    bool has_stopped = false, is_doubled = false;
  };
  Status take_tracker(const sound::OscMessage& message, const std::string& sender, double now_s);
  Status take_fingers(const sound::OscMessage& message);

  std::map<std::string, Tracker> trackers_;
  std::map<std::string, glm::dvec2> sticks_;
  std::map<std::string, std::array<double, 5>> motions_;
  std::map<int, glm::dvec2> fingers_;
  std::vector<ButtonEvent> buttons_;
  std::vector<std::string> notes_;
};

}  // namespace parvis::devices
