// The trunk of a captured tree as geometry: a stack of discs with what the photographs show of its bark.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "base/sealed_file.h"
#include "scene/data/model.h"

namespace parvis::trees {

/// A trunk as a stack of discs, from the foot upward.
struct Trunk {
  /// A horizontal disc of the trunk.
  struct Ring {
    glm::vec3 centre{0.0f};  ///< metres
    float radius_m = 0.0f;
  };
  std::vector<Ring> rings;  ///< ascending; empty where no trunk was found

  /// True within the trunk.
  bool contains(glm::vec3 point) const;
  /// The trunk's axis and radius at a height between its first and its last ring.
  Ring ring_at(float z) const;
};

/// A trunk with its bark.
struct TrunkShape {
  Trunk trunk;  ///< two rings or more
  Image8 bark;  ///< RGBA, sRGB: once round from the east, counter-clockwise, from the top to the foot
};

/// The trunk as a mesh whose texture is `bark`. In the frame of the photographs' cameras.
scene::Model model_of(const TrunkShape& shape);

/// Appends a trunk to the content of a file: its rings, and its bark in blocks (texture_blocks.h).
void append_trunk(std::string& content, const TrunkShape& shape);
/// Takes it out of the content of a file, checked; the error says what is wrong with it.
Result<TrunkShape> take_trunk(ByteReader& reader);

}  // namespace parvis::trees
