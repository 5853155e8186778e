// The sheet of a plan as PDF.
#include <cmath>

#include "planning/plan_drawing/cairo_module.h"
#include "planning/plan_drawing/cairo_plan.h"

namespace parvis::plan_drawing {
namespace {

constexpr double margin_mm = 10.0, column_mm = 68.0, inset_mm = 4.0;

/// "1043010"; 0 where rounding left a little beside it.
std::string coordinate(double value) { return fmt::format("{:.10g}", std::abs(value) < 1e-6 ? 0.0 : value); }

/// Crosses at round coordinates, with their numbers at the frame.
void draw_grid(const Page& page, const Viewport& view, const glm::dvec2& origin) {
  constexpr double arm_mm = 1.5, text_mm = 1.6;
  const double step = round_number(0.06 * view.scale);  // 60 mm on paper at most
  const glm::dvec2 min = origin + view.centre - view.half_m(), max = origin + view.centre + view.half_m();
  for (double x = std::ceil(min.x / step) * step; x < max.x; x += step)
    for (double y = std::ceil(min.y / step) * step; y < max.y; y += step) {
      const glm::dvec2 at = view.on_page(glm::dvec2(x, y) - origin);
      page.line(at - glm::dvec2(arm_mm, 0), at + glm::dvec2(arm_mm, 0), 0.09, grey);
      page.line(at - glm::dvec2(0, arm_mm), at + glm::dvec2(0, arm_mm), 0.09, grey);
    }
  for (double x = std::ceil(min.x / step) * step; x < max.x; x += step) {
    const double at = view.on_page({x - origin.x, 0}).x;
    page.line({at, view.max_mm.y}, {at, view.max_mm.y - 2.0}, 0.13, black);
    page.text(coordinate(x), {at + 0.6, view.max_mm.y - 0.8}, text_mm);
  }
  for (double y = std::ceil(min.y / step) * step; y < max.y; y += step) {
    const double at = view.on_page({0, y - origin.y}).y;
    page.line({view.min_mm.x, at}, {view.min_mm.x + 2.0, at}, 0.13, black);
    page.text(coordinate(y), {view.min_mm.x + 2.6, at - 0.5}, text_mm);
  }
}

/// The column beside the plan: north, legend, notes, title block from the top down.
void draw_column(const Page& page, glm::dvec2 min, glm::dvec2 max, const ScenePlan& plan, const Sheet& sheet,
                 const PlanPainter& painter) {
  const double left = min.x + inset_mm, width = max.x - min.x - 2.0 * inset_mm;
  constexpr double title_block_mm = 62.0;
  const double title_top = max.y - title_block_mm;
  draw_north(page, {max.x - 12.0, min.y + 27.0});
  double y = min.y + 9.0;
  page.text(sheet.words("Legend"), {left, y}, 2.6, width, true);
  y += 7.0;
  const auto entry = [&](const std::string& label, const auto& draw) {
    if (y > title_top - 8.0) return;
    draw(glm::dvec2(left, y - 1.0));
    page.text(label, {left + 11.0, y}, 2.0, (y < min.y + 32.0 ? width - 30.0 : width - 11.0));
    y += 5.2;
  };
  for (const auto& [layer, count] : painter.layers()) {
    const Pen pen = pen_of(layer);
    entry(sheet.words(pen.label),
          [&](glm::dvec2 at) { page.line(at, at + glm::dvec2(8.0, 0), pen.width_mm, pen.colour); });
  }
  if (painter.trees() > 0)
    entry(sheet.words.format("Tree ({})", painter.trees()), [&](glm::dvec2 at) {
      cairo_new_path(page.context());
      cairo_arc(page.context(), at.x + 4.0, at.y, 2.0, 0.0, 2.0 * std::numbers::pi);
      page.fill(green, 0.12), page.stroke(0.18, green);
    });
  if (painter.measured() > 0)
    entry(sheet.words.format("Measured ({})", painter.measured()),
          [&](glm::dvec2 at) { page.line(at, at + glm::dvec2(8.0, 0), 0.18, crimson); });
  for (const auto& [label, kind] : painter.kinds())
    entry(fmt::format("{} ({})", label, kind.first), [&, colour = kind.second](glm::dvec2 at) {
      page.path({at + glm::dvec2(1, -1.5), at + glm::dvec2(7, -1.5), at + glm::dvec2(7, 1.5),
                 at + glm::dvec2(1, 1.5)},
                true);
      page.fill(colour, 0.8), page.stroke(0.25, black);
    });
  if (!plan.left_out.empty() && y < title_top - 20.0) {
    y += 3.0;
    page.text(sheet.words("Not on this plan"), {left, y}, 2.0, width, true);
    y += 4.0;
    for (const std::string& note : plan.left_out)
      if (y < title_top - 8.0) y = page.paragraph(note, {left, y}, 1.7, width) + 0.6;
  }
  page.line({min.x, title_top}, {max.x, title_top}, 0.35, black);
  y = title_top + 10.0;
  page.text(sheet.title.empty() ? sheet.words("Plan") : sheet.title, {left, y}, 4.0, width, true);
  if (!sheet.subtitle.empty()) page.text(sheet.subtitle, {left, y + 6.5}, 2.4, width);
  page.line({min.x, title_top + 22.0}, {max.x, title_top + 22.0}, 0.18, black);
  page.text(fmt::format("1:{:g}", sheet.scale), {left, title_top + 31.0}, 4.0, width, true);
  page.text(sheet.words.format("{} landscape, north up", sheet.paper), {left + 26.0, title_top + 31.0}, 2.0,
            width - 26.0);
  draw_scale_bar(page, {left, title_top + 36.0}, sheet.scale, width - 6.0);
  page.line({min.x, title_top + 46.0}, {max.x, title_top + 46.0}, 0.18, black);
  const char* const frame =
      plan.origin == glm::dvec3(0.0)
          ? "Coordinates are the scene's own, in metres. Print at 100 %, not fitted to the page."
      : plan.map.empty() || plan.map.size() > 40
          ? "Coordinates are those of the map, in metres. Print at 100 %, not fitted to the page."
          : "Coordinates are those of {}, in metres. Print at 100 %, not fitted to the page.";
  page.paragraph(sheet.words.format(frame, plan.map), {left, title_top + 51.0}, 1.7, width);
}

}  // namespace

Status draw_sheet(const std::filesystem::path& file, const ScenePlan& plan, const Sheet& sheet,
                  glm::dvec2 size_mm) {
  const Page page(file, size_mm);
  const glm::dvec2 min(margin_mm), max = size_mm - margin_mm;
  const Viewport view{min, {max.x - column_mm, max.y}, *sheet.centre, sheet.scale};
  PlanPainter painter(page, view);
  cairo_save(page.context());
  cairo_rectangle(page.context(), view.min_mm.x, view.min_mm.y, view.max_mm.x - view.min_mm.x,
                  view.max_mm.y - view.min_mm.y);
  cairo_clip(page.context());
  painter.draw(plan);
  draw_grid(page, view, glm::dvec2(plan.origin));
  cairo_restore(page.context());
  if (!painter.has_drawn())
    return error(
        "nothing of the scene lies on a sheet of {} at 1:{:g} about {:.2f}, {:.2f}; choose another centre "
        "or scale",
        sheet.paper, sheet.scale, view.centre.x, view.centre.y);
  page.box(min, max, 0.7, black);
  page.line({view.max_mm.x, min.y}, {view.max_mm.x, max.y}, 0.35, black);
  draw_column(page, {view.max_mm.x, min.y}, max, plan, sheet, painter);
  return page.finish();
}

}  // namespace parvis::plan_drawing
