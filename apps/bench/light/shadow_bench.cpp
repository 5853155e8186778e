#include "bench/light/shadow_bench.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.h"
#include "bench/light/city_views.h"
#include "bench/light/shadow_time_bench.h"
#include "bench/light/sunlit_city.h"
#include "graphics/shadows/traced_sun.h"
#include "scene/data/sun_shadows.h"

namespace parvis::bench {
namespace {

using light::ShadowTechnique;

constexpr std::size_t technique_count = light::shadow_technique_names.size();
/// Of the suns of controls: under the one no ray may be taken for another's, under the other no picture.
constexpr float slightly_off_deg = 0.006f, off_deg = 2.0f;
/// What the issue allows rays, and the pictures of maps.
constexpr Target exact = {0.0, false}, of_pictures = {0.5, false};

/// From two to 69 degrees high: mornings and evenings have the longest shadows.
glm::vec3 any_sun(Random& random) {
  const float e = random.uniform(0.03f, 1.2f), a = random.uniform(0.0f, 6.2831853f);
  return glm::normalize(glm::vec3(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)));
}

/// The renderer's own pixels of method rays, before the picture.
SunShares traced_shares(const reference::RayScene& rays, const scene::SunLight& sun, const Camera& camera) {
  shadows::TracedSun traced;
  traced.trace(rays, 1, {}, sun, camera, sunlit_pixels.width, sunlit_pixels.height, 1);
  const auto across = std::size_t(sunlit_pixels.width), last = std::size_t(sunlit_pixels.height - 1);
  return judged_shares(sunlit_pixels, [&](std::size_t x, std::size_t y) {
    return traced.pixels()[(last - y) * across + x].x;
  });
}

/// Pixels that change between right and wrong from one step of a walk to the next, while the truth stays.
class Flicker {
 public:
  /// What is added next is the first step of another walk.
  void begin() { truth_before_.clear(); }
  void add(const SunPicture& truth, const SunShares& shares) {
    for (std::size_t k = 0; !truth_before_.empty() && k < truth.size(); ++k) {
      if (truth[k] < 0 || truth[k] != truth_before_[k]) continue;
      ++pixels_;
      changes_ += (shares[k] > half_lit) != (shares_before_[k] > half_lit);
    }
    truth_before_ = truth, shares_before_ = shares;
  }
  double percent() const { return pixels_ > 0 ? 100.0 * double(changes_) / double(pixels_) : std::nan(""); }

 private:
  long changes_ = 0, pixels_ = 0;
  SunPicture truth_before_;
  SunShares shares_before_;
};

constexpr float step_m = 0.02f;

Camera ahead(Camera camera, int steps) {
  camera.world_from_camera[3] -= step_m * float(steps) * camera.world_from_camera[2];
  return camera;
}

/// Steps of a walk, and what each pixel's middle truly sees in them.
struct Walk {
  std::vector<Camera> cameras;
  std::vector<SunPicture> truths;
  glm::vec3 to_sun;

  Walk(const DoubleTracer& tracer, const Camera& first, glm::vec3 sun, int steps) : to_sun(sun) {
    for (int i = 0; i < steps; ++i) {
      cameras.push_back(ahead(first, i));
      truths.push_back(exact_sun(tracer, cameras.back(), sunlit_pixels, glm::dvec3(sun)));
    }
  }
};

/// Ahead of a view or behind it, where so many steps cross the place at which the default draws its near map
/// about another middle.
Result<Camera> first_of_walk(SunlitCity& drawn, const Camera& camera, int steps) {
  constexpr int max_steps = int(25.0f / step_m);  // such places are no farther apart
  constexpr ShadowTechnique technique = ShadowTechnique::cached_cascades;
  drawn.draws_maps(camera, technique);
  for (int far = steps - 1; far <= max_steps; far += steps - 1)
    for (const bool is_behind : {false, true})
      if (drawn.draws_maps(ahead(camera, is_behind ? -far : far), technique))
        return ahead(camera, is_behind ? -far : far - (steps - 1));
  return error("the default draws its maps again nowhere within 25 m of a view");
}

struct WalkFlicker {
  Flicker resolved, middle;
};

/// Adds a walk. Every other step is lit by a sun that is off by `tremble_deg`. Returns how many views of
/// shadow maps were drawn after the first step.
Result<int> add_walk(SunlitCity& drawn, const Walk& walk, ShadowTechnique technique, WalkFlicker& flicker,
                     float tremble_deg = 0.0f) {
  flicker.resolved.begin(), flicker.middle.begin();
  int first_views = 0;
  for (std::size_t i = 0; i < walk.cameras.size(); ++i) {
    drawn.set_sun(i % 2 == 1 && tremble_deg > 0.0f ? turned_sun(walk.to_sun, tremble_deg) : walk.to_sun);
    if (Status status = drawn.look(walk.cameras[i]); !status) return status.errors();
    const Result<DrawnSun> sun = drawn.sun(technique);
    if (!sun) return sun.errors();
    flicker.resolved.add(walk.truths[i], sun->resolved);
    flicker.middle.add(walk.truths[i], sun->middle);
    if (i == 0) first_views = drawn.map_views();
  }
  return drawn.map_views() - first_views;
}

/// Walks from the first views, each under a sun of its own.
Status measure_flicker(const BenchSetup& setup, const scene::Scene& city, const DoubleTracer& tracer,
                       SunlitCity& drawn, Random& random, Report& report) {
  const int steps = setup.is_quick ? 12 : 100;
  const std::size_t walks = std::min(std::size_t(setup.is_quick ? 2 : 4), city.cameras.size());
  constexpr float tremble_deg = 0.2f;
  WalkFlicker shipped, fitted, trembling;
  for (std::size_t w = 0; w < walks; ++w) {
    const glm::vec3 to_sun = any_sun(random);
    drawn.set_sun(to_sun);
    const Result<Camera> first = first_of_walk(drawn, city.cameras[w].camera, steps);
    if (!first) return first.errors();
    const Walk walk(tracer, *first, to_sun, steps);
    const auto redrawn = add_walk(drawn, walk, ShadowTechnique::cached_cascades, shipped),
               fits = add_walk(drawn, walk, ShadowTechnique::cascades, fitted),
               trembles = add_walk(drawn, walk, ShadowTechnique::cached_cascades, trembling, tremble_deg);
    for (const auto* each : {&redrawn, &fits, &trembles})
      if (!*each) return each->errors();
    if (*redrawn == 0) return error("walk {}: the default has not drawn its near map again", w);
  }
  report.add("shadow_flicker_percent", shipped.resolved.percent(), up_to(0.1));
  report.add("shadow_flicker_percent_in_the_middle_of_pixels", shipped.middle.percent());
  report.add("shadow_flicker_percent_of_cascades", fitted.resolved.percent());
  report.add_control("shadow_flicker_percent_of_a_trembling_sun", trembling.resolved.percent(), up_to(0.1));
  report.note(fmt::format(
      "{} walks of {} steps of 2 cm, in each of which the default draws its near map again about another "
      "middle; control: maps of a sun that trembles by {} degrees",
      walks, steps, tremble_deg));
  return Done{};
}

/// The pictures of one technique, and the same against the truth of a sun that is off.
struct WrongPictures {
  WrongSun resolved, middle, resolved_of_other_sun, middle_of_other_sun;
};

/// Wrong pixels of all views.
struct WrongShadows {
  WrongSun of_rays, of_rays_with_sun_off;
  std::array<WrongPictures, technique_count> pictures;

  const WrongPictures& of(ShadowTechnique technique) const { return pictures[std::size_t(technique)]; }
};

/// One view under one sun.
Status add_view(const DoubleTracer& tracer, const reference::RayScene& rays, const scene::Scene& twin,
                const Camera& camera, glm::vec3 to_sun, SunlitCity& drawn, WrongShadows& wrong) {
  const SunPicture truth = exact_sun(tracer, camera, sunlit_pixels, glm::dvec3(to_sun));
  scene::SunLight sun = scene::sun_light(twin);
  sun.direction_to_sun = to_sun;
  wrong.of_rays.add(truth, traced_shares(rays, sun, camera));
  sun.direction_to_sun = turned_sun(to_sun, slightly_off_deg);
  wrong.of_rays_with_sun_off.add(truth, traced_shares(rays, sun, camera));
  drawn.set_sun(to_sun);
  if (Status status = drawn.look(camera); !status) return status;
  const SunPicture truth_of_other_sun =
      exact_sun(tracer, camera, sunlit_pixels, glm::dvec3(turned_sun(to_sun, off_deg)));
  for (std::size_t t = 0; t < technique_count; ++t) {
    const Result<DrawnSun> shares = drawn.sun(ShadowTechnique(t));
    if (!shares) return shares.errors();
    WrongPictures& pictures = wrong.pictures[t];
    pictures.resolved.add(truth, shares->resolved), pictures.middle.add(truth, shares->middle);
    pictures.resolved_of_other_sun.add(truth_of_other_sun, shares->resolved);
    pictures.middle_of_other_sun.add(truth_of_other_sun, shares->middle);
  }
  return Done{};
}

void report_wrong(const WrongShadows& wrong, Report& report) {
  constexpr double none = std::numeric_limits<double>::infinity();
  double best = none, best_resolved = none, best_with_sun_off = none, best_mean_off = none;
  for (std::size_t t = 0; t < technique_count; ++t) {
    const WrongPictures& pictures = wrong.pictures[t];
    report.note(fmt::format("{}: {:.3f} % of {} pixels wrong in their middle, {:.3f} % as resolved",
                            light::shadow_technique_names[t], pictures.middle.percent(),
                            pictures.middle.pixels, pictures.resolved.percent()));
    if (ShadowTechnique(t) == ShadowTechnique::rays) continue;
    best = std::min(best, pictures.middle.percent());
    best_resolved = std::min(best_resolved, pictures.resolved.percent());
    best_mean_off = std::min(best_mean_off, pictures.resolved.mean_off_percent());
    best_with_sun_off = std::min(best_with_sun_off, pictures.resolved_of_other_sun.percent());
  }
  report.add("shadow_wrong_px_percent_rays", wrong.of_rays.percent(), exact);
  report.add_control("shadow_wrong_px_percent_rays_sun_0.006_deg_off", wrong.of_rays_with_sun_off.percent(),
                     exact);
  report.note(fmt::format("{} of {} pixels; control: rays to a sun 0.006 degrees off", wrong.of_rays.wrong,
                          wrong.of_rays.pixels));
  const auto add_picture = [&](const std::string& key, const WrongSun& of_picture,
                               const WrongSun& of_other_sun, const Target& target) {
    report.add(key, of_picture.percent(), target);
    report.add_control(key + "_sun_2_deg_off", of_other_sun.percent(), target);
  };
  const WrongPictures &of_rays = wrong.of(ShadowTechnique::rays),
                      &of_default = wrong.of(light::ShadowSettings().technique);
  add_picture("shadow_wrong_px_percent_rays_as_drawn", of_rays.resolved, of_rays.resolved_of_other_sun,
              of_pictures);
  add_picture("shadow_wrong_px_percent_rays_as_drawn_in_the_middle_of_pixels", of_rays.middle,
              of_rays.middle_of_other_sun, exact);
  add_picture("shadow_wrong_px_percent_default", of_default.resolved, of_default.resolved_of_other_sun,
              of_pictures);
  report.add("shadow_wrong_px_percent_best_raster", best_resolved, of_pictures);
  report.add("shadow_wrong_px_percent_best_raster_in_the_middle_of_pixels", best);
  // A share that is off by less than a half makes no pixel wrong, and is seen all the same.
  report.add("shadow_mean_share_off_percent_rays_as_drawn", of_rays.resolved.mean_off_percent());
  report.add("shadow_mean_share_off_percent_default", of_default.resolved.mean_off_percent());
  report.add("shadow_mean_share_off_percent_best_raster", best_mean_off);
  report.add_control("shadow_wrong_px_percent_best_raster_sun_2_deg_off", best_with_sun_off, of_pictures);
  report.note(
      "controls: the same pictures against the truth of a sun 2 degrees off. As drawn, the four samples of a "
      "pixel at an edge mix two surfaces, of which the truth knows one: the limit is that of maps; in the "
      "middle of pixels it is that of rays");
  const WrongPictures& of_perspective = wrong.of(ShadowTechnique::perspective);
  report.add("shadow_perspective_over_best_raster",
             of_perspective.resolved.percent() / std::max(best_resolved, 1e-9));
  report.add("shadow_perspective_over_best_raster_in_the_middle_of_pixels",
             of_perspective.middle.percent() / std::max(best, 1e-9));
}

}  // namespace

Status measure_shadows(const BenchSetup& setup, const scene::Scene& city, Report& report) {
  const scene::Scene twin = opaque_twin(city);
  if (twin.objects.empty() || city.cameras.empty())
    return error("the scene has no opaque objects or no cameras to measure shadows with");
  const DoubleTracer tracer(twin);
  const reference::RayScene rays(twin, reference::Precision::fine);
  auto drawn = SunlitCity::create(twin);
  if (!drawn) return drawn.errors();
  WrongShadows wrong;
  Random random(4);
  const int suns = setup.is_quick ? 3 : 24;
  const auto views =
      city_views(city, tracer, setup.is_quick ? 8 : 200, sunlit_pixels.width, sunlit_pixels.height);
  if (!views) return views.errors();
  for (const Camera& camera : *views)
    for (int s = 0; s < suns; ++s)
      if (Status status = add_view(tracer, rays, twin, camera, any_sun(random), **drawn, wrong); !status)
        return status;
  report.note(fmt::format(
      "{} views, each above another point of the lanes: a half at the height of eyes, a quarter at that of "
      "balconies, a quarter down from above the roofs; {} suns for each",
      views->size(), suns));
  report_wrong(wrong, report);
  if (Status status = measure_flicker(setup, city, tracer, **drawn, random, report); !status) return status;
  return measure_shadow_times(city, report);
}

}  // namespace parvis::bench
