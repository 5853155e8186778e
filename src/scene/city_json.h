// CityJSON 0.2 to 2.0: buildings, terrain, roads and the rest as one model, in metres about a local origin
// that is kept.
#pragma once

#include <filesystem>

#include "base/result.h"
#include "scene/model.h"

namespace parvis::scene {

/// Parts by tile, name and material; Model::origin keeps where the origin lies. Materials are named after the
/// semantics
/// ("WallSurface"), and so are objects; roads' names add what they are for ("Road voetpad"), as streets()
/// asks. Takes the highest level of detail of each object. Surfaces without semantics are named after their
/// object's type, those of buildings by their slope. Objects without polygons are named in `warnings`; a file
/// without any, an unknown version and an index out of range are errors.
Result<Model> read_city_model(const std::filesystem::path& file, Errors& warnings);

}  // namespace parvis::scene
