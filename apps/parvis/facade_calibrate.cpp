// parvis facade calibrate: cameras and points of photographs, by COLMAP.
#include <memory>

#include "capture/photographs/calibrate.h"
#include "facade_stages.h"

namespace parvis {
namespace {

struct Arguments {
  photographs::CalibrationJob job;
  std::vector<std::string> distance;
};

Status calibrate(Arguments& arguments) {
  if (!arguments.distance.empty()) {
    char* end = nullptr;
    const double metres = std::strtod(arguments.distance[2].c_str(), &end);
    if (*end != '\0' || !(metres > 0.0))
      return error("--distance: expected two photographs and metres > 0, found \"{}\"",
                   arguments.distance[2]);
    arguments.job.distance = {arguments.distance[0], arguments.distance[1], metres};
  }
  const Result<photographs::LoadedSet> loaded = photographs::calibrate(arguments.job);
  if (!loaded) return loaded.errors();
  fmt::print("{}", photographs::calibration_report(loaded->set));
  fmt::print(stderr, "{}", to_string(loaded->problems));
  fmt::print("written to {}\n", arguments.job.folder.string());
  return Done{};
}

}  // namespace

void add_facade_calibrate(CLI::App& stage, Chosen& chosen) {
  const auto arguments = std::make_shared<Arguments>();
  stage.add_option("photographs", arguments->job.pictures, "Folder of the photographs")
      ->required()
      ->check(CLI::ExistingDirectory);
  stage.add_option("-o,--output", arguments->job.folder, "Folder to write to; it keeps what is finished")
      ->required();
  stage.add_option(
      "--cameras", arguments->job.cameras,
      "Cameras that are known: a COLMAP model, a folder of .camera files, .json, .wrl, .gltf, or a text with "
      "camera=\"x y z h p r fov aspect\"");
  stage.add_option("--lens", arguments->job.lens, "COLMAP's camera model")->capture_default_str();
  stage.add_flag("!--lens-per-photograph", arguments->job.one_lens_for_all,
                 "The zoom or the camera was changed");
  stage.add_option("--features", arguments->job.max_features, "Features per photograph; more take longer")
      ->capture_default_str()
      ->check(CLI::Range(500, 50000));
  stage.add_option("--scale", arguments->job.scale, "Metres per unit of the reconstruction")
      ->check(CLI::PositiveNumber);
  stage
      .add_option("--distance", arguments->distance,
                  "Two photographs, and the metres between where they were taken")
      ->expected(3);
  stage.footer(
      "Example: parvis facade calibrate photographs/ -o courtyard --distance 0001.jpg 0009.jpg 12.5");
  stage.callback([arguments, &chosen] { chosen = [arguments] { return calibrate(*arguments); }; });
}

}  // namespace parvis
