#include "capture/trees/tree_view.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace parvis::trees {

Pinhole pinhole_of(const Camera& camera, int width, int height) {
  Pinhole result;
  result.width = width, result.height = height;
  result.focal = glm::vec2(0.5f * float(height) / std::tan(0.5f * camera.vertical_fov));
  result.principal_point = 0.5f * glm::vec2(float(width), float(height));
  result.world_from_camera = glm::mat3(camera.world_from_camera);
  result.position_in_world = camera.position_in_world();
  return result;
}

Pinhole reduced(const Pinhole& camera, int factor) {
  Pinhole result = camera;
  result.width = (camera.width + factor - 1) / factor, result.height = (camera.height + factor - 1) / factor;
  result.focal /= float(factor), result.principal_point /= float(factor);
  return result;
}

ImageF reduced_alpha(const Image8& rgba, int factor) {
  ImageF result((rgba.width + factor - 1) / factor, (rgba.height + factor - 1) / factor, 1);
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x) {
      const int x1 = std::min((x + 1) * factor, rgba.width), y1 = std::min((y + 1) * factor, rgba.height);
      int sum = 0, count = 0;
      for (int v = y * factor; v < y1; ++v)
        for (int u = x * factor; u < x1; ++u) sum += rgba.at(u, v)[3], ++count;
      *result.at(x, y) = float(sum) / (255.0f * float(count));
    }
  return result;
}

glm::vec3 point_looked_at(std::span<const TreeView> views) {
  glm::dmat3 matrix(0.0);
  glm::dvec3 right(0.0), mean(0.0);
  for (const TreeView& view : views) {
    const glm::dvec3 axis = view.camera.forward(), position = view.camera.position_in_world;
    const glm::dmat3 across = glm::dmat3(1.0) - glm::outerProduct(axis, axis);
    matrix += across, right += across * position, mean += position;
  }
  if (std::abs(glm::determinant(matrix)) < 1e-9 * double(views.size()))
    return glm::vec3(mean / double(views.size()));
  return glm::vec3(glm::inverse(matrix) * right);
}

}  // namespace parvis::trees
