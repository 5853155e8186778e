// Planning in a visit: what hangs on the pointer looks as it will stand, and a design is kept.
#include "viewer/planning.h"

#include <fstream>
#include <sstream>

#include "graphics/reference/metrics.h"
#include "graphics/render/picture_target.h"
#include "viewer/test_square.h"

namespace parvis::viewer {
namespace {

constexpr glm::ivec2 size(480, 270);

class PlanningTest : public SquareTest {
 protected:
  void SetUp() override {
    SquareTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    planning_.emplace(*visit_, design::Language::english);
    planning_->turn_on(true);
    ASSERT_TRUE(planning_->is_on()) << told();
    look_from("roof");
  }

  void look_from(const char* camera) {
    visit_->look_from(camera);
    wait();
  }

  planner::Pointer at(glm::vec3 place) const {
    planner::Pointer pointer;
    pointer.camera = visit_->camera(), pointer.size = size;
    const glm::vec4 clip = pointer.camera.clip_from_camera(float(size.x) / float(size.y)) *
                           pointer.camera.camera_from_world() * glm::vec4(place, 1.0f);
    pointer.pixel = (glm::dvec2(clip) / double(clip.w) * glm::dvec2(0.5, -0.5) + 0.5) * glm::dvec2(size);
    pointer.is_free = true;
    return pointer;
  }
  Image8 held() {
    for (int i = 0; i < 3; ++i) planning_->draw_held(size.x, size.y);
    return stage_->picture();
  }
  Image8 whole() {
    stage_->draw(visit_->camera(), size.x, size.y);
    return stage_->whole_picture();
  }
  double flip_over(const Image8& a, const Image8& b, const std::string& object) {
    const render::ObjectPicture picked = stage_->renderer().pick(visit_->camera(), size.x, size.y, false);
    Image8 mask(size.x, size.y, 1);
    for (std::size_t i = 0; i < mask.pixels.size(); ++i)
      if (picked.pixels[i] > 0 && picked.pixels[i] <= visit_->scene().objects.size())
        mask.pixels[i] = visit_->scene().objects[picked.pixels[i] - 1].name == object ? 255 : 0;
    const auto difference = reference::compare(a, b, mask);
    EXPECT_TRUE(difference) << object << " is not in the picture";
    return difference ? difference->flip : 1.0;
  }
  void place(const char* kind, glm::vec3 where) {
    planning_->tool()->choose_kind(kind);
    planning_->tool()->press(at(where));
    const Status status = planning_->tool()->release(at(where));
    ASSERT_TRUE(status) << to_string(status.errors());
  }

  std::optional<Planning> planning_;
};

TEST_F(PlanningTest, AScriptThatWasChangedElsewhereIsNotWrittenOver) {
  open(std::string(square_script) + "design(name=mine) { }\ndesign(name=yours) { }\n");
  planning_.emplace(*visit_, design::Language::english);
  planning_->turn_on(true);
  look_from("roof");
  place("kiosk", {1, -4, 0});
  planning_->save();
  const std::filesystem::path file = folder_.path() / "square.xp";
  EXPECT_NE(read_file(file)->find("kiosk"), std::string::npos) << told();
  planning_->open_design("yours");
  place("umbrella", {4, -7, 0});
  planning_->save();
  EXPECT_NE(read_file(file)->find("umbrella"), std::string::npos)
      << "what was saved here is known: " << told();
  planning_->open_design("mine");
  folder_.write("square.xp", *read_file(file) + "camera(name=elsewhere)\n");
  const std::string theirs = *read_file(file);
  place("bench_stone", {3, -6, 0});
  planning_->save();
  EXPECT_EQ(*read_file(file), theirs);
  EXPECT_NE(read_file(folder_.path() / "square-mine.xp")->find("bench_stone"), std::string::npos) << told();
}

TEST_F(PlanningTest, FromThePlanAndFromAWallOneComesDownToWalk) {
  const auto look = [this](PlanningView view) {
    planning_->look(view);
    for (int i = 0; i < 20; ++i) wait(0.1f);
  };
  visit_->set_mode(Mode::walk);
  look_from("street");
  const glm::vec3 street = visit_->camera().position_in_world();
  look(PlanningView::plan), look(PlanningView::street);
  EXPECT_EQ(visit_->navigation().mode(), Mode::walk);
  EXPECT_LT(glm::distance(visit_->camera().position_in_world(), street), 0.01f);
  look(PlanningView::balcony);
  ASSERT_TRUE(planning_->stand_at(at({6, 11, 5}))) << told();
  for (int i = 0; i < 20; ++i) wait(0.1f);
  look(PlanningView::street);
  EXPECT_LT(glm::distance(visit_->camera().position_in_world(), street), 0.01f);
}

TEST_F(PlanningTest, StepsOfADesignStayWhileAnotherOneIsOpen) {
  place("kiosk", {1, -4, 0});
  const std::string first = planning_->open_name();
  planning_->begin_design();
  place("bench_stone", {3, -6, 0});
  planning_->open_design(first);
  EXPECT_EQ(planning_->session()->done().size(), 1u) << told();
  place("bench_stone", {-3, -6, 0});
  planning_->save(), planning_->save();
  const auto scripts = std::ranges::count_if(
      std::filesystem::directory_iterator(folder_.path()),
      [](const std::filesystem::directory_entry& each) { return each.path().extension() == ".xp"; });
  EXPECT_EQ(scripts, 2) << "saved twice into one file: " << told();

  Result<stage::Simulation> again = stage::open_simulation(
      rooms::all_registries(), folder_.path() / fmt::format("square-{}.xp", first), {});
  ASSERT_TRUE(again) << to_string(again.errors());
  Result<design::Session> session = design::Session::open(again->scene, again->live(), first, {});
  ASSERT_TRUE(session) << to_string(session.errors());
  const auto kept = session->keep_journal(design::journal_file(again->scene.file, first));
  ASSERT_TRUE(kept) << to_string(kept.errors());
  EXPECT_EQ(session->done().size(), 2u) << "its steps can be undone where the saved script is opened";
}

TEST_F(PlanningTest, WhoWalksStopsAtWallsAndGoesAlongThem) {
  place("kiosk", {1, -4, 0});
  planning_->turn_on(false);
  Navigation& visitor = visit_->navigation();
  const auto walked = [&](glm::vec3 from, glm::vec2 step, int steps) {
    glm::vec3 here = from;
    for (int i = 0; i < steps; ++i) here = visitor.on_foot(here, here + glm::vec3(step, 0.0f)).value_or(here);
    return here;
  };
  const glm::vec3 before(-4.0f, -4.0f, 1.7f);
  const glm::vec3 stopped = walked(before, {0.1f, 0.0f}, 60);
  EXPECT_GT(stopped.x, -2.0f);
  EXPECT_LT(stopped.x, 0.5f) << "the kiosk is in the way";
  const glm::vec3 slid = walked(stopped, {0.05f, 0.05f}, 10);
  EXPECT_NEAR(slid.y, stopped.y + 0.5f, 0.1f) << "along it";
  EXPECT_NEAR(slid.x, stopped.x, 0.1f);
  EXPECT_GT(walked(slid, {0.0f, 0.2f}, 5).y, slid.y + 0.8f) << "with longer strides, too";
  EXPECT_LT(walked(slid, {-0.1f, 0.02f}, 10).x, slid.x - 0.8f) << "and away from it";
}

TEST_F(PlanningTest, WhatHangsOnThePointerLooksAsItWillStand) {
  planning_->tool()->choose_kind("kiosk");
  planning_->tool()->point(at({1, -4, 0}));
  ASSERT_TRUE(planning_->holds_things());
  const Image8 before = held();
  place("kiosk", {1, -4, 0});
  planning_->tool()->choose(planner::Mode::select);
  planning_->tool()->settle();
  ASSERT_FALSE(planning_->holds_things());
  const Image8 after = whole();
  // The part of the sky that it hides from itself is missing until it stands: .040; without its own shadow
  // .046.
  const double as_held = flip_over(before, after, "kiosk_1");
  EXPECT_LT(as_held, 0.043);
  planning_->tool()->choose_kind("kiosk");
  planning_->tool()->point(at({1.2f, -4, 0}));
  EXPECT_GT(flip_over(held(), after, "kiosk_1"), 1.5 * as_held) << "the control: 20 cm beside it";
}

TEST_F(PlanningTest, WhatStandsBeforeItHidesIt) {
  look_from("street");
  planning_->tool()->choose_kind("bollard");
  const Image8 without = whole();
  design::Preview preview(visit_->scene(), visit_->live());
  const design::Command insert = design::Insert{"bollard", {6, 14, 0}};
  const auto changes = design::changes_of(planning_->session()->view(), insert);
  ASSERT_TRUE(changes);
  ASSERT_TRUE(preview.show(*changes, nullptr));
  for (int i = 0; i < 3; ++i)
    stage_->draw_held(visit_->camera(), size.x, size.y, preview.what_stays(), preview.scene());
  const auto difference = reference::compare(stage_->picture(), without);
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->flip, 0.0);
}

TEST_F(PlanningTest, TheSceneStandsStillMeanwhileAndTheDesignIsKept) {
  place("bench_stone", {2, -5, 0});
  EXPECT_EQ(planning_->session()->objects().size(), 1u);
  EXPECT_TRUE(planning_->holds_things()) << "until it settles";
  planning_->step(1.0f, false);
  EXPECT_TRUE(planning_->run("select all"));
  planning_->save();
  std::ifstream file(folder_.path() / "square-design.xp");
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_NE(text.str().find("bench_stone_1"), std::string::npos) << told();
  planning_->undo();
  EXPECT_TRUE(planning_->session()->objects().empty());
  planning_->redo();
  EXPECT_EQ(planning_->session()->objects().size(), 1u);
}

TEST_F(PlanningTest, ViewsFlyToThePlanAndBack) {
  const glm::vec3 eye = visit_->camera().position_in_world();
  planning_->look(PlanningView::plan);
  for (int i = 0; i < 20; ++i) wait(0.1f);
  EXPECT_TRUE(visit_->camera().parallel);
  place("bin", {0, 0, 0});
  EXPECT_NEAR(planning_->session()->objects().front().position.x, 0.0, 0.1);
  planning_->look(PlanningView::street);
  for (int i = 0; i < 20; ++i) wait(0.1f);
  EXPECT_FALSE(visit_->camera().parallel);
  EXPECT_LT(glm::distance(visit_->camera().position_in_world(), eye), 0.01f);
}

TEST_F(PlanningTest, AClickOnAWallStandsThere) {
  look_from("street");
  planning_->look(PlanningView::balcony);
  EXPECT_FALSE(planning_->stand_at(at({-2, -5, 0}))) << "the ground is no wall";
  EXPECT_TRUE(planning_->waits_for_balcony());
  EXPECT_TRUE(planning_->stand_at(at({6, 11, 5})));
  for (int i = 0; i < 20; ++i) wait(0.1f);
  const glm::vec3 eye = visit_->camera().position_in_world();
  EXPECT_LT(glm::distance(eye, glm::vec3(6, 10.65f, 5)), 0.2f);
  EXPECT_LT(visit_->camera().forward_in_world().y, -0.8f) << "away from the wall";
}

TEST_F(PlanningTest, TwoDesignsShareTheWindow) {
  planning_.reset();
  open(
      "sun(azimuth_deg=215, elevation_deg=42) exposure(value=1.1) reflection(method=none)\n"
      "model(name=pavement, file=\"ground.glb\")\n"
      "camera(name=roof, position=\"12 -16 14\", heading_deg=325, pitch_deg=-28)\n"
      "design(name=old) { placed(name=k, kind=kiosk, position=\"-2 -4 0\") }\n"
      "design(name=new, visible=0) { placed(name=u, kind=umbrella, position=\"2 -4 0\") }\n");
  planning_.emplace(*visit_, design::Language::english);
  planning_->turn_on(true);
  look_from("roof");
  const auto turn_to = [&](const char* design) {
    planning_->open_design(design);
    wait();
  };
  turn_to("new");
  const Image8 after = whole();
  turn_to("old");
  const Image8 before = whole();
  turn_to("new");
  EXPECT_FALSE(planning_->compares_pictures());
  planning_->next_compared_view();
  ASSERT_TRUE(planning_->compares_pictures()) << told();
  EXPECT_EQ(planning_->compared(), "old");

  const gl::Texture texture = gl::texture_2d(GL_RGBA8, size.x, size.y);
  const gl::Framebuffer framebuffer = gl::Framebuffer::create();
  glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, texture.name(), 0);
  const auto shown = [&] {
    for (int i = 0; i < 3; ++i) planning_->draw_compared(size.x, size.y, framebuffer.name());
    Image8 image(size.x, size.y, 4);
    glGetTextureImage(texture.name(), 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(image.pixels.size()),
                      image.pixels.data());
    render::flip_rows(image);
    return image;
  };
  const auto same_columns = [&](const Image8& a, const Image8& b, int from, int to) {
    int different = 0;
    for (int y = 0; y < size.y; ++y)
      for (int x = from; x < to; ++x)
        for (int channel = 0; channel < 3; ++channel)
          different += std::abs(int(a.at(x, y)[channel]) - int(b.at(x, y)[channel])) > 1;
    return different == 0;
  };
  for (const float split : {0.25f, 0.6f}) {
    planning_->set_split(split);
    const int at = int(std::lround(split * float(size.x)));
    const Image8 both = shown();
    EXPECT_TRUE(same_columns(both, before, 0, at)) << "the other design left of " << at;
    EXPECT_TRUE(same_columns(both, after, at, size.x)) << "the open one right of " << at;
  }
  EXPECT_FALSE(same_columns(before, after, 0, size.x)) << "the control";
  EXPECT_TRUE(sees("u"));
  EXPECT_FALSE(sees("k")) << "the open design stays the one that is shown";
  planning_->next_compared_view();
  EXPECT_EQ(planning_->compared_view(), ComparedView::side_by_side);
  const Image8 beside = shown();
  const auto half = [&](const char* design) {
    turn_to(design);
    stage_->draw(visit_->camera(), size.x / 2, size.y);
    return stage_->whole_picture();
  };
  const Image8 left = half("old"), right = half("new");
  int different = 0;
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      const Image8& one = x < size.x / 2 ? left : right;
      different += std::abs(int(beside.at(x, y)[1]) - int(one.at(x % (size.x / 2), y)[1])) > 1;
    }
  EXPECT_EQ(different, 0);
  planning_->next_compared_view();
  EXPECT_FALSE(planning_->compares_pictures()) << "in colours again";
}

}  // namespace
}  // namespace parvis::viewer
