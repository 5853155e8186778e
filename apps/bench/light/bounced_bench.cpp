#include "bench/light/bounced_bench.h"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "base/colour.h"
#include "bench/light/bounced_update_bench.h"
#include "bench/light/city_views.h"
#include "bench/light/exchanged_bounces.h"
#include "bench/light/photographed_city.h"
#include "bench/light/set_hour.h"
#include "graphics/bounced_light/bounced_over.h"
#include "graphics/lamps/lamp_light.h"
#include "graphics/render/drawables.h"
#include "graphics/shading/tone_curve.h"
#include "graphics/shadows/chosen_light.h"

namespace parvis::bench {
namespace {

constexpr std::size_t own_views = 5;  // of the scene, before others

/// The city without dynamic objects: neither traffic nor parked cars.
scene::Scene still_city(const scene::Scene& city) {
  scene::Scene still = city;
  std::erase_if(still.objects, [](const scene::Object& object) { return object.is_dynamic; });
  return still;
}

/// A renderer with the light and the drawables that ship.
Result<std::unique_ptr<render::Renderer>> renderer_of(const House& house, const scene::Scene& scene) {
  return render::Renderer::create(scene, house.get<render::Drawables>(), house.get<render::Lights>().make);
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

/// The scene's own first views, then others above its streets.
Result<std::vector<scene::NamedCamera>> views_of(const scene::Scene& city, std::size_t count) {
  const std::size_t own = std::min({own_views, count, city.cameras.size()});
  std::vector<scene::NamedCamera> views(city.cameras.begin(), city.cameras.begin() + std::ptrdiff_t(own));
  if (views.size() == count) return views;
  const auto others =
      city_views(city, DoubleTracer(opaque_twin(city)), count - own, photograph_size.x, photograph_size.y);
  if (!others) return others.errors();
  for (const Camera& camera : *others)
    views.push_back({.name = fmt::format("view {}", views.size() + 1), .camera = camera, .follows = {}});
  return views;
}

/// A renderer of the scene at its hour, with the bounced light of another.
struct Exchanged {
  std::unique_ptr<render::Renderer> renderer;
  ExchangedBounces* light;  ///< the renderer's own
};
Result<Exchanged> exchanged_renderer_of(const House& house, const scene::Scene& scene) {
  ExchangedBounces* light = nullptr;
  const render::MakeLight make = [&](const scene::Scene& lit,
                                     const Bounds& fixed) -> Result<std::unique_ptr<render::LightSource>> {
    auto below = lamps::with_lamps(shadows::ChosenLight::create)(lit, fixed);
    if (!below) return below.errors();
    auto other = bounced_light::with_bounced_light(shadows::ChosenLight::create)(lit, fixed);
    if (!other) return other.errors();
    auto made = std::make_unique<ExchangedBounces>(*std::move(below), *std::move(other));
    light = made.get();
    return std::unique_ptr<render::LightSource>(std::move(made));
  };
  auto renderer = render::Renderer::create(scene, house.get<render::Drawables>(), make);
  if (!renderer) return renderer.errors();
  return Exchanged{*std::move(renderer), light};
}

/// FLIP against photographs, of one picture or the sum of many.
struct Flips {
  double with = 0.0, without = 0.0;
  double brightened = 0.0;  ///< without, as bright in the mean as the photograph
  double exchanged = 0.0;   ///< with the bounced light of another hour

  Flips& operator+=(const Flips& other) {
    with += other.with, without += other.without;
    brightened += other.brightened, exchanged += other.exchanged;
    return *this;
  }
};

/// Photographs of a city at an hour, and pictures of the same by the renderer.
class HourOfCity {
 public:
  static Result<std::unique_ptr<HourOfCity>> create(const BenchSetup& setup, const scene::Scene& city) {
    auto made = std::make_unique<HourOfCity>();
    made->with_ = made->without_ = city;
    made->without_.data<scene::BouncedSettings>().is_on = false;
    made->samples_per_pixel_ = setup.is_quick ? 96 : 256;
    auto bounced = renderer_of(setup.house, made->with_), plain = renderer_of(setup.house, made->without_);
    if (!bounced) return bounced.errors();
    if (!plain) return plain.errors();
    made->bounced_ = *std::move(bounced), made->plain_ = *std::move(plain);
    auto exchanged = exchanged_renderer_of(setup.house, made->with_);
    if (!exchanged) return exchanged.errors();
    made->exchanged_ = *std::move(exchanged);
    return made;
  }

  Status show(double hour, double exchanged_hour) {
    scene::Scene of_other_hour = with_;
    if (Status status = set_hour(of_other_hour, exchanged_hour); !status) return status;
    exchanged_.light->show_bounces_of(of_other_hour);
    for (scene::Scene* scene : {&with_, &without_})
      if (Status status = set_hour(*scene, hour); !status) return status;
    return Done{};
  }

  Result<Flips> flips(const Camera& camera) {
    const Result<ImageF> with = drawn_as_photographed(*bounced_, with_, camera),
                         without = drawn_as_photographed(*plain_, without_, camera),
                         exchanged = drawn_as_photographed(*exchanged_.renderer, with_, camera),
                         photograph = photograph_by(1, camera);
    for (const auto* each : {&with, &without, &exchanged, &photograph})
      if (!*each) return each->errors();
    const Image8 truth = shading::tone_mapped_picture(*photograph, with_.exposure);
    const float lacking = float(mean_luminance(*photograph) / mean_luminance(*without));
    Flips flips;
    for (const auto& [radiance, exposure, flip] : {std::tuple{&*with, with_.exposure, &flips.with},
                                                   {&*without, with_.exposure, &flips.without},
                                                   {&*without, lacking * with_.exposure, &flips.brightened},
                                                   {&*exchanged, with_.exposure, &flips.exchanged}}) {
      const Result<double> difference = flip_to(truth, *radiance, exposure);
      if (!difference) return difference.errors();
      *flip = *difference;
    }
    return flips;
  }

  /// Between two photographs by other seeds: noise that no picture can match.
  Result<double> flip_of_noise(const Camera& camera) {
    const Result<ImageF> one = photograph_by(1, camera), other = photograph_by(2, camera);
    if (!one) return one.errors();
    if (!other) return other.errors();
    return flip_to(shading::tone_mapped_picture(*other, with_.exposure), *one, with_.exposure);
  }

 private:
  Result<ImageF> photograph_by(std::uint64_t seed, const Camera& camera) const {
    return photograph_of(with_, *bounced_, camera, samples_per_pixel_, seed);
  }

  scene::Scene with_, without_;
  std::unique_ptr<render::Renderer> bounced_, plain_;
  Exchanged exchanged_{};
  int samples_per_pixel_ = 0;
};

}  // namespace

Status measure_bounced_light(const BenchSetup& setup, const scene::Scene& city, Report& report) {
  scene::Scene still = still_city(city);
  if (still.objects.empty() || still.cameras.empty())
    return error("the scene has nothing static or no cameras to photograph");
  if (!still.data<scene::BouncedSettings>().is_on)
    return error("the scene's script has no bouncedLight: nothing that ships would be measured");
  if (Status status = measure_bounced_update(still, report); !status) return status;
  auto made = HourOfCity::create(setup, still);
  if (!made) return made.errors();
  HourOfCity& hour_of_city = **made;

  const std::vector<double> hours =
      setup.is_quick ? std::vector{9.0, 13.6} : std::vector{6.4, 9.0, 13.6, 19.8};
  const Result<std::vector<scene::NamedCamera>> views = views_of(still, setup.is_quick ? 2 : 20);
  if (!views) return views.errors();
  Flips all;
  Result<double> flip_of_noise = error("no view was photographed");
  for (std::size_t h = 0; h < hours.size(); ++h) {
    const double other_hour = hours[(h + 1) % hours.size()];
    if (Status status = hour_of_city.show(hours[h], other_hour); !status) return status;
    for (const scene::NamedCamera& view : *views) {
      const Result<Flips> flips = hour_of_city.flips(view.camera);
      if (!flips) return flips.errors();
      all += *flips;
      if (!flip_of_noise) flip_of_noise = hour_of_city.flip_of_noise(view.camera);
      report.note(
          fmt::format("{} at {} h: FLIP {:.3f} with, {:.3f} without bounced light, {:.3f} with that of {} h",
                      view.name, hours[h], flips->with, flips->without, flips->exchanged, other_hour));
    }
  }
  if (!flip_of_noise) return flip_of_noise.errors();
  report.add("flip_to_photograph_over_without_bounces", all.with / all.without, up_to(0.6));
  report.add_control("flip_to_photograph_over_without_bounces_brightened_control",
                     all.brightened / all.without, up_to(0.6));
  report.add_control("flip_to_photograph_over_without_bounces_exchanged_hours", all.exchanged / all.without,
                     up_to(0.6));
  // Reported alone: pictures without any bounced light are nearer than those of exchanged hours, too.
  report.add("flip_to_photograph_over_exchanged_hours", all.with / all.exchanged);
  report.add("flip_without_bounces_over_exchanged_hours", all.without / all.exchanged);
  report.add("flip_between_two_photographs", *flip_of_noise);
  report.note(
      "flip_between_two_photographs: of the first view, by another seed: noise that no picture can match");
  report.note(
      "controls: pictures without bounced light, as bright in the mean as the photograph; pictures with the "
      "bounced light of another of the hours under the sun and sky of their own");
  return Done{};
}

}  // namespace parvis::bench
