#include "planning/plan_drawing/cairo_module.h"

#include <cairo.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

namespace parvis::plan_drawing {
namespace {

constexpr double font_size = 100.0;                  // cairo's outlines are rounded to 1/256
constexpr double capital_height = 0.72 * font_size;  // of which DXF gives the height
constexpr double line_spacing = 5.0 / 3.0;           // of the height, as the DXF reference has it
constexpr double max_text_height_m = 1000.0;

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

using Rings = std::vector<std::vector<glm::dvec2>>;

/// The present path of the context as rings.
Rings rings_of(cairo_t* context) {
  Rings rings;
  const std::unique_ptr<cairo_path_t, decltype(&cairo_path_destroy)> path(cairo_copy_path_flat(context),
                                                                          &cairo_path_destroy);
  for (int i = 0; i < path->num_data; i += path->data[i].header.length) {
    const cairo_path_data_t* const data = path->data + i;
    if (data->header.type == CAIRO_PATH_MOVE_TO) rings.emplace_back();
    if (data->header.type != CAIRO_PATH_CLOSE_PATH && !rings.empty())
      rings.back().emplace_back(data[1].point.x, -data[1].point.y);
  }
  for (std::vector<glm::dvec2>& ring : rings)
    if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  std::erase_if(rings, [](const std::vector<glm::dvec2>& ring) { return ring.size() < 3; });
  return rings;
}

/// The characters of a text in UTF-8, one string each.
std::vector<std::string> characters_of(const std::string& text) {
  std::vector<std::string> characters;
  for (const char c : text)
    if ((static_cast<unsigned char>(c) & 0xc0) == 0x80 && !characters.empty())
      characters.back() += c;
    else
      characters.emplace_back(1, c);
  return characters;
}

/// The letters of a line from its left end on its base line, in the font's units, and the line's width.
std::pair<std::vector<Rings>, double> letters_of(cairo_t* context, const std::string& line) {
  std::vector<Rings> letters;
  double pen = 0.0;
  for (const std::string& character : characters_of(line)) {
    cairo_new_path(context);
    // Each at the origin: cairo leaves out letters more than ten sizes beside its surface.
    cairo_move_to(context, 0.0, 0.0);
    cairo_text_path(context, character.c_str());
    Rings rings = rings_of(context);
    for (std::vector<glm::dvec2>& ring : rings)
      for (glm::dvec2& corner : ring) corner.x += pen;
    if (!rings.empty()) letters.push_back(std::move(rings));
    cairo_text_extents_t extents;
    cairo_text_extents(context, character.c_str(), &extents);
    pen += extents.x_advance;
  }
  return {std::move(letters), pen};
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines(1);
  for (const char c : text)
    if (c == '\n')
      lines.emplace_back();
    else
      lines.back() += c;
  return lines;
}

TextOutlines outlines_of(const formats::DrawingText& text) {
  TextOutlines placed;
  if (!(text.height_m > 0.0 && text.height_m < max_text_height_m)) return placed;
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1), &cairo_surface_destroy);
  const Context context(cairo_create(surface.get()), &cairo_destroy);
  cairo_select_font_face(context.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context.get(), font_size);
  cairo_set_tolerance(context.get(), 0.5);
  const double metres = text.height_m / capital_height;
  const double angle = text.angle_deg * std::numbers::pi / 180.0;
  const glm::dvec2 along(std::cos(angle), std::sin(angle)), up(-along.y, along.x);
  const std::vector<std::string> lines = lines_of(text.text);
  const double height = capital_height * (1.0 + line_spacing * double(lines.size() - 1));
  double base = height * (1.0 - text.anchor.y) - capital_height;  // of the first line, above the position
  for (const std::string& line : lines) {
    const auto [letters, width] = letters_of(context.get(), line);
    for (const Rings& letter : letters) {
      auto& rings = placed.emplace_back();
      for (const std::vector<glm::dvec2>& ring : letter) {
        auto& corners = rings.emplace_back();
        for (const glm::dvec2 corner : ring) {
          const glm::dvec2 away = metres * (corner + glm::dvec2(-text.anchor.x * width, base));
          corners.push_back(text.position + glm::dvec3(away.x * along + away.y * up, 0.0));
        }
      }
    }
    base -= line_spacing * capital_height;
  }
  return placed;
}

}  // namespace
}  // namespace parvis::plan_drawing

PARVIS_MODULE(parvis::plan_drawing::CairoFunctions){parvis::plan_drawing::outlines_of,
                                                    parvis::plan_drawing::draw_sheet,
                                                    parvis::plan_drawing::draw_council_sheet};
