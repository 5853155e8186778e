#include "graphics/light/bench/bounced_bench.h"

#include <algorithm>

#include "base/reduction.h"
#include "graphics/bounced_light/bounced_over.h"
#include "graphics/bounced_light/transfer.h"
#include "graphics/lamps/lamp_light.h"
#include "graphics/lamps/lamp_process.h"
#include "graphics/light/day_light.h"
#include "graphics/reference/metrics.h"
#include "graphics/reference/photograph.h"
#include "graphics/render/frame_views.h"
#include "graphics/shading/tone_curve.h"
#include "graphics/shadows/chosen_light.h"

namespace parvis::bench {
namespace {

constexpr int width = 192, height = 108;
constexpr int supersample = 4;  // of the renderer's pictures, across and down

/// The city without dynamic objects: neither traffic nor parked cars.
scene::Scene still_city(const scene::Scene& city) {
  scene::Scene still = city;
  std::erase_if(still.objects, [](const scene::Object& object) { return object.is_dynamic; });
  return still;
}

Result<std::unique_ptr<render::Renderer>> renderer_of(const scene::Scene& scene) {
  return render::Renderer::create(
      scene, {}, bounced_light::with_bounced_light(lamps::with_lamps(shadows::ChosenLight::create)));
}

/// A picture of the renderer whose pixels are the mean of many samples, as those of a photograph are: what is
/// compared is light, not edges.
Result<Image8> drawn(render::Renderer& renderer, const scene::Scene& scene, const Camera& camera) {
  if (Status status =
          render::draw_frame(renderer, scene, {camera, supersample * width, supersample * height});
      !status)
    return status.errors();
  return shading::tone_mapped_picture(reduced(renderer.read_radiance(), supersample), scene.exposure);
}

void measure_update(const scene::Scene& city, Report& report) {
  const reference::RayScene rays(city);
  bounced_light::Transfer transfer;
  const double traced_ms = milliseconds(
      [&] { transfer = bounced_light::Transfer(city, rays, city.data<scene::BouncedSettings>()); });
  const shading::SkyLight sky =
      shading::make_sky_light(city.sky.picture, city.sky.intensity, city.sky.heading);
  std::vector<double> samples;
  for (int i = 0; i < 11; ++i) {
    scene::Sun sun = city.sun;
    sun.direction_to_sun = glm::normalize(sun.direction_to_sun + glm::vec3(0.02f * float(i), 0.0f, 0.0f));
    samples.push_back(milliseconds([&] { transfer.light(sun, sky); }));
  }
  const Median update = median(samples);
  report.add("bounced_light_update_ms", update.value, up_to(50.0));
  report.note(fmt::format("95 % interval {:.1f} to {:.1f} ms; {} places, {} patches; traced once in {:.1f} s",
                          update.low, update.high, transfer.place_count(), transfer.patches().size(),
                          traced_ms / 1e3));
}

}  // namespace

Status measure_bounced_light(const BenchSetup& setup, const scene::Scene& city, Report& report) {
  scene::Scene with = still_city(city);
  if (with.objects.empty() || with.cameras.empty())
    return error("the scene has nothing static or no cameras to photograph");
  with.data<scene::BouncedSettings>().is_on = true;
  measure_update(with, report);
  scene::Scene without = with;
  without.data<scene::BouncedSettings>().is_on = false;
  auto bounced = renderer_of(with), plain = renderer_of(without);
  if (!bounced) return bounced.errors();
  if (!plain) return plain.errors();

  const std::vector<double> hours =
      setup.is_quick ? std::vector{9.0, 13.6} : std::vector{6.4, 9.0, 13.6, 19.8};
  const std::size_t views = std::min<std::size_t>(setup.is_quick ? 2 : 5, with.cameras.size());
  double flip_with = 0.0, flip_without = 0.0, flip_darkened = 0.0, flip_of_noise = -1.0;
  for (const double hour : hours)
    for (std::size_t v = 0; v < views; ++v) {
      for (scene::Scene* scene : {&with, &without}) {
        scene->data<light::DayLight>().when.time_of_day_h = hour;
        if (Status status = light::light_scene(*scene); !status) return status;
      }
      const Camera camera = with.cameras[v].camera;
      const Result<Image8> seen_with = drawn(**bounced, with, camera),
                           seen_without = drawn(**plain, without, camera);
      if (!seen_with) return seen_with.errors();
      if (!seen_without) return seen_without.errors();
      const reference::RayScene rays(with);
      reference::PhotographOptions options;
      options.samples_per_pixel = setup.is_quick ? 96 : 256;
      const auto photograph =
          reference::take_photograph(rays, with, (*bounced)->sky(), camera, width, height, options);
      if (!photograph) return photograph.errors();
      const Image8 truth = shading::tone_mapped_picture(photograph->radiance, with.exposure);
      const Image8 darkened = shading::tone_mapped_picture(photograph->radiance, 0.5f * with.exposure);
      double flips[3];
      const Image8* pictures[]{&*seen_with, &*seen_without, &darkened};
      for (int i = 0; i < 3; ++i) {
        const auto difference = reference::compare(*pictures[i], truth);
        if (!difference) return difference.errors();
        flips[i] = difference->flip;
      }
      flip_with += flips[0], flip_without += flips[1], flip_darkened += flips[2];
      if (flip_of_noise < 0.0) {
        options.seed = 2;
        const auto other =
            reference::take_photograph(rays, with, (*bounced)->sky(), camera, width, height, options);
        if (!other) return other.errors();
        const auto noise =
            reference::compare(shading::tone_mapped_picture(other->radiance, with.exposure), truth);
        if (!noise) return noise.errors();
        flip_of_noise = noise->flip;
      }
      report.note(fmt::format("{} at {} h: FLIP {:.3f} with, {:.3f} without bounced light",
                              with.cameras[v].name, hour, flips[0], flips[1]));
    }
  report.add("flip_to_photograph_over_without_bounces", flip_with / flip_without, up_to(0.6));
  report.add("flip_to_photograph_over_half_exposed_control", flip_darkened / flip_without);
  report.add("flip_between_two_photographs", flip_of_noise);
  report.note(
      "flip_between_two_photographs: of the first view, by another seed: noise that no picture can match");
  report.note("control: the photograph itself at half its exposure, in place of the picture");
  return Done{};
}

}  // namespace parvis::bench
