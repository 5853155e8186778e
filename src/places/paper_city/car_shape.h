// The shapes of the city's vehicles as tables: sections of the body, regions of materials, and wheels.
// Metres; x forward, y left, z up, the road at z = 0.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace parvis::city {

/// One column of the body's control net, from the sill to the middle of the roof. Bonnet and boot lie between
/// `belt` and `top` like the roof: where there is no cabin, these are low.
struct BodySection {
  float x = 0.0f, x_belt = 0.0f, x_top = 0.0f;  ///< of the side, of the foot of the windows, of the roof
  float half_width = 0.0f, half_belt = 0.0f, half_top = 0.0f;
  float sill = 0.0f, shoulder = 0.0f, belt = 0.0f, edge = 0.0f,
        top = 0.0f;  ///< heights; edge: of the roof's side
};

/// Materials of a vehicle's body.
enum class CarSurface : std::uint8_t { paint, glass, black, chrome, lamp, tail_lamp, indicator, count };

/// A rectangle in the parameters of the body's surface (columns and rows of its net) with its material. Later
/// rectangles cover earlier ones.
struct BodyRegion {
  float u0 = 0.0f, u1 = 0.0f, v0 = 0.0f, v1 = 0.0f;
  CarSurface surface = CarSurface::paint;
};

/// A vehicle's dimensions, metres.
struct CarShape {
  std::string name;
  std::vector<BodySection> sections;
  std::vector<BodyRegion> regions;
  float front_axle_x = 1.3f, rear_axle_x = -1.3f;
  float wheel_radius = 0.32f, wheel_width = 0.2f, half_track = 0.77f;
  float arch_radius = 0.38f;
  int wheel_segments = 28;                                    ///< round a tyre and a rim
  bool has_round_tyre_shoulders = true;                       ///< else tyres have half as many triangles
  glm::vec3 mirror{0.0f}, mirror_radii{0.1f, 0.11f, 0.075f};  ///< of the left one
  float plate_height = 0.45f;
};

CarShape saloon_shape();     ///< four-door car with a boot
CarShape hatchback_shape();  ///< small car with a tailgate
CarShape van_shape();        ///< delivery van
CarShape bus_shape();        ///< city bus

}  // namespace parvis::city
