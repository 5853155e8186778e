#include "formats/terrain/terrain.h"

#include <cpl_conv.h>
#include <gdal.h>
#include <gtest/gtest.h>
#include <ogr_srs_api.h>

#include <cmath>
#include <utility>

#include "base/test_folder.h"
#include "formats/terrain/map_projection.h"
#include "land/heights/terrain_heights.h"

namespace parvis::scene {
namespace {

constexpr int grid_width = 100, grid_height = 80;
constexpr double nothing = -9999.0;

/// A slope that rises by half a metre from column to column, with one hole.
std::vector<float> slope() {
  std::vector<float> heights;
  for (int row = 0; row < grid_height; ++row)
    for (int column = 0; column < grid_width; ++column) heights.push_back(10.0f + 0.5f * float(column));
  heights[std::size_t(40 * grid_width + 50)] = float(nothing);
  return heights;
}

void write_grid(const std::filesystem::path& file, const double* transform, int epsg,
                std::vector<float> heights = slope()) {
  GDALAllRegister();
  const GDALDatasetH grid = GDALCreate(GDALGetDriverByName("GTiff"), file.c_str(), grid_width, grid_height, 1,
                                       GDT_Float32, nullptr);
  if (transform) GDALSetGeoTransform(grid, const_cast<double*>(transform));
  if (epsg) {
    const OGRSpatialReferenceH map = OSRNewSpatialReference(nullptr);
    OSRImportFromEPSG(map, epsg);
    GDALSetSpatialRef(grid, map);
    OSRDestroySpatialReference(map);
  }
  const GDALRasterBandH band = GDALGetRasterBand(grid, 1);
  GDALSetRasterNoDataValue(band, nothing);
  EXPECT_EQ(GDALRasterIO(band, GF_Write, 0, 0, grid_width, grid_height, heights.data(), grid_width,
                         grid_height, GDT_Float32, 0, 0),
            CE_None);
  GDALClose(grid);
}

TEST(Terrain, AMapInMetresStandsWhereItSays) {
  const TestFolder folder;
  const double transform[]{600'000.0, 2.0, 0.0, 5'700'000.0, 0.0, -2.0};
  write_grid(folder.path() / "slope.tif", transform, 32631);
  Errors warnings;
  const Result<Model> model = read_terrain(folder.path() / "slope.tif", std::nullopt, warnings);
  ASSERT_TRUE(model) << to_string(model.errors());
  EXPECT_TRUE(warnings.empty()) << to_string(warnings);
  const Bounds box = bounds(*model);
  EXPECT_NEAR(box.min.x + model->origin.x, 600'001.0, 1e-3) << "samples lie in the middle of their cells";
  EXPECT_NEAR(box.max.y + model->origin.y, 5'699'999.0, 1e-3);
  EXPECT_NEAR(box.size().x, 198.0f, 1e-3f);
  EXPECT_NEAR(box.size().y, 158.0f, 1e-3f);
  EXPECT_NEAR(box.min.z + model->origin.z, 10.0, 1e-5);
  EXPECT_NEAR(box.size().z, 49.5f, 1e-4f);
  // each of the four cells about the hole keeps half of itself
  EXPECT_EQ(model->triangle_count(), std::size_t(2 * (grid_width - 1) * (grid_height - 1) - 4));
  for (const Part& part : model->parts)
    for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
      const auto at = [&](std::size_t k) { return part.mesh.positions[part.mesh.indices[i + k]]; };
      EXPECT_GT(glm::cross(at(1) - at(0), at(2) - at(0)).z, 0.0f);
    }
  const glm::vec3 normal = model->parts[0].mesh.normals[5];
  EXPECT_LT(glm::distance(normal, glm::normalize(glm::vec3(-0.25f, 0.0f, 1.0f))), 1e-4f);
}

TEST(Terrain, DegreesBecomeMetres) {
  const TestFolder folder;
  const double transform[]{4.49, 1e-4, 0.0, 52.16, 0.0, -1e-4};
  write_grid(folder.path() / "degrees.tif", transform, 4326);
  Errors warnings;
  const Result<Model> model = read_terrain(folder.path() / "degrees.tif", std::nullopt, warnings);
  ASSERT_TRUE(model) << to_string(model.errors());
  const glm::dvec2 corner = MapProjection::utm({4.495, 52.156})({4.49005, 52.15995});
  const glm::vec3 first = model->parts[0].mesh.positions[0];
  EXPECT_NEAR(first.x + model->origin.x, corner.x, 0.01);
  EXPECT_NEAR(first.y + model->origin.y, corner.y, 0.01);
  const glm::dvec2 opposite = MapProjection::utm({4.495, 52.156})({4.49995, 52.15205});
  const glm::vec3 last = model->parts.back().mesh.positions.back();
  EXPECT_NEAR(last.x + model->origin.x, opposite.x, 0.01);
  EXPECT_NEAR(last.y + model->origin.y, opposite.y, 0.01);
}

TEST(Terrain, AGridWithoutAPlaceNeedsItsCells) {
  const TestFolder folder;
  write_grid(folder.path() / "bare.tif", nullptr, 0);
  Errors warnings;
  const Result<Model> refused = read_terrain(folder.path() / "bare.tif", std::nullopt, warnings);
  ASSERT_FALSE(refused);
  EXPECT_NE(to_string(refused.errors()).find("give cell="), std::string::npos);
  const Result<Model> model = read_terrain(folder.path() / "bare.tif", 3.0, warnings);
  ASSERT_TRUE(model) << to_string(model.errors());
  EXPECT_NEAR(bounds(*model).size().x, 3.0f * float(grid_width - 1), 1e-3f);
  EXPECT_NEAR(bounds(*model).centre().x, 0.0f, 1e-3f);
  EXPECT_EQ(model->origin, glm::dvec3(0.0));
}

TEST(Terrain, OtherFilesAndEmptyGridsAreRefused) {
  const TestFolder folder;
  Errors warnings;
  const auto told = [&](const std::filesystem::path& file) {
    const Result<Model> model = read_terrain(file, 1.0, warnings);
    return model ? std::string() : to_string(model.errors());
  };
  EXPECT_NE(told(folder.write("text.tif", "heights")).find("no GeoTIFF"), std::string::npos);
  EXPECT_NE(
      told(folder.write("other.tif", "<VRTDataset rasterXSize=\"9\" rasterYSize=\"9\"/>")).find("no GeoTIFF"),
      std::string::npos);
  write_grid(folder.path() / "holes.tif", nullptr, 0,
             std::vector<float>(std::size_t(grid_width * grid_height), float(nothing)));
  EXPECT_NE(told(folder.path() / "holes.tif").find("all holes"), std::string::npos);
}

/// The head of a TIFF whose samples, 32 bits each, lie in one tile.
std::string tiff_of_one_tile(std::uint32_t side) {
  const std::vector<std::pair<std::uint16_t, std::uint32_t>> tags{
      {256, side}, {257, side},           {258, 32}, {259, 1}, {262, 1}, {322, side}, {323, side},
      {324, 200},  {325, 4 * side * side}};
  std::string text("II*\0\x08\0\0\0", 8);
  const auto add = [&](std::uint32_t number, int bytes) {
    for (int i = 0; i < bytes; ++i) text += char(number >> (8 * i));
  };
  add(std::uint32_t(tags.size()), 2);
  for (const auto& [tag, value] : tags) add(tag, 2), add(4, 2), add(1, 4), add(value, 4);
  add(0, 4);
  return text;
}

TEST(Terrain, SamplesInBlocksThatFillTheMemoryAreRefused) {
  const TestFolder folder;
  Errors warnings;
  const auto said = [&](std::uint32_t side) {
    return to_string(read_terrain(folder.write("a.tif", tiff_of_one_tile(side)), 1.0, warnings).errors());
  };
  EXPECT_NE(said(10'000).find("blocks of 400 MB; expected at most 256 MB"), std::string::npos)
      << said(10'000);
  EXPECT_EQ(said(96).find("blocks of"), std::string::npos)
      << said(96);  // the control: its samples are missing
}

TEST(Terrain, ReportsItsHeightAtPlacesOnTheMap) {
  const TestFolder folder;
  const double transform[]{600'000.0, 2.0, 0.0, 5'700'000.0, 0.0, -2.0};
  write_grid(folder.path() / "slope.tif", transform, 32631);
  Errors warnings;
  const Result<Model> model = read_terrain(folder.path() / "slope.tif", std::nullopt, warnings);
  ASSERT_TRUE(model) << to_string(model.errors());
  const TerrainHeights heights(*model);
  EXPECT_NEAR(heights.lowest().value_or(0.0), 10.0, 0.2) << "half a cell of the raster";
  for (const double east_m : {5.0, 33.3, 150.0}) {
    const std::optional<double> height_m = heights.at({600'000.0 + east_m, 5'699'950.0});
    ASSERT_TRUE(height_m) << east_m;
    EXPECT_NEAR(*height_m, 10.0 + 0.25 * (east_m - 1.0), 1e-3);  // the first sample lies 1 m in
  }
  EXPECT_FALSE(heights.at({599'990.0, 5'699'950.0}));
  EXPECT_FALSE(TerrainHeights(Model()).lowest());
}

/// A grid with something of its own said before it is closed.
template <class Say>
void write_grid_that_says(const std::filesystem::path& file, int epsg, const Say& say) {
  const double transform[]{500'000.0, 2.0, 0.0, 5'700'000.0, 0.0, -2.0};
  write_grid(file, transform, epsg);
  const GDALDatasetH grid = GDALOpen(file.c_str(), GA_Update);
  say(grid);
  GDALClose(grid);
}

float height_of(const std::filesystem::path& file) {
  Errors warnings;
  const Result<Model> model = read_terrain(file, std::nullopt, warnings);
  EXPECT_TRUE(model) << to_string(model.errors());
  EXPECT_TRUE(warnings.empty()) << to_string(warnings);
  return model ? bounds(*model).size().z : 0.0f;
}

TEST(Terrain, HeightsAreInTheUnitThatTheFileNames) {
  const TestFolder folder;
  const auto file = folder.path() / "unit.tif";
  for (const auto& [unit, metres] : {std::pair("ft", 0.3048), std::pair("US survey foot", 1200.0 / 3937.0),
                                     std::pair("cm", 0.01), std::pair("metre", 1.0)}) {
    write_grid_that_says(file, 25832,
                         [&](GDALDatasetH grid) { GDALSetRasterUnitType(GDALGetRasterBand(grid, 1), unit); });
    EXPECT_NEAR(height_of(file), 49.5 * metres, 1e-4) << unit;
  }
  write_grid_that_says(file, 25832, [](GDALDatasetH grid) {
    const OGRSpatialReferenceH map = OSRNewSpatialReference(nullptr);
    OSRSetFromUserInput(map, "EPSG:25832+6360");  // NAVD88 in US survey feet
    GDALSetSpatialRef(grid, map);
    OSRDestroySpatialReference(map);
  });
  EXPECT_NEAR(height_of(file), 49.5 * 1200.0 / 3937.0, 1e-4) << "of the vertical system";
}

TEST(Terrain, SamplesThatAMaskLeavesOutAreHoles) {
  const TestFolder folder;
  const auto file = folder.path() / "masked.tif";
  CPLSetConfigOption("GDAL_TIFF_INTERNAL_MASK", "YES");
  write_grid_that_says(file, 25832, [](GDALDatasetH grid) {
    const GDALRasterBandH band = GDALGetRasterBand(grid, 1);
    GDALDeleteRasterNoDataValue(band);
    GDALCreateMaskBand(band, GMF_PER_DATASET);
    std::vector<std::uint8_t> mask(std::size_t(grid_width) * grid_height, 255);
    for (int row = 0; row < grid_height; ++row)
      for (int column = 0; column < grid_width / 2; ++column)
        mask[std::size_t(row * grid_width + column)] = 0;
    EXPECT_EQ(GDALRasterIO(GDALGetMaskBand(band), GF_Write, 0, 0, grid_width, grid_height, mask.data(),
                           grid_width, grid_height, GDT_Byte, 0, 0),
              CE_None);
  });
  Errors warnings;
  const Result<Model> model = read_terrain(file, std::nullopt, warnings);
  ASSERT_TRUE(model) << to_string(model.errors());
  EXPECT_NEAR(bounds(*model).size().x, 2.0f * (grid_width / 2 - 1), 1e-3f) << "the eastern half alone";
  FileAccount account("GeoTIFF");
  ASSERT_TRUE(read_terrain(file, std::nullopt, warnings, nullptr, {}, &account));
  EXPECT_EQ(account.count(Fate::used, "samples"), std::size_t(grid_width / 2 * grid_height))
      << account.text();
  EXPECT_EQ(account.count(Fate::unneeded, "samples"), std::size_t(grid_width / 2 * grid_height));
}

TEST(Terrain, EverySecondSampleStandsAtItsOwnPlace) {
  const TestFolder folder;
  const auto file = folder.path() / "wide.tif";
  constexpr int samples = 2000;
  GDALAllRegister();
  const GDALDatasetH grid =
      GDALCreate(GDALGetDriverByName("GTiff"), file.c_str(), samples, 4, 1, GDT_Float32, nullptr);
  double transform[]{0.0, 1.0, 0.0, 0.0, 0.0, -1.0};
  GDALSetGeoTransform(grid, transform);
  std::vector<float> heights;
  for (int i = 0; i < 4 * samples; ++i) heights.push_back(float(i % samples));  // as far east as they lie
  EXPECT_EQ(GDALRasterIO(GDALGetRasterBand(grid, 1), GF_Write, 0, 0, samples, 4, heights.data(), samples, 4,
                         GDT_Float32, 0, 0),
            CE_None);
  int half = 2;
  EXPECT_EQ(GDALBuildOverviews(grid, "AVERAGE", 1, &half, 0, nullptr, nullptr, nullptr), CE_None);
  GDALClose(grid);
  Errors warnings;
  const Result<Model> model = read_terrain(file, std::nullopt, warnings);
  ASSERT_TRUE(model) << to_string(model.errors());
  for (const Part& part : model->parts)
    for (const glm::vec3& point : part.mesh.positions)
      EXPECT_NEAR(double(point.x) + model->origin.x, double(point.z) + model->origin.z + 0.5, 1e-3);
}

TEST(Terrain, AGridIsLaidOnTheMapOfTheScene) {
  const TestFolder folder;
  const auto file = folder.path() / "zone.tif";
  const double transform[]{700'000.0, 2.0, 0.0, 5'700'000.0, 0.0, -2.0};
  write_grid(file, transform, 25832);
  Errors warnings;
  std::optional<glm::dvec2> place_deg;
  const Result<Model> own = read_terrain(file, std::nullopt, warnings, &place_deg),
                      laid = read_terrain(file, std::nullopt, warnings, nullptr, "EPSG:25833");
  ASSERT_TRUE(own && laid);
  EXPECT_EQ(own->map, "EPSG:25832");
  EXPECT_EQ(laid->map, "EPSG:25833");
  ASSERT_TRUE(place_deg);
  const auto zone_33 = MapProjection::of("EPSG:25833"), zone_32 = MapProjection::of("EPSG:25832");
  ASSERT_TRUE(zone_32 && zone_33);
  EXPECT_NEAR(glm::distance((*zone_33)(*place_deg), glm::dvec2(laid->origin)), 0.0, 3.0);
  EXPECT_NEAR(own->true_north_deg, -2.26, 0.05)
      << "north of a grid lies east of the earth's, east of its meridian";
  EXPECT_GT(laid->true_north_deg, 2.0);
}

TEST(MapProjection, DegreesComeBackAndNorthIsThatOfTheMeridian) {
  const glm::dvec2 kilpisjarvi_deg(20.79, 69.04);
  const auto finland = MapProjection::of("EPSG:3067");  // of one meridian, 27 degrees east
  ASSERT_TRUE(finland);
  EXPECT_NEAR(finland->true_north_deg(kilpisjarvi_deg), 5.80, 0.01);
  EXPECT_NEAR(glm::distance(finland->degrees((*finland)(kilpisjarvi_deg)), kilpisjarvi_deg), 0.0, 1e-9);
  const auto new_york = MapProjection::of("EPSG:2263");  // in feet
  ASSERT_TRUE(new_york);
  EXPECT_NEAR((*new_york)({-74.0, 40.1666667}).x, 300'000.0, 2.0) << "metres of its false easting";
  for (const char* none : {"", "EPSG:4326", "EPSG:999999", "nonsense"})
    EXPECT_FALSE(MapProjection::of(none)) << none;
  const MapProjection fiji = MapProjection::utm({180.5, -17.0});
  EXPECT_EQ(fiji.system(), "EPSG:32701") << "beyond the date line";
}

}  // namespace
}  // namespace parvis::scene
