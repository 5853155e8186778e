#include "planning/plan_drawing/council_sheet.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "base/files.h"
#include "base/test_folder.h"

namespace parvis::plan_drawing {
namespace {

design::PlacedObject umbrella(const std::string& name, glm::dvec2 at) {
  design::PlacedObject made;
  made.name = name, made.kind = "umbrella", made.label = "Umbrella", made.design = "new";
  made.position = glm::dvec3(at, 0.0), made.size_m = {3.0, 3.0, 2.5};
  made.outline = design::rectangle_outline(at, {3.0, 3.0}, 0.0);
  return made;
}

design::Difference of(design::Differs how, glm::dvec2 at, double moved_m = 0.0) {
  design::Difference made{how, umbrella("u", at), umbrella("u", at + glm::dvec2(moved_m, 0.0)), moved_m};
  if (how == design::Differs::added) made.before = {};
  if (how == design::Differs::removed) made.after = {};
  return made;
}

TEST(CouncilSheet, ItsTableCountsWhatDiffersAlike) {
  const std::vector<DifferenceRow> rows =
      difference_rows({of(design::Differs::added, {0, 0}), of(design::Differs::moved, {5, 0}, 0.4),
                       of(design::Differs::added, {9, 0}), of(design::Differs::moved, {5, 9}, 1.25),
                       of(design::Differs::removed, {1, 9})});
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].how, design::Differs::removed);
  EXPECT_EQ(rows[1].count, 2);
  EXPECT_EQ(rows[1].detail, "3.00 x 3.00 x 2.50 m");
  EXPECT_EQ(rows[2].detail, "by 0.40 to 1.25 m");
}

TEST(CouncilSheet, ThePlanShowsAllThatDiffersAtAUsualScale) {
  const auto extent =
      extent_of({of(design::Differs::added, {-10, 2}), of(design::Differs::moved, {8, 4}, 2.0)});
  ASSERT_TRUE(extent);
  EXPECT_NEAR(extent->first.x, 0.0, 1e-9);
  EXPECT_NEAR(extent->second.x, 11.5, 1e-9);
  EXPECT_EQ(fitting_scale(extent->second), 200.0);
  EXPECT_EQ(fitting_scale({1.0, 1.0}), 100.0);
  EXPECT_FALSE(extent_of({})) << "two designs that are the same";
}

TEST(CouncilSheet, SunHasFiguresAndPictures) {
  SunDifference sun;
  sun.columns = 2, sun.rows = 1, sun.cell_m = 2.0, sun.max_hours = 10.0;
  sun.is_ground = {1, 0}, sun.before = {8.0f, 0.0f}, sun.after = {5.0f, 0.0f};
  const SunPictures made = sun_pictures(sun);
  EXPECT_EQ(made.figures[0],
            (std::vector<std::string>{"Mean hours of sun per day", "8.0 h", "5.0 h", "-3.0 h"}));
  EXPECT_EQ(made.figures[3][3], "4 m\u00b2") << "loses an hour or more";
  EXPECT_EQ(made.max_change_h, 3.0);
  EXPECT_GT(int(made.change.at(0, 0)[2]), int(made.change.at(0, 0)[0])) << "blue: less sun";
  EXPECT_EQ(int(made.change.at(1, 0)[0]), 255) << "no ground: white";
}

TEST(CouncilSheet, PagesAreWrittenWhole) {
  const TestFolder folder;
  CouncilSheet sheet;
  sheet.title = "Place de la Libert\u00e9", sheet.before = "old", sheet.after = "new";
  sheet.differences = {of(design::Differs::added, {0, 0}), of(design::Differs::moved, {5, 0}, 0.4)};
  sheet.rows = difference_rows(sheet.differences);
  const SheetPicture picture{Image8(16, 9, 3, 128), {}};
  sheet.views.assign(3, {"street", picture, picture});
  ASSERT_TRUE(write_council_sheet(folder.path() / "council.pdf", sheet));
  if (std::system("pdftotext -v 2> /dev/null") != 0) GTEST_SKIP() << "skipped: pdftotext is not here";
  ASSERT_EQ(
      std::system(fmt::format("cd '{}' && pdftotext -layout council.pdf", folder.path().string()).c_str()),
      0);
  const Result<std::string> text = read_file(folder.path() / "council.txt");
  ASSERT_TRUE(text);
  for (const char* const said :
       {"page 1 of 3", "page 3 of 3", "street: old", "1 added, 1 moved", "1:200 on A3", "by 0.40 m"})
    EXPECT_NE(text->find(said), std::string::npos) << said << " in\n" << *text;
  sheet.words = design::words_in(design::Language::french);
  sheet.rows = difference_rows(sheet.differences, sheet.words);
  ASSERT_TRUE(write_council_sheet(folder.path() / "council.pdf", sheet));
  ASSERT_EQ(std::system(fmt::format("cd '{}' && pdftotext council.pdf", folder.path().string()).c_str()), 0);
  const Result<std::string> french = read_file(folder.path() / "council.txt");
  ASSERT_TRUE(french);
  for (const char* const said :
       {"page 1 sur 3", "ajouts : 1, déplacements : 1", "de 0,40 m", "Ce qui change"})
    EXPECT_NE(french->find(said), std::string::npos) << said << " in\n" << *french;
  sheet.scale = 1.0;
  EXPECT_FALSE(write_council_sheet(folder.path() / "other.pdf", sheet));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "other.pdf"));
}

}  // namespace
}  // namespace parvis::plan_drawing
