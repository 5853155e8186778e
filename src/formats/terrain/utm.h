// Degrees on the earth to metres on a map: the zones of the universal transverse Mercator projection (WGS
// 84), through PROJ. Scale is within 0.04 %, north within 3 degrees of the meridian.
#pragma once

#include <glm/glm.hpp>
#include <memory>

namespace parvis::scene {

class Utm {
 public:
  /// The zone of a place (degrees: east, north).
  explicit Utm(glm::dvec2 place_deg);

  /// Easting and northing in metres (southern ones from 10,000 km); not finite where there are none.
  glm::dvec2 operator()(glm::dvec2 place_deg) const;
  /// EPSG's number of the zone.
  int epsg() const;

 private:
  struct Projection;
  std::shared_ptr<const Projection> projection_;
  int zone_;
  bool is_south_;
};

}  // namespace parvis::scene
