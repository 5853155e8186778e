// Depth maps of lamps, by rays.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "graphics/reference/ray_scene.h"
#include "graphics/shading/lamps.h"

namespace parvis::lamps {

/// Texels of a map: lamp_map_px squared.
inline constexpr std::size_t map_texels =
    std::size_t(shading::lamp_map_px) * std::size_t(shading::lamp_map_px);

/// Fills the map of a lamp: how far it sees static things in each direction, as LampTable::depths has it.
/// What lies within the lamp is passed.
void trace_map(const scene::Scene& scene, const reference::RayScene& rays, const shading::Lamp& lamp,
               std::span<std::uint16_t> depths);

}  // namespace parvis::lamps
