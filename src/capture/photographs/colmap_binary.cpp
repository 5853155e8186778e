// COLMAP's binary files (src/colmap/base/reconstruction.cc, Read*Binary): little-endian, unaligned, as this
// machine is.
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "capture/photographs/colmap_model.h"

namespace parvis::photographs {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t max_name_bytes = 4096;

/// Reads numbers off the front of a file's bytes. After the first that is not there, all are 0 and `failed`.
class Bytes {
 public:
  Bytes(std::string_view bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {}

  template <class T>
  T take() {
    T value{};
    if (failed_ || bytes_.size() - at_ < sizeof(T)) return failed_ = true, value;
    std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return value;
  }
  /// A count of items that take at least `item_bytes` each: fails where the file is too short for them.
  std::size_t take_count(std::size_t item_bytes) {
    const auto count = take<std::uint64_t>();
    if (!failed_ && count > (bytes_.size() - at_) / item_bytes) failed_ = true;
    return failed_ ? 0 : std::size_t(count);
  }
  /// The text up to the next zero, without it.
  std::string take_text() {
    const std::size_t end = bytes_.find('\0', at_);
    if (failed_ || end == std::string_view::npos || end - at_ > max_name_bytes) return failed_ = true, "";
    const std::string text(bytes_.substr(at_, end - at_));
    at_ = end + 1;
    return text;
  }
  glm::dvec3 take_vec3() {
    glm::dvec3 v;
    for (int i = 0; i < 3; ++i) v[i] = take<double>();
    return v;
  }
  bool failed() const { return failed_; }
  Error cut_short() const {
    return error(
        "{}: the file ends, or is damaged, at byte {} of {}; copy it again from where COLMAP wrote it", file_,
        at_, bytes_.size());
  }
  Error wrong(const std::string& what) const { return error("{}: before byte {}: {}", file_, at_, what); }
  bool at_end() const { return at_ == bytes_.size(); }

 private:
  std::string_view bytes_;
  std::string file_;
  std::size_t at_ = 0;
  bool failed_ = false;
};

Status parse_cameras(Bytes in, ColmapModel& model) {
  const std::size_t count = in.take_count(4 + 4 + 8 + 8 + 3 * 8);
  for (std::size_t i = 0; i < count; ++i) {
    const auto id = in.take<std::uint32_t>();
    const auto model_id = in.take<std::int32_t>();
    const auto width = in.take<std::uint64_t>(), height = in.take<std::uint64_t>();
    if (in.failed()) return in.cut_short();
    if (model_id < 0 || model_id >= lens_model_count)
      return in.wrong(fmt::format("camera {} has model {}; COLMAP 3.8 knows 0 to {}", id, model_id,
                                  lens_model_count - 1));
    constexpr std::uint64_t max_side = 1 << 24;
    if (width < 1 || height < 1 || width > max_side || height > max_side)
      return in.wrong(fmt::format("camera {} is {} x {} pixels", id, width, height));
    Lens lens{LensModel(model_id), int(width), int(height), {}};
    for (int k = 0; k < info(lens.model).parameter_count; ++k) {
      lens.parameters[std::size_t(k)] = in.take<double>();
      if (!std::isfinite(lens.parameters[std::size_t(k)]))
        return in.wrong(fmt::format("camera {} has a parameter that is no number", id));
    }
    if (!model.cameras.emplace(id, lens).second)
      return in.wrong(fmt::format("camera {} stands in the file twice", id));
  }
  if (in.failed() || !in.at_end()) return in.cut_short();
  return Ok{};
}

Status parse_images(Bytes in, ColmapModel& model) {
  constexpr std::size_t keypoint_bytes = 24;
  const std::size_t count = in.take_count(4 + 7 * 8 + 4 + 1 + 8);
  for (std::size_t i = 0; i < count && !in.failed(); ++i) {
    ColmapImage image;
    image.id = in.take<std::uint32_t>();
    for (int k = 0; k < 4; ++k) image.rotation_wxyz[k] = in.take<double>();
    image.translation = in.take_vec3();
    image.camera_id = in.take<std::uint32_t>();
    image.name = in.take_text();
    image.keypoints.resize(in.take_count(keypoint_bytes));
    for (ColmapKeypoint& keypoint : image.keypoints) {
      keypoint.pixel.x = in.take<double>();
      keypoint.pixel.y = in.take<double>();
      keypoint.point_id = in.take<std::int64_t>();
    }
    if (!in.failed()) model.images.push_back(std::move(image));
  }
  if (in.failed() || !in.at_end()) return in.cut_short();
  return Ok{};
}

Status parse_points(Bytes in, ColmapModel& model) {
  const std::size_t count = in.take_count(8 + 3 * 8 + 3 + 8 + 8);
  for (std::size_t i = 0; i < count && !in.failed(); ++i) {
    ColmapPoint point;
    point.id = in.take<std::int64_t>();
    point.position = in.take_vec3();
    for (int k = 0; k < 3; ++k) point.colour[k] = in.take<std::uint8_t>();
    point.error_px = in.take<double>();
    point.track.resize(in.take_count(8));
    for (ColmapPoint::Sighting& sighting : point.track) {
      sighting.image_id = in.take<std::uint32_t>();
      sighting.keypoint = in.take<std::uint32_t>();
    }
    if (!in.failed()) model.points.push_back(std::move(point));
  }
  if (in.failed() || !in.at_end()) return in.cut_short();
  return Ok{};
}

template <class... T>
void put(std::string& out, const T&... values) {
  (out.append(reinterpret_cast<const char*>(&values), sizeof(T)), ...);
}

}  // namespace

Result<ColmapModel> parse_colmap_binary(const ColmapFiles& files, const std::filesystem::path& folder) {
  ColmapModel model;
  if (Status status = parse_cameras(Bytes(files.cameras, (folder / "cameras.bin").string()), model); !status)
    return status.errors();
  if (Status status = parse_images(Bytes(files.images, (folder / "images.bin").string()), model); !status)
    return status.errors();
  if (Status status = parse_points(Bytes(files.points, (folder / "points3D.bin").string()), model); !status)
    return status.errors();
  return model;
}

ColmapFiles colmap_binary(const ColmapModel& model) {
  ColmapFiles files;
  put(files.cameras, std::uint64_t(model.cameras.size()));
  for (const auto& [id, lens] : model.cameras) {
    put(files.cameras, id, std::int32_t(lens.model), std::uint64_t(lens.width), std::uint64_t(lens.height));
    for (int i = 0; i < info(lens.model).parameter_count; ++i)
      put(files.cameras, lens.parameters[std::size_t(i)]);
  }
  put(files.images, std::uint64_t(model.images.size()));
  for (const ColmapImage& image : model.images) {
    const glm::dvec4& q = image.rotation_wxyz;
    const glm::dvec3& t = image.translation;
    put(files.images, image.id, q.x, q.y, q.z, q.w, t.x, t.y, t.z, image.camera_id);
    files.images += image.name + '\0';
    put(files.images, std::uint64_t(image.keypoints.size()));
    for (const ColmapKeypoint& k : image.keypoints) put(files.images, k.pixel.x, k.pixel.y, k.point_id);
  }
  put(files.points, std::uint64_t(model.points.size()));
  for (const ColmapPoint& point : model.points) {
    const glm::dvec3& p = point.position;
    put(files.points, point.id, p.x, p.y, p.z, point.colour.x, point.colour.y, point.colour.z, point.error_px,
        std::uint64_t(point.track.size()));
    for (const ColmapPoint::Sighting& s : point.track) put(files.points, s.image_id, s.keypoint);
  }
  return files;
}

}  // namespace parvis::photographs
