// The window in which one walks, flies and follows a vehicle, with the panel beside the picture.
#pragma once

#include <optional>
#include <string>

#include "house/stage/stage.h"
#include "viewer/visit.h"

namespace parvis::viewer {

struct WindowOptions {
  int width = 1280, height = 720;
  std::string title;       ///< of the scene
  std::string camera;      ///< where the visit begins; empty: the scene's first
  bool has_panel = false;  ///< at first; F2 opens and closes it
  PicturePlace pictures;   ///< where those go that the visitor takes
  int max_frames = 0;      ///< closes after so many; 0: when the visitor does (tests and screenshots)
  /// The rate that is held by drawing fewer pixels; 0: none is. Unset: 10 on a software renderer and 60 on a
  /// GPU, none where `max_frames` asks for pictures that can be repeated.
  std::optional<double> frames_per_second;
  std::string screenshot;  ///< what the window shows last, panel and all, is written here; empty: nowhere
};

/// Opens the window, makes a stage of the play and shows it until the window is closed. Fails where there is
/// no display or no OpenGL 4.5.
Status show(house::Play play, const WindowOptions& options);

}  // namespace parvis::viewer
