#include "scene/data/object_animation.h"

namespace parvis::scene {
namespace {

void deform(const Part& part, const Animation& animation, float time_s,
            const std::vector<glm::mat4>& model_from_node, Mesh& mesh) {
  std::vector<float> weights = part.deformation->weights;
  for (const WeightChannel& channel : animation.weights)
    if (channel.node == part.deformation->weights_node) sample(channel, time_s, weights);
  deform(*part.deformation, weights, model_from_node, part.node, mesh);
}

}  // namespace

void play(Object& object, const PlayedAnimation& played) {
  object.played = played;
  object.is_dynamic = true;
  const std::vector<Part>& parts = object.model->parts;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (!parts[p].deformation) continue;
    object.deformed_meshes.resize(parts.size());
    object.deformed_meshes[p] = parts[p].mesh;
  }
}

void animate(Scene& scene, double time_s) {
  for (Object& object : scene.objects) {
    if (object.played.animation == no_index) continue;
    const Animation& animation = object.model->animations[std::size_t(object.played.animation)];
    const float now_s = looped(animation, object.played.start_s + double(object.played.speed) * time_s);
    object.pose = pose_at(*object.model, animation, now_s);
    for (std::size_t p = 0; p < object.deformed_meshes.size(); ++p)
      if (const Part& part = object.model->parts[p]; part.deformation)
        deform(part, animation, now_s, object.pose, object.deformed_meshes[p]);
  }
}

}  // namespace parvis::scene
