#include "environment_maps/scene_maps.h"

#include "base/progress.h"
#include "environment_maps/map_cache.h"
#include "environment_maps/map_painter.h"
#include "environment_maps/placement.h"
#include "render/fixed_parts.h"

namespace parvis::environment_maps {
namespace {

/// Places wider than the heightfield's most cells get coarser ones.
void tell_if_coarse(const shading::Heightfield& heights, float wanted_m) {
  if (heights.cell_m() <= wanted_m) return;
  const glm::vec3 size = heights.bounds().size();
  const double megabytes = 4.0e-6 * double(size.x / wanted_m) * double(size.y / wanted_m);
  fmt::print(
      stderr,
      "warning: the place is {:.1f} x {:.1f} km: reflections know its heights in cells of {:.1f} m (cells "
      "of {} m would take {:.0f} MB); leave out far models for finer ones\n",
      1e-3f * size.x, 1e-3f * size.y, heights.cell_m(), wanted_m, megabytes);
}

/// Where shadows are to be sharp.
Camera camera_at(glm::vec3 place) {
  Camera camera;
  camera.world_from_camera = look_at(place, place - glm::vec3(0, 0, 1), {0, 1, 0});
  return camera;
}

ReferenceMaps compressed(const ReferenceMaps& maps) {
  ReferenceMaps small(maps.places(), maps.resolution(), true);
  for (std::size_t i = 0; i < maps.places().size(); ++i) small.copy(i, maps, i);
  return small;
}

}  // namespace

shading::Heightfield heights_of(const scene::Scene& scene, float cell_m, int most_cells_a_side) {
  Bounds bounds;
  const auto each_part = [&](auto&& visit) {
    render::for_each_fixed_opaque_part(
        scene, [&](const scene::Object& object, const scene::Part& part, const glm::mat4& world_from_mesh) {
          if (object.is_visible) visit(part.mesh, world_from_mesh);
        });
  };
  each_part([&](const Mesh& mesh, const glm::mat4& world_from_mesh) {
    bounds.add(transformed(world_from_mesh, mesh.bounds()));
  });
  shading::Heightfield heights(bounds, cell_m, most_cells_a_side);
  tell_if_coarse(heights, cell_m);
  each_part([&](const Mesh& mesh, const glm::mat4& world_from_mesh) { heights.add(mesh, world_from_mesh); });
  return heights;
}

std::vector<glm::vec3> map_places(const scene::Scene& scene, const HeightPyramid& heights) {
  const scene::ReferenceMapPlan& plan = scene.reference_maps;
  if (!plan.places.empty()) return plan.places;
  std::vector<glm::vec3> places =
      place_for_pictures(scene, heights, plan.most ? plan.most : scene.reflection.most_maps).places;
  if (places.empty()) places.emplace_back(0.0f, 0.0f, 1.5f);
  return places;
}

int map_resolution(const scene::Scene& scene) {
  const int resolution = scene.reference_maps.resolution;
  return resolution ? resolution : scene.reflection.resolution;
}

Result<ReferenceMaps> bake_maps(const scene::Scene& scene, const HeightPyramid& heights,
                                render::Renderer& renderer, Keep keep) {
  const int face_resolution = map_resolution(scene);
  Result<MapPainter> painter = MapPainter::create(face_resolution);
  if (!painter) return painter.errors();
  const MapCache cache(scene);
  if (keep == Keep::no) cache.tell_what_is_old();
  const std::optional<MapFile> first = cache.read(0);
  ReferenceMaps maps(first ? first->places : map_places(scene, heights),
                     ReferenceMaps::layer_side(face_resolution));

  Progress progress("reference maps", maps.places().size());
  for (std::size_t i = 0; i < maps.places().size(); ++i) {
    const std::optional<MapFile> kept = i == 0 ? first : cache.read(i);
    if (!kept || kept->places != maps.places() || !maps.write(i, kept->textures)) {
      renderer.begin_still_frame(scene, camera_at(maps.places()[i]));
      painter->paint(renderer, maps, i);
      if (keep == Keep::yes) {
        const MapFile file{0, maps.places(), std::uint32_t(i), std::uint32_t(maps.resolution()),
                           maps.read(i)};
        if (Status status = cache.write(file); !status) return status.errors();
      }
    }
    progress.advance();
  }
  maps.update_levels();
  return scene.reference_maps.is_compressed ? compressed(maps) : std::move(maps);
}

}  // namespace parvis::environment_maps
