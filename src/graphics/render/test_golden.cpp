#include "graphics/render/test_golden.h"

#include <algorithm>
#include <cstdlib>

#include "base/files.h"
#include "base/image_io.h"

namespace parvis::render {
namespace {

struct Difference {
  int maximum = 0;
  double failing_fraction = 0.0, mean = 0.0;
  Image8 picture;  ///< eight times as strong
};

Difference difference_between(const Image8& a, const Image8& b, int failing_difference) {
  Difference difference;
  difference.picture = Image8(a.width, a.height, 3);
  double failing = 0.0, sum = 0.0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      int worst = 0;
      for (int c = 0; c < 3; ++c) {
        const int step = std::abs(int(a.at(x, y)[c]) - int(b.at(x, y)[c]));
        difference.picture.at(x, y)[c] = std::uint8_t(std::min(8 * step, 255));
        worst = std::max(worst, step);
      }
      difference.maximum = std::max(difference.maximum, worst);
      failing += worst > failing_difference;
      sum += worst;
    }
  const double pixels = double(a.width) * double(a.height);
  difference.failing_fraction = failing / pixels;
  difference.mean = sum / pixels;
  return difference;
}

std::string page(const std::string& name, const std::string& message) {
  const auto figure = [&](const char* kind) {
    return fmt::format("<figure><img src=\"{0}-{1}.png\"><figcaption>{1}</figcaption></figure>\n", name,
                       kind);
  };
  return fmt::format(
      "<!doctype html>\n<meta charset=\"utf-8\"><title>{0}</title>\n"
      "<style>figure {{ display: inline-block; margin: 4px }} img {{ max-width: 32vw }}</style>\n"
      "<h1>{0}</h1>\n<p>{1}</p>\n{2}{3}{4}",
      name, message, figure("actual"), figure("expected"), figure("difference"));
}

/// Writes what a person needs to judge the failure, and says where.
Status failure(const std::string& name, const std::string& message, const std::filesystem::path& folder,
               const Image8& actual, const Image8& expected, const Image8& difference) {
  std::error_code ignored;
  std::filesystem::create_directories(folder, ignored);
  for (const Status& written : {write_image(folder / (name + "-actual.png"), actual),
                                write_image(folder / (name + "-expected.png"), expected),
                                write_image(folder / (name + "-difference.png"), difference),
                                write_file(folder / (name + ".html"), page(name, message))})
    if (!written) return written.errors();
  return error("{}: {}; see {}", name, message, (folder / (name + ".html")).string());
}

}  // namespace

Status matches_golden(const Image8& actual, const std::string& name, const GoldenTolerance& tolerance,
                      const std::filesystem::path& source_folder) {
  const std::filesystem::path golden = source_folder / "docs/goldens" / (name + ".png");
  if (std::getenv("PARVIS_UPDATE_GOLDENS")) {
    std::error_code ignored;
    std::filesystem::create_directories(golden.parent_path(), ignored);
    return write_image(golden, actual);
  }
  const Result<Image8> expected = read_image8(golden);
  if (!expected) return expected.errors();

  const std::filesystem::path folder = source_folder / "build/golden-failures";
  if (expected->width != actual.width || expected->height != actual.height)
    return failure(name,
                   fmt::format("is {}x{}, expected {}x{}", actual.width, actual.height, expected->width,
                               expected->height),
                   folder, actual, *expected, *expected);
  const Difference difference = difference_between(actual, *expected, tolerance.failing_difference);
  if (difference.maximum <= tolerance.max_difference &&
      difference.failing_fraction <= tolerance.failing_fraction &&
      difference.mean <= tolerance.mean_difference)
    return Ok{};
  return failure(
      name,
      fmt::format("differs by {} at most (allowed {}), {:.4f} of the pixels fail (allowed {}), mean {:.4f} "
                  "(allowed {})",
                  difference.maximum, tolerance.max_difference, difference.failing_fraction,
                  tolerance.failing_fraction, difference.mean, tolerance.mean_difference),
      folder, actual, *expected, difference.picture);
}

}  // namespace parvis::render
