#include "capture/photographs/picture.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <unordered_set>

#include "base/files.h"
#include "base/image_io.h"
#include "base/parallel.h"
#include "base/path_inside.h"
#include "capture/photographs/picture_header.h"
#include "capture/photographs/resample.h"

namespace parvis::photographs {
namespace {
namespace fs = std::filesystem;

bool is_turned_by_a_quarter(int orientation) { return orientation >= 5 && orientation <= 8; }

Error wrong_size(const Photograph& photograph, int width, int height) {
  return error(
      "{}: the picture has {} x {} pixels, its camera {} x {}; give the camera of this picture, or the "
      "picture "
      "that was calibrated",
      photograph.name, width, height, photograph.lens.width, photograph.lens.height);
}

/// The lens for a picture of this size, or nothing where the shape is another. One row or column may be
/// missing: halved pictures lose it.
std::optional<Lens> lens_for(const Lens& lens, int width, int height) {
  if (lens.width == width && lens.height == height) return lens;
  const double scale = double(width) / lens.width;
  if (std::abs(height - lens.height * scale) > 1.0) return std::nullopt;
  return resized(lens, width, height);
}

Status apply_mask(const Photograph& photograph, Image8& image) {
  if (photograph.mask.empty()) return Ok{};
  const Result<Image8> mask = read_image8(photograph.mask);
  if (!mask) return mask.errors();
  if (mask->width != image.width || mask->height != image.height)
    return error("{}: the mask has {} x {} pixels, its photograph {} x {}", photograph.mask.string(),
                 mask->width, mask->height, image.width, image.height);
  for (std::size_t i = 0; i < image.pixels.size(); i += 4)
    image.pixels[i + 3] = std::min(image.pixels[i + 3], mask->pixels[i]);
  return Ok{};
}

}  // namespace

Image8 upright(const Image8& stored, int orientation) {
  const bool quarter = is_turned_by_a_quarter(orientation);
  Image8 shown(quarter ? stored.height : stored.width, quarter ? stored.width : stored.height,
               stored.channels);
  const int right = stored.width - 1, bottom = stored.height - 1;
  for (int y = 0; y < shown.height; ++y)
    for (int x = 0; x < shown.width; ++x) {
      int from_x = quarter ? y : x, from_y = quarter ? x : y;
      if (orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8)
        from_x = right - from_x;
      if (orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7)
        from_y = bottom - from_y;
      std::copy_n(stored.at(from_x, from_y), stored.channels, shown.at(x, y));
    }
  return shown;
}

Result<Image8> read_picture(const Photograph& photograph) {
  const Result<PictureHeader> info = read_picture_header(photograph.file);
  if (!info) return info.errors();
  if (std::size_t(std::max(info->width, 0)) * std::size_t(std::max(info->height, 0)) > max_photograph_pixels)
    return error("{}: {} x {} pixels are too many ({} million are read); scale it down",
                 photograph.file.string(), info->width, info->height, max_photograph_pixels / 1000000);
  const Lens& lens = photograph.lens;
  const bool as_stored = info->width == lens.width && info->height == lens.height;
  const bool as_shown = !as_stored && is_turned_by_a_quarter(info->orientation) &&
                        info->height == lens.width && info->width == lens.height;
  if (!as_stored && !as_shown) return wrong_size(photograph, info->width, info->height);
  const Result<std::string> bytes = read_file(photograph.file);
  if (!bytes) return bytes.errors();
  if (!is_whole_jpeg(*bytes))
    return error("{}: the picture is cut short; copy it again from the camera", photograph.file.string());
  Result<Image8> stored = read_image8(photograph.file);
  if (!stored) return stored.errors();
  Image8 image = as_stored ? std::move(*stored) : upright(*stored, info->orientation);
  if (Status status = apply_mask(photograph, image); !status) return status.errors();
  return image;
}

Picture undistorted(const Photograph& photograph, Image8 image) {
  Picture result{photograph, {}};
  if (is_pinhole(photograph.lens)) {
    result.image = std::move(image);
    return result;
  }
  result.photograph.lens = undistorted(photograph.lens);
  result.photograph.mask.clear();  // it is in the alpha now
  result.image = Image8(image.width, image.height, 4);
  parallel_for(
      std::size_t(image.height),
      [&](std::size_t y) {
        for (int x = 0; x < image.width; ++x) {
          const auto direction = direction_of(result.photograph.lens, {x + 0.5, double(y) + 0.5});
          const auto from = direction ? pixel_of(photograph.lens, *direction) : std::nullopt;
          if (from && is_inside(photograph.lens, *from))
            sample_bicubic(image, *from, Border::clamped, result.image.at(x, int(y)));
        }
      },
      16);
  return result;
}

namespace {

std::string lower_extension(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return extension;
}

}  // namespace

std::vector<std::string> picture_names(const fs::path& folder) {
  return picture_names(folder, {".jpg", ".jpeg", ".png"});
}

std::vector<std::string> picture_names(const fs::path& folder, const std::set<std::string>& extensions) {
  std::vector<std::string> names;
  std::error_code code;
  for (auto entry = fs::recursive_directory_iterator(folder, code);
       !code && entry != fs::recursive_directory_iterator(); entry.increment(code)) {
    if (entry->path().filename().string().starts_with(".")) {
      if (entry->is_directory(code)) entry.disable_recursion_pending();
      continue;
    }
    if (entry->is_regular_file(code) && extensions.contains(lower_extension(entry->path())))
      names.push_back(entry->path().lexically_relative(folder).generic_string());
  }
  std::ranges::sort(names);
  return names;
}

void fit_to_files(LoadedSet& loaded, const fs::path& picture_folder) {
  std::vector<std::string> without_camera = picture_names(picture_folder);
  std::unordered_set<std::string> with_camera;
  for (const Photograph& photograph : loaded.set.photographs) with_camera.insert(photograph.name);
  std::erase_if(without_camera, [&](const std::string& name) { return with_camera.contains(name); });
  std::vector<int> new_index(loaded.set.photographs.size(), -1);
  std::vector<glm::dvec2> scale(loaded.set.photographs.size(), glm::dvec2(1.0));
  std::vector<Photograph> kept;
  for (std::size_t i = 0; i < loaded.set.photographs.size(); ++i) {
    Photograph& photograph = loaded.set.photographs[i];
    const auto leave_out = [&](Error why) { loaded.problems.push_back(std::move(why)); };
    if (std::error_code code; !fs::is_regular_file(photograph.file, code)) {
      leave_out(error("{}: there is a camera but no picture {}", photograph.name, photograph.file.string()));
      continue;
    }
    if (const Result<fs::path> inside = path_inside(picture_folder, photograph.name); !inside) {
      leave_out(inside.errors().front());
      continue;
    }
    const Result<PictureHeader> info = read_picture_header(photograph.file);
    if (!info) {
      leave_out(info.errors().front());
      continue;
    }
    if (std::size_t(std::max(info->width, 0)) * std::size_t(std::max(info->height, 0)) >
        max_photograph_pixels) {
      leave_out(error("{}: {} x {} pixels are too many ({} million are read); scale it down", photograph.name,
                      info->width, info->height, max_photograph_pixels / 1000000));
      continue;
    }
    std::optional<Lens> lens = lens_for(photograph.lens, info->width, info->height);
    photograph.orientation = lens ? info->orientation : 1;
    if (!lens && is_turned_by_a_quarter(info->orientation))
      lens = lens_for(photograph.lens, info->height, info->width);
    if (!lens) {
      leave_out(wrong_size(photograph, info->width, info->height));
      continue;
    }
    scale[i] =
        glm::dvec2(lens->width, lens->height) / glm::dvec2(photograph.lens.width, photograph.lens.height);
    photograph.lens = *lens;
    new_index[i] = int(kept.size());
    kept.push_back(std::move(photograph));
  }
  loaded.set.photographs = std::move(kept);
  for (SparsePoint& point : loaded.set.points) {
    std::vector<Observation> observations;
    for (const Observation& o : point.observations)
      if (new_index[std::size_t(o.photograph)] >= 0)
        observations.push_back(
            {new_index[std::size_t(o.photograph)], o.pixel * scale[std::size_t(o.photograph)]});
    point.observations = std::move(observations);
  }
  for (const std::string& name : without_camera)
    loaded.problems.push_back(error(
        "{}: the picture has no camera and is left out; if it was added after the others were calibrated, "
        "parvis facade calibrate may find one",
        name));
}

}  // namespace parvis::photographs
