// Terrain: a grid of heights as a Model, in tiles that are culled one by one.
#pragma once

#include <filesystem>
#include <optional>

#include "base/result.h"
#include "scene/data/file_account.h"
#include "scene/data/model.h"

namespace parvis::scene {

/// Reads a GeoTIFF as read_height_grid says. Holes stay open. `Model::origin` says where on the map it is.
/// `place_deg` is filled with the middle (degrees: east, north) where the file says it.
Result<Model> read_terrain(const std::filesystem::path& file, std::optional<double> cell_m, Errors& warnings,
                           std::optional<glm::dvec2>* place_deg = nullptr, const std::string& map = {},
                           FileAccount* account = nullptr);

}  // namespace parvis::scene
