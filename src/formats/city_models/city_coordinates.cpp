#include "formats/city_models/city_coordinates.h"

#include <algorithm>
#include <cmath>

#include "formats/terrain/map_system.h"

namespace parvis::scene {
namespace {

constexpr double max_longitude_deg = 180.0;
constexpr double max_region_m = 100'000.0;  // no city is so wide, and floats end at centimetres there
/// Coordinates without a named system are degrees if they span less than a town and are higher than wide.
constexpr double narrow_deg = 0.2, high_building_m = 2.0;
constexpr double majority = 0.5;  // of their area, that face one way rather than the other
/// Distance from a map's origin: nearer coordinates are about an origin of the file's own, whatever it names.
constexpr double off_origin_m = 1000.0;

/// Whether the coordinates can be degrees in one order of the axes.
bool can_be_degrees(const CoordinateClues& clues, bool is_north_first) {
  const glm::dvec2 reach = glm::max(glm::abs(glm::dvec2(clues.low)), glm::abs(glm::dvec2(clues.high)));
  const glm::dvec2 east_first = is_north_first ? glm::dvec2(reach.y, reach.x) : reach;
  return east_first.x <= max_longitude_deg && east_first.y <= max_latitude_deg;
}

/// Whether roofs, or bodies where there are none, say that the axes are in the other order than
/// `is_north_first`.
bool roofs_contradict(const CoordinateClues& clues, bool is_north_first) {
  const bool has_roofs = clues.roofs > 0.0;
  const double right = has_roofs ? clues.roofs_up : clues.bodies_right;
  return (is_north_first ? -right : right) < -majority * (has_roofs ? clues.roofs : clues.bodies);
}

const char* order_name(bool is_north_first) { return is_north_first ? "latitude first" : "longitude first"; }

std::string shortened(const std::string& name) {
  constexpr std::size_t longest = 120;
  return name.size() <= longest ? name : name.substr(0, longest) + "...";
}

glm::dvec2 east_first(glm::dvec2 in_file, bool is_north_first) {
  return is_north_first ? glm::dvec2(in_file.y, in_file.x) : in_file;
}

bool names_longitude_first(const std::string& system) {
  return system.find("CRS84") != std::string::npos;  // OGC's own, which EPSG has no number for
}

/// Whether names of this form mean the order of axes of the system's definition (OGC 07-092r1, 09-048r3).
/// Older ones, "EPSG:2180", have the easting first.
bool means_defined_order(const std::string& system) {
  return system.find("urn:") != std::string::npos || system.find("/def/crs/") != std::string::npos;
}

/// Decides whether northing stands first in a projected system that defines it so.
bool has_northing_first(const CoordinateClues& clues, int epsg) {
  if (roofs_contradict(clues, false)) return true;
  if (roofs_contradict(clues, true)) return false;
  const glm::dvec2 middle = 0.5 * glm::dvec2(clues.low + clues.high);
  const bool fits_east_first = lies_in_area(epsg, middle),
             fits_north_first = lies_in_area(epsg, {middle.y, middle.x});
  return fits_east_first == fits_north_first ? means_defined_order(clues.system) : fits_north_first;
}

/// Area in plan, in the file's own units; negative where the ring runs clockwise about its first two axes.
double signed_area(std::span<const glm::dvec3> ring) {
  double twice = 0.0;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i)  // about the first: far coordinates would lose digits
    twice += (ring[i].x - ring[0].x) * (ring[i + 1].y - ring[0].y) -
             (ring[i + 1].x - ring[0].x) * (ring[i].y - ring[0].y);
  return twice / 2.0;
}

}  // namespace

void CoordinateClues::add(const glm::dvec3& point) {
  if (!std::isfinite(point.x + point.y + point.z)) return;
  low = glm::min(low, point), high = glm::max(high, point);
}

void CoordinateClues::add_roof(std::span<const glm::dvec3> ring) {
  const double area = signed_area(ring);
  if (std::isfinite(area)) roofs_up += area, roofs += std::abs(area);
}

void CoordinateClues::add_body(std::span<const std::vector<glm::dvec3>> rings) {
  double lowest = std::numeric_limits<double>::max(), volume = 0.0;
  for (const std::vector<glm::dvec3>& ring : rings)
    for (const glm::dvec3& point : ring) lowest = std::min(lowest, point.z);
  for (const std::vector<glm::dvec3>& ring : rings) {
    double sum = 0.0;
    for (const glm::dvec3& point : ring) sum += point.z - lowest;
    if (!ring.empty()) volume += signed_area(ring) * sum / double(ring.size());
  }
  if (std::isfinite(volume)) bodies_right += volume, bodies += std::abs(volume);
}

void CityCoordinates::lay_on(const MapProjection& target) {
  target_ = target;
  map_ = target.system();
  if (place_deg_) true_north_deg_ = target.true_north_deg(*place_deg_);
}

Result<CityCoordinates> CityCoordinates::find(const CoordinateClues& clues, const std::filesystem::path& file,
                                              Errors& warnings, const std::string& map) {
  CityCoordinates found;
  if (!(clues.low.x <= clues.high.x)) return found;
  if (const Status known = projections_known(); !known) return known.errors();
  const FileLocation where{file.string(), 0, 0};
  const std::string name = shortened(clues.system);
  const glm::dvec2 size = clues.high - clues.low, middle = 0.5 * glm::dvec2(clues.low + clues.high);
  const std::optional<int> epsg = epsg_in(clues.system);
  const std::optional<MapSystem> system = epsg ? map_system(*epsg) : std::nullopt;
  if (epsg && !system)
    warnings.push_back(
        error_at(where,
                 "its coordinates are of a system that is not known, \"{}\" (EPSG:{}): they are "
                 "read as metres, east first. Name the system that they are of",
                 name, *epsg));
  if (system && !system->is_geographic) {
    found.is_north_first_ = system->is_north_first && has_northing_first(clues, *epsg);
    found.plan_unit_m_ = system->plan_unit_m;
    found.height_unit_m_ = system->height_unit_m.value_or(system->plan_unit_m);
    if (found.height_unit_m_ != 1.0 && !system->height_unit_m)
      warnings.push_back(
          error_at(where,
                   "\"{}\" ({}) has no heights; they are taken to be in its unit of {:.4f} m, as "
                   "the plan is. Where they are in metres, name a system that has them, too",
                   name, system->name, system->plan_unit_m));
    if (std::max(std::abs(middle.x), std::abs(middle.y)) * system->plan_unit_m > off_origin_m)
      found.place_deg_ = place_on_earth(*epsg, east_first(middle, found.is_north_first_));
    const std::string own = fmt::format("EPSG:{}", *epsg);
    const std::optional<MapProjection> projection = found.place_deg_ ? MapProjection::of(own) : std::nullopt;
    if (!projection) return found;
    const std::optional<MapProjection> other =
        map.empty() || map == own ? std::nullopt : MapProjection::of(map);
    if (other && std::isfinite((*other)(*found.place_deg_).x)) {
      found.own_ = projection;
      found.lay_on(*other);
    } else {
      found.map_ = own;
      found.true_north_deg_ = projection->true_north_deg(*found.place_deg_);
    }
    return found;
  }
  const bool is_named = system || names_longitude_first(clues.system);
  const bool looks_like_degrees =
      std::max(size.x, size.y) < narrow_deg && clues.high.z - clues.low.z > high_building_m;
  const bool can_be_north_first = can_be_degrees(clues, true),
             can_be_east_first = can_be_degrees(clues, false);
  // Without a name the order has to follow from the coordinates, or the assembly refuses them.
  if (!is_named && (!looks_like_degrees || can_be_north_first == can_be_east_first)) return found;
  if (!can_be_north_first && !can_be_east_first) {
    warnings.push_back(
        error_at(where,
                 "\"{}\" names coordinates in degrees, but they reach to {:.1f} {:.1f}: they are "
                 "read as metres, east first. Name the system that they are of",
                 name, clues.high.x, clues.high.y));
    return found;
  }
  const bool is_named_north_first = system ? system->is_north_first : !is_named;
  found.is_north_first_ = is_named_north_first;
  if (can_be_north_first != can_be_east_first)
    found.is_north_first_ = can_be_north_first;
  else if (roofs_contradict(clues, is_named_north_first))
    found.is_north_first_ = !is_named_north_first;
  if (!is_named)
    warnings.push_back(
        error_at(where,
                 "it names no coordinate system, and its houses are higher than the place is "
                 "wide: its coordinates are read as degrees, {}. Name their system in the file, "
                 "EPSG:4979, say",
                 order_name(found.is_north_first_)));
  else if (found.is_north_first_ != is_named_north_first)
    warnings.push_back(
        error_at(where,
                 "\"{}\" means {}, but by its {} it has {}: it is read so. Exchange the axes, or "
                 "name another system, where this is wrong",
                 name, order_name(is_named_north_first),
                 can_be_north_first == can_be_east_first ? "roofs" : "coordinates",
                 order_name(found.is_north_first_)));
  const glm::dvec2 place_deg = east_first(middle, found.is_north_first_);
  found.place_deg_ = place_deg;
  const std::optional<MapProjection> other = MapProjection::of(map);
  const bool is_on_other = other && std::isfinite((*other)(place_deg).x);
  found.lay_on(is_on_other ? *other : MapProjection::utm(place_deg));
  found.height_unit_m_ = system ? system->height_unit_m.value_or(1.0) : 1.0;
  const glm::dvec3 size_m = found(clues.high) - found(clues.low);
  if (!(glm::length(glm::dvec2(size_m)) < max_region_m))
    return error_at(
        where,
        "its coordinates reach from {:.3f} {:.3f} to {:.3f} {:.3f} degrees, wider than {:.0f} km: "
        "are the axes of some objects exchanged, or are they metres? Repair them or the system's "
        "name, or cut out the part that you need",
        clues.low.x, clues.low.y, clues.high.x, clues.high.y, max_region_m / 1000.0);
  return found;
}

glm::dvec3 CityCoordinates::operator()(const glm::dvec3& in_file) const {
  const glm::dvec2 plan = east_first(in_file, is_north_first_);
  const glm::dvec2 metres = plan_unit_m_ * plan;
  return {own_      ? (*target_)(own_->degrees(metres))
          : target_ ? (*target_)(plan)
                    : metres,
          height_unit_m_ * in_file.z};
}

}  // namespace parvis::scene
