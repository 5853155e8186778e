#include "bench/light/sky_update_bench.h"

#include <filesystem>
#include <memory>
#include <vector>

#include "base/files.h"
#include "base/image_io.h"
#include "bench/scratch_folder.h"
#include "graphics/render/fixed_parts.h"
#include "graphics/render/light_source.h"
#include "house/stage/stage.h"
#include "places/paper_city/paper_script.h"
#include "places/paper_city/sky_picture.h"

namespace parvis::bench {
namespace {

/// The project's own: what the issue allows bounced light, which follows the sky in the same frame.
constexpr Target of_update = {50.0, false};
constexpr double frame_s = 1.0 / 30.0;
constexpr int updates = 11;
constexpr const char* clouds_file = "sky.hdr";
constexpr int clouds_px = 2048;  // across, as those of the paper's city

/// A running scene of nothing but its sky, and the light of the renderer that shows it. Shadow maps and
/// bounced light, which follow a new sun too, have keys of their own.
class PassingDay {
 public:
  /// `more`: nodes beside dayLight. Fails as house::open_play, or if a shader does.
  static Result<PassingDay> open(const BenchSetup& setup, const std::filesystem::path& script,
                                 const std::string& more) {
    if (Status status = write_file(script, "dayLight(timeOfDay=8)\n" + more); !status) return status.errors();
    Result<house::Play> play = house::open_play(setup.house, script, {});
    if (!play) return play.errors();
    auto light = setup.house.get<render::Lights>().make(play->scene,
                                                        render::bounds_of_fixed_parts(play->scene, false));
    if (!light) return light.errors();
    return PassingDay(*std::move(play), *std::move(light));
  }

  /// The frame in which dayLight has received a message: how long its sky takes. Fails where the message
  /// does, and where the sky that is shown is the same as before.
  Result<double> change(const std::string& message) {
    const auto before = light_->sky().irradiance_sh;
    if (Status status = play_.clock.send("%dayLight", message); !status) return status.errors();
    glFinish();
    const double ms = milliseconds([&] {
      play_.advance(frame_s);
      light_->update(play_.scene);
      glFinish();
    });
    if (light_->sky().irradiance_sh == before) return error("\"{}\" has not changed the sky", message);
    return ms;
  }
  /// From each half hour to the next.
  Result<std::vector<double>> half_hours() {
    std::vector<double> all_ms;
    all_ms.reserve(updates);
    for (int i = 1; i <= updates; ++i) {
      const Result<double> ms = change(fmt::format("timeOfDay {}", 8.0 + 0.5 * double(i)));
      if (!ms) return ms.errors();
      all_ms.push_back(*ms);
    }
    return all_ms;
  }

 private:
  PassingDay(house::Play play, std::unique_ptr<render::LightSource> light)
      : play_(std::move(play)), light_(std::move(light)) {}

  house::Play play_;
  std::unique_ptr<render::LightSource> light_;
};

}  // namespace

Status measure_sky_update(const BenchSetup& setup, Report& report) {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder.path);
  if (Status status = write_image(folder.path / clouds_file, city::sky_picture(clouds_px, city::to_sun(), 1));
      !status)
    return status;
  Result<PassingDay> clear = PassingDay::open(setup, folder.path / "clear.xp", ""),
                     cloudy = PassingDay::open(setup, folder.path / "cloudy.xp",
                                               fmt::format("skyDome(texture=\"{}\")\n", clouds_file));
  if (!clear) return clear.errors();
  if (!cloudy) return cloudy.errors();
  const auto clear_ms = clear->half_hours(), cloudy_ms = cloudy->half_hours();
  if (!clear_ms) return clear_ms.errors();
  if (!cloudy_ms) return cloudy_ms.errors();
  const Result<double> of_other_air = clear->change("turbidity 5"),
                       with_clouds_of_other_air = cloudy->change("turbidity 5.5");
  if (!of_other_air) return of_other_air.errors();
  if (!with_clouds_of_other_air) return with_clouds_of_other_air.errors();
  const Median update = median(*clear_ms);
  report.add("sky_update_ms", update.value, of_update);
  report.add_control("sky_update_ms_of_another_air", *of_other_air, of_update);
  report.add("sky_update_ms_with_clouds", median(*cloudy_ms).value, of_update);
  report.add_control("sky_update_ms_with_clouds_of_another_air", *with_clouds_of_other_air, of_update);
  report.note(fmt::format(
      "95 % interval {:.1f} to {:.1f} ms, from half an hour to the next, by a message to dayLight: its "
      "table, its picture, their blurred levels and their way to the GPU; the target is the project's own; "
      "control: another turbidity, for which the light that air scatters is computed from the beginning; "
      "clouds: those of a photograph {} pixels wide",
      update.low, update.high, clouds_px));
  return Done{};
}

}  // namespace parvis::bench
