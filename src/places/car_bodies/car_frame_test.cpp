#include "places/car_bodies/car_frame.h"

#include <gtest/gtest.h>

#include "places/car_bodies/body.h"
#include "places/car_bodies/test_car.h"

namespace parvis::car_bodies {
namespace {

using namespace test;

const glm::vec3 x_axis(1, 0, 0), y_axis(0, 1, 0), z_axis(0, 0, 1);

CarFrame frame_of(const scene::Model& model) {
  const Result<CarFrame> frame = find_frame(model, "car.obj");
  EXPECT_TRUE(frame) << (frame ? "" : to_string(frame.errors()));
  return frame ? *frame : CarFrame();
}

/// The car stands as bare_body does, but for its place.
void expect_upright(const scene::Model& model, const CarFrame& frame) {
  const scene::Model usual = bare_body();
  const Bounds expected = Body(usual).bounds(), found = Body(model, frame.car_from_model()).bounds();
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(found.size()[axis], expected.size()[axis], 0.01f) << axis;
  // The cabin is at the rear.
  Bounds cabin;
  const Body body(model, frame.car_from_model());
  for (std::size_t i = 0; i < model.parts[0].mesh.triangle_count(); ++i)
    for (const glm::vec3& corner : body.corners(0, i))
      if (corner.z > found.min.z + 0.9f * found.size().z) cabin.add(corner);
  ASSERT_FALSE(cabin.empty());
  EXPECT_LT(cabin.centre().x, found.centre().x - 0.1f);
}

TEST(CarFrame, ABodyThatLiesAsWantedStaysSo) {
  const CarFrame frame = frame_of(bare_body());
  EXPECT_EQ(frame.up, "");
  EXPECT_EQ(frame.heading_deg, 0.0f);
  EXPECT_EQ(frame.scale, 1.0f);
  EXPECT_NEAR(frame.aside_m, 0.0f, 1e-4f);
}

TEST(CarFrame, LengthAlongAnotherAxisIsTurned) {
  // A file with y up and its length along z: along y of the model as read, to either side.
  for (const float turn : {90.0f, -90.0f, 180.0f}) {
    const scene::Model model = moved(bare_body(), turned_about(z_axis, turn));
    const CarFrame frame = frame_of(model);
    EXPECT_EQ(frame.heading_deg, turn);  // clockwise, whereas the file was turned the other way
    expect_upright(model, frame);
  }
}

TEST(CarFrame, AFileWithTheOtherUpAxisIsReadSo) {
  // z up read as y up: what was up is toward -y; and the other way round.
  for (const auto& [degrees, up] : {std::pair(90.0f, "z"), std::pair(-90.0f, "y")}) {
    const scene::Model along_x = moved(bare_body(), turned_about(x_axis, degrees));
    EXPECT_EQ(frame_of(along_x).up, up);
    expect_upright(along_x, frame_of(along_x));
    const scene::Model along_y =
        moved(bare_body(), turned_about(x_axis, degrees) * turned_about(z_axis, 90.0f));
    EXPECT_EQ(frame_of(along_y).up, up);
    expect_upright(along_y, frame_of(along_y));
  }
}

TEST(CarFrame, UnitsAreKnownByTheSizeOfACar) {
  for (const auto& [unit, metres] : {std::pair("millimetres", 0.001f), std::pair("centimetres", 0.01f),
                                     std::pair("inches", 0.0254f), std::pair("feet", 0.3048f)}) {
    const scene::Model model = moved(bare_body(), scaled(1.0f / metres));
    const CarFrame frame = frame_of(model);
    EXPECT_EQ(frame.unit, unit);
    EXPECT_EQ(frame.scale, metres);
    EXPECT_NEAR(frame.units_long, 4.4f / metres, 0.01f / metres);
    expect_upright(model, frame);
  }
}

TEST(CarFrame, ABusOfTwelveMetresIsNoCarInFeet) {
  const scene::Model bus =
      moved(bare_body(), glm::scale(glm::mat4(1.0f), glm::vec3(12.0f / 4.4f, 2.5f / 1.7f, 3.0f / 1.28f)));
  EXPECT_EQ(frame_of(bus).scale, 1.0f);
}

TEST(CarFrame, ASizeOfNoUnitIsAGuessThatSaysSo) {
  const CarFrame frame = frame_of(moved(bare_body(), scaled(1.0f / 4.4f)));
  EXPECT_TRUE(frame.is_guess);
  EXPECT_NEAR(frame.scale, 4.4f, 0.02f);
}

TEST(CarFrame, AMirrorOnOneSideMovesNoMiddle) {
  scene::Model model = bare_body();
  add_quad(model.parts[0],
           {{0.6f, 0.85f, 0.8f}, {0.7f, 0.85f, 0.8f}, {0.7f, 1.1f, 0.8f}, {0.6f, 1.1f, 0.8f}});
  EXPECT_NEAR(frame_of(model).aside_m, 0.0f, 1e-3f);
  const CarFrame aside = frame_of(moved(model, glm::translate(glm::mat4(1.0f), {7.0f, 3.0f, 0.0f})));
  EXPECT_NEAR(aside.aside_m, 3.0f, 1e-3f);
}

TEST(CarFrame, WhatIsFlatOrOnItsSideIsAnError) {
  scene::Model flat = bare_body();
  for (glm::vec3& at : flat.parts[0].mesh.positions) at.y = 0.0f;
  EXPECT_FALSE(find_frame(flat, "car.obj"));
  const auto on_its_side = find_frame(moved(bare_body(), turned_about(y_axis, 90.0f)), "car.obj");
  ASSERT_FALSE(on_its_side);
  EXPECT_NE(to_string(on_its_side.errors()).find("on its side"), std::string::npos);
}

TEST(CarFrame, ThousandsOfTrianglesAsLongAsTheCarAreRefused) {
  const auto with_long_triangles = [](int pairs) {
    scene::Model model = bare_body();
    scene::Part sheet;
    sheet.object = "sheet";
    add_quad(sheet,
             {{-2.2f, -0.85f, 0.12f}, {2.2f, -0.85f, 0.12f}, {2.2f, 0.85f, 1.4f}, {-2.2f, 0.85f, 1.4f}});
    const std::vector<std::uint32_t> pair = sheet.mesh.indices;
    for (int i = 1; i < pairs; ++i)
      sheet.mesh.indices.insert(sheet.mesh.indices.end(), pair.begin(), pair.end());
    model.parts.push_back(std::move(sheet));
    return model;
  };
  EXPECT_TRUE(find_frame(with_long_triangles(20), "car.obj"));
  const Result<CarFrame> frame = find_frame(with_long_triangles(3000), "car.obj");
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.errors().front().where.file, "car.obj");
  EXPECT_NE(frame.errors().front().message.find("as long as the whole car"), std::string::npos);
}

}  // namespace
}  // namespace parvis::car_bodies
