// What every method of this room starts from: a scene's heights, and its reference maps.
#pragma once

#include "machines/processes.h"
#include "reflections/reference_maps/height_pyramid.h"
#include "reflections/reference_maps/map_cache.h"
#include "reflections/reference_maps/map_painter.h"
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

/// Place of the only map of a scene in which no place offers itself.
inline constexpr glm::vec3 place_without_ground{0.0f, 0.0f, 1.5f};

/// Where the scene's reference maps are taken: where the script says, else where they show most; one place at
/// least.
std::vector<glm::vec3> map_places(const scene::Scene& scene, const HeightPyramid& heights);

/// The same as far as they are baked: their places are known without computing them.
std::vector<glm::vec3> places_of(const scene::Scene& scene, const HeightPyramid& heights,
                                 const MapCache& cache);

/// A view from a reference map's place, about which shadows are to be sharp.
Camera camera_at(glm::vec3 place);

/// One map, as it is drawn now, with all its levels: in the light of a frame of its own, which it begins.
/// Errors: the driver has no memory for it.
Result<ReferenceMaps> drawn_map(const scene::Scene& scene, render::Renderer& renderer, MapPainter& painter,
                                glm::vec3 place);

/// A baked map with all its levels, the only one of its ReferenceMaps. None: it is not baked, or unfit, which
/// is reported on standard error.
std::optional<ReferenceMaps> baked_map(const MapCache& cache, std::size_t number,
                                       std::span<const glm::vec3> places, int resolution);

/// The scene's reference maps: those that are baked are read, the others drawn. Unfit baked ones are reported
/// on standard error. Errors: a shader; more maps than ReferenceMaps holds.
Result<ReferenceMaps> bake_maps(const scene::Scene& scene, const HeightPyramid& heights,
                                render::Renderer& renderer);

/// Draws the scene's reference maps that are not baked and keeps each beside the scene; one is in memory at a
/// time. `processes` draw them together, and the first one keeps them. Returns the places of all maps.
/// Errors: a shader; a map cannot be kept.
Result<std::vector<glm::vec3>> keep_maps(const scene::Scene& scene, const HeightPyramid& heights,
                                         render::Renderer& renderer,
                                         const machines::Processes& processes = {});

}  // namespace parvis::reference_maps
