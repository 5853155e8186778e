// Terrain: a grid of heights as a Model, in tiles that are culled one by one.
#pragma once

#include <filesystem>
#include <optional>

#include "base/result.h"
#include "scene/data/model.h"

namespace parvis::scene {

/// Reads a GeoTIFF as read_height_grid says. Holes stay open. `Model::origin` says where on the map it is.
Result<Model> read_terrain(const std::filesystem::path& file, std::optional<double> cell_m, Errors& warnings);

}  // namespace parvis::scene
