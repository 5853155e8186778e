// Which triangles of a model get a material: real cars come with one material and one picture, so that glass
// and paint can only be told apart by where in the picture a triangle lies, or by the colour it has there.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/result.h"
#include "scene/data/model.h"

namespace parvis::scene {

/// Holds for triangles for which every condition that is given holds.
struct MaterialMask {
  struct Box {
    glm::vec2 min, max;  ///< texture space: 0..1, v down from the picture's top
  };
  struct Colour {
    glm::vec3 srgb;   ///< 0..1
    float tolerance;  ///< largest difference of a channel
  };
  std::optional<Box> box;
  std::optional<Colour> colour;
  std::optional<float> grey;  ///< largest difference between the channels of a colour that is still grey
};

/// Reads "object" (all triangles), "box u0 v0 u1 v1", "colour #RRGGBB [tolerance]", or a box and a colour
/// together.
Result<MaterialMask> parse_mask(std::string_view text, const FileLocation& where);

/// The triangle's centroid lies in the mask: in texture space, and by the colour that its material has there.
bool lies_in(const MaterialMask& mask, const Model& model, const Part& part, std::size_t triangle);

/// A copy of `picture` (sRGB) in which the texels that lie in one of `masks` have the linear colour `colour`
/// and are opaque.
Image8 painted(const Image8& picture, std::span<const MaterialMask> masks, glm::vec3 colour);

}  // namespace parvis::scene
