#include "graphics/reference/seen_points.h"

#include "graphics/reference/camera_ray.h"

namespace parvis::reference {
namespace {

constexpr float same_place_share = 1e-3f;  // of the distance: nearer than this to what a picture sees is seen

bool sees(const RayScene& rays, const scene::TakenPicture& picture, glm::vec3 position) {
  const Camera& camera = picture.camera;
  if (glm::dot(position - camera.position_in_world(), camera.forward_in_world()) <= camera.near_m)
    return false;
  const glm::vec2 pixel = scene::projected(picture, position);
  if (pixel.x < 0.0f || pixel.y < 0.0f || pixel.x >= float(picture.width) || pixel.y >= float(picture.height))
    return false;
  const std::optional<Hit> hit = rays.nearest_hit(camera_ray(camera, picture.width, picture.height, pixel));
  const float distance_m = glm::length(position - camera.position_in_world());
  return hit && std::abs(hit->distance_m - distance_m) < same_place_share * distance_m;
}

}  // namespace

std::vector<scene::SeenPoint> seen_points(const RayScene& rays,
                                          const std::vector<scene::TakenPicture>& pictures,
                                          const std::vector<Image8>& photographs, int step) {
  std::vector<scene::SeenPoint> points;
  for (std::size_t i = 0; i < pictures.size(); ++i)
    for (int y = step / 2; y < pictures[i].height; y += step)
      for (int x = step / 2; x < pictures[i].width; x += step) {
        const glm::vec2 centre(float(x) + 0.5f, float(y) + 0.5f);
        const Ray ray = camera_ray(pictures[i].camera, pictures[i].width, pictures[i].height, centre);
        const std::optional<Hit> hit = rays.nearest_hit(ray);
        if (!hit) continue;
        const std::uint8_t* colour = photographs[i].at(x, y);
        scene::SeenPoint point{
            ray.origin + hit->distance_m * ray.direction, {colour[0], colour[1], colour[2]}, {}};
        for (std::size_t j = 0; j < pictures.size(); ++j)
          if (j == i || sees(rays, pictures[j], point.position)) point.pictures.push_back(int(j));
        points.push_back(std::move(point));
      }
  return points;
}

}  // namespace parvis::reference
