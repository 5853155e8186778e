// parvis facade walk: every stage, from a folder of photographs to a scene to walk through.
#include <memory>

#include "capture/facades/coarse_model_file.h"
#include "capture/facades/place_model.h"
#include "facade_calibrate.h"
#include "facade_place.h"
#include "facade_stages.h"

namespace parvis {
namespace {

struct FacadeWalkArguments {
  CalibrationArguments calibration;
  PlaceArguments place;
  std::filesystem::path scan;
};

Status walk(FacadeWalkArguments& arguments) {
  const std::filesystem::path folder = arguments.place.folder = arguments.calibration.job.folder;
  const std::filesystem::path file = folder / "model.glb";
  std::error_code code;
  // A model that is there may have been corrected: it is kept.
  const bool needs_model = arguments.place.model.empty() && !std::filesystem::exists(file, code);
  if (!needs_model && !arguments.scan.empty())
    fmt::print(stderr,
               "{} is there and is kept; parvis facade model \"{}\" --scan \"{}\" --overwrite makes it of "
               "the scan\n",
               file.string(), folder.string(), arguments.scan.string());
  if (Status status = arguments.calibration.run(); !status) return status;
  if (needs_model && !arguments.scan.empty()) {
    if (Status status = write_trimmed_scan(folder, arguments.scan, file); !status) return status;
  } else if (needs_model) {
    const Result<facades::PlaceModel> model = facades::propose_place_model(folder);
    if (!model) return model.errors();
    fmt::print(stderr, "{}", to_string(model->notes));
    if (Status status = facades::write_meshes(file, model->meshes); !status) return status;
  }
  return finish_place(arguments.place, true);
}

}  // namespace

void add_facade_walk(CLI::App& stage, Chosen& chosen) {
  const auto arguments = std::make_shared<FacadeWalkArguments>();
  arguments->calibration.add(stage);
  arguments->place.add_choices(stage);
  stage.add_option("--scan", arguments->scan, scan_help)->check(CLI::ExistingFile)->excludes("--model");
  stage.footer("Example: parvis facade walk photographs/ -o courtyard && parvis view courtyard/place.xp");
  stage.callback([arguments, &chosen] { chosen = [arguments] { return walk(*arguments); }; });
}

}  // namespace parvis
