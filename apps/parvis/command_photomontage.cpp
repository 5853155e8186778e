// parvis photomontage: a design in a photograph of the place.
#include <algorithm>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/files.h"
#include "base/image_io.h"
#include "capture/photographs/camera_files.h"
#include "capture/photographs/clicked_camera.h"
#include "capture/photographs/picture.h"
#include "capture/photographs/picture_header.h"
#include "capture/photographs/set_file.h"
#include "commands.h"
#include "graphics/light/day_light_time.h"
#include "planning/design/design_nodes.h"
#include "planning/photomontage/caption.h"
#include "planning/photomontage/montage.h"
#include "scene_arguments.h"
#include "stage/output_names.h"

namespace parvis {
namespace {

struct MontageArguments {
  SceneArguments scene;
  std::filesystem::path photograph, cameras, points, in_front, output = "montage.png", report;
  std::string design, date, hour, grey;
  std::optional<double> clock_h, brightness;
  bool is_without_caption = false;
};

struct Moment {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0;
};

/// The moment of --date and --hour, else what the camera wrote; nothing where neither says it.
Result<std::optional<Moment>> moment_of(const MontageArguments& arguments, const std::string& taken) {
  Moment moment;
  int read = 0;
  if (arguments.date.empty() != arguments.hour.empty())
    return error("--date and --hour go together: --date 2026-06-21 --hour 14:15");
  if (arguments.date.empty()) {
    const int count = std::sscanf(taken.c_str(), "%4d:%2d:%2d %2d:%2d", &moment.year, &moment.month,
                                  &moment.day, &moment.hour, &moment.minute);
    if (count != 5 || moment.month < 1 || moment.month > 12) return std::optional<Moment>();
    return std::optional(moment);
  }
  if (std::sscanf(arguments.date.c_str(), "%4d-%2d-%2d%n", &moment.year, &moment.month, &moment.day, &read) !=
          3 ||
      std::size_t(read) != arguments.date.size() || moment.month < 1 || moment.month > 12 || moment.day < 1 ||
      moment.day > 31)
    return error("--date {}: expected a day as 2026-06-21", arguments.date);
  if (std::sscanf(arguments.hour.c_str(), "%2d:%2d%n", &moment.hour, &moment.minute, &read) != 2 ||
      std::size_t(read) != arguments.hour.size() || moment.hour > 23 || moment.minute > 59 ||
      moment.hour < 0 || moment.minute < 0)
    return error("--hour {}: expected a time as 14:15", arguments.hour);
  return std::optional(moment);
}

/// Sets the scene's sun and sky; false where the scene has another sun than dayLight's.
Result<bool> light_as_of(stage::Simulation& simulation, const Moment& moment,
                         const std::optional<double>& clock_h) {
  scene::LiveScene& live = simulation.live();
  const scene::Node* day = live.find("%dayLight");
  if (!day) return false;
  const auto hold = [&](const std::string& attribute, const std::string& value) {
    return live.hold(*day, attribute, value);
  };
  Status status = hold("year", std::to_string(moment.year));
  if (status)
    status = hold("julianDay", std::to_string(light::day_of_year(moment.year, moment.month, moment.day)));
  if (status) status = hold("timeOfDay", fmt::format("{}", moment.hour + moment.minute / 60.0));
  if (status && clock_h) status = hold("standardMeridian", fmt::format("{}", *clock_h));
  if (!status) return status.errors();
  if (Errors errors = live.refresh(simulation.scene); !errors.empty()) return errors;
  simulation.settle();
  return true;
}

/// The camera of the photograph's name among those that are given.
Result<photographs::Photograph> listed_camera(const MontageArguments& arguments) {
  const bool is_set = std::filesystem::exists(arguments.cameras / "photographs.json");
  const Result<photographs::LoadedSet> loaded =
      is_set ? photographs::read_photograph_set(arguments.cameras)
             : photographs::read_cameras(arguments.cameras, arguments.photograph.has_parent_path()
                                                                ? arguments.photograph.parent_path()
                                                                : std::filesystem::path("."));
  if (!loaded) return loaded.errors();
  std::vector<std::string> names;
  for (const photographs::Photograph& each : loaded->set.photographs) {
    names.push_back(each.name);
    if (std::filesystem::path(each.name).filename() == arguments.photograph.filename()) return each;
  }
  const std::string name = arguments.photograph.filename().string();
  return error("{}: has no camera of the photograph {}{}", arguments.cameras.string(), name,
               names_that_exist(name, names));
}

Result<photographs::Photograph> clicked_camera(const MontageArguments& arguments,
                                               const photographs::PictureHeader& header) {
  const Result<std::string> text = read_file(arguments.points, 16u << 20);
  if (!text) return text.errors();
  const auto points = photographs::parse_clicked_points(*text, arguments.points.string());
  if (!points) return points.errors();
  std::optional<double> focal_px;
  if (header.focal_length_35mm_mm > 0.0)
    focal_px = header.focal_length_35mm_mm / 36.0 * std::max(header.width, header.height);
  const Result<photographs::ClickedCamera> found =
      photographs::camera_of_points(*points, header.width, header.height, focal_px);
  if (!found) return error("{}: {}", arguments.points.string(), found.errors().front().message);
  const glm::dvec3 eye = found->photograph.position_in_world();
  fmt::print("camera at {:.3f},{:.3f},{:.3f}; focal length {:.0f} pixels\n", eye.x, eye.y, eye.z,
             photographs::focal_px(found->photograph.lens).x);
  for (std::size_t i = 0; i < points->size(); ++i)
    fmt::print("point {} is shown {:.2f} pixels from its click\n", i + 1, found->errors_px[i]);
  return found->photograph;
}

/// The photograph's camera by --cameras, --points or --camera, with the size of the picture.
Result<photographs::Photograph> photograph_camera(const MontageArguments& arguments,
                                                  const photographs::PictureHeader& header,
                                                  const stage::Simulation& simulation) {
  if (!arguments.cameras.empty() && !arguments.points.empty())
    return error("--cameras and --points each give the photograph's camera; give one of them");
  if (!arguments.points.empty()) return clicked_camera(arguments, header);
  if (!arguments.cameras.empty()) return listed_camera(arguments);
  if (arguments.scene.camera.empty())
    return error(
        "the photograph's camera is not given: --cameras FILE (of COLMAP and others), --points FILE (six "
        "points "
        "clicked in it), or --camera NAME (of the scene)");
  const Result<Camera> named = simulation.camera(arguments.scene.camera);
  if (!named) return named.errors();
  if (named->parallel || named->off_axis)
    return error("--camera {}: a plan or a display wall takes no photograph", arguments.scene.camera);
  photographs::Photograph photograph = photographs::photograph_of(*named, "", header.width, header.height);
  return photograph;
}

/// Whether a camera sees the photograph as it is stored, whichever side of it is up.
bool sees_stored(const photographs::Lens& lens, const photographs::PictureHeader& header) {
  return lens.width == header.width && lens.height == header.height;
}

/// The header of the picture as it is shown.
photographs::PictureHeader shown(photographs::PictureHeader header) {
  constexpr int first_quarter_turn = 5;
  if (header.orientation >= first_quarter_turn) std::swap(header.width, header.height);
  return header;
}

Result<photomontage::MontageJob> job_of(const MontageArguments& arguments,
                                        const photographs::PictureHeader& header,
                                        const stage::Simulation& simulation) {
  // Who clicks points, or names a camera of the scene, has seen the picture upright.
  const bool is_listed = !arguments.cameras.empty();
  Result<photographs::Photograph> found = photograph_camera(arguments, shown(header), simulation);
  if (!found) return found.errors();
  photomontage::MontageJob job;
  job.photograph = *std::move(found);
  job.photograph.name = arguments.photograph.filename().string(), job.photograph.file = arguments.photograph;
  job.photograph.mask.clear();
  Result<Image8> picture = photographs::read_picture(job.photograph);
  if (!picture) return picture.errors();
  job.picture = *std::move(picture);
  const bool is_stored = sees_stored(job.photograph.lens, header);
  if (is_stored && !is_listed) job.picture = photographs::upright(job.picture, header.orientation);
  job.brightness = arguments.brightness;
  if (!arguments.grey.empty()) {
    const std::vector<double> numbers = scene::parse_numbers(arguments.grey);
    if (numbers.size() != 2) return error("--grey {}: expected a pixel, as 320,200", arguments.grey);
    job.grey = glm::ivec2(glm::clamp(glm::dvec2(numbers[0], numbers[1]), -1.0, 1e6));
  }
  if (!arguments.in_front.empty()) {
    Result<Image8> mask = read_image8(arguments.in_front);
    if (!mask) return mask.errors();
    if (is_stored && is_listed) {  // painted over the upright picture
      const int back = header.orientation == 6 ? 8 : header.orientation == 8 ? 6 : header.orientation;
      mask = photographs::upright(*mask, back);
    }
    if (mask->width != job.picture.width || mask->height != job.picture.height)
      return error("{}: has {} x {} pixels, and the photograph {} x {}; paint it over the photograph itself",
                   arguments.in_front.string(), mask->width, mask->height, job.picture.width,
                   job.picture.height);
    job.in_front = Image8(mask->width, mask->height, 1);
    for (std::size_t i = 0; i < job.in_front.pixels.size(); ++i)
      job.in_front.pixels[i] = mask->pixels[i * std::size_t(mask->channels)];
  }
  const std::vector<const scene::Node*> designs = design::designs_of(simulation.live());
  if (designs.empty())
    return error("the scene has no design; place one by parvis plan or parvis view --plan");
  job.design = arguments.design.empty() ? designs.front()->text("name") : arguments.design;
  return job;
}

/// "4 x bench_stone, 6 x umbrella".
std::string counted(const std::vector<design::PlacedObject>& objects) {
  std::map<std::string, int> counts;
  for (const design::PlacedObject& each : objects) ++counts[each.label.empty() ? each.kind : each.label];
  std::string text;
  for (const auto& [label, count] : counts)
    text += fmt::format("{}{} x {}", text.empty() ? "" : ", ", count, label);
  return text;
}

Status write_montage_report(const MontageArguments& arguments, const photomontage::MontageJob& job,
                            const photomontage::Montage& montage, const std::string& caption) {
  if (arguments.report.empty()) return Ok{};
  const glm::dvec3 eye = job.photograph.position_in_world(), forward = job.photograph.forward_in_world();
  const nlohmann::json report{{"photograph", job.photograph.name},
                              {"design", job.design},
                              {"caption", caption},
                              {"camera",
                               {{"position", {eye.x, eye.y, eye.z}},
                                {"forward", {forward.x, forward.y, forward.z}},
                                {"focal_px", photographs::focal_px(job.photograph.lens).x}}},
                              {"brightness", montage.brightness},
                              {"covered_fraction", montage.covered},
                              {"shaded_fraction", montage.shaded}};
  return write_file(arguments.report, report.dump(2) + "\n");
}

Status make_photomontage(const MontageArguments& arguments) {
  if (Status status = arguments.scene.expect_one_scenario(); !status) return status;
  std::vector<std::filesystem::path> files{arguments.photograph, arguments.output};
  for (const std::filesystem::path& each :
       {arguments.points, arguments.cameras, arguments.in_front, arguments.report})
    if (!each.empty()) files.push_back(each);
  if (Status status = stage::check_different(files); !status) return status;
  const Result<photographs::PictureHeader> header = photographs::read_picture_header(arguments.photograph);
  if (!header) return header.errors();
  const Result<std::optional<Moment>> moment = moment_of(arguments, header->taken);
  if (!moment) return moment.errors();
  Result<stage::Simulation> simulation = arguments.scene.open_simulation();
  if (!simulation) return simulation.errors();
  std::string sun = "the sun is the scene's";
  if (*moment) {
    const Result<bool> is_lit = light_as_of(*simulation, **moment, arguments.clock_h);
    if (!is_lit) return is_lit.errors();
    if (*is_lit)
      sun = fmt::format("sun of {:04}-{:02}-{:02}, {:02}:{:02}", (*moment)->year, (*moment)->month,
                        (*moment)->day, (*moment)->hour, (*moment)->minute);
    else
      fmt::print(stderr, "warning: the scene has no dayLight(...), so that its sun stays where it is\n");
  } else {
    fmt::print(stderr,
               "warning: the photograph does not say when it was taken, so that the sun stays the scene's; "
               "--date and --hour say it\n");
  }
  const Result<photomontage::MontageJob> job = job_of(arguments, *header, *simulation);
  if (!job) return job.errors();
  const std::string objects =
      counted(design::placed_objects(simulation->scene, simulation->live(), job->design));
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  Result<std::unique_ptr<stage::Stage>> stage = stage::Stage::create(*std::move(simulation));
  if (!stage) return stage.errors();
  Result<photomontage::Montage> montage = photomontage::make_montage(**stage, *job);
  if (!montage) return montage.errors();
  if (!arguments.cameras.empty() && sees_stored(job->photograph.lens, *header))
    montage->picture = photographs::upright(montage->picture, header->orientation);
  const std::string caption = fmt::format("Photomontage: {} with design \"{}\" ({}); {}.",
                                          job->photograph.name, job->design, objects, sun);
  fmt::print("{}\nthe design covers {:.2f} % of the photograph and shades {:.2f} %\n", caption,
             100.0 * montage->covered, 100.0 * montage->shaded);
  if (!arguments.is_without_caption) {
    Result<Image8> captioned = photomontage::with_caption(montage->picture, caption);
    if (!captioned) return captioned.errors();
    montage->picture = *std::move(captioned);
  }
  if (Status status = write_montage_report(arguments, *job, *montage, caption); !status) return status;
  return write_image(arguments.output, montage->picture);
}

}  // namespace

void add_photomontage(CLI::App& app, Chosen& chosen) {
  CLI::App* command = app.add_subcommand("photomontage", "A design set into a photograph of the place");
  const auto arguments = std::make_shared<MontageArguments>();
  command
      ->add_option("photograph", arguments->photograph,
                   "JPEG, PNG, HEIC, AVIF, WebP, TIFF, or a camera's raw file")
      ->required();
  arguments->scene.add_scene(*command);
  arguments->scene.add_camera(*command);
  arguments->scene.add_state(*command);
  command->add_option(
      "--cameras", arguments->cameras,
      "Cameras of photographs, the photograph's by its name: a folder of parvis facade calibrate, "
      "or what it reads: COLMAP, .camera, JSON, viewpoints, glTF");
  command->add_option(
      "--points", arguments->points,
      "Six points or more that were clicked in the photograph: lines of \"x y X Y Z\", two pixels "
      "from the top left, then three metres in the scene");
  command->add_option("--design", arguments->design, "Name of the design (default: the scene's first)");
  command->add_option("--in-front", arguments->in_front,
                      "A picture of the photograph's size, white where something stands before the design");
  command->add_option("--date", arguments->date,
                      "Day of the sun, as 2026-06-21 (default: the photograph's EXIF)");
  command->add_option("--hour", arguments->hour, "By the clock, as 14:15");
  command
      ->add_option("--clock", arguments->clock_h,
                   "The clock's hours ahead of universal time (default: the scene's)")
      ->check(CLI::Range(-12.0, 14.0));
  command
      ->add_option("--brightness", arguments->brightness,
                   "Of the photograph over the scene's (default: by what both show)")
      ->check(CLI::Range(1e-9, 1e9));
  command->add_option(
      "--grey", arguments->grey,
      "A pixel X,Y from the top left that shows something grey or white, for the colour of the light");
  command->add_flag("--no-caption", arguments->is_without_caption,
                    "No strip below that says what was changed");
  command->add_option("--report", arguments->report, "Also write camera, brightness and areas as JSON");
  command->add_option("-o,--output", arguments->output, "The picture to write")->capture_default_str();
  command->footer(
      "Example: parvis photomontage 0003.jpg scenes/planned_square.xp --points corners.txt --date 2026-06-21 "
      "--hour 14:15 -o montage.jpg");
  command->callback([arguments, &chosen] { chosen = [arguments] { return make_photomontage(*arguments); }; });
}

}  // namespace parvis
