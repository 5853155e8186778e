#include "graphics/reference/tracer.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "base/progress.h"
#include "base/random.h"
#include "base/sealed_file.h"
#include "graphics/reference/camera_ray.h"
#include "graphics/reference/pixel_tracer.h"
#include "graphics/shading/tone_curve.h"
#include "machines/divided_work.h"

namespace parvis::reference {

using glm::vec3;

ObjectPicture trace_objects(const RayScene& rays, const Camera& camera, int width, int height) {
  ObjectPicture objects(width, height, 1);
  parallel_for(std::size_t(height), [&](std::size_t row) {
    for (int x = 0; x < width; ++x) {
      const auto hit =
          rays.nearest_hit(camera_ray(camera, width, height, {float(x) + 0.5f, float(row) + 0.5f}));
      *objects.at(x, int(row)) = hit ? std::uint32_t(hit->place->object) + 1 : 0;
    }
  });
  return objects;
}

namespace {

/// A row of a picture as it travels between processes.
struct TracedRow {
  std::uint64_t rays = 0;
  std::vector<float> radiance;             ///< linear RGB
  std::vector<std::uint8_t> mirror_share;  ///< of each pixel, 0..255
};

std::string bytes_of(const TracedRow& row) {
  std::string bytes;
  append_value(bytes, row.rays);
  append_values(bytes, row.radiance);
  append_values(bytes, row.mirror_share);
  return bytes;
}

TracedRow row_of(std::string_view bytes) {
  ByteReader reader(bytes);
  TracedRow row;
  row.rays = reader.take<std::uint64_t>();
  row.radiance = reader.take_values<float>();
  row.mirror_share = reader.take_values<std::uint8_t>();
  return row;
}

/// Traces one row of the window. Random numbers belong to the pixel of the whole picture.
TracedRow trace_row(const PixelTracer& tracer, const Camera& camera, int width, int height,
                    const TraceOptions& options, const PixelWindow& window, int row, float exposure) {
  const int side = int(std::ceil(std::sqrt(float(options.samples_per_pixel)))), samples = side * side;
  const float spread =  // of a sample's share of the pixel
      camera.height_at_1m() / float(height) / float(side);
  TracedRow traced;
  for (int column = 0; column < window.width; ++column) {
    const int x = window.x + column, y = window.y + row;
    Random random(options.seed, std::size_t(y) * std::size_t(width) + std::size_t(x));
    LobePoints lobe_points{
        {glm::vec2(random.uniform(), random.uniform()), glm::vec2(random.uniform(), random.uniform())}};
    vec3 sum(0.0f);
    float weights = 0.0f;
    int mirrors = 0, counted = 0;
    if (options.only_sample) lobe_points.skip(*options.only_sample);
    for (int i = 0; i < samples; ++i) {
      const int column_in_pixel = i % side, row_in_pixel = i / side;
      const float px = float(x) + (float(column_in_pixel) + random.uniform()) / float(side);
      const float py = float(y) + (float(row_in_pixel) + random.uniform()) / float(side);
      if (options.only_sample && *options.only_sample != i) continue;
      const Ray ray = camera_ray(camera, width, height, {px, py});
      bool is_mirror = false;
      const vec3 sample = tracer.radiance({ray, 0.0f, spread}, lobe_points, traced.rays, is_mirror);
      const float weight = shading::sample_weight(exposure * sample);
      sum += weight * sample;
      weights += weight;
      mirrors += is_mirror;
      ++counted;
    }
    for (int c = 0; c < 3; ++c) traced.radiance.push_back(sum[c] / weights);
    traced.mirror_share.push_back(std::uint8_t(255 * mirrors / std::max(counted, 1)));
  }
  return traced;
}

}  // namespace

TracedPicture trace_picture(const RayScene& rays, const scene::Scene& scene, const shading::SkyLight& sky,
                            const Camera& camera, int width, int height, const TraceOptions& options) {
  const PixelTracer tracer(rays, scene, sky, options);
  const PixelWindow window = options.window.width > 0 ? options.window : PixelWindow{0, 0, width, height};
  TracedPicture picture;
  picture.radiance = ImageF(window.width, window.height, 3);
  picture.mirror_mask = Image8(window.width, window.height, 1);
  const auto start = std::chrono::steady_clock::now();
  std::optional<Progress> progress;
  if (!options.progress.empty()) progress.emplace(options.progress, std::size_t(window.height));
  machines::DividedWork work;
  work.run = [&](std::uint32_t row) -> Result<std::string> {
    return bytes_of(trace_row(tracer, camera, width, height, options, window, int(row), scene.exposure));
  };
  work.keep = [&](std::uint32_t row, std::string_view bytes) -> Status {
    const TracedRow traced = row_of(bytes);
    std::ranges::copy(traced.radiance, picture.radiance.at(0, int(row)));
    std::ranges::copy(traced.mirror_share, picture.mirror_mask.at(0, int(row)));
    picture.rays += traced.rays;
    if (progress) progress->advance();
    return Ok{};
  };
  work.is_interrupted = options.is_interrupted;
  machines::Tasks rows(std::size_t(window.height));
  std::iota(rows.begin(), rows.end(), 0u);
  const Result<std::size_t> kept =
      machines::divide(options.processes ? *options.processes : machines::Processes(), rows, work);
  assert(kept && "rows are traced without errors");
  picture.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return picture;
}

void trace_mirrors(const RayScene& rays, const scene::Scene& scene, const shading::SkyLight& sky, vec3 eye,
                   float spread, std::span<const MirrorPixel> pixels, const TraceOptions& options,
                   std::span<std::optional<MirrorLight>> light) {
  constexpr std::size_t packet = RayScene::packet_size, packets_per_task = 4;
  const PixelTracer tracer(rays, scene, sky, options);
  parallel_for((pixels.size() + packet - 1) / packet,
               [&](std::size_t i) {
                 const std::size_t first = i * packet, count = std::min(packet, pixels.size() - first);
                 tracer.find_light_of_mirrors(pixels.subspan(first, count), eye, spread,
                                              light.subspan(first, count));
               },
               packets_per_task);
}

}  // namespace parvis::reference
