#include "base/image_text.h"

#include <cmath>
#include <cstring>
#include <filesystem>

#include "base/isolated_process.h"
#include "base/openimageio_module.h"

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

/// The header of what a worker returns; the covered pixels follow.
struct TextHeader {
  glm::ivec2 corner, size;
};

/// The work of a worker. The input is the height of the letters and the text.
Status cover_in_worker(std::string_view input, IsolatedOutput& output) {
  int height_px = 0;
  std::memcpy(&height_px, input.data(), sizeof height_px);
  const Result<TextCoverage> text = openimageio.call(
      &OpenImageIoFunctions::cover_text, std::string(input.substr(sizeof height_px)), height_px, font_file());
  if (!text) return text.errors();
  const Image8& covered = text->coverage;
  const TextHeader header{text->corner, {covered.width, covered.height}};
  const std::span<std::byte> to = output.allocate(sizeof header + covered.pixels.size());
  if (to.empty()) return error("there is no memory for a line of text");
  std::memcpy(to.data(), &header, sizeof header);
  std::memcpy(to.data() + sizeof header, covered.pixels.data(), covered.pixels.size());
  return Ok{};
}

/// Empty where the machine has no font, or the library for it is missing.
TextCoverage coverage_of(const std::string& text, int height_px) {
  if (font_file().empty() || text.empty()) return {};
  const std::string_view height(reinterpret_cast<const char*>(&height_px), sizeof height_px);
  const Result<IsolatedBytes> made = run_isolated(cover_in_worker, {height, text}, "a line of text",
                                                  {.readable = {font_file()}, .writes = true});
  TextHeader header{};
  if (!made || made->bytes().size() < sizeof header) return {};
  std::memcpy(&header, made->bytes().data(), sizeof header);
  const std::span<const std::byte> covered = made->bytes().subspan(sizeof header);
  if (covered.empty() || header.size.x < 1 || covered.size() % std::size_t(header.size.x) != 0 ||
      covered.size() / std::size_t(header.size.x) != std::size_t(header.size.y))
    return {};
  TextCoverage result{header.corner, Image8(header.size.x, header.size.y, 1)};
  std::memcpy(result.coverage.pixels.data(), covered.data(), covered.size());
  return result;
}

}  // namespace

void write_text(Image8& picture, glm::ivec2 at, const std::string& text, int height_px, glm::u8vec3 colour) {
  const TextCoverage letters = coverage_of(text, height_px);
  const glm::ivec2 corner = at + letters.corner;
  const glm::ivec2 first = glm::max(corner, glm::ivec2(0)),
                   end = glm::min(corner + glm::ivec2(letters.coverage.width, letters.coverage.height),
                                  glm::ivec2(picture.width, picture.height));
  const glm::vec4 ink(glm::vec3(colour), 255.0f);
  for (int y = first.y; y < end.y; ++y)
    for (int x = first.x; x < end.x; ++x) {
      const float covered = float(*letters.coverage.at(x - corner.x, y - corner.y)) / 255.0f;
      std::uint8_t* const pixel = picture.at(x, y);
      for (int c = 0; c < picture.channels; ++c)
        pixel[c] = std::uint8_t(std::lround(covered * ink[c] + (1.0f - covered) * float(pixel[c])));
    }
}

int text_width(const std::string& text, int height_px) { return coverage_of(text, height_px).coverage.width; }

}  // namespace parvis
