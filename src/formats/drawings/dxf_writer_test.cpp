#include "formats/drawings/dxf_writer.h"

#include <gtest/gtest.h>

#include "base/files.h"
#include "base/test_folder.h"
#include "formats/drawings/drawing_reader.h"

namespace parvis::formats {
namespace {

DxfPlan test_plan() {
  DxfPlan plan;
  plan.lines.push_back({"Bâti",
                        {200, 0, 0},
                        {{1043012.4001, 6298021.7002, 10},
                         {1043013, 6298022, 11.5},
                         {1043014, 6298022, 12},
                         {1043012.4001, 6298021.7002, 10}}});
  plan.lines.push_back({"KERBS", {0, 0, 0}, {{0, 0, 5}, {10, 0, 5}, {10, 10, 5}}});
  plan.lines.push_back({"WALLS", {0, 0, 0}, {{0, 0, 0}, {0, 0, 3}}});
  plan.blocks.push_back(
      {"BENCH", {{{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}, {-0.5, -0.5, 0}}}});
  plan.inserts.push_back({"BENCH", "FURNITURE", {0, 0, 200}, {3, 4, 0.5}, {2, 0.5, 0.45}, 30});
  plan.texts.push_back({"TEXTS", "Place de la \"Liberté\"", {1, 2, 0}, 0.5});
  return plan;
}

TEST(DxfWriter, IsReadBackInMetresWhereItWas) {
  const TestFolder folder;
  const std::filesystem::path file = folder.path() / "plan.dxf";
  const Status written = write_dxf(file, test_plan());
  ASSERT_TRUE(written) << to_string(written.errors());
  Errors warnings;
  const Result<Drawing> drawing = read_drawing(file, std::nullopt, warnings);
  ASSERT_TRUE(drawing) << to_string(drawing.errors());
  EXPECT_TRUE(warnings.empty()) << to_string(warnings);
  EXPECT_EQ(drawing->metres_per_unit, 1.0) << "$INSUNITS 6";
  EXPECT_EQ(drawing->entity_counts.at("Bati").at("POLYLINE"), 1) << "a sloping outline is a 3D polyline";
  EXPECT_EQ(drawing->entity_counts.at("KERBS").at("LWPOLYLINE"), 1);
  EXPECT_EQ(drawing->entity_counts.at("FURNITURE").at("INSERT"), 1);
  ASSERT_EQ(drawing->lines.size(), 4u);
  EXPECT_EQ(drawing->lines[0].points, test_plan().lines[0].points);
  EXPECT_EQ(drawing->lines[1].points, test_plan().lines[1].points) << "at its height";
  EXPECT_EQ(drawing->lines[2].points, test_plan().lines[2].points) << "a vertical line is not lost";
  ASSERT_EQ(drawing->blocks.size(), 1u);
  EXPECT_EQ(drawing->blocks[0].position, glm::dvec3(3, 4, 0.5));
  EXPECT_NEAR(drawing->blocks[0].heading_deg, 330.0, 1e-9);
  EXPECT_NEAR(drawing->blocks[0].size_m->x, 2.0, 1e-9);
  EXPECT_NEAR(drawing->blocks[0].size_m->y, 0.5, 1e-9);
  ASSERT_EQ(drawing->texts.size(), 1u);
  EXPECT_NE(drawing->texts[0].text.find("Liberté"), std::string::npos) << drawing->texts[0].text;
}

TEST(DxfWriter, SaysMetresAndMetric) {
  const TestFolder folder;
  const std::filesystem::path file = folder.path() / "plan.dxf";
  ASSERT_TRUE(write_dxf(file, test_plan()));
  const Result<std::string> text = read_file(file);
  ASSERT_TRUE(text);
  EXPECT_NE(text->find("$INSUNITS\n 70\n     6\n"), std::string::npos);
  EXPECT_NE(text->find("$MEASUREMENT\n 70\n     1\n"), std::string::npos);
}

TEST(DxfWriter, NamesAreThoseThatEveryReaderTakes) {
  EXPECT_EQ(dxf_name("Forêt d'œuvres 3"), "Foret_d_oeuvres_3");
  EXPECT_EQ(dxf_name(""), "0");
}

TEST(DxfWriter, WritesNothingWhereItCannot) {
  const TestFolder folder;
  folder.write("file", "");
  EXPECT_FALSE(write_dxf(folder.path() / "file" / "plan.dxf", test_plan()));
}

}  // namespace
}  // namespace parvis::formats
