// The sheet that goes to the council: pictures, plan, table and sun of one design against another.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "planning/design/session.h"
#include "stage/stage.h"

namespace parvis {

/// Inputs and options of the sheet.
struct CouncilOptions {
  std::filesystem::path file;
  std::string before;              ///< the design that is compared with
  std::string title, subtitle;     ///< of the pages
  std::string link;                ///< an address, drawn as a QR code; empty: none
  std::vector<std::string> views;  ///< names of cameras; empty: all of the scene
  std::optional<double> scale;     ///< of the plan, 1 : scale; none: the largest usual one that fits
  std::string day = "2026-03-21";  ///< of the hours of sun
  design::Language language = design::Language::english;
};

/// Draws the scene with either design and writes the sheet. Needs a current OpenGL context; afterwards the
/// session's design is shown, and the other is not. Errors: designs, cameras and dates that are none, two
/// designs that are the same, and those of write_council_sheet.
Status write_council(stage::Stage& stage, const design::Session& session, const CouncilOptions& options);

}  // namespace parvis
