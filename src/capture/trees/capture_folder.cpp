#include "capture/trees/capture_folder.h"

#include <algorithm>
#include <filesystem>
#include <span>

#include "base/image_io.h"
#include "base/parallel.h"
#include "capture/photographs/colmap_set.h"
#include "capture/photographs/picture.h"

namespace parvis::trees {
namespace {

/// The camera of a photograph in single precision.
Pinhole pinhole_of_photograph(const photographs::Photograph& photograph) {
  Pinhole result;
  result.width = photograph.lens.width, result.height = photograph.lens.height;
  result.focal = glm::vec2(photographs::focal_px(photograph.lens));
  result.principal_point = glm::vec2(photographs::principal_point_px(photograph.lens));
  result.world_from_camera = glm::mat3(photograph.world_from_camera);
  result.position_in_world = glm::vec3(photograph.position_in_world());
  return result;
}

photographs::Photograph photograph_of(const TreeView& view) {
  photographs::Photograph result;
  result.name = view.name + ".png";
  const Pinhole& c = view.camera;
  result.lens = photographs::pinhole_lens(c.width, c.height, double(c.focal.x), double(c.focal.y),
                                          double(c.principal_point.x), double(c.principal_point.y));
  result.world_from_camera = glm::dmat4(glm::dmat3(c.world_from_camera));
  result.world_from_camera[3] = glm::dvec4(glm::dvec3(c.position_in_world), 1.0);
  return result;
}

/// The fault of a picture as a matte; empty: none.
std::string problem_of(const photographs::Photograph& photograph, const Image8& picture) {
  if (picture.width != photograph.lens.width || picture.height != photograph.lens.height)
    return fmt::format("{} x {} pixels, but its camera was calibrated for {} x {}", picture.width,
                       picture.height, photograph.lens.width, photograph.lens.height);
  int low = 255, high = 0;
  for (std::size_t i = 3; i < picture.pixels.size(); i += 4)
    low = std::min(low, int(picture.pixels[i])), high = std::max(high, int(picture.pixels[i]));
  if (high == 0) return "its alpha is 0 everywhere: the matte shows no tree";
  if (low == 255) return "its alpha is 255 everywhere: it has no matte; make one with parvis tree matte";
  return "";
}

}  // namespace

Status write_capture(const std::filesystem::path& folder, std::span<const TreeView> views) {
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (code) return error("{}: the folder cannot be made: {}", folder.string(), code.message());
  for (const TreeView& view : views)
    if (Status status = write_image(folder / (view.name + ".png"), view.picture); !status) return status;
  return write_cameras(folder, views);
}

Status write_cameras(const std::filesystem::path& folder, std::span<const TreeView> views) {
  photographs::PhotographSet set;
  for (const TreeView& view : views) set.photographs.push_back(photograph_of(view));
  return photographs::write_colmap_model(folder, photographs::colmap_model_of(set),
                                         photographs::ColmapFormat::text);
}

Result<std::vector<TreeView>> read_capture(const std::filesystem::path& folder) {
  const Result<photographs::ColmapModel> model = photographs::read_colmap_model(folder);
  if (!model) return model.errors();
  photographs::LoadedSet loaded = photographs::photograph_set_of(*model, folder);
  Errors problems = std::move(loaded.problems);
  const std::vector<photographs::Photograph>& photos = loaded.set.photographs;
  std::vector<TreeView> views(photos.size());
  std::vector<Errors> own(photos.size());
  parallel_for(photos.size(), [&](std::size_t i) {
    Result<Image8> picture = read_image8(photos[i].file);
    if (!picture) {
      own[i] = picture.errors();
      return;
    }
    if (const std::string problem = problem_of(photos[i], *picture); !problem.empty())
      own[i].push_back(error("{}: {}", photos[i].name, problem));
    if (!own[i].empty()) return;
    photographs::Picture straight = photographs::undistorted(photos[i], *std::move(picture));
    views[i] = {photos[i].name, pinhole_of_photograph(straight.photograph), std::move(straight.image)};
  });
  for (const Errors& errors : own) problems.insert(problems.end(), errors.begin(), errors.end());
  if (!problems.empty()) return problems;
  if (views.empty()) return error("{}: the model has no photographs", folder.string());
  return views;
}

}  // namespace parvis::trees
