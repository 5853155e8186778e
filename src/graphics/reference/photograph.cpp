#include "graphics/reference/photograph.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "base/content_hash.h"
#include "base/progress.h"
#include "base/sealed_file.h"
#include "graphics/reference/camera_ray.h"
#include "graphics/reference/photograph_checkpoint.h"
#include "machines/divided_work.h"
#include "scene/data/scene_key.h"

namespace parvis::reference {
namespace {

constexpr int tile_side = 32;  // pixels: rays of a tile meet the same parts, and its textures stay at hand
constexpr int values_per_pixel = 5;          // red, green, blue, alpha, depth
constexpr std::uint32_t method_version = 2;  // to be raised whenever the same options give other pictures

struct Tile {
  int x0, y0, x1, y1;

  std::size_t value_count() const { return std::size_t(x1 - x0) * std::size_t(y1 - y0) * values_per_pixel; }
};

Tile tile_at(std::size_t index, int width, int height) {
  const int columns = (width + tile_side - 1) / tile_side;
  const int x0 = int(index) % columns * tile_side, y0 = int(index) / columns * tile_side;
  return {x0, y0, std::min(x0 + tile_side, width), std::min(y0 + tile_side, height)};
}

std::uint64_t work_key(const scene::Scene& scene, const Camera& camera, int width, int height,
                       const PhotographOptions& options) {
  ContentHash hash;
  hash.add(method_version);
  hash.add(scene::scene_key(scene));
  hash.add(camera.world_from_camera);
  for (const float value : {camera.vertical_fov, camera.near_m, options.paths.clamp.value_or(-1.0f)})
    hash.add(value);
  if (camera.off_axis) hash.add(*camera.off_axis);
  if (camera.parallel) hash.add(*camera.parallel);
  for (const int value : {width, height, options.samples_per_pixel, options.paths.bounces.value_or(-1),
                          int(options.paths.strategy)})
    hash.add(value);
  hash.add(options.seed);
  return hash.value();
}

/// Depth of the surface at the pixel's centre; a blended surface counts where its alpha is at least 0.5.
float centre_depth_m(const RayScene& rays, const Camera& camera, int width, int height, int x, int y) {
  const Ray ray = camera_ray(camera, width, height, {float(x) + 0.5f, float(y) + 0.5f});
  Passage passage{Random(1), false};
  const std::optional<Hit> hit = rays.nearest_hit(ray, passage);
  return hit ? hit->distance_m * glm::dot(ray.direction, camera.forward_in_world()) : 0.0f;
}

/// Fills `values`; returns how many rays that took.
std::uint64_t trace_tile(const PathTracer& tracer, const RayScene& rays, const Camera& camera, int width,
                         int height, const PhotographOptions& options, const Tile& tile,
                         std::vector<float>& values) {
  const float pixel_spread = camera.height_at_1m() / float(height);
  const float spread = pixel_spread / std::sqrt(float(options.samples_per_pixel));
  std::uint64_t ray_count = 0;
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) {
      const std::uint32_t pixel = std::uint32_t(y) * std::uint32_t(width) + std::uint32_t(x);
      glm::vec3 sum(0.0f);
      int met = 0;
      for (int i = 0; i < options.samples_per_pixel; ++i) {
        SampleSequence numbers(options.seed, pixel, std::uint32_t(i));
        const glm::vec2 place = glm::vec2(float(x), float(y)) + numbers.next_2d();
        const std::uint64_t chance_seed =
            (options.seed << 40) ^ (std::uint64_t(pixel) << 16) ^ std::uint64_t(i);
        const PathTracer::Sample sample =
            tracer.sample(camera_ray(camera, width, height, place), spread, numbers, chance_seed);
        sum += sample.radiance;
        met += sample.meets_scene;
        ray_count += sample.rays;
      }
      const float samples = float(options.samples_per_pixel);
      for (int c = 0; c < 3; ++c) values.push_back(sum[c] / samples);
      values.push_back(float(met) / samples);
      values.push_back(centre_depth_m(rays, camera, width, height, x, y));
    }
  return ray_count;
}

void put_tile(const Tile& tile, std::span<const float> values, Photograph& photograph) {
  const float* value = values.data();
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x, value += values_per_pixel) {
      std::copy(value, value + 3, photograph.radiance.at(x, y));
      *photograph.alpha.at(x, y) = std::uint8_t(std::lround(255.0f * value[3]));
      *photograph.depth_m.at(x, y) = value[4];
    }
}

}  // namespace

Result<Photograph> take_photograph(const RayScene& rays, const scene::Scene& scene,
                                   const shading::SkyLight& sky, const Camera& camera, int width, int height,
                                   const PhotographOptions& options) {
  Photograph photograph{ImageF(width, height, 3), Image8(width, height, 1), ImageF(width, height, 1)};
  const std::size_t tiles =
      std::size_t((width + tile_side - 1) / tile_side) * std::size_t((height + tile_side - 1) / tile_side);
  std::vector<std::uint8_t> is_done(tiles, 0);
  std::optional<PhotographCheckpoint> checkpoint;
  if (!options.checkpoint.empty() && options.processes.is_first()) {
    const auto put_found = [&](std::uint32_t index, std::span<const float> values) {
      if (index >= tiles || values.size() != tile_at(index, width, height).value_count()) return;
      put_tile(tile_at(index, width, height), values, photograph);
      is_done[index] = 1;
    };
    Result<PhotographCheckpoint> opened =
        PhotographCheckpoint::open(options.checkpoint, work_key(scene, camera, width, height, options),
                                   options.replaces_checkpoint, put_found);
    if (!opened) return opened.errors();
    checkpoint.emplace(*std::move(opened));
  }

  machines::Tasks to_do;
  for (std::size_t i = 0; i < tiles; ++i)
    if (!is_done[i]) to_do.push_back(std::uint32_t(i));
  const PathTracer tracer(rays, scene, sky, options.paths);
  const auto start = std::chrono::steady_clock::now();
  Progress progress(options.progress, to_do.size());
  machines::DividedWork work;
  work.is_interrupted = options.is_interrupted;
  work.run = [&](std::uint32_t index) -> Result<std::string> {
    const Tile tile = tile_at(index, width, height);
    std::vector<float> values;
    values.reserve(tile.value_count());
    std::string bytes;
    append_value(bytes, trace_tile(tracer, rays, camera, width, height, options, tile, values));
    append_values(bytes, values);
    return bytes;
  };
  work.keep = [&](std::uint32_t index, std::string_view bytes) -> Status {
    ByteReader reader(bytes);
    photograph.rays += reader.take<std::uint64_t>();
    const std::vector<float> values = reader.take_values<float>();
    put_tile(tile_at(index, width, height), values, photograph);
    if (checkpoint) checkpoint->keep(index, values);
    progress.advance();
    return Ok{};
  };
  const Result<std::size_t> finished = machines::divide(options.processes, to_do, work);
  if (!finished) return finished.errors();
  photograph.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const bool is_whole = !options.processes.is_first() || *finished == to_do.size();
  if (!is_whole)
    return error("interrupted: {} of {} tiles are done{}", tiles - to_do.size() + *finished, tiles,
                 checkpoint ? fmt::format(", and {} are kept in {}; the same command goes on from there",
                                          checkpoint->tiles(), options.checkpoint.string())
                            : "");
  return photograph;
}

}  // namespace parvis::reference
