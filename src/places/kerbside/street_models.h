// What stands in streets: generated models, each with its foot at the origin, x along the kerb, y away from
// the carriageway (for what stands on the right of it).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene/data/model.h"

namespace parvis::kerbside {

using Models = std::vector<std::shared_ptr<const scene::Model>>;

/// Trees of about 10,000 triangles, all of one height, each another shape.
Models street_trees(float height_m, std::uint64_t seed);

/// The cars of the paper's city, without its buses.
Models parked_cars();

/// A kind of street furniture.
struct FurnitureKind {
  std::string name;         ///< as the script calls it
  std::string object_name;  ///< of each piece; a number follows
  float spacing_m;          ///< as usual
  float beside_m;           ///< of the kerb, as usual
  float half_length_m;
  scene::Model (*make)();
};

/// Lamps, benches, bins and bollards.
const std::vector<FurnitureKind>& furniture_kinds();

}  // namespace parvis::kerbside
