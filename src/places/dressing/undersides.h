// Undersides of what hangs in the air: of bridges between houses, of what juts out, of passages.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <unordered_map>
#include <vector>

#include "places/dressing/wall_panels.h"
#include "scene/data/model.h"

namespace parvis::dressing {

/// The surfaces of a model that are called OuterCeilingSurface, by cells of the plan.
class Undersides {
 public:
  explicit Undersides(const scene::Model& model);

  /// True if the house behind the panel has an underside at the height of the panel's foot: it hangs in the
  /// air, and nobody goes in there.
  bool begin_at(const WallPanel& panel) const;

 private:
  using Triangle = std::array<glm::vec3, 3>;

  void add(const Triangle& triangle);

  std::vector<Triangle> triangles_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace parvis::dressing
