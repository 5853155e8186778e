#include "graphics/light/bench/shadow_bench.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>

#include "base/parallel.h"
#include "base/random.h"
#include "graphics/light/bench/double_tracer.h"
#include "graphics/light/bench/street_camera.h"
#include "graphics/light/shadow_settings.h"
#include "graphics/reference/camera_ray.h"
#include "graphics/render/frame_views.h"
#include "graphics/shadows/chosen_light.h"
#include "graphics/shadows/traced_sun.h"
#include "scene/data/sun_shadows.h"

namespace parvis::bench {
namespace {

using light::ShadowTechnique;

constexpr int width = 160, height = 90;
constexpr double min_facing = 0.03, min_m = 1e-4;
constexpr float half_lit = 0.5f;

/// What each pixel's middle sees of the sun: -1 nothing that faces it, 0 shadow, 1 light.
using SunPicture = std::vector<signed char>;

/// A middle is in shadow if the line from the very point that it shows to the middle of the sun crosses a
/// triangle, more than `min_m` away, whose front the sun sees: shadows as they are drawn.
SunPicture exact_sun(const DoubleTracer& tracer, const Camera& camera, glm::dvec3 to_sun) {
  SunPicture picture(std::size_t(width) * height, -1);
  const reference::CameraRays rays(camera, width, height);
  parallel_for(std::size_t(height), [&](std::size_t row) {
    for (int x = 0; x < width; ++x) {
      const reference::Ray ray = rays.through({float(x) + 0.5f, float(row) + 0.5f});
      const glm::dvec3 origin(ray.origin), direction = glm::normalize(glm::dvec3(ray.direction));
      const auto hit = tracer.nearest(origin, direction, double(ray.min_m), StoppedBy::front);
      if (!hit || glm::dot(hit->normal, to_sun) < min_facing) continue;
      picture[row * std::size_t(width) + std::size_t(x)] =
          tracer.is_blocked(origin + hit->distance_m * direction, to_sun, min_m, StoppedBy::back) ? 0 : 1;
    }
  });
  return picture;
}

/// A picture of the share of the sun in each pixel; 1 where nothing faces it.
using Shares = std::vector<float>;

/// The light of each pixel: of its four samples as they are resolved for the eye, and of its very middle,
/// which at edges shows one surface where the samples show two.
struct DrawnSun {
  Shares resolved, middle;
};

/// A target of one sample per pixel, which lies in the pixel's middle.
class MiddleTarget {
 public:
  MiddleTarget()
      : colour_(gl::texture_2d(GL_RGBA32F, width, height)),
        depth_(gl::texture_2d(GL_DEPTH_COMPONENT32F, width, height)),
        framebuffer_(gl::Framebuffer::create()) {
    glNamedFramebufferTexture(framebuffer_.name(), GL_COLOR_ATTACHMENT0, colour_.name(), 0);
    glNamedFramebufferTexture(framebuffer_.name(), GL_DEPTH_ATTACHMENT, depth_.name(), 0);
  }

  /// The main view as the renderer drew it last, once more.
  ImageF drawn(render::Renderer& renderer) const {
    render::View view = renderer.main_view();
    view.framebuffer = framebuffer_.name();
    renderer.draw_view(view);
    ImageF picture(width, height, 4);
    glGetTextureImage(colour_.name(), 0, GL_RGBA, GL_FLOAT, GLsizei(picture.pixels.size() * sizeof(float)),
                      picture.pixels.data());
    render::flip_rows(picture);
    return picture;
  }

 private:
  gl::Texture colour_, depth_;
  gl::Framebuffer framebuffer_;
};

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

  /// The view that is drawn next. Fails as render::draw_frame.
  Status look(const Camera& camera) {
    camera_ = camera;
    return draw(*open_renderer_, open_, unshaded_);
  }

  /// The shares of the sun in the view that was set. Fails as render::draw_frame.
  Result<DrawnSun> sun(ShadowTechnique technique) {
    light::ShadowSettings& settings = shaded_.data<light::ShadowSettings>();
    settings.technique = technique, settings.sun_samples = 1;
    Pictures shaded;
    if (Status status = draw(*renderer_, shaded_, shaded); !status) return status.errors();
    return DrawnSun{shares(shaded.resolved, unshaded_.resolved), shares(shaded.middle, unshaded_.middle)};
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
  struct Pictures {
    ImageF resolved, middle;
  };
  Status draw(render::Renderer& renderer, const scene::Scene& scene, Pictures& pictures) const {
    if (Status status = render::draw_frame(renderer, scene, {camera_, width, height}); !status) return status;
    pictures = {renderer.read_radiance(), middles_.drawn(renderer)};
    return Done{};
  }
  static Shares shares(const ImageF& with, const ImageF& without) {
    Shares shares(std::size_t(width) * height, 1.0f);
    for (std::size_t i = 0; i < shares.size(); ++i) {
      const float maximum = without.pixels[i * std::size_t(without.channels)];
      if (maximum > 1e-3f) shares[i] = with.pixels[i * std::size_t(with.channels)] / maximum;
    }
    return shares;
  }

  scene::Scene shaded_, open_;
  std::unique_ptr<render::Renderer> renderer_, open_renderer_;
  MiddleTarget middles_;
  Camera camera_;
  Pictures unshaded_;
};

/// Wrong pixels among those that face the sun.
struct Wrong {
  long wrong = 0, pixels = 0;

  void add(const SunPicture& truth, const Shares& shares) {
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (truth[i] < 0) continue;
      ++pixels;
      wrong += (shares[i] > half_lit) != (truth[i] > 0);
    }
  }
  double percent() const { return pixels > 0 ? 100.0 * double(wrong) / double(pixels) : std::nan(""); }
};

glm::vec3 any_sun(Random& random) {
  const float e = random.uniform(0.2f, 1.2f), a = random.uniform(0.0f, 6.2831853f);
  return glm::normalize(glm::vec3(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)));
}

/// The renderer's own pixels of method rays, before the picture.
Shares traced_shares(const reference::RayScene& rays, const scene::SunLight& sun, const Camera& camera) {
  shadows::TracedSun traced;
  traced.trace(rays, 1, {}, sun, camera, width, height, 1);
  Shares shares(std::size_t(width) * height);
  constexpr std::size_t across = width, down = height;
  for (std::size_t y = 0; y < down; ++y)
    for (std::size_t x = 0; x < across; ++x)
      shares[y * across + x] = traced.pixels()[(down - 1 - y) * across + x].x;
  return shares;
}

/// Pixels that change between right and wrong from one step of a walk to the next, while the truth stays.
class Flicker {
 public:
  void add(const SunPicture& truth, const Shares& shares) {
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
  Shares shares_before_;
};

/// Steps of a walk, and what each pixel's middle truly sees in them.
struct Walk {
  std::vector<Camera> cameras;
  std::vector<SunPicture> truths;
  glm::vec3 to_sun;

  Walk(const DoubleTracer& tracer, Camera camera, glm::vec3 sun, int steps) : to_sun(sun) {
    for (int i = 0; i < steps; ++i) {
      camera.world_from_camera[3] -= 0.02f * camera.world_from_camera[2];  // ahead
      cameras.push_back(camera);
      truths.push_back(exact_sun(tracer, camera, glm::dvec3(sun)));
    }
  }
};

struct WalkFlicker {
  Flicker resolved, middle;
};

/// Every other step is lit by a sun that is off by `tremble`.
Result<WalkFlicker> flicker(SunlitCity& drawn, const Walk& walk, ShadowTechnique technique,
                            glm::vec3 tremble = glm::vec3(0.0f)) {
  WalkFlicker flicker;
  for (std::size_t i = 0; i < walk.cameras.size(); ++i) {
    drawn.set_sun(glm::normalize(walk.to_sun + float(i % 2) * tremble));
    if (Status status = drawn.look(walk.cameras[i]); !status) return status.errors();
    const Result<DrawnSun> sun = drawn.sun(technique);
    if (!sun) return sun.errors();
    flicker.resolved.add(walk.truths[i], sun->resolved);
    flicker.middle.add(walk.truths[i], sun->middle);
  }
  return flicker;
}

Status measure_flicker(SunlitCity& drawn, const Walk& walk, Report& report) {
  const glm::vec3 tremble = 3.5e-3f * glm::normalize(glm::vec3(walk.to_sun.y, -walk.to_sun.x, 0.0f));
  const auto shipped = flicker(drawn, walk, ShadowTechnique::cached_cascades),
             fitted = flicker(drawn, walk, ShadowTechnique::cascades),
             trembling = flicker(drawn, walk, ShadowTechnique::cached_cascades, tremble);
  for (const auto* each : {&shipped, &fitted, &trembling})
    if (!*each) return each->errors();
  report.add("shadow_flicker_percent", shipped->resolved.percent(), up_to(0.1));
  report.add("shadow_flicker_percent_in_the_middle_of_pixels", shipped->middle.percent());
  report.add("shadow_flicker_percent_of_cascades", fitted->resolved.percent());
  report.add_control("shadow_flicker_percent_of_a_trembling_sun", trembling->resolved.percent(), up_to(0.1));
  report.note("control: maps of a sun that trembles by 0.2 degrees");
  return Done{};
}

}  // namespace

/// What method `rays` takes for one 720p picture (the scene of this frame, rays, upload) beside the shadow
/// maps of a new sun, on all of the city's triangles and in the city's own views.
Status measure_shadow_times(const scene::Scene& city, Report& report) {
  scene::Scene still = city;
  std::erase_if(still.objects, [](const scene::Object& object) { return object.is_dynamic; });
  auto drawn = SunlitCity::create(still);
  if (!drawn) return drawn.errors();
  reference::RayScene rays(still, reference::Precision::fine);
  std::vector<double> rays_ms, maps_ms, control_ms;
  double rays_cpu_ms = 0.0, maps_cpu_ms = 0.0;  // of all cores: other programs on the machine leave it alone
  constexpr std::size_t max_views = 5;
  constexpr int pictures_per_view = 3;
  const auto cpu_of = [](const auto& body) {
    const std::clock_t before = std::clock();
    body();
    return 1e3 * double(std::clock() - before) / CLOCKS_PER_SEC;
  };
  shadows::TracedSun traced;
  const scene::SunLight sun = scene::sun_light(still);
  const auto picture = [&](const Camera& camera) {
    rays.update(still);
    traced.trace(rays, 1, {}, sun, camera, 1280, 720, 1);
    traced.upload();
    glFinish();
  };
  picture(city.cameras.front().camera);  // arrays and texture are made
  const std::size_t views = std::min(max_views, city.cameras.size());
  for (std::size_t v = 0; v < views; ++v) {
    Camera camera = city.cameras[v].camera;
    double view_ms = 0.0;
    for (int i = 0; i < pictures_per_view; ++i) {
      camera.world_from_camera[3] += glm::vec4(0.0f, 0.01f, 0.0f, 0.0f);
      rays_cpu_ms += cpu_of([&] { rays_ms.push_back(milliseconds([&] { picture(camera); })); });
      view_ms += rays_ms.back() / pictures_per_view;
      // The control traces four times as many pixels.
      shadows::TracedSun larger;
      control_ms.push_back(milliseconds([&] { larger.trace(rays, 1, {}, sun, camera, 2560, 1440, 1); }));
      (*drawn)->set_sun(glm::normalize(glm::vec3(0.4f, -0.3f + 0.02f * float(i), 0.7f)));
      maps_cpu_ms += cpu_of([&] { maps_ms.push_back((*drawn)->beginning_ms(camera)); });
    }
    const auto in_shade =
        std::ranges::count_if(traced.pixels(), [](glm::vec2 pixel) { return pixel.x < 0.5f; });
    report.note(fmt::format(
        "view {}: {:.0f} ms; {:.1f} % of its pixels are in shade or face away from the sun",
        city.cameras[v].name, view_ms, 100.0 * double(in_shade) / double(traced.pixels().size())));
  }
  report.add("shadow_rays_over_depth_pass_time", median(rays_ms).value / median(maps_ms).value, up_to(0.5));
  report.add_control("shadow_rays_over_depth_pass_time_control_of_4_times_the_pixels",
                     median(control_ms).value / median(maps_ms).value, up_to(0.5));
  report.add("shadow_rays_over_depth_pass_cpu_time", rays_cpu_ms / maps_cpu_ms);
  const double pictures = double(rays_ms.size());
  report.note(
      fmt::format("rays {:.0f} ms ({:.0f} of all cores), both maps of cached_cascades after a new sun {:.0f} "
                  "ms ({:.0f}), {} triangles",
                  median(rays_ms).value, rays_cpu_ms / pictures, median(maps_ms).value,
                  maps_cpu_ms / pictures, rays.triangle_count()));
  return Done{};
}

Status measure_shadows(const BenchSetup& setup, const scene::Scene& city, Report& report) {
  const scene::Scene twin = opaque_twin(city);
  if (twin.objects.empty() || city.cameras.empty())
    return error("the scene has no opaque objects or no cameras to measure shadows with");
  const DoubleTracer tracer(twin);
  const reference::RayScene rays(twin, reference::Precision::fine);
  auto drawn = SunlitCity::create(twin);
  if (!drawn) return drawn.errors();
  std::array<Wrong, light::shadow_technique_names.size()> wrong, wrong_resolved, with_sun_moved;
  Wrong of_rays, of_rays_with_sun_moved;
  Random random(4);
  const int cameras = setup.is_quick ? 8 : 200, suns = setup.is_quick ? 3 : 24;
  for (int c = 0; c < cameras; ++c) {
    const Camera camera = street_camera(city, c, random);
    for (int s = 0; s < suns; ++s) {
      const glm::vec3 to_sun = any_sun(random);
      const SunPicture truth = exact_sun(tracer, camera, glm::dvec3(to_sun));
      scene::SunLight sun = scene::sun_light(twin);
      sun.direction_to_sun = to_sun;
      of_rays.add(truth, traced_shares(rays, sun, camera));
      sun.direction_to_sun = glm::normalize(to_sun + glm::vec3(1e-4f, 0.0f, 0.0f));
      of_rays_with_sun_moved.add(truth, traced_shares(rays, sun, camera));
      (*drawn)->set_sun(to_sun);
      if (Status status = (*drawn)->look(camera); !status) return status;
      const SunPicture truth_of_other_sun =
          exact_sun(tracer, camera, glm::dvec3(glm::normalize(to_sun + glm::vec3(0.03f, 0.0f, 0.0f))));
      for (std::size_t t = 0; t < wrong.size(); ++t) {
        const Result<DrawnSun> shares = (*drawn)->sun(ShadowTechnique(t));
        if (!shares) return shares.errors();
        wrong[t].add(truth, shares->middle), wrong_resolved[t].add(truth, shares->resolved);
        with_sun_moved[t].add(truth_of_other_sun, shares->resolved);
      }
    }
  }
  const auto resolved_of = [&](ShadowTechnique technique) {
    return wrong_resolved[std::size_t(technique)].percent();
  };
  double best = 1e9, best_resolved = 1e9, best_with_sun_moved = 1e9;
  for (std::size_t t = 0; t < wrong.size(); ++t) {
    report.note(fmt::format("{}: {:.3f} % of {} pixels wrong in their middle, {:.3f} % as resolved",
                            light::shadow_technique_names[t], wrong[t].percent(), wrong[t].pixels,
                            wrong_resolved[t].percent()));
    if (ShadowTechnique(t) == ShadowTechnique::rays) continue;
    best = std::min(best, wrong[t].percent());
    best_resolved = std::min(best_resolved, wrong_resolved[t].percent());
    best_with_sun_moved = std::min(best_with_sun_moved, with_sun_moved[t].percent());
  }
  report.add("shadow_wrong_px_percent_rays", of_rays.percent(), up_to(0.0));
  report.add_control("shadow_wrong_px_percent_rays_sun_0.006_deg_off", of_rays_with_sun_moved.percent(),
                     up_to(0.0));
  report.note(fmt::format("{} of {} pixels; control: rays to a sun 0.006 degrees off", of_rays.wrong,
                          of_rays.pixels));
  report.add("shadow_wrong_px_percent_best_raster", best_resolved, up_to(0.5));
  report.add("shadow_wrong_px_percent_best_raster_in_the_middle_of_pixels", best);
  report.add_control("shadow_wrong_px_percent_best_raster_sun_2_deg_off", best_with_sun_moved, up_to(0.5));
  report.note("control: the same pictures against a sun 2 degrees off");
  report.add("shadow_wrong_px_percent_rays_as_drawn", resolved_of(ShadowTechnique::rays));
  report.add("shadow_wrong_px_percent_default", resolved_of(ShadowTechnique::cached_cascades));
  report.add("shadow_perspective_over_best_raster",
             resolved_of(ShadowTechnique::perspective) / std::max(best_resolved, 1e-9));
  report.add("shadow_perspective_over_best_raster_in_the_middle_of_pixels",
             wrong[std::size_t(ShadowTechnique::perspective)].percent() / std::max(best, 1e-9));
  const Walk walk(tracer, city.cameras.front().camera, any_sun(random), setup.is_quick ? 12 : 100);
  if (Status status = measure_flicker(**drawn, walk, report); !status) return status;
  return measure_shadow_times(city, report);
}

}  // namespace parvis::bench
