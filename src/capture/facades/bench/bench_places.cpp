#include "capture/facades/bench/bench_places.h"

#include <algorithm>

#include "bench/scratch_folder.h"
#include "capture/facades/place_folder.h"
#include "capture/facades/place_model.h"
#include "capture/photographs/calibrate.h"
#include "capture/photographs/camera_files.h"
#include "formats/meshes/assimp_reader.h"

namespace parvis::bench {
namespace fs = std::filesystem;
namespace {

/// The photographs' own copies of the pictures that do not judge: points are triangulated from these alone.
Status copy_pictures(const photographs::PhotographSet& set, const std::vector<std::string>& held_out,
                     const fs::path& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  for (const photographs::Photograph& photograph : set.photographs)
    if (std::ranges::count(held_out, photograph.name) == 0)
      if (fs::copy_file(photograph.file, folder / photograph.name, code); code)
        return error("{}: cannot be copied ({})", photograph.file.string(), code.message());
  return Done{};
}

}  // namespace

Result<BenchPlace> sceaux(const fs::path& folder) {
  const Result<photographs::LoadedSet> set =
      photographs::read_cameras(folder / "cameras.json", folder / "images");
  if (!set) return set.errors();
  Errors warnings;
  const Result<scene::Model> model =
      scene::read_with_assimp(folder / "mesh_refined_175k.ply", formats::UpAxis::z, warnings);
  if (!model) return model.errors();
  return BenchPlace{set->set.photographs, facades::named_meshes(*model), {"00003.jpg", "00007.jpg"}};
}

Result<BenchPlace> courtyard(const fs::path& folder) {
  const Result<photographs::LoadedSet> given =
      photographs::read_cameras(folder / "colmap", folder / "images");
  if (!given) return given.errors();
  const std::vector<std::string> held_out{"0004.jpg", "0011.jpg", "0019.jpg", "0027.jpg"};
  const ScratchFolder scratch;
  photographs::CalibrationJob job;
  job.pictures = scratch.path / "pictures", job.folder = scratch.path / "place";
  job.cameras = fs::absolute(folder / "colmap");
  if (Status status = copy_pictures(given->set, held_out, job.pictures); !status) return status.errors();
  const Result<photographs::LoadedSet> calibrated = photographs::calibrate(job);
  if (!calibrated) return calibrated.errors();
  const Result<facades::PlaceModel> model = facades::propose_place_model(job.folder);
  if (!model) return model.errors();
  // Calibration has turned z up; the cameras that judge are turned alike.
  BenchPlace place{given->set.photographs, model->meshes, held_out};
  const photographs::Photograph& turned = calibrated->set.photographs.front();
  const photographs::Photograph* before = photographs::find(given->set, turned.name);
  const glm::dmat4 turn = turned.world_from_camera * glm::inverse(before->world_from_camera);
  for (photographs::Photograph& photograph : place.photographs)
    photograph.world_from_camera = turn * photograph.world_from_camera;
  return place;
}

}  // namespace parvis::bench
