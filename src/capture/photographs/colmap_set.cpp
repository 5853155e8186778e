#include "capture/photographs/colmap_set.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <set>
#include <unordered_map>

#include "base/path_inside.h"

namespace parvis::photographs {
namespace {

bool leads_out(const std::string& name) {
  const std::filesystem::path path(name);
  return path.is_absolute() || std::ranges::any_of(path, [](const auto& part) { return part == ".."; });
}

/// The photograph of an image, or why there is none.
Result<Photograph> photograph_of_colmap(const ColmapImage& image, const ColmapModel& model,
                                        const std::filesystem::path& picture_folder) {
  const auto camera = model.cameras.find(image.camera_id);
  if (camera == model.cameras.end())
    return error("{}: has no camera: the model has none with the number {}", image.name, image.camera_id);
  const glm::dvec2 focal = focal_px(camera->second);
  if (!(focal.x > 0.0) || !(focal.y > 0.0))
    return error("{}: its camera {} has a focal length of {} x {}; expected pixels > 0", image.name,
                 image.camera_id, focal.x, focal.y);
  if (image.name.empty() || leads_out(image.name))
    return error("\"{}\": a photograph's name has to lead into the folder of pictures", image.name);
  const Result<std::filesystem::path> file = path_inside(picture_folder, image.name);
  if (!file) return file.errors();
  const glm::dvec4& q = image.rotation_wxyz;
  const double length = glm::length(q), distance = glm::length(image.translation);
  if (!(length > 1e-6) || !std::isfinite(length) || !std::isfinite(distance))
    return error("{}: its pose is no rotation and translation", image.name);
  glm::dmat4 opencv_from_world = glm::mat4_cast(glm::normalize(glm::dquat(q.x, q.y, q.z, q.w)));
  opencv_from_world[3] = glm::dvec4(image.translation, 1.0);
  Photograph photograph;
  photograph.name = image.name;
  photograph.file = *file;
  photograph.lens = camera->second;
  photograph.world_from_camera = world_from_camera_of_opencv(opencv_from_world);
  return photograph;
}

using ImageOfId = std::unordered_map<std::uint32_t, const ColmapImage*>;
using IndexOfName = std::unordered_map<std::string, int>;

SparsePoint sparse_point_of(const ColmapPoint& point, const ImageOfId& images, const IndexOfName& indices) {
  SparsePoint result;
  result.position_in_world = point.position;
  result.colour = point.colour;
  result.reprojection_error_px = point.error_px;
  for (const ColmapPoint::Sighting& sighting : point.track) {
    const auto image = images.find(sighting.image_id);
    if (image == images.end() || sighting.keypoint >= image->second->keypoints.size()) continue;
    const auto index = indices.find(image->second->name);
    if (index != indices.end())
      result.observations.push_back({index->second, image->second->keypoints[sighting.keypoint].pixel});
  }
  std::ranges::stable_sort(result.observations, {}, &Observation::photograph);
  return result;
}

bool is_finite(glm::dvec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

}  // namespace

LoadedSet photograph_set_of(const ColmapModel& model, const std::filesystem::path& picture_folder) {
  LoadedSet loaded;
  std::set<std::string> names;
  std::set<std::uint32_t> used;
  ImageOfId images;
  for (const ColmapImage& image : model.images) {
    Result<Photograph> photograph = photograph_of_colmap(image, model, picture_folder);
    if (!photograph) {
      loaded.problems.insert(loaded.problems.end(), photograph.errors().begin(), photograph.errors().end());
    } else if (!names.insert(image.name).second) {
      loaded.problems.push_back(error("{}: stands in the model twice; the first is used", image.name));
    } else {
      used.insert(image.camera_id);
      images.emplace(image.id, &image);
      loaded.set.photographs.push_back(std::move(*photograph));
    }
  }
  for (const auto& [id, lens] : model.cameras)
    if (!used.contains(id))
      loaded.problems.push_back(error("camera {}: no photograph was taken with it", id));
  std::ranges::sort(loaded.set.photographs, {}, &Photograph::name);
  IndexOfName indices;
  for (const Photograph& photograph : loaded.set.photographs)
    indices.emplace(photograph.name, int(indices.size()));
  std::size_t broken = 0;
  for (const ColmapPoint& point : model.points)
    if (is_finite(point.position))
      loaded.set.points.push_back(sparse_point_of(point, images, indices));
    else
      ++broken;
  if (broken > 0) loaded.problems.push_back(error("{} points have no place and are left out", broken));
  measure_reprojection(loaded.set);
  return loaded;
}

ColmapModel colmap_model_of(const PhotographSet& set) {
  ColmapModel model;
  for (std::size_t i = 0; i < set.photographs.size(); ++i) {
    const Photograph& photograph = set.photographs[i];
    ColmapImage image;
    image.id = std::uint32_t(i + 1);
    image.name = photograph.name;
    const auto same = std::ranges::find_if(
        model.cameras, [&](const auto& camera) { return camera.second == photograph.lens; });
    image.camera_id = same == model.cameras.end() ? std::uint32_t(model.cameras.size() + 1) : same->first;
    model.cameras.emplace(image.camera_id, photograph.lens);
    const glm::dmat4 pose = opencv_from_world(photograph);
    const glm::dquat q = glm::normalize(glm::quat_cast(glm::dmat3(pose)));
    image.rotation_wxyz = {q.w, q.x, q.y, q.z};
    image.translation = glm::dvec3(pose[3]);
    model.images.push_back(std::move(image));
  }
  for (std::size_t i = 0; i < set.points.size(); ++i) {
    const SparsePoint& point = set.points[i];
    ColmapPoint out{
        std::int64_t(i + 1), point.position_in_world, point.colour, point.reprojection_error_px, {}};
    for (const Observation& observation : point.observations) {
      ColmapImage& image = model.images[std::size_t(observation.photograph)];
      out.track.push_back({image.id, std::uint32_t(image.keypoints.size())});
      image.keypoints.push_back({observation.pixel, out.id});
    }
    model.points.push_back(std::move(out));
  }
  return model;
}

void measure_reprojection(PhotographSet& set) {
  std::vector<double> sums(set.photographs.size(), 0.0);
  std::vector<std::size_t> counts(set.photographs.size(), 0);
  for (const SparsePoint& point : set.points)
    for (const Observation& observation : point.observations) {
      const std::size_t i = std::size_t(observation.photograph);
      const auto pixel = pixel_of_world(set.photographs[i], point.position_in_world);
      if (!pixel) continue;
      sums[i] += glm::distance(*pixel, observation.pixel);
      ++counts[i];
    }
  for (std::size_t i = 0; i < sums.size(); ++i)
    set.photographs[i].reprojection_error_px = counts[i] > 0 ? sums[i] / double(counts[i]) : -1.0;
}

}  // namespace parvis::photographs
