// The sheet that compares two designs, as PDF: pictures, plan with a table, hours of sun.
#include <array>

#include "planning/plan_drawing/cairo_module.h"
#include "planning/plan_drawing/cairo_plan.h"

namespace parvis::plan_drawing {
namespace {

constexpr glm::dvec2 page_mm(420.0, 297.0);
constexpr double edge_mm = 12.0, head_mm = 24.0, foot_mm = 9.0;
constexpr double link_mm = 30.0;  // side of a QR code with its quiet zone
constexpr double top_mm = edge_mm + head_mm, bottom_mm = page_mm.y - edge_mm - foot_mm;
constexpr double gap_mm = 6.0;
constexpr Colour dim{0.36, 0.36, 0.36}, hair{0.75, 0.75, 0.75};

/// How each difference is drawn, in the order of design::Differs.
struct Mark {
  const char* word;
  Colour colour;
};
constexpr std::array marks{Mark{"Added", {0.10, 0.55, 0.22}}, Mark{"Removed", {0.80, 0.13, 0.12}},
                           Mark{"Moved", {0.12, 0.38, 0.80}}, Mark{"Changed", {0.75, 0.55, 0.0}}};

const Mark& mark_of(design::Differs how) { return marks[std::size_t(how)]; }

/// Head and foot of a page.
void draw_frame(const Page& page, const CouncilSheet& sheet, const std::string& heading, int number,
                int count) {
  const double width = page_mm.x - 2.0 * edge_mm;
  page.text(sheet.title, {edge_mm, edge_mm + 8.0}, 5.6, width - 90.0, true);
  page.text(heading, {edge_mm, edge_mm + 16.5}, 3.4, width - 90.0, false, dim);
  const std::string designs = fmt::format("{} \u2192 {}", sheet.before, sheet.after);
  page.text(designs,
            {page_mm.x - edge_mm - std::min(86.0, page.text_width(designs, 3.4, true)), edge_mm + 8.0}, 3.4,
            86.0, true);
  page.line({edge_mm, edge_mm + 20.0}, {page_mm.x - edge_mm, edge_mm + 20.0}, 0.35, black);
  const double base = page_mm.y - edge_mm;
  page.line({edge_mm, base - 5.5}, {page_mm.x - edge_mm, base - 5.5}, 0.18, hair);
  page.text(sheet.subtitle, {edge_mm, base}, 2.2, width - 40.0, false, dim);
  const std::string place = sheet.words.format("page {} of {}", number, count);
  page.text(place, {page_mm.x - edge_mm - page.text_width(place, 2.2), base}, 2.2, 40.0, false, dim);
}

/// "3 removed, 5 added, 1 moved".
std::string counts_of(const CouncilSheet& sheet) {
  std::array<int, 4> counts{};
  for (const DifferenceRow& row : sheet.rows) counts[std::size_t(row.how)] += row.count;
  std::string text;
  for (const auto& [how, word] : {std::pair(1, "{} removed"), std::pair(0, "{} added"),
                                  std::pair(2, "{} moved"), std::pair(3, "{} changed")})
    if (counts[std::size_t(how)] > 0)
      text += (text.empty() ? "" : ", ") + sheet.words.format(word, counts[std::size_t(how)]);
  return text;
}

void draw_pair(const Page& page, const CouncilSheet& sheet, const ViewPair& pair, double y, double width) {
  const double height = width * pair.before.image.height / pair.before.image.width;
  double x = edge_mm;
  for (const auto& [picture, design] :
       {std::pair(&pair.before, &sheet.before), std::pair(&pair.after, &sheet.after)}) {
    page.text(fmt::format("{}: {}", pair.name, *design), {x, y + 4.2}, 2.6, width, picture == &pair.after);
    page.picture(picture->image, picture->jpeg, {x, y + 6.0}, {width, height});
    page.box({x, y + 6.0}, {x + width, y + 6.0 + height}, 0.18, dim);
    x += width + gap_mm;
  }
}

/// Its outline, filled faintly.
void draw_marked(const Page& page, const Viewport& view, const design::PlacedObject& object,
                 const Colour& colour, double alpha, bool is_dashed) {
  std::vector<glm::dvec2> points;
  for (const glm::dvec2& corner : object.outline) points.push_back(view.on_page(corner));
  if (points = cut_at(view, points); points.size() < 3) return;
  page.path(points, true);
  page.fill(colour, alpha);
  constexpr std::array dashes{1.6, 1.0};
  if (is_dashed) cairo_set_dash(page.context(), dashes.data(), int(dashes.size()), 0.0);
  page.stroke(object.kind == "ground" ? 0.3 : 0.45, colour);
  cairo_set_dash(page.context(), nullptr, 0, 0.0);
}

void draw_way(const Page& page, const Viewport& view, const design::Difference& moved, const Colour& colour,
              const design::Words& words) {
  const glm::dvec2 from = view.on_page(glm::dvec2(moved.before.position)),
                   to = view.on_page(glm::dvec2(moved.after.position));
  const double length = glm::distance(from, to);
  if (length < 0.5) return;
  const glm::dvec2 along = (to - from) / length, across(-along.y, along.x);
  page.line(from, to, 0.3, colour);
  const double head = std::min(2.4, 0.5 * length);
  page.path({to, to - head * along + 0.4 * head * across, to - head * along - 0.4 * head * across}, true);
  page.set(colour), cairo_fill(page.context());
  const std::string text = words.format("{:.2f} m", moved.moved_m);
  page.text(text, 0.5 * (from + to) + glm::dvec2(1.0, -1.0), 1.9, 60.0, false, colour);
}

/// Surfaces first, then what is removed, and what stands there over all.
void draw_differences(const Page& page, const Viewport& view,
                      const std::vector<design::Difference>& differences, const design::Words& words) {
  for (const bool is_ground : {true, false})
    for (const design::Differs how :
         {design::Differs::removed, design::Differs::added, design::Differs::changed, design::Differs::moved})
      for (const design::Difference& each : differences) {
        if (each.how != how || (each.shown().kind == "ground") != is_ground) continue;
        const Colour& colour = mark_of(how).colour;
        if (how == design::Differs::moved) draw_marked(page, view, each.before, colour, 0.0, true);
        draw_marked(page, view, each.shown(), colour, is_ground ? 0.10 : 0.30,
                    how == design::Differs::removed);
        if (how == design::Differs::moved) draw_way(page, view, each, colour, words);
      }
}

/// Clips to a frame, for as long as it lives.
class Clip {
 public:
  Clip(const Page& page, glm::dvec2 min, glm::dvec2 max) : page_(page) {
    cairo_save(page.context());
    cairo_rectangle(page.context(), min.x, min.y, max.x - min.x, max.y - min.y);
    cairo_clip(page.context());
  }
  ~Clip() { cairo_restore(page_.context()); }
  Clip(const Clip&) = delete;
  Clip& operator=(const Clip&) = delete;

 private:
  const Page& page_;
};

void draw_legend_and_table(const Page& page, const CouncilSheet& sheet, glm::dvec2 min, glm::dvec2 max) {
  const double width = max.x - min.x;
  double y = min.y + 4.0;
  page.text(sheet.words("Legend"), {min.x, y}, 2.8, width, true);
  y += 6.5;
  for (const std::size_t how : {1u, 0u, 2u, 3u}) {
    const bool occurs = std::ranges::any_of(
        sheet.rows, [&](const DifferenceRow& row) { return std::size_t(row.how) == how; });
    if (!occurs) continue;
    const Mark& mark = marks[how];
    page.path({{min.x, y - 2.6}, {min.x + 7.0, y - 2.6}, {min.x + 7.0, y + 0.6}, {min.x, y + 0.6}}, true);
    page.fill(mark.colour, 0.3), page.stroke(0.45, mark.colour);
    page.text(sheet.words(mark.word), {min.x + 10.0, y}, 2.2, 40.0);
    y += 5.6;
  }
  draw_north(page, {max.x - 8.0, min.y + 24.0});
  draw_scale_bar(page, {min.x + 42.0, min.y + 16.0}, sheet.scale, width - 66.0);
  page.text(sheet.words.format("1:{:g} on A3", sheet.scale), {min.x + 42.0, min.y + 12.0}, 2.6, 40.0, true);
  y = std::max(y, min.y + 33.0) + 6.0;
  page.text(sheet.words("What changes"), {min.x, y}, 2.8, width, true);
  y += 3.0;
  const std::array columns{min.x, min.x + 19.0, min.x + 55.0, min.x + 66.0};
  page.line({min.x, y}, {max.x, y}, 0.18, black);
  constexpr double row_mm = 5.4;
  std::size_t shown = 0;
  for (const DifferenceRow& row : sheet.rows) {
    if (y + 2.0 * row_mm > max.y) break;
    y += row_mm;
    page.text(sheet.words(mark_of(row.how).word), {columns[0], y - 1.6}, 2.1, 18.0, true,
              mark_of(row.how).colour);
    page.text(row.label, {columns[1], y - 1.6}, 2.1, 35.0);
    page.text(fmt::format("{}", row.count), {columns[2], y - 1.6}, 2.1, 10.0);
    page.text(row.detail, {columns[3], y - 1.6}, 2.1, max.x - columns[3]);
    page.line({min.x, y}, {max.x, y}, 0.1, hair);
    ++shown;
  }
  if (shown < sheet.rows.size())
    page.text(sheet.words.format("and {} further kinds: parvis plan --compare lists all",
                                 sheet.rows.size() - shown),
              {min.x, y + 4.5}, 2.0, width, false, dim);
}

/// The code with its quiet zone, and the address below it, cut where it is too long.
void draw_link(const Page& page, const QrCode& code, glm::dvec2 corner, double width_mm) {
  const double module_mm = link_mm / double(code.side + 2 * QrCode::quiet_modules);
  const glm::dvec2 first = corner + module_mm * double(QrCode::quiet_modules);
  page.set(black);
  for (int y = 0; y < code.side; ++y)
    for (int x = 0; x < code.side; ++x)
      if (code.dark(x, y))
        cairo_rectangle(page.context(), first.x + module_mm * x, first.y + module_mm * y, module_mm,
                        module_mm);
  cairo_fill(page.context());
  page.text(code.link, corner + glm::dvec2(0.0, link_mm + 2.0), 2.0, width_mm, false, dim);
}

void draw_plan_page(const Page& page, const CouncilSheet& sheet) {
  const glm::dvec2 min(edge_mm, top_mm), max = min + council_plan_mm;
  const Viewport view{min, max, sheet.centre, sheet.scale};
  {
    const Clip clip(page, min, max);
    PlanPainter painter(page, view);
    painter.draw(sheet.plan);
    draw_differences(page, view, sheet.differences, sheet.words);
  }
  page.box(min, max, 0.35, black);
  const double left = max.x + gap_mm, right = page_mm.x - edge_mm;
  const double table_bottom = sheet.link ? bottom_mm - link_mm - 5.0 : bottom_mm;
  draw_legend_and_table(page, sheet, {left, min.y}, {right, table_bottom});
  if (sheet.link) draw_link(page, *sheet.link, {left, table_bottom + 2.0}, right - left);
}

void draw_scale_of(const Page& page, const Image8& colours, glm::dvec2 at, double width,
                   const std::string& least, const std::string& middle, const std::string& most) {
  constexpr double height = 4.0;
  page.picture(colours, "", at, {width, height});
  page.box(at, at + glm::dvec2(width, height), 0.18, dim);
  const double base = at.y + height + 3.6;
  page.text(least, {at.x, base}, 2.0);
  page.text(middle, {at.x + 0.5 * (width - page.text_width(middle, 2.0)), base}, 2.0);
  page.text(most, {at.x + width - page.text_width(most, 2.0), base}, 2.0);
}

void draw_figures(const Page& page, const CouncilSheet& sheet, const SunPictures& sun, glm::dvec2 at) {
  const std::array columns{at.x, at.x + 92.0, at.x + 122.0, at.x + 152.0};
  const std::array heads{std::string(), sheet.before, sheet.after, sheet.words("Change")};
  for (std::size_t k = 0; k < heads.size(); ++k) page.text(heads[k], {columns[k], at.y}, 2.3, 28.0, true);
  double y = at.y + 2.2;
  page.line({at.x, y}, {at.x + 182.0, y}, 0.18, black);
  for (const std::vector<std::string>& row : sun.figures) {
    y += 5.8;
    for (std::size_t k = 0; k < row.size(); ++k)
      page.text(row[k], {columns[k], y - 1.7}, 2.3, k == 0 ? 90.0 : 28.0);
    page.line({at.x, y}, {at.x + 182.0, y}, 0.1, hair);
  }
}

void draw_sun_page(const Page& page, const CouncilSheet& sheet, const SunPictures& sun) {
  const SunDifference& hours = *sheet.sun;
  const glm::dvec2 extent = hours.cell_m * glm::dvec2(hours.columns, hours.rows);
  constexpr double max_height = 150.0, caption_mm = 6.0;
  const double widest = (page_mm.x - 2.0 * edge_mm - 2.0 * gap_mm) / 3.0;
  const double mm_per_m = std::min(widest / extent.x, max_height / extent.y);
  const glm::dvec2 size = mm_per_m * extent;
  // What stands is drawn over the colours; of the designs, outlines alone.
  ScenePlan around = sheet.plan;
  around.texts.clear(), around.measured.clear(), around.placed.clear();
  std::erase_if(around.lines, [](const PlanLine& line) { return line.layer != PlanLayer::wall; });
  double x = edge_mm;
  for (const auto& [picture, caption, part] :
       {std::tuple(&sun.before, sheet.before, 0), std::tuple(&sun.after, sheet.after, 1),
        std::tuple(&sun.change, sheet.words("What changes"), 2)}) {
    const glm::dvec2 min(x, top_mm + caption_mm), max = min + size;
    page.text(caption, {x, top_mm + 3.8}, 2.8, widest, true);
    page.picture(*picture, "", min, size);
    const Viewport view{min, max, hours.corner + 0.5 * extent, 1000.0 / mm_per_m};
    {
      const Clip clip(page, min, max);
      PlanPainter(page, view).draw(around);
      const auto outline = [&](const design::PlacedObject& object) {
        if (object.outline.size() < 3 || object.kind == "ground") return;
        std::vector<glm::dvec2> points;
        for (const glm::dvec2& corner : object.outline) points.push_back(view.on_page(corner));
        page.path(points, true), page.stroke(0.18, black);
      };
      for (const design::PlacedObject& object : sheet.plan.placed) outline(object);
      for (const design::Difference& each : sheet.differences) {
        if (part != 1 && each.how != design::Differs::added) outline(each.before);
        if (part != 0 && each.how != design::Differs::removed) outline(each.after);
      }
    }
    page.box(min, max, 0.25, black);
    const glm::dvec2 below(x, max.y + 4.0);
    if (part < 2)
      draw_scale_of(page, sun.hours_scale, below, std::min(90.0, size.x), "0 h",
                    sheet.words.format("{:.1f} h", 0.5 * sun.max_hours),
                    sheet.words.format("{:.1f} h", sun.max_hours));
    else
      draw_scale_of(page, sun.change_scale, below, std::min(90.0, size.x),
                    sheet.words.format("{:g} h less", sun.max_change_h), sheet.words("as before"),
                    sheet.words.format("{:g} h more", sun.max_change_h));
    x += widest + gap_mm;
  }
  const double y = top_mm + caption_mm + size.y + 26.0;
  draw_figures(page, sheet, sun, {edge_mm, y});
  page.paragraph(
      sheet.words.format(
          "Hours of direct sun on the ground on {}, without clouds, 10 cm above the ground, in cells of "
          "{:.2f} m; "
          "buildings, plants and what the designs place cast their shadows, people and cars do not. Lines "
          "are walls 1 m above the ground and the outlines of what is placed. North is up.",
          sheet.sun_day, hours.cell_m),
      {edge_mm + 206.0, y}, 2.2, page_mm.x - 2.0 * edge_mm - 206.0);
}

}  // namespace

Status draw_council_sheet(const std::filesystem::path& file, const CouncilSheet& sheet,
                          const SunPictures& sun) {
  constexpr std::size_t per_page = 2;
  const Page page(file, page_mm);
  const double width = 0.5 * (page_mm.x - 2.0 * edge_mm - gap_mm);
  const std::size_t view_pages = (sheet.views.size() + per_page - 1) / per_page;
  const int count = int(view_pages) + 1 + (sheet.sun ? 1 : 0);
  int number = 1;
  for (std::size_t first = 0; first < sheet.views.size(); first += per_page, page.next()) {
    draw_frame(page, sheet, sheet.words("Before and after: ") + counts_of(sheet), number++, count);
    double y = top_mm - 1.0;
    for (std::size_t i = first; i < std::min(first + per_page, sheet.views.size()); ++i) {
      draw_pair(page, sheet, sheet.views[i], y, width);
      y += 0.5 * (bottom_mm - top_mm) + 1.0;
    }
  }
  draw_frame(page, sheet, sheet.words("Plan of what changes"), number++, count);
  draw_plan_page(page, sheet);
  if (sheet.sun) {
    page.next();
    draw_frame(page, sheet, sheet.words("Hours of sun"), number, count);
    draw_sun_page(page, sheet, sun);
  }
  return page.finish();
}

}  // namespace parvis::plan_drawing
