#include "formats/terrain/map_projection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "formats/terrain/proj_objects.h"

namespace parvis::scene {

using glm::dvec2;

struct MapProjection::Projection {
  ProjContext context = quiet_context();
  ProjObject map;  ///< from degrees, or radians where PROJ wants these, to the map's unit, east first
  double unit_m = 1.0;

  dvec2 through(PJ_DIRECTION direction, dvec2 from) const {
    const dvec2 nowhere(std::numeric_limits<double>::quiet_NaN());
    if (!map || !std::isfinite(from.x + from.y)) return nowhere;
    const bool takes_radians = direction == PJ_FWD && proj_angular_input(map.get(), PJ_FWD);
    if (takes_radians) from = glm::radians(from);
    const PJ_COORD there = proj_trans(map.get(), direction, proj_coord(from.x, from.y, 0.0, 0.0));
    dvec2 to(there.xy.x, there.xy.y);
    if (direction == PJ_INV && proj_angular_output(map.get(), PJ_INV)) to = glm::degrees(to);
    return std::isfinite(to.x + to.y) ? to : nowhere;
  }
};

namespace {

/// Metres per unit of a projected system; nothing for others.
std::optional<double> unit_m_of(PJ_CONTEXT* context, const PJ* system) {
  if (!system || proj_get_type(system) != PJ_TYPE_PROJECTED_CRS) return std::nullopt;
  const ProjObject axes(proj_crs_get_coordinate_system(context, system));
  double unit_m = 0.0;
  if (!axes || !proj_cs_get_axis_info(context, axes.get(), 0, nullptr, nullptr, nullptr, &unit_m, nullptr,
                                      nullptr, nullptr))
    return std::nullopt;
  return unit_m > 0.0 ? std::optional(unit_m) : std::nullopt;
}

}  // namespace

MapProjection MapProjection::utm(dvec2 place_deg) {
  const double turns = std::floor((place_deg.x + 180.0) / 360.0);  // beyond the date line
  const int zone = std::clamp(int(std::floor((place_deg.x - 360.0 * turns + 180.0) / 6.0)) + 1, 1, 60);
  const bool is_south = place_deg.y < 0.0;
  const auto projection = std::make_shared<Projection>();
  projection->map.reset(
      proj_create(projection->context.get(),
                  fmt::format("+proj=utm +zone={} {}+ellps=WGS84", zone, is_south ? "+south " : "").c_str()));
  return {fmt::format("EPSG:{}", (is_south ? 32700 : 32600) + zone), projection};
}

std::optional<MapProjection> MapProjection::of(const std::string& system) {
  constexpr std::size_t longest = 100'000;
  if (system.empty() || system.size() > longest) return std::nullopt;
  const auto projection = std::make_shared<Projection>();
  PJ_CONTEXT* const context = projection->context.get();
  const ProjObject plan = plan_of(context, ProjObject(proj_create(context, system.c_str())));
  const std::optional<double> unit_m = unit_m_of(context, plan.get());
  const ProjObject earth(proj_create(context, "EPSG:4326"));
  if (!unit_m || !earth) return std::nullopt;
  const ProjObject as_defined(
      proj_create_crs_to_crs_from_pj(context, earth.get(), plan.get(), nullptr, nullptr));
  if (!as_defined) return std::nullopt;
  projection->map.reset(proj_normalize_for_visualization(context, as_defined.get()));
  projection->unit_m = *unit_m;
  if (!projection->map) return std::nullopt;
  return MapProjection(system, projection);
}

dvec2 MapProjection::operator()(dvec2 place_deg) const {
  return projection_->unit_m * projection_->through(PJ_FWD, place_deg);
}

dvec2 MapProjection::degrees(dvec2 on_map_m) const {
  return projection_->through(PJ_INV, on_map_m / projection_->unit_m);
}

double MapProjection::true_north_deg(dvec2 place_deg) const {
  constexpr double step_deg = 1e-4;  // some 10 m: the meridian is straight there
  const double north = std::min(place_deg.y + step_deg, 89.9999);
  const dvec2 along = (*this)({place_deg.x, north}) - (*this)({place_deg.x, north - 2.0 * step_deg});
  return std::isfinite(along.x + along.y) ? std::atan2(along.x, along.y) * 180.0 / std::numbers::pi : 0.0;
}

}  // namespace parvis::scene
