#include "base/image_text.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <array>
#include <filesystem>

namespace parvis {
namespace {

/// The window's fonts (viewer/theme.cpp); empty: the machine has neither.
const std::string& font_file() {
  static const std::string found = [] {
    for (const char* file : {"/usr/share/fonts/opentype/inter/Inter-Regular.otf",
                             "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"})
      if (std::filesystem::exists(file)) return std::string(file);
    return std::string();
  }();
  return found;
}

}  // namespace

void write_text(Image8& picture, glm::ivec2 at, const std::string& text, int height_px, glm::u8vec3 colour) {
  if (font_file().empty() || text.empty()) return;
  OIIO::ImageBuf canvas(
      OIIO::ImageSpec(picture.width, picture.height, picture.channels, OIIO::TypeDesc::UINT8),
      picture.pixels.data());
  const std::array<float, 4> rgba{float(colour.x) / 255.0f, float(colour.y) / 255.0f,
                                  float(colour.z) / 255.0f, 1.0f};
  OIIO::ImageBufAlgo::render_text(canvas, at.x, at.y, text, height_px, font_file(), rgba);
}

int text_width(const std::string& text, int height_px) {
  if (font_file().empty() || text.empty()) return 0;
  return OIIO::ImageBufAlgo::text_size(text, height_px, font_file()).width();
}

}  // namespace parvis
