// Which parts of a car's pictures are glass and lamps, as masks of the node `material`.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "places/car_bodies/surface_samples.h"

namespace parvis::car_bodies {

/// A mask of a picture: all conditions that are given hold.
struct PictureMask {
  std::optional<Bounds> box = {};        ///< u and v, 0 to 1; z is 0
  std::optional<glm::vec3> colour = {};  ///< sRGB
  bool is_grey = false;
  float tolerance = 0.0f;  ///< of the colour or the grey, largest difference of a channel

  /// The text that the attribute `mask` takes: "box 0.1 0.2 0.3 0.4 grey 0.085".
  std::string text() const;
  /// Whether the triangle's middle lies in it.
  bool holds(const SurfaceSample& sample) const;
};

/// Masks of one picture.
struct PictureMasks {
  std::vector<PictureMask> glass;  ///< one per pane or row of panes
  std::vector<PictureMask> lamps;  ///< rear lamps, front lamps
};

/// The colour that covers most of the car's sides, sRGB.
glm::vec3 paint_of(std::span<const SurfaceSample> samples);

/// Panes are grey or pale blue, not of the paint's kind, in the upper half and do not face up; or they are
/// holes in a picture. Bumpers and aerofoils may have such triangles, too: what they belong to says that it
/// is none.
bool is_pane(const SurfaceSample& sample, glm::vec3 paint);
/// Whether a surface whose highest point is at this fraction of the car's height can be a pane: these lie on
/// the cabin and reach up to its roof. Bumpers, grilles and aerofoils on boots end below.
bool reaches_roof(float top);
/// Lamps are red at the rear and yellow at the front, where the paint is not.
bool is_lamp(const SurfaceSample& sample, glm::vec3 paint);

/// The panes and lamps in `picture`, that the material of `samples` has. Regions of less than a fiftieth of
/// `all_panes_m2`, which the whole car has, are seals and shadows. Those that do not reach up to the roof,
/// and those whose colour lies for the most part below where panes begin, are bumpers and trim.
PictureMasks find_masks(const Image8& picture, std::span<const SurfaceSample> samples, glm::vec3 paint,
                        float all_panes_m2);

}  // namespace parvis::car_bodies
