#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>

#include "formats/terrain/proj_module.h"
#include "formats/terrain/proj_objects.h"

namespace parvis::scene {

using glm::dvec2;

namespace {

class MapOfProj final : public ProjectedMap {
 public:
  ProjContext context = quiet_context();
  ProjObject map;  ///< from degrees, or radians where PROJ wants these, to the map's unit, east first
  double metres_per_unit = 1.0;

  dvec2 forward(dvec2 deg) const override { return through(PJ_FWD, deg); }
  dvec2 inverse(dvec2 in_unit) const override { return through(PJ_INV, in_unit); }
  double unit_m() const override { return metres_per_unit; }

 private:
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

std::shared_ptr<const ProjectedMap> utm_map(int zone, bool is_south) {
  const auto utm = std::make_shared<MapOfProj>();
  utm->map.reset(
      proj_create(utm->context.get(),
                  fmt::format("+proj=utm +zone={} {}+ellps=WGS84", zone, is_south ? "+south " : "").c_str()));
  return utm;
}

std::shared_ptr<const ProjectedMap> map_of_system(const std::string& system) {
  const auto made = std::make_shared<MapOfProj>();
  PJ_CONTEXT* const context = made->context.get();
  const ProjObject plan = plan_of(context, ProjObject(proj_create(context, system.c_str())));
  const std::optional<double> unit_m = unit_m_of(context, plan.get());
  const ProjObject earth(proj_create(context, "EPSG:4326"));
  if (!unit_m || !earth) return nullptr;
  const ProjObject as_defined(
      proj_create_crs_to_crs_from_pj(context, earth.get(), plan.get(), nullptr, nullptr));
  if (!as_defined) return nullptr;
  made->map.reset(proj_normalize_for_visualization(context, as_defined.get()));
  made->metres_per_unit = *unit_m;
  return made->map ? made : nullptr;
}

}  // namespace parvis::scene
