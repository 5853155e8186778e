// The module `cairo`: what of this room knows cairo.
#pragma once

#include <filesystem>

#include "base/module.h"
#include "planning/plan_drawing/council_sheet.h"
#include "planning/plan_drawing/plan_files.h"
#include "planning/plan_drawing/text_outlines.h"

namespace parvis::plan_drawing {

/// The functions of cairo that this room needs.
struct CairoFunctions {
  TextOutlines (*text_outlines)(const formats::DrawingText& text);
  /// Draws a sheet of this size, whose centre is given, as PDF.
  Status (*draw_sheet)(const std::filesystem::path& file, const ScenePlan& plan, const Sheet& sheet,
                       glm::dvec2 size_mm);
  /// Draws the sheet that compares two designs, as PDF.
  Status (*draw_council_sheet)(const std::filesystem::path& file, const CouncilSheet& sheet,
                               const SunPictures& sun);
};

/// Loaded where the first text of a drawing is shown, or a plan is written as PDF.
inline constexpr Module<CairoFunctions> cairo("cairo");

/// The module's own `draw_sheet`.
Status draw_sheet(const std::filesystem::path& file, const ScenePlan& plan, const Sheet& sheet,
                  glm::dvec2 size_mm);
/// The module's own `draw_council_sheet`.
Status draw_council_sheet(const std::filesystem::path& file, const CouncilSheet& sheet,
                          const SunPictures& sun);

}  // namespace parvis::plan_drawing
