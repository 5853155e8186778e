#include "graphics/light/bench/bounced_bench.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/colour.h"
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
#include "graphics/render/light_over.h"
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

/// Radiance by the renderer whose pixels are the mean of many samples, as those of a photograph are: what is
/// compared is light, not edges.
Result<ImageF> drawn(render::Renderer& renderer, const scene::Scene& scene, const Camera& camera) {
  if (Status status =
          render::draw_frame(renderer, scene, {camera, supersample * width, supersample * height});
      !status)
    return status.errors();
  return reduced(renderer.read_radiance(), supersample);
}

double mean_luminance(const ImageF& radiance) {
  double sum = 0.0;
  for (int y = 0; y < radiance.height; ++y)
    for (int x = 0; x < radiance.width; ++x) {
      const float* pixel = radiance.at(x, y);
      sum += double(luminance({pixel[0], pixel[1], pixel[2]}));
    }
  return sum / double(radiance.width) / double(radiance.height);
}

/// Sun and sky that are brought up to date ahead of what is laid over them, so that this can be timed alone.
class SunAhead final : public render::LightOver {
 public:
  using LightOver::LightOver;
  void follow(const scene::Scene& scene) { has_news_ |= LightOver::update(scene); }
  bool update(const scene::Scene& /*scene*/) override { return std::exchange(has_news_, false); }

 private:
  bool has_news_ = false;
};

/// How much the light of all places has changed, relative to all of it.
double change(const std::vector<glm::vec4>& before, const std::vector<glm::vec4>& after) {
  double difference = 0.0, all = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    difference += double(glm::distance(before[i], after[i]));
    all += double(glm::length(before[i]));
  }
  return difference / std::max(all, 1e-12);
}

/// What a frame waits for when the hour, and with it sun and sky, has changed: the light of all places and
/// its way to the GPU. Sun and sky by themselves take their time without bounced light, too.
Status measure_update(const scene::Scene& city, Report& report) {
  SunAhead* ahead = nullptr;
  const render::MakeLight below = [&](const scene::Scene& scene,
                                      const Bounds& fixed) -> Result<std::unique_ptr<render::LightSource>> {
    Result<std::unique_ptr<render::LightSource>> light = shadows::ChosenLight::create(scene, fixed);
    if (!light) return light.errors();
    auto made = std::make_unique<SunAhead>(*std::move(light));
    ahead = made.get();
    return std::unique_ptr<render::LightSource>(std::move(made));
  };
  Result<std::unique_ptr<render::LightSource>> made =
      bounced_light::with_bounced_light(below)(city, render::bounds_of_fixed_parts(city, false));
  if (!made) return made.errors();
  render::LightSource& light = **made;
  const double traced_ms = milliseconds([&] { light.update(city); });
  if (!light.bounced()) return error("the scene has no bounced light");
  scene::Scene later = city;
  std::vector<double> samples;
  for (int i = 1; i <= 11; ++i) {
    later.data<light::DayLight>().when.time_of_day_h = 8.0 + 0.5 * double(i);
    if (Status status = light::light_scene(later); !status) return status;
    const std::vector<glm::vec4> before = light.bounced()->lobes;
    ahead->follow(later);
    glFinish();
    samples.push_back(milliseconds([&] { light.update(later), glFinish(); }));
    if (change(before, light.bounced()->lobes) < 1e-3)
      return error("the bounced light has not changed with the hour");
  }
  const Median update = median(samples);
  report.add("bounced_light_update_ms", update.value, up_to(50.0));
  report.add_control("bounced_light_update_ms_with_its_rays", traced_ms, up_to(50.0));
  report.note(
      fmt::format("95 % interval {:.1f} to {:.1f} ms, from half an hour to the next; control: the "
                  "first light, with its rays",
                  update.low, update.high));
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
  double flip_with = 0.0, flip_without = 0.0, flip_brightened = 0.0, flip_of_noise = -1.0;
  for (const double hour : hours)
    for (const scene::NamedCamera& view : views) {
      for (scene::Scene* scene : {&with, &without}) {
        scene->data<light::DayLight>().when.time_of_day_h = hour;
        if (Status status = light::light_scene(*scene); !status) return status;
      }
      const Camera& camera = view.camera;
      const Result<ImageF> seen_with = drawn(**bounced, with, camera),
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
      const double lacking = mean_luminance(photograph->radiance) / mean_luminance(*seen_without);
      const Image8 pictures[]{shading::tone_mapped_picture(*seen_with, with.exposure),
                              shading::tone_mapped_picture(*seen_without, with.exposure),
                              shading::tone_mapped_picture(*seen_without, float(lacking) * with.exposure)};
      double flips[3];
      for (int i = 0; i < 3; ++i) {
        const auto difference = reference::compare(pictures[i], truth);
        if (!difference) return difference.errors();
        flips[i] = difference->flip;
      }
      flip_with += flips[0], flip_without += flips[1], flip_brightened += flips[2];
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
  report.add_control("flip_to_photograph_over_without_bounces_brightened_control",
                     flip_brightened / flip_without, up_to(0.6));
  report.add("flip_between_two_photographs", flip_of_noise);
  report.note(
      "flip_between_two_photographs: of the first view, by another seed: noise that no picture can match");
  report.note("control: pictures without bounced light, as bright in the mean as the photograph");
  return Done{};
}

}  // namespace parvis::bench
