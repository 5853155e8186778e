// The triangles of a car with the colour that they have at their middle.
#pragma once

#include <vector>

#include "places/car_bodies/body.h"

namespace parvis::car_bodies {

/// A triangle; lengths in metres in the frame of the car.
struct SurfaceSample {
  std::size_t part = 0;
  std::uint32_t triangle = 0;
  glm::vec3 centre{0.0f};
  glm::vec3 normal{
      0.0f};  ///< away from the car's middle, whatever the file's winding; 0 where it has no area
  float area_m2 = 0.0f;
  float height = 0.0f;        ///< of its middle, as a fraction of the car's
  float top = 0.0f;           ///< height of its highest corner, likewise
  float forward = 0.0f;       ///< of its middle: -0.5 at the rear bumper to 0.5 at the front bumper
  glm::vec2 uv{0.0f};         ///< of its middle, in the picture: 0 to 1, as masks have it
  glm::vec2 corner_uvs[3]{};  ///< about `uv`, beyond 0 to 1 where the picture repeats within the triangle
  glm::vec3 srgb{0.0f};       ///< of the picture, times the material's colour; or of the material alone
  bool has_picture = false;
  bool is_hole = false;   ///< the picture's alpha, or the material's, lets one see through
  bool is_outer = false;  ///< seen from outside the car
};

/// One for each triangle, in the order of parts and triangles.
std::vector<SurfaceSample> samples_of(const Body& body);

/// The largest difference between the channels of a colour: 0 is grey.
float spread(glm::vec3 srgb);

}  // namespace parvis::car_bodies
