// PDF through cairo. Its coordinates are rounded to a thousandth of a point and wrap beyond eight million:
// everything is taken about the sheet's centre and cut at its edge first. It draws no line of width 0.
#include <cairo-pdf.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>

#include "base/colour.h"
#include "base/cut_polygon.h"
#include "planning/plan_drawing/cairo_module.h"

namespace parvis::plan_drawing {
namespace {

constexpr double point_per_mm = 72.0 / 25.4;
constexpr double margin_mm = 10.0, column_mm = 68.0, inset_mm = 4.0;
constexpr double beyond_mm = 20.0;  // what is cut lies outside of the frame

struct Colour {
  double red, green, blue;
};
constexpr Colour black{0, 0, 0}, grey{0.45, 0.45, 0.45}, light{0.86, 0.86, 0.86}, green{0.18, 0.45, 0.2},
    blue{0.15, 0.3, 0.6};

/// How lines of a layer are drawn.
struct Pen {
  double width_mm;
  Colour colour;
  const char* label;
};

Pen pen_of(PlanLayer layer) {
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

/// A page in millimetres from its upper left corner.
class Page {
 public:
  Page(const std::filesystem::path& file, glm::dvec2 size_mm)
      : surface_(cairo_pdf_surface_create(file.c_str(), size_mm.x * point_per_mm, size_mm.y * point_per_mm),
                 &cairo_surface_destroy),
        context_(cairo_create(surface_.get()), &cairo_destroy) {
    cairo_scale(context_.get(), point_per_mm, point_per_mm);
    cairo_set_line_join(context_.get(), CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(context_.get(), CAIRO_LINE_CAP_ROUND);
  }

  cairo_t* context() const { return context_.get(); }
  void set(const Colour& colour, double alpha = 1.0) const {
    cairo_set_source_rgba(context(), colour.red, colour.green, colour.blue, alpha);
  }
  void path(const std::vector<glm::dvec2>& points, bool is_closed) const {
    cairo_new_path(context());
    for (const glm::dvec2& point : points) cairo_line_to(context(), point.x, point.y);
    if (is_closed) cairo_close_path(context());
  }
  void stroke(double width_mm, const Colour& colour) const {
    set(colour);
    cairo_set_line_width(context(), width_mm);
    cairo_stroke(context());
  }
  void fill(const Colour& colour, double alpha = 1.0) const {
    set(colour, alpha);
    cairo_fill_preserve(context());
  }
  void line(glm::dvec2 from, glm::dvec2 to, double width_mm, const Colour& colour) const {
    path({from, to}, false), stroke(width_mm, colour);
  }
  void box(glm::dvec2 min, glm::dvec2 max, double width_mm, const Colour& colour) const {
    path({min, {max.x, min.y}, max, {min.x, max.y}}, true), stroke(width_mm, colour);
  }
  double text_width(const std::string& text, double height_mm, bool is_bold = false) const {
    font(height_mm, is_bold);
    cairo_text_extents_t extents;
    cairo_text_extents(context(), text.c_str(), &extents);
    return extents.x_advance;
  }
  /// On its base line; made smaller where it is wider than `max_width_mm`.
  void text(const std::string& text, glm::dvec2 at, double height_mm, double max_width_mm = 1e3,
            bool is_bold = false, const Colour& colour = black) const {
    const double width = text_width(text, height_mm, is_bold);
    if (width > max_width_mm) font(height_mm * max_width_mm / width, is_bold);
    set(colour);
    cairo_move_to(context(), at.x, at.y);
    cairo_show_text(context(), text.c_str());
  }
  /// Broken into lines; returns the base line after the last.
  double paragraph(const std::string& text, glm::dvec2 at, double height_mm, double max_width_mm) const {
    std::string line;
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find(' ', begin), text.size());
      const std::string word = text.substr(begin, end - begin);
      if (!line.empty() && text_width(line + " " + word, height_mm) > max_width_mm) {
        this->text(line, at, height_mm), at.y += 1.45 * height_mm;
        line.clear();
      }
      line += (line.empty() ? "" : " ") + word;
      begin = end + 1;
    }
    this->text(line, at, height_mm, max_width_mm);
    return at.y + 1.45 * height_mm;
  }
  Status finish() const {
    cairo_show_page(context());
    cairo_surface_finish(surface_.get());
    const cairo_status_t status = cairo_surface_status(surface_.get());
    if (status != CAIRO_STATUS_SUCCESS)
      return error("the plan could not be written ({})", cairo_status_to_string(status));
    return Done{};
  }

 private:
  void font(double height_mm, bool is_bold) const {
    cairo_select_font_face(context(), "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           is_bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context(), height_mm * 1.38);  // of capitals of this height
  }

  std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface_;
  std::unique_ptr<cairo_t, decltype(&cairo_destroy)> context_;
};

/// Where the plan is on the page.
struct Viewport {
  glm::dvec2 min_mm, max_mm;  ///< of the frame
  glm::dvec2 centre;          ///< in the scene, shown in the frame's middle
  double scale;

  glm::dvec2 on_page(glm::dvec2 point) const {
    const glm::dvec2 away = (point - centre) * 1000.0 / scale;
    return 0.5 * (min_mm + max_mm) + glm::dvec2(away.x, -away.y);
  }
  bool shows(glm::dvec2 min, glm::dvec2 max) const {
    return glm::all(glm::lessThan(min, max_mm)) && glm::all(glm::greaterThan(max, min_mm));
  }
  /// Half of what the frame shows, in metres.
  glm::dvec2 half_m() const { return 0.5 * (max_mm - min_mm) * scale / 1000.0; }
};

/// The polygon inside of the frame and a little around it.
std::vector<glm::dvec2> cut_at(const Viewport& view, std::vector<glm::dvec2> polygon) {
  const glm::dvec2 min = view.min_mm - beyond_mm, max = view.max_mm + beyond_mm;
  polygon = cut(polygon, [&](const glm::dvec2& p) { return p.x - min.x; });
  polygon = cut(polygon, [&](const glm::dvec2& p) { return max.x - p.x; });
  polygon = cut(polygon, [&](const glm::dvec2& p) { return p.y - min.y; });
  return cut(polygon, [&](const glm::dvec2& p) { return max.y - p.y; });
}

/// Draws things of a plan and notes what the legend explains.
class PlanPainter {
 public:
  PlanPainter(const Page& page, const Viewport& view) : page_(page), view_(view) {}

  void draw(const ScenePlan& plan) {
    for (const PlanLayer layer :
         {PlanLayer::drawing, PlanLayer::road, PlanLayer::plant, PlanLayer::thing, PlanLayer::wall})
      for (const PlanLine& line : plan.lines)
        if (line.layer == layer) draw(line);
    for (const PlanText& text : plan.texts) draw(text);
    for (const PlanTree& tree : plan.trees) draw(tree);
    for (const design::PlacedObject& object : plan.placed) draw(object);
  }

  const std::map<PlanLayer, int>& layers() const { return layers_; }
  int trees() const { return trees_; }
  /// Number and colour of the kinds that are shown, by their label.
  const std::map<std::string, std::pair<int, Colour>>& kinds() const { return kinds_; }
  bool has_drawn() const { return !layers_.empty() || trees_ > 0 || !kinds_.empty(); }

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
      page_.fill(line.layer == PlanLayer::wall ? light : green, line.layer == PlanLayer::wall ? 1.0 : 0.15);
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
    const bool goes_on = cairo_has_current_point(page_.context()) != 0;
    if (goes_on) cairo_get_current_point(page_.context(), &x, &y);
    if (!goes_on || std::abs(x - begin.x) + std::abs(y - begin.y) > 1e-6)
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

  const Page& page_;
  const Viewport& view_;
  std::map<PlanLayer, int> layers_;
  int trees_ = 0;
  std::map<std::string, std::pair<int, Colour>> kinds_;
};

/// 1, 2 or 5 times a power of ten, at most `value`.
double round_number(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double digit : {5.0, 2.0, 1.0})
    if (digit * power <= value) return digit * power;
  return power;
}

std::string metres(double value) {
  return value < 1.0 ? fmt::format("{:g} cm", 100.0 * value) : fmt::format("{:g} m", value);
}

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

/// An arrow that points up the page.
void draw_north(const Page& page, glm::dvec2 foot) {
  constexpr double length = 18.0, half = 4.0;
  const glm::dvec2 tip = foot - glm::dvec2(0, length), notch = foot - glm::dvec2(0, 0.25 * length);
  page.path({tip, foot - glm::dvec2(half, 0), notch}, true), page.fill(black), page.stroke(0.18, black);
  page.path({tip, foot + glm::dvec2(half, 0), notch}, true), page.stroke(0.18, black);
  page.text("N", tip - glm::dvec2(0.5 * page.text_width("N", 3.5, true), 1.5), 3.5, 20.0, true);
}

/// Four fields, black and white, with their lengths.
void draw_scale_bar(const Page& page, glm::dvec2 at, double scale, double max_width_mm) {
  const double field_m = round_number(max_width_mm / 4.0 * scale / 1000.0), field = field_m * 1000.0 / scale;
  constexpr double height = 2.0;
  for (int k = 0; k < 4; ++k) {
    const glm::dvec2 min = at + glm::dvec2(k * field, 0), max = min + glm::dvec2(field, height);
    page.path({min, {max.x, min.y}, max, {min.x, max.y}}, true);
    page.fill(k % 2 == 0 ? black : Colour{1, 1, 1}), page.stroke(0.18, black);
  }
  for (const int k : {0, 1, 2, 4}) {
    const std::string label = k == 4 ? metres(4 * field_m) : fmt::format("{:g}", k * field_m);
    page.text(label,
              at + glm::dvec2(k * field - (k == 0 ? 0.0 : 0.5 * page.text_width(label, 1.8)), height + 3.0),
              1.8);
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
  page.text("Legend", {left, y}, 2.6, width, true);
  y += 7.0;
  const auto entry = [&](const std::string& label, const auto& draw) {
    if (y > title_top - 8.0) return;
    draw(glm::dvec2(left, y - 1.0));
    page.text(label, {left + 11.0, y}, 2.0, (y < min.y + 32.0 ? width - 30.0 : width - 11.0));
    y += 5.2;
  };
  for (const auto& [layer, count] : painter.layers()) {
    const Pen pen = pen_of(layer);
    entry(pen.label,
          [&](glm::dvec2 at) { page.line(at, at + glm::dvec2(8.0, 0), pen.width_mm, pen.colour); });
  }
  if (painter.trees() > 0)
    entry(fmt::format("Tree ({})", painter.trees()), [&](glm::dvec2 at) {
      cairo_new_path(page.context());
      cairo_arc(page.context(), at.x + 4.0, at.y, 2.0, 0.0, 2.0 * std::numbers::pi);
      page.fill(green, 0.12), page.stroke(0.18, green);
    });
  for (const auto& [label, kind] : painter.kinds())
    entry(fmt::format("{} ({})", label, kind.first), [&, colour = kind.second](glm::dvec2 at) {
      page.path({at + glm::dvec2(1, -1.5), at + glm::dvec2(7, -1.5), at + glm::dvec2(7, 1.5),
                 at + glm::dvec2(1, 1.5)},
                true);
      page.fill(colour, 0.8), page.stroke(0.25, black);
    });
  if (!plan.left_out.empty() && y < title_top - 20.0) {
    y += 3.0;
    page.text("Not on this plan", {left, y}, 2.0, width, true);
    y += 4.0;
    for (const std::string& note : plan.left_out)
      if (y < title_top - 8.0) y = page.paragraph(note, {left, y}, 1.7, width) + 0.6;
  }
  page.line({min.x, title_top}, {max.x, title_top}, 0.35, black);
  y = title_top + 10.0;
  page.text(sheet.title.empty() ? "Plan" : sheet.title, {left, y}, 4.0, width, true);
  if (!sheet.subtitle.empty()) page.text(sheet.subtitle, {left, y + 6.5}, 2.4, width);
  page.line({min.x, title_top + 22.0}, {max.x, title_top + 22.0}, 0.18, black);
  page.text(fmt::format("1:{:g}", sheet.scale), {left, title_top + 31.0}, 4.0, width, true);
  page.text(fmt::format("{} landscape, north up", sheet.paper), {left + 26.0, title_top + 31.0}, 2.0,
            width - 26.0);
  draw_scale_bar(page, {left, title_top + 36.0}, sheet.scale, width - 6.0);
  page.line({min.x, title_top + 46.0}, {max.x, title_top + 46.0}, 0.18, black);
  const std::string frame = plan.origin == glm::dvec3(0.0)             ? "the scene's own"
                            : plan.map.empty() || plan.map.size() > 40 ? "those of the map"
                                                                       : "those of " + plan.map;
  page.paragraph(fmt::format("Coordinates are {}, in metres. Print at 100 %, not fitted to the page.", frame),
                 {left, title_top + 51.0}, 1.7, width);
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
