#include "formats/ifc/ifc_georeference.h"

#include <fmt/format.h>
#include <ifcpp/IFC4/include/IfcCompoundPlaneAngleMeasure.h>
#include <ifcpp/IFC4/include/IfcConversionBasedUnit.h>
#include <ifcpp/IFC4/include/IfcCoordinateReferenceSystem.h>
#include <ifcpp/IFC4/include/IfcDirection.h>
#include <ifcpp/IFC4/include/IfcGeometricRepresentationContext.h>
#include <ifcpp/IFC4/include/IfcIdentifier.h>
#include <ifcpp/IFC4/include/IfcLabel.h>
#include <ifcpp/IFC4/include/IfcLengthMeasure.h>
#include <ifcpp/IFC4/include/IfcMapConversion.h>
#include <ifcpp/IFC4/include/IfcNamedUnit.h>
#include <ifcpp/IFC4/include/IfcProjectedCRS.h>
#include <ifcpp/IFC4/include/IfcPropertySet.h>
#include <ifcpp/IFC4/include/IfcPropertySingleValue.h>
#include <ifcpp/IFC4/include/IfcReal.h>
#include <ifcpp/IFC4/include/IfcSIPrefix.h>
#include <ifcpp/IFC4/include/IfcSIUnit.h>
#include <ifcpp/IFC4/include/IfcSite.h>
#include <ifcpp/IFC4/include/IfcText.h>
#include <ifcpp/IFC4/include/IfcValue.h>
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

/// Values of a conversion to a map, in the units of the file.
struct MapValues {
  glm::dvec3 origin{0.0};  ///< eastings, northings, height
  glm::dvec2 axis{1.0, 0.0};
  double scale = 0.0;              ///< 0: not given
  std::optional<double> unit_m{};  ///< of the map, where the file says so
  std::string system{};
};

MapValues values_of(const IfcMapConversion& conversion) {
  MapValues values{{value_of(conversion.m_Eastings, 0.0), value_of(conversion.m_Northings, 0.0),
                    value_of(conversion.m_OrthogonalHeight, 0.0)},
                   {value_of(conversion.m_XAxisAbscissa, 1.0), value_of(conversion.m_XAxisOrdinate, 0.0)},
                   value_of(conversion.m_Scale, 0.0),
                   map_unit_m(conversion)};
  if (conversion.m_TargetCRS && conversion.m_TargetCRS->m_Name)
    values.system = utf8(conversion.m_TargetCRS->m_Name->m_value);
  return values;
}

/// Takes over what a property set of IFC 2x3 says in place of the entities that only IFC 4 has
/// (buildingSMART: User guide for geo-referencing in IFC); false of any other set.
bool take_property_set(const IfcPropertySet& set, MapValues& values) {
  const std::wstring name = set.m_Name ? set.m_Name->m_value : L"";
  const bool is_conversion = name == L"ePSet_MapConversion", is_system = name == L"ePSet_ProjectedCRS";
  if (!is_conversion && !is_system) return false;
  for (const auto& property : set.m_HasProperties) {
    const auto* single = dynamic_cast<const IfcPropertySingleValue*>(property.get());
    if (!single || !single->m_Name) continue;
    const std::wstring& key = single->m_Name->m_value;
    const IfcValue* value = single->m_NominalValue.get();
    if (const auto* label = dynamic_cast<const IfcLabel*>(value); label && is_system && key == L"Name")
      values.system = utf8(label->m_value);
    if (const auto* text = dynamic_cast<const IfcText*>(value); text && is_system && key == L"Name")
      values.system = utf8(text->m_value);
    std::optional<double> number;
    if (const auto* length = dynamic_cast<const IfcLengthMeasure*>(value)) number = length->m_value;
    if (const auto* real = dynamic_cast<const IfcReal*>(value)) number = real->m_value;
    if (!number || !std::isfinite(*number)) continue;
    if (key == L"Eastings") values.origin.x = *number;
    if (key == L"Northings") values.origin.y = *number;
    if (key == L"OrthogonalHeight") values.origin.z = *number;
    if (key == L"XAxisAbscissa") values.axis.x = *number;
    if (key == L"XAxisOrdinate") values.axis.y = *number;
    if (key == L"Scale") values.scale = *number;
  }
  return is_conversion;
}

void place_on_map(const MapValues& values, double project_unit_m, IfcGeoreference& place,
                  FileAccount& account) {
  const glm::dvec3 given = values.origin;
  const double reach = std::max(std::abs(given.x), std::abs(given.y));
  double unit_m = values.unit_m.value_or(project_unit_m);
  if (reach * unit_m < near_m && reach >= far_m) unit_m = 1.0;
  const glm::dvec2 axis = values.axis;
  if (!(reach * unit_m < farthest_m) || !(std::abs(given.z) * unit_m < farthest_m)) {
    account.left_out("places on maps", "farther than half round the earth", values.system);
    return;
  }
  place.origin = unit_m * given;
  if (const auto epsg = epsg_in(values.system)) place.map = fmt::format("EPSG:{}", *epsg);
  // Between a project's units and a map's it is their ratio.
  constexpr double max_difference = 1e-7;
  const double ratio = values.scale * unit_m / project_unit_m;
  if (values.scale > 0.0 && std::abs(ratio - 1.0) > max_difference &&
      std::abs(values.scale - 1.0) > max_difference)
    account.changed("scales of maps", fmt::format("{} is not applied: lengths stay true", values.scale));
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

IfcGeoreference georeference_of(BuildingModel& building, FileAccount& account) {
  IfcGeoreference place;
  MapValues of_properties;
  bool has_properties = false;
  const double project_unit_m = building.getUnitConverter()->getLengthInMeterFactor();
  bool has_map = false;
  std::optional<glm::dvec2> north_up;
  for (const auto& [id, entity] : building.getMapIfcEntities()) {
    const auto* conversion = dynamic_cast<const IfcMapConversion*>(entity.get());
    if (conversion && !has_map)
      place_on_map(values_of(*conversion), project_unit_m, place, account), has_map = true;
    if (const auto* set = dynamic_cast<const IfcPropertySet*>(entity.get()))
      has_properties = take_property_set(*set, of_properties) || has_properties;
    const auto* context = dynamic_cast<const IfcGeometricRepresentationContext*>(entity.get());
    if (context && context->m_TrueNorth && !north_up) north_up = x_axis_for(*context->m_TrueNorth);
    const auto* site = dynamic_cast<const IfcSite*>(entity.get());
    if (site && !place.place_deg) place.place_deg = place_of(*site);
  }
  if (!has_map && has_properties) place_on_map(of_properties, project_unit_m, place, account), has_map = true;
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
