// A glTF file made small for browsers: meshes in the order in which a GPU reads them, quantised and
// compressed (EXT_meshopt_compression, KHR_mesh_quantization).
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

namespace parvis::scene {

/// Packs the meshes of a file: `json` describes it, with all data of its accessors in `bytes`, its one
/// buffer. Afterwards the accessors that no mesh uses are empty ones; animations and skins are not supported.
/// Positions keep 20 bits of the largest coordinate of a vertex (0.5 mm at 500 m), texture coordinates 16,
/// normals 8 bits per octahedral coordinate, colours 16 bits each.
void pack_meshes(nlohmann::json& json, std::vector<std::uint8_t>& bytes);

}  // namespace parvis::scene
