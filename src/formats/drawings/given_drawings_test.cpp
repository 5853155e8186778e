// The drawings of ../shared/data/plan, whose coordinates come from a script, not from a reader.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "base/test_data.h"
#include "formats/drawings/drawing_facts.h"
#include "formats/drawings/drawing_reader.h"

namespace parvis::formats {
namespace {

using nlohmann::json;

constexpr double tolerance_m = 0.001;  // of the given coordinates and of ours

glm::dvec3 point_of(const json& numbers) {
  return {numbers[0].get<double>(), numbers[1].get<double>(),
          numbers.size() > 2 ? numbers[2].get<double>() : 0.0};
}

double distance(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::distance(glm::dvec2(a), glm::dvec2(b));
}

double distance_to(const DrawingLine& line, const glm::dvec3& point) {
  double nearest = 1e9;
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
    const glm::dvec2 a(line.points[i]), ab = glm::dvec2(line.points[i + 1]) - a;
    const double along = glm::clamp(glm::dot(glm::dvec2(point) - a, ab) / glm::dot(ab, ab), 0.0, 1.0);
    nearest = std::min(nearest, glm::distance(glm::dvec2(point), a + along * ab));
  }
  return nearest;
}

struct Given {
  json expected;
  Drawing drawing;
  double max_error_m = 0.0;  ///< of all that was compared

  int layer(const std::string& name) const {
    for (std::size_t i = 0; i < drawing.layers.size(); ++i)
      if (drawing.layers[i].name == name) return int(i);
    ADD_FAILURE() << "no layer " << name;
    return -1;
  }
  void note(double error_m, const std::string& what) {
    EXPECT_LE(error_m, tolerance_m) << what;
    max_error_m = std::max(max_error_m, error_m);
  }
  /// The nearest end or corner of a layer's lines.
  void expect_corner(const std::string& on, const json& at, const std::string& what) {
    double nearest = 1e9;
    for (const DrawingLine& line : drawing.lines)
      if (line.layer == layer(on))
        for (const glm::dvec3& point : line.points)
          nearest = std::min(nearest, distance(point, point_of(at)));
    note(nearest, what);
  }
  void expect_on_line(const std::string& on, const json& at, const std::string& what) {
    double nearest = 1e9;
    for (const DrawingLine& line : drawing.lines)
      if (line.layer == layer(on)) nearest = std::min(nearest, distance_to(line, point_of(at)));
    note(nearest, what);
  }
};

class GivenDrawings : public testing::Test {
 protected:
  template <class Check>
  void each(const Check& check) const {
    const auto folder = shared_data("plan");
    if (!folder) GTEST_SKIP() << "the shared drawings are not here";
    const json cases = json::parse(std::ifstream(*folder / "expected.json"));
    ASSERT_EQ(cases["files"].size(), 3u);
    for (const json& expected : cases["files"]) {
      const std::string name = expected["file"];
      SCOPED_TRACE(name);
      const auto unit = expected["insunits"].is_null()
                            ? std::optional(expected["metres_per_unit"].get<double>())
                            : std::nullopt;
      Errors warnings;
      Result<Drawing> drawing = read_drawing(*folder / name, unit, warnings);
      ASSERT_TRUE(drawing) << to_string(drawing.errors());
      EXPECT_TRUE(warnings.empty()) << to_string(warnings);
      Given given{expected, *std::move(drawing)};
      check(given);
      std::printf("%s: largest error %.4f mm\n", name.c_str(), 1000.0 * given.max_error_m);
    }
  }
};

TEST_F(GivenDrawings, TreesStandWhereTheyAreWithTheirCrownsAndAttributes) {
  each([](Given& given) {
    for (const auto& [name, tree] : given.expected["trees"].items()) {
      const auto block = std::ranges::find_if(given.drawing.blocks, [&](const PlacedBlock& placed) {
        const auto number = placed.attributes.find("NUM");
        return number != placed.attributes.end() && number->second == name;
      });
      ASSERT_NE(block, given.drawing.blocks.end()) << name;
      EXPECT_EQ(block->block, tree["block"].get<std::string>());
      EXPECT_EQ(block->attributes.at("ESSENCE"), tree["species"].get<std::string>());
      EXPECT_EQ(given.drawing.layers[std::size_t(block->layer)].name, "ARBRES");
      EXPECT_EQ(block->is_mirrored, name == "A7");
      given.note(distance(block->position, point_of(tree["centre"])), name);
      ASSERT_TRUE(block->size_m) << name;
      given.note(std::abs(block->size_m->x / 2.0 - tree["crown_radius"].get<double>()), name + " crown");
    }
  });
}

TEST_F(GivenDrawings, CornersOfBenchesKerbsAndBuildings) {
  each([](Given& given) {
    for (const auto& [name, bench] : given.expected["benches"].items())
      for (const json& corner : bench["corners"]) given.expect_corner("MOBILIER", corner, name);
    for (const json& corner : given.expected["building_corners"])
      given.expect_corner("BATI", corner, "building");
    for (const json& corner : given.expected["kerb_3_corners"])
      given.expect_corner("VOIRIE_BORDURE", corner, "kerb 3");
    for (const json& end : given.expected["kerb_2_ends"])
      given.expect_corner("VOIRIE_BORDURE", end, "kerb 2");
    for (const json& corner : given.expected["tram_axis"]["vertices"])
      given.expect_corner("TRAM_AXE", corner, "axis");
    for (const json& corner : given.expected["frame_corners"]) given.expect_corner("FOND", corner, "frame");
    for (const json& end : given.expected["path_ends"]) given.expect_corner("CHEMINEMENT", end, "path");
    for (const auto& [name, lamp] : given.expected["lamps"].items()) {
      double nearest = 1e9;
      for (const DrawingLine& line : given.drawing.lines)
        if (line.layer == given.layer("ECLAIRAGE")) {
          glm::dvec3 min(1e9), max(-1e9);
          for (const glm::dvec3& point : line.points) min = glm::min(min, point), max = glm::max(max, point);
          nearest = std::min(nearest, distance(0.5 * (min + max), point_of(lamp)));
        }
      given.note(nearest, name);
    }
  });
}

TEST_F(GivenDrawings, ArcsBulgesAndEllipses) {
  each([](Given& given) {
    for (const auto& [name, arc] : given.expected["arcs"].items()) {
      const std::string layer = name.starts_with("tram") ? "TRAM_AXE"
                                : name == "seat_arc"     ? "MOBILIER"
                                                         : "VOIRIE_BORDURE";
      for (const char* part : {"start", "middle", "end"}) given.expect_on_line(layer, arc[part], name);
    }
    const json& basin = given.expected["basin"];
    const double turn = basin["major_axis_degrees"].get<double>() * 3.14159265358979323846 / 180.0;
    const glm::dvec3 centre = point_of(basin["centre"]);
    for (int k = 0; k < 16; ++k) {
      const double t = 0.3926990817 * k, x = 4.0 * std::cos(t), y = 2.0 * std::sin(t);
      given.expect_on_line("BASSIN",
                           {centre.x + x * std::cos(turn) - y * std::sin(turn),
                            centre.y + x * std::sin(turn) + y * std::cos(turn)},
                           "basin");
    }
  });
}

TEST_F(GivenDrawings, WidthsPointsAreasAndTexts) {
  each([](Given& given) {
    int stripes = 0;
    for (const DrawingLine& line : given.drawing.lines)
      if (line.layer == given.layer("VOIRIE_MARQUAGE"))
        ++stripes, given.note(std::abs(line.width_m - 0.5), "stripe");
    EXPECT_EQ(stripes, 5);
    for (const auto& [name, at] : given.expected["survey_points"].items()) {
      double nearest = 1e9;
      for (const DrawingPoint& point : given.drawing.points)
        nearest = std::min(nearest, glm::distance(point.position, point_of(at)));
      given.note(nearest, name);
    }
    std::vector<double> areas;
    for (const DrawingArea& area : given.drawing.areas) {
      if (area.layer != given.layer("HACHURES")) continue;
      double sum = 0.0;
      for (const auto& ring : area.rings) {
        double twice = 0.0;
        for (std::size_t i = 0; i < ring.size(); ++i) {
          const glm::dvec3 a = ring[i] - ring[0], b = ring[(i + 1) % ring.size()] - ring[0];
          twice += a.x * b.y - a.y * b.x;
        }
        sum += sum == 0.0 ? std::abs(twice) / 2.0 : -std::abs(twice) / 2.0;
      }
      areas.push_back(sum);
    }
    ASSERT_EQ(areas.size(), 2u);
    for (const char* name : {"grass", "paving"}) {
      const double expected = given.expected["hatch_areas_m2"][name];
      EXPECT_LT(std::min(std::abs(areas[0] - expected), std::abs(areas[1] - expected)), 0.05) << name;
    }
    for (const char* name : {"title", "storeys"}) {
      const json& text = given.expected["texts"][name];
      const auto found =
          std::ranges::find(given.drawing.texts, text["text"].get<std::string>(), &DrawingText::text);
      ASSERT_NE(found, given.drawing.texts.end()) << text["text"];
      given.note(distance(found->position, point_of(text["at"])), name);
    }
    EXPECT_TRUE(std::ranges::any_of(given.drawing.texts, [](const DrawingText& text) {
      return text.text == "Axe du tramway\nrayon 25 m puis 30 m";
    }));
  });
}

TEST_F(GivenDrawings, UnitsLayersAndCounts) {
  each([](Given& given) {
    EXPECT_NEAR(given.drawing.metres_per_unit, given.expected["metres_per_unit"].get<double>(), 1e-12);
    EXPECT_EQ(given.drawing.version, given.expected["dxf_version"].get<std::string>());
    for (const DrawingLayer& layer : given.drawing.layers)
      EXPECT_EQ(layer.is_on, layer.name != "AIDE") << layer.name;
    int paper = 0;
    for (const auto& [layer, types] : given.expected["paper_space_entities"].items())
      for (const auto& [type, count] : types.items()) paper += count.get<int>();
    EXPECT_GE(given.drawing.paper_entities, paper);
    json counts = json::object();
    for (const auto& [layer, types] : given.drawing.entity_counts)
      for (const auto& [type, count] : types) counts[layer][type] = count;
    EXPECT_EQ(counts, given.expected["model_space_counts"]);
    EXPECT_TRUE(given.drawing.left_out.empty());
    const bool is_far = given.expected["insunits"] == 6;
    EXPECT_EQ(given.drawing.local_origin() != glm::dvec3(0.0), is_far);
  });
}

TEST_F(GivenDrawings, OneWithoutAUnitIsRefusedWithItsExtent) {
  const auto folder = shared_data("plan");
  if (!folder) GTEST_SKIP() << "the shared drawings are not here";
  Errors warnings;
  const Result<Drawing> drawing = read_drawing(*folder / "square_no_unit_cm.dxf", std::nullopt, warnings);
  ASSERT_FALSE(drawing);
  const std::string message = to_string(drawing.errors());
  for (const char* part :
       {"no unit", "in metres it measures 6", "in centimetres 6", "in millimetres 6", "unit="})
    EXPECT_NE(message.find(part), std::string::npos) << message;
}

}  // namespace
}  // namespace parvis::formats
