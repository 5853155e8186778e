// What six clicked points make of the cameras of real photographs.
#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "base/test_data.h"
#include "bench/parts.h"
#include "capture/facades/place_folder.h"
#include "capture/photographs/camera_files.h"
#include "capture/photographs/test_clicks.h"
#include "formats/meshes/assimp_reader.h"

namespace parvis::bench {
namespace {

namespace fs = std::filesystem;

constexpr double click_sigma_px = 0.5, coarse_sigma_px = 5.0;

/// Photographs with their known cameras, and points of what they show.
struct Place {
  std::vector<photographs::Photograph> photographs;
  std::vector<glm::dvec3> points;
};

Place courtyard(const fs::path& folder) {
  const photographs::LoadedSet loaded = must(photographs::read_cameras(folder / "colmap", folder / "images"));
  Place place{loaded.set.photographs, {}};
  for (const photographs::SparsePoint& point : loaded.set.points)
    place.points.push_back(point.position_in_world);
  return place;
}

Place sceaux(const fs::path& folder) {
  const photographs::LoadedSet loaded =
      must(photographs::read_cameras(folder / "cameras.json", folder / "images"));
  Errors warnings;
  const scene::Model model =
      must(scene::read_with_assimp(folder / "mesh_coarse_15k.ply", formats::UpAxis::z, warnings));
  Place place{loaded.set.photographs, {}};
  for (const facades::NamedMesh& named : facades::named_meshes(model))
    for (const glm::vec3& position : named.mesh.positions) place.points.emplace_back(position);
  return place;
}

std::vector<double> errors_px(const Place& place, double sigma_px) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < place.photographs.size(); ++i)
    errors.push_back(photographs::clicked_camera_error_px(place.photographs[i], place.points, sigma_px, i));
  std::ranges::sort(errors);
  return errors;
}

}  // namespace

void measure_clicked_cameras(const BenchSetup&, Report& report) {
  double middle = 0.0, worst = 0.0, coarse = 0.0;
  using Read = Place (*)(const fs::path&);
  constexpr std::array<std::pair<const char*, Read>, 2> places{
      {{"photos_castle_p30", courtyard}, {"photos_sceaux", sceaux}}};
  for (const auto& [name, read] : places) {
    const auto folder = shared_data(name, fs::current_path());
    if (!folder) return report.skip("photomontage_check_points_px", fmt::format("{} is absent", name));
    const Place place = read(*folder);
    const std::vector<double> errors = errors_px(place, click_sigma_px);
    middle = std::max(middle, errors[errors.size() / 2]), worst = std::max(worst, errors.back());
    const std::vector<double> by_coarse = errors_px(place, coarse_sigma_px);
    coarse = std::max(coarse, by_coarse[by_coarse.size() / 2]);
  }
  report.add("photomontage_check_points_px", middle);
  report.add("photomontage_check_points_px_worst", worst);
  report.add("photomontage_check_points_px_of_clicks_off_by_5", coarse);
}

}  // namespace parvis::bench
