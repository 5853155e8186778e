#include "life/propagation/test_noise_cases.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/plan_polygon.h"
#include "life/propagation/air.h"
#include "life/propagation/road_emission.h"
#include "life/propagation/site.h"

namespace parvis::propagation {
namespace {

using nlohmann::json;

json read_json(const std::filesystem::path& file) { return json::parse(std::ifstream(file)); }

glm::dvec2 plan_point(const json& p) { return {p[0].get<double>(), p[1].get<double>()}; }
glm::dvec3 place(const json& p) { return {p[0].get<double>(), p[1].get<double>(), p[2].get<double>()}; }

std::vector<glm::dvec2> ring(const json& points) {
  std::vector<glm::dvec2> result;
  for (const json& p : points) result.push_back(plan_point(p));
  return result;
}

/// Planar faces, areas of ground factors and flat roofs of a case.
class CaseTerrain final : public Terrain {
 public:
  CaseTerrain(const json& terrain, const json& given) : default_factor_(given["default_g"]) {
    for (const json& face : terrain["faces"]) {
      Face made;
      for (const json& index : face)
        made.corners.push_back(place(terrain["points"][index.get<std::size_t>()]));
      faces_.push_back(std::move(made));
    }
    if (!terrain["outside_z"].is_null()) outside_z_ = terrain["outside_z"];
    for (const json& area : given["ground"]) areas_.push_back({ring(area["polygon"]), area["g"]});
    for (const json& building : given["buildings"])
      roofs_.push_back({ring(building["footprint"]), building["top_z"]});
  }
  double ground_z(glm::dvec2 at) const override {
    for (const Face& face : faces_) {
      if (!is_in_ring(face.corners, at)) continue;
      const glm::dvec3 a = face.corners[0], n = glm::cross(face.corners[1] - a, face.corners[2] - a);
      return a.z - (n.x * (at.x - a.x) + n.y * (at.y - a.y)) / n.z;
    }
    return outside_z_;
  }
  double ground_factor(glm::dvec2 at) const override {
    for (const Area& area : areas_)
      if (is_in_ring(area.ring, at)) return area.value;
    return default_factor_;
  }
  std::optional<double> roof_z(glm::dvec2 at) const override {
    for (const Area& roof : roofs_)
      if (is_in_ring(roof.ring, at)) return roof.value;
    return std::nullopt;
  }
  void add_breaks(glm::dvec2 from, glm::dvec2 to, std::vector<double>& distances) const override {
    const auto add_ring = [&](const auto& points) {
      for (std::size_t i = 0, k = points.size() - 1; i < points.size(); k = i++) {
        const glm::dvec2 a(points[k]), along = glm::dvec2(points[i]) - a, ray = to - from;
        const double turn = ray.x * along.y - ray.y * along.x;
        if (std::abs(turn) < 1e-12) continue;
        const double t = ((a.x - from.x) * along.y - (a.y - from.y) * along.x) / turn;
        const double u = ((a.x - from.x) * ray.y - (a.y - from.y) * ray.x) / turn;
        if (t > 0 && t < 1 && u >= 0 && u <= 1) distances.push_back(t * glm::length(ray));
      }
    };
    for (const Face& face : faces_) add_ring(face.corners);
    for (const Area& area : areas_) add_ring(area.ring);
  }

 private:
  struct Face {
    std::vector<glm::dvec3> corners;
  };
  struct Area {
    std::vector<glm::dvec2> ring;
    double value;
  };
  std::vector<Face> faces_;
  std::vector<Area> areas_, roofs_;
  double default_factor_, outside_z_ = 0.0;
};

std::vector<Wall> walls_of(const json& given, std::vector<std::string>& ids) {
  std::vector<Wall> walls;
  const auto add = [&](const json& of, const json& a, const json& b, double top_a, double top_b) {
    Wall wall{plan_point(a), plan_point(b), top_a, top_b, std::nullopt};
    if (!of["absorption"].is_null()) wall.absorption = of["absorption"].get<Octaves>();
    walls.push_back(wall);
    ids.push_back(of["id"]);
  };
  for (const json& wall : given["walls"])
    add(wall, wall["line"][0], wall["line"][1], wall["line"][0][2], wall["line"][1][2]);
  for (const json& building : given["buildings"]) {
    const json& corners = building["footprint"];
    for (std::size_t i = 0; i < corners.size(); ++i)
      add(building, corners[i], corners[(i + 1) % corners.size()], building["top_z"], building["top_z"]);
  }
  return walls;
}

CaseResult compute(const json& given, const json& all, double warmer_c) {
  const json& settings = all["settings"];
  const Octaves air = absorption_db_per_m(
      {settings["temperature_c"].get<double>() + warmer_c, settings["relative_humidity_percent"]});
  const CaseTerrain terrain(all["terrains"][given["terrain"].get<std::string>()], given);
  std::vector<std::string> ids;
  const Site site(terrain, walls_of(given, ids));
  const Place source = place(given["source"]), receiver = place(given["receiver"]);
  const auto power = given["sound_power_db"].get<Octaves>();
  CaseResult result;
  result.id = given["id"];
  Octaves with{}, without{};

  for (const auto& [path, levels] : given["expected"]["paths"].items())
    for (const Condition condition : {Condition::homogeneous, Condition::favourable}) {
      const bool is_favourable = condition == Condition::favourable;
      const json& printed = levels[is_favourable ? "favourable" : "homogeneous"];
      std::optional<Octaves> loss;
      if (path == "direct") {
        loss = site.over(source, receiver, air, condition);
      } else if (path == "reflection") {
        for (std::size_t i = 0; i < ids.size() && !loss; ++i)
          if (ids[i] == given["via"]["reflection"][0].get<std::string>()) {
            const int sequence[]{int(i)};
            loss = site.reflected(source, receiver, sequence, air, condition);
          }
      } else if (!printed.is_null()) {
        const json& via = given["via"];
        const std::string own = path + "_favourable";
        const std::vector<glm::dvec2> corners = ring(via[is_favourable && via.contains(own) ? own : path]);
        loss = site.around(source, receiver, corners, air, condition);
        const auto found = site.corners_around(source, receiver, condition, path == "left", 1e6);
        bool is_found = found.size() == corners.size();
        for (std::size_t i = 0; i < corners.size() && is_found; ++i)
          is_found = glm::distance(found[i], corners[i]) < 0.01;
        result.finds_corners = result.finds_corners && is_found;
      }
      if (loss.has_value() == printed.is_null()) {
        result.path_db = result.total_db = 1e3;
        result.worst = path + (loss ? " must not exist" : " was not found");
        continue;
      }
      if (!loss) continue;
      for (std::size_t i = 0; i < octaves; ++i) {
        const double heard = power[i] - (*loss)[i], difference = std::abs(heard - printed[i].get<double>());
        if (difference > result.path_db) {
          result.path_db = difference;
          result.worst = fmt::format("{} {} {} Hz: {:.2f}, printed {:.2f}", path,
                                     is_favourable ? "favourable" : "homogeneous", nominal_hz[i], heard,
                                     printed[i].get<double>());
        }
        with[i] += 0.5 * energy(heard);
        if (path == "direct" || path == "reflection") without[i] += 0.5 * energy(heard);
      }
    }
  for (std::size_t i = 0; i < octaves; ++i) {
    const auto difference = [&](const Octaves& energies, const char* key) {
      return std::abs(level(energies[i]) + a_weights_db[i] - given["expected"][key][i].get<double>());
    };
    result.total_db = std::max(result.total_db, difference(with, "la_db"));
    result.without_lateral_db =
        std::max(result.without_lateral_db, difference(without, "la_without_lateral_db"));
  }
  return result;
}

constexpr const char* category_names[]{"1", "2", "3", "4a", "4b"};

RoadCoefficients coefficients_of(const json& data) {
  RoadCoefficients result;
  for (std::size_t i = 0; i < vehicle_categories; ++i) {
    const json& category = data["categories"][category_names[i]];
    VehicleCoefficients& c = result.vehicles[i];
    if (category.contains("ar"))
      c.rolling_a = category["ar"].get<Octaves>(), c.rolling_b = category["br"].get<Octaves>();
    c.propulsion_a = category["ap"].get<Octaves>(), c.propulsion_b = category["bp"].get<Octaves>();
  }
  result.studded_a = data["studded_tyres"]["a"].get<Octaves>();
  result.studded_b = data["studded_tyres"]["b"].get<Octaves>();
  return result;
}

}  // namespace

std::vector<CaseResult> compute_cases(const std::filesystem::path& folder, double warmer_c) {
  const json all = read_json(folder / "iso_tr_17534_4.json");
  std::vector<CaseResult> results;
  for (const json& given : all["cases"]) results.push_back(compute(given, all, warmer_c));
  return results;
}

Matches compare_air_table(const std::filesystem::path& folder, double warmer_c) {
  std::ifstream file(folder / "air_absorption.csv");
  std::string line;
  std::getline(file, line);
  Matches result;
  while (std::getline(file, line)) {
    std::istringstream row(line);
    std::string celsius, humidity, band, exact, printed;
    for (std::string* field : {&celsius, &humidity, &band, &exact, &printed}) std::getline(row, *field, ',');
    if (printed.empty()) continue;
    ++result.all;
    const double per_km =
        1000.0 * absorption_db_per_m(std::stod(exact), {std::stod(celsius) + warmer_c, std::stod(humidity)});
    const double digit = std::stod(printed) >= 100.0 ? 1.0 : 0.1,
                 apart = std::abs(per_km - std::stod(printed));
    result.agree += apart <= digit;
    if (apart <= 0.5 * digit + 1e-9)
      ++result.rounded;
    else
      result.differing +=
          fmt::format("{} C, {} %, {} Hz: {:.3f}, printed {}; ", celsius, humidity, band, per_km, printed);
  }
  return result;
}

Matches compare_road_checks(const std::filesystem::path& folder, const char* key, double warmer_c) {
  const json data = read_json(folder / "road_emission_2015_checks.json");
  const RoadCoefficients coefficients = coefficients_of(data);
  Matches result;
  for (const json& check : data[key]) {
    RoadTraffic traffic;
    RoadSurface surface;
    const json& given = data["surfaces"][check["surface"].get<std::string>()];
    for (std::size_t i = 0; i < vehicle_categories; ++i) {
      traffic.flow_per_h[i] = check["flow_per_h"][category_names[i]];
      traffic.speed_km_h[i] = check["speed_km_h"][category_names[i]];
      if (i < surface.beta.size())
        surface.alpha[i] = given[category_names[i]]["alpha"].get<Octaves>(),
        surface.beta[i] = given[category_names[i]]["beta"];
    }
    traffic.gradient_percent = check["slope_percent"];
    traffic.celsius = check["temperature_c"].get<double>() + warmer_c;
    traffic.junction = Junction(check["junction_type"].get<int>()),
    traffic.junction_m = check["junction_distance_m"];
    traffic.studded_fraction = check["studded_share"], traffic.studded_months = check["studded_months"];
    const Octaves power = road_power_db(coefficients, surface, traffic);
    ++result.all;
    for (std::size_t i = 0; i < octaves; ++i) {
      if (nominal_hz[i] != check["band_hz"].get<double>()) continue;
      if (std::abs(power[i] - check["expected_lw_per_m_db"].get<double>()) <=
          data["tolerance_db"].get<double>())
        ++result.agree;
      else
        result.differing += fmt::format("{}: {:.4f}; ", check["id"].get<std::string>(), power[i]);
    }
  }
  return result;
}

Matches compare_road_coefficients(const std::filesystem::path& folder) {
  const RoadCoefficients given = coefficients_of(read_json(folder / "road_emission_2020.json"));
  Matches result;
  const auto compare = [&](const Octaves& ours, const Octaves& theirs) {
    for (std::size_t i = 0; i < octaves; ++i) ++result.all, result.agree += ours[i] == theirs[i];
  };
  for (std::size_t i = 0; i < vehicle_categories; ++i) {
    const VehicleCoefficients &ours = road_coefficients_2020.vehicles[i], &theirs = given.vehicles[i];
    compare(ours.rolling_a, theirs.rolling_a), compare(ours.rolling_b, theirs.rolling_b);
    compare(ours.propulsion_a, theirs.propulsion_a), compare(ours.propulsion_b, theirs.propulsion_b);
  }
  compare(road_coefficients_2020.studded_a, given.studded_a);
  compare(road_coefficients_2020.studded_b, given.studded_b);
  return result;
}

}  // namespace parvis::propagation
