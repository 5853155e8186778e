#include "capture/trees/synthetic_capture.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>

#include "base/colour.h"
#include "base/content_hash.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "base/random.h"
#include "graphics/reference/camera_ray.h"
#include "graphics/reference/path_tracer.h"
#include "graphics/shading/sky.h"
#include "scene/data/scene_key.h"

namespace parvis::trees {
namespace {

constexpr float fov = 0.52f;                             // radians: a lens of about 65 mm
constexpr float lowest_deg = 2.0f, highest_deg = 26.0f;  // of the cameras, above the tree's middle
constexpr float golden_share = 0.61803399f;
constexpr int tracer_version = 1;  // to be raised whenever the same scene gives other photographs

/// Distance at which the box fills the picture's height or width, from the highest camera.
float distance_m(const Bounds& tree) {
  const glm::vec3 half = 0.5f * tree.size();
  const float across = std::max(half.x, half.y), above = glm::radians(highest_deg);
  return std::max(half.z * std::cos(above) + across * std::sin(above), across) / std::tan(0.5f * fov) +
         0.5f * across;
}

Camera camera_at(const Bounds& tree, float azimuth, float elevation) {
  Camera camera;
  const glm::vec3 out(std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation),
                      std::sin(elevation));
  camera.world_from_camera = look_at(tree.centre() + distance_m(tree) * out, tree.centre());
  camera.vertical_fov = fov;
  return camera;
}

/// A photograph that was kept; none where it has not as many pixels as these options give it.
std::optional<Image8> kept_picture(const KeptParts& checkpoint, const std::string& name, std::uint64_t key,
                                   const CaptureOptions& options) {
  const std::optional<std::string> bytes = checkpoint.find(name, key);
  Image8 picture(options.width, options.height, 4);
  if (!bytes || bytes->size() != picture.pixels.size()) return std::nullopt;
  std::ranges::copy(*bytes, picture.pixels.begin());
  return picture;
}

}  // namespace

scene::Scene capture_scene(const scene::Model& model, const CaptureLight& light) {
  scene::Scene scene;
  scene::Object tree;
  tree.name = "tree", tree.model = std::make_shared<scene::Model>(model);
  scene.objects.push_back(std::move(tree));
  const float azimuth = glm::radians(light.sun_azimuth_deg), height = glm::radians(light.sun_height_deg);
  scene.sun.direction_to_sun = {std::sin(azimuth) * std::cos(height), std::cos(azimuth) * std::cos(height),
                                std::sin(height)};
  return scene;
}

std::vector<Camera> capture_cameras(const Bounds& tree, int count) {
  std::vector<Camera> cameras;
  for (int i = 0; i < count; ++i) {
    const float azimuth = 6.2831853f * float(i) / float(count);
    const float share = float(i) * golden_share - std::floor(float(i) * golden_share);
    cameras.push_back(camera_at(tree, azimuth, glm::radians(glm::mix(lowest_deg, highest_deg, share))));
  }
  return cameras;
}

std::vector<Camera> held_out_cameras(const Bounds& tree, int count, std::uint64_t seed) {
  Random random(seed, 400);
  std::vector<Camera> cameras;
  for (int i = 0; i < count; ++i) {
    const float azimuth = random.uniform(0.0f, 6.2831853f);
    cameras.push_back(camera_at(tree, azimuth, glm::radians(random.uniform(lowest_deg, highest_deg))));
  }
  return cameras;
}

TreeView photograph_tree(const scene::Scene& scene, const Camera& camera, std::string name, float at_exposure,
                         const CaptureOptions& options) {
  const reference::RayScene rays(scene);
  const shading::SkyLight sky =
      shading::make_sky_light(scene.sky.picture, scene.sky.intensity, scene.sky.heading);
  reference::PathOptions paths;
  paths.bounces = options.bounces;
  const reference::PathTracer tracer(rays, scene, sky, paths);
  TreeView view{std::move(name), pinhole_of(camera, options.width, options.height),
                Image8(options.width, options.height, 4)};
  const float spread = 2.0f * std::tan(0.5f * camera.vertical_fov) / float(options.height) /
                       std::sqrt(float(options.samples_per_pixel));
  parallel_for(std::size_t(options.height), [&](std::size_t row) {
    for (int x = 0; x < options.width; ++x) {
      const auto pixel = std::uint32_t(int(row) * options.width + x);
      glm::vec3 sum(0.0f);
      int met = 0;
      for (int i = 0; i < options.samples_per_pixel; ++i) {
        reference::SampleSequence numbers(options.seed, pixel, std::uint32_t(i));
        const glm::vec2 place = glm::vec2(float(x), float(row)) + numbers.next_2d();
        const std::uint64_t chance = (options.seed << 40) ^ (std::uint64_t(pixel) << 16) ^ std::uint64_t(i);
        const reference::PathTracer::Sample sample = tracer.sample(
            reference::camera_ray(camera, options.width, options.height, place), spread, numbers, chance);
        if (sample.meets_scene) sum += sample.radiance, ++met;
      }
      const glm::vec3 colour =
          srgb_from_linear(glm::min(sum * (at_exposure / float(std::max(met, 1))), 1.0f));
      std::uint8_t* out = view.picture.at(x, int(row));
      for (int c = 0; c < 3; ++c) out[c] = std::uint8_t(std::lround(255.0f * colour[c]));
      out[3] = std::uint8_t(std::lround(255.0f * float(met) / float(options.samples_per_pixel)));
    }
  });
  return view;
}

std::uint64_t photograph_key(std::uint64_t shown_scene, const Camera& camera, float exposure,
                             const CaptureOptions& options) {
  ContentHash hash;
  hash.add(tracer_version), hash.add(shown_scene);
  hash.add(camera.world_from_camera), hash.add(camera.vertical_fov), hash.add(exposure);
  for (const int number : {options.width, options.height, options.samples_per_pixel, options.bounces})
    hash.add(number);
  hash.add(options.seed);
  return hash.value();
}

std::vector<TreeView> photograph_tree(const scene::Scene& scene, std::span<const Camera> cameras,
                                      const std::string& name, const CaptureOptions& options) {
  return *photograph_tree(scene, cameras, name, options, KeptParts());  // what keeps nothing cannot fail
}

Result<std::vector<TreeView>> photograph_tree(const scene::Scene& scene, std::span<const Camera> cameras,
                                              const std::string& name, const CaptureOptions& options,
                                              const KeptParts& checkpoint) {
  Progress progress("photographing " + name, cameras.size());
  const std::uint64_t shown_scene = checkpoint.keeps_parts() ? scene::scene_key(scene) : 0;
  std::vector<TreeView> views;
  views.reserve(cameras.size());
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    CaptureOptions own = options;
    own.seed = options.seed + 7919 * i;
    const std::string own_name = fmt::format("{}_{:03}", name, i);
    const std::uint64_t key = photograph_key(shown_scene, cameras[i], capture_exposure, own);
    if (std::optional<Image8> picture = kept_picture(checkpoint, own_name, key, own)) {
      views.push_back({own_name, pinhole_of(cameras[i], own.width, own.height), *std::move(picture)});
    } else {
      views.push_back(photograph_tree(scene, cameras[i], own_name, capture_exposure, own));
      const std::vector<std::uint8_t>& pixels = views.back().picture.pixels;
      const std::string_view bytes(reinterpret_cast<const char*>(pixels.data()), pixels.size());
      if (Status status = checkpoint.keep(own_name, key, bytes); !status) return status.errors();
    }
    progress.advance();
  }
  return views;
}

}  // namespace parvis::trees
