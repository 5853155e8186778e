// Shadows of every technique against a tracer in double precision.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "base/random.h"
#include "bench/light/exact_sun.h"
#include "bench/parts.h"
#include "graphics/light/shadow_settings.h"
#include "graphics/render/frame_views.h"
#include "graphics/shadows/chosen_light.h"
#include "graphics/shadows/traced_sun.h"
#include "scene/data/sun_shadows.h"

namespace parvis::bench {
namespace {

/// The pictures of SunlitCity. They are as large as a window that is kept fluent, because the share of pixels
/// that lie at an edge grows as pictures shrink; every fourth pixel each way is judged: the other tracer
/// takes its time.
inline constexpr JudgedPixels sunlit_pixels{640, 360, 4};

/// Counts the views of shadow maps that a renderer draws. Draws nothing.
class ShadowViewCounter final : public render::Drawable {
 public:
  render::Extents extents() const override { return {}; }
  void prepare(const render::View& view, const render::Culling& /*culling*/) override {
    count_ += view.kind == render::ViewKind::shadow ? 1 : 0;
  }
  void draw(const render::View& /*view*/, render::Pass /*pass*/) override {}
  /// Shadow views that were prepared.
  int count() const { return count_; }

 private:
  int count_ = 0;
};

constexpr int width = sunlit_pixels.width, height = sunlit_pixels.height;

/// Light of an irradiance of 1 below which, without shadows, a surface does not face the sun.
constexpr float min_light = 1e-3f;

SunShares shares_of(const ImageF& with, const ImageF& without) {
  return judged_shares(sunlit_pixels, [&](std::size_t x, std::size_t y) {
    const std::size_t pixel = y * std::size_t(width) + x;
    const float maximum = without.pixels[pixel * std::size_t(without.channels)];
    return maximum > min_light ? with.pixels[pixel * std::size_t(with.channels)] / maximum : 1.0f;
  });
}
/// The city with and without shadows: the quotient of both pictures is the light that shadows leave.
class SunlitCity {
 public:
  /// `twin` is an opaque_twin. Fails if a shader does.
  static std::unique_ptr<SunlitCity> create(const scene::Scene& twin) {
    auto city = std::make_unique<SunlitCity>();
    city->shaded_ = twin, city->open_ = twin;
    for (scene::Scene* scene : {&city->shaded_, &city->open_})
      scene->sky.intensity = 0.0f, scene->haze_per_m = 0.0f, scene->sun.irradiance = glm::vec3(1.0f);
    city->open_.data<scene::SunShadows>().casts_none.assign(twin.objects.size(), true);
    for (auto [scene, renderer] :
         {std::pair{&city->shaded_, &city->renderer_}, {&city->open_, &city->open_renderer_}}) {
      *renderer = must(render::Renderer::create(*scene, {}, shadows::ChosenLight::create));
    }
    city->renderer_->add(&city->map_views_);
    return city;
  }

  /// Sets the sun of both scenes, a unit vector.
  void set_sun(glm::vec3 to_sun) {
    for (scene::Scene* scene : {&shaded_, &open_}) scene->sun.direction_to_sun = to_sun;
  }
  /// The view that is drawn next. Fails as render::draw_frame.
  void look(const Camera& camera) {
    camera_ = camera;
    draw(*open_renderer_, open_, unshaded_);
  }
  /// The shares of the sun in the view that was set. Rays go to the middle of the sun, as those of a view
  /// that moves do with any settings. Fails as render::draw_frame.
  SunShares sun(light::ShadowTechnique technique) {
    set_technique(technique);
    ImageF shaded;
    draw(*renderer_, shaded_, shaded);
    return shares_of(shaded, unshaded_);
  }
  /// Begins a frame of a view by the technique, and draws nothing of the view itself. True where that has
  /// drawn shadow maps.
  bool draws_maps(const Camera& camera, light::ShadowTechnique technique) {
    set_technique(technique);
    const int before = map_views();
    renderer_->begin_frame(shaded_, camera);
    return map_views() > before;
  }
  /// Views of shadow maps that were drawn for all frames so far.
  int map_views() const { return map_views_.count(); }

 private:
  void draw(render::Renderer& renderer, const scene::Scene& scene, ImageF& picture) const {
    must(render::draw_frame(renderer, scene, {camera_, width, height}));
    picture = renderer.read_radiance();
  }

  void set_technique(light::ShadowTechnique technique) {
    light::ShadowSettings& settings = shaded_.data<light::ShadowSettings>();
    settings.technique = technique, settings.sun_samples = 1;
  }

  scene::Scene shaded_, open_;
  ShadowViewCounter map_views_;
  std::unique_ptr<render::Renderer> renderer_, open_renderer_;
  Camera camera_;
  ImageF unshaded_;
};

using light::ShadowTechnique;

constexpr std::size_t technique_count = light::shadow_technique_names.size();

/// Angles of the suns of controls: under the one no ray may be taken for another's, under the other no
/// picture.
constexpr float slightly_off_deg = 0.006f, off_deg = 2.0f;

/// A sun from two to 69 degrees high: mornings and evenings have the longest shadows.
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
  /// Begins another walk with the next step that is added.
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
Camera first_of_walk(SunlitCity& drawn, const Camera& camera, int steps) {
  constexpr int max_steps = int(25.0f / step_m);  // such places are no farther apart
  constexpr ShadowTechnique technique = ShadowTechnique::cached_cascades;
  drawn.draws_maps(camera, technique);
  for (int far = steps - 1; far <= max_steps; far += steps - 1)
    for (const bool is_behind : {false, true})
      if (drawn.draws_maps(ahead(camera, is_behind ? -far : far), technique))
        return ahead(camera, is_behind ? -far : far - (steps - 1));
  fail("the default draws its maps again nowhere within 25 m of a view");
}

/// Adds a walk. Every other step is lit by a sun that is off by `tremble_deg`. Returns how many views of
/// shadow maps were drawn after the first step.
int add_walk(SunlitCity& drawn, const Walk& walk, ShadowTechnique technique, Flicker& flicker,
             float tremble_deg = 0.0f) {
  flicker.begin();
  int first_views = 0;
  for (std::size_t i = 0; i < walk.cameras.size(); ++i) {
    drawn.set_sun(i % 2 == 1 && tremble_deg > 0.0f ? turned_sun(walk.to_sun, tremble_deg) : walk.to_sun);
    drawn.look(walk.cameras[i]);
    const SunShares sun = drawn.sun(technique);
    flicker.add(walk.truths[i], sun);
    if (i == 0) first_views = drawn.map_views();
  }
  return drawn.map_views() - first_views;
}

/// Walks from the first views, each under a sun of its own.
void measure_flicker(const BenchSetup& setup, const scene::Scene& city, const DoubleTracer& tracer,
                     SunlitCity& drawn, Random& random, Report& report) {
  const int steps = setup.is_quick ? 12 : 100;
  const std::size_t walks = std::min(std::size_t(setup.is_quick ? 2 : 4), city.cameras.size());
  constexpr float tremble_deg = 0.2f;
  Flicker shipped, trembling;
  for (std::size_t w = 0; w < walks; ++w) {
    const glm::vec3 to_sun = any_sun(random);
    drawn.set_sun(to_sun);
    const Camera first = first_of_walk(drawn, city.cameras[w].camera, steps);
    const Walk walk(tracer, first, to_sun, steps);
    const int redrawn = add_walk(drawn, walk, ShadowTechnique::cached_cascades, shipped);
    add_walk(drawn, walk, ShadowTechnique::cached_cascades, trembling, tremble_deg);
    if (redrawn == 0) fail("walk {}: the default has not drawn its near map again", w);
  }
  report.add("shadow_flicker_percent", shipped.percent());
  report.add("shadow_flicker_percent_of_a_trembling_sun", trembling.percent());
}

/// The pictures of one technique, and the same against the truth of a sun that is off.
struct WrongPictures {
  WrongSun resolved, resolved_of_other_sun;
};

/// Wrong pixels of all views.
struct WrongShadows {
  WrongSun of_rays, of_rays_with_sun_off;
  std::array<WrongPictures, technique_count> pictures;

  const WrongPictures& of(ShadowTechnique technique) const { return pictures[std::size_t(technique)]; }
};

/// One view under one sun.
void add_view(const DoubleTracer& tracer, const reference::RayScene& rays, const scene::Scene& twin,
              const Camera& camera, glm::vec3 to_sun, SunlitCity& drawn, WrongShadows& wrong) {
  const SunPicture truth = exact_sun(tracer, camera, sunlit_pixels, glm::dvec3(to_sun));
  scene::SunLight sun = scene::sun_light(twin);
  sun.direction_to_sun = to_sun;
  wrong.of_rays.add(truth, traced_shares(rays, sun, camera));
  sun.direction_to_sun = turned_sun(to_sun, slightly_off_deg);
  wrong.of_rays_with_sun_off.add(truth, traced_shares(rays, sun, camera));
  drawn.set_sun(to_sun);
  drawn.look(camera);
  const SunPicture truth_of_other_sun =
      exact_sun(tracer, camera, sunlit_pixels, glm::dvec3(turned_sun(to_sun, off_deg)));
  for (std::size_t t = 0; t < technique_count; ++t) {
    const SunShares shares = drawn.sun(ShadowTechnique(t));
    WrongPictures& pictures = wrong.pictures[t];
    pictures.resolved.add(truth, shares);
    pictures.resolved_of_other_sun.add(truth_of_other_sun, shares);
  }
}

void report_wrong(const WrongShadows& wrong, Report& report) {
  constexpr double none = std::numeric_limits<double>::infinity();
  double best_resolved = none, best_with_sun_off = none;
  for (std::size_t t = 0; t < technique_count; ++t) {
    const WrongPictures& pictures = wrong.pictures[t];
    report.note(fmt::format("{}: {:.3f} % of {} pixels wrong as resolved", light::shadow_technique_names[t],
                            pictures.resolved.percent(), pictures.resolved.pixels));
    if (ShadowTechnique(t) == ShadowTechnique::rays) continue;
    best_resolved = std::min(best_resolved, pictures.resolved.percent());
    best_with_sun_off = std::min(best_with_sun_off, pictures.resolved_of_other_sun.percent());
  }
  report.add("shadow_wrong_px_percent_rays", wrong.of_rays.percent());
  report.add("shadow_wrong_px_percent_rays_sun_0.006_deg_off", wrong.of_rays_with_sun_off.percent());
  report.note(fmt::format("{} of {} pixels; control: rays to a sun 0.006 degrees off", wrong.of_rays.wrong,
                          wrong.of_rays.pixels));
  const auto add_picture = [&](const std::string& key, const WrongSun& of_picture,
                               const WrongSun& of_other_sun) {
    report.add(key, of_picture.percent());
    report.add(key + "_sun_2_deg_off", of_other_sun.percent());
  };
  const WrongPictures &of_rays = wrong.of(ShadowTechnique::rays),
                      &of_default = wrong.of(light::ShadowSettings().technique);
  add_picture("shadow_wrong_px_percent_rays_as_drawn", of_rays.resolved, of_rays.resolved_of_other_sun);
  add_picture("shadow_wrong_px_percent_default", of_default.resolved, of_default.resolved_of_other_sun);
  report.add("shadow_wrong_px_percent_best_raster", best_resolved);
  report.add("shadow_wrong_px_percent_best_raster_sun_2_deg_off", best_with_sun_off);
  const WrongPictures& of_perspective = wrong.of(ShadowTechnique::perspective);
  report.add("shadow_perspective_over_best_raster",
             of_perspective.resolved.percent() / std::max(best_resolved, 1e-9));
}

}  // namespace

void measure_shadows(const BenchSetup& setup, Report& report) {
  const scene::Scene city = setup.scene(setup.city() / "paper_day.xp");
  const scene::Scene twin = opaque_twin(city);
  if (twin.objects.empty() || city.cameras.empty())
    fail("the scene has no opaque objects or no cameras to measure shadows with");
  const DoubleTracer tracer(twin);
  const reference::RayScene rays(twin, reference::Precision::fine);
  auto drawn = SunlitCity::create(twin);
  WrongShadows wrong;
  Random random(4);
  const int suns = setup.is_quick ? 3 : 24;
  const auto views =
      city_views(city, tracer, setup.is_quick ? 8 : 200, sunlit_pixels.width, sunlit_pixels.height);
  for (const Camera& camera : views)
    for (int s = 0; s < suns; ++s) add_view(tracer, rays, twin, camera, any_sun(random), *drawn, wrong);
  report_wrong(wrong, report);
  measure_flicker(setup, city, tracer, *drawn, random, report);
  measure_shadow_times(setup, report);
}

}  // namespace parvis::bench
