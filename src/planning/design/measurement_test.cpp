#include "planning/design/measurement.h"

#include "planning/design/design_json.h"
#include "planning/design/test_design.h"

namespace parvis::design {
namespace {

class MeasurementTest : public DesignTest {
 protected:
  Measurement measured(const std::string& name) const {
    for (const Measurement& each : session_->measurements())
      if (each.name == name) return each;
    ADD_FAILURE() << "no " << name;
    return {};
  }
};

TEST_F(MeasurementTest, MeasuresInMetresSquareMetresAndPercent) {
  open();
  run("measure distance 0,0,0 3,4,0 3,4,2");
  EXPECT_NEAR(measured("distance_1").value(), 7.0, 1e-6);
  EXPECT_EQ(measured("distance_1").text(), "7.00 m");
  run("measure area 0,0,1 4,0,1 4,3,1.5 0,3,1.5 name court");
  EXPECT_NEAR(measured("court").value(), 12.0, 1e-6) << "in plan";
  EXPECT_EQ(measured("court").text(), "12.00 m\u00b2");
  run("measure height 1,1,0.15 2,1,4.65");
  EXPECT_EQ(measured("height_1").text(), "+4.50 m");
  EXPECT_EQ(measured("height_1").line().at(1), glm::dvec3(2, 1, 0.15)) << "level first, then upright";
  run("measure slope 0,0,0.5 10,0,0");
  EXPECT_NEAR(measured("slope_1").value(), -0.05, 1e-6);
  EXPECT_EQ(measured("slope_1").text(), "-5.0 % (-2.9\u00b0)");
  EXPECT_EQ(visible(), 0) << "pictures do not show measurements";
  EXPECT_TRUE(session_->objects().empty()) << "nor are they counted as objects";
}

TEST_F(MeasurementTest, PointsMoveAndComeBack) {
  open();
  run("measure distance 0,0 3,4 name ruler");
  run("point ruler 2 to 6,8");
  EXPECT_NEAR(measured("ruler").value(), 10.0, 1e-6);
  run("move ruler by 1,0");
  EXPECT_EQ(measured("ruler").points.front(), glm::dvec3(1, 0, 0));
  EXPECT_NEAR(measured("ruler").value(), 10.0, 1e-6);
  run("undo"), run("undo");
  EXPECT_NEAR(measured("ruler").value(), 5.0, 1e-6);
  run("redo");
  EXPECT_NEAR(measured("ruler").value(), 10.0, 1e-6);
  run("surface lawn 0,0 4,0 4,4 name green");
  run("point green 2 to 8,0");
  EXPECT_NEAR(signed_area_m2(object("green").outline), 16.0, 1e-6);
  run("lock ruler");
  EXPECT_NE(refusal("point ruler 1 to 0,1").find("locked"), std::string::npos);
  run("select all");
  EXPECT_EQ(session_->selected(), (Names{"ruler", "green"}));
  run("unlock selected"), run("delete selected");
  EXPECT_TRUE(session_->measurements().empty());
}

TEST_F(MeasurementTest, RefusesWhatCannotBeMeasured) {
  open();
  EXPECT_NE(refusal("measure volume 0,0 1,1").find("distance"), std::string::npos);
  EXPECT_NE(refusal("measure distance 0,0").find("two points"), std::string::npos);
  EXPECT_NE(refusal("measure area 0,0 1,1").find("three corners"), std::string::npos);
  EXPECT_NE(refusal("measure area 0,0 4,4 4,0 0,4").find("crosses itself"), std::string::npos);
  EXPECT_NE(refusal("measure height 0,0 1,1 2,2").find("two points"), std::string::npos);
  EXPECT_NE(refusal("measure slope 1,1,0 1,1,3").find("one above the other"), std::string::npos);
  EXPECT_NE(refusal("measure distance 0,0 1e30,0").find("origin"), std::string::npos);
  EXPECT_NE(refusal("measure distance 0,0 x,0").find("a point"), std::string::npos);
  run("measure slope 0,0,0 1,0,0.1 name ramp");
  EXPECT_NE(refusal("point ramp 3 to 1,1").find("points 1 to 2"), std::string::npos);
  EXPECT_NE(refusal("point ramp 2 to 0,0").find("one above the other"), std::string::npos);
  EXPECT_NE(refusal("point ramp 2 to 1e30,0").find("origin"), std::string::npos);
  run("insert bollard 5,5 name post");
  EXPECT_NE(refusal("point post 1 to 1,1").find("no points"), std::string::npos);
  EXPECT_NE(refusal("swap ramp for bollard").find("measurement"), std::string::npos);
  EXPECT_NE(refusal("colour ramp #FF0000").find("no colour"), std::string::npos);
}

TEST_F(MeasurementTest, AScriptSaysWhereItIsWrong) {
  const auto loaded = ScriptTest::load(
      "camera(name=eye)\ndesign(name=a) {\n  measured(name=m, kind=slope, points=\"0 0 0\")\n}");
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.errors().front().where.line, 3);
  EXPECT_NE(loaded.errors().front().message.find("two points"), std::string::npos);
  EXPECT_FALSE(ScriptTest::load("design(name=a) { measured(name=m, kind=volume, points=\"0 0 0, 1 1 1\") }"));
}

TEST_F(MeasurementTest, JsonKeepsThem) {
  open();
  run("measure area 0,0 4,0 4,3 name court");
  const std::string json = json_of(scene_, *session_, "design.json");
  const std::string before = session_->script();
  open();
  ASSERT_TRUE(read_json(json, "a.json", *session_, {}));
  EXPECT_EQ(session_->script(), before);
  const Status bad =
      read_json(R"({"parvis_design":1,"objects":[{"kind":"measured","measures":"area","points":[[0,0]]}]})",
                "b.json", *session_, {});
  ASSERT_FALSE(bad);
  EXPECT_NE(bad.errors().front().message.find("[x, y, z]"), std::string::npos);
}

}  // namespace
}  // namespace parvis::design
