#include "life/crowd/person_model.h"

#include <algorithm>
#include <limits>

#include "base/bounds.h"

namespace parvis::crowd {
namespace {

constexpr int samples = 48;              // of a cycle
constexpr float foot_fraction = 0.2f;    // of the height, below which nodes belong to feet
constexpr std::size_t max_joints = 256;  // posed for each person in every frame
constexpr float min_step_m = 0.1f;       // less is no walking

}  // namespace

Result<PersonModel> person_model(std::shared_ptr<const scene::Model> model) {
  if (model->animations.empty() || model->animations.front().duration_s <= 0.0f)
    return error("a person's model has no animation; export it with a cycle of walking on the spot");
  for (const scene::Part& part : model->parts)
    if (part.deformation && part.deformation->skin.joints.size() > max_joints)
      return error(
          "a person's model has {} joints in the skin of \"{}\", expected at most {}; export it without the "
          "bones of "
          "face and fingers",
          part.deformation->skin.joints.size(), part.object, max_joints);
  const scene::Animation& walk = model->animations.front();
  const float height = scene::bounds(*model).max.z;
  const std::size_t nodes = model->nodes.size();
  std::vector<float> front(nodes, -std::numeric_limits<float>::max()),
      rear(nodes, std::numeric_limits<float>::max()), mean_z(nodes, 0.0f);
  for (int s = 0; s < samples; ++s) {
    const std::vector<glm::mat4> pose =
        scene::pose_at(*model, walk, walk.duration_s * float(s) / float(samples));
    for (std::size_t n = 0; n < nodes; ++n) {
      const glm::vec3 at(pose[n][3]);
      front[n] = std::max(front[n], at.x), rear[n] = std::min(rear[n], at.x);
      mean_z[n] += at.z / float(samples);
    }
  }
  float step_m = 0.0f;
  for (std::size_t n = 0; n < nodes; ++n)
    if (mean_z[n] < foot_fraction * height) step_m = std::max(step_m, front[n] - rear[n]);
  if (step_m < min_step_m)
    return error(
        "a person's model does not walk in its animation \"{}\": nothing near the ground moves forward and "
        "back along "
        "its x axis; turn it with heading_deg, or export a cycle of walking on the spot",
        walk.name);
  return PersonModel{std::move(model), 0, 2.0f * step_m, walk.duration_s};
}

}  // namespace parvis::crowd
