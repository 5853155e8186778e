#include "reflections/reference_maps/placement_plan.h"

#include <algorithm>
#include <cmath>

#include "base/bounds.h"
#include "base/reduction.h"

namespace parvis::reference_maps {
namespace {

constexpr float fov = 0.2f;        // radians; from so far that roofs hardly hide streets
constexpr float margin_m = 40.0f;  // beyond the outermost map
constexpr int samples = 2;         // a side of a pixel
constexpr float disc_px = 6.0f, ring_px = 9.0f, line_px = 2.0f;
constexpr glm::vec3 disc_colour(255, 120, 20), ring_colour(60, 190, 255), outline_colour(20, 20, 20);

Camera camera_over(const Bounds& area) {
  const glm::vec3 centre = area.centre(), size = area.size();
  const float half_m = 0.5f * std::max(size.x, size.y) + margin_m;
  const float height_m = half_m / std::tan(0.5f * fov);
  Camera camera;
  camera.world_from_camera = look_at(centre + glm::vec3(0, 0, height_m), centre, {0, 1, 0});
  camera.vertical_fov = fov;
  camera.near_m = 0.5f * height_m;
  camera.far_m = 2.0f * height_m;
  return camera;
}

/// Paints what lies between two distances from a point.
void paint_ring(Image8& image, glm::vec2 centre, float inner_px, float outer_px, glm::vec3 colour) {
  const glm::ivec2 low(glm::floor(centre - outer_px)), high(glm::ceil(centre + outer_px));
  for (int y = std::max(low.y, 0); y <= std::min(high.y, image.height - 1); ++y)
    for (int x = std::max(low.x, 0); x <= std::min(high.x, image.width - 1); ++x) {
      const float off = glm::distance(glm::vec2(x, y) + 0.5f, centre);
      if (off < inner_px || off > outer_px) continue;
      for (int channel = 0; channel < 3; ++channel) image.at(x, y)[channel] = std::uint8_t(colour[channel]);
    }
}

}  // namespace

Image8 placement_plan(render::Renderer& renderer, const scene::Scene& scene,
                      std::span<const glm::vec3> places, std::span<const glm::vec3> others, int side_px) {
  Bounds area;
  for (const std::span<const glm::vec3> some : {places, others})
    for (const glm::vec3& place : some) area.add(place);
  const Camera camera = camera_over(area);
  scene::Scene clear = scene;
  clear.haze_per_m = 0.0f;
  for (scene::Object& object : clear.objects) object.is_visible &= !object.is_dynamic;

  const int side = samples * side_px;
  renderer.begin_still_frame(clear, camera);
  renderer.prepare_main_view(camera, side, side);
  renderer.draw_main_view();
  Image8 picture = renderer.read_picture(clear.exposure);

  const glm::mat4 clip_from_world = camera.clip_from_camera(1.0f) * camera.camera_from_world();
  const auto pixel_of = [&](glm::vec3 place) {
    const glm::vec4 clip = clip_from_world * glm::vec4(place, 1.0f);
    return glm::vec2(0.5f + 0.5f * clip.x / clip.w, 0.5f - 0.5f * clip.y / clip.w) * float(side);
  };
  const float scale = float(samples);
  for (const glm::vec3& place : others) {
    paint_ring(picture, pixel_of(place), scale * (ring_px - 1.5f * line_px),
               scale * (ring_px + 0.5f * line_px), outline_colour);
    paint_ring(picture, pixel_of(place), scale * (ring_px - line_px), scale * ring_px, ring_colour);
  }
  for (const glm::vec3& place : places) {
    paint_ring(picture, pixel_of(place), 0.0f, scale * (disc_px + line_px), outline_colour);
    paint_ring(picture, pixel_of(place), 0.0f, scale * disc_px, disc_colour);
  }
  return reduced(picture, samples);
}

}  // namespace parvis::reference_maps
