// A scene as a folder of web pages: what everybody can open in a browser, from a server or by a double click,
// without Parvis.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "stage/stage.h"

namespace parvis::share {

/// Inputs and options of a site.
struct SiteOptions {
  std::filesystem::path folder;    ///< absent or empty
  std::string title;               ///< empty: the scene's name
  std::filesystem::path notes;     ///< of the authors: see `read_notes`; empty: none
  std::vector<std::string> views;  ///< names of cameras; empty: all of the scene
  std::string link;                ///< the address under which it will stand; empty: not known
  int max_texture_px = 2048;       ///< longest side
};

/// Contents of the site that was written, for a report.
struct WrittenSite {
  std::size_t states = 0, views = 0, objects = 0, bytes = 0;
  /// Each kind of thing that a browser does not show as the program does, and what is shown instead.
  std::vector<std::string> instead;
};

/// Writes the site. Needs a current OpenGL context; draws every view in every scenario, for browsers without
/// WebGL 2. Afterwards the scene is in its base state. Errors: a folder that is not empty, cameras that are
/// none, notes that cannot be read, a part of the program that is missing, a full disk. Nothing is left
/// behind then.
Result<WrittenSite> write_site(stage::Stage& stage, const SiteOptions& options);

}  // namespace parvis::share
