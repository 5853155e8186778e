#include "formats/terrain/map_projection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "formats/terrain/proj_module.h"

namespace parvis::scene {

using glm::dvec2;

MapProjection MapProjection::utm(dvec2 place_deg) {
  const double turns = std::floor((place_deg.x + 180.0) / 360.0);  // beyond the date line
  const int zone = std::clamp(int(std::floor((place_deg.x - 360.0 * turns + 180.0) / 6.0)) + 1, 1, 60);
  const bool is_south = place_deg.y < 0.0;
  const Result<const ProjFunctions*> functions = proj.functions();
  return {fmt::format("EPSG:{}", (is_south ? 32700 : 32600) + zone),
          functions ? (*functions)->utm(zone, is_south) : nullptr};
}

std::optional<MapProjection> MapProjection::of(const std::string& system) {
  constexpr std::size_t longest = 100'000;
  if (system.empty() || system.size() > longest) return std::nullopt;
  const Result<const ProjFunctions*> functions = proj.functions();
  std::shared_ptr<const ProjectedMap> map = functions ? (*functions)->map(system) : nullptr;
  if (!map) return std::nullopt;
  return MapProjection(system, std::move(map));
}

dvec2 MapProjection::operator()(dvec2 place_deg) const {
  if (!map_) return dvec2(std::numeric_limits<double>::quiet_NaN());
  return map_->unit_m() * map_->forward(place_deg);
}

dvec2 MapProjection::degrees(dvec2 on_map_m) const {
  if (!map_) return dvec2(std::numeric_limits<double>::quiet_NaN());
  return map_->inverse(on_map_m / map_->unit_m());
}

double MapProjection::true_north_deg(dvec2 place_deg) const {
  constexpr double step_deg = 1e-4;  // some 10 m: the meridian is straight there
  const double north = std::min(place_deg.y + step_deg, 89.9999);
  const dvec2 along = (*this)({place_deg.x, north}) - (*this)({place_deg.x, north - 2.0 * step_deg});
  return std::isfinite(along.x + along.y) ? std::atan2(along.x, along.y) * 180.0 / std::numbers::pi : 0.0;
}

}  // namespace parvis::scene
