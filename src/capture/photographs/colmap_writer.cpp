#include "capture/photographs/colmap_writer.h"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>

#include "capture/photographs/colmap_model.h"

namespace parvis::photographs {
namespace {

/// Pictures of one size and field of view share the camera of the first of them.
std::uint32_t camera_id(const std::vector<scene::TakenPicture>& pictures,
                        const scene::TakenPicture& picture) {
  const auto first = std::ranges::find_if(pictures, [&](const scene::TakenPicture& other) {
    return other.width == picture.width && other.height == picture.height &&
           other.camera.vertical_fov == picture.camera.vertical_fov;
  });
  return std::uint32_t(first - pictures.begin()) + 1;
}

/// COLMAP's cameras look along +z, y downward; ours along -z, y upward.
glm::dmat4 opencv_from_world(const Camera& camera) {
  glm::dmat4 opencv_from_camera(1.0);
  opencv_from_camera[1][1] = opencv_from_camera[2][2] = -1.0;
  return opencv_from_camera * glm::inverse(glm::dmat4(camera.world_from_camera));
}

}  // namespace

Status write_colmap(const std::filesystem::path& folder, const std::vector<scene::TakenPicture>& pictures,
                    const std::vector<scene::SeenPoint>& points) {
  ColmapModel model;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const scene::TakenPicture& picture = pictures[i];
    const glm::dmat4 pose = opencv_from_world(picture.camera);
    const glm::dquat turn = glm::normalize(glm::quat_cast(glm::dmat3(pose)));
    const std::uint32_t camera = camera_id(pictures, picture);
    const double focal_px = scene::focal_length_px(picture);
    model.cameras.try_emplace(camera, pinhole_lens(picture.width, picture.height, focal_px, focal_px,
                                                   0.5 * picture.width, 0.5 * picture.height));
    model.images.push_back({std::uint32_t(i) + 1,
                            camera,
                            {turn.w, turn.x, turn.y, turn.z},
                            glm::dvec3(pose[3]),
                            picture.name,
                            {}});
  }
  for (std::size_t p = 0; p < points.size(); ++p) {
    ColmapPoint point{std::int64_t(p) + 1, glm::dvec3(points[p].position), points[p].colour, 0.0, {}};
    for (const int i : points[p].pictures) {
      ColmapImage& image = model.images[std::size_t(i)];
      point.track.push_back({image.id, std::uint32_t(image.keypoints.size())});
      image.keypoints.push_back(
          {glm::dvec2(scene::projected(pictures[std::size_t(i)], points[p].position)), point.id});
    }
    model.points.push_back(std::move(point));
  }
  return write_colmap_model(folder, model, ColmapFormat::text);
}

}  // namespace parvis::photographs
