// parvis facade model: proposes a coarse model of the place, corrected by a file of hints; or trims a scan.
#include <filesystem>
#include <memory>

#include "capture/facades/coarse_model_file.h"
#include "capture/facades/place_model.h"
#include "facade_place.h"
#include "facade_stages.h"

namespace parvis {
namespace {

struct FacadeModelArguments {
  std::filesystem::path folder, output, scan;
  facades::ModelSettings settings;
  bool overwrites = false;
};

Status propose_model(const FacadeModelArguments& arguments) {
  const std::filesystem::path file =
      arguments.output.empty() ? arguments.folder / "model.glb" : arguments.output;
  std::error_code code;
  if (!arguments.overwrites && std::filesystem::exists(file, code))
    return error(
        "{} is there already, perhaps corrected by hand; give --overwrite to replace it, or another file "
        "with --output",
        file.string());
  if (!arguments.scan.empty()) {
    if (Status status = write_trimmed_scan(arguments.folder, arguments.scan, file); !status) return status;
    fmt::print("written to {}\n", file.string());
    return Ok{};
  }
  const Result<facades::PlaceModel> model =
      facades::propose_place_model(arguments.folder, arguments.settings);
  if (!model) return model.errors();
  fmt::print(stderr, "{}", to_string(model->notes));
  if (Status status = facades::write_meshes(file, model->meshes); !status) return status;
  for (const facades::CoarseSurface& surface : model->planes.surfaces) {
    fmt::print("{:<12} {:>6} points ", surface.name, surface.points);
    for (const glm::dvec3& corner : surface.corners)
      fmt::print(" ({:.2f} {:.2f} {:.2f})", corner.x, corner.y, corner.z);
    fmt::print("\n");
  }
  fmt::print("written to {}\n", file.string());
  return Ok{};
}

}  // namespace

void add_facade_model(CLI::App& stage, Chosen& chosen) {
  const auto arguments = std::make_shared<FacadeModelArguments>();
  stage.add_option("folder", arguments->folder, "Folder of calibrated photographs")
      ->required()
      ->check(CLI::ExistingDirectory);
  CLI::Option* hints = stage.add_option(
      "--hints", arguments->settings.hints,
      "Corrections, one per line: remove NAME, rename NAME NEW, top|bottom NAME Z, left|right NAME X Y, "
      "plane NAME X Y Z X Y Z X Y Z ...");
  hints->check(CLI::ExistingFile);
  CLI::Option* flat = stage.add_flag("!--flat", arguments->settings.finds_relief,
                                     "Leave surfaces flat: no relief is searched");
  stage.add_option("--scan", arguments->scan, scan_help)
      ->check(CLI::ExistingFile)
      ->excludes(hints)
      ->excludes(flat);
  stage.add_option("-o,--output", arguments->output,
                   "glTF file (.glb) to write; FOLDER/model.glb where it is not given");
  stage.add_flag("--overwrite", arguments->overwrites, "Replace a model that is there");
  stage.footer("Example: parvis facade model courtyard --hints corrections.txt --overwrite");
  stage.callback([arguments, &chosen] { chosen = [arguments] { return propose_model(*arguments); }; });
}

}  // namespace parvis
