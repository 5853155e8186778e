#include "bench/light/night_bench.h"

#include <algorithm>
#include <span>
#include <vector>

#include "bench/light/photographed_city.h"
#include "bench/light/set_hour.h"
#include "graphics/reference/scene_lamps.h"
#include "graphics/shading/tone_curve.h"
#include "house/stage/stage.h"
#include "scene/data/lamp.h"

namespace parvis::bench {
namespace {

/// That of the scenario night of the paper's city.
constexpr double nightfall_h = 21.9;
/// The project's own. By day the renderer's pictures are off by 0.10 to 0.12.
constexpr Target of_night = {0.15, false};

/// The same night with all lamps switched off, and with them all that is seen only while they burn.
scene::Scene without_lamps(scene::Scene scene) {
  for (scene::Lamp& lamp : scene.data<scene::ItemsOf<scene::Lamp>>().items)
    lamp.burns = scene::LampSwitch::never;
  scene::show_what_lamps_show(scene);
  return scene;
}

/// The mean FLIP of the renderer's pictures of a scene to photographs of the same views.
Result<double> mean_flip(render::Renderer& renderer, const scene::Scene& scene,
                         std::span<const scene::NamedCamera> views, const std::vector<Image8>& photographs) {
  double sum = 0.0;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const Result<ImageF> picture = drawn_as_photographed(renderer, scene, views[v].camera);
    if (!picture) return picture.errors();
    const Result<double> flip = flip_to(photographs[v], *picture, scene.exposure);
    if (!flip) return flip.errors();
    sum += *flip;
  }
  return sum / double(views.size());
}

}  // namespace

Status measure_night(const BenchSetup& setup, const scene::Scene& city, Report& report) {
  if (city.cameras.empty()) return error("the scene has no cameras to photograph by night");
  scene::Scene night = city;
  if (Status status = set_hour(night, nightfall_h); !status) return status;
  const house::Play play = house::make_play(setup.house, std::move(night));  // with traffic
  const scene::Scene& lit = play.scene;
  const std::size_t still = reference::lit_lamps(lit, reference::LampKind::still).size(),
                    moving = reference::lit_lamps(lit, reference::LampKind::moving).size();
  if (still == 0 || moving == 0)
    return error("at {} h {} lamps of the place burn and {} of vehicles: there must be both", nightfall_h,
                 still, moving);
  auto made = render::Renderer::create(lit, setup.house.get<render::Drawables>(),
                                       setup.house.get<render::Lights>().make);
  if (!made) return made.errors();
  render::Renderer& renderer = **made;

  const std::span views(lit.cameras.data(),
                        std::min<std::size_t>(setup.is_quick ? 1 : 2, lit.cameras.size()));
  std::vector<Image8> photographs;
  photographs.reserve(views.size());
  for (const scene::NamedCamera& view : views) {
    const Result<ImageF> radiance = photograph_of(lit, renderer, view.camera, setup.is_quick ? 64 : 256);
    if (!radiance) return radiance.errors();
    photographs.push_back(shading::tone_mapped_picture(*radiance, lit.exposure));
  }
  const Result<double> with = mean_flip(renderer, lit, views, photographs),
                       without = mean_flip(renderer, without_lamps(lit), views, photographs);
  if (!with) return with.errors();
  if (!without) return without.errors();
  report.add("flip_to_photograph_at_night", *with, of_night);
  report.add_control("flip_to_photograph_at_night_lamps_off", *without, of_night);
  report.add("flip_to_photograph_at_night_over_lamps_off", *with / *without);
  report.note(fmt::format(
      "{} of the city's views at {} h, {} lamps of the place and {} of vehicles burn; the target is the "
      "project's own; control: the same pictures with all lamps, windows and shop fronts dark",
      views.size(), nightfall_h, still, moving));
  return Done{};
}

}  // namespace parvis::bench
