#include "planning/plan_drawing/cairo_plan.h"

#include <fmt/format.h>

namespace parvis::plan_drawing {
namespace {

std::string metres(double value) {
  return value < 1.0 ? fmt::format("{:g} cm", 100.0 * value) : fmt::format("{:g} m", value);
}

}  // namespace

double round_number(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double digit : {5.0, 2.0, 1.0})
    if (digit * power <= value) return digit * power;
  return power;
}

void draw_north(const Page& page, glm::dvec2 foot) {
  constexpr double length = 18.0, half = 4.0;
  const glm::dvec2 tip = foot - glm::dvec2(0, length), notch = foot - glm::dvec2(0, 0.25 * length);
  page.path({tip, foot - glm::dvec2(half, 0), notch}, true), page.fill(black), page.stroke(0.18, black);
  page.path({tip, foot + glm::dvec2(half, 0), notch}, true), page.stroke(0.18, black);
  page.text("N", tip - glm::dvec2(0.5 * page.text_width("N", 3.5, true), 1.5), 3.5, 20.0, true);
}

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

void Page::picture(const Image8& image, const std::string& jpeg, glm::dvec2 min, glm::dvec2 size_mm) const {
  const int stride = cairo_format_stride_for_width(CAIRO_FORMAT_RGB24, image.width);
  std::vector<unsigned char> pixels(std::size_t(stride) * std::size_t(image.height));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* const from = image.at(x, y);
      unsigned char* const to = pixels.data() + std::size_t(y) * std::size_t(stride) + 4u * std::size_t(x);
      to[0] = from[2], to[1] = from[1], to[2] = from[0], to[3] = 0xff;  // little-endian xRGB
    }
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
      cairo_image_surface_create_for_data(pixels.data(), CAIRO_FORMAT_RGB24, image.width, image.height,
                                          stride),
      &cairo_surface_destroy);
  if (!jpeg.empty()) {
    // Cairo keeps the bytes until the surface is written out, which is after this function.
    std::string* const kept = std::make_unique<std::string>(jpeg).release();
    cairo_surface_set_mime_data(
        surface.get(), CAIRO_MIME_TYPE_JPEG,
        reinterpret_cast<const unsigned char*>(
            kept->data()),  // NOLINT(cppcoreguidelines-pro-type-reinterpret-cast)
        kept->size(), [](void* data) { delete static_cast<std::string*>(data); }, kept);
  }
  cairo_save(context());
  cairo_translate(context(), min.x, min.y);
  cairo_scale(context(), size_mm.x / image.width, size_mm.y / image.height);
  cairo_set_source_surface(context(), surface.get(), 0.0, 0.0);
  cairo_pattern_set_filter(cairo_get_source(context()),
                           jpeg.empty() ? CAIRO_FILTER_NEAREST : CAIRO_FILTER_GOOD);
  cairo_paint(context());
  cairo_restore(context());
  cairo_surface_flush(surface.get());
}

}  // namespace parvis::plan_drawing
