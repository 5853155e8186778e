#include "bench/light/bounced_update_bench.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "bench/light/set_hour.h"
#include "graphics/bounced_light/bounced_over.h"
#include "graphics/render/fixed_parts.h"
#include "graphics/render/light_over.h"
#include "graphics/shadows/chosen_light.h"

namespace parvis::bench {
namespace {

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
Result<shading::BouncedLight> fresh_light(const scene::Scene& scene) {
  auto made = bounced_light::with_bounced_light(shadows::ChosenLight::create)(
      scene, render::bounds_of_fixed_parts(scene, false));
  if (!made) return made.errors();
  (*made)->update(scene);
  if (!(*made)->bounced()) return error("the scene has no bounced light");
  return *(*made)->bounced();
}

}  // namespace

/// What a frame waits for when the hour, and with it sun and sky, has changed: the light of all places and
/// its way to the GPU. Sun and sky by themselves take their time without bounced light, too.
Status measure_bounced_update(const scene::Scene& city, Report& report) {
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
  shading::BouncedLight before;
  std::vector<double> samples;
  for (int i = 1; i <= 11; ++i) {
    if (Status status = set_hour(later, 8.0 + 0.5 * double(i)); !status) return status;
    before = *light.bounced();
    ahead->follow(later);
    glFinish();
    samples.push_back(milliseconds([&] { light.update(later), glFinish(); }));
    if (change(before, *light.bounced()) < 1e-3)
      return error("the bounced light has not changed with the hour");
  }
  const Result<shading::BouncedLight> fresh = fresh_light(later);
  if (!fresh) return fresh.errors();
  const Median update = median(samples);
  report.add("bounced_light_update_ms", update.value, up_to(50.0));
  report.add_control("bounced_light_update_ms_with_its_rays", traced_ms, up_to(50.0));
  report.note(
      fmt::format("95 % interval {:.1f} to {:.1f} ms, from half an hour to the next; control: the "
                  "first light, with its rays",
                  update.low, update.high));
  report.add("bounced_light_updated_off_fresh", change(*fresh, *light.bounced()), up_to(1e-3));
  report.add_control("bounced_light_updated_off_fresh_half_an_hour_ago", change(*fresh, before), up_to(1e-3));
  report.note(
      "bounced_light_updated_off_fresh: light of the places as it was updated eleven times, against light "
      "that starts over at the last hour, as a share of all of it; control: the light before the last "
      "update");
  return Done{};
}

}  // namespace parvis::bench
