// The formula of referencePoint and orientation is that of OGC 12-019 (CityGML 2.0), section 9.4: a point of
// the plan less the reference point, times the matrix, is the place in the picture from its lower left
// corner.
#include "formats/city_models/georeferenced_textures.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/files.h"
#include "base/image_io.h"
#include "formats/city_models/city_assembly.h"

namespace parvis::scene {
namespace {

constexpr std::string_view texture_element = "GeoreferencedTexture";
constexpr std::string_view blank_letters = " \t\r\n";
constexpr std::size_t max_named = 3;  // pictures in one warning
constexpr std::uint64_t max_world_file_bytes = 4096;

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blank_letters);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank_letters) - first + 1);
}

/// True if the name at this place begins an element, with or without a prefix.
bool begins_element(std::string_view xml, std::size_t at) {
  constexpr std::size_t longest_prefix = 64;
  if (at == 0 || (xml[at - 1] != '<' && xml[at - 1] != ':')) return false;
  const std::size_t first = at - std::min(at, longest_prefix);
  const std::string_view before = xml.substr(first, at - first);
  const std::size_t tag = before.rfind('<');
  return tag != std::string_view::npos && before.find_first_of("/>", tag) == std::string_view::npos;
}

/// The text within the next element of this name, whatever its prefix, from `at` on, which moves behind it.
/// Nothing where there is none.
std::optional<std::string_view> next_text(std::string_view xml, std::string_view name, std::size_t& at) {
  for (at = xml.find(name, at); at != std::string_view::npos; at = xml.find(name, at)) {
    const bool begins = begins_element(xml, at);
    at += name.size();
    if (!begins || at >= xml.size() || (xml[at] != '>' && blank_letters.find(xml[at]) == blank_letters.npos))
      continue;
    const std::size_t opened = xml.find('>', at);
    if (opened == std::string_view::npos) break;
    const std::size_t end = xml.find('<', opened);
    at = std::min(end, xml.size());
    return trimmed(xml.substr(opened + 1, at - opened - 1));
  }
  at = xml.size();
  return std::nullopt;
}

std::optional<std::string_view> first_text(std::string_view xml, std::string_view name) {
  std::size_t at = 0;
  return next_text(xml, name, at);
}

/// All numbers of a text; none where something else stands among them.
std::vector<double> numbers_in(std::string_view text) {
  constexpr std::size_t enough = 8;
  std::vector<double> numbers;
  for (std::size_t at = text.find_first_not_of(blank_letters);
       at != std::string_view::npos && numbers.size() < enough;
       at = text.find_first_not_of(blank_letters, at)) {
    if (text[at] == '+') ++at;
    double number = 0.0;
    const auto [end, problem] = std::from_chars(text.data() + at, text.data() + text.size(), number);
    if (problem != std::errc() || !std::isfinite(number)) return {};
    numbers.push_back(number);
    at = std::size_t(end - text.data());
  }
  return numbers;
}

bool is_regular(const glm::dmat2& matrix) {
  const double area = std::abs(glm::determinant(matrix));
  return std::isfinite(area) && area > 0.0;
}

/// Reads referencePoint and orientation, row after row.
void read_elements(std::string_view xml, GeoreferencedTexture& texture) {
  const std::vector<double> orientation = numbers_in(first_text(xml, "orientation").value_or("")),
                            point = numbers_in(first_text(xml, "pos").value_or(""));
  if (orientation.size() != 4 || point.size() < 2) return;
  const double &a = orientation[0], &b = orientation[1], &c = orientation[2], &d = orientation[3];
  const glm::dmat2 st_from_plan(a, c, b, d);
  if (!is_regular(st_from_plan)) return;
  if (glm::determinant(st_from_plan) < 0.0)
    texture.as_world_file = {a, c, b, d, point[0], point[1]};
  else  // the picture's own t runs upward
    texture.placed = {glm::dmat2(a, -c, b, -d), {point[0], point[1]}, {0.0, 1.0}};
}

/// ESRI's names of the world file of a picture.
std::vector<std::string> world_files_of(const std::string& picture) {
  const auto renamed = [&](const std::string& extension) {
    return std::filesystem::path(picture).replace_extension(extension).string();
  };
  const std::string extension = std::filesystem::path(picture).extension().string();  // with its dot
  std::vector<std::string> names{picture + "w", renamed(".wld")};
  if (extension.size() > 3) names.insert(names.begin(), renamed({'.', extension[1], extension.back(), 'w'}));
  return names;
}

/// The map given by the numbers of a world file: the step of a column, of a row, and the middle of the first
/// pixel.
std::optional<PlanToPicture> placed_by_numbers(const std::vector<double>& n, glm::ivec2 size_px) {
  if (n.size() != 6) return std::nullopt;
  const glm::dmat2 plan_from_pixels(n[0], n[1], n[2], n[3]);
  if (!is_regular(plan_from_pixels)) return std::nullopt;
  const glm::dvec2 pixel_uv = 1.0 / glm::dvec2(size_px);
  glm::dmat2 uv_from_plan = glm::inverse(plan_from_pixels);
  for (int column = 0; column < 2; ++column) uv_from_plan[column] *= pixel_uv;
  return PlanToPicture{uv_from_plan, {n[4], n[5]}, 0.5 * pixel_uv};
}

std::optional<PlanToPicture> placed_by_world_file(const Roots& roots, const std::string& picture,
                                                  glm::ivec2 size_px) {
  for (const std::string& name : world_files_of(picture)) {
    const Result<std::filesystem::path> path = city_picture_path(roots, name);
    if (!path) continue;
    const Result<std::string> text = read_file(*path, max_world_file_bytes);
    if (!text) continue;
    if (const auto placed = placed_by_numbers(numbers_in(*text), size_px)) return placed;
  }
  return std::nullopt;
}

/// False where nothing says where the picture lies, or there is none.
bool find_place(GeoreferencedTexture& texture, const Roots& roots) {
  if (texture.targets.empty()) return false;
  const Result<std::filesystem::path> path = city_picture_path(roots, texture.picture);
  if (!path) return false;
  if (texture.placed) return true;
  const Result<Image8> picture = read_image8(*path);  // for its size, in pixels
  if (!picture) return false;
  const glm::ivec2 size_px(picture->width, picture->height);
  texture.placed = texture.as_world_file.empty() ? placed_by_world_file(roots, texture.picture, size_px)
                                                 : placed_by_numbers(texture.as_world_file, size_px);
  return texture.placed.has_value();
}

}  // namespace

std::vector<GeoreferencedTexture> georeferenced_textures(std::string_view xml) {
  std::vector<GeoreferencedTexture> textures;
  for (std::size_t at = xml.find(texture_element); at != std::string_view::npos;
       at = xml.find(texture_element, at + 1)) {
    if (!begins_element(xml, at)) continue;
    const std::string_view text =
        xml.substr(at, std::min(xml.find(texture_element, at + 1), xml.size()) - at);
    GeoreferencedTexture& texture = textures.emplace_back();
    texture.picture = first_text(text, "imageURI").value_or("");
    read_elements(text, texture);
    std::size_t in_text = 0;
    while (const auto target = next_text(text, "target", in_text))
      if (target->starts_with('#')) texture.targets.emplace_back(target->substr(1));
  }
  return textures;
}

std::vector<GeoreferencedTexture> placed_textures(std::vector<GeoreferencedTexture> textures, bool are_plane,
                                                  const std::filesystem::path& file, Errors& warnings) {
  const Roots roots(file.parent_path());
  std::vector<GeoreferencedTexture> placed;
  std::vector<std::string> left_out;
  for (GeoreferencedTexture& texture : textures)
    if (are_plane && find_place(texture, roots))
      placed.push_back(std::move(texture));
    else
      left_out.push_back(texture.picture);
  if (left_out.empty()) return placed;
  const std::size_t count = left_out.size();
  left_out.resize(std::min(count, max_named));
  warnings.push_back(error_at(
      {file.string(), 0, 0},
      "pictures that lie on it by their coordinates are left out ({} GeoreferencedTexture: {}), and what "
      "they cover is plain: put each and its world file (aerial.jgw for aerial.jpg) beside it, in metres as "
      "the file's own coordinates, or export them as ParameterizedTexture, with texture coordinates",
      count, fmt::join(left_out, ", ")));
  return placed;
}

void BesidePictures::note(const GeoreferencedTexture& texture, std::span<const glm::vec2> corners_uv) {
  if (corners_uv.empty()) return;
  ++covered_;
  glm::vec2 low = corners_uv.front(), high = low;
  for (const glm::vec2 uv : corners_uv) low = glm::min(low, uv), high = glm::max(high, uv);
  if (high.x > 0.0f && high.y > 0.0f && low.x < 1.0f && low.y < 1.0f) return;
  ++beside_;
  if (pictures_.size() < max_named && std::ranges::find(pictures_, texture.picture) == pictures_.end())
    pictures_.push_back(texture.picture);
}

void BesidePictures::report(const std::filesystem::path& file, Errors& warnings) const {
  if (beside_ == 0) return;
  warnings.push_back(
      error_at({file.string(), 0, 0},
               "{} of {} polygons that a picture covers by its coordinates lie wholly beside it "
               "(GeoreferencedTexture: "
               "{}), and show its edge alone: check its referencePoint and orientation, or its world file",
               beside_, covered_, fmt::join(pictures_, ", ")));
}

}  // namespace parvis::scene
