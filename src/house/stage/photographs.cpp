#include "house/stage/photographs.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "base/camera_check.h"
#include "base/image_io.h"
#include "capture/photographs/colmap_writer.h"
#include "formats/gltf/gltf_cameras.h"
#include "graphics/reference/seen_points.h"
#include "graphics/shading/tone_curve.h"

namespace parvis::house {
namespace {
namespace fs = std::filesystem;

constexpr int max_cameras_of_circle = 1000;
constexpr int points_across = 48;  // of the grid of points that a COLMAP model gets from each picture

/// What is left of a camera's name in the name of a file.
std::string file_part(std::string name) {
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
  return name;
}

/// The file of one camera's picture.
fs::path file_of(const fs::path& file, const scene::NamedCamera& camera, const PhotographJob& job) {
  if (job.cameras.size() == 1) return file;
  return file.parent_path() /
         (file.stem().string() + "_" + file_part(camera.name) + file.extension().string());
}

fs::path checkpoint_of(const scene::NamedCamera& camera, const PhotographJob& job) {
  constexpr std::size_t max_name = 255;
  const std::string_view extension = ".checkpoint";
  const fs::path picture = file_of(job.pictures.front(), camera, job);
  std::string name = picture.filename().string();
  name.resize(std::min(name.size(), max_name - extension.size()));
  return picture.parent_path() / name.append(extension);
}

bool is_linear(const fs::path& file) { return file.extension() == ".exr" || file.extension() == ".hdr"; }

Status write_photograph(const reference::Photograph& photograph, const Image8& display,
                        const scene::NamedCamera& camera, const PhotographJob& job) {
  for (const fs::path& picture : job.pictures) {
    const fs::path file = file_of(picture, camera, job);
    Status status = is_linear(file) ? write_image(file, photograph.radiance) : write_image(file, display);
    if (!status) return status;
  }
  if (!job.depth.empty())
    if (Status status = write_image(file_of(job.depth, camera, job), photograph.depth_m); !status)
      return status;
  if (!job.alpha.empty()) return write_image(file_of(job.alpha, camera, job), photograph.alpha);
  return Done{};
}

Status check(const PhotographJob& job) {
  if (job.cameras.empty()) return error("the scene has no camera to photograph with");
  if (!job.depth.empty() && !is_linear(job.depth))
    return error("--depth {}: expected a file in float, .exr", job.depth.string());
  std::set<std::string> files;
  for (const scene::NamedCamera& camera : job.cameras)
    if (!files.insert(file_part(camera.name)).second)
      return error("two cameras are named \"{}\": their pictures would have one name", camera.name);
  return Done{};
}

}  // namespace

Result<std::vector<scene::NamedCamera>> circle_of_cameras(glm::vec3 target, float radius_m,
                                                          float eye_above_target_m, int count,
                                                          float vertical_fov) {
  if (count < 1 || count > max_cameras_of_circle || !(radius_m > 0.0f))
    return error("a circle of {} cameras of radius {} m; expected 1 to {} cameras and a radius above 0",
                 count, radius_m, max_cameras_of_circle);
  std::vector<scene::NamedCamera> cameras;
  for (int i = 0; i < count; ++i) {
    const float turn = 6.2831853f * float(i) / float(count);
    const glm::vec3 eye =
        target + glm::vec3(radius_m * std::cos(turn), radius_m * std::sin(turn), eye_above_target_m);
    scene::NamedCamera named;
    named.name = fmt::format("circle_{:02}", i + 1);
    named.camera.world_from_camera = look_at(eye, target);
    named.camera.vertical_fov = vertical_fov;
    if (!is_usable(named.camera))
      return error(
          "a circle of cameras about {} {} {} of radius {} m, {} m above: expected finite numbers of "
          "up to {:g} m",
          target.x, target.y, target.z, radius_m, eye_above_target_m, max_coordinate_m);
    cameras.push_back(std::move(named));
  }
  return cameras;
}

Status take_photographs(const scene::Scene& scene, const PhotographJob& job) {
  if (Status status = check(job); !status) return status;
  const reference::RayScene rays(scene);
  const shading::SkyLight sky =
      shading::make_sky_light(scene.sky.picture, scene.sky.intensity, scene.sky.heading);
  std::vector<scene::TakenPicture> taken;
  std::vector<Image8> displays;
  for (const scene::NamedCamera& named : job.cameras) {
    reference::PhotographOptions options = job.options;
    options.checkpoint = checkpoint_of(named, job);
    options.progress = fmt::format("photograph {}/{}, tiles", taken.size() + 1, job.cameras.size());
    const Result<reference::Photograph> photograph =
        reference::take_photograph(rays, scene, sky, named.camera, job.width, job.height, options);
    if (!photograph) return photograph.errors();
    if (!options.processes.is_first()) continue;
    displays.push_back(shading::tone_mapped_picture(photograph->radiance, scene.exposure));
    if (Status status = write_photograph(*photograph, displays.back(), named, job); !status) return status;
    const double millions = 1e-6 * double(photograph->rays);
    fmt::print("{}: {:.1f} million rays in {:.1f} s, {:.2f} million a second\n", named.name, millions,
               photograph->seconds, millions / photograph->seconds);
    taken.push_back(
        {file_of(job.pictures.front(), named, job).filename().string(), named.camera, job.width, job.height});
  }
  if (!job.options.processes.is_first()) return Done{};
  if (!job.colmap_folder.empty()) {
    const auto points = reference::seen_points(rays, taken, displays, std::max(job.width / points_across, 1));
    if (Status status = photographs::write_colmap(job.colmap_folder, taken, points); !status) return status;
  }
  if (!job.gltf_cameras.empty())
    if (Status status = scene::write_gltf_cameras(job.gltf_cameras, taken); !status) return status;
  std::error_code ignored;
  for (const scene::NamedCamera& camera : job.cameras) fs::remove(checkpoint_of(camera, job), ignored);
  return Done{};
}

}  // namespace parvis::house
