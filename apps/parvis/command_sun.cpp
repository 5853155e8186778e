// parvis sun: hours of direct sun over a scene.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "base/progress.h"
#include "commands.h"
#include "dates.h"
#include "graphics/gl/context.h"
#include "graphics/light/day_light.h"
#include "machines/processes.h"
#include "planning/sun_hours/sun_study.h"
#include "scene/script/attribute.h"
#include "scene_arguments.h"
#include "stage/film.h"

namespace parvis {
namespace {

struct SunArguments {
  SceneArguments scene;
  std::string from, to, date;
  std::vector<double> place, area;
  std::vector<std::string> ground;
  std::optional<std::string> outline;
  std::optional<double> clock_h;
  double cell_m = 2.0;
  int every = 1;
  bool is_ground_only = false;
  std::filesystem::path output, film;
  double film_step_min = 5.0;
};

constexpr int max_days = 366;

/// The place of the scene's dayLight, or --place with its clock: by default that of the sun in whole hours.
light::PlaceAndTime read_place(const SunArguments& arguments, const scene::Scene& scene) {
  light::PlaceAndTime place = scene.data<light::DayLight>().when;
  place.true_north_deg = scene.true_north_deg;
  if (arguments.place.empty()) return place;
  place.latitude_deg = arguments.place[0], place.longitude_deg = arguments.place[1];
  place.time_zone_h = arguments.clock_h.value_or(std::round(place.longitude_deg / 15.0));
  return place;
}

/// The period from --from to --to.
Result<sun_hours::SunPeriod> read_period(const SunArguments& arguments, const scene::Scene& scene) {
  const light::DayLight& day = scene.data<light::DayLight>();
  sun_hours::SunPeriod period{.place = read_place(arguments, scene), .day_step = arguments.every};
  if (arguments.place.empty() && !day.is_given)
    return error(
        "the scene has no place on the earth: add dayLight(latitude=, longitude=) to it or give --place "
        "LATITUDE LONGITUDE");
  const Result<std::pair<int, int>> from = read_date(arguments.from);
  const Result<std::pair<int, int>> to = read_date(arguments.to.empty() ? arguments.from : arguments.to);
  if (!from) return from.errors();
  if (!to) return to.errors();
  int last_day = to->second;
  for (int year = from->first; year < to->first; ++year) last_day += light::days_in_year(year);
  if (from->first > to->first || from->second > last_day || last_day - from->second >= max_days)
    return error("--from {} --to {}: expected two dates, the earlier first, with {} days at most",
                 arguments.from, arguments.to, max_days);
  period.place.year = from->first, period.first_day = from->second, period.last_day = last_day;
  period.place.day_of_year = from->second, period.place.time_of_day_h = 12.0;
  if (Status status = check(period.place); !status) return status.errors();
  return period;
}

/// Corners out of "x y, x y, ...", which lie in the area of the study.
Result<std::vector<glm::dvec2>> read_outline(const SunArguments& arguments) {
  std::vector<glm::dvec2> corners;
  if (!arguments.outline) return corners;
  const Result<scene::AttributeValue> points =
      scene::parse_value(scene::attribute::points("--outline", ""), *arguments.outline, Roots(""), {});
  if (!points) return points.errors();
  for (const glm::vec3 point : std::get<std::vector<glm::vec3>>(*points)) corners.emplace_back(point);
  const std::vector<double>& area = arguments.area;
  for (const glm::dvec2 corner : corners) {
    const bool is_inside =
        area.empty() || (corner.x >= std::min(area[0], area[2]) && corner.x <= std::max(area[0], area[2]) &&
                         corner.y >= std::min(area[1], area[3]) && corner.y <= std::max(area[1], area[3]));
    if (!is_inside)
      return error("--outline: the corner {:g} {:g} lies outside of --area: no hours are studied there",
                   corner.x, corner.y);
  }
  Result<std::vector<glm::dvec2>> checked = sun_hours::checked_outline(std::move(corners));
  if (!checked) return error("--outline: {}", checked.errors().front().message);
  return checked;
}

/// The scene with what visitors may move at the place where the script puts it: it casts its shadow there.
scene::Scene as_it_stands(const stage::Simulation& simulation) {
  scene::Scene scene = simulation.scene;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (!scene.objects[i].is_dynamic) continue;
    const scene::Node* maker = simulation.live().maker_of(scene, int(i));
    const bool is_grabbed = maker && maker->schema->find("grab") && maker->flag("grab");
    if (is_grabbed && scene.objects[i].played.animation == scene::no_index)
      scene.objects[i].is_dynamic = false;
  }
  return scene;
}

/// Name of the ground that is judged, as the command line says it.
std::string judged_ground(const SunArguments& arguments) {
  if (arguments.ground.empty()) return arguments.outline ? "open ground in the outline" : "open ground";
  return fmt::format("ground \"{}\"{}", fmt::join(arguments.ground, "\", \""),
                     arguments.outline ? " in the outline" : "");
}

void print_rule(const SunArguments& arguments, const sun_hours::SunStudy& study,
                const sun_hours::SunPeriod& period) {
  const sun_hours::OpenSpaceRule rule = sun_hours::open_space_rule(study);
  if (rule.area_m2 == 0.0) {
    fmt::print("no open ground: the rule of BRE 209 does not apply\n");
    return;
  }
  const bool is_equinox =
      period.first_day == light::day_of_year(period.place.year, 3, 21) && period.last_day == period.first_day;
  fmt::print("{}: {}{}\n", judged_ground(arguments), to_string(rule),
             !is_equinox      ? " (BRE 209 asks for 21 March: --from 2026-03-21)"
             : rule.is_kept() ? ": BRE 209 is kept (half of it)"
                              : ": BRE 209 is NOT kept (it asks for half of it)");
}

/// The hours as a clock shows them.
std::string clock_time(double hours) {
  const int minutes = int(std::lround(60.0 * hours) + 24 * 60) % (24 * 60);
  return fmt::format("{:02}:{:02}", minutes / 60, minutes % 60);
}

/// When the sun passes the horizon between 0 and 24 o'clock of a date, in order: a night beside midnight may
/// give it a setting more than the day between two nights has.
std::vector<std::pair<double, std::string>> passings(const light::PlaceAndTime& day) {
  constexpr double same_h = 1.0 / 60.0;
  std::vector<std::pair<double, std::string>> found;
  for (const double shift : {-24.0, 0.0, 24.0}) {
    const light::DaylightHours hours = light::daylight_hours(light::at_hour(day, 12.0 + shift));
    for (const auto& [hour, name] : {std::pair(hours.rise_h, "sunrise"), {hours.set_h, "sunset"}}) {
      if (!hour || *hour + shift < 0.0 || *hour + shift >= 24.0) continue;
      const bool is_known = std::ranges::any_of(
          found, [&](const auto& each) { return std::abs(each.first - *hour - shift) < same_h; });
      if (!is_known) found.emplace_back(*hour + shift, name);
    }
  }
  std::ranges::sort(found);
  return found;
}

void print_daylight(const light::PlaceAndTime& day, const std::string& date) {
  std::vector<std::string> said;
  for (const auto& [hour, name] : passings(day)) said.push_back(fmt::format("{} {}", name, clock_time(hour)));
  if (said.empty())
    return fmt::print("{}: the sun does not {}\n", date,
                      light::daylight_hours(day).is_polar_night() ? "rise" : "set");
  if (said.size() == 1) said.emplace_back(said[0].starts_with("sunset") ? "no sunrise" : "no sunset");
  fmt::print("{}: {}, at UTC{:+g}\n", date, fmt::join(said, ", "), day.time_zone_h);
}

/// Where the sun stands on a day, without a scene: rise and set, its highest position, and each hour.
Status print_positions(const SunArguments& arguments) {
  if (arguments.place.empty())
    return error("--date asks where the sun stands: give --place LATITUDE,LONGITUDE");
  const Result<std::pair<int, int>> date = read_date(arguments.date);
  if (!date) return date.errors();
  light::PlaceAndTime day = read_place(arguments, {});
  day.year = date->first, day.day_of_year = date->second;
  if (Status status = check(day); !status) return status;
  print_daylight(day, arguments.date);
  const auto print = [&](double hour, const std::string& name) {
    const light::SolarPosition sun = light::sun_of(light::at_hour(day, hour));
    fmt::print("{} {:>8.3f} {:>9.3f}{}\n", clock_time(hour), sun.azimuth_deg, sun.elevation_deg(), name);
  };
  fmt::print("clock  azimuth elevation (degrees, from north clockwise; with refraction)\n");
  const double highest_h = light::daylight_hours(day).noon_h;
  for (int hour = 0; hour < 24; ++hour) {
    print(hour, "");
    if (highest_h >= hour && highest_h < hour + 1) print(highest_h, "  highest");
  }
  return Ok{};
}

Status study(const SunArguments& arguments) {
  Result<std::vector<glm::dvec2>> outline = read_outline(arguments);
  if (!outline) return outline.errors();
  const Result<machines::Processes> processes = machines::Processes::join();
  if (!processes) return processes.errors();
  const Result<stage::Simulation> simulation = arguments.scene.open_simulation();
  if (!simulation) return simulation.errors();
  const Result<sun_hours::SunPeriod> period = read_period(arguments, simulation->scene);
  if (!period) return period.errors();
  sun_hours::SunStudyOptions options{.period = *period,
                                     .cell_m = arguments.cell_m,
                                     .area = {},
                                     .has_facades = !arguments.is_ground_only,
                                     .judged = {arguments.ground, *std::move(outline)},
                                     .processes = *processes};
  if (!arguments.area.empty())
    options.area = glm::dvec4(arguments.area[0], arguments.area[1], arguments.area[2], arguments.area[3]);
  const Result<sun_hours::SunStudy> result = sun_hours::study_sun(as_it_stands(*simulation), options);
  if (!result) return result.errors();
  if (processes->is_first())
    if (Status status = sun_hours::write_sun_study(arguments.output, *result); !status) return status;
  processes->leave();

  if (result->covered_m2 > 0.0)
    fmt::print(
        stderr,
        "warning: {:.0f} m2 of ground lie under surfaces that face down alone; is a building inside out? "
        "They count as built\n",
        result->covered_m2);
  print_daylight(period->place, arguments.from);
  fmt::print(
      "hours of sun per day, of {:.1f} on an open plain: {}.png, .csv{}\n", result->max_hours,
      arguments.output.string(),
      result->surfaces.indices.empty() ? "" : ", _facades.csv, .glb with its colours in _sun_hours.jpg");
  print_rule(arguments, *result, *period);
  return Ok{};
}

/// The day's shadows as a film: the hours while the sun is up, a frame every few minutes.
Status film_day(const SunArguments& arguments) {
  int width = 0, height = 0;
  if (Status status = arguments.scene.read_size(width, height); !status) return status;
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  Result<std::unique_ptr<stage::Stage>> stage = arguments.scene.open_stage();
  if (!stage) return stage.errors();
  stage::Simulation& simulation = (*stage)->simulation();
  scene::LiveScene& live = simulation.live();
  const scene::Node* node = live.find("%dayLight");
  if (!node) return error("a film of the day's shadows needs a scene with dayLight(...)");
  const Result<std::pair<int, int>> date = read_date(arguments.from);
  if (!date) return date.errors();
  light::PlaceAndTime day = read_place(arguments, simulation.scene);
  day.year = date->first, day.day_of_year = date->second;
  if (Status status = check(day); !status) return status.errors();
  const light::DaylightHours hours = light::daylight_hours(day);
  if (hours.is_polar_night()) return error("the sun does not rise on {}", arguments.from);
  const bool is_whole_day = hours.sets_first() || !hours.rise_h || !hours.set_h;
  const double from = is_whole_day ? 0.0 : *hours.rise_h, to = is_whole_day ? 23.99 : *hours.set_h;

  Result<stage::Film> film = stage::Film::open(arguments.film, width, height, 25);
  if (!film) return film.errors();
  live.set(*node, "latitude", day.latitude_deg);
  live.set(*node, "longitude", day.longitude_deg);
  live.set(*node, "standardMeridian", day.time_zone_h);
  const int frames = int((to - from) * 60.0 / arguments.film_step_min) + 1;
  Progress progress("film of the day", std::size_t(frames));
  for (int i = 0; i < frames; ++i, progress.advance()) {
    const light::PlaceAndTime now = light::at_hour(day, from + i * arguments.film_step_min / 60.0);
    live.set(*node, "year", long(now.year));
    live.set(*node, "julianDay", long(now.day_of_year));
    live.set(*node, "timeOfDay", now.time_of_day_h);
    if (const Errors errors = live.refresh(simulation.scene); !errors.empty()) return errors;
    simulation.clock.follow(simulation.scene);
    simulation.settle();
    const Result<Camera> camera = (*stage)->camera(arguments.scene.camera);
    if (!camera) return camera.errors();
    (*stage)->draw(*camera, width, height);
    if (Status status = film->add((*stage)->picture()); !status) return status;
  }
  return film->finish();
}

Status run(const SunArguments& arguments) {
  if (!arguments.date.empty()) return print_positions(arguments);
  if (arguments.scene.scene.empty() || arguments.from.empty())
    return error("give a scene and --from DATE for hours of sun, or --place and --date for the sun alone");
  if (arguments.film.empty() == arguments.output.empty())
    return error("give either -o PREFIX for hours of sun, or --film FILE for the shadows of the day");
  if (arguments.film.empty()) return study(arguments);
  const Result<machines::Processes> processes = machines::Processes::join();
  if (!processes) return processes.errors();
  if (processes->is_first())
    if (Status status = film_day(arguments); !status) return status;
  processes->leave();
  return Ok{};
}

}  // namespace

void add_sun(CLI::App& app, Chosen& chosen) {
  CLI::App* command = app.add_subcommand(
      "sun", "Hours of direct sun over ground and facades, as a plan, a table and a model");
  const auto arguments = std::make_shared<SunArguments>();
  arguments->scene.add_scene(*command);
  arguments->scene.add_state(*command);
  command->get_option("scene")->required(false);
  command->add_option("--from", arguments->from, "First day, as 2026-03-21");
  command->add_option("--to", arguments->to, "Last day (default: the first)");
  command->add_option("--every", arguments->every, "One day stands for so many")
      ->check(CLI::Range(1, 366))
      ->capture_default_str();
  command
      ->add_option("--place", arguments->place,
                   "Latitude and longitude (east positive) in place of the scene's: 43.7,7.26")
      ->delimiter(',')
      ->expected(2);
  command
      ->add_option(
          "--date", arguments->date,
          "Without a scene: print where the sun stands at --place on this day, when it rises and sets")
      ->excludes("--from")
      ->needs("--place");
  command
      ->add_option("--clock", arguments->clock_h,
                   "Hours by which the clock of --place is ahead of universal time (default: longitude / 15, "
                   "in whole hours)")
      ->check(CLI::Range(-12.0, 14.0))
      ->needs("--place");
  command
      ->add_option("--area", arguments->area, "x and y of two corners in metres (default: the whole scene)")
      ->expected(4);
  CLI::Option* ground =
      command
          ->add_option("--ground", arguments->ground,
                       "What the rule for open space judges: objects of this name, or parts or materials of "
                       "their models; * and ? stand for other text; may repeat (default: all open ground)")
          ->allow_extra_args(false);
  CLI::Option* outline = command->add_option("--outline", arguments->outline,
                                             "Corners of the ground that it judges, as \"x y, x y, x y\" in "
                                             "metres; with --ground, what lies in both");
  command->add_option("--cell", arguments->cell_m, "Size of a cell in metres")
      ->check(CLI::Range(0.05, 1000.0))
      ->capture_default_str();
  command->add_flag("--ground-only", arguments->is_ground_only, "No facades: no model");
  command->add_option("-o,--output", arguments->output, "Prefix of the files to write");
  command
      ->add_option("--film", arguments->film, "In their place: a film of the shadows of the first day (.mp4)")
      ->excludes(ground, outline);
  command->add_option("--step", arguments->film_step_min, "Of the film: minutes between frames")
      ->check(CLI::Range(0.1, 120.0))
      ->capture_default_str();
  arguments->scene.add_camera(*command);
  command->add_option("--size", arguments->scene.size, "Of the film: width x height in pixels")
      ->capture_default_str();
  command->footer(
      "Example: parvis sun out/paper/paper_day.xp --from 2026-03-21 --area -120 -120 120 120 -o out/sun\n"
      "Example: parvis sun place.xp --from 2026-03-21 --outline \"-40 -40, 40 -40, 0 40\" -o out/square\n"
      "Example: parvis sun place.xp --from 2026-03-21 --ground \"square*\" -o out/square\n"
      "Example: parvis sun --place 43.7,7.26 --clock 2 --date 2026-06-21\n"
      "Example: parvis sun out/paper/paper_day.xp --from 2026-06-21 --camera plan --film out/shadows.mp4\n"
      "Started by mpirun, several processes or machines divide the hours of sun: the same files, sooner.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

}  // namespace parvis
