#include "planning/devices/spnav_module.h"

#include <spnav.h>

namespace parvis::devices {
namespace {

Result<Ok> begin_mice() {  // Status is a macro of X11
  static const bool is_open = spnav_open() == 0;
  if (!is_open) return error("3D mice cannot be read: spacenavd does not run");
  return Ok{};
}

Result<std::vector<sound::OscMessage>> poll_mice() {
  std::vector<sound::OscMessage> messages;
  spnav_event event;
  while (spnav_poll_event(&event) != 0) {
    if (event.type == SPNAV_EVENT_MOTION) {
      const spnav_event_motion& motion = event.motion;
      messages.push_back(motion_message({motion.x, motion.y, motion.z, motion.rx, motion.ry, motion.rz}));
    }
    if (event.type == SPNAV_EVENT_BUTTON)
      messages.push_back({"/parvis/button",
                          {0.0, event.button.bnum + 1.0, double(event.button.press)},
                          {"mouse3d", "", ""}});
  }
  return messages;
}

}  // namespace
}  // namespace parvis::devices

PARVIS_MODULE(parvis::devices::SpnavFunctions){parvis::devices::begin_mice, parvis::devices::poll_mice};
