#include "house/stage/colmap_writer.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "base/files.h"

namespace parvis::scene {
namespace {

bool share_a_camera(const TakenPicture& a, const TakenPicture& b) {
  return a.width == b.width && a.height == b.height && a.camera.vertical_fov == b.camera.vertical_fov;
}

/// For each picture the index of the first one that has its camera.
std::vector<std::size_t> first_of_camera(const std::vector<TakenPicture>& pictures) {
  std::vector<std::size_t> first(pictures.size());
  for (std::size_t i = 0; i < pictures.size(); ++i)
    while (!share_a_camera(pictures[first[i]], pictures[i])) ++first[i];
  return first;
}

/// COLMAP's cameras look along +z, y downward; ours along -z, y upward.
glm::dmat4 colmap_from_world(const Camera& camera) {
  glm::dmat4 colmap_from_camera(1.0);
  colmap_from_camera[1][1] = colmap_from_camera[2][2] = -1.0;
  return colmap_from_camera * glm::inverse(glm::dmat4(camera.world_from_camera));
}

std::string cameras_text(const std::vector<TakenPicture>& pictures, const std::vector<std::size_t>& first) {
  std::string text = "# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[] (fx, fy, cx, cy)\n";
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const TakenPicture& picture = pictures[i];
    if (first[i] != i) continue;
    const double focal = focal_length_px(picture);
    text += fmt::format("{} PINHOLE {} {} {:.17g} {:.17g} {} {}\n", i + 1, picture.width, picture.height,
                        focal, focal, 0.5 * picture.width, 0.5 * picture.height);
  }
  return text;
}

std::string images_text(const std::vector<TakenPicture>& pictures, const std::vector<std::size_t>& first,
                        const std::vector<SeenPoint>& points) {
  std::string text =
      "# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME (of colmap_from_world)\n"
      "# POINTS2D[] as (X, Y, POINT3D_ID)\n";
  std::vector<std::string> seen(pictures.size());
  for (std::size_t p = 0; p < points.size(); ++p)
    for (const int i : points[p].pictures) {
      const glm::vec2 at = projected(pictures[std::size_t(i)], points[p].position);
      seen[std::size_t(i)] +=
          fmt::format("{}{} {} {}", seen[std::size_t(i)].empty() ? "" : " ", at.x, at.y, p + 1);
    }
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const glm::dmat4 pose = colmap_from_world(pictures[i].camera);
    const glm::dquat q = glm::normalize(glm::quat_cast(glm::dmat3(pose)));
    text +=
        fmt::format("{} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {} {}\n{}\n", i + 1, q.w, q.x,
                    q.y, q.z, pose[3].x, pose[3].y, pose[3].z, first[i] + 1, pictures[i].name, seen[i]);
  }
  return text;
}

std::string points_text(const std::vector<SeenPoint>& points) {
  std::string text = "# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n";
  std::vector<int> seen_before;  // for each picture, how many points of it came before
  for (std::size_t p = 0; p < points.size(); ++p) {
    const SeenPoint& point = points[p];
    text += fmt::format("{} {} {} {} {} {} {} 0", p + 1, point.position.x, point.position.y, point.position.z,
                        point.colour.x, point.colour.y, point.colour.z);
    for (const int i : point.pictures) {
      if (seen_before.size() <= std::size_t(i)) seen_before.resize(std::size_t(i) + 1, 0);
      text += fmt::format(" {} {}", i + 1, seen_before[std::size_t(i)]++);
    }
    text += "\n";
  }
  return text;
}

}  // namespace

Status write_colmap(const std::filesystem::path& folder, const std::vector<TakenPicture>& pictures,
                    const std::vector<SeenPoint>& points) {
  const std::vector<std::size_t> first = first_of_camera(pictures);
  if (Status status = write_file(folder / "cameras.txt", cameras_text(pictures, first)); !status)
    return status;
  if (Status status = write_file(folder / "images.txt", images_text(pictures, first, points)); !status)
    return status;
  return write_file(folder / "points3D.txt", points_text(points));
}

}  // namespace parvis::scene
