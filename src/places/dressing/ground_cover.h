// What lies on the ground of city models: paving, gravel, lawn, asphalt; and trees where the model has only
// green spikes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/data/model.h"

namespace parvis::dressing {

/// Names of what `add_ground_cover` lays.
const std::vector<std::string>& ground_covers();

/// Adds the material of one of ground_covers() to a model and returns its index.
int add_cover_material(scene::Model& model, std::string_view cover);
/// Side of the square that a sheet of this cover's pictures shows, metres.
float cover_sheet_m(std::string_view cover);

/// Lays one of ground_covers() on the parts that match the pattern `target`, seen from above. The material
/// that later nodes can change has the cover's name. Returns the number of parts changed.
std::size_t add_ground_cover(scene::Model& model, std::string_view target, std::string_view cover);

/// Green that was measured from the air stands in a model as ground pulled up to the tops of trees. Lowers
/// what rises steeply above its neighbourhood back to the ground, lays a lawn, and plants a tree of that
/// height at each top. Returns the number of trees.
std::size_t add_greenery(scene::Model& model, std::string_view target, std::uint64_t seed);

}  // namespace parvis::dressing
