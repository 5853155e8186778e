#include "graphics/light/bench/bounced_bench.h"

#include <algorithm>
#include <vector>

#include "base/reduction.h"
#include "graphics/bounced_light/bounced_over.h"
#include "graphics/lamps/lamp_light.h"
#include "graphics/lamps/lamp_process.h"
#include "graphics/light/bench/street_camera.h"
#include "graphics/light/day_light.h"
#include "graphics/reference/metrics.h"
#include "graphics/reference/photograph.h"
#include "graphics/render/fixed_parts.h"
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

/// What a frame waits for when the sun has moved: the light of all places and its way to the GPU.
Status measure_update(const scene::Scene& city, Report& report) {
  Result<std::unique_ptr<render::LightSource>> made = bounced_light::with_bounced_light(
      shadows::ChosenLight::create)(city, render::bounds_of_fixed_parts(city, false));
  if (!made) return made.errors();
  render::LightSource& light = **made;
  const double traced_ms = milliseconds([&] { light.update(city); });
  scene::Scene later = city;
  std::vector<double> samples, still_samples;
  int followed = 0;
  const auto has_changed = [&](const std::vector<glm::vec4>& before) {
    double difference = 0.0, all = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      difference += double(glm::distance(before[i], light.bounced()->lobes[i]));
      all += double(glm::length(before[i]));
    }
    return difference > 1e-3 * all;
  };
  if (!light.bounced()) return error("the scene has no bounced light");
  for (int i = 1; i <= 11; ++i) {
    later.sun.direction_to_sun =
        glm::normalize(city.sun.direction_to_sun + glm::vec3(0.02f * float(i), 0.0f, 0.0f));
    const std::vector<glm::vec4> before = light.bounced()->lobes;
    samples.push_back(milliseconds([&] { light.update(later), glFinish(); }));
    followed += has_changed(before) ? 1 : 0;
    still_samples.push_back(milliseconds([&] { light.update(later), glFinish(); }));
  }
  const Median update = median(samples);
  if (followed < int(samples.size()))
    return error("only {} of {} updates changed the bounced light", followed, samples.size());
  report.add("bounced_light_update_ms", update.value, up_to(50.0));
  report.add("bounced_light_update_ms_of_a_sun_that_stays", median(still_samples).value);
  report.note(fmt::format("95 % interval {:.1f} to {:.1f} ms; the first light took {:.1f} s", update.low,
                          update.high, traced_ms / 1e3));
  return Done{};
}

/// The scene's own first views, then others from its streets.
std::vector<scene::NamedCamera> views_of(const scene::Scene& city, std::size_t count) {
  std::vector<scene::NamedCamera> views(
      city.cameras.begin(),
      city.cameras.begin() + std::ptrdiff_t(std::min<std::size_t>(5, city.cameras.size())));
  Random random(7);
  for (int i = 0; views.size() < count; ++i)
    views.push_back(
        {.name = fmt::format("street {}", i + 1), .camera = street_camera(city, i, random), .follows = {}});
  views.resize(count);
  return views;
}

}  // namespace

Status measure_bounced_light(const BenchSetup& setup, const scene::Scene& city, Report& report) {
  scene::Scene with = still_city(city);
  if (with.objects.empty() || with.cameras.empty())
    return error("the scene has nothing static or no cameras to photograph");
  with.data<scene::BouncedSettings>().is_on = true;
  if (Status status = measure_update(with, report); !status) return status;
  scene::Scene without = with;
  without.data<scene::BouncedSettings>().is_on = false;
  auto bounced = renderer_of(with), plain = renderer_of(without);
  if (!bounced) return bounced.errors();
  if (!plain) return plain.errors();

  const std::vector<double> hours =
      setup.is_quick ? std::vector{9.0, 13.6} : std::vector{6.4, 9.0, 13.6, 19.8};
  const std::vector<scene::NamedCamera> views = views_of(with, setup.is_quick ? 2 : 20);
  double flip_with = 0.0, flip_without = 0.0, flip_darkened = 0.0, flip_of_noise = -1.0;
  for (const double hour : hours)
    for (const scene::NamedCamera& view : views) {
      for (scene::Scene* scene : {&with, &without}) {
        scene->data<light::DayLight>().when.time_of_day_h = hour;
        if (Status status = light::light_scene(*scene); !status) return status;
      }
      const Camera& camera = view.camera;
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
      report.note(fmt::format("{} at {} h: FLIP {:.3f} with, {:.3f} without bounced light", view.name, hour,
                              flips[0], flips[1]));
    }
  report.add("flip_to_photograph_over_without_bounces", flip_with / flip_without, up_to(0.6));
  report.add_control("flip_to_photograph_over_half_exposed_control", flip_darkened / flip_without,
                     up_to(0.6));
  report.add("flip_between_two_photographs", flip_of_noise);
  report.note(
      "flip_between_two_photographs: of the first view, by another seed: noise that no picture can match");
  report.note("control: the photograph itself at half its exposure, in place of the picture");
  return Done{};
}

}  // namespace parvis::bench
