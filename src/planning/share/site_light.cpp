#include "planning/share/site_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "base/progress.h"

namespace parvis::share {
namespace {

using Json = nlohmann::json;

/// A sky between two moments of the hour strip is smooth; its sun is none of its pixels.
constexpr int hour_sky_width_px = 128;
constexpr int steps_per_hour = 2;
/// Skies of photographs have more pixels than a page needs.
constexpr int max_sky_width_px = 1024;

std::string packed(const ImageF& image) {
  std::string bytes;
  bytes.reserve(4 * std::size_t(image.width) * std::size_t(image.height));
  for (std::size_t i = 0; i + 2 < image.pixels.size(); i += 3) {
    const glm::vec3 colour =
        glm::max(glm::vec3(image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]), 0.0f);
    const std::uint32_t word = glm::packF3x9_E1x5(glm::min(colour, glm::vec3(65000.0f)));
    bytes.append(reinterpret_cast<const char*>(&word), 4);
  }
  return bytes;
}

/// `sky` with its levels; those above `max_sky_width_px` are left out of a page.
Json sky_json(const shading::SkyLight& sky, LightBytes& bytes) {
  Json json{{"heading", sky.heading}, {"haze", array_of(sky.haze_radiance)}};
  for (const glm::vec3& each : sky.irradiance_sh) json["sh"].push_back(array_of(each));
  // GPUs want all levels down from one size: where the sharpest is left out, the next one begins.
  std::size_t first = 0;
  while (first + 1 < sky.levels.size() && sky.levels[first].width > max_sky_width_px) ++first;
  json["sharpest"] = first;
  for (std::size_t i = first; i < sky.levels.size(); ++i)
    json["levels"].push_back({{"width", sky.levels[i].width},
                              {"height", sky.levels[i].height},
                              {"offset", bytes.add(packed(sky.levels[i]))}});
  return json;
}

/// Day and month of a day of the year.
std::string date_of(int year, int day_of_year) {
  constexpr std::array months{"January", "February", "March",     "April",   "May",      "June",
                              "July",    "August",   "September", "October", "November", "December"};
  for (int month = 12; month >= 1; --month)
    if (const int first = light::day_of_year(year, month, 1); day_of_year >= first)
      return fmt::format("{} {}", day_of_year - first + 1, months[std::size_t(month - 1)]);
  return {};
}

}  // namespace

Json array_of(glm::vec3 v) { return {v.x, v.y, v.z}; }

std::size_t LightBytes::add(std::string_view piece) {
  bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
  const std::size_t offset = bytes_.size();
  bytes_.append(piece);
  return offset;
}

Json moment_json(const scene::Scene& scene, const shading::SkyLight& sky, LightBytes& bytes) {
  return {{"to_sun", array_of(glm::normalize(scene.sun.direction_to_sun))},
          {"sun", array_of(scene.sun.irradiance)},
          {"exposure", scene.exposure},
          {"sky", sky_json(sky, bytes)}};
}

Json visibility_json(const shading::SkyVisibility& visibility, LightBytes& bytes) {
  const auto& values = visibility.values;
  return {{"origin", array_of(visibility.grid.origin)},
          {"size", array_of(visibility.grid.size_m)},
          {"lift", visibility.grid.lift_m},
          {"cells", {visibility.cells.x, visibility.cells.y, visibility.cells.z}},
          {"offset", bytes.add({reinterpret_cast<const char*>(values.data()), values.size()})}};
}

Json bounced_json(const shading::BouncedLight* light, LightBytes& bytes) {
  if (light == nullptr || light->empty()) return nullptr;
  std::vector<std::uint64_t> texels;
  texels.reserve(3 * light->lobes.size());
  for (const glm::vec4& lobe : light->lobes) texels.push_back(glm::packHalf4x16(lobe));
  for (const std::vector<glm::vec3>* list : {&light->colours, &light->skies})
    for (const glm::vec3& each : *list) texels.push_back(glm::packHalf4x16(glm::vec4(each, 0.0f)));
  return {{"origin", array_of(light->grid.origin)},
          {"size", array_of(light->grid.size_m)},
          {"lift", light->grid.lift_m},
          {"layers", light->grid.layers},
          {"cells", {light->cells.x, light->cells.y, 3 * light->cells.z}},
          {"offset", bytes.add({reinterpret_cast<const char*>(texels.data()), 8 * texels.size()})}};
}

Result<Json> days_json(const scene::Scene& scene, LightBytes& bytes) {
  const light::DayLight& given = scene.data<light::DayLight>();
  Json days = Json::array();
  if (!given.is_given) return days;
  light::PlaceAndTime place = given.when;
  place.true_north_deg = scene.true_north_deg;
  std::vector<int> numbers{place.day_of_year};
  for (const auto& [month, day] : {std::pair(3, 21), std::pair(6, 21), std::pair(12, 21)})
    if (const int number = light::day_of_year(place.year, month, day); !std::ranges::count(numbers, number))
      numbers.push_back(number);
  Progress progress("hours of the day", numbers.size());
  for (const int number : numbers) {
    place.day_of_year = number;
    const light::DaylightHours hours = light::daylight_hours(place);
    const light::DaylightHours twilight = light::daylight_hours(place, light::civil_twilight_elevation_deg);
    Json day{{"label", date_of(place.year, number)}, {"moments", Json::array()}};
    if (hours.rise_h) day["rise_h"] = *hours.rise_h;
    if (hours.set_h) day["set_h"] = *hours.set_h;
    for (int step = 0; step < 24 * steps_per_hour; ++step) {
      const double hour = double(step) / steps_per_hour;
      if (hour < twilight.begin_h() || hour > twilight.end_h()) continue;
      light::PlaceAndTime when = light::at_hour(place, hour);
      const Result<std::shared_ptr<const light::SkyModel>> sky =
          light::make_sky(given.kind, given.air, light::sun_of(when));
      if (!sky) return sky.errors();
      scene::Scene moment;
      moment.sun = {(*sky)->to_sun(), light::displayable((*sky)->sun_irradiance_xyz())};
      moment.exposure = given.chosen_exposure * light::exposure_for((*sky)->irradiance_xyz({0, 0, 1}).y);
      const ImageF picture = light::sky_picture(**sky, given, hour_sky_width_px);
      Json json = moment_json(moment, shading::make_sky_light(picture, 1.0f, 0.0f), bytes);
      json["hour"] = hour;
      day["moments"].push_back(std::move(json));
    }
    days.push_back(std::move(day));
    progress.advance();
  }
  return days;
}

}  // namespace parvis::share
