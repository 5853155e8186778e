#include "formats/terrain/proj_module.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "formats/terrain/proj_objects.h"

namespace parvis::scene {
namespace {

constexpr double radians_per_degree = std::numbers::pi / 180.0;

struct Axis {
  std::string direction;
  double unit = 1.0;  ///< in metres or radians
};

std::optional<Axis> axis_of(PJ_CONTEXT* context, const PJ* system, int index) {
  const ProjObject axes(proj_crs_get_coordinate_system(context, system));
  if (!axes || index >= proj_cs_get_axis_count(context, axes.get())) return std::nullopt;
  const char* direction = nullptr;
  Axis axis;
  if (!proj_cs_get_axis_info(context, axes.get(), index, nullptr, nullptr, &direction, &axis.unit, nullptr,
                             nullptr, nullptr) ||
      !direction)
    return std::nullopt;
  axis.direction = direction;
  return axis;
}

ProjObject system_of(PJ_CONTEXT* context, int epsg) {
  return ProjObject(proj_create_from_database(context, "EPSG", fmt::format("{}", epsg).c_str(),
                                              PJ_CATEGORY_CRS, 0, nullptr));
}

std::optional<double> height_unit_m(PJ_CONTEXT* context, const PJ* system, const PJ* plan) {
  const ProjObject heights(proj_crs_get_sub_crs(context, system, 1));  // of a compound system
  const std::optional<Axis> axis = heights ? axis_of(context, heights.get(), 0) : axis_of(context, plan, 2);
  return axis && axis->unit > 0.0 ? std::optional(axis->unit) : std::nullopt;
}

std::optional<MapSystem> system_by_number(int epsg) {
  const ProjContext context = quiet_context();
  const ProjObject system = system_of(context.get(), epsg);
  const ProjObject plan = plan_of(context.get(), system_of(context.get(), epsg));
  if (!system || !plan) return std::nullopt;
  const std::optional<Axis> first = axis_of(context.get(), plan.get(), 0),
                            second = axis_of(context.get(), plan.get(), 1);
  const PJ_TYPE type = proj_get_type(plan.get());
  const bool is_geographic = type == PJ_TYPE_GEOGRAPHIC_2D_CRS || type == PJ_TYPE_GEOGRAPHIC_3D_CRS;
  if (!first || !second || !(first->unit > 0.0)) return std::nullopt;
  if (!is_geographic && type != PJ_TYPE_PROJECTED_CRS) return std::nullopt;
  if (is_geographic && std::abs(first->unit / radians_per_degree - 1.0) > 1e-6) return std::nullopt;
  MapSystem found;
  found.name = proj_get_name(system.get());
  found.is_geographic = is_geographic;
  found.is_north_first = first->direction == "north";
  found.plan_unit_m = is_geographic ? 1.0 : first->unit;
  found.height_unit_m = height_unit_m(context.get(), system.get(), plan.get());
  return found;
}

std::optional<glm::dvec2> place_of(int epsg, glm::dvec2 on_map) {
  const ProjContext context = quiet_context();
  constexpr int wgs_84 = 4326;
  const ProjObject map = plan_of(context.get(), system_of(context.get(), epsg));
  const ProjObject earth = system_of(context.get(), wgs_84);
  if (!map || !earth) return std::nullopt;
  const ProjObject as_defined(
      proj_create_crs_to_crs_from_pj(context.get(), map.get(), earth.get(), nullptr, nullptr));
  if (!as_defined) return std::nullopt;
  const ProjObject east_first(proj_normalize_for_visualization(context.get(), as_defined.get()));
  if (!east_first) return std::nullopt;
  const PJ_COORD there = proj_trans(east_first.get(), PJ_FWD, proj_coord(on_map.x, on_map.y, 0.0, 0.0));
  const glm::dvec2 deg(there.xy.x, there.xy.y);
  const bool is_on_earth = std::abs(deg.x) <= 180.0 && std::abs(deg.y) <= 90.0;
  return is_on_earth ? std::optional(deg) : std::nullopt;
}

bool is_in_area(int epsg, glm::dvec2 on_map) {
  constexpr double margin_deg = 1.0;
  const std::optional<glm::dvec2> deg = place_of(epsg, on_map);
  const ProjContext context = quiet_context();
  const ProjObject map = system_of(context.get(), epsg);
  double west = 0.0, south = 0.0, east = 0.0, north = 0.0;
  if (!deg || !map || !proj_get_area_of_use(context.get(), map.get(), &west, &south, &east, &north, nullptr))
    return false;
  const bool is_between = west <= east ? deg->x > west - margin_deg && deg->x < east + margin_deg
                                       : deg->x > west - margin_deg || deg->x < east + margin_deg;
  return is_between && deg->y > south - margin_deg && deg->y < north + margin_deg;
}

}  // namespace
}  // namespace parvis::scene

PARVIS_MODULE(parvis::scene::ProjFunctions){parvis::scene::system_by_number, parvis::scene::is_in_area,
                                            parvis::scene::place_of, parvis::scene::utm_map,
                                            parvis::scene::map_of_system};
