#include "formats/drawings/drawing_reader.h"

#include <gtest/gtest.h>

#include <cstring>

#include "base/test_folder.h"
#include "formats/drawings/drawing_account.h"
#include "formats/drawings/drawing_facts.h"
#include "formats/drawings/drawing_text.h"
#include "formats/drawings/test_drawing.h"

namespace parvis::formats {
namespace {

Result<Drawing> parsed(const TestDrawing& file, std::optional<double> unit = std::nullopt) {
  Errors warnings;
  return parse_drawing(file.text(), "test.dxf", unit, warnings);
}

Drawing drawing_of(const TestDrawing& file, std::optional<double> unit = std::nullopt) {
  Result<Drawing> drawing = parsed(file, unit);
  EXPECT_TRUE(drawing) << to_string(drawing.errors());
  return drawing ? *std::move(drawing) : Drawing();
}

std::string message_of(const TestDrawing& file) {
  const Result<Drawing> drawing = parsed(file);
  EXPECT_FALSE(drawing);
  return drawing ? "" : to_string(drawing.errors());
}

/// How far a point lies from all that is drawn.
double distance_to(const Drawing& drawing, glm::dvec2 point) {
  double nearest = 1e9;
  const auto note = [&](glm::dvec2 a, glm::dvec2 b) {
    const glm::dvec2 ab = b - a;
    const double square = glm::dot(ab, ab);
    const double along = square > 0.0 ? glm::clamp(glm::dot(point - a, ab) / square, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, glm::distance(point, a + along * ab));
  };
  for (const DrawingLine& line : drawing.lines)
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i)
      note(glm::dvec2(line.points[i]), glm::dvec2(line.points[i + 1]));
  for (const DrawingArea& area : drawing.areas)
    for (const auto& ring : area.rings)
      for (std::size_t i = 0; i < ring.size(); ++i)
        note(glm::dvec2(ring[i]), glm::dvec2(ring[(i + 1) % ring.size()]));
  for (const DrawingText& text : drawing.texts) note(glm::dvec2(text.position), glm::dvec2(text.position));
  return nearest;
}

// Below, an entity of extrusion (0, 0, -1) lies in a plane whose x axis points west: x = -x, y = y.
struct Mirrored {
  const char* kind;
  const char* entity;
  std::vector<glm::dvec2> through;  ///< points that it passes
  glm::dvec2 min, max;              ///< of all of it
};

TEST(DrawingReader, PutsEntitiesOfMirroredPlanesWhereTheyBelong) {
  const double s = std::sqrt(0.5);
  const std::vector<Mirrored> cases{
      {"ARC",
       "0 ARC|5 A|8 0|10 10|20 5|40 2|50 0|51 90|230 -1",
       {{-12, 5}, {-10, 7}, {-10 - 2 * s, 5 + 2 * s}},
       {-12, 5},
       {-10, 7}},
      {"CIRCLE", "0 CIRCLE|5 A|8 0|10 10|20 5|40 2|230 -1", {{-8, 5}, {-10, 7}}, {-12, 3}, {-8, 7}},
      // The ellipse's centre and axis are in the world; its minor axis is normal x major: it runs clockwise.
      {"ELLIPSE",
       "0 ELLIPSE|5 A|8 0|100 AcDbEllipse|10 10|20 5|11 3|21 0|31 0|230 -1|40 0.5|41 0|42 1.5707963267949",
       {{13, 5}, {10, 3.5}, {10 + 3 * s, 5 - 1.5 * s}},
       {10, 3.5},
       {13, 5}},
      {"LWPOLYLINE",
       "0 LWPOLYLINE|5 A|8 0|100 AcDbPolyline|90 3|70 0|10 1|20 1|10 4|20 1|42 1|10 4|20 3|210 0|220 0|230 "
       "-1",
       {{-1, 1}, {-4, 1}, {-5, 2}, {-4, 3}},
       {-5, 1},
       {-1, 3}},
      {"POLYLINE",
       "0 POLYLINE|5 A|8 0|66 1|70 0|230 -1|0 VERTEX|8 0|10 1|20 1|0 VERTEX|8 0|10 4|20 1|42 1|0 VERTEX|8 "
       "0|10 "
       "4|20 3|0 SEQEND|8 0",
       {{-1, 1}, {-4, 1}, {-5, 2}, {-4, 3}},
       {-5, 1},
       {-1, 3}},
      {"HATCH",
       "0 HATCH|5 A|8 0|100 AcDbHatch|10 0|20 0|30 0|210 0|220 0|230 -1|2 SOLID|70 1|71 0|91 1|92 2|72 1|73 "
       "1|93 "
       "3|10 1|20 1|42 0|10 4|20 1|42 1|10 4|20 3|42 0|97 0|75 0|76 1|98 0",
       {{-1, 1}, {-4, 1}, {-5, 2}, {-4, 3}},
       {-5, 1},
       {-1, 3}},
      {"SOLID",
       "0 SOLID|5 A|8 0|10 1|20 1|11 4|21 1|12 1|22 3|13 4|23 3|230 -1",
       {{-1, 1}, {-4, 3}, {-2, 3}},
       {-4, 1},
       {-1, 3}},
      {"TEXT", "0 TEXT|5 A|8 0|10 1|20 2|40 1|1 A|230 -1", {{-1, 2}}, {-1, 2}, {-1, 2}},
      // The block's line (1, 0)-(3, 0) about its base (1, 0), twice as long, turned by 30 degrees in its
      // plane.
      {"INSERT",
       "0 INSERT|5 A|8 0|2 B|10 10|20 5|41 2|42 3|50 30|230 -1",
       {{-10, 5}, {-10 - 4 * std::sqrt(0.75), 7}},
       {-10 - 4 * std::sqrt(0.75), 5},
       {-10, 7}},
      {"LINE (in the world)", "0 LINE|5 A|8 0|10 1|20 2|11 3|21 4|230 -1", {{1, 2}, {3, 4}}, {1, 2}, {3, 4}},
  };
  for (const Mirrored& each : cases) {
    SCOPED_TRACE(each.kind);
    TestDrawing file;
    file.blocks = "0 BLOCK|8 0|2 B|70 0|10 1|20 0|0 LINE|8 0|10 1|20 0|11 3|21 0|0 ENDBLK";
    file.entities = each.entity;
    const Drawing drawing = drawing_of(file);
    for (const glm::dvec2 point : each.through) EXPECT_LE(distance_to(drawing, point), max_chord_gap_m);
    EXPECT_LE(glm::distance(glm::dvec2(drawing.min), each.min), max_chord_gap_m);
    EXPECT_LE(glm::distance(glm::dvec2(drawing.max), each.max), max_chord_gap_m);
  }
}

TEST(DrawingReader, PlacedBlocksAreSymbolsWithTheirPlaceTurnAndMirror) {
  TestDrawing file;
  file.blocks =
      "0 BLOCK|8 0|2 B|70 0|10 1|20 0|0 LINE|8 0|10 1|20 0|11 3|21 0|0 LINE|8 OWN|10 1|20 0|11 1|21 1|0 "
      "ENDBLK";
  file.entities =
      "0 INSERT|5 A|8 TREES|66 1|2 B|10 10|20 5|41 2|42 3|50 90|0 ATTRIB|8 0|10 0|20 0|40 1|1 Ch\\U+00EAne|2 "
      "KIND|0 SEQEND|8 0|"
      "0 INSERT|5 B|8 TREES|2 B|10 7|20 5|41 -1|0 INSERT|5 C|8 TREES|2 B|70 3|71 2|44 5|45 7|10 100|20 0|50 "
      "90";
  const Drawing drawing = drawing_of(file);
  ASSERT_EQ(drawing.blocks.size(), 8u);
  const PlacedBlock& turned = drawing.blocks[0];
  EXPECT_EQ(turned.block, "B");
  EXPECT_EQ(drawing.layers[std::size_t(turned.layer)].name, "TREES");
  EXPECT_EQ(turned.position, glm::dvec3(10, 5, 0));
  EXPECT_EQ(turned.scale, glm::dvec3(2, 3, 1));
  EXPECT_NEAR(turned.heading_deg, 270.0, 1e-9) << "the block's y axis points west";
  EXPECT_FALSE(turned.is_mirrored);
  EXPECT_EQ(turned.attributes.at("KIND"), "Chêne");
  ASSERT_TRUE(turned.centre && turned.size_m);
  EXPECT_NEAR(turned.size_m->x, 4.0, 1e-9);
  EXPECT_NEAR(turned.size_m->y, 3.0, 1e-9);
  EXPECT_NEAR(turned.centre->x, 8.5, 1e-9);
  EXPECT_NEAR(turned.centre->y, 7.0, 1e-9);
  EXPECT_TRUE(drawing.blocks[1].is_mirrored);
  // The array's rows run along its turned y axis.
  EXPECT_NEAR(drawing.blocks[4].position.y, 10.0, 1e-9);
  EXPECT_NEAR(drawing.blocks[5].position.x, 93.0, 1e-9);
  for (std::size_t copy = 2; copy < drawing.blocks.size(); ++copy) {
    const PlacedBlock& block = drawing.blocks[copy];
    ASSERT_TRUE(block.centre && block.size_m) << "copy " << copy;
    EXPECT_NEAR(glm::distance(*block.size_m, {2.0, 1.0}), 0.0, 1e-9) << "as large as one, not as the array";
    EXPECT_NEAR(glm::distance(*block.centre, glm::dvec2(block.position) + glm::dvec2(-0.5, 1.0)), 0.0, 1e-9);
  }
  EXPECT_EQ(drawing.entity_counts.at("TREES").at("INSERT"), 3);
  EXPECT_TRUE(std::ranges::any_of(drawing.lines, [&](const DrawingLine& line) {
    return drawing.layers[std::size_t(line.layer)].name == "OWN";
  })) << "parts of a block keep their own layers";
}

TEST(DrawingReader, UnitsBecomeMetres) {
  TestDrawing file;
  file.entities = "0 LINE|5 A|8 0|10 0|20 0|11 100|21 0";
  const std::vector<std::pair<std::string, double>> units{{"1", 2.54}, {"2", 30.48}, {"4", 0.1},
                                                          {"5", 1.0},  {"6", 100.0}, {"14", 10.0}};
  for (const auto& [code, length_m] : units) {
    file.header = "9 $ACADVER|1 AC1015|9 $INSUNITS|70 " + code;
    EXPECT_NEAR(drawing_of(file).max.x, length_m, 1e-9) << code;
  }
  EXPECT_NEAR(drawing_of(file, 0.01).max.x, 1.0, 1e-9)
      << "what the caller says goes before what the file says";
}

TEST(DrawingReader, AsksForAUnitWhereNoneIsNamedOrInchesCannotBe) {
  TestDrawing file;
  file.header = "9 $ACADVER|1 AC1015|9 $INSUNITS|70 0";
  file.entities = "0 LINE|5 A|8 0|10 0|20 0|11 6000|21 4000";
  const std::string message = message_of(file);
  for (const char* part : {"no unit", "6000 x 4000 m", "60 x 40 m", "6 x 4 m", "unit="})
    EXPECT_NE(message.find(part), std::string::npos) << message;
  file.header = "9 $ACADVER|1 AC1015|9 $INSUNITS|70 1";
  file.entities = "0 LINE|5 A|8 0|10 1043012|20 6298021|11 1043072|21 6298061";
  EXPECT_NE(message_of(file).find("inches"), std::string::npos);
  EXPECT_NE(message_of(file).find("60 x 40 m"), std::string::npos);
}

TEST(DrawingReader, LayersAreOffFrozenAndColoured) {
  TestDrawing file;
  file.layers =
      "0 LAYER|2 ON|70 0|62 3|0 LAYER|2 OFF|70 0|62 -5|0 LAYER|2 FROZEN|70 1|62 1|0 LAYER|2 For\\U+00EAt|70 "
      "4|62 92";
  file.entities =
      "0 LINE|5 A|8 ON|10 0|20 0|11 1|21 0|0 LINE|5 B|8 OFF|10 0|20 1|11 1|21 1|0 LINE|5 C|8 For\\U+00EAt|62 "
      "1|10 0|20 2|11 "
      "1|21 2|0 LINE|5 D|8 NOT_IN_TABLE|10 0|20 3|11 1|21 3";
  const Drawing drawing = drawing_of(file);
  ASSERT_EQ(drawing.layers.size(), 5u);
  EXPECT_TRUE(drawing.layers[0].is_shown());
  EXPECT_FALSE(drawing.layers[1].is_on);
  EXPECT_EQ(drawing.layers[1].colour_index, 5);
  EXPECT_TRUE(drawing.layers[2].is_frozen);
  EXPECT_EQ(drawing.layers[3].name, "Forêt");
  EXPECT_EQ(drawing.layers[4].name, "NOT_IN_TABLE");
  ASSERT_EQ(drawing.lines.size(), 4u);
  EXPECT_EQ(drawing.lines[0].colour, glm::u8vec3(0, 255, 0)) << "its layer's";
  EXPECT_EQ(drawing.lines[2].layer, 3);
  EXPECT_EQ(drawing.lines[2].colour, glm::u8vec3(255, 0, 0)) << "its own";
}

TEST(DrawingReader, TextIsUtf8WhateverTheCodePage) {
  EXPECT_EQ(decoded("Libert\xe9 \x80"), "Liberté €");
  EXPECT_EQ(decoded("Liberté"), "Liberté");
  EXPECT_EQ(decoded("\\U+00E9\\U+D83C\\U+DF33 \\U+00G0"), "é🌳 \\U+00G0");
  EXPECT_EQ(decoded("a\\U+000Ab"), "a b") << "a line's end would shift all groups";
  TestDrawing file;
  for (const char* page : {"ANSI_1252", "ANSI_1251", "UTF-8"}) {
    file.header = std::string("9 $ACADVER|1 AC1024|9 $DWGCODEPAGE|3 ") + page + "|9 $INSUNITS|70 6";
    file.entities = "0 TEXT|5 A|8 0|10 1|20 2|40 0.5|50 30|1 Liberté \\U+2013 %%d";
    const Drawing drawing = drawing_of(file);
    ASSERT_EQ(drawing.texts.size(), 1u);
    EXPECT_EQ(drawing.texts[0].text, "Liberté – °") << page;
    EXPECT_NEAR(drawing.texts[0].height_m, 0.5, 1e-9);
    EXPECT_NEAR(drawing.texts[0].angle_deg, 30.0, 1e-9);
  }
}

TEST(DrawingReader, CountsWhatIsNotDrawn) {
  TestDrawing file;
  file.entities =
      "0 LINE|5 A|8 0|10 0|20 0|11 1|21 1|0 RAY|5 B|8 0|10 0|20 0|11 1|21 0|0 ACAD_TABLE|5 C|8 0|0 "
      "ACAD_TABLE|5 D|8 0|0 "
      "LINE|5 E|8 0|67 1|10 0|20 0|11 1|21 1|0 LINE|5 F|8 0|10 1e30|20 0|11 1|21 1";
  Errors warnings;
  const Result<Drawing> drawing = parse_drawing(file.text(), "test.dxf", std::nullopt, warnings);
  ASSERT_TRUE(drawing);
  EXPECT_EQ(drawing->left_out.at("RAY"), 1);
  EXPECT_EQ(drawing->left_out.at("ACAD_TABLE"), 2);
  EXPECT_EQ(drawing->far_away, 1);
  EXPECT_EQ(drawing->paper_entities, 1);
  EXPECT_EQ(drawing->lines.size(), 1u);
  EXPECT_TRUE(warnings.empty());
  const scene::FileAccount account = account_of(*drawing, "test.dxf");
  EXPECT_EQ(account.count(scene::Fate::left_out, "ACAD_TABLE"), 2u);
  EXPECT_EQ(account.count(scene::Fate::left_out, "entities in layouts"), 1u);
  EXPECT_EQ(account.count(scene::Fate::used, "LINE"), 1u) << "the other one lies too far away";
  EXPECT_NE(to_string(account.warnings()).find("2 ACAD_TABLE left out"), std::string::npos);
  file.entities = "0 RAY|5 B|8 0|10 0|20 0|11 1|21 0|0 RAY|5 C|8 0|10 0|20 0|11 1|21 1";
  const Result<Drawing> empty = parse_drawing(file.text(), "test.dxf", std::nullopt, warnings);
  ASSERT_FALSE(empty);
  EXPECT_NE(to_string(empty.errors()).find("nothing is drawn in model space; not read: 2 RAY"),
            std::string::npos)
      << to_string(empty.errors());
}

/// The binary form of a text file; with codes of one byte, as before AC1012, if `is_old`.
std::string binary_of(const std::string& text, bool is_old) {
  std::string bytes("AutoCAD Binary DXF\r\n\x1a\0", 22);
  std::size_t at = 0;
  const auto line = [&] {
    const std::size_t end = text.find('\n', at);
    const std::string taken = text.substr(at, end - at);
    at = end + 1;
    return taken;
  };
  const auto put = [&](auto value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  while (at < text.size()) {
    const int code = std::stoi(line());
    const std::string value = line();
    if (is_old) {
      put(static_cast<unsigned char>(code));
    } else {
      put(std::int16_t(code));
    }
    if ((code >= 10 && code < 60) || (code >= 210 && code < 240)) {
      put(std::stod(value));
    } else if (code >= 60 && code < 80) {
      put(std::int16_t(std::stoi(value)));
    } else if (code >= 90 && code < 100) {
      put(std::int32_t(std::stoi(value)));
    } else {
      bytes += value;
      bytes += '\0';
    }
  }
  return bytes;
}

TEST(DrawingReader, BinaryFilesAreReadAsTextOnes) {
  TestDrawing file;
  file.layers = "0 LAYER|2 OFF|70 0|62 -5";
  file.entities =
      "0 ARC|5 A|8 OFF|10 1043012.4|20 6298021.7|40 2.125|50 0|51 90|230 -1|0 TEXT|5 B|8 0|10 1|20 2|40 1|1 "
      "R+4";
  for (const bool is_old : {false, true}) {
    Errors warnings;
    const auto as_text = parse_drawing(file.text(), "text.dxf", std::nullopt, warnings);
    const auto as_binary =
        parse_drawing(binary_of(file.text(), is_old), "binary.dxf", std::nullopt, warnings);
    ASSERT_TRUE(as_text);
    ASSERT_TRUE(as_binary) << to_string(as_binary.errors());
    ASSERT_EQ(as_binary->lines.size(), 1u);
    EXPECT_EQ(as_binary->lines[0].points, as_text->lines[0].points);
    EXPECT_FALSE(as_binary->layers[0].is_on);
    EXPECT_EQ(as_binary->texts.at(0).text, "R+4");
    const std::string whole = binary_of(file.text(), is_old);
    for (std::size_t size = 22; size < whole.size(); size += 7)
      EXPECT_FALSE(parse_drawing(whole.substr(0, size), "cut.dxf", std::nullopt, warnings)) << size;
  }
}

TEST(DrawingReader, SaysWhatIsWrongWithAFile) {
  TestDrawing file;
  file.entities = "0 LINE|5 A|8 0|10 0|20 0|11 1|21 1";
  const std::string whole = file.text();
  const auto message = [](const std::string& bytes) {
    Errors warnings;
    const auto drawing = parse_drawing(bytes, "test.dxf", std::nullopt, warnings);
    return drawing ? std::string() : to_string(drawing.errors());
  };
  EXPECT_EQ(message(whole), "");
  EXPECT_NE(message(whole.substr(0, whole.find("LINE") + 8)).find("within the section ENTITIES"),
            std::string::npos);
  EXPECT_NE(message(whole.substr(0, whole.rfind("EOF") - 3)).find("the file was cut"), std::string::npos);
  EXPECT_NE(message("AC1024\0").find("DWG"), std::string::npos);
  EXPECT_NE(message("<svg/>").find("no DXF file"), std::string::npos);
  EXPECT_NE(message("").find("no DXF file"), std::string::npos);
  file.entities = "0 LINE|5 A|8 0|67 1|10 0|20 0|11 1|21 1";
  EXPECT_NE(message(file.text()).find("paper space"), std::string::npos);
  file.entities = "0 LINE|broken code|8 0";
  EXPECT_NE(message(file.text()).find("no group code"), std::string::npos);
}

TEST(DrawingReader, ComesBackWholeFromItsProcess) {
  TestDrawing file;
  file.entities =
      "0 LINE|5 A|8 WALLS|10 1043012.4001|20 6298021.7002|11 1043013|21 6298022|0 RAY|5 B|8 0|10 0|20 0|11 "
      "1|21 0|0 "
      "INSERT|5 C|8 0|2 NONE|10 1|20 2";
  const TestFolder folder;
  Errors warnings;
  const Result<Drawing> drawing = read_drawing(folder.write("plan.dxf", file.text()), std::nullopt, warnings);
  ASSERT_TRUE(drawing) << to_string(drawing.errors());
  ASSERT_EQ(drawing->lines.size(), 1u);
  EXPECT_EQ(drawing->lines[0].points[0], glm::dvec3(1043012.4001, 6298021.7002, 0)) << "in double precision";
  EXPECT_EQ(drawing->local_origin(), glm::dvec3(1043012, 6298021, 0));
  EXPECT_EQ(drawing->blocks.size(), 1u);
  EXPECT_EQ(drawing->left_out.at("RAY"), 1);
  EXPECT_TRUE(warnings.empty());
  EXPECT_FALSE(read_drawing(folder.path() / "missing.dxf", std::nullopt, warnings));
}

}  // namespace
}  // namespace parvis::formats
