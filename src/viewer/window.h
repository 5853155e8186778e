// The window in which one walks, flies and follows a vehicle.
#pragma once

#include <string>

#include "stage/stage.h"

namespace parvis::viewer {

struct WindowOptions {
  int width = 1280, height = 720;
  std::string camera;      ///< where the visit begins; empty: the scene's first
  int most_frames = 0;     ///< closes after so many; 0: when the visitor does (tests and screenshots)
  std::string screenshot;  ///< written when the window closes; empty: none
};

/// Opens the window, makes a stage of the play and shows it until the window is closed. Fails where there is
/// no display or no OpenGL 4.5.
Status show(stage::Play play, const WindowOptions& options);

}  // namespace parvis::viewer
