#include "capture/photographs/panorama.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "base/files.h"
#include "base/image_io.h"
#include "base/parallel.h"
#include "capture/photographs/picture_header.h"
#include "capture/photographs/resample.h"

namespace parvis::photographs {
namespace {

struct Face {
  const char* name;
  glm::dvec3 forward, up;
};

constexpr Face faces[] = {{"north", {0, 1, 0}, {0, 0, 1}},  {"east", {1, 0, 0}, {0, 0, 1}},
                          {"south", {0, -1, 0}, {0, 0, 1}}, {"west", {-1, 0, 0}, {0, 0, 1}},
                          {"up", {0, 0, 1}, {0, -1, 0}},    {"down", {0, 0, -1}, {0, 1, 0}}};

/// Where a direction appears in an equirectangular picture.
glm::dvec2 panorama_pixel(const Image8& panorama, glm::dvec3 direction, double middle_heading) {
  const double heading = std::remainder(std::atan2(direction.x, direction.y) - middle_heading,
                                        2.0 * std::numbers::pi);  // from the middle column over its right
  const double height = std::atan2(direction.z, std::hypot(direction.x, direction.y));
  return {(0.5 + heading / (2.0 * std::numbers::pi)) * panorama.width,
          (0.5 - height / std::numbers::pi) * panorama.height};
}

Photograph photograph_of_face(const Face& face, const std::string& name, int side, glm::dvec3 position) {
  Photograph photograph;
  photograph.name = name + "_" + face.name + ".png";
  photograph.lens = pinhole_lens(side, side, 0.5 * side, 0.5 * side, 0.5 * side, 0.5 * side);
  photograph.world_from_camera[0] = glm::dvec4(glm::cross(face.forward, face.up), 0.0);
  photograph.world_from_camera[1] = glm::dvec4(face.up, 0.0);
  photograph.world_from_camera[2] = glm::dvec4(-face.forward, 0.0);
  photograph.world_from_camera[3] = glm::dvec4(position, 1.0);
  return photograph;
}

}  // namespace

Result<std::vector<Picture>> faces_of_panorama(const Image8& panorama, const std::string& name,
                                               glm::dvec3 position, double heading_deg) {
  if (panorama.channels != 4 || panorama.width < 8 || std::abs(panorama.width - 2 * panorama.height) > 2)
    return error("{}: {} x {} pixels are no full panorama; expected one twice as wide as high", name,
                 panorama.width, panorama.height);
  std::vector<Picture> pictures;
  for (const Face& face : faces) {
    Picture picture{photograph_of_face(face, name, panorama.width / 4, position),
                    Image8(panorama.width / 4, panorama.width / 4, 4)};
    parallel_for(
        std::size_t(picture.image.height),
        [&](std::size_t y) {
          for (int x = 0; x < picture.image.width; ++x)
            if (const auto direction = direction_in_world(picture.photograph, {x + 0.5, double(y) + 0.5}))
              sample_bicubic(panorama, panorama_pixel(panorama, *direction, glm::radians(heading_deg)),
                             Border::wraps_around, picture.image.at(x, int(y)));
        },
        16);
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

Result<PhotographSet> write_faces(std::vector<Picture> pictures, const std::filesystem::path& folder) {
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  PhotographSet set;
  for (Picture& picture : pictures) {
    const Image8& image = picture.image;
    Image8 colours(image.width, image.height, 3), mask(image.width, image.height, 1);
    std::size_t shown = 0;
    for (std::size_t i = 0; i < mask.pixels.size(); ++i) {
      std::copy_n(image.pixels.data() + 4 * i, 3, colours.pixels.data() + 3 * i);
      mask.pixels[i] = image.pixels[4 * i + 3], shown += mask.pixels[i] > 0;
    }
    if (shown == 0) continue;
    picture.photograph.file = folder / picture.photograph.name;
    if (Status status = write_image(picture.photograph.file, colours); !status) return status.errors();
    if (shown < mask.pixels.size()) {
      picture.photograph.mask = folder.parent_path() / "masks" / picture.photograph.name;
      std::filesystem::create_directories(picture.photograph.mask.parent_path(), code);
      if (Status status = write_image(picture.photograph.mask, mask); !status) return status.errors();
    }
    set.photographs.push_back(std::move(picture.photograph));
  }
  std::ranges::sort(set.photographs, {}, &Photograph::name);
  return set;
}

Result<PhotographSet> split_panorama(const std::filesystem::path& file, const std::filesystem::path& folder,
                                     glm::dvec3 position, double heading_deg) {
  const Result<PictureHeader> header = read_picture_header(file);
  if (!header) return header.errors();
  if (header->focal_length_35mm_mm > 0.0)  // stitched pictures that name a lens name their projection, too
    if (const Result<std::string> bytes = read_file(file);
        bytes && bytes->find("GPano:") == std::string::npos)
      return error(
          "{}: its EXIF says that it was taken through a lens of {:.0f} mm (on film 36 mm wide), which does "
          "not "
          "show the whole sphere: parvis facade calibrate takes photographs. If it was stitched, remove its "
          "EXIF",
          file.string(), header->focal_length_35mm_mm);
  Photograph whole;
  whole.name = file.filename().string();
  whole.file = file;
  whole.lens = pinhole_lens(header->width, header->height, 1.0, 1.0, 0.0, 0.0);
  const Result<Image8> panorama = read_picture(whole);
  if (!panorama) return panorama.errors();
  Result<std::vector<Picture>> pictures =
      faces_of_panorama(*panorama, file.stem().string(), position, heading_deg);
  if (!pictures) return pictures.errors();
  return write_faces(*std::move(pictures), folder);
}

}  // namespace parvis::photographs
