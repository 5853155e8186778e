#include "formats/ifc/ifc_georeference.h"

#include <fmt/format.h>
#include <ifcpp/IFC4/include/IfcCompoundPlaneAngleMeasure.h>
#include <ifcpp/IFC4/include/IfcConversionBasedUnit.h>
#include <ifcpp/IFC4/include/IfcCoordinateReferenceSystem.h>
#include <ifcpp/IFC4/include/IfcDirection.h>
#include <ifcpp/IFC4/include/IfcGeometricRepresentationContext.h>
#include <ifcpp/IFC4/include/IfcLabel.h>
#include <ifcpp/IFC4/include/IfcLengthMeasure.h>
#include <ifcpp/IFC4/include/IfcMapConversion.h>
#include <ifcpp/IFC4/include/IfcNamedUnit.h>
#include <ifcpp/IFC4/include/IfcProjectedCRS.h>
#include <ifcpp/IFC4/include/IfcReal.h>
#include <ifcpp/IFC4/include/IfcSIPrefix.h>
#include <ifcpp/IFC4/include/IfcSIUnit.h>
#include <ifcpp/IFC4/include/IfcSite.h>
#include <ifcpp/model/BuildingModel.h>
#include <ifcpp/model/UnitConverter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cwctype>

#include "formats/ifc/ifc_text.h"
#include "formats/terrain/map_projection.h"
#include "formats/terrain/map_system.h"

namespace parvis::scene {
namespace {

constexpr double farthest_m = 2e7;  // of a place on a map from the map's origin: half round the earth
// Coordinates on maps are hundreds of kilometres: less than `near_m` in the project's unit, but far in
// metres, they are metres, whatever the project is drawn in.
constexpr double near_m = 20'000.0, far_m = 100'000.0;

template <class Measure>
double value_of(const std::shared_ptr<Measure>& measure, double otherwise) {
  return measure && std::isfinite(measure->m_value) ? measure->m_value : otherwise;
}

/// Metres per unit of the map; nothing where the file does not say.
std::optional<double> map_unit_m(const IfcMapConversion& conversion) {
  const auto* crs = dynamic_cast<const IfcProjectedCRS*>(conversion.m_TargetCRS.get());
  if (!crs) return std::nullopt;
  if (const auto* si = dynamic_cast<const IfcSIUnit*>(crs->m_MapUnit.get())) {
    if (!si->m_Prefix) return 1.0;
    switch (si->m_Prefix->m_enum) {
      case IfcSIPrefix::ENUM_MILLI:
        return 1e-3;
      case IfcSIPrefix::ENUM_CENTI:
        return 1e-2;
      case IfcSIPrefix::ENUM_KILO:
        return 1e3;
      default:
        return std::nullopt;
    }
  }
  const auto* named = dynamic_cast<const IfcConversionBasedUnit*>(crs->m_MapUnit.get());
  if (!named || !named->m_Name) return std::nullopt;
  std::wstring name = named->m_Name->m_value;
  std::ranges::transform(name, name.begin(),
                         [](wchar_t c) { return wchar_t(std::towupper(std::wint_t(c))); });
  constexpr double foot_m = 0.3048, us_survey_foot_m = 1200.0 / 3937.0;
  if (name.find(L"FOOT") == std::wstring::npos && name.find(L"FEET") == std::wstring::npos)
    return std::nullopt;
  return name.find(L"SURVEY") != std::wstring::npos ? us_survey_foot_m : foot_m;
}

void place_on_map(const IfcMapConversion& conversion, double project_unit_m, IfcGeoreference& place) {
  const glm::dvec3 given(value_of(conversion.m_Eastings, 0.0), value_of(conversion.m_Northings, 0.0),
                         value_of(conversion.m_OrthogonalHeight, 0.0));
  const double reach = std::max(std::abs(given.x), std::abs(given.y));
  double unit_m = map_unit_m(conversion).value_or(project_unit_m);
  if (reach * unit_m < near_m && reach >= far_m) unit_m = 1.0;
  const glm::dvec2 axis(value_of(conversion.m_XAxisAbscissa, 1.0), value_of(conversion.m_XAxisOrdinate, 0.0));
  if (!(reach * unit_m < farthest_m) || !(std::abs(given.z) * unit_m < farthest_m)) return;
  place.origin = unit_m * given;
  if (conversion.m_TargetCRS && conversion.m_TargetCRS->m_Name)
    if (const auto epsg = epsg_in(utf8(conversion.m_TargetCRS->m_Name->m_value)))
      place.map = fmt::format("EPSG:{}", *epsg);
  // Not by glm::length, whose squares overflow for axes that are finite.
  const double length = std::hypot(axis.x, axis.y);
  if (length > 0.0 && std::isfinite(length)) place.x_axis = axis / length;
}

/// Degrees, minutes, seconds and their millionths, all of one sign; nothing where they are none.
std::optional<double> degrees_of(const std::shared_ptr<IfcCompoundPlaneAngleMeasure>& angle) {
  if (!angle || angle->m_vec.size() < 3 || angle->m_vec.size() > 4) return std::nullopt;
  constexpr std::array parts_per_degree{1.0, 60.0, 3600.0, 3.6e9};
  double degrees = 0.0;
  for (std::size_t i = 0; i < angle->m_vec.size(); ++i) degrees += angle->m_vec[i] / parts_per_degree[i];
  return degrees;
}

std::optional<glm::dvec2> place_of(const IfcSite& site) {
  const std::optional<double> north = degrees_of(site.m_RefLatitude), east = degrees_of(site.m_RefLongitude);
  if (!north || !east || std::abs(*north) > 90.0 || std::abs(*east) > 180.0) return std::nullopt;
  if (*north == 0.0 && *east == 0.0) return std::nullopt;  // that nobody has filled in
  return glm::dvec2(*east, *north);
}

/// Where the file's x axis lies on a map whose north is the direction `north` of the file.
std::optional<glm::dvec2> x_axis_for(const IfcDirection& north) {
  if (north.m_DirectionRatios.size() < 2) return std::nullopt;
  const glm::dvec2 direction(value_of(north.m_DirectionRatios[0], 0.0),
                             value_of(north.m_DirectionRatios[1], 0.0));
  const double length = std::hypot(direction.x, direction.y);
  if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
  return glm::dvec2(direction.y, direction.x) / length;
}

}  // namespace

IfcGeoreference georeference_of(BuildingModel& building) {
  IfcGeoreference place;
  const double project_unit_m = building.getUnitConverter()->getLengthInMeterFactor();
  bool has_map = false;
  std::optional<glm::dvec2> north_up;
  for (const auto& [id, entity] : building.getMapIfcEntities()) {
    const auto* conversion = dynamic_cast<const IfcMapConversion*>(entity.get());
    if (conversion && !has_map) place_on_map(*conversion, project_unit_m, place), has_map = true;
    const auto* context = dynamic_cast<const IfcGeometricRepresentationContext*>(entity.get());
    if (context && context->m_TrueNorth && !north_up) north_up = x_axis_for(*context->m_TrueNorth);
    const auto* site = dynamic_cast<const IfcSite*>(entity.get());
    if (site && !place.place_deg) place.place_deg = place_of(*site);
  }
  if (!has_map && north_up) place.x_axis = *north_up;
  const std::optional<MapProjection> map = MapProjection::of(place.map);
  const glm::dvec2 deg = map ? map->degrees(place.origin) : glm::dvec2(std::nan(""));
  if (std::isfinite(deg.x + deg.y)) {
    place.true_north_deg = map->true_north_deg(deg);
    if (!place.place_deg) place.place_deg = deg;
  } else {
    place.map.clear();
  }
  return place;
}

}  // namespace parvis::scene
