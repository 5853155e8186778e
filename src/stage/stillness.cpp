#include "stage/stillness.h"

#include "base/content_hash.h"
#include "reflections/methods/settings.h"

namespace parvis::stage {

/// Models stay as they are while a scene runs, and a sky that is computed counts its versions: neither is
/// read through in each frame.
std::uint64_t state_of(const scene::Scene& scene, const Camera& camera, int width, int height,
                       const std::vector<std::uint8_t>* shown) {
  ContentHash hash;
  hash.add(camera.world_from_camera);
  hash.add(camera.tangents(float(width) / float(height)));
  if (camera.parallel) hash.add(*camera.parallel);
  for (const float value : {scene.exposure, scene.haze_per_m, scene.sky.intensity, scene.sky.heading})
    hash.add(value);
  for (const int value : {width, height, scene.sky.version}) hash.add(value);
  for (const glm::vec3 value : {scene.sun.direction_to_sun, scene.sun.irradiance}) hash.add(value);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const scene::Object& object = scene.objects[i];
    if (shown && !((*shown)[i] && object.is_visible)) continue;
    hash.add(i);
    hash.add(object.model.get());
    hash.add(object.paint.get());
    hash.add(object.world_from_model);
    hash.add(object.pose);
    hash.add(object.is_visible);
    hash.add(object.takes_reflection);
    for (const Mesh& mesh : object.deformed_meshes) hash.add(mesh.positions);
  }
  scene.room_data.hash(hash, [](scene::DataRole) { return true; });
  return hash.value();
}

void Stillness::add_frame(const scene::Scene& scene, const Camera& camera, int width, int height,
                          double passed_s) {
  const std::uint64_t state = state_of(scene, camera, width, height);
  still_s_ = state == state_ ? still_s_ + passed_s : 0.0;
  state_ = state;
}

}  // namespace parvis::stage
