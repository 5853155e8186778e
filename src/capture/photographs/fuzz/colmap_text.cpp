// Any text as a COLMAP model: a set or errors. A line of dashes separates the three files.
#include <algorithm>

#include "capture/photographs/colmap_set.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace parvis::photographs;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  constexpr std::string_view between = "\n---\n";
  const std::size_t first = std::min(text.find(between), size);
  const std::size_t images = std::min(first + between.size(), size);
  const std::size_t second = std::min(text.find(between, images), size);
  const std::size_t points = std::min(second + between.size(), size);
  const ColmapFiles files{std::string(text.substr(0, first)),
                          std::string(text.substr(images, second - images)),
                          std::string(text.substr(points))};
  if (const auto model = parse_colmap_text(files, ""))
    (void)colmap_model_of(photograph_set_of(*model, "").set);
  return 0;
}
