// A scene's plan on a page, for the sources of this room's module. Cairo's coordinates are rounded to a
// thousandth of a point and wrap beyond eight million: everything is taken about the middle and cut at the
// frame's edge first.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/colour.h"
#include "base/cut_polygon.h"
#include "planning/plan_drawing/cairo_page.h"
#include "planning/plan_drawing/scene_plan.h"

namespace parvis::plan_drawing {

inline constexpr double beyond_mm = 20.0;  // what is cut lies outside of the frame

/// How lines of a layer are drawn.
struct Pen {
  double width_mm;
  Colour colour;
  const char* label;
};

/// The pen of a layer.
inline Pen pen_of(PlanLayer layer) {
  switch (layer) {
    case PlanLayer::wall:
      return {0.35, black, "Cut 1 m above the ground"};
    case PlanLayer::road:
      return {0.13, grey, "Edge of road or square"};
    case PlanLayer::thing:
      return {0.13, blue, "Low object"};
    case PlanLayer::plant:
      return {0.18, green, "Hedge, grass"};
    default:
      return {0.1, grey, "Plan drawing"};
  }
}

/// Where the plan is on the page.
struct Viewport {
  glm::dvec2 min_mm, max_mm;  ///< of the frame
  glm::dvec2 centre;          ///< in the scene, shown in the frame's middle
  double scale;

  /// A place of the scene on the page.
  glm::dvec2 on_page(glm::dvec2 point) const {
    const glm::dvec2 away = (point - centre) * 1000.0 / scale;
    return 0.5 * (min_mm + max_mm) + glm::dvec2(away.x, -away.y);
  }
  /// Whether a rectangle of the page lies in the frame.
  bool shows(glm::dvec2 min, glm::dvec2 max) const {
    return glm::all(glm::lessThan(min, max_mm)) && glm::all(glm::greaterThan(max, min_mm));
  }
  /// Half of what the frame shows, in metres.
  glm::dvec2 half_m() const { return 0.5 * (max_mm - min_mm) * scale / 1000.0; }
};

/// The polygon inside of the frame and a little around it.
inline std::vector<glm::dvec2> cut_at(const Viewport& view, std::vector<glm::dvec2> polygon) {
  const glm::dvec2 min = view.min_mm - beyond_mm, max = view.max_mm + beyond_mm;
  polygon = cut(polygon, [&](const glm::dvec2& p) { return p.x - min.x; });
  polygon = cut(polygon, [&](const glm::dvec2& p) { return max.x - p.x; });
  polygon = cut(polygon, [&](const glm::dvec2& p) { return p.y - min.y; });
  return cut(polygon, [&](const glm::dvec2& p) { return max.y - p.y; });
}

/// Draws things of a plan and notes what the legend explains.
class PlanPainter {
 public:
  /// Both outlive it.
  PlanPainter(const Page& page, const Viewport& view) : page_(page), view_(view) {}

  /// Draws all of a plan.
  void draw(const ScenePlan& plan) {
    for (const PlanLayer layer :
         {PlanLayer::drawing, PlanLayer::road, PlanLayer::plant, PlanLayer::thing, PlanLayer::wall})
      for (const PlanLine& line : plan.lines)
        if (line.layer == layer) draw(line);
    for (const PlanText& text : plan.texts) draw(text);
    for (const PlanTree& tree : plan.trees) draw(tree);
    for (const design::PlacedObject& object : plan.placed) draw(object);
    for (const PlanMeasure& each : plan.measured) draw(each);
  }

  /// Number of lines of each layer that is shown.
  const std::map<PlanLayer, int>& layers() const { return layers_; }
  /// Number of trees that are shown.
  int trees() const { return trees_; }
  /// Number of measurements that are shown.
  int measured() const { return measured_; }
  /// Number and colour of the kinds that are shown, by their label.
  const std::map<std::string, std::pair<int, Colour>>& kinds() const { return kinds_; }
  /// Is anything shown?
  bool has_drawn() const { return !layers_.empty() || trees_ > 0 || measured_ > 0 || !kinds_.empty(); }

 private:
  template <class Points>
  std::vector<glm::dvec2> on_page(const Points& points) const {
    std::vector<glm::dvec2> placed;
    for (const auto& point : points) placed.push_back(view_.on_page(glm::dvec2(point)));
    return placed;
  }

  bool is_shown(const std::vector<glm::dvec2>& points) const {
    glm::dvec2 min(1e30), max(-1e30);
    for (const glm::dvec2& point : points) min = glm::min(min, point), max = glm::max(max, point);
    return !points.empty() && view_.shows(min, max);
  }

  void draw(const PlanLine& line) {
    std::vector<glm::dvec2> points = on_page(line.points);
    if (!is_shown(points)) return;
    ++layers_[line.layer];
    Pen pen = pen_of(line.layer);
    if (line.layer == PlanLayer::drawing) {
      const glm::vec3 tint = glm::mix(srgb_from_linear(line.colour), glm::vec3(1.0f), 0.35f);
      pen.colour = {tint.x, tint.y, tint.z};
      pen.width_mm = std::max(pen.width_mm, line.width_m * 1000.0 / view_.scale);
    }
    const bool fills = line.is_closed() && (line.layer == PlanLayer::wall || line.layer == PlanLayer::plant);
    if (fills) {
      points.pop_back();
      if (points = cut_at(view_, points); points.size() < 3) return;
      page_.path(points, true);
      page_.fill(line.layer == PlanLayer::wall ? pale : green, line.layer == PlanLayer::wall ? 1.0 : 0.15);
      return page_.stroke(pen.width_mm, pen.colour);
    }
    for (std::size_t i = 0; i + 1 < points.size(); ++i) segment(points[i], points[i + 1]);
    if (pen.width_mm > 0.5) cairo_set_line_cap(page_.context(), CAIRO_LINE_CAP_BUTT);
    page_.stroke(pen.width_mm, pen.colour);
    cairo_set_line_cap(page_.context(), CAIRO_LINE_CAP_ROUND);
  }

  /// Adds a line to the path, cut a little outside of the frame.
  void segment(glm::dvec2 from, glm::dvec2 to) const {
    const glm::dvec2 min = view_.min_mm - beyond_mm, max = view_.max_mm + beyond_mm;
    double first = 0.0, last = 1.0;
    for (int axis = 0; axis < 2; ++axis) {
      const double step = to[axis] - from[axis];
      if (step == 0.0 && (from[axis] < min[axis] || from[axis] > max[axis])) return;
      if (step == 0.0) continue;
      const double a = (min[axis] - from[axis]) / step, b = (max[axis] - from[axis]) / step;
      first = std::max(first, std::min(a, b)), last = std::min(last, std::max(a, b));
    }
    if (first >= last) return;
    const glm::dvec2 begin = glm::mix(from, to, first), end = glm::mix(from, to, last);
    double x = 0.0, y = 0.0;
    const bool continues = cairo_has_current_point(page_.context()) != 0;
    if (continues) cairo_get_current_point(page_.context(), &x, &y);
    if (!continues || std::abs(x - begin.x) + std::abs(y - begin.y) > 1e-6)
      cairo_move_to(page_.context(), begin.x, begin.y);
    cairo_line_to(page_.context(), end.x, end.y);
  }

  void draw(const PlanText& text) {
    constexpr double min_mm = 0.8, max_mm = 50.0;  // that can be read, and that is no title of a sheet
    const glm::dvec2 at = view_.on_page(text.position);
    const double height_mm = text.height_m * 1000.0 / view_.scale;
    if (!view_.shows(at - 1.0, at + 1.0) || height_mm < min_mm || height_mm > max_mm) return;
    std::vector<std::string> lines(1);
    for (const char c : text.text)
      if (c == '\n')
        lines.emplace_back();
      else
        lines.back() += c;
    constexpr double spacing = 5.0 / 3.0;  // of the height
    const double height = height_mm * (1.0 + spacing * double(lines.size() - 1));
    cairo_save(page_.context());
    cairo_translate(page_.context(), at.x, at.y);
    cairo_rotate(page_.context(), -text.angle_deg * std::numbers::pi / 180.0);
    double base = height_mm - height * (1.0 - text.anchor.y);
    for (const std::string& line : lines) {
      page_.text(line, {-text.anchor.x * page_.text_width(line, height_mm), base}, height_mm, 1e3, false,
                 grey);
      base += spacing * height_mm;
    }
    cairo_restore(page_.context());
  }

  void draw(const PlanTree& tree) { draw_tree(tree.position, tree.crown_radius_m); }

  void draw_tree(const glm::dvec3& position, double crown_radius_m) {
    const glm::dvec2 at = view_.on_page(glm::dvec2(position));
    const double radius = crown_radius_m * 1000.0 / view_.scale;
    if (!view_.shows(at - radius, at + radius)) return;
    ++trees_;
    cairo_new_path(page_.context());
    cairo_arc(page_.context(), at.x, at.y, radius, 0.0, 2.0 * std::numbers::pi);
    page_.fill(green, 0.12), page_.stroke(0.18, green);
    const double half = std::min(0.8, 0.4 * radius);
    page_.line(at - glm::dvec2(half, 0), at + glm::dvec2(half, 0), 0.13, green);
    page_.line(at - glm::dvec2(0, half), at + glm::dvec2(0, half), 0.13, green);
  }

  void draw(const design::PlacedObject& object) {
    if (object.kind.starts_with("tree")) return draw_tree(object.position, 0.5 * object.size_m.x);
    const std::vector<glm::dvec2> points = on_page(object.outline);
    if (points.size() < 3 || !is_shown(points)) return;
    const glm::vec3 srgb = glm::clamp(srgb_from_linear(object.colour), 0.0f, 1.0f);
    const Colour colour{srgb.x, srgb.y, srgb.z};
    const std::string& label = object.label.empty() ? object.kind : object.label;
    const auto kind = kinds_.try_emplace(label, 0, colour).first;
    ++kind->second.first;
    page_.path(cut_at(view_, points), true);
    page_.fill(colour, object.kind == "ground" ? 0.35 : 0.8);
    page_.stroke(object.kind == "ground" ? 0.18 : 0.25, black);
  }

  void draw(const PlanMeasure& measure) {
    constexpr double dot_mm = 0.45, text_mm = 2.0, halo_mm = 0.7;
    const std::vector<glm::dvec2> line = on_page(measure.line);
    glm::dvec2 min(1e30), max(-1e30);
    for (const glm::dvec2& point : line) min = glm::min(min, point), max = glm::max(max, point);
    if (line.empty() || !view_.shows(min - dot_mm, max + dot_mm)) return;
    ++measured_;
    cairo_new_path(page_.context());
    for (std::size_t i = 0; i + 1 < line.size(); ++i) segment(line[i], line[i + 1]);
    page_.stroke(0.18, crimson);
    for (const glm::dvec2& point : on_page(measure.measured.points)) {
      cairo_new_path(page_.context());
      cairo_arc(page_.context(), point.x, point.y, dot_mm, 0.0, 2.0 * std::numbers::pi);
      page_.set(crimson), cairo_fill(page_.context());
    }
    const std::string& text = measure.text;
    const glm::dvec2 at =
        view_.on_page(glm::dvec2(measure.middle)) + glm::dvec2(-0.5 * page_.text_width(text, text_mm), -0.8);
    cairo_move_to(page_.context(), at.x, at.y);
    cairo_text_path(page_.context(), text.c_str());
    page_.stroke(halo_mm, {1, 1, 1});
    page_.text(text, at, text_mm, 1e3, false, crimson);
  }

  const Page& page_;
  const Viewport& view_;
  std::map<PlanLayer, int> layers_;
  int trees_ = 0, measured_ = 0;
  std::map<std::string, std::pair<int, Colour>> kinds_;
};

/// 1, 2 or 5 times a power of ten, at most `value`.
double round_number(double value);
/// An arrow that points up the page.
void draw_north(const Page& page, glm::dvec2 foot);
/// Four fields, black and white, with their lengths.
void draw_scale_bar(const Page& page, glm::dvec2 at, double scale, double max_width_mm);

}  // namespace parvis::plan_drawing
