#include "capture/facades/place_report.h"

#include <gtest/gtest.h>

#include "base/files.h"
#include "capture/facades/test_street.h"

namespace parvis::facades {
namespace {

TEST(PlaceReport, NamesSurfacesThatNoPhotographShowsAndTheirProposals) {
  const Photos input;
  std::vector<NamedMesh> meshes = street();
  meshes.push_back(wall("behind <us>", -6, -4, 4, -2, 3));
  PlaceLayers place = *place_layers(input.photos, meshes);
  place.surfaces[1] = Filling::refused;
  const TestFolder folder;
  ASSERT_TRUE(write_report(folder.path(), place, packed_facade(place)));
  const std::string page = *read_file(folder.path() / "index.html");
  for (const char* row : {"<tr><td>far<td>0.0 %<td>proposal", "<tr><td>near<td>0.0 %<td>refused",
                          "<tr><td>behind &lt;us&gt;<td>100.0 %<td>proposal"})
    EXPECT_NE(page.find(row), std::string::npos) << row;
  EXPECT_TRUE(read_image8(folder.path() / "0001-coverage.png"));
}

}  // namespace
}  // namespace parvis::facades
