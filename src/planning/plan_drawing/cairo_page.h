// A page of a PDF through cairo, for the sources of this room's module. Cairo draws no line of width 0.
#pragma once

#include <cairo-pdf.h>

#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/result.h"

namespace parvis::plan_drawing {

inline constexpr double point_per_mm = 72.0 / 25.4;

/// sRGB, 0 to 1.
struct Colour {
  double red, green, blue;
};
inline constexpr Colour black{0, 0, 0}, grey{0.45, 0.45, 0.45}, pale{0.86, 0.86, 0.86},
    green{0.18, 0.45, 0.2}, blue{0.15, 0.3, 0.6}, crimson{0.7, 0.05, 0.35};

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

  /// The context, for drawings that the functions below do not offer.
  cairo_t* context() const { return context_.get(); }
  /// Sets the colour of the next drawing.
  void set(const Colour& colour, double alpha = 1.0) const {
    cairo_set_source_rgba(context(), colour.red, colour.green, colour.blue, alpha);
  }
  /// Begins a path.
  void path(const std::vector<glm::dvec2>& points, bool is_closed) const {
    cairo_new_path(context());
    for (const glm::dvec2& point : points) cairo_line_to(context(), point.x, point.y);
    if (is_closed) cairo_close_path(context());
  }
  /// Draws the path, which ends.
  void stroke(double width_mm, const Colour& colour) const {
    set(colour);
    cairo_set_line_width(context(), width_mm);
    cairo_stroke(context());
  }
  /// Fills the path, which stays.
  void fill(const Colour& colour, double alpha = 1.0) const {
    set(colour, alpha);
    cairo_fill_preserve(context());
  }
  /// Draws a line.
  void line(glm::dvec2 from, glm::dvec2 to, double width_mm, const Colour& colour) const {
    path({from, to}, false), stroke(width_mm, colour);
  }
  /// Draws a rectangle.
  void box(glm::dvec2 min, glm::dvec2 max, double width_mm, const Colour& colour) const {
    path({min, {max.x, min.y}, max, {min.x, max.y}}, true), stroke(width_mm, colour);
  }
  /// Width of a line of text.
  double text_width(const std::string& text, double height_mm, bool is_bold = false) const {
    font(height_mm, is_bold);
    cairo_text_extents_t extents;
    cairo_text_extents(context(), text.c_str(), &extents);
    return extents.x_advance;
  }
  /// Writes a text on its base line; made smaller where it is wider than `max_width_mm`.
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
  /// A picture in a rectangle; `jpeg`, the same as JPEG, is what the file holds; empty: its pixels, each a
  /// sharp square.
  void picture(const Image8& image, const std::string& jpeg, glm::dvec2 min, glm::dvec2 size_mm) const;
  /// Ends the page; what follows lies on the next one.
  void next() const { cairo_show_page(context()); }
  /// Ends the last page and the file. Errors: it cannot be written.
  Status finish() const {
    cairo_show_page(context());
    cairo_surface_finish(surface_.get());
    const cairo_status_t status = cairo_surface_status(surface_.get());
    if (status != CAIRO_STATUS_SUCCESS)
      return error("the plan could not be written ({})", cairo_status_to_string(status));
    return Ok{};
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

}  // namespace parvis::plan_drawing
