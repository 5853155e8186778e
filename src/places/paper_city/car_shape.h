// The shapes of the city's vehicles as tables: sections of the body, what its surface is made of where, and
// its wheels. Metres; x forward, y left, z up, the road at z = 0.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace parvis::city {

/// One column of the body's control net, from the sill up to the middle of the roof. Bonnet and boot lie
/// between `belt` and `top` like the roof does: where there is no cabin, these are low.
struct BodySection {
  float x = 0.0f, x_belt = 0.0f, x_top = 0.0f;  ///< of the side, of the foot of the windows, of the roof
  float half_width = 0.0f, half_belt = 0.0f, half_top = 0.0f;
  float sill = 0.0f, shoulder = 0.0f, belt = 0.0f, edge = 0.0f,
        top = 0.0f;  ///< heights; edge: of the roof's side
};

enum class CarSurface : std::uint8_t { paint, glass, black, chrome, lamp, tail_lamp, indicator, count };

/// A rectangle of the body's parameters, in columns and rows of its net, with what it is made of. Later ones
/// cover earlier ones.
struct BodyRegion {
  float u0 = 0.0f, u1 = 0.0f, v0 = 0.0f, v1 = 0.0f;
  CarSurface surface = CarSurface::paint;
};

struct CarShape {
  std::string name;
  std::vector<BodySection> sections;
  std::vector<BodyRegion> regions;
  float front_axle_x = 1.3f, rear_axle_x = -1.3f;
  float wheel_radius = 0.32f, wheel_width = 0.2f, half_track = 0.77f;
  float arch_radius = 0.38f;
  glm::vec3 mirror{0.0f}, mirror_radii{0.1f, 0.11f, 0.075f};  ///< of the left one
  float plate_height = 0.45f;
};

CarShape saloon_shape();
CarShape hatchback_shape();
CarShape van_shape();
CarShape bus_shape();

}  // namespace parvis::city
