// The scene of a packed place: one facade(...), a camera for each photograph, and a tour through them.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/files.h"
#include "capture/facades/place_folder.h"

namespace parvis::facades {
namespace fs = std::filesystem;
namespace {

constexpr double degrees = 57.295779513082320876;
constexpr double nominal_aspect = 16.0 / 9.0;  ///< at which camera(fov_deg=) is horizontal
constexpr double seconds_per_stop = 3.0;
constexpr const char* first_line =
    "// Written by parvis facade pack. Take this line out to keep your changes.\n";

std::string camera_line(const std::string& name, const PackedPhoto& photo) {
  const glm::dmat3 world_from_camera = glm::transpose(photo.view.camera_from_world);
  const glm::dvec3 forward = world_from_camera[2], p = photo.view.centre;
  const glm::dvec3 level = glm::normalize(glm::cross(forward, glm::dvec3(0, 0, 1))),
                   right = world_from_camera[0];
  const double roll = std::atan2(-glm::dot(right, glm::cross(level, forward)), glm::dot(right, level));
  const double vertical = 0.5 * photo.view.height / photo.view.fy;
  return fmt::format(
      "camera(name=\"{}\", position=\"{:.4f} {:.4f} {:.4f}\", heading_deg={:.3f}, pitch_deg={:.3f}, "
      "roll_deg={:.3f}, fov_deg={:.3f})\n",
      name, p.x, p.y, p.z, std::atan2(forward.x, forward.y) * degrees,
      std::asin(std::clamp(forward.z, -1.0, 1.0)) * degrees, std::isfinite(roll) ? roll * degrees : 0.0,
      2.0 * std::atan(vertical * nominal_aspect) * degrees);
}

std::string name_of(const PackedPhoto& photo) { return fs::path(photo.name).stem().string(); }

/// A camera between two photographs that looks at the middle between their subjects.
PackedPhoto between(const PackedPhoto& a, const PackedPhoto& b) {
  PackedPhoto middle = a;
  middle.view.centre = 0.5 * (a.view.centre + b.view.centre);
  const glm::dvec3 ahead = glm::normalize(glm::transpose(a.view.camera_from_world)[2] +
                                          glm::transpose(b.view.camera_from_world)[2]);
  const glm::dvec3 right = glm::normalize(glm::cross(ahead, glm::dvec3(0, 0, 1)));
  middle.view.camera_from_world = glm::transpose(glm::dmat3(right, glm::cross(ahead, right), ahead));
  return middle;
}

std::string scene_text(const PackedFacade& facade) {
  std::string text = first_line;
  text += "facade(name=\"place\", file=\"place.facade\")\n";
  const std::vector<PackedPhoto>& photos = facade.photos;
  if (photos.size() > 1)
    text += camera_line("between", between(photos[photos.size() / 2 - 1], photos[photos.size() / 2]));
  for (const PackedPhoto& photo : photos) text += camera_line(name_of(photo), photo);
  if (photos.size() < 2) return text;
  text += "tour(name=\"walk\") {\n";
  for (std::size_t i = 0; i < photos.size(); ++i)
    text +=
        fmt::format("  stop(time_s={}, camera=\"{}\")\n", seconds_per_stop * double(i), name_of(photos[i]));
  return text + "}\n";
}

}  // namespace

Result<PackedFacade> pack_place(const PlaceSource& source, const PlaceLayers& place) {
  PackedFacade facade = packed_facade(place);
  if (Status status = write_facade(source.folder / "place.facade", facade); !status) return status.errors();
  const fs::path scene = source.folder / "place.xp";
  std::error_code code;
  const Result<std::string> there =
      fs::exists(scene, code) ? read_file(scene) : Result<std::string>(first_line);
  if (!there) return there.errors();
  if (there->starts_with(first_line))
    if (Status status = write_file(scene, scene_text(facade)); !status) return status.errors();
  return facade;
}

}  // namespace parvis::facades
