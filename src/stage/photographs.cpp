#include "stage/photographs.h"

#include <algorithm>
#include <cmath>

#include "base/camera_check.h"
#include "base/image_io.h"
#include "capture/photographs/colmap_writer.h"
#include "formats/gltf/gltf_cameras.h"
#include "graphics/reference/seen_points.h"
#include "graphics/shading/tone_curve.h"
#include "stage/output_names.h"

namespace parvis::stage {
namespace {
namespace fs = std::filesystem;

constexpr int max_cameras_of_circle = 1000;
constexpr int points_across = 48;  // of the grid of points that a COLMAP model gets from each picture

/// The files of the cameras' pictures, one per camera in each list; none where none were asked for.
struct Outputs {
  explicit Outputs(const PhotographJob& job) {
    std::vector<std::string> names;
    names.reserve(job.cameras.size());
    for (const scene::NamedCamera& camera : job.cameras) names.push_back(camera.name);
    const auto files_of = [&](const fs::path& file) {
      return file.empty() || names.size() == 1 ? std::vector<fs::path>(file.empty() ? 0 : 1, file)
                                               : series_files(file, '_', names);
    };
    for (const fs::path& picture : job.pictures) pictures.push_back(files_of(picture));
    depth = files_of(job.depth), alpha = files_of(job.alpha);
  }
  fs::path checkpoint(std::size_t camera) const {
    return file_beside(pictures.front()[camera], ".checkpoint");
  }

  std::vector<std::vector<fs::path>> pictures;
  std::vector<fs::path> depth, alpha;
};

bool is_linear(const fs::path& file) { return file.extension() == ".exr" || file.extension() == ".hdr"; }

Status write_photograph(const reference::Photograph& photograph, const Image8& display, std::size_t camera,
                        const Outputs& outputs) {
  for (const std::vector<fs::path>& files : outputs.pictures) {
    const fs::path& file = files[camera];
    Status status = is_linear(file) ? write_image(file, photograph.radiance) : write_image(file, display);
    if (!status) return status;
  }
  if (!outputs.depth.empty())
    if (Status status = write_image(outputs.depth[camera], photograph.depth_m); !status) return status;
  if (!outputs.alpha.empty()) return write_image(outputs.alpha[camera], photograph.alpha);
  return Ok{};
}

Status check(const PhotographJob& job, const Outputs& outputs) {
  for (const std::vector<fs::path>& files : outputs.pictures)
    if (files.empty()) return error("a picture without a name: give -o the name of a file");
  if (!job.depth.empty() && !is_linear(job.depth))
    return error("--depth {}: expected a file in float, .exr", job.depth.string());
  std::vector<fs::path> all = outputs.depth;
  all.insert(all.end(), outputs.alpha.begin(), outputs.alpha.end());
  for (const std::vector<fs::path>& files : outputs.pictures)
    all.insert(all.end(), files.begin(), files.end());
  return check_different(all);
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
  if (job.cameras.empty()) return error("the scene has no camera to photograph with");
  const Outputs outputs(job);
  if (Status status = check(job, outputs); !status) return status;
  const reference::RayScene rays(scene);
  const shading::SkyLight sky =
      shading::make_sky_light(scene.sky.picture, scene.sky.intensity, scene.sky.heading);
  std::vector<scene::TakenPicture> taken;
  std::vector<Image8> displays;
  for (std::size_t camera = 0; camera < job.cameras.size(); ++camera) {
    const scene::NamedCamera& named = job.cameras[camera];
    reference::PhotographOptions options = job.options;
    options.checkpoint = outputs.checkpoint(camera);
    options.progress = fmt::format("photograph {}/{}, tiles", taken.size() + 1, job.cameras.size());
    const Result<reference::Photograph> photograph =
        reference::take_photograph(rays, scene, sky, named.camera, job.width, job.height, options);
    if (!photograph) return photograph.errors();
    if (!options.processes.is_first()) continue;
    displays.push_back(shading::tone_mapped_picture(photograph->radiance, scene.exposure));
    if (Status status = write_photograph(*photograph, displays.back(), camera, outputs); !status)
      return status;
    const double millions = 1e-6 * double(photograph->rays);
    fmt::print("{}: {:.1f} million rays in {:.1f} s, {:.2f} million per second\n", named.name, millions,
               photograph->seconds, millions / photograph->seconds);
    taken.push_back(
        {outputs.pictures.front()[camera].filename().string(), named.camera, job.width, job.height});
  }
  if (!job.options.processes.is_first()) return Ok{};
  if (!job.colmap_folder.empty()) {
    const auto points = reference::seen_points(rays, taken, displays, std::max(job.width / points_across, 1));
    if (Status status = photographs::write_colmap(job.colmap_folder, taken, points); !status) return status;
  }
  if (!job.gltf_cameras.empty())
    if (Status status = scene::write_gltf_cameras(job.gltf_cameras, taken); !status) return status;
  std::error_code ignored;
  for (std::size_t camera = 0; camera < job.cameras.size(); ++camera)
    fs::remove(outputs.checkpoint(camera), ignored);
  return Ok{};
}

}  // namespace parvis::stage
