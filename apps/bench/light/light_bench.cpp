#include "bench/light/light_bench.h"

#include "bench/benches.h"
#include "bench/light/bounced_bench.h"
#include "bench/light/lit_object_bench.h"
#include "bench/light/night_bench.h"
#include "bench/light/relighting_bench.h"
#include "bench/light/shadow_bench.h"
#include "bench/light/shadow_time_bench.h"
#include "bench/light/sky_bench.h"
#include "bench/light/sky_update_bench.h"
#include "bench/light/sun_hours_bench.h"
#include "bench/scratch_folder.h"
#include "bench/vegetation/vegetation_bench.h"
#include "graphics/gl/context.h"
#include "places/paper_city/paper_city.h"
#include "scene/script/scene_loader.h"

namespace parvis::bench {
namespace {

Result<scene::LoadedScene> load_city(const BenchSetup& setup) {
  const ScratchFolder folder;
  if (Status written = city::write_paper_city(folder.path, 1); !written) return written.errors();
  return scene::load_scene(folder.path / "paper_day.xp", setup.house.get<scene::NodeRegistry>());
}

/// Says on which machine, and measures.
Status with_context(const std::function<Status()>& measure, Report& report) {
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  report.note("machine: " + gl::driver_name());
  return measure();
}

/// Measures each, whatever has become of those before: hours of figures are not lost by one that fails. Fails
/// with the errors of all.
Status each_of(const std::vector<std::function<Status()>>& measures) {
  Errors errors;
  for (const std::function<Status()>& measure : measures)
    if (const Status status = measure(); !status)
      errors.insert(errors.end(), status.errors().begin(), status.errors().end());
  if (!errors.empty()) return errors;
  return Done{};
}

using MeasureCity = std::function<Status(const BenchSetup&, const scene::Scene&, Report&)>;

Status measure_city(const BenchSetup& setup, Report& report, std::initializer_list<MeasureCity> measures) {
  const Result<scene::LoadedScene> loaded = load_city(setup);
  if (!loaded) return loaded.errors();
  std::vector<std::function<Status()>> of_city;
  of_city.reserve(measures.size());
  for (const MeasureCity& measure : measures)
    of_city.push_back([&, measure] { return measure(setup, loaded->scene, report); });
  return each_of(of_city);
}

/// The keys relight_*.
Status relight(const BenchSetup& setup, Report& report) {
  return each_of(
      {[&] { return measure_relighting(setup, report); }, [&] { return measure_lit_object(setup, report); }});
}

/// One of the parts that measure the city, as a bench by itself.
Bench part_of_city(std::string name, std::string summary, MeasureCity measure) {
  return {std::move(name), std::move(summary), [measure](const BenchSetup& setup, Report& report) {
            return with_context([&] { return measure_city(setup, report, {measure}); }, report);
          }};
}

/// The keys sky_*.
Status sky(const BenchSetup& setup, Report& report) {
  return each_of(
      {[&] { return measure_sky(setup, report); }, [&] { return measure_sky_update(setup, report); }});
}

Status measure_all(const BenchSetup& setup, Report& report) {
  return each_of({[&] { return sky(setup, report); }, [&] { return relight(setup, report); },
                  [&] {
                    return measure_city(
                        setup, report,
                        {measure_bounced_light, measure_night, measure_sun_hours, measure_shadows});
                  },
                  [&] { return measure_vegetation(setup, report); }});
}

Status measure_sun_and_sky(const BenchSetup& setup, Report& report) {
  return each_of(
      {[&] { return sky(setup, report); }, [&] { return measure_city(setup, report, {measure_sun_hours}); }});
}

}  // namespace

void add_light(Benches& benches) {
  benches.add(part_of_city("shadows", "shadows of each method against exact ones", measure_shadows));
  benches.add({"relighting", "light at the vertices of moved objects", relight});
  benches.add(part_of_city("shadow_times", "exact shadows of a picture beside its shadow maps",
                           [](const BenchSetup&, const scene::Scene& city, Report& report) {
                             return measure_shadow_times(city, report);
                           }));
  benches.add(part_of_city("bounced_light", "pictures with bounced light against photographs",
                           measure_bounced_light));
  benches.add(part_of_city("night", "pictures in the light of lamps against photographs", measure_night));
  benches.add({"sun_and_sky", "sun, sky and hours of sun against their ground truths",
               [](const BenchSetup& setup, Report& report) {
                 return with_context([&] { return measure_sun_and_sky(setup, report); }, report);
               }});
  benches.add({"light", "sun, sky, shadows and hours of sun against their ground truths",
               [](const BenchSetup& setup, Report& report) {
                 return with_context([&] { return measure_all(setup, report); }, report);
               }});
}

}  // namespace parvis::bench
