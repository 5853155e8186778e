#include "reflections/reference_maps/bake_step.h"

#include "base/image_io.h"
#include "reflections/reference_maps/map_cache.h"
#include "reflections/reference_maps/placement.h"
#include "reflections/reference_maps/placement_plan.h"
#include "reflections/reference_maps/scene_maps.h"

namespace parvis::reference_maps {
namespace {

constexpr double megabyte = 1e-6;
constexpr int plan_side_px = 1200;

}  // namespace

Result<render::Baked> bake_and_plan(render::BakeInput& input) {
  const scene::Scene& scene = input.scene();
  const Result<render::Renderer*> renderer = input.renderer();
  if (!renderer) return renderer.errors();
  const HeightPyramid heights(heights_of(scene));
  const Result<std::vector<glm::vec3>> places = keep_maps(scene, heights, **renderer, input.processes());
  if (!places) return places.errors();
  if (!input.plan().empty() && input.processes().is_first()) {
    const std::vector<glm::vec3> even = spread_over_roads(scene, heights, int(places->size()));
    if (Status status =
            write_image(input.plan(), placement_plan(**renderer, scene, *places, even, plan_side_px));
        !status)
      return status.errors();
  }
  const int side = ReferenceMaps::layer_side(map_resolution(scene));
  const std::size_t bytes =
      places->size() * ReferenceMaps::bytes_per_map(side, map_plan(scene).is_compressed);
  const std::filesystem::path folder = MapCache(scene).folder();
  return render::Baked{{folder},
                       fmt::format("{} reference maps of {} x {} texels, {:.1f} MB of graphics memory: {}",
                                   places->size(), side, side, megabyte * double(bytes), folder.string())};
}

}  // namespace parvis::reference_maps
