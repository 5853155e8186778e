// A chequered floor and coloured boxes around one body, rendered by a method and by the ray tracer: for tests
// of reflections and refraction.
#pragma once

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "graphics/light/sun_and_sky.h"
#include "graphics/reference/metrics.h"
#include "graphics/render/test_room.h"
#include "graphics/shading/tone_curve.h"
#include "reflections/methods/frame.h"
#include "reflections/methods/reflections.h"
#include "reflections/methods/settings.h"
#include "reflections/reflector_maps/settings.h"

namespace parvis::reflector_maps {

inline constexpr int width = 320, height = 240;

/// Each triangle divided into `parts` squared triangles: only vertices are reflected exactly.
inline Mesh divided(const Mesh& mesh, int parts) {
  Mesh fine;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const std::uint32_t* corner = &mesh.indices[i];
    const std::uint32_t first = std::uint32_t(fine.positions.size());
    for (int b = 0; b <= parts; ++b)
      for (int c = 0; b + c <= parts; ++c) {
        const float v = float(b) / float(parts), w = float(c) / float(parts), u = 1.0f - v - w;
        fine.positions.push_back(u * mesh.positions[corner[0]] + v * mesh.positions[corner[1]] +
                                 w * mesh.positions[corner[2]]);
        fine.normals.push_back(mesh.normals[corner[0]]);
        fine.uvs.push_back(u * mesh.uvs[corner[0]] + v * mesh.uvs[corner[1]] + w * mesh.uvs[corner[2]]);
      }
    const auto at = [&](int b, int c) {
      return first + std::uint32_t(b * (parts + 1) - b * (b - 1) / 2 + c);
    };
    for (int b = 0; b < parts; ++b)
      for (int c = 0; b + c < parts; ++c) {
        for (const std::uint32_t v : {at(b, c), at(b + 1, c), at(b, c + 1)}) fine.indices.push_back(v);
        if (b + c + 1 < parts)
          for (const std::uint32_t v : {at(b + 1, c), at(b + 1, c + 1), at(b, c + 1)})
            fine.indices.push_back(v);
      }
  }
  return fine;
}

/// The scene; `body` is its last object.
inline scene::Scene among_boxes(const Mesh& body, const scene::Material& material,
                                const glm::mat4& world_from_body) {
  scene::Scene scene;
  scene.sun.direction_to_sun = glm::normalize(glm::vec3(-0.5f, -0.4f, 0.8f));
  for (int y = -4; y < 4; ++y)
    for (int x = -4; x < 4; ++x) {
      const glm::vec3 low(float(x), float(y), 0.0f);
      const glm::vec3 grey((x + y) % 2 ? 0.15f : 0.6f);
      scene::add(scene,
                 scene::model_of(divided(scene::quad(low, low + glm::vec3(1, 0, 0), low + glm::vec3(1, 1, 0),
                                                     low + glm::vec3(0, 1, 0)),
                                         8),
                                 scene::matt(grey)));
    }
  const auto box = [&](glm::vec3 low, glm::vec3 size, glm::vec3 colour) {
    scene::add(scene, scene::model_of(divided(scene::box(low, low + size), 12), scene::matt(colour)));
  };
  box({-2.6f, -1.5f, 0}, {0.7f, 0.7f, 1.6f}, {0.8f, 0.1f, 0.1f});
  box({1.7f, -2.2f, 0}, {0.8f, 0.6f, 1.1f}, {0.1f, 0.6f, 0.1f});
  box({-0.6f, -3.4f, 0}, {0.9f, 0.5f, 2.0f}, {0.1f, 0.2f, 0.8f});
  box({-1.0f, 2.2f, 0}, {2.0f, 0.4f, 1.4f}, {0.9f, 0.7f, 0.1f});
  std::shared_ptr<scene::Model> model = scene::model_of(body, material);
  model->name = "body";
  const int object = scene::add(scene, model, true, world_from_body);
  scene.objects[std::size_t(object)].takes_reflection = true;
  methods::settings(scene).method = "virtual_objects";
  return scene;
}

/// A translation.
inline glm::mat4 placed(glm::vec3 at) { return glm::translate(glm::mat4(1.0f), at); }

/// A rendered image, its ground truth, and the mask of mirror-like pixels.
struct Compared {
  Image8 ours, traced, mirrors;

  /// Mean FLIP error over mirror-like pixels.
  double flip() const {
    const Result<reference::Difference> difference = reference::compare(ours, traced, mirrors);
    EXPECT_TRUE(difference) << to_string(difference.errors());
    return difference ? difference->flip : 1.0;
  }
};

/// Renders the scene with the method that `make(scene, renderer)` returns (null: mirrors show the sky), and
/// traces it.
template <class Make>
Compared draw_by(const scene::Scene& scene, glm::vec3 eye, glm::vec3 target, Make make,
                 const render::Drawables& drawables = {}) {
  Result<std::unique_ptr<render::Renderer>> renderer =
      render::Renderer::create(scene, drawables, light::sun_and_sky);
  EXPECT_TRUE(renderer) << to_string(renderer.errors());
  Result<std::unique_ptr<methods::Reflections>> reflections = make(scene, **renderer);
  EXPECT_TRUE(reflections) << to_string(reflections.errors());
  const Status set = (*renderer)->set_reflection(reflections->get());
  EXPECT_TRUE(set) << to_string(set.errors());
  Camera camera;
  camera.world_from_camera = look_at(eye, target);
  EXPECT_TRUE(methods::draw_frame(**renderer, scene, reflections->get(), {camera, width, height}));
  const Image8 drawn = (*renderer)->read_picture(scene.exposure);
  const reference::TracedPicture truth = methods::trace_frame(**renderer, scene, {camera, width, height});
  return {drawn, shading::tone_mapped_picture(truth.radiance, scene.exposure), truth.mirror_mask};
}

}  // namespace parvis::reflector_maps
