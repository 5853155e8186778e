#include "capture/facades/bench/bench_places.h"

#include "capture/facades/coarse_model.h"
#include "capture/facades/place_folder.h"
#include "capture/photographs/alignment.h"
#include "capture/photographs/camera_files.h"
#include "formats/meshes/assimp_reader.h"

namespace parvis::bench {
namespace fs = std::filesystem;
namespace {

Result<BenchPlace> sceaux_with(const fs::path& folder, const char* mesh) {
  const Result<photographs::LoadedSet> set =
      photographs::read_cameras(folder / "cameras.json", folder / "images");
  if (!set) return set.errors();
  Errors warnings;
  const Result<scene::Model> model = scene::read_with_assimp(folder / mesh, formats::UpAxis::z, warnings);
  if (!model) return model.errors();
  return BenchPlace{set->set.photographs, facades::named_meshes(*model), {"00003.jpg", "00007.jpg"}};
}

}  // namespace

Result<BenchPlace> sceaux(const fs::path& folder) { return sceaux_with(folder, "mesh_refined_175k.ply"); }

Result<BenchPlace> sceaux_of_few_triangles(const fs::path& folder) {
  return sceaux_with(folder, "mesh_coarse_15k.ply");
}

Result<BenchPlace> courtyard(const fs::path& folder) {
  Result<photographs::LoadedSet> set = photographs::read_cameras(folder / "colmap", folder / "images");
  if (!set) return set.errors();
  photographs::make_z_up(set->set, true);
  const Result<facades::CoarseModel> model = facades::propose_coarse_model(set->set);
  if (!model) return model.errors();
  return BenchPlace{
      set->set.photographs, facades::meshes_of(*model), {"0004.jpg", "0011.jpg", "0019.jpg", "0027.jpg"}};
}

}  // namespace parvis::bench
