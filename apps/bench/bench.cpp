#include "bench/bench.h"

#include <algorithm>

#include "base/progress.h"
#include "graphics/gl/context.h"
#include "graphics/reference/metrics.h"
#include "places/paper_city/paper_city.h"

namespace parvis::bench {
namespace fs = std::filesystem;

fs::path BenchSetup::city() const {
  const fs::path place = folder / "city";
  if (!fs::exists(place / "paper.xp")) must(city::write_paper_city(place, 1));
  return place;
}

scene::Scene BenchSetup::scene(const fs::path& script, std::span<const fs::path> data_folders) const {
  return must(scene::load_scene(script, rooms::node_registry(), data_folders)).scene;
}

stage::Simulation BenchSetup::simulation(const fs::path& script,
                                         std::span<const fs::path> data_folders) const {
  return must(stage::open_simulation(rooms::all_registries(), script, data_folders));
}

std::unique_ptr<stage::Stage> stage_of(stage::Simulation simulation) {
  return must(stage::Stage::create(std::move(simulation)));
}

std::unique_ptr<stage::Stage> stage_of(const scene::Scene& scene) {
  return stage_of(stage::make_simulation(rooms::all_registries(), scene));
}

std::unique_ptr<render::Renderer> renderer_of(const scene::Scene& scene) {
  return must(render::Renderer::create(scene, rooms::drawables(),
                                       rooms::all_registries().get<render::Lights>().make));
}

double flip_between(const Image8& picture, const Image8& expected, const Image8& mask) {
  return must(reference::compare(picture, expected, mask)).flip;
}

std::vector<const Part*> parts_named(const std::string& name) {
  std::vector<const Part*> found;
  for (const Part& part : all_parts())
    if (name == part.bench && !part.when_named) found.push_back(&part);
  if (!found.empty()) return found;
  for (const Part& part : all_parts())
    if (name == part.name || name == fmt::format("{}_{}", part.bench, part.name) ||
        name == fmt::format("{}/{}", part.bench, part.name))
      found.push_back(&part);
  return found;
}

Status run_parts(const BenchSetup& setup, std::span<const Part* const> parts, Report& report) {
  Errors errors;
  const auto failed = [&errors](const Errors& more) {
    errors.insert(errors.end(), more.begin(), more.end());
  };
  Progress progress("parts of the bench", parts.size());
  for (const Part* part : parts) {
    try {
      std::optional<gl::Context> context;
      if (part->needs_gl) {
        context.emplace(must(gl::Context::create_headless()));
        report.set_machine(gl::driver_name());
      }
      part->measure(setup, report);
    } catch (const Failed& failure) {
      failed(failure.errors);
    }
    progress.advance();
  }
  if (const Status controls = report.controls(); !controls) failed(controls.errors());
  if (!errors.empty()) return errors;
  return Ok{};
}

}  // namespace parvis::bench
