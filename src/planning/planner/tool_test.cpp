// The tool driven by a pointer in three views: a plan, a street and a balcony.
#include "planning/planner/tool.h"

#include "graphics/render/drawables.h"
#include "planning/design/test_design.h"
#include "scene/data/test_scene.h"

namespace parvis::planner {
namespace {

constexpr glm::ivec2 size(1280, 720);

Camera plan_view(float height_m) {
  Camera camera;
  camera.world_from_camera = look_at({0, 0, 200}, {0, 0, 0}, {0, 1, 0});
  camera.parallel = ParallelView{height_m, 200.0f};
  return camera;
}

Camera street_view() {
  Camera camera;
  camera.world_from_camera = look_at({-2, -12, 1.7f}, {0, 0, 0.5f});
  return camera;
}

Camera balcony_view() {
  Camera camera;
  camera.world_from_camera = look_at({9, -14, 9}, {0, 0, 0});
  return camera;
}

class ToolTest : public design::DesignTest {
 protected:
  void place(const std::string& script) {
    open(script);
    scene::add(scene_, scene::model_of(scene::ground(60), scene::matt(glm::vec3(0.3f))));
    registries_.get<render::Drawables>().attach(scene_);
    surfaces_.emplace(scene_);
    tool_.emplace(scene_, live_, *session_, *surfaces_);
    tool_->grid_m = 0.0;
  }

  /// The pointer at a place of the world in the picture.
  Pointer at(glm::dvec3 place) const {
    Pointer pointer;
    pointer.camera = camera_, pointer.size = size;
    const glm::vec4 clip = camera_.clip_from_camera(float(size.x) / float(size.y)) *
                           camera_.camera_from_world() * glm::vec4(glm::vec3(place), 1.0f);
    pointer.pixel = (glm::dvec2(clip) / double(clip.w) * glm::dvec2(0.5, -0.5) + 0.5) * glm::dvec2(size);
    return pointer;
  }
  void click(const Pointer& pointer) {
    tool_->point(pointer);
    tool_->press(pointer);
    const Status status = tool_->release(pointer);
    EXPECT_TRUE(status) << to_string(status.errors());
  }
  void drag(const Pointer& from, const Pointer& to) {
    tool_->point(from);
    tool_->press(from);
    Pointer half = to;
    half.pixel = 0.5 * (from.pixel + to.pixel);
    tool_->point(half);
    tool_->point(to);
    const Status status = tool_->release(to);
    EXPECT_TRUE(status) << to_string(status.errors());
  }
  void expect_near(const std::string& name, glm::dvec2 at, double within_m) {
    EXPECT_LT(glm::distance(glm::dvec2(object(name).position), at), within_m)
        << name << " at " << object(name).position.x << ' ' << object(name).position.y;
  }

  Camera camera_ = plan_view(20.0f);
  std::optional<design::SceneSurfaces> surfaces_;
  std::optional<Tool> tool_;
};

TEST_F(ToolTest, PlacesAgainAndAgainInEveryView) {
  place("camera(name=eye)");
  tool_->choose_kind("bench_stone");
  int number = 0;
  for (const Camera& view : {plan_view(20.0f), street_view(), balcony_view()}) {
    camera_ = view;
    const glm::dvec2 wanted(-2.0 + 2.3 * number, 0.7 * number);
    click(at(glm::dvec3(wanted, 0.0)));
    expect_near(fmt::format("bench_stone_{}", ++number), wanted, 0.02);
  }
  EXPECT_EQ(session_->objects().size(), 3u);
  EXPECT_EQ(tool_->mode(), Mode::insert) << "until another is picked";
}

TEST_F(ToolTest, ShowsWhatAClickWouldPlaceAndLeavesNothingBehind) {
  place("design(name=a) { placed(kind=table, name=table_1, position=\"3 0 0\") }");
  const std::string before = session_->script();
  tool_->choose_kind("umbrella");
  tool_->point(at({-1, 2, 0}));
  ASSERT_FALSE(tool_->preview().is_empty());
  const scene::Object& shown = tool_->preview().scene().objects.front();
  EXPECT_NEAR(shown.world_from_model[3].x, -1.0f, 0.02f);
  EXPECT_NEAR(shown.world_from_model[3].y, 2.0f, 0.02f);
  EXPECT_EQ(session_->script(), before);
  const std::size_t objects = scene_.objects.size();
  tool_->point(at({1, -2, 0}));
  EXPECT_EQ(tool_->preview().scene().objects.size(), 1u) << "the same object, elsewhere";
  EXPECT_EQ(scene_.objects.size(), objects);
  EXPECT_TRUE(tool_->cancel());
  EXPECT_TRUE(tool_->preview().is_empty());
  EXPECT_EQ(tool_->mode(), Mode::select);
}

TEST_F(ToolTest, WhatWasPlacedStaysInThePictureUntilItSettles) {
  place("camera(name=eye)");
  tool_->choose_kind("bollard");
  click(at({1, 1, 0}));
  EXPECT_TRUE(tool_->has_unsettled());
  EXPECT_FALSE(tool_->preview().is_empty());
  tool_->point(at({1, 1, 0}));
  EXPECT_EQ(tool_->refusal(), "") << "the click's own place is no taken one";
  for (const scene::Object& shown : tool_->preview().scene().objects) EXPECT_EQ(shown.paint, nullptr);
  const std::vector<std::uint8_t> stays = tool_->preview().what_stays();
  EXPECT_EQ(stays.back(), 0) << "the picture below is still that without it";
  tool_->leave();
  EXPECT_FALSE(tool_->preview().is_empty());
  tool_->point(at({1, 1, 0}));
  tool_->settle();
  EXPECT_TRUE(tool_->preview().is_empty()) << "none hangs there until the pointer moves";
  tool_->point(at({2, 1, 0}));
  EXPECT_FALSE(tool_->preview().is_empty());
  EXPECT_EQ(session_->objects().size(), 1u);
}

TEST_F(ToolTest, RefusesATakenPlaceAndSaysWhy) {
  place("design(name=a) { placed(kind=table, name=table_1, position=\"3 0 0\") }");
  tool_->choose_kind("table");
  Pointer there = at({3, 0, 0});
  there.is_free = true;
  tool_->point(there);
  EXPECT_NE(tool_->refusal().find("table_1"), std::string::npos) << tool_->refusal();
  ASSERT_FALSE(tool_->preview().is_empty());
  EXPECT_NE(tool_->preview().scene().objects.front().paint, nullptr) << "in red";
  tool_->press(there);
  EXPECT_FALSE(tool_->release(there));
  EXPECT_EQ(session_->objects().size(), 1u);
  tool_->point(at({-3, 0, 0}));
  EXPECT_EQ(tool_->refusal(), "");
}

TEST_F(ToolTest, ADragMovesByTheWayFromWhereItTookHold) {
  place("design(name=a) { placed(kind=bench_stone, name=b, position=\"1 1 0\") }");
  Pointer to = at({4.5, -1.2, 0.2});
  to.is_free = true;
  drag(at({1.4, 1.1, 0.45}), to);
  EXPECT_EQ(session_->done().size(), 1u) << "a drag is one step";
  expect_near("b", {1.0 + 3.1, 1.0 - 2.3}, 0.03);
  EXPECT_EQ(object("b").position.z, 0.0);
  EXPECT_TRUE(session_->undo());
  expect_near("b", {1, 1}, 1e-6);
}

TEST_F(ToolTest, WhatIsLeftAfterShiftIsDraggedFromWhereItStands) {
  place(
      "design(name=a) { placed(kind=bench_stone, name=b, position=\"1 1 0\")"
      " placed(kind=bench_stone, name=c, position=\"-4 1 0\") }");
  click(at({1, 1, 0.45}));
  Pointer other = at({-4, 1, 0.45});
  other.adds = true;
  click(other);
  other = at({1, 1, 0.45});
  other.adds = true;
  tool_->press(other);  // takes b out of the selection
  Pointer to = at({2, 1, 0.45});
  to.is_free = true;
  tool_->point(to);
  EXPECT_TRUE(tool_->release(to));
  expect_near("c", {-3, 1}, 0.03);
  expect_near("b", {1, 1}, 1e-9);
}

TEST_F(ToolTest, AGroupIsSelectedTogether) {
  place(
      "design(name=a) { placed(kind=table, name=b, position=\"1 1 0\", group=g)"
      " placed(kind=table, name=c, position=\"-4 1 0\", group=g) placed(kind=table, name=d, position=\"4 1 "
      "0\") "
      "}");
  click(at({1, 1, 0.5}));
  EXPECT_EQ(session_->selected(), (design::Names{"b", "c"}));
}

TEST_F(ToolTest, AClickWithoutWayMovesNothing) {
  place("design(name=a) { placed(kind=bench_stone, name=b, position=\"1 1 0\") }");
  click(at({1, 1, 0.45}));
  EXPECT_EQ(session_->selected(), design::Names{"b"});
  EXPECT_TRUE(session_->done().empty());
  click(at({-5, -5, 0}));
  EXPECT_TRUE(session_->selected().empty()) << "a click beside it selects nothing";
}

TEST_F(ToolTest, ATypedDistanceIsExact) {
  place("design(name=a) { placed(kind=bench_stone, name=b, position=\"1 1 0\") }");
  session_->select({"b"});
  tool_->point(at({1, 1, 0}));
  EXPECT_TRUE(tool_->begin(Action::move));
  Pointer right = at({3.3, 1.02, 0});
  right.adds = true;  // Shift keeps the right angle
  tool_->point(right);
  for (const char character : std::string("12,345")) EXPECT_TRUE(tool_->type(character));
  EXPECT_FALSE(tool_->type('x'));
  EXPECT_TRUE(tool_->confirm());
  EXPECT_DOUBLE_EQ(object("b").position.x, 13.345);
  EXPECT_DOUBLE_EQ(object("b").position.y, 1.0);
}

TEST_F(ToolTest, TurnsInStepsAndResizesAboutTheFoot) {
  place("design(name=a) { placed(kind=bench_stone, name=b, position=\"0 0 0\") }");
  session_->select({"b"});
  tool_->point(at({0, 3, 0}));
  EXPECT_TRUE(tool_->begin(Action::turn));
  tool_->point(at({2.9, 0.1, 0}));
  EXPECT_TRUE(tool_->press(at({2.9, 0.1, 0})));
  EXPECT_TRUE(tool_->release(at({2.9, 0.1, 0})));
  EXPECT_DOUBLE_EQ(object("b").heading_deg, 90.0);
  tool_->point(at({0, 2, 0}));
  EXPECT_TRUE(tool_->begin(Action::resize));
  tool_->point(at({0, 2.5, 0}));
  EXPECT_TRUE(tool_->confirm());
  EXPECT_NEAR(object("b").size_m.x, 2.5, 1e-6);
  EXPECT_TRUE(tool_->begin(Action::resize));
  tool_->point(at({0, 9, 0}));
  EXPECT_NE(tool_->refusal(), "") << "larger than the kind may be";
  EXPECT_FALSE(tool_->confirm());
}

TEST_F(ToolTest, EscapeUndoesWhatIsUnderWayAndNothingElse) {
  place("design(name=a) { placed(kind=bench_stone, name=b, position=\"1 1 0\") }");
  session_->select({"b"});
  tool_->point(at({1, 1, 0.45}));
  tool_->press(at({1, 1, 0.45}));
  tool_->point(at({4, 1, 0.45}));
  EXPECT_EQ(tool_->action(), Action::move);
  EXPECT_FALSE(tool_->preview().what_stays().empty());
  EXPECT_TRUE(tool_->cancel());
  EXPECT_TRUE(tool_->release(at({4, 1, 0.45})));
  expect_near("b", {1, 1}, 1e-9);
  EXPECT_EQ(session_->selected(), design::Names{"b"});
}

TEST_F(ToolTest, LeavesWhatIsDraggedOutOfThePictureBelow) {
  place(
      "design(name=a) { placed(kind=bench_stone, name=b, position=\"1 1 0\")"
      " placed(kind=bench_stone, name=c, position=\"-3 1 0\") }");
  session_->select({"b"});
  EXPECT_TRUE(tool_->begin(Action::move));
  tool_->point(at({4, 1, 0}));
  const std::vector<std::uint8_t> stays = tool_->preview().what_stays();
  for (std::size_t i = 0; i < scene_.objects.size(); ++i)
    EXPECT_EQ(stays[i] != 0, scene_.objects[i].name != "b") << scene_.objects[i].name;
}

TEST_F(ToolTest, ADragWhileInsertingMakesARow) {
  place("camera(name=eye)");
  tool_->choose_kind("bollard");
  drag(at({-6, 2, 0}), at({6, 2, 0}));
  const std::vector<design::PlacedObject> all = session_->objects();
  EXPECT_GE(all.size(), 8u);
  EXPECT_EQ(session_->done().size(), 1u);
  for (std::size_t i = 2; i < all.size(); ++i)
    EXPECT_NEAR(glm::distance(all[i].position, all[i - 1].position),
                glm::distance(all[1].position, all[0].position), 2e-4);
}

TEST_F(ToolTest, ABoxInThePlanSelectsWhatStandsInIt) {
  place(
      "design(name=a) { placed(kind=table, name=p, position=\"0 0 0\")"
      " placed(kind=table, name=q, position=\"2 0 0\") placed(kind=table, name=r, position=\"8 0 0\") }");
  drag(at({-2, 2, 0}), at({4, -2, 0}));
  EXPECT_EQ(session_->selected(), (design::Names{"p", "q"}));
}

TEST_F(ToolTest, DrawsASurfaceByItsCorners) {
  place("camera(name=eye)");
  tool_->choose(Mode::surface);
  for (const glm::dvec3 corner : {glm::dvec3(0, 0, 0), {4, 0, 0}, {4, 3, 0}, {0, 3, 0}, {0, 0, 0}})
    click(at(corner));
  ASSERT_EQ(session_->objects().size(), 1u);
  EXPECT_NEAR(design::signed_area_m2(session_->objects().front().outline), 12.0, 0.2);
  EXPECT_TRUE(tool_->corners().empty());
}

TEST_F(ToolTest, MeasuresFromPointToPoint) {
  place("camera(name=eye)");
  tool_->choose_measure();
  click(at({0, 0, 0}));
  tool_->point(at({3, 0, 0}));
  ASSERT_EQ(tool_->measurements().size(), 1u) << "while the second point is looked for";
  EXPECT_NEAR(tool_->measurements().back().value(), 3.0, 0.05);
  EXPECT_TRUE(session_->measurements().empty());
  click(at({3, 4, 0}));
  ASSERT_EQ(session_->measurements().size(), 1u);
  EXPECT_NEAR(session_->measurements().front().value(), 5.0, 0.05);
  EXPECT_TRUE(session_->objects().empty());
  tool_->choose_measure();
  EXPECT_EQ(tool_->quantity(), design::Quantity::area);
  for (const glm::dvec3 corner : {glm::dvec3(0, -4, 0), {4, -4, 0}, {4, -1, 0}}) click(at(corner));
  EXPECT_TRUE(tool_->confirm());
  ASSERT_EQ(session_->measurements().size(), 2u);
  EXPECT_NEAR(session_->measurements().back().value(), 6.0, 0.1);
}

TEST_F(ToolTest, EndsOfAMeasurementAreDraggedInEveryView) {
  for (const Camera& view : {plan_view(20.0f), street_view(), balcony_view()}) {
    camera_ = view;
    place("design(name=a) { measured(name=m, kind=distance, points=\"0 0 0, 2 0 0\") }");
    tool_->point(at({2, 0, 0}));
    EXPECT_EQ(tool_->pointed(), "m");
    const Pointer from = at({2, 0, 0}), to = at({4, 1, 0});
    tool_->press(from);
    tool_->point(to);
    EXPECT_EQ(tool_->action(), Action::point);
    EXPECT_NEAR(tool_->measurements().front().points[1].x, 4.0, 0.05) << "it follows the pointer";
    EXPECT_EQ(session_->measurements().front().points[1], glm::dvec3(2, 0, 0)) << "until it is let go";
    EXPECT_TRUE(tool_->release(to));
    EXPECT_LT(glm::distance(session_->measurements().front().points[1], glm::dvec3(4, 1, 0)), 0.05);
    EXPECT_EQ(session_->measurements().front().points[0], glm::dvec3(0, 0, 0));
    EXPECT_TRUE(session_->undo());
    EXPECT_EQ(session_->measurements().front().points[1], glm::dvec3(2, 0, 0));
    click(at({1, 0, 0}));
    EXPECT_EQ(session_->selected(), design::Names{"m"}) << "its line selects it";
    drag(at({1, 0, 0}), at({1, 1, 0}));
    EXPECT_NEAR(session_->measurements().front().points[0].y, 1.0, 0.05);
    EXPECT_NEAR(session_->measurements().front().value(), 2.0, 1e-3) << "all of it moves";
  }
}

TEST_F(ToolTest, FindsTheTreesOfADesign) {
  place("design(name=a) { placed(kind=tree_orange, name=t, position=\"0 0 0\") }");
  int things = int(scene_.objects.size());
  EXPECT_EQ(tool_->object_at(things)->text("name"), "t");
  EXPECT_EQ(tool_->object_at(things + 1), nullptr);
  EXPECT_EQ(tool_->object_at(0), nullptr) << "the pavement is no object of the design";
}

TEST_F(ToolTest, KeysMoveAlongTheNearestAxes) {
  place("design(name=a) { placed(kind=bench_stone, name=b, position=\"1 1 0\") }");
  session_->select({"b"});
  EXPECT_TRUE(tool_->nudge(plan_view(20.0f), 0.01, 0.0));
  EXPECT_NEAR(object("b").position.x, 1.01, 1e-6);
  EXPECT_TRUE(tool_->nudge(street_view(), 0.0, 1.0));
  EXPECT_NEAR(object("b").position.y, 2.0, 1e-6);
}

}  // namespace
}  // namespace parvis::planner
