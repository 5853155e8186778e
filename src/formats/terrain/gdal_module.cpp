#include "formats/terrain/gdal_module.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_vsi.h>
#include <gdal.h>
#include <ogr_srs_api.h>
#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <memory>
#include <string_view>

#include "formats/terrain/map_projection.h"

namespace parvis::scene {
namespace {

constexpr int max_across = 1000;           // two million triangles
constexpr double max_height_m = 20'000.0;  // what is beyond is no height on the earth
constexpr double max_block_mb = 256.0;

/// Redirects GDAL's messages into our errors, away from the terminal.
struct QuietGdal {
  QuietGdal() {
    CPLPushErrorHandler(CPLQuietErrorHandler);
    CPLErrorReset();
  }
  QuietGdal(const QuietGdal&) = delete;
  ~QuietGdal() { CPLPopErrorHandler(); }
};

using Dataset = std::unique_ptr<void, void (*)(GDALDatasetH)>;

/// Opens a GeoTIFF alone, and nothing beside it: other formats name further files, or servers.
Dataset open(const std::filesystem::path& file) {
  static const bool is_ready = (GDALAllRegister(), true);
  static_cast<void>(is_ready);
  const char* const formats[]{"GTiff", nullptr};
  // Without overviews, whose samples may be means, or lie elsewhere.
  const char* const options[]{"GEOREF_SOURCES=INTERNAL", "OVERVIEW_LEVEL=NONE", nullptr};
  const char* const siblings[]{nullptr};
  return {GDALOpenEx(file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, formats, options, siblings),
          [](GDALDatasetH opened) {
            if (opened) GDALClose(opened);
          }};
}

/// The largest block of all the file's images, for overviews are read, too. GDAL takes the memory that the
/// file claims for a block (a tile, or a strip of rows that may be many more than there are), however little
/// the file holds.
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

/// The map from a sample (column, row) to coordinates in the map's own units.
struct Georeference {
  std::array<double, 6> transform;
  bool is_in_degrees = false;
  double unit_m = 1.0;
  std::string system{};  ///< as map_projection.h reads it; empty: not known

  glm::dvec2 at(double column, double row) const {
    return {transform[0] + column * transform[1] + row * transform[2],
            transform[3] + column * transform[4] + row * transform[5]};
  }
};

/// The system's name: EPSG's number where it has one, else a description.
std::string name_of_system(OGRSpatialReferenceH map) {
  for (const char* part : {"PROJCS", static_cast<const char*>(nullptr)}) {
    const char* const authority = OSRGetAuthorityName(map, part);
    const char* const code = OSRGetAuthorityCode(map, part);
    if (authority && code && std::string_view(authority) == "EPSG") return fmt::format("EPSG:{}", code);
  }
  char* text = nullptr;
  const char* const options[]{"FORMAT=WKT2_2018", nullptr};
  std::string described;
  if (OSRExportToWktEx(map, &text, options) == OGRERR_NONE && text) described = text;
  CPLFree(text);
  return described;
}

std::optional<Georeference> georeference_of(GDALDatasetH grid) {
  Georeference result;
  if (GDALGetGeoTransform(grid, result.transform.data()) != CE_None) return std::nullopt;
  for (const double value : result.transform)
    if (!std::isfinite(value)) return std::nullopt;
  if (const OGRSpatialReferenceH map = GDALGetSpatialRef(grid)) {
    result.is_in_degrees = OSRIsGeographic(map) != 0;
    if (!result.is_in_degrees) result.unit_m = OSRGetLinearUnits(map, nullptr);
    if (!result.is_in_degrees && OSRIsProjected(map)) result.system = name_of_system(map);
  }
  return result;
}

/// Metres per unit of the heights: as the band names it, else as the vertical system does.
double height_unit_m(GDALDatasetH grid, GDALRasterBandH band, const FileLocation& where, Errors& warnings) {
  std::string name = GDALGetRasterUnitType(band);
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  constexpr double foot_m = 0.3048, us_survey_foot_m = 1200.0 / 3937.0;
  const bool is_foot =
      name == "ft" || name.find("foot") != std::string::npos || name.find("feet") != std::string::npos;
  if (is_foot || name == "us-ft" || name == "ftus")
    return name.find("us") != std::string::npos ? us_survey_foot_m : foot_m;
  if (name == "cm" || name.starts_with("centimet")) return 0.01;
  if (name == "mm" || name.starts_with("millimet")) return 0.001;
  if (name == "dm" || name.starts_with("decimet")) return 0.1;
  if (name == "km" || name.starts_with("kilomet")) return 1000.0;
  if (name == "m" || name.starts_with("met")) return 1.0;
  if (!name.empty())
    warnings.push_back({fmt::format("the unit of its heights, \"{}\", is not known; they are read as metres",
                                    name.substr(0, 40)),
                        where});
  const OGRSpatialReferenceH map = GDALGetSpatialRef(grid);
  return name.empty() && map && OSRIsCompound(map) ? OSRGetTargetLinearUnits(map, "VERT_CS", nullptr) : 1.0;
}

/// Columns or rows of a grid that are taken: `count` of `all`, each where it lies.
std::vector<int> taken(int count, int all) {
  std::vector<int> places(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) places[std::size_t(i)] = int((i + 0.5) * all / count);
  return places;
}

/// Values that programs write where nothing was measured, also into files that declare no such value: no land
/// lies there.
constexpr std::array usual_holes{-9999.0, -32767.0, -32768.0, -99999.0};

/// Heights in metres, NaN where there is none; every step-th sample.
bool read_heights(GDALRasterBandH band, double unit_m, int width, int height, HeightGrid& grid) {
  std::vector<double> values(std::size_t(grid.columns) * std::size_t(grid.rows));
  std::vector<std::uint8_t> mask(values.size(), 255);
  const auto read = [&](GDALRasterBandH from, void* to, GDALDataType type) {
    return GDALRasterIO(from, GF_Read, 0, 0, width, height, to, grid.columns, grid.rows, type, 0, 0) ==
           CE_None;
  };
  if (!read(band, values.data(), GDT_Float64)) return false;
  if ((GDALGetMaskFlags(band) & (GMF_ALL_VALID | GMF_NODATA)) == 0 &&
      !read(GDALGetMaskBand(band), mask.data(), GDT_Byte))
    return false;
  int has_nothing = 0;
  const double nothing = GDALGetRasterNoDataValue(band, &has_nothing);
  const double scale = GDALGetRasterScale(band, nullptr), offset = GDALGetRasterOffset(band, nullptr);
  const bool has_mask = has_nothing || (GDALGetMaskFlags(band) & GMF_ALL_VALID) == 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double metres = unit_m * (offset + scale * values[i]);
    const bool is_usual_hole = !has_mask && std::ranges::find(usual_holes, values[i]) != usual_holes.end();
    grid.undeclared_holes += is_usual_hole;
    const bool is_height = mask[i] != 0 && !(has_nothing && values[i] == nothing) && !is_usual_hole &&
                           std::abs(metres) < max_height_m;
    grid.points[i].z = is_height ? metres : std::numeric_limits<double>::quiet_NaN();
  }
  return true;
}

/// The system that a grid is laid on, and, of one that is not in degrees, its own where that is another.
struct Target {
  std::optional<MapProjection> map, own;
};

Target target_of(const Georeference& given, glm::dvec2 middle, const std::string& map) {
  Target target;
  if (!given.is_in_degrees) target.own = MapProjection::of(given.system);
  const bool is_known = given.is_in_degrees || target.own;
  if (is_known && !map.empty() && map != given.system) target.map = MapProjection::of(map);
  const glm::dvec2 deg = given.is_in_degrees ? middle
                         : target.own        ? target.own->degrees(given.unit_m * middle)
                                             : middle;
  if (target.map && !std::isfinite((*target.map)(deg).x)) target.map.reset();
  if (!target.map && given.is_in_degrees) target.map = MapProjection::utm(middle);
  return target;
}

Status place(const Georeference& given, int width, int height, const std::string& map, HeightGrid& grid) {
  const glm::dvec2 middle = given.at(width / 2.0, height / 2.0);
  if (given.is_in_degrees && !(std::abs(middle.x) <= 2.0 * 180.0 && std::abs(middle.y) < max_latitude_deg))
    return error("its middle lies at {} degrees east, {} north, which is nowhere on the earth's maps",
                 middle.x, middle.y);
  const Target target = target_of(given, middle, map);
  const auto on_map = [&](glm::dvec2 in_file) {
    if (given.is_in_degrees) return (*target.map)(in_file);
    const glm::dvec2 metres = given.unit_m * in_file;
    return target.map ? (*target.map)(target.own->degrees(metres)) : metres;
  };
  const std::vector<int> columns = taken(grid.columns, width), rows = taken(grid.rows, height);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      glm::dvec3& point = grid.points[std::size_t(row) * std::size_t(grid.columns) + std::size_t(column)];
      const glm::dvec2 metres =
          on_map(given.at(columns[std::size_t(column)] + 0.5, rows[std::size_t(row)] + 0.5));
      point = glm::dvec3(
          metres, std::isfinite(metres.x + metres.y) ? point.z : std::numeric_limits<double>::quiet_NaN());
    }
  const std::optional<MapProjection>& shown = target.map ? target.map : target.own;
  if (!shown) return Ok{};
  const glm::dvec2 deg = given.is_in_degrees ? middle : target.own->degrees(given.unit_m * middle);
  if (!std::isfinite(deg.x + deg.y)) return Ok{};
  grid.map = shown->system();
  grid.true_north_deg = shown->true_north_deg(deg);
  grid.place_deg = glm::dvec2(deg.x - 360.0 * std::floor((deg.x + 180.0) / 360.0), deg.y);
  return Ok{};
}

/// North up, about the middle.
Georeference about_the_middle(int width, int height, double cell_m) {
  return {.transform = {-cell_m * width / 2.0, cell_m, 0.0, cell_m * height / 2.0, 0.0, -cell_m}};
}

Result<HeightGrid> read(const std::filesystem::path& file, std::optional<double> cell_m, Errors& warnings,
                        const std::string& map) {
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
  if (GDALGetRasterCount(opened.get()) >= 3 &&
      GDALGetRasterColorInterpretation(GDALGetRasterBand(opened.get(), 1)) == GCI_RedBand)
    return error_at(
        where,
        "this GeoTIFF is a picture (red, green, blue), not a grid of heights; of a terrain model the "
        "first band holds heights");
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
  const GDALRasterBandH band = GDALGetRasterBand(opened.get(), 1);
  grid.file_columns = width, grid.file_rows = height, grid.bands = GDALGetRasterCount(opened.get());
  grid.height_unit_m = height_unit_m(opened.get(), band, where, warnings);
  if (!read_heights(band, grid.height_unit_m, width, height, grid))
    return error_at(where, "its samples cannot be read ({})", CPLGetLastErrorMsg());
  const Georeference own = given ? *given : about_the_middle(width, height, *cell_m);
  if (const Status placed = place(own, width, height, map, grid); !placed)
    return Error{placed.errors().front().message, where};
  return grid;
}

Result<std::string> write(const MapRaster& raster) {
  const QuietGdal quiet;
  GDALAllRegister();
  constexpr const char* file = "/vsimem/parvis_raster.tif";  // in memory
  const char* const compressed[]{"COMPRESS=DEFLATE", nullptr};
  Dataset made(GDALCreate(GDALGetDriverByName("GTiff"), file, raster.columns, raster.rows,
                          int(raster.bands.size()), GDT_Float32, const_cast<char**>(compressed)),
               [](GDALDatasetH created) {
                 if (created) GDALClose(created);
               });
  if (!made) return error("no GeoTIFF can be made ({})", CPLGetLastErrorMsg());
  double transform[]{raster.corner.x, raster.cell_m, 0.0, raster.corner.y, 0.0, -raster.cell_m};
  bool is_written = GDALSetGeoTransform(made.get(), transform) == CE_None;
  if (!raster.map.empty()) {
    const std::unique_ptr<void, void (*)(OGRSpatialReferenceH)> system(OSRNewSpatialReference(nullptr),
                                                                       OSRDestroySpatialReference);
    if (OSRSetFromUserInput(system.get(), raster.map.c_str()) != OGRERR_NONE)
      return error("the map's coordinate system \"{}\" is not known: the GeoTIFF is not written", raster.map);
    is_written = is_written && GDALSetSpatialRef(made.get(), system.get()) == CE_None;
  }
  for (std::size_t i = 0; i < raster.bands.size(); ++i) {
    const GDALRasterBandH band = GDALGetRasterBand(made.get(), int(i) + 1);
    GDALSetDescription(band, raster.bands[i].name.c_str());
    GDALSetRasterNoDataValue(band, double(MapRaster::nothing));
    is_written = is_written && GDALRasterIO(band, GF_Write, 0, 0, raster.columns, raster.rows,
                                            const_cast<float*>(raster.bands[i].values.data()), raster.columns,
                                            raster.rows, GDT_Float32, 0, 0) == CE_None;
  }
  made.reset();  // all is written when the file is closed
  vsi_l_offset size = 0;
  const GByte* const bytes = VSIGetMemFileBuffer(file, &size, FALSE);
  std::string content = bytes ? std::string(reinterpret_cast<const char*>(bytes), size) : std::string();
  VSIUnlink(file);
  if (!is_written || content.empty())
    return error("the GeoTIFF cannot be written ({})", CPLGetLastErrorMsg());
  return content;
}

}  // namespace
}  // namespace parvis::scene

PARVIS_MODULE(parvis::scene::GdalFunctions){parvis::scene::read, parvis::scene::write};
