// Sun positions and skies, each against its ground truth, and what a new sky costs.
#include "graphics/shading/sky.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "base/colour.h"
#include "base/files.h"
#include "base/image_io.h"
#include "base/test_data.h"
#include "bench/parts.h"
#include "graphics/light/day_light.h"
#include "graphics/light/sky_model.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/light/test_brute_force_sky.h"
#include "graphics/light/test_drawn_sky_check.h"
#include "graphics/light/test_sky_gpu_check.h"
#include "graphics/light/test_sun_tables.h"
#include "graphics/light/test_worse.h"
#include "graphics/render/fixed_parts.h"
#include "graphics/render/frame_views.h"
#include "graphics/render/light_source.h"
#include "graphics/render/renderer.h"
#include "places/paper_city/paper_script.h"
#include "stage/stage.h"
#include "synthesis/sky_picture.h"

namespace parvis::bench {
namespace {

/// Samples, and those of them that are no radiance: negative or no numbers, or black where a sky is not,
/// which is what clamps leave of negative ones.
struct SkySamples {
  long all = 0, bad = 0;

  /// Counts one, of radiance in any three channels.
  void add(glm::vec3 radiance, bool has_light) {
    const bool is_radiance = radiance.x >= 0.0f && radiance.y >= 0.0f && radiance.z >= 0.0f &&
                             std::isfinite(radiance.x + radiance.y + radiance.z);
    const bool is_black = has_light && radiance == glm::vec3(0.0f);
    ++all, bad += !is_radiance || is_black;
  }
};

/// Both models on the CPU, for all that a scene may ask of them; and the same samples, each a little darker.
struct ModelSamples {
  SkySamples shipped, darker;
};

/// A model of which some radiance is taken away, below zero where it has less: a control.
class DarkerSky final : public light::SkyModel {
 public:
  DarkerSky(std::shared_ptr<const light::SkyModel> sky, float less)
      : SkyModel(sky->to_sun(), sky->sun_irradiance_xyz()), sky_(std::move(sky)), less_(less) {}
  glm::vec3 sky_radiance_xyz(glm::vec3 direction) const override {
    return sky_->sky_radiance_xyz(direction) - less_;
  }

 private:
  std::shared_ptr<const light::SkyModel> sky_;
  float less_;
};

using light::SkyKind;

/// Whether there is light: by day everywhere, in twilight down to -4 degrees above the horizon.
bool has_light(double sun_elevation_deg, bool is_above_horizon) {
  constexpr double last_twilight_deg = -4.0, rounding_deg = 1e-3;
  return sun_elevation_deg > rounding_deg ||
         (is_above_horizon && sun_elevation_deg > last_twilight_deg - rounding_deg);
}
/// Where a sun stands that the models are asked for, in the south.
light::SolarPosition sun_at(double elevation_deg) {
  return {.azimuth_deg = 180.0, .zenith_deg = 90.0 - elevation_deg, .geometric_elevation_deg = elevation_deg};
}

/// Unit direction `number` of `count` that are spread evenly over the sphere.
glm::vec3 even_direction(int number, int count) {
  const float z = 1.0f - 2.0f * (float(number) + 0.5f) / float(count), turn = 2.39996323f * float(number);
  const float across = std::sqrt(1.0f - z * z);
  return {across * std::cos(turn), across * std::sin(turn), z};
}

/// So many directions of each sky.
ModelSamples model_samples(int directions) {
  constexpr float less = 1e-4f;  // W/m2/sr, 0.07 cd/m2: what the control takes away
  ModelSamples samples;
  const auto look = [&](SkyKind kind, const light::Air& air, double elevation) {
    const auto sky = must(light::make_sky(kind, air, sun_at(elevation)));
    for (int i = 0; i < directions; ++i) {
      const glm::vec3 direction = even_direction(i, directions), seen = sky->sky_radiance_xyz(direction);
      samples.shipped.add(seen, has_light(elevation, direction.z > 0.0f));
      samples.darker.add(seen - less, false);
    }
    return;
  };
  for (const double turbidity : {1.0, 1.1, 1.3, 1.5, 1.645, 1.8, 2.0, 3.0, 6.0, 11.5, 20.0, 64.0})
    for (const double albedo : {0.0, 0.2, 1.0})
      for (const double elevation : {-90.0, -18.0, -8.0, -4.0, -1.0, 0.0, 1.0, 5.0, 20.0, 60.0, 90.0})
        for (const SkyKind kind : {SkyKind::atmosphere, SkyKind::preetham})
          look(kind, {turbidity, albedo}, elevation);
  return samples;
}
/// Skies as the renderer draws them, one after the other.
class DrawnSky {
 public:
  /// Fails if a shader does. Needs a current OpenGL context.
  static DrawnSky create() {
    scene::Scene scene;
    auto renderer = must(render::Renderer::create(scene, {}, light::sun_and_sky));
    return DrawnSky(std::move(scene), std::move(renderer));
  }
  /// The pixels of six views that together show all directions, with the dome of `day` if it has one. Fails
  /// as render::draw_frame.
  SkySamples samples(const light::SkyModel& sky, const light::DayLight& day = {});

 private:
  DrawnSky(scene::Scene scene, std::unique_ptr<render::Renderer> renderer)
      : scene_(std::move(scene)), renderer_(std::move(renderer)) {}

  scene::Scene scene_;
  std::unique_ptr<render::Renderer> renderer_;
};

SkySamples DrawnSky::samples(const light::SkyModel& sky, const light::DayLight& day) {
  constexpr int view_px = 96, picture_px = 512, upward_face = 5;
  const double sun_deg = glm::degrees(std::asin(std::clamp(double(sky.to_sun().z), -1.0, 1.0)));
  scene_.sun = {sky.to_sun(), glm::vec3(1.0f)};
  scene_.sky.picture = light::sky_picture(sky, day, picture_px);
  ++scene_.sky.version;
  SkySamples samples;
  for (int face = 0; face < 6; ++face) {
    must(render::draw_frame(*renderer_, scene_, {light::view_of_sky(face), view_px, view_px}));
    const ImageF seen = renderer_->read_radiance();
    for (std::size_t i = 0; i < seen.pixels.size(); i += std::size_t(seen.channels))
      samples.add({seen.pixels[i], seen.pixels[i + 1], seen.pixels[i + 2]},
                  has_light(sun_deg, face == upward_face));
  }
  return samples;
}

constexpr double frame_s = 1.0 / 30.0;
constexpr int updates = 11;
constexpr const char* clouds_file = "sky.hdr";
constexpr int clouds_px = 2048;  // across, as those of the paper's city

/// A running scene of nothing but its sky, and the light of the renderer that shows it. Shadow maps and
/// bounced light, which follow a new sun too, have keys of their own.
class PassingDay {
 public:
  /// `more`: nodes beside dayLight. Fails as stage::open_simulation, or if a shader does.
  static PassingDay open(const BenchSetup& setup, const std::filesystem::path& script,
                         const std::string& more) {
    must(write_file(script, "dayLight(timeOfDay=8)\n" + more));
    stage::Simulation simulation = setup.simulation(script);
    auto light = must(rooms::all_registries().get<render::Lights>().make(
        simulation.scene, render::bounds_of_fixed_parts(simulation.scene, false)));
    return PassingDay(std::move(simulation), std::move(light));
  }

  /// The frame in which dayLight has received a message: how long its sky takes. Fails where the message
  /// does, and where the sky that is shown is the same as before.
  double change(const std::string& message) {
    const auto before = light_->sky().irradiance_sh;
    must(simulation_.clock.send("%dayLight", message));
    glFinish();
    const double ms = milliseconds([&] {
      simulation_.advance(frame_s);
      light_->update(simulation_.scene);
      glFinish();
    });
    if (light_->sky().irradiance_sh == before) fail("\"{}\" has not changed the sky", message);
    return ms;
  }
  /// Times of steps from each half hour to the next.
  std::vector<double> half_hours() {
    std::vector<double> all_ms;
    all_ms.reserve(updates);
    for (int i = 1; i <= updates; ++i) {
      const double ms = change(fmt::format("timeOfDay {}", 8.0 + 0.5 * double(i)));
      all_ms.push_back(ms);
    }
    return all_ms;
  }

 private:
  PassingDay(stage::Simulation simulation, std::unique_ptr<render::LightSource> light)
      : simulation_(std::move(simulation)), light_(std::move(light)) {}

  stage::Simulation simulation_;
  std::unique_ptr<render::LightSource> light_;
};

namespace fs = std::filesystem;

using light::SkyKind, light::worse;

void measure_sun(Report& report) {
  const auto file = shared_data("sun/spa_azimuth_zenith.csv", fs::current_path());
  if (!file) return report.skip("sun_max_error_deg", "the shared data is absent");
  const std::vector<light::SunRow> rows = light::read_sun_rows(*file);
  constexpr std::size_t min_rows = 250;  // there are 256: what cannot be read is passed over
  if (rows.size() < min_rows) fail("{} has {} rows, not {}", file->string(), rows.size(), min_rows);
  report.add("sun_max_error_deg", light::max_error_deg(rows));
  report.add("sun_max_error_deg_a_second_late", light::max_error_deg(rows, 1.0 / 3600.0));
  report.note(fmt::format("{} rows of NREL's own program", rows.size()));
}

/// Luminance of the sky alone on level ground.
double diffuse(const light::SkyModel& sky) {
  return double(sky.irradiance_xyz({0, 0, 1}, 8192).y -
                std::max(sky.to_sun().z, 0.0f) * sky.sun_irradiance_xyz().y);
}

/// The same as scenes get it: from the sky's picture, by its harmonics up to `orders`, all of them 3.
double diffuse_of_scene(const light::SkyModel& sky, int orders = 3) {
  constexpr int picture_px = 512;  // as clear skies have
  shading::SkyLight light = shading::make_sky_light(light::sky_picture(sky, {}, picture_px), 1.0f, 0.0f);
  std::fill(light.irradiance_sh.begin() + orders * orders, light.irradiance_sh.end(), glm::vec3(0.0f));
  return double(luminance(shading::sky_irradiance(light.irradiance_sh.data(), {0, 0, 1})));
}

/// Diffuse light by so many paths, or by more if their error is too large.
light::BruteForceIrradiance true_diffuse(const light::Air& air, double elevation_deg, int paths) {
  constexpr double max_standard_error = 0.01;
  for (const int more : {1, 2, 4, 8}) {
    const auto truth = light::brute_force_diffuse(air, elevation_deg, more * paths, 1);
    if (truth.standard_error <= max_standard_error) return truth;
  }
  fail("brute force under a sun at {} deg is not known to a percent after {} paths", elevation_deg,
       8 * paths);
}

/// The largest error of diffuse light over all elevations of the sun, percent: of both models, and of the
/// light of scenes that have the first of them, with all harmonics and with their mean alone.
struct DiffuseErrors {
  double atmosphere = 0.0, preetham = 0.0, of_scene = 0.0, of_scene_without_orders = 0.0;

  void add(const DiffuseErrors& other) {
    atmosphere = worse(atmosphere, other.atmosphere), preetham = worse(preetham, other.preetham);
    of_scene = worse(of_scene, other.of_scene);
    of_scene_without_orders = worse(of_scene_without_orders, other.of_scene_without_orders);
  }
};

DiffuseErrors diffuse_errors(double turbidity, const std::vector<double>& elevations, int paths,
                             Report& report) {
  DiffuseErrors largest;
  for (const double elevation : elevations) {
    const light::Air air{turbidity};
    const light::BruteForceIrradiance truth = true_diffuse(air, elevation, paths);
    const double expected = light::xyz(truth.share).y;
    const auto sky = must(light::make_sky(SkyKind::atmosphere, air, sun_at(elevation)));
    const auto preetham = must(light::make_sky(SkyKind::preetham, air, sun_at(elevation)));
    const auto off_percent = [&](double found) { return 100.0 * (found / expected - 1.0); };
    const double of_tables = off_percent(diffuse(*sky)), of_preetham = off_percent(diffuse(*preetham)),
                 of_scene = off_percent(diffuse_of_scene(*sky));
    largest.add({std::abs(of_tables), std::abs(of_preetham), std::abs(of_scene),
                 std::abs(off_percent(diffuse_of_scene(*sky, 1)))});
    report.note(
        fmt::format("turbidity {}, sun at {:3.0f} deg: brute force {:8.1f} lx (+- {:.1f} %), tables "
                    "{:+.1f} %, light of scenes {:+.1f} %, preetham {:+.0f} %",
                    turbidity, elevation, light::lumens_per_watt * expected, 100.0 * truth.standard_error,
                    of_tables, of_scene, of_preetham));
  }
  return largest;
}

void measure_brute_force(const BenchSetup& setup, Report& report) {
  std::vector<double> elevations{-4, -2, 0, 5, 15, 45, 90}, turbidities{3.0};
  if (!setup.is_quick)
    elevations = {-4, -3, -2, -1, 0, 1, 2, 5, 10, 15, 25, 35, 45, 60, 75, 90}, turbidities = {2.0, 3.0, 6.0};
  const int paths = setup.is_quick ? 128'000 : 512'000;
  DiffuseErrors largest;
  for (const double turbidity : turbidities) {
    const DiffuseErrors errors = diffuse_errors(turbidity, elevations, paths, report);
    largest.add(errors);
  }
  report.add("sky_diffuse_illuminance_error_percent", largest.atmosphere);
  report.add("sky_diffuse_illuminance_error_percent_preetham", largest.preetham);
  report.add("sky_diffuse_illuminance_error_percent_of_scenes", largest.of_scene);
  report.add("sky_diffuse_illuminance_error_percent_of_scenes_by_the_mean_alone",
             largest.of_scene_without_orders);
  // Haze, where the tables are less exact.
  elevations = {-4, 0, 15, 90};
  if (!setup.is_quick) elevations = {-4, -2, 0, 2, 5, 10, 15, 25, 45, 60, 75, 90};
  report.add("sky_diffuse_illuminance_error_percent_turbidity_10",
             diffuse_errors(10.0, elevations, setup.is_quick ? 64'000 : 512'000, report).atmosphere);
}

/// Samples of the sky on the GPU.
struct GpuSamples {
  SkySamples of_formulas;      ///< of the models' own formulas, and of the C++ build beside them: channels
  SkySamples drawn, darkened;  ///< of the renderer's pictures, and of those of a model that is below zero
};

/// The sky of the GPU beside its C++ build; its samples are counted.
void measure_gpu(const BenchSetup& setup, GpuSamples& samples, Report& report) {
  constexpr double control_turbidity = 3.0, control_elevation_deg = 10.0;
  double maximum = 0.0, off_model = 0.0, of_formulas = 0.0;
  DrawnSky drawn_sky = DrawnSky::create();
  const auto dome = std::make_shared<const ImageF>(synthesis::sky_picture(512, city::to_sun(), 1));
  const std::vector<double> turbidities =
      setup.is_quick ? std::vector{3.0} : std::vector{1.0, 3.0, 10.0, 64.0};
  for (const double turbidity : turbidities)
    for (const double elevation :
         setup.is_quick ? std::vector{-3.0, 10.0} : std::vector{-4.0, -1.0, 0.0, 2.0, 10.0, 40.0, 90.0}) {
      for (const SkyKind kind : {SkyKind::atmosphere, SkyKind::preetham}) {
        const light::DrawnSkyError drawn = must(light::drawn_sky_error(kind, turbidity, elevation));
        maximum = worse(maximum, drawn.of_build), off_model = worse(off_model, drawn.of_model);
        const auto sky = must(light::make_sky(kind, light::Air{turbidity}, sun_at(elevation)));
        light::DayLight clouded;
        clouded.air = light::Air{turbidity}, clouded.dome = dome;
        for (const light::DayLight& day : {light::DayLight(), clouded}) {
          const SkySamples pixels = drawn_sky.samples(*sky, day);
          samples.drawn.all += pixels.all, samples.drawn.bad += pixels.bad;
        }
        report.note(fmt::format("{}, turbidity {}, sun at {} deg: {:.1e}, of the model {:.1e} in the mean",
                                light::sky_kind_names[std::size_t(kind)], turbidity, elevation,
                                drawn.of_build, drawn.of_model));
      }
      const light::SkyGpuCheck models = must(light::check_sky_on_gpu(light::Air{turbidity}, elevation));
      of_formulas = worse(of_formulas, models.max_relative_error);
      samples.of_formulas.all += models.samples, samples.of_formulas.bad += models.bad_samples;
    }
  const light::DrawnSkyError turned =
      must(light::drawn_sky_error(SkyKind::atmosphere, control_turbidity, control_elevation_deg, 1.0f));
  report.add("sky_gpu_cpu_relative", maximum);
  report.add("sky_gpu_cpu_relative_turned_by_a_degree", turned.of_build);
  report.add("sky_drawn_to_model_mean_relative", off_model);
  report.add("sky_drawn_to_model_mean_relative_turned_by_a_degree", turned.of_model);
  // Tables and models that are darker by more than the sky is bright: the figures must see it.
  constexpr float table_error = -1.0f, less_than_nothing = 1e4f;
  const light::SkyGpuCheck darker =
      must(light::check_sky_on_gpu(light::Air{control_turbidity}, control_elevation_deg, table_error));
  report.add("sky_model_gpu_cpu_relative", of_formulas);
  report.add("sky_model_gpu_cpu_relative_of_a_darker_table", darker.max_relative_error);
  report.add("sky_negative_samples_of_a_darker_table_of_the_gpu", double(darker.bad_samples));
  const auto control_sky = must(
      light::make_sky(SkyKind::atmosphere, light::Air{control_turbidity}, sun_at(control_elevation_deg)));
  const SkySamples darkened = drawn_sky.samples(DarkerSky(control_sky, less_than_nothing));
  samples.darkened = darkened;
}

}  // namespace

void measure_sky_update(const BenchSetup& setup, Report& report) {
  must(write_image(setup.folder / clouds_file, synthesis::sky_picture(clouds_px, city::to_sun(), 1)));
  PassingDay clear = PassingDay::open(setup, setup.folder / "clear.xp", ""),
             cloudy = PassingDay::open(setup, setup.folder / "cloudy.xp",
                                       fmt::format("skyDome(texture=\"{}\")\n", clouds_file));
  const auto clear_ms = clear.half_hours(), cloudy_ms = cloudy.half_hours();
  const double of_other_air = clear.change("turbidity 5"),
               with_clouds_of_other_air = cloudy.change("turbidity 5.5");
  report.add("sky_update_ms", median(clear_ms));
  report.add("sky_update_ms_of_another_air", of_other_air);
  report.add("sky_update_ms_with_clouds", median(cloudy_ms).value);
  report.add("sky_update_ms_with_clouds_of_another_air", with_clouds_of_other_air);
}

void measure_sky(const BenchSetup& setup, Report& report) {
  measure_sun(report);
  measure_brute_force(setup, report);
  const ModelSamples on_cpu = model_samples(setup.is_quick ? 400 : 4000);
  GpuSamples on_gpu;
  measure_gpu(setup, on_gpu, report);
  const SkySamples &of_models = on_cpu.shipped, &of_formulas = on_gpu.of_formulas, &drawn = on_gpu.drawn;
  report.add("sky_negative_samples", double(of_models.bad + of_formulas.bad + drawn.bad));
  report.add("sky_negative_samples_0.07_cd_less", double(on_cpu.darker.bad));
  report.add("sky_negative_samples_drawn_of_a_model_below_zero", double(on_gpu.darkened.bad));
}

}  // namespace parvis::bench
