// The sheet that goes to the council: what one design changes against another, as a PDF of A3 pages.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "planning/design/difference.h"
#include "planning/design/words.h"
#include "planning/plan_drawing/qr_code.h"
#include "planning/plan_drawing/scene_plan.h"
#include "planning/plan_drawing/sun_difference.h"

namespace parvis::plan_drawing {

/// Size of the sheet's plan, millimetres.
inline constexpr glm::dvec2 council_plan_mm(285.0, 238.0);

/// A picture of a page.
struct SheetPicture {
  Image8 image;
  std::string jpeg;  ///< the same, encoded
};

/// One of the scene's views with either design.
struct ViewPair {
  std::string name;  ///< of the camera
  SheetPicture before, after;
};

/// Objects that differ in the same way, a row of the table.
struct DifferenceRow {
  design::Differs how = design::Differs::added;
  std::string label;  ///< of the kind
  int count = 0;
  std::string detail;  ///< size, or how far they moved
};

/// The rows of a table of differences: removed, added, moved, changed; by label in each.
std::vector<DifferenceRow> difference_rows(const std::vector<design::Difference>& differences,
                                           const design::Words& words = {});

/// Hours of sun, ready to be drawn.
struct SunPictures {
  Image8 before, after, change;      ///< a pixel for each cell, north up; white where there is no ground
  Image8 hours_scale, change_scale;  ///< a row of pixels: 0 to `max_hours`; -`max_change` to `max_change`
  double max_hours = 0.0, max_change_h = 0.0;
  std::vector<std::vector<std::string>> figures;  ///< a table: what, before, after, change
};
/// All pictures from the hours.
SunPictures sun_pictures(const SunDifference& sun, const design::Words& words = {});

/// All that the sheet shows.
struct CouncilSheet {
  std::string title, subtitle;  ///< UTF-8
  std::string before, after;    ///< names of the two designs
  std::vector<ViewPair> views;
  ScenePlan plan;  ///< the place; its placed objects are those that stay
  std::vector<design::Difference> differences;
  std::vector<DifferenceRow> rows;
  double scale = 200.0;    ///< of the plan, 1 : scale
  glm::dvec2 centre{0.0};  ///< of the plan, in the scene's frame
  std::optional<SunDifference> sun;
  std::string sun_day;         ///< "21 March 2026"
  std::optional<QrCode> link;  ///< the address at which the designs can be seen, beside the plan
  design::Words words;         ///< of all that the pages say
};

/// The middle and half the extent of what differs, in plan. Errors: nothing does.
Result<std::pair<glm::dvec2, glm::dvec2>> extent_of(const std::vector<design::Difference>& differences);

/// The largest usual scale at which so much fits into the plan of the sheet.
double fitting_scale(glm::dvec2 half_extent_m);

/// Writes the sheet. Errors: a scale beyond 1:5 to 1:50,000, cairo cannot be loaded, the disk is full.
Status write_council_sheet(const std::filesystem::path& file, const CouncilSheet& sheet);

}  // namespace parvis::plan_drawing
