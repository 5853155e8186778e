#include "formats/terrain/height_grid.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <gdal.h>
#include <ogr_srs_api.h>
#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "formats/terrain/utm.h"

namespace parvis::scene {
namespace {

constexpr int max_across = 1000;        // two million triangles
constexpr double highest_m = 20'000.0;  // what is beyond is no height on the earth
constexpr double farthest_deg = 84.0;   // as far as UTM goes
constexpr double max_block_mb = 256.0;

/// What GDAL says goes into our errors, not to the terminal.
struct QuietGdal {
  QuietGdal() {
    CPLPushErrorHandler(CPLQuietErrorHandler);
    CPLErrorReset();
  }
  QuietGdal(const QuietGdal&) = delete;
  ~QuietGdal() { CPLPopErrorHandler(); }
};

using Dataset = std::unique_ptr<void, void (*)(GDALDatasetH)>;

/// Of GeoTIFF alone, and nothing beside it: other formats name further files, or servers.
Dataset open(const std::filesystem::path& file) {
  static const bool is_ready = (GDALAllRegister(), true);
  static_cast<void>(is_ready);
  const char* const formats[]{"GTiff", nullptr};
  const char* const options[]{"GEOREF_SOURCES=INTERNAL", nullptr};
  const char* const siblings[]{nullptr};
  return {GDALOpenEx(file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, formats, options, siblings),
          [](GDALDatasetH opened) {
            if (opened) GDALClose(opened);
          }};
}

/// Of the file's images, for overviews are read, too. GDAL takes the memory that the file claims for a block
/// (a tile, or a strip of rows that may be many more than there are), however little the file holds.
double largest_block_mb(const std::filesystem::path& file) {
  const auto say_nothing = [](TIFF*, void*, const char*, const char*, va_list) { return 1; };
  const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options{TIFFOpenOptionsAlloc(),
                                                                                 TIFFOpenOptionsFree};
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), say_nothing, nullptr);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), say_nothing, nullptr);
  const std::unique_ptr<TIFF, decltype(&TIFFClose)> images{TIFFOpenExt(file.c_str(), "r", options.get()),
                                                           TIFFClose};
  std::uint64_t maximum = 0;
  if (images) do {
      maximum = std::max(
          maximum, TIFFIsTiled(images.get()) ? TIFFTileSize64(images.get()) : TIFFStripSize64(images.get()));
    } while (TIFFReadDirectory(images.get()));
  return 1e-6 * double(maximum);
}

/// From a sample (column, row) to the map, in the map's own units.
struct Georeference {
  std::array<double, 6> transform;
  bool is_in_degrees = false;
  double unit_m = 1.0;

  glm::dvec2 at(double column, double row) const {
    return {transform[0] + column * transform[1] + row * transform[2],
            transform[3] + column * transform[4] + row * transform[5]};
  }
};

std::optional<Georeference> georeference_of(GDALDatasetH grid) {
  Georeference result;
  if (GDALGetGeoTransform(grid, result.transform.data()) != CE_None) return std::nullopt;
  for (const double value : result.transform)
    if (!std::isfinite(value)) return std::nullopt;
  if (const OGRSpatialReferenceH map = GDALGetSpatialRef(grid)) {
    result.is_in_degrees = OSRIsGeographic(map) != 0;
    if (!result.is_in_degrees) result.unit_m = OSRGetLinearUnits(map, nullptr);
  }
  return result;
}

/// Heights in metres, NaN where there is none; every step-th sample.
bool read_heights(GDALRasterBandH band, int width, int height, HeightGrid& grid) {
  std::vector<double> values(std::size_t(grid.columns) * std::size_t(grid.rows));
  if (GDALRasterIO(band, GF_Read, 0, 0, width, height, values.data(), grid.columns, grid.rows, GDT_Float64, 0,
                   0) != CE_None)
    return false;
  int has_nothing = 0;
  const double nothing = GDALGetRasterNoDataValue(band, &has_nothing);
  const double scale = GDALGetRasterScale(band, nullptr), offset = GDALGetRasterOffset(band, nullptr);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double metres = offset + scale * values[i];
    const bool is_height = !(has_nothing && values[i] == nothing) && std::abs(metres) < highest_m;
    grid.points[i].z = is_height ? metres : std::numeric_limits<double>::quiet_NaN();
  }
  return true;
}

Status place(const Georeference& map, int width, int height, HeightGrid& grid) {
  const glm::dvec2 middle = map.at(width / 2.0, height / 2.0);
  if (map.is_in_degrees && !(std::abs(middle.x) <= 180.0 && std::abs(middle.y) < farthest_deg))
    return error("its middle lies at {} degrees east, {} north, which is nowhere on the earth's maps",
                 middle.x, middle.y);
  const Utm utm(map.is_in_degrees ? middle : glm::dvec2(0.0));
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const glm::dvec2 on_map =
          map.at((column + 0.5) * width / grid.columns, (row + 0.5) * height / grid.rows);
      glm::dvec3& point = grid.points[std::size_t(row) * std::size_t(grid.columns) + std::size_t(column)];
      const glm::dvec2 metres = map.is_in_degrees ? utm(on_map) : on_map * map.unit_m;
      point = glm::dvec3(
          metres, std::isfinite(metres.x + metres.y) ? point.z : std::numeric_limits<double>::quiet_NaN());
    }
  return Done{};
}

/// North up, about the middle.
Georeference about_the_middle(int width, int height, double cell_m) {
  return {{-cell_m * width / 2.0, cell_m, 0.0, cell_m * height / 2.0, 0.0, -cell_m}};
}

}  // namespace

Result<HeightGrid> read_height_grid(const std::filesystem::path& file, std::optional<double> cell_m,
                                    Errors& warnings) {
  const FileLocation where{file.string(), 0, 0};
  const QuietGdal quiet;
  if (const double block_mb = largest_block_mb(file); block_mb > max_block_mb)
    return error_at(where,
                    "its samples lie in blocks of {:.0f} MB; expected at most {:.0f} MB: write it in tiles "
                    "(gdal_translate -co TILED=YES)",
                    block_mb, max_block_mb);
  const Dataset opened = open(file);
  if (!opened) return error_at(where, "this is no GeoTIFF that can be read ({})", CPLGetLastErrorMsg());
  const int width = GDALGetRasterXSize(opened.get()), height = GDALGetRasterYSize(opened.get());
  if (width < 2 || height < 2 || GDALGetRasterCount(opened.get()) < 1)
    return error_at(where, "a grid of {} x {} samples has no surface; expected 2 x 2 or more", width, height);
  const std::optional<Georeference> given = georeference_of(opened.get());
  if (!given && !cell_m)
    return error_at(where,
                    "this grid has no place on the earth (georeference); give cell=, the metres between its "
                    "samples, and it stands about the node's position");

  HeightGrid grid;
  const int step = (std::max(width, height) + max_across - 1) / max_across;
  grid.columns = std::max(width / step, 2), grid.rows = std::max(height / step, 2);
  grid.points.resize(std::size_t(grid.columns) * std::size_t(grid.rows));
  grid.has_place = given.has_value();
  if (step > 1)
    warnings.push_back(
        {fmt::format("of {} x {} samples every {}. is taken, as many as can be shown", width, height, step),
         where});
  if (!read_heights(GDALGetRasterBand(opened.get(), 1), width, height, grid))
    return error_at(where, "its samples cannot be read ({})", CPLGetLastErrorMsg());
  const Georeference map = given ? *given : about_the_middle(width, height, *cell_m);
  if (const Status placed = place(map, width, height, grid); !placed)
    return Error{placed.errors().front().message, where};
  return grid;
}

}  // namespace parvis::scene
