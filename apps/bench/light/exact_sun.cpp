#include "bench/light/exact_sun.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "base/random.h"
#include "bench/reflections/views.h"
#include "graphics/reference/camera_ray.h"

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

namespace {

constexpr double min_facing = 0.03, min_m = 1e-4;

}  // namespace

SunPicture exact_sun(const DoubleTracer& tracer, const Camera& camera, const JudgedPixels& pixels,
                     glm::dvec3 to_sun, const DoubleTracer* unknown) {
  SunPicture picture(pixels.count(), -1);
  const reference::CameraRays rays(camera, pixels.width, pixels.height);
  const auto columns = std::size_t(pixels.columns());
  parallel_for(std::size_t(pixels.rows()), [&](std::size_t row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const reference::Ray ray = rays.through(
          {float(column * std::size_t(pixels.step)) + 0.5f, float(row * std::size_t(pixels.step)) + 0.5f});
      const glm::dvec3 origin(ray.origin), direction = glm::normalize(glm::dvec3(ray.direction));
      const auto hit = tracer.nearest(origin, direction, double(ray.min_m), StoppedBy::front);
      if (!hit || glm::dot(hit->normal, to_sun) < min_facing) continue;
      const glm::dvec3 point = origin + hit->distance_m * direction;
      if (unknown) {
        const auto before = unknown->nearest(origin, direction, double(ray.min_m), StoppedBy::both);
        if ((before && before->distance_m < hit->distance_m + min_m) ||
            unknown->is_blocked(point, to_sun, 0.0, StoppedBy::both))
          continue;
      }
      picture[row * columns + column] = tracer.is_blocked(point, to_sun, min_m, StoppedBy::back) ? 0 : 1;
    }
  });
  return picture;
}

void WrongSun::add(const SunPicture& truth, const SunShares& shares) {
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth[i] < 0) continue;
    ++pixels;
    wrong += (shares[i] > half_lit) != (truth[i] > 0);
  }
}

double WrongSun::percent() const {
  return pixels > 0 ? 100.0 * double(wrong) / double(pixels) : std::numeric_limits<double>::quiet_NaN();
}

glm::vec3 turned_sun(glm::vec3 to_sun, float degrees) {
  const glm::dvec3 sun = glm::normalize(glm::dvec3(to_sun));
  const glm::dvec3 aside = glm::normalize(glm::cross(glm::dvec3(0.0, 0.0, 1.0), sun));
  const double angle = glm::radians(double(degrees));
  return glm::vec3(glm::normalize(std::cos(angle) * sun + std::sin(angle) * aside));
}

namespace {

/// How high a viewer is, and between which pitches the view lies, radians.
struct Viewpoint {
  float height_m, min_pitch, max_pitch;
};
constexpr Viewpoint eyes{1.6f, -0.1f, 0.1f}, balcony{11.0f, -0.35f, 0.0f}, plan{120.0f, -1.5f, -1.1f};
constexpr std::array in_turn{eyes, balcony, eyes, plan};

constexpr double min_room_m = 0.5, same_m = 1e-6;
constexpr std::size_t tries_per_view = 4;

/// True if all that is nearest along the axes shows its front, as that which one stands inside of does not.
bool is_free(const DoubleTracer& tracer, glm::dvec3 eye) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      glm::dvec3 direction(0.0);
      direction[axis] = side;
      const auto nearest = tracer.nearest(eye, direction, 0.0, StoppedBy::both);
      if (!nearest) continue;
      const auto front = tracer.nearest(eye, direction, 0.0, StoppedBy::front);
      if (nearest->distance_m < min_room_m || !front || front->distance_m > nearest->distance_m + same_m)
        return false;
    }
  return true;
}

}  // namespace

std::vector<Camera> city_views(const scene::Scene& city, const DoubleTracer& tracer, std::size_t count,
                               int width, int height) {
  if (city.roads.empty()) fail("the city has no lanes above which its views could stand");
  Random random(11);
  std::vector<Camera> views;
  views.reserve(count);
  for (Camera camera : street_views(city, tries_per_view * count, 0.0f, 0.0f, {width, height})) {
    if (views.size() == count) break;
    const Viewpoint& viewpoint = in_turn[views.size() % in_turn.size()];
    const float heading = random.uniform(0.0f, 6.2831853f),
                pitch = random.uniform(viewpoint.min_pitch, viewpoint.max_pitch);
    const glm::vec3 eye = camera.position_in_world() + glm::vec3(0.0f, 0.0f, viewpoint.height_m);
    if (!is_free(tracer, glm::dvec3(eye))) continue;
    camera.world_from_camera =
        look_at(eye, eye + glm::vec3(std::cos(heading) * std::cos(pitch), std::sin(heading) * std::cos(pitch),
                                     std::sin(pitch)));
    views.push_back(camera);
  }
  if (views.size() < count)
    fail("of {} places above the city's lanes {} are free, of which {} were asked for",
         tries_per_view * count, views.size(), count);
  return views;
}

}  // namespace parvis::bench
