#include "plan_council.h"

#include <algorithm>
#include <array>

#include "base/image_io.h"
#include "base/known_names.h"
#include "base/progress.h"
#include "base/reduction.h"
#include "dates.h"
#include "graphics/light/day_light.h"
#include "planning/plan_drawing/council_sheet.h"
#include "planning/plan_drawing/plan_files.h"

namespace parvis {
namespace {

constexpr glm::ivec2 picture_px(1600, 900);
constexpr int supersample = 2;

/// Names that the scene has, or all of them where none is asked for.
Result<std::vector<std::string>> chosen_views(const scene::Scene& scene, const CouncilOptions& options) {
  std::vector<std::string> known;
  for (const scene::NamedCamera& camera : scene.cameras) known.push_back(camera.name);
  for (const std::string& name : options.views)
    if (std::ranges::find(known, name) == known.end())
      return error("--view: the scene has no camera \"{}\"{}", name.substr(0, 40),
                   names_that_exist(name, known));
  if (known.empty())
    return error("the scene has no camera to draw it from; add camera(name=, position=, target=) to it");
  return options.views.empty() ? known : options.views;
}

/// Shows these designs of two, and hides the other.
Status show(stage::Simulation& simulation, const std::string& before, const std::string& after,
            bool shows_before, bool shows_after) {
  scene::LiveScene& live = simulation.live();
  for (const auto& [name, is_shown] : {std::pair(&before, shows_before), std::pair(&after, shows_after)}) {
    const scene::Node* node = live.find(*name);
    if (!node) return error("the design \"{}\" has no objects", *name);
    live.set(*node, "visible", is_shown);
  }
  if (const Errors errors = live.refresh(simulation.scene); !errors.empty()) return errors;
  simulation.clock.follow(simulation.scene);
  simulation.settle();
  return Ok{};
}

Result<plan_drawing::SheetPicture> draw(stage::Stage& stage, const std::string& camera_name) {
  const Result<Camera> camera = stage.camera(camera_name);
  if (!camera) return camera.errors();
  stage.draw(*camera, supersample * picture_px.x, supersample * picture_px.y);
  plan_drawing::SheetPicture made{reduced(stage.picture(), supersample), {}};
  Result<std::string> jpeg = encode_image(made.image, "view.jpg");
  if (!jpeg) return jpeg.errors();
  made.jpeg = *std::move(jpeg);
  return made;
}

/// A day of the scene's place, and its name; an empty name: the scene has no place on the earth.
Result<std::pair<sun_hours::SunPeriod, std::string>> period_of(const scene::Scene& scene,
                                                               const std::string& day,
                                                               const design::Words& words) {
  constexpr std::array months{"January", "February", "March",     "April",   "May",      "June",
                              "July",    "August",   "September", "October", "November", "December"};
  const Result<std::pair<int, int>> date = read_date(day);
  if (!date) return date.errors();
  const light::DayLight& light = scene.data<light::DayLight>();
  sun_hours::SunPeriod period;
  if (!light.is_given) return std::pair(period, std::string());
  period.place = light.when;
  period.place.true_north_deg = scene.true_north_deg;
  period.place.year = date->first, period.place.day_of_year = date->second, period.place.time_of_day_h = 12.0;
  period.first_day = period.last_day = date->second;
  if (Status status = check(period.place); !status) return status.errors();
  int month = 0, number = 0;
  std::sscanf(day.c_str(), "%*d-%d-%d", &month, &number);
  return std::pair(period,
                   fmt::format("{} {} {}", number, words(months[std::size_t(month - 1)]), date->first));
}

/// The rectangle about all that differs, with room for the shadows.
glm::dvec4 studied_area(glm::dvec2 middle, glm::dvec2 half) {
  const glm::dvec2 reach = half + glm::max(glm::dvec2(6.0), 0.3 * half);
  return {middle - reach, middle + reach};
}

double cell_of(const glm::dvec4& area) {
  constexpr double cells = 180.0, min_m = 0.1;
  return std::max(min_m, std::max(area.z - area.x, area.w - area.y) / cells);
}

}  // namespace

Status write_council(stage::Stage& stage, const design::Session& session, const CouncilOptions& options) {
  stage::Simulation& simulation = stage.simulation();
  if (options.scale)
    if (Status status = plan_drawing::check_scale(*options.scale); !status) return status;
  const Result<std::vector<std::string>> views = chosen_views(simulation.scene, options);
  if (!views) return views.errors();
  plan_drawing::CouncilSheet sheet;
  sheet.words = design::words_in(options.language);
  const auto period = period_of(simulation.scene, options.day, sheet.words);
  if (!period) return period.errors();
  if (!options.link.empty()) {
    Result<plan_drawing::QrCode> code = plan_drawing::qr_code(options.link);
    if (!code) return code.errors();
    sheet.link = *std::move(code);
  }
  const auto labelled = [&](std::vector<design::PlacedObject> objects) {
    return design::labelled_in(options.language, std::move(objects));
  };
  const std::vector<design::PlacedObject> before_objects =
      labelled(design::placed_objects(simulation.scene, simulation.live(), options.before));
  sheet.title = options.title, sheet.subtitle = options.subtitle;
  sheet.before = options.before, sheet.after = session.name();
  sheet.differences = design::differences(before_objects, labelled(session.objects()));
  const auto extent = plan_drawing::extent_of(sheet.differences);
  if (!extent) return extent.errors();
  sheet.rows = plan_drawing::difference_rows(sheet.differences, sheet.words);
  sheet.centre = extent->first;
  sheet.scale = options.scale.value_or(plan_drawing::fitting_scale(extent->second));

  if (Status status = show(simulation, sheet.before, sheet.after, false, false); !status) return status;
  const scene::Scene bare = simulation.scene;
  std::vector<design::PlacedObject> staying = labelled(session.objects());
  std::erase_if(staying, [&](const design::PlacedObject& object) {
    return std::ranges::any_of(
        sheet.differences, [&](const design::Difference& each) { return each.after.name == object.name; });
  });
  for (design::PlacedObject& object : staying) object.is_visible = true;  // it is, with the design
  sheet.plan = plan_drawing::plan_of(bare, std::move(staying), {}, sheet.words);
  sheet.views.resize(views->size());
  std::array<scene::Scene, 2> scenes;
  Progress progress("council sheet", 2 * views->size() + 1);
  for (const bool is_after : {false, true}) {
    if (Status status = show(simulation, sheet.before, sheet.after, !is_after, is_after); !status)
      return status;
    for (std::size_t i = 0; i < views->size(); ++i, progress.advance()) {
      Result<plan_drawing::SheetPicture> picture = draw(stage, (*views)[i]);
      if (!picture) return picture.errors();
      sheet.views[i].name = (*views)[i];
      (is_after ? sheet.views[i].after : sheet.views[i].before) = *std::move(picture);
    }
    scenes[is_after ? 1 : 0] = simulation.scene;
  }
  if (period->second.empty()) {
    fmt::print(
        "no hours of sun: the scene has no place on the earth; add dayLight(latitude=, longitude=) to it\n");
  } else {
    const glm::dvec4 area = studied_area(extent->first, extent->second);
    Result<plan_drawing::SunDifference> sun =
        plan_drawing::sun_difference(bare, scenes[0], scenes[1], period->first, area, cell_of(area));
    if (!sun) return sun.errors();
    sheet.sun = *std::move(sun), sheet.sun_day = period->second;
  }
  progress.advance();
  if (Status status = plan_drawing::write_council_sheet(options.file, sheet); !status) return status;
  fmt::print("{}: {} views, plan at 1:{:g}, {} objects that differ{}\n", options.file.string(), views->size(),
             sheet.scale, sheet.differences.size(), sheet.sun ? ", hours of sun on " + sheet.sun_day : "");
  return Ok{};
}

}  // namespace parvis
