#include "planning/plan_drawing/world_file.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/files.h"
#include "formats/drawings/group_codes.h"

namespace parvis::plan_drawing {
namespace {
namespace fs = std::filesystem;

constexpr std::uint64_t max_world_file_bytes = 64 << 10;
constexpr double farthest = 1e12;

/// ".pgw" and ".pngw" of ".png", in the case of the picture's extension and in lower case; then ".wld".
std::vector<std::string> extensions_of(const std::string& extension) {
  std::vector<std::string> all;
  if (extension.size() >= 3) all = {fmt::format(".{}{}w", extension[1], extension.back()), extension + "w"};
  all.emplace_back(".wld");
  return all;
}

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return text;
}

/// Finds a file beside the picture, without regard to the case of the extension.
fs::path found_beside(const fs::path& picture, const std::vector<std::string>& extensions) {
  std::error_code code;
  for (const fs::directory_entry& entry : fs::directory_iterator(picture.parent_path(), code)) {
    const fs::path& file = entry.path();
    // A link could lead out of the folders that the scene may read.
    if (file.stem() != picture.stem() || entry.is_symlink(code)) continue;
    if (std::ranges::find(extensions, lower(file.extension().string())) != extensions.end()) return file;
  }
  return {};
}

}  // namespace

Result<WorldFile> read_world_file(const fs::path& picture) {
  const std::vector<std::string> extensions = extensions_of(lower(picture.extension().string()));
  const fs::path file = found_beside(picture, extensions);
  if (file.empty())
    return error_at(
        {picture.string(), 0, 0},
        "no world file lies beside this picture, so nobody knows where it lies and how large it is; "
        "write {}{}: six lines, the metres per pixel to the right, two numbers for its turn (0), the "
        "metres per pixel down (negative), and x and y of the middle of the upper left pixel",
        picture.stem().string(), extensions.front());
  const Result<std::string> text = read_file(file, max_world_file_bytes);
  if (!text) return text.errors();
  std::vector<double> numbers;
  std::string word;
  for (const char c : *text + "\n") {
    if (!std::isspace(static_cast<unsigned char>(c))) {
      word += c == ',' ? '.' : c;
      continue;
    }
    if (!word.empty()) numbers.push_back(formats::number_of(word, std::numeric_limits<double>::infinity()));
    word.clear();
  }
  const auto is_usable = [](double number) { return std::abs(number) < farthest; };
  if (numbers.size() != 6 || !std::ranges::all_of(numbers, is_usable))
    return error_at({file.string(), 0, 0}, "expected six numbers, one on each line");
  const WorldFile world{{numbers[0], numbers[1]}, {numbers[2], numbers[3]}, {numbers[4], numbers[5]}};
  if (!(std::abs(world.across.x * world.down.y - world.across.y * world.down.x) > 0.0))
    return error_at({file.string(), 1, 0}, "its pixels have no area: lines 1 and 4 are the sizes of a pixel");
  return world;
}

}  // namespace parvis::plan_drawing
