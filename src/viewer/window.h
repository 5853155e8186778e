// The window in which one walks, flies and follows a vehicle, with the panel beside the picture.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "planning/design/words.h"
#include "planning/devices/devices.h"
#include "planning/study/session.h"
#include "stage/stage.h"
#include "viewer/visit.h"

namespace parvis::viewer {

struct WindowOptions {
  int width = 1280, height = 720;
  std::string title;       ///< of the scene
  std::string camera;      ///< where the visit begins; empty: the scene's first
  bool has_panel = false;  ///< at first; F2 opens and closes it
  float text_size = 1.0f;  ///< over the usual, 1 to 3
  bool plans = false;      ///< begins with the planner's tool in hand
  design::Language language = design::Language::english;  ///< of the planner's tool
  std::filesystem::path kept_pictures;                    ///< of the catalogue; empty: they are not kept
  PicturePlace pictures;                                  ///< where those go that the visitor takes
  int max_frames = 0;  ///< closes after so many; 0: when the visitor does (tests and screenshots)
  std::optional<double> frames_per_second;  ///< to hold by drawing fewer pixels; 0: none; unset: `rate_of`
  bool always_holds_rate = false;           ///< the window's own rate is held where `max_frames` is set, too
  study::Session* study = nullptr;          ///< of a participant who works in the window; not owned
  /// The scene of the session's next part, when this one's are over; nothing where there is none.
  std::function<Result<std::optional<stage::Simulation>>()> next_scene = {};
  std::optional<devices::DeviceSettings> devices;  ///< gamepads and 3D mice; unset: as haptic nodes need them
  std::string sound = "default";                   ///< the device that sounds (sound/device.h); off: none
  std::string screenshot;  ///< what the window shows last, panel and all, is written here; empty: nowhere
};

/// Frames per second that a window holds, 0: none. By itself 15 on a software renderer and 60 on a GPU; none
/// where `max_frames` asks for pictures that can be repeated, unless `always_holds_rate`.
double rate_of(const WindowOptions& options, bool is_software);

/// Whether the first picture may be a cheaper one (methods::Pace): not where pictures can be repeated.
bool begins_at_once(const WindowOptions& options);

/// Opens the window, makes a stage of the simulation and shows it until the window is closed. Fails where
/// there is no display or no OpenGL 4.5.
Status show(stage::Simulation simulation, const WindowOptions& options);

}  // namespace parvis::viewer
