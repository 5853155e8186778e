#include "capture/facades/scan_trim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "capture/facades/test_measure_place.h"
#include "capture/facades/test_street.h"

namespace parvis::facades {
namespace {

constexpr double house_end = 2.0;  ///< x, where the wall ends and nothing but what is far is seen

/// A far wall of differently coloured fields, and a plain one before it with a hole.
glm::vec3 colour(glm::dvec3 p) {
  if (p.y < 7.0) return {0.3 + 0.1 * std::sin(3.0 * p.x), 0.3 + 0.1 * std::sin(4.0 * p.z + p.x), 0.2};
  const auto field = [&](double shift) {
    return std::abs(std::sin(12.9898 * std::floor(p.x) + 78.233 * std::floor(p.z) + shift));
  };
  return {0.9 * field(0.0), 0.9 * field(1.0), 0.9 * field(2.0)};
}

std::vector<NamedMesh> truth() {
  return {wall("far", 14, -30, 30, -20, 20), wall("left", 6, -3, -1, -2, 2), wall("right", 6, 0, 2, -2, 2),
          wall("below", 6, -1, 0, -2, -0.5f), wall("above", 6, -1, 0, 0.5f, 2)};
}

/// The front wall as one fine sheet that goes on beyond its end, and over the hole.
NamedMesh scan() {
  constexpr std::uint32_t columns = 60, rows = 40;
  NamedMesh named{"scan", {}};
  for (std::uint32_t row = 0; row <= rows; ++row)
    for (std::uint32_t column = 0; column <= columns; ++column)
      named.mesh.positions.emplace_back(-3.0f + 7.0f * float(column) / columns, 6.0f,
                                        -2.0f + 4.0f * float(row) / rows);
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t a = row * (columns + 1) + column, b = a + 1, c = a + columns + 1, d = c + 1;
      named.mesh.indices.insert(named.mesh.indices.end(), {a, b, d, a, d, c});
    }
  fill_normals(named.mesh);
  named.mesh.uvs.assign(named.mesh.positions.size(), glm::vec2(0.0f));
  return named;
}

struct PhotographedScan {
  TestFolder folder;
  std::vector<photographs::Photograph> photos;
  PhotographedScan() {
    for (int i = 0; i < 5; ++i)
      photos.push_back(photograph_of(truth(), colour, folder, fmt::format("{}.png", i),
                                     test_view(240, 180, {0.7 * i - 1.0, 0, 0.3 * (i % 2)}),
                                     0.8f + 0.1f * float(i)));
  }
};

/// Triangles whose middle lies in the rectangle.
long count_in(const Mesh& mesh, double left, double right, double bottom, double top) {
  long count = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    glm::dvec3 middle(0.0);
    for (std::size_t k = 0; k < 3; ++k) middle += glm::dvec3(mesh.positions[mesh.indices[3 * t + k]]) / 3.0;
    count += middle.x > left && middle.x < right && middle.z > bottom && middle.z < top;
  }
  return count;
}

TEST(ScanTrim, WhatGoesOnBeyondTheHouseIsCutOffAndTheHouseStays) {
  const PhotographedScan place;
  const std::vector<NamedMesh> meshes{scan(), wall("few", 20, -40, 40, -30, 30)};
  const Result<TrimmedScans> trimmed = trimmed_scans(meshes, place.photos);
  ASSERT_TRUE(trimmed) << to_string(trimmed.errors());
  ASSERT_EQ(trimmed->meshes.size(), 2u);
  const Mesh &before = meshes[0].mesh, &after = trimmed->meshes[0].mesh;
  // Colours are means over 5 x 5 pixels and over the neighbours: the cut is exact to some triangles.
  EXPECT_EQ(count_in(after, house_end + 0.4, 4.0, -2.0, 2.0), 0);
  EXPECT_GT(count_in(before, house_end + 0.4, 4.0, -2.0, 2.0), 900) << "the control: there it was";
  EXPECT_EQ(count_in(after, -3.0, house_end - 0.4, -2.0, 2.0),
            count_in(before, -3.0, house_end - 0.4, -2.0, 2.0))
      << "the wall stays, and so does what closes the hole in it";
  EXPECT_EQ(trimmed->meshes[1].mesh.positions, meshes[1].mesh.positions) << "a mesh of few triangles stays";
  const std::string text = to_string(trimmed->notes);
  EXPECT_NE(text.find("scan: "), std::string::npos) << text;
  EXPECT_NE(text.find("were cut off"), std::string::npos) << text;
  EXPECT_TRUE(check(after, "scan"));
  EXPECT_LT(after.positions.size(), before.positions.size()) << "no vertex is left without a triangle";
}

TEST(ScanTrim, WhatIsCutOffLacksInWhatAMeasurementCovers) {
  const PhotographedScan place;
  const std::vector<NamedMesh> meshes{scan()};
  const Result<PlaceFigures> whole = measured_place(place.photos, meshes, {"2.png"}, {1, false, false}),
                             trimmed = measured_place(place.photos, meshes, {"2.png"}, {1, false, true});
  ASSERT_TRUE(whole && trimmed);
  const MethodFigures &before = whole->methods.front(), &after = trimmed->methods.front();
  EXPECT_GT(before.covered_percent, 99.0);
  EXPECT_LT(after.covered_percent, before.covered_percent - 10.0) << "two of seven metres are cut off";
  EXPECT_GT(after.psnr_cc_db, before.psnr_cc_db + 1.0) << "of what is left";
}

TEST(ScanTrim, WithoutASecondPhotographNothingIsCutOff) {
  PhotographedScan place;
  place.photos.resize(1);
  const Result<TrimmedScans> trimmed = trimmed_scans({scan()}, place.photos);
  ASSERT_TRUE(trimmed);
  EXPECT_TRUE(trimmed->notes.empty()) << to_string(trimmed->notes);
  EXPECT_EQ(trimmed->meshes[0].mesh.indices, scan().mesh.indices);
}

TEST(ScanTrim, TheBackdropStays) {
  const PhotographedScan place;
  std::vector<NamedMesh> meshes{scan()};
  meshes[0].name = backdrop_name;
  const Result<TrimmedScans> trimmed = trimmed_scans(meshes, place.photos);
  ASSERT_TRUE(trimmed);
  EXPECT_EQ(trimmed->meshes[0].mesh.indices, scan().mesh.indices);
}

TEST(ScanTrim, APhotographThatCannotBeReadIsNamedAndAnEmptyModelIsAnError) {
  PhotographedScan place;
  place.photos[0].file = place.folder.path() / "missing.png";
  const Result<TrimmedScans> trimmed = trimmed_scans({scan()}, place.photos);
  ASSERT_TRUE(trimmed);
  EXPECT_NE(to_string(trimmed->notes).find("missing.png"), std::string::npos) << to_string(trimmed->notes);
  EXPECT_FALSE(trimmed_scans({}, place.photos));
}

}  // namespace
}  // namespace parvis::facades
