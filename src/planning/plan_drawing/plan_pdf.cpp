#include <map>

#include "base/files.h"
#include "planning/plan_drawing/cairo_module.h"
#include "planning/plan_drawing/plan_files.h"

namespace parvis::plan_drawing {

std::optional<glm::dvec2> paper_size_mm(const std::string& paper) {
  static const std::map<std::string, glm::dvec2> sizes{
      {"A4", {297, 210}}, {"A3", {420, 297}}, {"A2", {594, 420}}, {"A1", {841, 594}}, {"A0", {1189, 841}}};
  const auto found = sizes.find(paper);
  return found == sizes.end() ? std::nullopt : std::optional(found->second);
}

Status check_scale(double scale) {
  if (scale >= min_plan_scale && scale <= max_plan_scale) return Ok{};
  return error("a scale of 1:{:g}; expected 1:{:g} to 1:{:g}", scale, min_plan_scale, max_plan_scale);
}

Status write_plan_pdf(const std::filesystem::path& file, const ScenePlan& plan, const Sheet& sheet) {
  const std::optional<glm::dvec2> size_mm = paper_size_mm(sheet.paper);
  if (!size_mm) return error("\"{}\" is no paper; expected A4, A3, A2, A1 or A0", sheet.paper);
  if (Status status = check_scale(sheet.scale); !status) return status;
  Sheet centred = sheet;
  if (!sheet.centre) centred.centre = plan.middle();
  return write_atomically(file, [&](const std::filesystem::path& temporary) {
    return cairo.call(&CairoFunctions::draw_sheet, temporary, plan, centred, *size_mm);
  });
}

}  // namespace parvis::plan_drawing
