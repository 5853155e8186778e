// What every method of this room starts from: a scene's heights, and its reference maps.
#pragma once

#include "reflections/reference_maps/height_pyramid.h"
#include "reflections/reference_maps/reference_maps.h"
#include "reflections/reference_maps/settings.h"
#include "scene/data/scene.h"

namespace parvis::reference_maps {

/// The highest opaque, visible, static point over each cell of the ground.
/// Cells are as wide as the scene wants them, and wider (with a warning) where these would take more memory
/// than heights may have.
shading::Heightfield heights_of(const scene::Scene& scene);

/// Width of the cells that a place of so many metres gets where `wanted_m` are wanted.
float fitting_cell_m(glm::vec2 size_m, float wanted_m);

/// Where the scene's reference maps are taken: where the script says, else where they show most; one place at
/// least.
std::vector<glm::vec3> map_places(const scene::Scene& scene, const HeightPyramid& heights);

/// The scene's reference maps as far as they are baked.
struct BakedMaps {
  ReferenceMaps maps;
  std::vector<std::size_t> missing = {};  ///< numbers of the maps that hold nothing yet
};

/// Reads what is baked; places without a baked map are computed. Unfit maps are reported on standard error.
BakedMaps read_baked_maps(const scene::Scene& scene, const HeightPyramid& heights);

/// A view from a reference map's place, about which shadows are to be sharp.
Camera camera_at(glm::vec3 place);

/// Maps that are drawn are kept beside the scene, too.
enum class Keep : bool { no, yes };

/// The scene's reference maps: those that are baked are read, the others drawn; begins a frame for the light.
/// Unfit baked ones are reported on standard error. Fails if a shader does, or if a map cannot be kept.
Result<ReferenceMaps> bake_maps(const scene::Scene& scene, const HeightPyramid& heights,
                                render::Renderer& renderer, Keep keep = Keep::no);

}  // namespace parvis::reference_maps
