// What stands in streets: generated models, each with its foot at the origin, x along the kerb, y away from
// the carriageway (for what stands on the right of it).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene/data/model.h"

namespace parvis::kerbside {

/// A model in one of its paints.
struct StreetModel {
  std::shared_ptr<const scene::Model> model;
  std::shared_ptr<const std::vector<scene::Material>> paint = nullptr;  ///< null: the model's own
};
using StreetModels = std::vector<StreetModel>;

/// Trees of about 10,000 triangles, all of one height, each another shape.
StreetModels street_trees(float height_m, std::uint64_t seed);

/// The cars of the paper's city, without its buses, for so many places: one body for up to twenty of them,
/// all three for more than forty, each in all of its paints. Cars of one body share its model.
StreetModels parked_cars(std::size_t places);

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
