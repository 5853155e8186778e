#include "places/dressing/bare_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "base/bounds.h"
#include "base/files.h"
#include "land/heights/city_surfaces.h"
#include "land/roads/places_on_map.h"
#include "land/roads/road_from_polygons.h"
#include "places/dressing/clock_of_place.h"
#include "places/dressing/street_view.h"

namespace parvis::dressing {
namespace {

constexpr float exhibit_m = 30.0f;       // what is smaller is a thing to look at: a car, a house
constexpr float alone_m = 70.0f;         // a town model no larger is one house
constexpr float house_m = 2.6f;          // an exhibit so high and so wide is a house, no car or bench
constexpr double dense_fraction = 0.25;  // of the place, which is built over
constexpr float view_margin_m = 60.0f;   // of ground around the place, for choosing views
constexpr float steep = 0.7f;           // cosine of 45 degrees: green that rises so was measured from the air
constexpr double min_spikes = 0.05;     // of such green, which stands upright
constexpr float wall_cos = 0.3f;        // of 73 degrees: what is steeper is a wall
constexpr float furnished_m = 6000.0f;  // of streets about the camera; more would make pictures slow
constexpr int max_scripts = 1000;       // of one name in a folder

using scene::Model, scene::Part;

const scene::Material& material_of(const Model& model, const Part& part) {
  return model.materials[std::size_t(part.material)];
}

bool has_surface(const Model& model, const std::string& name) {
  return std::ranges::any_of(model.parts, [&](const Part& part) {
    return material_of(model, part).name == name && !part.mesh.indices.empty();
  });
}

/// Surfaces of this name without pictures, all in one opaque colour: what a file says that describes shapes
/// alone.
bool is_bare(const Model& model, const std::string& name) {
  std::optional<glm::vec3> colour;
  for (const Part& part : model.parts) {
    const scene::Material& material = material_of(model, part);
    if (material.name != name) continue;
    if (material.base_colour_texture != scene::no_index || material.alpha < 1.0f) return false;
    if (colour && *colour != material.base_colour) return false;
    colour = material.base_colour;
  }
  return colour.has_value();
}

bool is_city(const Model& model) {
  return std::ranges::any_of(model.parts, [&](const Part& part) {
    const std::string& name = material_of(model, part).name;
    return scene::is_ground(name) || name == "WallSurface" || name == "RoofSurface";
  });
}

/// True for land alone, on which nothing stands.
bool is_bare_land(const Model& model) {
  return std::ranges::all_of(model.parts,
                             [&](const Part& part) { return material_of(model, part).name == "TINRelief"; });
}

/// Area in plan, m2.
double area_of(const Model& model, const std::string& name) {
  double area = 0.0;
  for (const Part& part : model.parts) {
    if (material_of(model, part).name != name) continue;
    const std::vector<std::uint32_t>& indices = part.mesh.indices;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
      const glm::vec3 a = part.mesh.positions[indices[i]];
      area += 0.5 * std::abs(double(glm::cross(part.mesh.positions[indices[i + 1]] - a,
                                               part.mesh.positions[indices[i + 2]] - a)
                                        .z));
    }
  }
  return area;
}

/// True if houses stand close, as in a town, not in gardens as in a village.
bool is_dense(const Model& model) {
  const glm::vec3 size = scene::bounds(model).size();
  return area_of(model, "RoofSurface") > dense_fraction * double(size.x) * double(size.y);
}

/// The fraction of the surface of this name, dams left out, that is steeper than the angle of this cosine.
double steeper_fraction(const Model& model, const std::string& name, float cosine) {
  double steep_m2 = 0.0, all_m2 = 0.0;
  for (const Part& part : model.parts) {
    if (material_of(model, part).name != name || part.object.ends_with(" embankment")) continue;
    const std::vector<std::uint32_t>& indices = part.mesh.indices;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
      const glm::vec3 a = part.mesh.positions[indices[i]];
      const glm::vec3 area =
          glm::cross(part.mesh.positions[indices[i + 1]] - a, part.mesh.positions[indices[i + 2]] - a);
      all_m2 += double(glm::length(area));
      if (std::abs(area.z) < cosine * glm::length(area)) steep_m2 += double(glm::length(area));
    }
  }
  return steep_m2 / std::max(all_m2, 1e-9);
}

std::string quoted(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '"' || c == '\\') escaped += '\\';
    escaped += c;
  }
  return fmt::format("\"{}\"", escaped);
}

/// Asphalt on carriageways, slabs on what is for people on foot. The file's functions tell them apart.
std::string dressing_of_roads(const Model& model) {
  std::set<std::string> names;
  for (const Part& part : model.parts)
    if (material_of(model, part).name == "Road") names.insert(part.object);
  std::string nodes;
  for (const std::string& name : names)
    nodes += fmt::format("  ground(target={}, surface=\"{}\")\n", quoted(name),
                         scene::is_drivable(name) ? "asphalt" : "paving");
  return nodes;
}

/// The nodes that dress a city model, where the file itself says nothing of walls, roofs and ground.
std::string dressing_of(const Model& model, bool is_alone) {
  std::string nodes;
  const auto add = [&](const char* node) { nodes += fmt::format("  {}\n", node); };
  // A house that shows its windows is as its file wants it. In a town, facades leave such walls alone.
  const bool has_windows = is_alone && (has_surface(model, "Window") || has_surface(model, "Door"));
  if (is_bare(model, "WallSurface") && !has_windows) add("facades(target=\"WallSurface\")");
  if (is_bare(model, "RoofSurface") && !has_windows) add("roofs(target=\"RoofSurface\")");
  if (is_bare(model, "GenericCityObject") && steeper_fraction(model, "GenericCityObject", wall_cos) > 0.0)
    add("facades(target=\"GenericCityObject\", openings=0)");  // garden walls, quays
  if (is_bare(model, "TINRelief")) add("ground(target=\"TINRelief\", surface=\"by_density\")");
  if (is_bare(model, "LandUse")) add("ground(target=\"LandUse\", surface=\"by_density\")");
  if (is_bare(model, "TransportSquare")) add("ground(target=\"TransportSquare\", surface=\"paving\")");
  if (is_bare(model, "Road")) nodes += dressing_of_roads(model);
  if (is_bare(model, "PlantCover"))
    add(steeper_fraction(model, "PlantCover", steep) > min_spikes
            ? "greenery(target=\"PlantCover\")"
            : "ground(target=\"PlantCover\", surface=\"lawn\")");
  return nodes;
}

std::string number(float value) {
  const float rounded = std::round(10.0f * value) / 10.0f;
  return fmt::format("{}", rounded == 0.0f ? 0.0f : rounded);
}

std::string point(glm::vec3 p) { return fmt::format("\"{} {} {}\"", number(p.x), number(p.y), number(p.z)); }

/// Metres of streets within a distance of a point.
float length_within(const std::vector<scene::Road>& streets, glm::vec2 point, float radius_m) {
  float length_m = 0.0f;
  for (const scene::Road& street : streets)
    for (std::size_t i = 0; i + 1 < street.path.size(); ++i)
      if (glm::distance(0.5f * (glm::vec2(street.path[i]) + glm::vec2(street.path[i + 1])), point) < radius_m)
        length_m += glm::distance(street.path[i], street.path[i + 1]);
  return length_m;
}

/// Attributes of the largest circle about the camera whose streets are furnished; none: all of them are.
std::string furnished_circle(const std::vector<scene::Road>& streets, glm::vec3 eye) {
  if (length_within(streets, glm::vec2(eye), std::numeric_limits<float>::infinity()) <= furnished_m)
    return "";
  float radius_m = 800.0f;
  while (radius_m > 100.0f && length_within(streets, glm::vec2(eye), radius_m) > furnished_m)
    radius_m -= 50.0f;
  return fmt::format(", around={}, within={}", point(eye), radius_m);
}

/// Nodes of things along kerbs: generated trees where the file has none. Lamps light windows of facades, too.
std::string nodes_of_kerbs(const Model& model, const std::vector<scene::Road>& streets, glm::vec3 eye,
                           bool has_facades) {
  if (streets.empty()) return "";
  const bool has_trees =
      std::ranges::any_of(model.parts, [&](const Part& part) {  // other than those of woods
        return material_of(model, part).name == "SolitaryVegetationObject" &&
               part.object.find(" wood") == std::string::npos;
      });
  const std::string circle = furnished_circle(streets, eye);
  return fmt::format(
             "streetFurniture(kind=\"lamps\"{})\n"
             "{}lamp(of=\"street lamp *\", position=\"0 0 4.45\", flux_lm=5000{})\n"
             "parkedCars(share=0.4{})\n"
             "crowd(people=40, centre={}, radius=60)\n",
             circle, has_facades ? "litWindows(of=\"place\")\n" : "",
             has_facades ? ", shows=\"lit windows\"" : "", circle, point(eye)) +
         (has_trees ? "" : fmt::format("streetTrees(kind=\"plane\", spacing=12, clear=2.5{})\n", circle));
}

std::string camera(const char* name, const View& view) {
  return fmt::format("camera(name=\"{}\", position={}, target={})\n", name, point(view.eye),
                     point(view.target));
}

/// The sun of a place in the afternoon, in its summer.
std::string day_light(const std::optional<glm::dvec2>& place_deg) {
  constexpr glm::dvec2 anywhere_deg(10.0, 48.0);
  constexpr double central_europe_h = 2.0;
  constexpr int june_solstice = 172, december_solstice = 355;
  const auto rounded = [](double value) {
    const double hundredths = std::round(100.0 * value);
    return hundredths == 0.0 ? 0.0 : hundredths / 100.0;  // no -0
  };
  const glm::dvec2 deg = place_deg.value_or(anywhere_deg);
  return fmt::format(
      "dayLight(latitude={}, longitude={}, standardMeridian={}, julianDay={}, timeOfDay=16, "
      "turbidity=2.2)\n",
      rounded(deg.y), rounded(deg.x), place_deg ? summer_clock_h(deg) : central_europe_h,
      deg.y < 0.0 ? december_solstice : june_solstice);
}

/// "quarter" of quarter.city.json.
std::string stem_of(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  const std::string stem = name.substr(0, name.find('.', 1));
  return stem.empty() ? "place" : stem;
}

bool lies_below(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const std::filesystem::path relative = file.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

}  // namespace

bool is_bare_file(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return !extension.empty() && extension != ".xp";
}

std::string bare_scene(const Model& model, const std::string& file,
                       const std::optional<glm::dvec2>& place_deg) {
  scene::Scene scene;
  scene.objects.emplace_back();
  scene.objects.back().model = std::make_shared<const Model>(model);
  const std::vector<scene::Road> surfaces = model.roads.empty() ? road_surfaces(model) : model.roads;
  const scene::PlaceHeights place(scene, model.roads, view_margin_m);
  const glm::vec3 size = scene::bounds(model).size();
  const bool is_town = is_city(model), is_exhibit = !is_town && std::max(size.x, size.y) < exhibit_m;
  const bool is_alone = is_exhibit || (is_town && surfaces.empty() && std::max(size.x, size.y) < alone_m);
  const bool is_land = is_bare_land(model);
  const View street = is_land    ? view_on_land(scene, place)
                      : is_alone ? outside_view(scene, place)
                                 : street_view(scene, place, surfaces);
  const View above = is_land ? land_view(scene) : overview(scene, place, street);

  std::string script = fmt::format("// Made up by parvis for {}; change it as you like.\n", file);
  script += fmt::format("model(name=\"place\", file={}{})", quoted(file), is_exhibit ? ", reflective=1" : "");
  const std::string dressing = is_town ? dressing_of(model, is_alone) : std::string();
  if (!dressing.empty()) script += fmt::format(" {{\n{}}}", dressing);
  script += '\n';
  if (!surfaces.empty()) {
    script += "streets(of=\"place\")\n";
    const auto has = [&](std::string_view thing) {
      return !scene::places_on_map(scene.objects.front(), thing).empty();
    };
    if (has(scene::map_signal_node)) script += "trafficLights(of=\"place\")\n";
    if (has(scene::map_bus_stop_node)) script += "busStop(of=\"place\")\n";
  } else if (is_town && !is_land)
    script +=
        "// The file has no roads: road(path=\"x y, x y\") adds streets, which traffic, lamps and parked "
        "cars need.\n";
  const bool is_house = is_exhibit && size.z > house_m && std::max(size.x, size.y) > 2.0f * house_m;
  const bool is_in_gardens = is_town ? !is_dense(model) : is_house;
  script += is_in_gardens ? "terrain_plane(surface=\"lawn\")\n" : "terrain_plane()\n";
  if (has_surface(model, "SolitaryVegetationObject")) script += "grownTrees(of=\"place\")\n";
  const bool has_facades = dressing.find("facades(target=\"WallSurface\")") != std::string::npos;
  script += nodes_of_kerbs(model, surfaces, street.eye, has_facades);
  script += "\n// A summer's afternoon.\n" + day_light(place_deg) +
            "exposure(value=1.3)\n"
            "air(haze_per_m=0.0004)\n"
            "shadowMap()\n";
  if (is_exhibit) script += "reflection(method=\"rerendered_cube_map\", resolution=256)\n";
  if (is_land)
    script += fmt::format("\n{}{}", camera("overview", above), camera("hill", street));
  else
    script += fmt::format("\n{}{}", camera("street", street), camera("overview", above));
  return script;
}

Result<WrittenScene> write_bare_scene(const std::filesystem::path& file, const formats::Readers& readers,
                                      const std::filesystem::path& folder) {
  std::error_code problem;
  const std::filesystem::path found = std::filesystem::canonical(file, problem);
  if (problem) return error("{}: {}", file.string(), problem.message());
  const std::filesystem::path here = std::filesystem::canonical(folder, problem);
  if (problem) return error("{}: {}", folder.string(), problem.message());
  Errors warnings;
  std::optional<glm::dvec2> place_deg;
  const Result<Model> model = readers.read(found, {.place_deg = &place_deg}, warnings);
  if (!model) return model.errors();
  const bool is_below = lies_below(found, here);
  const std::string script =
      bare_scene(*model, (is_below ? found.lexically_relative(here) : found.filename()).string(), place_deg);
  for (int i = 1; i <= max_scripts; ++i) {
    WrittenScene written{folder / fmt::format("{}{}.xp", stem_of(file), i > 1 ? fmt::format("-{}", i) : ""),
                         is_below ? "" : found.parent_path()};
    if (std::filesystem::exists(written.script, problem)) {
      const Result<std::string> text = read_file(written.script);
      if (text && *text == script) return written;
      continue;
    }
    written.is_new = true;
    if (Status status = write_file(written.script, script); !status) return status.errors();
    return written;
  }
  return error("{}: {} scripts of this name stand here; remove some", stem_of(file), max_scripts);
}

}  // namespace parvis::dressing
