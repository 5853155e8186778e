// parvis facade calibrate: cameras and points of photographs, by COLMAP.
#include "facade_calibrate.h"

#include <memory>

#include "facade_stages.h"

namespace parvis {

void CalibrationArguments::add(CLI::App& stage) {
  stage.add_option("photographs", job.pictures, "Folder of the photographs")
      ->required()
      ->check(CLI::ExistingDirectory);
  stage.add_option("-o,--output", job.folder, "Folder to write to; it keeps what is finished")->required();
  stage.add_option(
      "--cameras", job.cameras,
      "Cameras that are known: a COLMAP model, a folder of .camera files, .json, .wrl, .gltf, or a text with "
      "camera=\"x y z h p r fov aspect\"");
  stage.add_option("--lens", job.lens, "COLMAP's camera model")->capture_default_str();
  stage.add_flag("!--lens-per-photograph", job.one_lens_for_all, "The zoom or the camera was changed");
  stage.add_option("--features", job.max_features, "Features per photograph; more take longer")
      ->capture_default_str()
      ->check(CLI::Range(500, 50000));
  stage.add_option("--scale", job.scale, "Metres per unit of the reconstruction")->check(CLI::PositiveNumber);
  stage.add_option("--distance", distance, "Two photographs, and the metres between where they were taken")
      ->expected(3);
}

Status CalibrationArguments::run() {
  if (!distance.empty()) {
    char* end = nullptr;
    const double metres = std::strtod(distance[2].c_str(), &end);
    if (*end != '\0' || !(metres > 0.0))
      return error("--distance: expected two photographs and metres > 0, found \"{}\"", distance[2]);
    job.distance = {distance[0], distance[1], metres};
  }
  const Result<photographs::LoadedSet> loaded = photographs::calibrate(job);
  if (!loaded) return loaded.errors();
  fmt::print("{}", photographs::calibration_report(loaded->set));
  fmt::print(stderr, "{}", to_string(loaded->problems));
  if (job.cameras.empty() && !job.distance && job.scale == 1.0)
    fmt::print(
        stderr,
        "note: lengths are no metres: give --distance A B METRES between two photographs, or --scale\n");
  fmt::print("written to {}\n", job.folder.string());
  return Ok{};
}

void add_facade_calibrate(CLI::App& stage, Chosen& chosen) {
  const auto arguments = std::make_shared<CalibrationArguments>();
  arguments->add(stage);
  stage.footer(
      "Example: parvis facade calibrate photographs/ -o courtyard --distance 0001.jpg 0009.jpg 12.5");
  stage.callback([arguments, &chosen] { chosen = [arguments] { return arguments->run(); }; });
}

}  // namespace parvis
