#include "bench/formats/planted_faults.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "base/files.h"
#include "scene/script/scene_loader.h"
#include "stage/place_check.h"

namespace parvis::bench {
namespace {
namespace fs = std::filesystem;

/// A row of houses in CityJSON, of their roofs alone, or with walls.
std::string houses_json(bool have_walls) {
  using Json = nlohmann::json;
  constexpr int houses = 24, spacing_m = 20, side_m = 10, high_m = 6;
  constexpr std::array<std::array<int, 2>, 4> corners{{{0, 0}, {side_m, 0}, {side_m, side_m}, {0, side_m}}};
  Json objects = Json::object(), vertices = Json::array();
  for (int i = 0; i < houses; ++i) {
    const int first = 8 * i;
    for (const int z_m : {0, high_m})
      for (const auto& [x_m, y_m] : corners) vertices.push_back(Json::array({spacing_m * i + x_m, y_m, z_m}));
    const auto surface = [&](int a, int b, int c, int d) {
      return Json::array({Json::array({first + a, first + b, first + c, first + d})});
    };
    Json boundaries = Json::array({surface(4, 5, 6, 7)}), values = Json::array({0});
    for (int k = 0; have_walls && k < 4; ++k) {
      const int next = (k + 1) % 4;
      boundaries.push_back(surface(k, next, 4 + next, 4 + k)), values.push_back(1);
    }
    Json geometry;
    geometry["type"] = "MultiSurface", geometry["lod"] = "2", geometry["boundaries"] = boundaries;
    geometry["semantics"]["values"] = values;
    for (std::size_t k = 0; const char* kind : {"RoofSurface", "WallSurface"})
      geometry["semantics"]["surfaces"][k++]["type"] = kind;
    Json& house = objects[fmt::format("house {}", i + 1)];
    house["type"] = "Building", house["geometry"] = Json::array({geometry});
  }
  Json city;
  city["type"] = "CityJSON", city["version"] = "2.0";
  city["transform"]["scale"] = {1.0, 1.0, 1.0}, city["transform"]["translate"] = {0.0, 0.0, 0.0};
  city["CityObjects"] = objects, city["vertices"] = vertices;
  return city.dump();
}

/// A cube of 10 m about the origin.
constexpr const char* cube_obj =
    "v -5 -5 -5\nv 5 -5 -5\nv 5 5 -5\nv -5 5 -5\nv -5 -5 5\nv 5 -5 5\nv 5 5 5\nv -5 5 5\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

struct Fault {
  const char* name;
  const char* script;
  const char* sound;    ///< the same place without its fault
  const char* warning;  ///< words of the warning that names the fault
};

constexpr std::array faults{
    Fault{"roofs without walls", "model(file=\"roofs.city.json\")\n", "model(file=\"houses.city.json\")\n",
          "none is a WallSurface"},
    Fault{"a dressing of nothing", "model(file=\"houses.city.json\") { facades(target=\"TINRelief\") }\n",
          "model(file=\"houses.city.json\") { facades(target=\"WallSurface\") }\n", "nothing that matches"},
    Fault{"a camera in a wall",
          "model(name=\"cube\", file=\"cube.obj\")\n"
          "camera(name=\"street\", position=\"0 0 0\", target=\"9 0 0\")\n",
          "model(name=\"cube\", file=\"cube.obj\")\n"
          "camera(name=\"street\", position=\"0 -40 0\", target=\"0 0 0\")\n",
          "camera \"street\" stands inside \"cube\""},
    Fault{"roads above nothing",
          "road(path=\"0 0, 100 0\")\n"
          "camera(name=\"street\", position=\"0 0 2\", target=\"9 0 2\")\n",
          "road(path=\"0 0, 100 0\")\nterrain_plane()\n"
          "camera(name=\"street\", position=\"0 0 2\", target=\"9 0 2\")\n",
          "nothing lies below the roads"},
    Fault{"a mask of nothing",
          "model(file=\"cube.obj\") { material(mask=\"colour #00FF00 0.02\", preset=\"glass\") }\n",
          "model(file=\"cube.obj\") { material(mask=\"object\", preset=\"glass\") }\n",
          "no triangle lies in the mask"}};

/// Whether loading a script warns in these words.
bool warns(const fs::path& script, const std::string& text, const char* words) {
  must(write_file(script, text));
  const scene::LoadedScene loaded = must(scene::load_scene(script, rooms::node_registry(), {}));
  Errors warnings = loaded.warnings;
  for (const Error& warning : stage::check_place(loaded.scene)) warnings.push_back(warning);
  return to_string(warnings).find(words) != std::string::npos;
}

}  // namespace

void measure_planted_faults(const BenchSetup& setup, Report& report) {
  const fs::path& folder = setup.folder;
  must(write_file(folder / "roofs.city.json", houses_json(false)));
  must(write_file(folder / "houses.city.json", houses_json(true)));
  must(write_file(folder / "cube.obj", cube_obj));
  int silent = 0, silent_when_sound = 0;
  for (const Fault& fault : faults) {
    const bool of_fault = warns(folder / "fault.xp", fault.script, fault.warning);
    const bool of_sound = warns(folder / "sound.xp", fault.sound, fault.warning);
    if (!of_fault) report.note(fmt::format("{}: loaded without a warning", fault.name));
    if (of_sound) report.note(fmt::format("{}: warned of where it is not", fault.name));
    silent += !of_fault, silent_when_sound += !of_sound;
  }
  report.add("faults_without_warning", silent);
  report.add("faults_without_warning_in_sound_places", silent_when_sound);
}

}  // namespace parvis::bench
