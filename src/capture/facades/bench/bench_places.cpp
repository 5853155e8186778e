#include "capture/facades/bench/bench_places.h"

#include <algorithm>

#include "bench/scratch_folder.h"
#include "capture/facades/place_folder.h"
#include "capture/facades/place_model.h"
#include "capture/photographs/alignment.h"
#include "capture/photographs/camera_files.h"
#include "capture/photographs/set_file.h"
#include "formats/meshes/assimp_reader.h"

namespace parvis::bench {
namespace fs = std::filesystem;
namespace {

/// The set without the photographs that judge, and without points that fewer than two of the rest see.
photographs::PhotographSet without(const photographs::PhotographSet& set,
                                   const std::vector<std::string>& held_out) {
  photographs::PhotographSet rest;
  std::vector<int> number(set.photographs.size(), -1);
  for (std::size_t i = 0; i < set.photographs.size(); ++i) {
    if (std::ranges::count(held_out, set.photographs[i].name) > 0) continue;
    number[i] = int(rest.photographs.size());
    rest.photographs.push_back(set.photographs[i]);
  }
  for (photographs::SparsePoint point : set.points) {
    for (photographs::Observation& seen : point.observations)
      seen.photograph = number[std::size_t(seen.photograph)];
    std::erase_if(point.observations,
                  [](const photographs::Observation& seen) { return seen.photograph < 0; });
    if (point.observations.size() >= 2) rest.points.push_back(std::move(point));
  }
  return rest;
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
  Result<photographs::LoadedSet> set = photographs::read_cameras(folder / "colmap", folder / "images");
  if (!set) return set.errors();
  photographs::make_z_up(set->set, true);
  const std::vector<std::string> held_out{"0004.jpg", "0011.jpg", "0019.jpg", "0027.jpg"};
  const ScratchFolder scratch;
  if (Status status = photographs::write_photograph_set(scratch.path, without(set->set, held_out),
                                                        fs::absolute(folder / "images"));
      !status)
    return status.errors();
  const Result<facades::PlaceModel> model = facades::propose_place_model(scratch.path);
  if (!model) return model.errors();
  return BenchPlace{set->set.photographs, model->meshes, held_out};
}

}  // namespace parvis::bench
