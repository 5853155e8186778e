// What the surfaces of a car are made of: paint, panes, lamps, and what stays as its file has it.
#pragma once

#include <vector>

#include "places/car_bodies/own_wheels.h"
#include "places/car_bodies/picture_masks.h"

namespace parvis::car_bodies {

/// A preset of the node `material`, or none.
enum class Finish : unsigned char { paint, glass, lamp, chrome, rubber, plastic, as_in_file };

/// The parts of a model that share a material and a finish.
struct BodySurface {
  int material = 0;
  Finish finish = Finish::as_in_file;
  std::vector<std::size_t> parts;
  PictureMasks masks = {};    ///< of paint: what in its picture is none
  bool sees_through = false;  ///< in the file
};

/// Materials that let light through, are called after panes or have a pane's colour and place are glass;
/// likewise lamps. Where a material has several uses, its parts are looked at one by one, and what has
/// paint's colour is divided by masks. What covers little, has another colour, or lies inside, stays as it
/// is; so do wheels with materials of their own.
std::vector<BodySurface> surfaces_of(const Body& body, const std::vector<SurfaceSample>& samples,
                                     const std::vector<OwnWheel>& wheels);

}  // namespace parvis::car_bodies
