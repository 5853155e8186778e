#include "places/car_bodies/car_script.h"

#include <gtest/gtest.h>

#include "places/car_bodies/body_surfaces.h"
#include "places/car_bodies/test_car.h"
#include "places/car_bodies/wheel_arches.h"

namespace parvis::car_bodies {
namespace {

using namespace test;

std::string script_of(const scene::Model& model) {
  const Result<std::string> script = car_script(model, "body.obj");
  EXPECT_TRUE(script) << (script ? "" : to_string(script.errors()));
  return script ? *script : "";
}

bool holds(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

TEST(CarScript, WheelsFillTheArches) {
  const scene::Model model = bare_body();
  const std::optional<WheelFit> fit = fit_wheels(SideView(Body(model)));
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->left_x, -axle_x, 0.03f);
  EXPECT_NEAR(fit->right_x, axle_x, 0.03f);
  EXPECT_NEAR(fit->radius, 0.82f * arch_radius, 0.05f);
  EXPECT_LT(fit->axle_z + fit->radius, arch_z + arch_radius);
  EXPECT_NEAR(fit->track, 1.7f - fit->width, 0.05f);
}

TEST(CarScript, WheelsInFlatArchesDoNotRaiseTheBodyHigh) {
  const scene::Model model = moved(bare_body(), glm::scale(glm::mat4(1.0f), {1.0f, 1.0f, 0.7f}));
  const SideView side{Body(model)};
  const std::optional<WheelFit> fit = fit_wheels(side);
  ASSERT_TRUE(fit);
  const float clearance_m = side.bounds().min.z - (fit->axle_z - fit->radius);
  EXPECT_GT(clearance_m, 0.1f);
  EXPECT_LT(clearance_m, 0.23f);
}

TEST(CarScript, TheCabinSaysWhereTheFrontIs) {
  const scene::Model model = bare_body();
  EXPECT_FALSE(faces_back(SideView(Body(model))));
  EXPECT_TRUE(faces_back(SideView(Body(model, glm::scale(glm::mat4(1.0f), {-1, 1, 1})))));
}

TEST(CarScript, ABodyThatFacesBackHasItsFrontAxleThere) {
  const std::string script = script_of(moved(bare_body(), turned_about({0, 0, 1}, 180.0f)));
  EXPECT_TRUE(holds(script, "heading_deg=180")) << script;
  EXPECT_TRUE(holds(script, "  wheels(front_axle_x=-1.30, rear_axle_x=1.30")) << script;
}

TEST(CarScript, PanesAreTheGreyOfThePicture) {
  const scene::Model model = bare_body();
  const Body body(model);
  const std::vector<BodySurface> surfaces = surfaces_of(body, samples_of(body), {});
  ASSERT_EQ(surfaces.size(), 1u);
  EXPECT_EQ(surfaces[0].finish, Finish::paint);
  ASSERT_EQ(surfaces[0].masks.glass.size(), 1u);
  const PictureMask& mask = surfaces[0].masks.glass[0];
  EXPECT_TRUE(mask.is_grey);
  EXPECT_NEAR(mask.box->min.x, 0.55f, 0.02f);
  EXPECT_NEAR(mask.box->max.y, 0.6f, 0.02f);
  EXPECT_TRUE(surfaces[0].masks.lamps.empty());
}

TEST(CarScript, TheScriptSaysWhatWasNotFound) {
  scene::Model model = bare_body();
  const std::string whole = script_of(model);
  EXPECT_TRUE(holds(whole, "  wheels(front_axle_x=1.")) << whole;
  EXPECT_TRUE(holds(whole, "preset=\"glass\""));
  model.materials[0].base_colour_texture = scene::no_index;
  for (glm::vec3& position : model.parts[0].mesh.positions)
    if (position.z < shoulder_z) position.z = 0.12f;  // sides without arches
  const std::string plain = script_of(model);
  EXPECT_TRUE(holds(plain, "No two arches were found")) << plain;
  EXPECT_TRUE(holds(plain, "No panes were found")) << plain;
}

TEST(CarScript, OpeningsWithoutPanesAreSaid) {
  scene::Model model = bare_body();
  // Windows are cut out of the mesh: only the roof's edge and the pillars stay above the shoulder.
  set_apart(model, "", [](glm::vec3 at) { return is_above_shoulder(at); });
  model.parts.pop_back();
  for (const float y : {-half_width, half_width})
    for (const auto& [low, high] : {std::pair(glm::vec2(-1.9f, 0.8f), glm::vec2(-1.8f, 1.4f)),
                                    std::pair(glm::vec2(0.6f, 0.8f), glm::vec2(0.7f, 1.4f)),
                                    std::pair(glm::vec2(-1.9f, 1.3f), glm::vec2(0.7f, 1.4f))})
      add_quad(model.parts[0],
               {{low.x, y, low.y}, {high.x, y, low.y}, {high.x, y, high.y}, {low.x, y, high.y}}, {0.1f, 0.1f},
               {0.2f, 0.2f});
  const std::string script = script_of(model);
  EXPECT_TRUE(holds(script, "openings of 1.")) << script;
  EXPECT_FALSE(holds(script_of(bare_body()), "openings"));
}

TEST(CarScript, TurnedAndScaledFilesSaySo) {
  const std::string centimetres = script_of(moved(car_with_wheels(), scaled(100.0f)));
  EXPECT_TRUE(holds(centimetres, "taken as centimetres, for a length of 4.40 m")) << centimetres;
  EXPECT_TRUE(holds(centimetres, ", scale=0.01,")) << centimetres;
  const std::string across = script_of(moved(car_with_wheels(), turned_about({0, 0, 1}, 90.0f)));
  EXPECT_TRUE(holds(across, "heading_deg=90,")) << across;
  EXPECT_FALSE(holds(across, "scale=")) << across;
  const std::string unknown = script_of(moved(bare_body(), scaled(1.0f / 4.4f)));
  EXPECT_TRUE(holds(unknown, "in no unit that makes it a car")) << unknown;
}

TEST(CarScript, WheelsThatTheFileHasGetNoOthers) {
  const std::string script = script_of(car_with_wheels());
  EXPECT_FALSE(holds(script, "wheels(front")) << script;
  EXPECT_TRUE(holds(script, "axles at x=1.30 (radius 0.31), x=-1.30 (radius 0.31)")) << script;
  EXPECT_TRUE(holds(script, "material(target=\"shell\", preset=\"paint\")")) << script;  // and not the wheels
  EXPECT_TRUE(holds(script, "With -o SCRIPT.xp")) << script;
}

TEST(CarScript, WheelsOfABodyInOtherUnitsAreACommentWithoutACopy) {
  const std::string script = script_of(moved(bare_body(), scaled(100.0f)));
  EXPECT_TRUE(holds(script, "// wheels(front_axle_x=1.30")) << script;
  EXPECT_TRUE(holds(script, "With -o SCRIPT.xp")) << script;
}

}  // namespace
}  // namespace parvis::car_bodies
