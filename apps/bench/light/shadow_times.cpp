// What the beginnings of frames cost by rays and by shadow maps.
#include <algorithm>
#include <ctime>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "bench/light/exact_sun.h"
#include "bench/parts.h"
#include "graphics/light/shadow_settings.h"
#include "graphics/render/light_over.h"
#include "graphics/render/renderer.h"
#include "graphics/shadows/chosen_light.h"

namespace parvis::bench {
namespace {

/// Cost of one frame.
struct FrameCost {
  double ms = 0.0, cpu_ms = 0.0;  ///< by the clock, and of all cores
};

/// Either of them.
using Cost = double FrameCost::*;

/// Median difference of frames drawn in turn: a load that slows both for a while leaves it as it is.
double median_difference(const std::vector<FrameCost>& more, const std::vector<FrameCost>& less, Cost cost) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < more.size(); ++i) differences.push_back(more[i].*cost - less[i].*cost);
  return median(std::move(differences)).value;
}

/// Frames of one size in turn, each under a sun of its own: by rays, by the default's maps, and by the same
/// maps where they are kept, because sun and view are those of the frame before.
struct FrameCosts {
  std::vector<FrameCost> rays, maps, kept;

  /// Cost of drawing the maps.
  double depth_pass(Cost cost) const { return median_difference(maps, kept, cost); }
  /// Cost of the rays over that. Method rays draws the default's maps, too, whose cost is not that of its
  /// rays. No number where either is nothing: the clock has then shown noise.
  double rays_over_depth_pass(Cost cost) const {
    const double beyond_maps = median_difference(rays, maps, cost), drawing = depth_pass(cost);
    return beyond_maps > 0.0 && drawing > 0.0 ? beyond_maps / drawing
                                              : std::numeric_limits<double>::quiet_NaN();
  }
};

constexpr glm::ivec2 picture{1280, 720};

/// Every eighth pixel each way is judged: the other tracer takes its time.
constexpr JudgedPixels judged{picture.x, picture.y, 8};
constexpr std::size_t max_views = 5;
constexpr std::size_t min_triangles = 500'000;  // as the issue has them
constexpr int pictures_per_view = 3;

/// Angle of a control's sun.
constexpr float off_deg = 2.0f;

/// The light that ships, of which the traced pixels can be read: those that a picture is drawn with.
class ReadableLight final : public render::LightOver {
 public:
  using LightOver::LightOver;

  render::TracedSun trace_view(const Camera& camera, int width, int height) override {
    size_ = {width, height};
    return texture_ = LightOver::trace_view(camera, width, height);
  }
  /// Shares of the sun in the view that was traced last; empty where the technique traces none.
  SunShares traced(const JudgedPixels& pixels) const {
    if (texture_ == 0 || size_ != glm::ivec2(pixels.width, pixels.height)) return {};
    std::vector<glm::vec2> texels(std::size_t(size_.x) * std::size_t(size_.y));
    glGetTextureImage(texture_, 0, GL_RG, GL_FLOAT, GLsizei(texels.size() * sizeof(glm::vec2)),
                      texels.data());
    const auto across = std::size_t(size_.x), last = std::size_t(size_.y - 1);
    return judged_shares(pixels, [&](std::size_t x, std::size_t y) {
      return texels[(last - y) * across + x].x;  // the picture's top row is the texture's last
    });
  }

 private:
  render::TracedSun texture_ = 0;
  glm::ivec2 size_{0};
};

/// A city whose frames are begun by one technique, as a running scene begins them: what moved, the maps that
/// the technique draws, the view's culling, and rays where there are any. All else of a frame is the same for
/// every technique.
class BegunFrames {
 public:
  static std::unique_ptr<BegunFrames> create(const scene::Scene& city, light::ShadowTechnique technique) {
    auto frames = std::make_unique<BegunFrames>();
    frames->scene_ = city;
    frames->scene_.data<light::ShadowSettings>().technique = technique;  // its other settings are the default
    const render::MakeLight make = [&](const scene::Scene& scene,
                                       const Bounds& fixed) -> Result<std::unique_ptr<render::LightSource>> {
      auto light = must(shadows::ChosenLight::create(scene, fixed));
      auto readable = std::make_unique<ReadableLight>(std::move(light));
      frames->light_ = readable.get();
      return std::unique_ptr<render::LightSource>(std::move(readable));
    };
    auto renderer = must(render::Renderer::create(frames->scene_, {}, make));
    frames->renderer_ = std::move(renderer);
    return frames;
  }

  FrameCost begin(const Camera& camera, glm::vec3 to_sun, glm::ivec2 size) {
    scene_.sun.direction_to_sun = to_sun;
    glFinish();
    FrameCost cost;
    const std::clock_t before = std::clock();
    cost.ms = milliseconds([&] {
      renderer_->begin_frame(scene_, camera);
      renderer_->prepare_main_view(camera, size.x, size.y);
      glFinish();
    });
    cost.cpu_ms = 1e3 * double(std::clock() - before) / CLOCKS_PER_SEC;
    return cost;
  }
  SunShares traced() const { return light_->traced(judged); }

 private:
  scene::Scene scene_;
  std::unique_ptr<render::Renderer> renderer_;
  const ReadableLight* light_ = nullptr;
};

/// Errors of the sun traced for the pictures that were timed, against the tracer in double precision and
/// against the same under a sun that is off.
struct Judgement {
  WrongSun wrong, wrong_of_other_sun;

  /// Leaves and glass, which the tracer does not know, are `unknown`: pixels that they may concern are left
  /// out.
  void add(const DoubleTracer& tracer, const DoubleTracer& unknown, const Camera& camera, glm::vec3 to_sun,
           const SunShares& shares) {
    if (shares.empty()) fail("method rays has traced no pixels of a picture that was timed");
    wrong.add(exact_sun(tracer, camera, judged, glm::dvec3(to_sun), &unknown), shares);
    const glm::dvec3 other_sun(turned_sun(to_sun, off_deg));
    wrong_of_other_sun.add(exact_sun(tracer, camera, judged, other_sun, &unknown), shares);
  }
};

/// The camera, a step further each time.
Camera ahead(Camera camera, int step) {
  camera.world_from_camera[3] += glm::vec4(0.0f, 0.01f * float(step), 0.0f, 0.0f);
  return camera;
}

/// One frame more of each, under a sun that both have not had.
void add(BegunFrames& rays, BegunFrames& maps, const Camera& camera, glm::vec3 to_sun, glm::ivec2 size,
         FrameCosts& costs) {
  costs.rays.push_back(rays.begin(camera, to_sun, size));
  costs.maps.push_back(maps.begin(camera, to_sun, size));
  costs.kept.push_back(maps.begin(camera, to_sun, size));
}

std::size_t triangles_of(const scene::Scene& scene) {
  std::size_t count = 0;
  for (const scene::Object& object : scene.objects)
    if (object.is_visible)
      for (const scene::Part& part : object.model->parts) count += part.mesh.indices.size() / 3;
  return count;
}

void report_times(const FrameCosts& costs, const FrameCosts& of_more_pixels, Report& report) {
  constexpr Cost ms = &FrameCost::ms;
  report.add("shadow_rays_over_depth_pass_time", costs.rays_over_depth_pass(ms));
  report.add("shadow_rays_over_depth_pass_time_control_of_4_times_the_pixels",
             of_more_pixels.rays_over_depth_pass(ms));
  report.add("shadow_rays_over_depth_pass_cpu_time", costs.rays_over_depth_pass(&FrameCost::cpu_ms));
}

void report_judgement(const Judgement& moving, Report& report) {
  report.add("shadow_wrong_px_percent_rays_as_timed", moving.wrong.percent());
  report.add("shadow_wrong_px_percent_rays_as_timed_sun_2_deg_off", moving.wrong_of_other_sun.percent());
  if (moving.wrong.pixels == 0 || moving.wrong.wrong > 0)
    fail("{} of {} traced pixels of the pictures that were timed are wrong: their time does not count",
         moving.wrong.wrong, moving.wrong.pixels);
}

}  // namespace

void measure_shadow_times(const BenchSetup& setup, Report& report) {
  const scene::Scene city = setup.scene(setup.city() / "paper_day.xp");
  if (city.cameras.empty()) fail("the scene has no cameras to time shadows with");
  scene::Scene still = city;
  std::erase_if(still.objects, [](const scene::Object& object) { return object.is_dynamic; });
  const std::size_t triangles = triangles_of(still);
  if (triangles < min_triangles)
    fail("the scene has {} triangles that stand still, where {} are to be timed", triangles, min_triangles);
  report.note(fmt::format("{} triangles stand still", triangles));
  const DoubleTracer tracer(opaque_twin(still)), unknown(rest_of_twin(still));
  auto rays = BegunFrames::create(still, light::ShadowTechnique::rays);
  auto maps = BegunFrames::create(still, light::ShadowSettings().technique);

  FrameCosts costs, of_more_pixels;
  Judgement of_moving;
  int suns = 0;
  const auto next_sun = [&] { return glm::normalize(glm::vec3(0.4f, -0.3f + 0.02f * float(suns++), 0.7f)); };
  const std::size_t views = std::min(max_views, city.cameras.size());
  for (std::size_t v = 0; v < views; ++v) {
    const Camera& camera = city.cameras[v].camera;
    glm::vec3 to_sun = next_sun();
    for (BegunFrames* frames : {rays.get(), maps.get()})  // arrays and textures of this size are made
      frames->begin(camera, to_sun, picture);
    for (int i = 1; i <= pictures_per_view; ++i) {
      to_sun = next_sun();
      add(*rays, *maps, ahead(camera, 2 * i), to_sun, picture, costs);
    }
    of_moving.add(tracer, unknown, ahead(camera, 2 * pictures_per_view), to_sun, rays->traced());
    // The control has four times as many pixels; the first frame of another size is a jump.
    for (BegunFrames* frames : {rays.get(), maps.get()}) frames->begin(camera, next_sun(), 2 * picture);
    add(*rays, *maps, ahead(camera, 2), next_sun(), 2 * picture, of_more_pixels);
  }
  report_judgement(of_moving, report);
  report_times(costs, of_more_pixels, report);
}

}  // namespace parvis::bench
