// What `parvis noise` writes.
#include "base/file_set.h"
#include "base/image_io.h"
#include "formats/gltf/gltf_writer.h"
#include "formats/terrain/map_raster.h"
#include "planning/noise/noise_picture.h"

namespace parvis::noise {
namespace {

std::filesystem::path named(const std::filesystem::path& prefix, const char* end) {
  return prefix.string() + end;
}

std::string level_columns(const NoiseLevels& it) {
  return fmt::format("{:.1f},{:.1f},{:.1f},{:.1f}", it.lday, it.levening, it.lnight, it.lden);
}

/// The end of a level's name: with trams it is indicative.
std::string_view mark_of(const NoiseMap& map) { return map.sources.has_trams ? "_indicative" : ""; }

std::string level_names(const NoiseMap& map) {
  return fmt::format("lday_db{0},levening_db{0},lnight_db{0},lden_db{0}\n", mark_of(map));
}

std::string map_table(const NoiseMap& map) {
  std::string table = "x_m,y_m,z_m," + level_names(map);
  for (const int receiver : map.receiver_of_cell) {
    if (receiver < 0) continue;
    const propagation::Place& at = map.receivers[std::size_t(receiver)].place;
    table += fmt::format("{:.2f},{:.2f},{:.2f},{}\n", at.x, at.y, at.z,
                         level_columns(map.levels[std::size_t(receiver)]));
  }
  return table;
}

std::string facade_rows(const NoiseMap& map) {
  std::string table = "x_m,y_m,z_m,floor,facing_x,facing_y," + level_names(map);
  bool has_any = false;
  for (std::size_t i = 0; i < map.receivers.size(); ++i) {
    const Receiver& it = map.receivers[i];
    if (it.wall < 0) continue;
    has_any = true;
    table += fmt::format("{:.2f},{:.2f},{:.2f},{},{:.3f},{:.3f},{}\n", it.place.x, it.place.y, it.place.z,
                         it.floor, it.facing.x, it.facing.y, level_columns(map.levels[i]));
  }
  return has_any ? table : std::string();
}

Result<std::string> raster_of(const NoiseMap& map, const scene::Scene& scene) {
  scene::MapRaster raster{.columns = map.columns, .rows = map.rows, .cell_m = map.cell_m};
  raster.corner = glm::dvec2(scene.origin) + map.corner + glm::dvec2(0.0, map.rows * map.cell_m);
  raster.map = scene.map;
  for (const char* level : {"Lden", "Lday", "Levening", "Lnight"})
    raster.bands.push_back(
        {fmt::format("{} dB(A){}", level, map.sources.has_trams ? ", indicative" : ""), {}});
  for (int row = map.rows; row-- > 0;)
    for (int column = 0; column < map.columns; ++column) {
      const std::optional<NoiseLevels> here = levels_at(map, column, row);
      const NoiseLevels& it = here ? *here : NoiseLevels{};
      const double values[]{it.lden, it.lday, it.levening, it.lnight};
      for (std::size_t band = 0; band < raster.bands.size(); ++band)
        raster.bands[band].values.push_back(here ? float(values[band]) : scene::MapRaster::nothing);
    }
  return scene::encode_geotiff(raster);
}

}  // namespace

Status write_noise(const std::filesystem::path& prefix, const NoiseMap& map, const scene::Scene& scene,
                   double receiver_height_m) {
  const auto lden = [&](int column, int row) -> std::optional<double> {
    const std::optional<NoiseLevels> here = levels_at(map, column, row);
    return here ? std::optional(here->lden) : std::nullopt;
  };
  const std::string title =
      map.sources.has_trams ? "Lden in dB(A); indicative, for trams count" : "Lden in dB(A)";
  const Result<std::string> picture =
      encode_image(noise_picture(map, title, level_scale(), lden), named(prefix, ".png").string());
  if (!picture) return picture.errors();
  const Result<std::string> raster = raster_of(map, scene);
  if (!raster) return raster.errors();
  std::vector<FileContent> files{{named(prefix, ".png"), *picture},
                                 {named(prefix, ".csv"), map_table(map)},
                                 {named(prefix, ".tif"), *raster}};
  if (std::string facades = facade_rows(map); !facades.empty())
    files.push_back({named(prefix, "_facades.csv"), std::move(facades)});
  if (Status status = write_together(files); !status) return status;
  return scene::write_gltf(named(prefix, ".glb"), noise_model(map, receiver_height_m));
}

Status write_difference(const std::filesystem::path& prefix, const NoiseMap& map, const NoiseMap& before) {
  if (map.columns != before.columns || map.rows != before.rows || map.corner != before.corner)
    return error("the two states of the scene cover different areas: give --area X Y X Y");
  const auto difference = [&](int column, int row) -> std::optional<double> {
    const std::optional<NoiseLevels> now = levels_at(map, column, row), then = levels_at(before, column, row);
    return now && then ? std::optional(now->lden - then->lden) : std::nullopt;
  };
  const bool has_trams = map.sources.has_trams || before.sources.has_trams;
  std::string table = fmt::format("x_m,y_m,lden_before_db{},lden_db{},difference_db{}\n", mark_of(before),
                                  mark_of(map), has_trams ? "_indicative" : "");
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column)
      if (const std::optional<double> here = difference(column, row)) {
        const glm::dvec2 at = map.corner + map.cell_m * (glm::dvec2(column, row) + 0.5);
        table += fmt::format("{:.2f},{:.2f},{:.1f},{:.1f},{:+.1f}\n", at.x, at.y,
                             levels_at(before, column, row)->lden, levels_at(map, column, row)->lden, *here);
      }
  const Result<std::string> picture =
      encode_image(noise_picture(map,
                                 has_trams ? "difference of Lden in dB; indicative, for trams count"
                                           : "difference of Lden in dB",
                                 difference_scale(), difference),
                   named(prefix, "_difference.png").string());
  if (!picture) return picture.errors();
  return write_together(
      {{named(prefix, "_difference.png"), *picture}, {named(prefix, "_difference.csv"), table}});
}

}  // namespace parvis::noise
