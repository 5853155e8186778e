// Plans as files: PDF at a true scale, DXF, CSV.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/result.h"
#include "planning/design/words.h"
#include "planning/plan_drawing/scene_plan.h"

namespace parvis::plan_drawing {

/// A sheet of paper, landscape, north up.
struct Sheet {
  std::string paper = "A3";          ///< A4 to A0
  double scale = 200.0;              ///< 1 : scale
  std::optional<glm::dvec2> centre;  ///< of what is shown, in the scene's frame; nothing: ScenePlan::middle
  std::string title, subtitle;       ///< of the title block; UTF-8
  design::Words words;               ///< of legend, notes and title block
};

/// Width and height of a paper in landscape, millimetres; nothing for a name that is none of A0 to A4.
std::optional<glm::dvec2> paper_size_mm(const std::string& paper);

inline constexpr double min_plan_scale = 5.0, max_plan_scale = 50'000.0;
/// Errors: a scale that is not between these.
Status check_scale(double scale);

/// Draws what lies on the sheet, with frame, grid, title block, legend, scale bar and north. Errors: an
/// unknown paper, a scale beyond 1:5 to 1:50,000, a sheet on which nothing lies.
Status write_plan_pdf(const std::filesystem::path& file, const ScenePlan& plan, const Sheet& sheet);

/// Layers WALLS, ROADS, THINGS, PLANTS, TREES, and DESIGN_ and MEASURES_ with the name of each design. Trees
/// and placed objects are blocks; coordinates are those of the map where the scene is on one.
Status write_plan_dxf(const std::filesystem::path& file, const ScenePlan& plan);

/// One line for each placed object, tree and measurement: kind, name, x, y, z, heading_deg, width_m, depth_m,
/// height_m, design, value, unit; coordinates as in the DXF, of a measurement those of its first point.
Status write_plan_csv(const std::filesystem::path& file, const ScenePlan& plan);

}  // namespace parvis::plan_drawing
