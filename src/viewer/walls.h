// A scene on the walls of a room: a window for each wall, in one process or in several that mpirun has
// started, all at the same moment.
#pragma once

#include "graphics/display/display.h"
#include "machines/processes.h"
#include "planning/devices/devices.h"
#include "stage/stage.h"

namespace parvis::viewer {

struct WallsOptions {
  display::Display display;
  glm::dvec3 eye{0.0};                ///< in the room, where nothing tracks it
  std::string title;                  ///< of the scene
  std::string camera;                 ///< where the visit begins; empty: the scene's first
  int max_frames = 0;                 ///< ends after so many; 0: when somebody ends it
  bool plans = false;                 ///< begins with the planner's tool in hand
  std::string sound = "default";      ///< of the first process
  std::filesystem::path frame_log;    ///< when each frame was shown, a file for each process; empty: nowhere
  std::filesystem::path screenshots;  ///< folder of what the walls show last; empty: nowhere
  std::filesystem::path kept_pictures;  ///< of the catalogue; empty: they are not kept
  devices::DeviceSettings devices;
  std::filesystem::path recording, replayed;  ///< of devices; empty: none
  machines::Processes processes;
};

/// Shows it until a window is closed or Esc is pressed in any of them. Of several processes each shows its
/// share of the walls; where there is one more than walls, the first shows the view of who operates the room.
/// Fails where a window cannot be opened.
Status show_walls(stage::Simulation simulation, const WallsOptions& options);

}  // namespace parvis::viewer
