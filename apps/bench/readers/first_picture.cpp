#include "bench/readers/first_picture.h"

#include "base/reduction.h"
#include "bench/flip_between.h"
#include "graphics/reference/camera_ray.h"
#include "graphics/reference/ray_scene.h"
#include "graphics/shading/tone_curve.h"
#include "scene/data/surroundings.h"

namespace parvis::bench {

bool is_of_place(const scene::Scene& scene, const scene::Object& object) {
  return object.name != "terrain" && !scene::surrounds_place(scene, object);
}

Image8 pixels_of_place(const scene::Scene& scene, const Camera& camera, int width, int height) {
  const reference::RayScene rays(scene);
  Image8 shown(width, height, 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto hit = rays.nearest_hit(reference::camera_ray(camera, width, height, glm::vec2(x, y) + 0.5f));
      if (!hit) continue;
      const auto object = std::size_t(hit->place->object);
      if (object >= scene.objects.size() || is_of_place(scene, scene.objects[object])) *shown.at(x, y) = 255;
    }
  return shown;
}

Result<PictureError> error_of_picture(house::Stage& stage, const Camera& camera, const Image8& picture) {
  constexpr int coarser = 8, samples_per_pixel = 8;
  const Image8 drawn = reduced(picture, coarser);
  const Image8 place = pixels_of_place(stage.scene(), camera, drawn.width, drawn.height);
  const reference::TracedPicture traced = stage.trace(camera, drawn.width, drawn.height, samples_per_pixel);
  const Image8 expected = shading::tone_mapped_picture(traced.radiance, stage.scene().exposure);
  const Result<double> off = flip_between(drawn, expected, place),
                       black = flip_between(Image8(drawn.width, drawn.height, 3), expected, place);
  if (!off) return off.errors();
  if (!black) return black.errors();
  return PictureError{*off, *black};
}

}  // namespace parvis::bench
