// COLMAP's text files. A line that starts with # is a comment; an image takes two lines, the second of which
// may be empty.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>

#include "capture/photographs/colmap_model.h"

namespace parvis::photographs {
namespace {

constexpr std::size_t max_problems = 20;

/// The lines of a file without comments.
class Lines {
 public:
  Lines(std::string_view text, std::string file) : rest_(text), file_(std::move(file)) {}

  /// The next line. `may_be_empty`: empty lines count, too.
  bool next(std::string_view& line, bool may_be_empty = false) {
    while (!rest_.empty()) {
      const std::size_t end = rest_.find('\n');
      line = rest_.substr(0, end);
      rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
      ++number_;
      while (!line.empty() && (line.back() == '\r' || line.back() == ' ' || line.back() == '\t'))
        line.remove_suffix(1);
      while (!line.empty() && (line.front() == ' ' || line.front() == '\t')) line.remove_prefix(1);
      if (may_be_empty || (!line.empty() && line.front() != '#')) return true;
    }
    return false;
  }
  FileLocation where() const { return {file_, number_, 0}; }

 private:
  std::string_view rest_;
  std::string file_;
  int number_ = 0;
};

std::string_view next_word(std::string_view& line) {
  while (!line.empty() && (line.front() == ' ' || line.front() == '\t')) line.remove_prefix(1);
  const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
  const std::string_view word = line.substr(0, end);
  line.remove_prefix(end);
  return word;
}

/// Reads a number off the front of `line`; false where there is none, or where a double is not finite.
template <class T>
bool take(std::string_view& line, T& value) {
  const std::string_view word = next_word(line);
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (code != std::errc() || end != word.data() + word.size()) return false;
  if constexpr (std::is_floating_point_v<T>) return std::isfinite(value);
  return true;
}

template <class... T>
bool take_all(std::string_view& line, T&... values) {
  return (take(line, values) && ...);
}

void parse_cameras(Lines lines, ColmapModel& model, Errors& problems) {
  std::string_view line;
  while (problems.size() < max_problems && lines.next(line)) {
    std::uint32_t id = 0;
    Lens lens;
    const bool has_id = take(line, id);
    const std::string_view name = next_word(line);
    const std::optional<LensModel> lens_model = lens_model_of_name(name);
    if (!has_id || !take_all(line, lens.width, lens.height) || lens.width < 1 || lens.height < 1) {
      problems.push_back(error_at(lines.where(), "expected CAMERA_ID MODEL WIDTH HEIGHT PARAMS..."));
      continue;
    }
    if (!lens_model) {
      problems.push_back(error_at(lines.where(),
                                  "camera model \"{}\" is none of COLMAP 3.8's; expected PINHOLE, "
                                  "SIMPLE_RADIAL, OPENCV, ...",
                                  std::string(name.substr(0, 40))));
      continue;
    }
    lens.model = *lens_model;
    const LensModelInfo& expected = info(lens.model);
    bool complete = true;
    for (int i = 0; i < expected.parameter_count; ++i)
      complete = complete && take(line, lens.parameters[std::size_t(i)]);
    if (!complete || !next_word(line).empty()) {
      problems.push_back(error_at(lines.where(), "{} takes {} parameters: {}", expected.name,
                                  expected.parameter_count, expected.parameter_names));
      continue;
    }
    if (!model.cameras.emplace(id, lens).second)
      problems.push_back(error_at(lines.where(), "camera {} stands in the file twice", id));
  }
}

bool parse_keypoints(std::string_view line, std::vector<ColmapKeypoint>& keypoints) {
  for (std::string_view rest = line; !rest.empty();) {
    ColmapKeypoint keypoint;
    if (!take_all(rest, keypoint.pixel.x, keypoint.pixel.y, keypoint.point_id)) return false;
    keypoints.push_back(keypoint);
  }
  return true;
}

void parse_images(Lines lines, ColmapModel& model, Errors& problems) {
  std::string_view line;
  while (problems.size() < max_problems && lines.next(line)) {
    ColmapImage image;
    glm::dvec4& q = image.rotation_wxyz;
    glm::dvec3& t = image.translation;
    if (!take_all(line, image.id, q.x, q.y, q.z, q.w, t.x, t.y, t.z, image.camera_id) || line.empty()) {
      problems.push_back(error_at(
          lines.where(), "expected IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME, then a line of points"));
      lines.next(line, true);
      continue;
    }
    image.name = line.substr(std::min(line.find_first_not_of(" \t"), line.size()));
    if (lines.next(line, true) && !parse_keypoints(line, image.keypoints)) {
      problems.push_back(error_at(lines.where(), "expected X Y POINT3D_ID for each point of {}", image.name));
      continue;
    }
    model.images.push_back(std::move(image));
  }
}

void parse_points(Lines lines, ColmapModel& model, Errors& problems) {
  std::string_view line;
  while (problems.size() < max_problems && lines.next(line)) {
    ColmapPoint point;
    int r = 0, g = 0, b = 0;
    glm::dvec3& p = point.position;
    bool complete = take_all(line, point.id, p.x, p.y, p.z, r, g, b, point.error_px);
    complete = complete && r >= 0 && r < 256 && g >= 0 && g < 256 && b >= 0 && b < 256;
    while (complete && !line.empty()) {
      ColmapPoint::Sighting sighting;
      complete = take_all(line, sighting.image_id, sighting.keypoint);
      point.track.push_back(sighting);
    }
    if (!complete) {
      problems.push_back(
          error_at(lines.where(), "expected POINT3D_ID X Y Z R G B ERROR (IMAGE_ID POINT2D_IDX)..."));
      continue;
    }
    point.colour = glm::u8vec3(r, g, b);
    model.points.push_back(std::move(point));
  }
}

}  // namespace

Result<ColmapModel> parse_colmap_text(const ColmapFiles& files, const std::filesystem::path& folder) {
  ColmapModel model;
  Errors problems;
  parse_cameras(Lines(files.cameras, (folder / "cameras.txt").string()), model, problems);
  parse_images(Lines(files.images, (folder / "images.txt").string()), model, problems);
  parse_points(Lines(files.points, (folder / "points3D.txt").string()), model, problems);
  if (!problems.empty()) return problems;
  return model;
}

ColmapFiles colmap_text(const ColmapModel& model) {
  ColmapFiles files;
  files.cameras = "# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n";
  for (const auto& [id, lens] : model.cameras) {
    files.cameras += fmt::format("{} {} {} {}", id, info(lens.model).name, lens.width, lens.height);
    for (int i = 0; i < info(lens.model).parameter_count; ++i)
      files.cameras += fmt::format(" {}", lens.parameters[std::size_t(i)]);
    files.cameras += '\n';
  }
  files.images =
      "# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n# POINTS2D[] as (X, Y, POINT3D_ID)\n";
  for (const ColmapImage& image : model.images) {
    const glm::dvec4& q = image.rotation_wxyz;
    const glm::dvec3& t = image.translation;
    files.images += fmt::format("{} {} {} {} {} {} {} {} {} {}\n", image.id, q.x, q.y, q.z, q.w, t.x, t.y,
                                t.z, image.camera_id, image.name);
    std::string_view between = "";
    for (const ColmapKeypoint& k : image.keypoints) {
      files.images += fmt::format("{}{} {} {}", between, k.pixel.x, k.pixel.y, k.point_id);
      between = " ";
    }
    files.images += '\n';
  }
  files.points = "# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n";
  for (const ColmapPoint& point : model.points) {
    const glm::dvec3& p = point.position;
    files.points += fmt::format("{} {} {} {} {} {} {} {}", point.id, p.x, p.y, p.z, point.colour.x,
                                point.colour.y, point.colour.z, point.error_px);
    for (const ColmapPoint::Sighting& s : point.track)
      files.points += fmt::format(" {} {}", s.image_id, s.keypoint);
    files.points += '\n';
  }
  return files;
}

}  // namespace parvis::photographs
