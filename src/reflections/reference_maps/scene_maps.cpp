#include "reflections/reference_maps/scene_maps.h"

#include <algorithm>
#include <cmath>

#include "base/progress.h"
#include "base/sealed_file.h"
#include "graphics/render/fixed_parts.h"
#include "machines/divided_work.h"
#include "reflections/reference_maps/placement.h"
#include "reflections/reference_maps/settings.h"

namespace parvis::reference_maps {
namespace {

constexpr double max_heights = double(1 << 26);  // cells: 256 MB, and a third more for the levels above
constexpr double max_heights_per_side = 16384;   // what OpenGL 4.5 promises of textures

/// Cells per side of the finest level, whose sides are powers of two.
glm::dvec2 cells_per_side(glm::vec2 size_m, float cell_m) {
  const glm::dvec2 cells = glm::floor(glm::dvec2(size_m) / double(cell_m)) + 1.0;
  return glm::exp2(glm::ceil(glm::log2(cells)));
}

void tell_if_coarse(glm::vec2 size_m, float cell_m, float wanted_m) {
  if (cell_m <= wanted_m) return;
  const auto megabytes = [&](float cell) {
    const glm::dvec2 cells = cells_per_side(size_m, cell);
    return 4e-6 * cells.x * cells.y;
  };
  fmt::print(stderr,
             "warning: the place is {:.1f} x {:.1f} km: its heights in cells of {} m would take {:.0f} MB of "
             "memory; reflections know them in cells of {:.3g} m ({:.0f} MB). Leave out far models for finer "
             "ones, or ask for these: referenceMaps(cell={:.3g})\n",
             1e-3f * size_m.x, 1e-3f * size_m.y, wanted_m, megabytes(wanted_m), cell_m, megabytes(cell_m),
             cell_m);
}

}  // namespace

Camera camera_at(glm::vec3 place) {
  Camera camera;
  camera.world_from_camera = look_at(place, place - glm::vec3(0, 0, 1), {0, 1, 0});
  return camera;
}

float fitting_cell_m(glm::vec2 size_m, float wanted_m) {
  constexpr float step = 1.01f;
  const auto fits = [&](float cell_m) {
    const glm::dvec2 cells = cells_per_side(size_m, cell_m);
    return std::max(cells.x, cells.y) <= max_heights_per_side && cells.x * cells.y <= max_heights;
  };
  float cell_m = wanted_m;
  while (!fits(cell_m) && std::isfinite(cell_m)) cell_m *= step;
  return cell_m;
}

shading::Heightfield heights_of(const scene::Scene& scene) {
  const Bounds bounds = render::bounds_of_fixed_parts(scene, false);
  const glm::vec2 size_m = bounds.empty() ? glm::vec2(0.0f) : glm::vec2(bounds.size());
  const float wanted_m = map_plan(scene).cell_m, cell_m = fitting_cell_m(size_m, wanted_m);
  tell_if_coarse(size_m, cell_m, wanted_m);
  shading::Heightfield heights(bounds, cell_m, int(max_heights_per_side));
  render::add_fixed_parts(scene, heights);
  return heights;
}

std::vector<glm::vec3> map_places(const scene::Scene& scene, const HeightPyramid& heights) {
  const ReferenceMapPlan& plan = map_plan(scene);
  if (!plan.places.empty()) return plan.places;
  std::vector<glm::vec3> places = place_for_pictures(scene, heights, max_maps(scene)).places;
  if (places.empty()) places.push_back(place_without_ground);
  return places;
}

std::vector<glm::vec3> places_of(const scene::Scene& scene, const HeightPyramid& heights,
                                 const MapCache& cache) {
  std::optional<std::vector<glm::vec3>> kept = cache.places();
  return kept ? *std::move(kept) : map_places(scene, heights);
}

Result<ReferenceMaps> drawn_map(const scene::Scene& scene, render::Renderer& renderer, MapPainter& painter,
                                glm::vec3 place) {
  Result<ReferenceMaps> drawn =
      ReferenceMaps::create({place}, ReferenceMaps::layer_side(map_resolution(scene)));
  if (!drawn) return drawn.errors();
  renderer.begin_still_frame(scene, camera_at(place));
  painter.paint(renderer, *drawn, 0);
  drawn->update_levels();
  return drawn;
}

std::optional<ReferenceMaps> baked_map(const MapCache& cache, std::size_t number,
                                       std::span<const glm::vec3> places, int resolution) {
  const std::optional<MapFile> file = cache.read(number);
  if (!file || !std::ranges::equal(file->places, places)) return std::nullopt;
  Result<ReferenceMaps> read = ReferenceMaps::create({places[number]}, resolution);
  if (!read || !read->write(0, file->textures)) return std::nullopt;
  read->update_levels();
  return *std::move(read);
}

Result<ReferenceMaps> bake_maps(const scene::Scene& scene, const HeightPyramid& heights,
                                render::Renderer& renderer) {
  Result<MapPainter> painter = MapPainter::create(map_resolution(scene));
  if (!painter) return painter.errors();
  const MapCache cache(scene);
  cache.report_other_states();
  Result<ReferenceMaps> maps =
      ReferenceMaps::create(places_of(scene, heights, cache),
                            ReferenceMaps::layer_side(map_resolution(scene)), map_plan(scene).is_compressed);
  if (!maps) return maps.errors();
  Progress progress("reference maps", maps->places().size());
  for (std::size_t i = 0; i < maps->places().size(); ++i) {
    if (const auto kept = baked_map(cache, i, maps->places(), maps->resolution())) {
      maps->copy(i, *kept, 0);
    } else {
      const Result<ReferenceMaps> drawn = drawn_map(scene, renderer, *painter, maps->places()[i]);
      if (!drawn) return drawn.errors();
      maps->copy(i, *drawn, 0);
    }
    progress.advance();
  }
  return maps;
}

namespace {

/// Where the maps are: the first process finds out and shares it.
std::vector<glm::vec3> shared_places(const scene::Scene& scene, const HeightPyramid& heights,
                                     const MapCache& cache, const machines::Processes& processes) {
  std::string bytes;
  if (processes.is_first()) append_values(bytes, places_of(scene, heights, cache));
  processes.share_of_first(bytes);
  return ByteReader(bytes).take_values<glm::vec3>();
}

/// The numbers of the maps that are not kept.
machines::Tasks maps_to_draw(const MapCache& cache, const std::vector<glm::vec3>& places) {
  machines::Tasks numbers;
  for (std::uint32_t i = 0; i < places.size(); ++i)
    if (const std::optional<MapFile> kept = cache.read(i); !kept || kept->places != places)
      numbers.push_back(i);
  return numbers;
}

}  // namespace

Result<std::vector<glm::vec3>> keep_maps(const scene::Scene& scene, const HeightPyramid& heights,
                                         render::Renderer& renderer, const machines::Processes& processes) {
  Result<MapPainter> painter = MapPainter::create(map_resolution(scene));
  if (!painter) return painter.errors();
  const MapCache cache(scene);
  const std::vector<glm::vec3> places = shared_places(scene, heights, cache, processes);
  const machines::Tasks to_do = processes.is_first() ? maps_to_draw(cache, places) : machines::Tasks();
  Progress progress("reference maps", to_do.size());
  machines::DividedWork work;
  work.uses_threads = false;
  work.run = [&](std::uint32_t number) -> Result<std::string> {
    const Result<ReferenceMaps> drawn = drawn_map(scene, renderer, *painter, places[number]);
    if (!drawn) return drawn.errors();
    std::string bytes;
    const std::vector<std::vector<std::uint8_t>> textures = drawn->read(0);
    append_value(bytes, std::uint32_t(drawn->resolution()));
    append_value(bytes, std::uint32_t(textures.size()));
    for (const std::vector<std::uint8_t>& texture : textures) append_values(bytes, texture);
    return bytes;
  };
  work.keep = [&](std::uint32_t number, std::string_view bytes) -> Status {
    ByteReader reader(bytes);
    MapFile file{places, number, reader.take<std::uint32_t>(), {}};
    file.textures.resize(reader.take<std::uint32_t>());
    for (std::vector<std::uint8_t>& texture : file.textures) texture = reader.take_values<std::uint8_t>();
    progress.advance();
    return cache.write(file);
  };
  if (const Result<std::size_t> kept = machines::divide(processes, to_do, work); !kept) return kept.errors();
  return places;
}

}  // namespace parvis::reference_maps
