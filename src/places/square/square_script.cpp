#include "places/square/square_script.h"

#include <fmt/format.h>

#include <glm/glm.hpp>
#include <vector>

#include "places/square/fountain.h"
#include "places/square/layout.h"

namespace parvis::square {
namespace {

std::string camera(const char* name, glm::vec3 eye, glm::vec3 target, int fov_deg) {
  return fmt::format(
      "camera(name=\"{}\", position=\"{:.2f} {:.2f} {:.2f}\", target=\"{:.2f} {:.2f} {:.2f}\", fov_deg={})\n",
      name, eye.x, eye.y, eye.z, target.x, target.y, target.z, fov_deg);
}

std::string roads() {
  const float out = reach_m - 8.0f;
  return fmt::format(
      "road(name=\"avenue\", lane_width=3.25, speed_km_h=30,\n    path=\"{0} -140 0, {0} {1} 0, {2} {1} 0, "
      "{2} -140 0\")\n"
      "road(name=\"eastern street\", lane_width=3.25, speed_km_h=30,\n    path=\"{3} {1} 0, {3} {2} 0, 130 "
      "{2} 0\")\n"
      "road(name=\"southern lane\", lane_width=3.25, speed_km_h=30,\n    path=\"{4} {1} 0, {4} {0} 0, -130 "
      "{0} 0\")\n",
      -out, avenue_y, out, street_x, lane_x);
}

std::string tram() {
  const float z = kerb_m - 0.025f, west = -150.0f, north = 146.0f;
  return fmt::format(
      "tram(name=\"line 1\", radius=26, headway_s=150, start_s=57,\n"
      "    path=\"{0} 110 {3:.3f}, {0} {1} {3:.3f}, {2} {1} {3:.3f}, {2} {4} {3:.3f}, -90 {4} {3:.3f}\") {{\n"
      "  tramStop(position=\"-10 {5} {6:.2f}\", dwell_s=24)\n}}\n"
      "sound(kind=\"bell\", follows=\"line 1 1\", position=\"12 0 3\")\n",
      west, tram_y, tram_x, z, north, tram_y - 3.0f, kerb_m);
}

/// Lamps along the rim of the square.
std::vector<glm::vec2> lamp_places() {
  std::vector<glm::vec2> places;
  for (int i = 0; i < 6; ++i)
    places.emplace_back(-43.0f + 14.6f * float(i), avenue_y + 0.5f * carriageway_m + 1.6f);
  for (int i = 0; i < 3; ++i)
    places.emplace_back(street_x - 0.5f * carriageway_m - 1.6f, -9.0f + 14.6f * float(i));
  for (const float x : {-40.0f, -26.0f, -12.0f, 22.0f}) places.emplace_back(x, 28.0f);
  return places;
}

/// Planes that stand there today, west and east.
std::string planes() {
  std::string text;
  int number = 0;
  for (const glm::vec2 at : {glm::vec2(27.5f, -13.0f), glm::vec2(27.5f, 1.0f), glm::vec2(27.5f, 14.5f),
                             glm::vec2(-40.0f, 3.0f), glm::vec2(-40.0f, -9.0f)}) {
    ++number;
    text += fmt::format(
        "plant(name=\"plane {0}\", kind=plane, seed={1}, height={2}, position=\"{3} {4} {5}\", "
        "heading_deg={6})\n",
        number, 1 + number % 2, 9.0f + 0.7f * float(number % 3), at.x, at.y, kerb_m, 77 * number % 360);
  }
  return text;
}

std::string lamps() {
  std::string text;
  int number = 0;
  for (const glm::vec2 at : lamp_places())
    text += fmt::format(
        "model(name=\"street lamp {}\", file=\"street_lamp.glb\", position=\"{:.2f} {:.2f} {:.2f}\")\n",
        ++number, at.x, at.y, kerb_m);
  return text;
}

std::string designs() {
  const float z = kerb_m;
  std::string text =
      "design(name=\"stone project\", label=\"Umbrellas, tables and stone benches\", visible=0) {\n";
  int number = 0;
  for (const float x : {-38.0f, -31.0f, -24.0f})
    for (const float y : {-16.5f, -10.5f}) {
      ++number;
      text += fmt::format(
          "  placed(name=umbrella_{0}, kind=umbrella, position=\"{1} {2} {3}\", heading_deg={4}{5})\n"
          "  placed(name=table_{0}, kind=table, position=\"{1} {2} {3}\", heading_deg={4})\n",
          number, x, y, z, 20 * number, number % 2 == 0 ? ", colour=\"#BF6A45\"" : "");
    }
  number = 0;
  for (const float x : {4.0f, 11.0f, 18.0f, 25.0f})
    text += fmt::format(
        "  placed(name=bench_{}, kind=bench_stone, position=\"{} -14 {}\", heading_deg=0, width=2.4)\n",
        ++number, x, z);
  text += "}\n";
  for (const auto& [name, label, kind, bench, height] :
       {std::tuple{"orange project", "Orange trees and benches", "tree_orange", "orange bench", 3.6f},
        std::tuple{"oak project", "Oaks and benches", "tree_oak", "oak bench", 7.5f}}) {
    text += fmt::format("design(name=\"{}\", label=\"{}\", visible=0) {{\n", name, label);
    number = 0;
    for (const float x : {-37.0f, -28.0f, 4.0f, 13.0f, 22.0f})
      for (const float y : {-14.5f, 3.5f}) {
        ++number;
        text += fmt::format(
            "  placed(name=\"{0} {1}\", kind={0}, position=\"{2} {3} {4}\", heading_deg={5}, height={6})\n",
            kind, number, x, y, z, 67 * number % 360, height);
      }
    number = 0;
    for (const float x : {-32.5f, 8.5f, 17.5f})
      text +=
          fmt::format("  placed(name=\"{} {}\", kind=bench_wood, position=\"{} -14.5 {}\", heading_deg=0)\n",
                      bench, ++number, x, z);
    text += "}\n";
  }
  return text;
}

std::string scenarios() {
  const auto scenario = [](const char* name, const char* title, const char* shown, bool has_cars) {
    std::string text = fmt::format("scenario(name=\"{}\", title=\"{}\") {{\n", name, title);
    for (const char* design : {"stone project", "orange project", "oak project"})
      text +=
          fmt::format("  override(of=\"{}\", visible={})\n", design, std::string(design) == shown ? 1 : 0);
    if (!has_cars) text += "  override(of=\"%traffic\", visible=0)\n";
    return text + "}\n";
  };
  return scenario("stone", "Stone, with cars", "stone project", true) +
         scenario("stone without cars", "Stone, without cars", "stone project", false) +
         scenario("trees", "Orange trees, with cars", "orange project", true) +
         scenario("trees without cars", "Orange trees, without cars", "orange project", false) +
         scenario("oaks", "Oaks, with cars", "oak project", true) +
         "scenario(name=\"morning\", title=\"A morning in spring\") {\n  override(of=\"%dayLight\", "
         "julianDay=110, timeOfDay=9.3)\n}\n"
         "scenario(name=\"evening\", title=\"A summer evening\") {\n  override(of=\"%dayLight\", "
         "timeOfDay=20.2)\n}\n"
         "scenario(name=\"night\", title=\"Night\") {\n  override(of=\"%dayLight\", timeOfDay=22.2)\n}\n";
}

std::string cameras() {
  return camera("square", {-24.5f, -18.0f, 1.7f}, {0.0f, 6.5f, 5.0f}, 68) +
         camera("at the fountain", {-19.0f, -3.0f, 1.7f}, {-2.0f, 4.5f, 4.4f}, 62) +
         camera("gallery", {-30.0f, 36.2f, 1.75f}, {20.0f, 35.6f, 2.4f}, 66) +
         camera("balcony", {-24.0f, -33.0f, 10.8f}, {2.0f, 10.0f, 3.0f}, 66) +
         camera("kerb", {5.0f, -20.6f, 1.5f}, {14.0f, -28.0f, 1.4f}, 60) +
         camera("tram stop", {16.0f, 3.5f, 1.7f}, {-8.0f, 14.5f, 2.8f}, 60) +
         camera("eastern side", {35.4f, -17.0f, 1.65f}, {41.0f, 40.0f, 5.0f}, 62) +
         camera("northern facades", {-22.0f, 8.0f, 1.7f}, {-26.0f, 34.0f, 9.0f}, 62) +
         camera("above", {-70.0f, -75.0f, 62.0f}, {2.0f, 4.0f, 0.0f}, 52) +
         "camera(name=\"car\", follows=\"vehicle 1\", offset=\"4.6 3.6 1.2\", fov_deg=58)\n"
         "camera(name=\"by the tram\", follows=\"line 1 1\", offset=\"16 -9 2.2\", fov_deg=62)\n" +
         // Half a minute through the square: what a film of it shows.
         camera("round 1", {-43.0f, -20.0f, 11.0f}, {0.0f, 4.0f, 3.5f}, 64) +
         camera("round 2", {-27.0f, -16.0f, 3.0f}, {-2.0f, 4.0f, 4.6f}, 64) +
         camera("round 3", {-8.0f, -14.5f, 1.8f}, {-6.0f, 10.0f, 4.6f}, 64) +
         camera("round 4", {12.0f, -11.0f, 1.8f}, {2.0f, 12.0f, 4.2f}, 64) +
         camera("round 5", {24.0f, -17.0f, 1.7f}, {38.0f, -22.0f, 1.8f}, 64) +
         camera("round 6", {33.0f, -18.5f, 1.7f}, {45.0f, 6.0f, 3.2f}, 64) +
         "tour(name=\"round\") {\n"
         "  stop(time_s=0, camera=\"round 1\")\n  stop(time_s=6, camera=\"round 2\")\n"
         "  stop(time_s=13, camera=\"round 3\")\n  stop(time_s=19, camera=\"round 4\")\n"
         "  stop(time_s=25, camera=\"round 5\")\n  stop(time_s=30, camera=\"round 6\")\n}\n";
}

}  // namespace

std::string light_script() {
  return "// The light of the square: a summer afternoon in Nice. Generated by `parvis city square`.\n"
         "dayLight(latitude=43.70, longitude=7.27, standardMeridian=2, julianDay=172, timeOfDay=16.6, "
         "turbidity=2.6)\nskyDome(texture=\"sky.hdr\")\nair(haze_per_m=0.0006)\n";
}

std::string place_script() {
  return fmt::format(
      "// The square as it is, without anything that moves: generated by `parvis city square`.\n"
      "include(file=\"light.xp\")\n"
      "model(name=\"houses\", file=\"square.glb\")\n"
      "model(name=\"fountain\", file=\"fountain.glb\", position=\"{:.2f} {:.2f} {:.2f}\", heading_deg=135, "
      "reflective=1)\n",
      fountain_at.x, fountain_at.y, kerb_m);
}

std::string life_script(std::span<const std::string> vehicle_files) {
  std::string text =
      "// Lamps, tram, traffic, people, sound, designs, scenarios and views of the square: generated "
      "by `parvis city square`.\n"
      "realism()\nreflection(method=\"multiple_environment_maps\", resolution=128)\n" +
      lamps() + roads() + tram() + "traffic(vehicles=14, seed=7, centre=\"12 -22 0\", radius=100) {\n";
  for (const std::string& file : vehicle_files)
    text += fmt::format("  model(file=\"{}\", reflective=1)\n", file);
  text += fmt::format(
      "}}\ncrowd(people=60, seed=5, centre=\"-6 2 0\", radius=48)\n"
      "sound(kind=\"fountain\", position=\"{:.2f} {:.2f} {:.2f}\")\n"
      "sound(kind=\"murmur\", position=\"-31 -13 1.2\")\n"
      "lamp(of=\"street lamp *\", position=\"0 0 4.45\", flux_lm=8000, colour=\"1 0.68 0.34\", reach=26, "
      "radius=0.34)\n"
      "lamp(of=\"vehicle *\", part=\"lamp\", direction=\"1 0 -0.07\", angle_deg=50, flux_lm=900, colour=\"1 "
      "0.88 0.68\", reach=32, radius=0.26)\n\n",
      fountain_at.x, fountain_at.y, kerb_m + spout_m);
  return text + designs() + scenarios() + "\n" + cameras();
}

std::string square_script() {
  return "// An arcaded square in the spirit of Place Garibaldi in Nice, generated by `parvis city square`.\n"
         "//\n//   parvis view square.xp\n//   parvis render square.xp --camera square --time 20 -o "
         "square.png\n"
         "include(file=\"place.xp\")\ninclude(file=\"life.xp\")\nbouncedLight()\nexposure(value=1)\n" +
         planes();
}

}  // namespace parvis::square
