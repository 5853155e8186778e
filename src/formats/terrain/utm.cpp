#include "formats/terrain/utm.h"

#include <fmt/format.h>
#include <proj.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace parvis::scene {

struct Utm::Projection {
  PJ_CONTEXT* context = proj_context_create();
  PJ* map = nullptr;

  explicit Projection(const std::string& definition) : map(proj_create(context, definition.c_str())) {}
  Projection(const Projection&) = delete;
  ~Projection() {
    proj_destroy(map);
    proj_context_destroy(context);
  }
};

Utm::Utm(glm::dvec2 place_deg)
    : zone_(std::clamp(int(std::floor((place_deg.x + 180.0) / 6.0)) + 1, 1, 60)),
      is_south_(place_deg.y < 0.0) {
  projection_ = std::make_shared<const Projection>(
      fmt::format("+proj=utm +zone={} {}+ellps=WGS84", zone_, is_south_ ? "+south " : ""));
}

glm::dvec2 Utm::operator()(glm::dvec2 place_deg) const {
  const glm::dvec2 nowhere(std::numeric_limits<double>::quiet_NaN());
  if (!projection_->map) return nowhere;
  const PJ_COORD there = proj_trans(projection_->map, PJ_FWD,
                                    proj_coord(proj_torad(place_deg.x), proj_torad(place_deg.y), 0.0, 0.0));
  return std::isfinite(there.xy.x) ? glm::dvec2(there.xy.x, there.xy.y) : nowhere;
}

int Utm::epsg() const { return (is_south_ ? 32700 : 32600) + zone_; }

}  // namespace parvis::scene
