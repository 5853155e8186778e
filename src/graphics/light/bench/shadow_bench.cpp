#include "graphics/light/bench/shadow_bench.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/parallel.h"
#include "base/random.h"
#include "graphics/light/bench/double_tracer.h"
#include "graphics/light/shadow_settings.h"
#include "graphics/reference/camera_ray.h"
#include "graphics/render/renderer.h"
#include "graphics/shadows/chosen_light.h"
#include "graphics/shadows/traced_sun.h"
#include "scene/data/sun_shadows.h"

namespace parvis::bench {
namespace {

using light::ShadowTechnique;

constexpr int width = 160, height = 90;
constexpr double lift_m = 2e-3, min_facing = 0.03;
constexpr float half_lit = 0.5f;

/// What each pixel's middle sees of the sun: -1 nothing that faces it, 0 shadow, 1 light.
using SunPicture = std::vector<signed char>;

SunPicture exact_sun(const DoubleTracer& tracer, const Camera& camera, glm::dvec3 to_sun) {
  SunPicture picture(std::size_t(width) * height, -1);
  parallel_for(std::size_t(height), [&](std::size_t row) {
    for (int x = 0; x < width; ++x) {
      const reference::Ray ray =
          reference::camera_ray(camera, width, height, {float(x) + 0.5f, float(row) + 0.5f});
      const glm::dvec3 origin(ray.origin), direction = glm::normalize(glm::dvec3(ray.direction));
      const auto hit = tracer.nearest(origin, direction, 1e-4, StoppedBy::front);
      if (!hit || glm::dot(hit->normal, to_sun) < min_facing) continue;
      const glm::dvec3 at = origin + hit->distance_m * direction + lift_m * hit->normal;
      picture[row * std::size_t(width) + std::size_t(x)] =
          tracer.is_blocked(at, to_sun, 1e-4, StoppedBy::front) ? 0 : 1;
    }
  });
  return picture;
}

/// The city in the light of the sun alone, with and without shadows, by the renderer.
class SunlitCity {
 public:
  static Result<std::unique_ptr<SunlitCity>> create(const scene::Scene& twin) {
    auto city = std::make_unique<SunlitCity>();
    city->shaded_ = twin, city->open_ = twin;
    for (scene::Scene* scene : {&city->shaded_, &city->open_})
      scene->sky.intensity = 0.0f, scene->haze_per_m = 0.0f, scene->sun.irradiance = glm::vec3(1.0f);
    city->open_.data<scene::SunShadows>().casts_none.assign(twin.objects.size(), true);
    for (auto [scene, renderer] :
         {std::pair{&city->shaded_, &city->renderer_}, {&city->open_, &city->open_renderer_}}) {
      auto made = render::Renderer::create(*scene, {}, shadows::ChosenLight::create);
      if (!made) return made.errors();
      *renderer = *std::move(made);
    }
    return city;
  }

  void set_sun(glm::vec3 to_sun) {
    for (scene::Scene* scene : {&shaded_, &open_}) scene->sun.direction_to_sun = to_sun;
  }

  /// The share of the sun in each pixel; 1 where nothing faces it.
  std::vector<float> shares(const Camera& camera, ShadowTechnique technique) {
    light::ShadowSettings& settings = shaded_.data<light::ShadowSettings>();
    settings.technique = technique, settings.sun_samples = 1;
    const ImageF with = drawn(*renderer_, shaded_, camera), without = drawn(*open_renderer_, open_, camera);
    std::vector<float> shares(std::size_t(width) * height, 1.0f);
    for (std::size_t i = 0; i < shares.size(); ++i) {
      const float maximum = without.pixels[i * std::size_t(without.channels)];
      if (maximum > 1e-3f) shares[i] = with.pixels[i * std::size_t(with.channels)] / maximum;
    }
    return shares;
  }

  /// Milliseconds of a frame's beginning: shadow maps for this camera and the sun as it is.
  double beginning_ms(const Camera& camera) {
    shaded_.data<light::ShadowSettings>().technique = ShadowTechnique::cached_cascades;
    glFinish();
    return milliseconds([&] {
      renderer_->begin_frame(shaded_, camera);
      glFinish();
    });
  }

 private:
  static ImageF drawn(render::Renderer& renderer, const scene::Scene& scene, const Camera& camera) {
    renderer.begin_frame(scene, camera);
    renderer.prepare_main_view(camera, width, height);
    renderer.draw_main_view();
    return renderer.read_radiance();
  }

  scene::Scene shaded_, open_;
  std::unique_ptr<render::Renderer> renderer_, open_renderer_;
};

/// Wrong pixels among those that face the sun.
struct Wrong {
  long wrong = 0, pixels = 0;

  void add(const SunPicture& truth, const std::vector<float>& shares) {
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (truth[i] < 0) continue;
      ++pixels;
      wrong += (shares[i] > half_lit) != (truth[i] > 0);
    }
  }
  double percent() const { return pixels > 0 ? 100.0 * double(wrong) / double(pixels) : std::nan(""); }
};

Camera street_camera(const scene::Scene& city, int number, Random& random) {
  Camera camera = city.cameras[std::size_t(number) % std::min<std::size_t>(city.cameras.size(), 5)].camera;
  const float turn = random.uniform(0.0f, 6.2831853f);
  const glm::vec3 eye =
      camera.position_in_world() + glm::vec3(random.uniform(-2.0f, 2.0f), random.uniform(-2.0f, 2.0f), 0.0f);
  camera.world_from_camera = look_at(eye, eye + glm::vec3(std::cos(turn), std::sin(turn), -0.05f));
  return camera;
}

glm::vec3 any_sun(Random& random) {
  const float e = random.uniform(0.2f, 1.2f), a = random.uniform(0.0f, 6.2831853f);
  return glm::normalize(glm::vec3(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)));
}

/// The renderer's own pixels of method rays, before the picture: what the tracer in single precision finds.
std::vector<float> traced_shares(const reference::RayScene& rays, const scene::Scene& twin,
                                 const Camera& camera) {
  shadows::TracedSun traced;
  traced.trace(rays, 1, scene::sun_light(twin), camera, width, height, 0);
  std::vector<float> shares(std::size_t(width) * height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      shares[std::size_t(y * width + x)] = traced.pixels()[std::size_t((height - 1 - y) * width + x)].x;
  return shares;
}

/// Pixels that change between right and wrong from one step of a walk to the next, while the truth stays.
double flicker_percent(SunlitCity& drawn, const DoubleTracer& tracer, const Camera& start, glm::vec3 to_sun,
                       int steps) {
  drawn.set_sun(to_sun);
  long changes = 0, pixels = 0;
  SunPicture truth_before;
  std::vector<float> shares_before;
  Camera camera = start;
  for (int i = 0; i < steps; ++i) {
    camera.world_from_camera[3] -= 0.02f * camera.world_from_camera[2];  // ahead
    const SunPicture truth = exact_sun(tracer, camera, glm::dvec3(to_sun));
    const std::vector<float> shares = drawn.shares(camera, ShadowTechnique::cached_cascades);
    for (std::size_t k = 0; i > 0 && k < truth.size(); ++k) {
      if (truth[k] < 0 || truth[k] != truth_before[k]) continue;
      ++pixels;
      changes += (shares[k] > half_lit) != (shares_before[k] > half_lit);
    }
    truth_before = truth, shares_before = shares;
  }
  return pixels > 0 ? 100.0 * double(changes) / double(pixels) : std::nan("");
}

/// Rays for one 720p picture beside the shadow maps of a new sun, on all of the city's triangles.
Status measure_times(const scene::Scene& city, Report& report) {
  scene::Scene still = city;
  std::erase_if(still.objects, [](const scene::Object& object) { return object.is_dynamic; });
  auto drawn = SunlitCity::create(still);
  if (!drawn) return drawn.errors();
  const reference::RayScene rays(still);
  Camera camera = city.cameras.front().camera;
  std::vector<double> rays_ms, maps_ms;
  shadows::TracedSun traced;
  scene::SunLight sun = scene::sun_light(still);
  traced.trace(rays, 1, sun, camera, 1280, 720, 0);
  for (int i = 0; i < 5; ++i) {
    camera.world_from_camera[3] += glm::vec4(0.0f, 0.01f, 0.0f, 0.0f);
    rays_ms.push_back(milliseconds([&] { traced.trace(rays, 1, sun, camera, 1280, 720, 0); }));
    (*drawn)->set_sun(glm::normalize(glm::vec3(0.4f, -0.3f + 0.02f * float(i), 0.7f)));
    maps_ms.push_back((*drawn)->beginning_ms(camera));
  }
  report.add("shadow_rays_over_depth_pass_time", median(rays_ms).value / median(maps_ms).value, up_to(0.5));
  report.note(
      fmt::format("rays {:.0f} ms, both maps of cached_cascades after a new sun {:.0f} ms, {} triangles",
                  median(rays_ms).value, median(maps_ms).value, rays.triangle_count()));
  return Done{};
}

}  // namespace

Status measure_shadows(const BenchSetup& setup, const scene::Scene& city, Report& report) {
  const scene::Scene twin = opaque_twin(city);
  if (twin.objects.empty() || city.cameras.empty())
    return error("the scene has no opaque objects or no cameras to measure shadows with");
  const DoubleTracer tracer(twin);
  const reference::RayScene rays(twin);
  auto drawn = SunlitCity::create(twin);
  if (!drawn) return drawn.errors();
  std::array<Wrong, light::shadow_technique_names.size()> wrong;
  Wrong of_rays, with_sun_moved;
  Random random(4);
  const int cameras = setup.is_quick ? 8 : 200, suns = setup.is_quick ? 3 : 24;
  for (int c = 0; c < cameras; ++c) {
    const Camera camera = street_camera(city, c, random);
    for (int s = 0; s < suns; ++s) {
      const glm::vec3 to_sun = any_sun(random);
      const SunPicture truth = exact_sun(tracer, camera, glm::dvec3(to_sun));
      scene::Scene lit = twin;
      lit.sun.direction_to_sun = to_sun;
      of_rays.add(truth, traced_shares(rays, lit, camera));
      (*drawn)->set_sun(to_sun);
      for (std::size_t t = 0; t < wrong.size(); ++t)
        wrong[t].add(truth, (*drawn)->shares(camera, ShadowTechnique(t)));
      const glm::vec3 other = glm::normalize(to_sun + glm::vec3(0.03f, 0.0f, 0.0f));
      with_sun_moved.add(exact_sun(tracer, camera, glm::dvec3(other)),
                         (*drawn)->shares(camera, ShadowTechnique::cached_cascades));
    }
  }
  double best = 1e9;
  for (std::size_t t = 0; t < wrong.size(); ++t) {
    report.note(fmt::format("{}: {:.3f} % of {} pixels wrong", light::shadow_technique_names[t],
                            wrong[t].percent(), wrong[t].pixels));
    if (ShadowTechnique(t) != ShadowTechnique::rays) best = std::min(best, wrong[t].percent());
  }
  report.add("shadow_wrong_px_percent_rays", of_rays.percent(), up_to(0.0));
  report.add("shadow_wrong_px_percent_best_raster", best, up_to(0.5));
  report.add("shadow_wrong_px_percent_sun_2_deg_off", with_sun_moved.percent());
  report.note("control: the same pictures against a sun 2 degrees off must fail 0.5");
  report.add("shadow_perspective_over_best_raster",
             wrong[std::size_t(ShadowTechnique::perspective)].percent() / std::max(best, 1e-9));
  report.add("shadow_flicker_percent",
             flicker_percent(**drawn, tracer, city.cameras.front().camera, any_sun(random),
                             setup.is_quick ? 12 : 100),
             up_to(0.1));
  return measure_times(city, report);
}

}  // namespace parvis::bench
