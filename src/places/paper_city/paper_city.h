// The city of the paper's section 7 as a scene that can be opened: 1 km2, 8 roads, buildings of 25,600
// triangles, 8 trees of 59,100 triangles each, 500,000 in all, and traffic.
#pragma once

#include <cstdint>
#include <filesystem>

#include "base/result.h"
#include "scene/data/model.h"

namespace parvis::city {

inline constexpr std::size_t city_triangles = 500000;

/// Everything that stands still but the trees, with its materials.
scene::Model make_city_model(std::uint64_t seed);

/// Writes the script `paper.xp`, models, textures and sky into `folder`, which is made where it is missing.
/// The same seed gives the same bytes. The files appear together or, when one of them cannot be written, not
/// at all.
Status write_paper_city(const std::filesystem::path& folder, std::uint64_t seed);

}  // namespace parvis::city
