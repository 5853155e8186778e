// Bounced light and lamps: pictures against path-traced photographs, and what a new hour costs.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "base/camera.h"
#include "base/colour.h"
#include "base/image.h"
#include "base/reduction.h"
#include "bench/light/exact_sun.h"
#include "bench/parts.h"
#include "graphics/bounced_light/bounced_over.h"
#include "graphics/lamps/lamp_light.h"
#include "graphics/light/day_light.h"
#include "graphics/reference/metrics.h"
#include "graphics/reference/photograph.h"
#include "graphics/reference/scene_lamps.h"
#include "graphics/render/drawables.h"
#include "graphics/render/fixed_parts.h"
#include "graphics/render/frame_views.h"
#include "graphics/render/light_over.h"
#include "graphics/render/renderer.h"
#include "graphics/shading/tone_curve.h"
#include "graphics/shadows/chosen_light.h"
#include "scene/data/lamp.h"
#include "stage/stage.h"

namespace parvis::bench {
namespace {

/// Gives a scene with dayLight the sun and sky of another hour of its day. Fails as light::light_scene.
inline void set_hour(scene::Scene& scene, double hour) {
  scene.data<light::DayLight>().when.time_of_day_h = hour;
  must(light::light_scene(scene));
}

/// Pixels of all of these pictures, across and down.
inline constexpr glm::ivec2 photograph_size{192, 108};

constexpr int supersample = 4;  // of the renderer's pictures, across and down

/// Radiance by the renderer whose pixels are the mean of many samples, as those of a photograph are: what is
/// compared is light, not edges. Fails as render::draw_frame.
ImageF drawn_as_photographed(render::Renderer& renderer, const scene::Scene& scene, const Camera& camera) {
  must(render::draw_frame(renderer, scene,
                          {camera, supersample * photograph_size.x, supersample * photograph_size.y}));
  return reduced(renderer.read_radiance(), supersample);
}

/// Radiance of the same view by the path tracer, under the renderer's present sky. Another seed gives other
/// noise.
ImageF photograph_of(const scene::Scene& scene, const render::Renderer& renderer, const Camera& camera,
                     int samples_per_pixel, std::uint64_t seed = 1) {
  const reference::RayScene rays(scene);
  reference::PhotographOptions options;
  options.samples_per_pixel = samples_per_pixel, options.seed = seed;
  auto photograph = must(reference::take_photograph(rays, scene, renderer.sky(), camera, photograph_size.x,
                                                    photograph_size.y, options));
  return std::move(photograph.radiance);
}

/// FLIP between a picture at an exposure and a tone-mapped photograph.
double flip_to(const Image8& photograph, const ImageF& radiance, float exposure) {
  return flip_between(shading::tone_mapped_picture(radiance, exposure), photograph);
}

/// The light below, over which lies the bounced light of a second source that follows a scene of its own.
class ExchangedBounces final : public render::LightOver {
 public:
  ExchangedBounces(std::unique_ptr<render::LightSource> below, std::unique_ptr<render::LightSource> other)
      : LightOver(std::move(below)), other_(std::move(other)) {}

  /// The hour whose bounced light is shown from now on.
  void show_bounces_of(const scene::Scene& other_hour) { other_->update(other_hour); }

  /// The other source binds all of its light first, and this one all but the bounced light over it.
  void bind() const override {
    other_->bind();
    LightOver::bind();
  }
  void fill(render::Frame& frame) const override {
    LightOver::fill(frame);
    render::Frame of_other{};
    other_->fill(of_other);
    frame.frame_bounced_origin = of_other.frame_bounced_origin;
    frame.frame_bounced_size = of_other.frame_bounced_size;
  }
  const shading::BouncedLight* bounced() const override { return other_->bounced(); }

 private:
  std::unique_ptr<render::LightSource> other_;
};

/// Sun and sky that are brought up to date ahead of what is laid over them, so that this can be timed alone.
class SunAhead final : public render::LightOver {
 public:
  using LightOver::LightOver;
  void follow(const scene::Scene& scene) { has_news_ |= LightOver::update(scene); }
  bool update(const scene::Scene& /*scene*/) override { return std::exchange(has_news_, false); }

 private:
  bool has_news_ = false;
};

/// How much one differs from the other, relative to all of the first.
template <class Vector>
double difference(const std::vector<Vector>& from, const std::vector<Vector>& to) {
  double difference = 0.0, all = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    difference += double(glm::distance(from[i], to[i]));
    all += double(glm::length(from[i]));
  }
  return difference / std::max(all, 1e-12);
}

/// How much the light of all places has changed, its lobes or its colours; all of it where the places are
/// others.
double change(const shading::BouncedLight& before, const shading::BouncedLight& after) {
  if (before.cells != after.cells) return 1.0;
  return std::max(difference(before.lobes, after.lobes), difference(before.colours, after.colours));
}

/// Bounced light that is made for a scene as it is, with rays of its own.
shading::BouncedLight fresh_light(const scene::Scene& scene) {
  auto made = must(bounced_light::with_bounced_light(shadows::ChosenLight::create)(
      scene, render::bounds_of_fixed_parts(scene, false)));
  made->update(scene);
  if (!made->bounced()) fail("the scene has no bounced light");
  return *made->bounced();
}

/// Measures the time that a frame waits for when the hour, and with it sun and sky, has changed: the light of
/// all places and its way to the GPU. Sun and sky by themselves take their time without bounced light, too.
void measure_bounced_update(const scene::Scene& city, Report& report) {
  SunAhead* ahead = nullptr;
  const render::MakeLight below = [&](const scene::Scene& scene,
                                      const Bounds& fixed) -> Result<std::unique_ptr<render::LightSource>> {
    auto made = std::make_unique<SunAhead>(must(shadows::ChosenLight::create(scene, fixed)));
    ahead = made.get();
    return std::unique_ptr<render::LightSource>(std::move(made));
  };
  std::unique_ptr<render::LightSource> made =
      must(bounced_light::with_bounced_light(below)(city, render::bounds_of_fixed_parts(city, false)));
  render::LightSource& light = *made;
  const double traced_ms = milliseconds([&] { light.update(city); });
  if (!light.bounced()) fail("the scene has no bounced light");
  scene::Scene later = city;
  shading::BouncedLight before;
  std::vector<double> samples;
  for (int i = 1; i <= 11; ++i) {
    set_hour(later, 8.0 + 0.5 * double(i));
    before = *light.bounced();
    ahead->follow(later);
    glFinish();
    samples.push_back(milliseconds([&] { light.update(later), glFinish(); }));
    if (change(before, *light.bounced()) < 1e-3) fail("the bounced light has not changed with the hour");
  }
  const shading::BouncedLight fresh = fresh_light(later);
  report.add("bounced_light_update_ms", median(samples));
  report.add("bounced_light_update_ms_with_its_rays", traced_ms);
  report.add("bounced_light_updated_off_fresh", change(fresh, *light.bounced()));
  report.add("bounced_light_updated_off_fresh_half_an_hour_ago", change(fresh, before));
}

constexpr std::size_t own_views = 5;  // of the scene, before others

/// The city without dynamic objects: neither traffic nor parked cars.
scene::Scene still_city(const scene::Scene& city) {
  scene::Scene still = city;
  std::erase_if(still.objects, [](const scene::Object& object) { return object.is_dynamic; });
  return still;
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
std::vector<scene::NamedCamera> views_of(const scene::Scene& city, std::size_t count) {
  const std::size_t own = std::min({own_views, count, city.cameras.size()});
  std::vector<scene::NamedCamera> views(city.cameras.begin(), city.cameras.begin() + std::ptrdiff_t(own));
  if (views.size() == count) return views;
  const auto others =
      city_views(city, DoubleTracer(opaque_twin(city)), count - own, photograph_size.x, photograph_size.y);
  for (const Camera& camera : others)
    views.push_back({.name = fmt::format("view {}", views.size() + 1), .camera = camera, .follows = {}});
  return views;
}

/// A renderer of the scene at its hour, with the bounced light of another.
struct Exchanged {
  std::unique_ptr<render::Renderer> renderer;
  ExchangedBounces* light;  ///< the renderer's own
};
Exchanged exchanged_renderer_of(const scene::Scene& scene) {
  ExchangedBounces* light = nullptr;
  const render::MakeLight make = [&](const scene::Scene& lit,
                                     const Bounds& fixed) -> Result<std::unique_ptr<render::LightSource>> {
    auto below = must(lamps::with_lamps(shadows::ChosenLight::create)(lit, fixed));
    auto other = must(bounced_light::with_bounced_light(shadows::ChosenLight::create)(lit, fixed));
    auto made = std::make_unique<ExchangedBounces>(std::move(below), std::move(other));
    light = made.get();
    return std::unique_ptr<render::LightSource>(std::move(made));
  };
  auto renderer = must(render::Renderer::create(scene, rooms::drawables(), make));
  return {std::move(renderer), light};
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
  static std::unique_ptr<HourOfCity> create(const BenchSetup& setup, const scene::Scene& city) {
    auto made = std::make_unique<HourOfCity>();
    made->with_ = made->without_ = city;
    made->without_.data<scene::BouncedSettings>().is_on = false;
    made->samples_per_pixel_ = setup.is_quick ? 96 : 256;
    made->bounced_ = renderer_of(made->with_), made->plain_ = renderer_of(made->without_);
    made->exchanged_ = exchanged_renderer_of(made->with_);
    return made;
  }

  void show(double hour, double exchanged_hour) {
    scene::Scene of_other_hour = with_;
    set_hour(of_other_hour, exchanged_hour);
    exchanged_.light->show_bounces_of(of_other_hour);
    for (scene::Scene* scene : {&with_, &without_}) set_hour(*scene, hour);
  }

  Flips flips(const Camera& camera) {
    const ImageF with = drawn_as_photographed(*bounced_, with_, camera),
                 without = drawn_as_photographed(*plain_, without_, camera),
                 exchanged = drawn_as_photographed(*exchanged_.renderer, with_, camera),
                 photograph = photograph_by(1, camera);
    const Image8 truth = shading::tone_mapped_picture(photograph, with_.exposure);
    const float lacking = float(mean_luminance(photograph) / mean_luminance(without));
    Flips flips;
    for (const auto& [radiance, exposure, flip] : {std::tuple{&with, with_.exposure, &flips.with},
                                                   {&without, with_.exposure, &flips.without},
                                                   {&without, lacking * with_.exposure, &flips.brightened},
                                                   {&exchanged, with_.exposure, &flips.exchanged}}) {
      *flip = flip_to(truth, *radiance, exposure);
    }
    return flips;
  }

  /// FLIP between two photographs by other seeds: noise that no picture can match.
  double flip_of_noise(const Camera& camera) {
    const ImageF one = photograph_by(1, camera), other = photograph_by(2, camera);
    return flip_to(shading::tone_mapped_picture(other, with_.exposure), one, with_.exposure);
  }

 private:
  ImageF photograph_by(std::uint64_t seed, const Camera& camera) const {
    return photograph_of(with_, *bounced_, camera, samples_per_pixel_, seed);
  }

  scene::Scene with_, without_;
  std::unique_ptr<render::Renderer> bounced_, plain_;
  Exchanged exchanged_{};
  int samples_per_pixel_ = 0;
};

/// That of the scenario night of the paper's city.
constexpr double nightfall_h = 21.9;

/// The same night with all lamps switched off, and with them all that is seen only while they burn.
scene::Scene without_lamps(scene::Scene scene) {
  for (scene::Lamp& lamp : scene.data<scene::ItemsOf<scene::Lamp>>().items)
    lamp.burns = scene::LampSwitch::never;
  scene::show_what_lamps_show(scene);
  return scene;
}

/// The mean FLIP of the renderer's pictures of a scene to photographs of the same views.
double mean_flip(render::Renderer& renderer, const scene::Scene& scene,
                 std::span<const scene::NamedCamera> views, const std::vector<Image8>& photographs) {
  double sum = 0.0;
  for (std::size_t v = 0; v < views.size(); ++v) {
    sum += flip_to(photographs[v], drawn_as_photographed(renderer, scene, views[v].camera), scene.exposure);
  }
  return sum / double(views.size());
}

}  // namespace

void measure_bounced_light(const BenchSetup& setup, Report& report) {
  const scene::Scene city = setup.scene(setup.city() / "paper_day.xp");
  scene::Scene still = still_city(city);
  if (still.objects.empty() || still.cameras.empty())
    fail("the scene has nothing static or no cameras to photograph");
  if (!still.data<scene::BouncedSettings>().is_on)
    fail("the scene's script has no bouncedLight: nothing that ships would be measured");
  measure_bounced_update(still, report);
  auto made = HourOfCity::create(setup, still);
  HourOfCity& hour_of_city = *made;

  const std::vector<double> hours =
      setup.is_quick ? std::vector{9.0, 13.6} : std::vector{6.4, 9.0, 13.6, 19.8};
  const std::vector<scene::NamedCamera> views = views_of(still, setup.is_quick ? 2 : 20);
  Flips all;
  std::optional<double> flip_of_noise;
  for (std::size_t h = 0; h < hours.size(); ++h) {
    const double other_hour = hours[(h + 1) % hours.size()];
    hour_of_city.show(hours[h], other_hour);
    for (const scene::NamedCamera& view : views) {
      const Flips flips = hour_of_city.flips(view.camera);
      all += flips;
      if (!flip_of_noise) flip_of_noise = hour_of_city.flip_of_noise(view.camera);
      report.note(
          fmt::format("{} at {} h: FLIP {:.3f} with, {:.3f} without bounced light, {:.3f} with that of {} h",
                      view.name, hours[h], flips.with, flips.without, flips.exchanged, other_hour));
    }
  }
  report.add("flip_to_photograph_over_without_bounces", all.with / all.without);
  report.add("flip_to_photograph_over_without_bounces_brightened_control", all.brightened / all.without);
  report.add("flip_to_photograph_over_without_bounces_exchanged_hours", all.exchanged / all.without);
  report.add("flip_between_two_photographs", flip_of_noise.value());
}

void measure_night(const BenchSetup& setup, Report& report) {
  const scene::Scene city = setup.scene(setup.city() / "paper_day.xp");
  if (city.cameras.empty()) fail("the scene has no cameras to photograph by night");
  scene::Scene night = city;
  set_hour(night, nightfall_h);
  const stage::Simulation simulation =
      stage::make_simulation(rooms::all_registries(), std::move(night));  // with traffic
  const scene::Scene& lit = simulation.scene;
  const std::size_t still = reference::lit_lamps(lit, reference::LampKind::still).size(),
                    moving = reference::lit_lamps(lit, reference::LampKind::moving).size();
  if (still == 0 || moving == 0)
    fail("at {} h {} lamps of the place burn and {} of vehicles: there must be both", nightfall_h, still,
         moving);
  const auto made = renderer_of(lit);
  render::Renderer& renderer = *made;
  const std::span views(lit.cameras.data(),
                        std::min<std::size_t>(setup.is_quick ? 1 : 2, lit.cameras.size()));
  std::vector<Image8> photographs;
  photographs.reserve(views.size());
  for (const scene::NamedCamera& view : views)
    photographs.push_back(shading::tone_mapped_picture(
        photograph_of(lit, renderer, view.camera, setup.is_quick ? 64 : 256), lit.exposure));
  const double with = mean_flip(renderer, lit, views, photographs),
               without = mean_flip(renderer, without_lamps(lit), views, photographs);
  report.add("flip_to_photograph_at_night", with);
  report.add("flip_to_photograph_at_night_lamps_off", without);
}

}  // namespace parvis::bench
