#include "planning/sun_hours/sun_plan.h"

#include <algorithm>
#include <cmath>

#include "base/image_text.h"

namespace parvis::sun_hours {
namespace {

constexpr int wanted_px = 1200, max_cell_px = 16;
constexpr int margin_px = 24, scale_px = 22, text_px = 17, gap_px = 10;
constexpr int min_width_px = 420;  // of the scale below
constexpr glm::vec3 ink{40.0f, 40.0f, 44.0f};
constexpr const char* title = "hours of direct sun per day";

void paint(Image8& picture, glm::ivec2 from, glm::ivec2 to, glm::vec3 colour) {
  for (int y = std::max(from.y, 0); y < std::min(to.y, picture.height); ++y)
    for (int x = std::max(from.x, 0); x < std::min(to.x, picture.width); ++x) {
      for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = std::uint8_t(std::lround(colour[c]));
      picture.at(x, y)[3] = 255;
    }
}

glm::vec3 colour_of(const GroundCell& cell, double max_hours) {
  const glm::vec3 colour = hours_colour(double(cell.hours) / max_hours);
  return cell.kind == GroundCell::Kind::ground ? colour : 0.35f * colour + glm::vec3(110.0f);
}

void paint_cells(const SunStudy& study, SunPlan& plan) {
  for (int row = 0; row < study.rows; ++row)
    for (int column = 0; column < study.columns; ++column) {
      const GroundCell& cell =
          study.cells[std::size_t(study.rows - 1 - row) * std::size_t(study.columns) + std::size_t(column)];
      if (cell.kind == GroundCell::Kind::nothing) continue;
      const glm::ivec2 at = plan.corner + plan.cell_px * glm::ivec2(column, row);
      paint(plan.picture, at, at + plan.cell_px, colour_of(cell, study.max_hours));
    }
}

/// A line around the judged ground, on its own side.
void paint_border(const SunStudy& study, SunPlan& plan) {
  const auto is_judged = [&](int row, int column) {
    return row >= 0 && column >= 0 && row < study.rows && column < study.columns &&
           study.cells[std::size_t(row) * std::size_t(study.columns) + std::size_t(column)].is_judged;
  };
  const int width = std::max(1, plan.cell_px / 4);
  for (int row = 0; row < study.rows; ++row)
    for (int column = 0; column < study.columns; ++column) {
      if (!is_judged(row, column)) continue;
      const glm::ivec2 from = plan.corner + plan.cell_px * glm::ivec2(column, study.rows - 1 - row),
                       to = from + plan.cell_px;
      if (!is_judged(row, column - 1)) paint(plan.picture, from, {from.x + width, to.y}, ink);
      if (!is_judged(row, column + 1)) paint(plan.picture, {to.x - width, from.y}, to, ink);
      if (!is_judged(row + 1, column)) paint(plan.picture, from, {to.x, from.y + width}, ink);
      if (!is_judged(row - 1, column)) paint(plan.picture, {from.x, to.y - width}, to, ink);
    }
}

/// A step for each begun hour, from none to the most, with the hour at its left edge.
void paint_scale(const SunStudy& study, glm::ivec2 at, int width, Image8& picture) {
  write_text(picture, at - glm::ivec2(0, gap_px), title, text_px, ink);
  const int steps = std::max(1, int(std::ceil(study.max_hours)));
  const auto left_of = [&](int hour) { return at.x + width * hour / steps; };
  for (int hour = 0; hour < steps; ++hour) {
    paint(picture, {left_of(hour), at.y}, {left_of(hour + 1), at.y + scale_px},
          hours_colour(hour / study.max_hours));
    write_text(picture, {left_of(hour), at.y + scale_px + gap_px + text_px / 2}, std::to_string(hour),
               text_px, ink);
  }
}

/// A bar of 1, 2 or 5 times a power of ten metres, at most a quarter of the plan's width, and its right end.
void paint_bar(const SunStudy& study, int cell_px, glm::ivec2 right, Image8& picture) {
  const double longest_m = 0.25 * study.columns * study.cell_m,
               power = std::pow(10.0, std::floor(std::log10(longest_m)));
  const double metres = power * (longest_m >= 5.0 * power ? 5.0 : longest_m >= 2.0 * power ? 2.0 : 1.0);
  const int length = std::max(2, int(std::lround(metres / study.cell_m * cell_px)));
  const std::string label = fmt::format("{:g} m", metres);
  paint(picture, right - glm::ivec2(length, 3), right, ink);
  write_text(picture, right - glm::ivec2(text_width(label, text_px), gap_px), label, text_px, ink);
}

}  // namespace

glm::vec3 hours_colour(double share) {
  // Viridis (Smith and van der Walt 2015) at five places: even to the eye, and readable without colour
  // vision.
  constexpr glm::vec3 colours[] = {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}};
  const float place = 4.0f * float(std::clamp(share, 0.0, 1.0));
  const int left = std::min(int(place), 3);
  return glm::mix(colours[left], colours[left + 1], place - float(left));
}

SunPlan sun_plan(const SunStudy& study) {
  SunPlan plan;
  plan.cell_px = std::clamp(wanted_px / std::max(study.columns, study.rows), 1, max_cell_px);
  const glm::ivec2 size = plan.cell_px * glm::ivec2(study.columns, study.rows);
  const int width = std::max(size.x, min_width_px);
  const int line_px = text_px + gap_px;
  const int rule_px = study.is_chosen ? line_px : 0;  // what is said of the judged ground
  const int below = margin_px + rule_px + line_px;    // of the plan: that and the title
  plan.corner = glm::ivec2(margin_px + (width - size.x) / 2, margin_px);
  plan.picture = Image8(width + 2 * margin_px,
                        margin_px + size.y + below + scale_px + gap_px + text_px + margin_px, 4, 255);
  paint_cells(study, plan);
  if (study.is_chosen) paint_border(study, plan);
  if (study.is_chosen)
    write_text(plan.picture, {margin_px, margin_px + size.y + margin_px + text_px},
               "outlined: " + to_string(open_space_rule(study)), text_px, ink);
  const int scale_y = margin_px + size.y + below;
  paint_scale(study, {margin_px, scale_y}, width, plan.picture);
  paint_bar(study, plan.cell_px, {margin_px + width, scale_y - gap_px}, plan.picture);
  return plan;
}

}  // namespace parvis::sun_hours
