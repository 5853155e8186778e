#include "bench/facades/bench_places.h"

#include <algorithm>

#include "base/image_io.h"
#include "capture/facades/place_folder.h"
#include "capture/facades/place_model.h"
#include "capture/photographs/calibrate.h"
#include "capture/photographs/camera_files.h"
#include "capture/photographs/picture.h"
#include "formats/meshes/assimp_reader.h"

namespace parvis::bench {
namespace fs = std::filesystem;
namespace {

/// The picture, each side `divisor` times as short: means of blocks, encoded.
Status write_reduced(const fs::path& from, const fs::path& to, int divisor) {
  const Result<Image8> picture = read_image8(from);
  if (!picture) return picture.errors();
  Image8 reduced(picture->width / divisor, picture->height / divisor, 3);
  for (int y = 0; y < reduced.height; ++y)
    for (int x = 0; x < reduced.width; ++x)
      for (int c = 0; c < 3; ++c) {
        int sum = 0;
        for (int k = 0; k < divisor * divisor; ++k)
          sum += picture->at(x * divisor + k % divisor, y * divisor + k / divisor)[c];
        reduced.at(x, y)[c] = std::uint8_t((sum + divisor * divisor / 2) / (divisor * divisor));
      }
  return write_image(to, reduced);
}

/// Copies of a folder's pictures, without some of them.
Status copy_pictures(const fs::path& from, const fs::path& to, const std::vector<std::string>& without,
                     int divisor) {
  std::error_code code;
  fs::create_directories(to, code);
  for (const std::string& name : photographs::picture_names(from)) {
    if (std::ranges::count(without, name) > 0) continue;
    if (divisor > 1) {
      if (Status status = write_reduced(from / name, to / name, divisor); !status) return status;
    } else if (fs::copy_file(from / name, to / name, code); code) {
      return error("{}: cannot be copied ({})", (from / name).string(), code.message());
    }
  }
  return Done{};
}

}  // namespace

Result<BenchPlace> sceaux(const fs::path& folder, bool) {
  const Result<photographs::LoadedSet> set =
      photographs::read_cameras(folder / "cameras.json", folder / "images");
  if (!set) return set.errors();
  Errors warnings;
  const Result<scene::Model> model =
      scene::read_with_assimp(folder / "mesh_refined_175k.ply", formats::UpAxis::z, warnings);
  if (!model) return model.errors();
  return BenchPlace{
      set->set.photographs, facades::named_meshes(*model), {"00003.jpg", "00007.jpg"}, nullptr, true};
}

Result<BenchPlace> courtyard(const fs::path& folder, bool is_quick) {
  const std::vector<std::string> held_out{"0004.jpg", "0011.jpg", "0019.jpg", "0027.jpg"};
  const auto scratch = std::make_shared<const ScratchFolder>();
  const fs::path all = scratch->path / "all";
  photographs::CalibrationJob job;
  job.pictures = scratch->path / "pictures", job.folder = scratch->path / "place";
  job.cameras = fs::absolute(folder / "colmap");
  if (Status status = copy_pictures(folder / "images", all, {}, is_quick ? 2 : 1); !status)
    return status.errors();
  if (Status status = copy_pictures(all, job.pictures, held_out, 1); !status) return status.errors();
  const Result<photographs::LoadedSet> given = photographs::read_cameras(folder / "colmap", all);
  if (!given) return given.errors();
  const Result<photographs::LoadedSet> calibrated = photographs::calibrate(job);
  if (!calibrated) return calibrated.errors();
  const Result<facades::PlaceModel> model = facades::propose_place_model(job.folder);
  if (!model) return model.errors();
  // Calibration has turned z up; the cameras that judge are turned alike.
  BenchPlace place{given->set.photographs, model->meshes, held_out, scratch};
  const photographs::Photograph& turned = calibrated->set.photographs.front();
  const photographs::Photograph* before = photographs::find(given->set, turned.name);
  const glm::dmat4 turn = turned.world_from_camera * glm::inverse(before->world_from_camera);
  for (photographs::Photograph& photograph : place.photographs)
    photograph.world_from_camera = turn * photograph.world_from_camera;
  return place;
}

}  // namespace parvis::bench
