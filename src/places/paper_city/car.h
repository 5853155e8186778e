// The city's vehicles: saloon, hatchback, van and bus, each of about 10,000 triangles.
#pragma once

#include <vector>

#include "places/paper_city/car_shape.h"
#include "scene/data/model.h"

namespace parvis::city {

struct CarPaint {
  const char* name;
  glm::vec3 colour{0.5f};  ///< linear
  float metallic = 0.0f;   ///< flakes under the clear coat
};

/// x forward, y left, z up, the ground at z = 0. Wheels are nodes named "wheel_front_left" and so on, with
/// their origin in the hub; a soft shadow lies on the ground below.
scene::Model make_car(const CarShape& shape, const CarPaint& paint);

/// The materials of make_car in another paint, in the same order.
std::vector<scene::Material> car_materials(const CarPaint& paint);

/// A kind of vehicle, and the colours in which it drives in the city.
struct VehicleKind {
  CarShape shape;
  std::vector<CarPaint> paints;
};

/// Saloon, hatchback, van and bus: the most frequent first.
std::vector<VehicleKind> city_vehicles();

/// One of each kind of vehicle and colour that drives in the city, named "saloon_white" and so on.
std::vector<scene::Model> city_cars();

}  // namespace parvis::city
