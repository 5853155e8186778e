#include "bench/light/double_tracer.h"

#include <algorithm>
#include <cmath>

namespace parvis::bench {
namespace {

constexpr int leaf_triangles = 8;

bool is_in_twin(const scene::Object& object, const scene::Part& part) {
  const scene::Material& material = object.model->materials[std::size_t(part.material)];
  return !object.is_dynamic && material.alpha_mode == scene::Alpha::opaque && !material.refracts() &&
         part.casts_shadow;
}

/// Copies of the visible objects, with their parts that are in the twin or with those that are not.
scene::Scene copy_of(const scene::Scene& scene, bool is_twin) {
  scene::Scene copied;
  for (const scene::Object& object : scene.objects) {
    if (!object.is_visible) continue;
    auto model = std::make_shared<scene::Model>();
    model->nodes = object.model->nodes;
    for (const scene::Material& material : object.model->materials) {
      scene::Material plain;
      plain.base_colour = glm::vec3(0.5f), plain.is_double_sided = material.is_double_sided;
      model->materials.push_back(plain);
    }
    for (const scene::Part& part : object.model->parts)
      if (is_in_twin(object, part) == is_twin) model->parts.push_back(part);
    if (model->parts.empty()) continue;
    scene::Object copy;
    copy.name = object.name, copy.model = model;
    copy.world_from_model = object.world_from_model, copy.pose = object.pose;
    copied.objects.push_back(std::move(copy));
  }
  return copied;
}

}  // namespace

scene::Scene opaque_twin(const scene::Scene& scene) { return copy_of(scene, true); }

scene::Scene rest_of_twin(const scene::Scene& scene) { return copy_of(scene, false); }

DoubleTracer::DoubleTracer(const scene::Scene& twin) {
  for (const scene::Object& object : twin.objects) {
    const std::vector<glm::mat4> pose = object.pose.empty() ? scene::rest_pose(*object.model) : object.pose;
    for (const scene::Part& part : object.model->parts) {
      const glm::dmat4 world(object.world_from_model * pose[std::size_t(part.node)]);
      const bool is_mirrored = glm::determinant(glm::dmat3(world)) < 0.0;  // its triangles turn the other way
      const bool is_double = object.model->materials[std::size_t(part.material)].is_double_sided;
      for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
        Triangle triangle;
        for (std::size_t k = 0; k < 3; ++k)
          triangle.corners[k] =
              glm::dvec3(world * glm::dvec4(part.mesh.positions[part.mesh.indices[i + k]], 1.0));
        if (is_mirrored) std::swap(triangle.corners[1], triangle.corners[2]);
        triangles_.push_back(triangle);
        if (is_double)
          triangles_.push_back({{triangle.corners[0], triangle.corners[2], triangle.corners[1]}});
      }
    }
  }
  if (!triangles_.empty()) divide(0, int(triangles_.size()));
}

void DoubleTracer::divide(int first, int count) {
  const auto number = boxes_.size();
  boxes_.emplace_back();
  Box box;
  for (int i = first; i < first + count; ++i)
    for (const glm::dvec3& corner : triangles_[std::size_t(i)].corners)
      box.min = glm::min(box.min, corner), box.max = glm::max(box.max, corner);
  const glm::dvec3 size = box.max - box.min;
  const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  if (count <= leaf_triangles) {
    box.first = first, box.count = count;
    boxes_[number] = box;
    return;
  }
  const auto begin = triangles_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count, [axis](const Triangle& a, const Triangle& b) {
    return a.centre()[axis] < b.centre()[axis];
  });
  divide(first, count / 2);
  box.second_child = int(boxes_.size());
  boxes_[number] = box;
  divide(first + count / 2, count - count / 2);
}

std::optional<DoubleTracer::Hit> DoubleTracer::nearest(glm::dvec3 origin, glm::dvec3 direction, double min_m,
                                                       StoppedBy side) const {
  std::optional<Hit> found;
  double max_m = 1e30;
  std::vector<int> open;
  if (!boxes_.empty()) open.push_back(0);
  while (!open.empty()) {
    const int number = open.back();
    open.pop_back();
    const Box& box = boxes_[std::size_t(number)];
    const glm::dvec3 a = (box.min - origin) / direction, b = (box.max - origin) / direction;
    double from = min_m, to = max_m;
    for (int c = 0; c < 3; ++c) {
      if (direction[c] == 0.0) {
        if (origin[c] < box.min[c] || origin[c] > box.max[c]) from = 2e30;
        continue;
      }
      from = std::max(from, std::min(a[c], b[c])), to = std::min(to, std::max(a[c], b[c]));
    }
    if (from > to + 1e-9) continue;
    if (box.count == 0) {
      open.push_back(number + 1), open.push_back(box.second_child);
      continue;
    }
    for (int i = box.first; i < box.first + box.count; ++i) {  // Moeller and Trumbore 1997
      const Triangle& t = triangles_[std::size_t(i)];
      const glm::dvec3 e1 = t.corners[1] - t.corners[0], e2 = t.corners[2] - t.corners[0];
      const glm::dvec3 p = glm::cross(direction, e2);
      const double determinant = glm::dot(e1, p);
      if (determinant == 0.0 || (side == StoppedBy::front && determinant < 0.0) ||
          (side == StoppedBy::back && determinant > 0.0))
        continue;
      const glm::dvec3 s = origin - t.corners[0], q = glm::cross(s, e1);
      const double u = glm::dot(s, p) / determinant, v = glm::dot(direction, q) / determinant;
      const double distance = glm::dot(e2, q) / determinant;
      if (u < 0.0 || v < 0.0 || u + v > 1.0 || distance <= min_m || distance >= max_m) continue;
      max_m = distance;
      found = Hit{distance, glm::normalize(glm::cross(e1, e2))};
    }
  }
  return found;
}

}  // namespace parvis::bench
