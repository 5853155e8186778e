// The panel driven by a synthetic mouse and keys, which go through Dear ImGui's own input; pictures of it are
// goldens.
#include "viewer/panel.h"

#include <algorithm>

#include "base/test_data.h"
#include "graphics/render/test_golden.h"
#include "reflections/methods/registry.h"
#include "reflections/methods/settings.h"
#include "viewer/keys.h"
#include "viewer/test_square.h"

namespace parvis::viewer {
namespace {

constexpr int width = 960, height = 640;
constexpr float frame_s = 1.0f / 60.0f;
/// Where the test's keyboard has the keys that ImGui asks for by number.
constexpr int enter_key = 1, backspace_key = 2, a_key = 3;

/// A picture to draw into, in a window's place.
struct Screen {
  Screen() : colour(gl::texture_2d(GL_RGBA8, width, height)), framebuffer(gl::Framebuffer::create()) {
    glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, colour.name(), 0);
  }
  Image8 read() const {
    Image8 picture(width, height, 4);
    glGetTextureImage(colour.name(), 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(picture.pixels.size()),
                      picture.pixels.data());
    render::flip_rows(picture);
    return picture;
  }
  gl::Texture colour;
  gl::Framebuffer framebuffer;
};

class PanelTest : public SquareTest {
 protected:
  void SetUp() override {
    SquareTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    put_up(1.0f);
  }

  void put_up(float scale, design::Language language = design::Language::english) {
    panel_.reset();
    imgui_.reset();
    imgui_ = std::make_unique<ImguiContext>(scale);
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {float(width), float(height)};
    io.DeltaTime = frame_s;
    io.KeyMap[ImGuiKey_Enter] = enter_key;
    io.KeyMap[ImGuiKey_Backspace] = backspace_key;
    io.KeyMap[ImGuiKey_A] = a_key;
    panel_ = std::make_unique<Panel>(*imgui_, "square", language);
    panel_->is_open = true;
    for (int i = 0; i < 3; ++i) frame();  // ImGui finds its sizes
  }
  void TearDown() override {
    panel_.reset();
    imgui_.reset();
  }

  /// A frame of panel and scene, without its picture.
  void frame() {
    imgui_->begin_frame();
    panel_->draw(*visit_, statistics_);
    ImGui::Render();
    visit_->step({}, frame_s);
  }
  /// The text of a frame of the panel.
  std::string text() {
    imgui_->begin_frame();
    ImGui::LogToClipboard();
    panel_->draw(*visit_, statistics_);
    ImGui::LogFinish();
    ImGui::Render();
    return ImGui::GetClipboardText();
  }
  Image8 picture() {
    for (int i = 0; i < 2; ++i) frame();
    const Screen screen;
    stage_->draw(visit_->camera(), width - int(panel_->width()), height);
    stage_->display(screen.framebuffer.name());
    imgui_->begin_frame();
    panel_->draw(*visit_, statistics_);
    glBindFramebuffer(GL_FRAMEBUFFER, screen.framebuffer.name());
    glViewport(0, 0, width, height);
    imgui_->draw();
    return screen.read();
  }
  void expect_golden(const std::string& name) {
    // The picture and the letters are the software renderer's, bit by bit but for the width of its vectors;
    // on a GPU edges lie elsewhere: there only the whole counts.
    const render::GoldenTolerance tolerance = gl::is_software() ? render::GoldenTolerance{32, 2, 0.002, 0.05}
                                                                : render::GoldenTolerance{255, 16, 0.03, 1.5};
    const Status status = render::matches_golden(picture(), name, tolerance, source_folder());
    EXPECT_TRUE(status) << to_string(status.errors());
  }

  Place place(const std::string& name) {
    const auto found = panel_->places().find(name);
    if (found != panel_->places().end()) return found->second;
    ADD_FAILURE() << "nothing in the panel is called \"" << name << '"';
    return {};
  }
  void point_at(ImVec2 position) {
    ImGui::GetIO().MousePos = position;
    frame();
  }
  /// `along`: from its left end to its right.
  void point_at(const std::string& name, float along = 0.5f) {
    const Place at = place(name);
    point_at(ImVec2(at.low.x + along * (at.high.x - at.low.x), 0.5f * (at.low.y + at.high.y)));
  }
  void set_button(bool is_down) {
    ImGui::GetIO().MouseDown[0] = is_down;
    frame();
  }
  void click(const std::string& name, float along = 0.5f) {
    point_at(name, along);
    set_button(true);
    set_button(false);
    frame();
  }
  void drag(const std::string& name, float pixels) {
    point_at(name);
    set_button(true);
    for (int i = 0; i < 10; ++i) {
      ImVec2 position = ImGui::GetIO().MousePos;
      position.x += pixels / 10.0f;
      point_at(position);
    }
    set_button(false);
    frame();
  }
  void press(int key) {
    for (const bool is_down : {true, false}) {
      ImGui::GetIO().KeysDown[key] = is_down;
      frame();
    }
  }
  /// Double-clicks a number and writes another in its place.
  void write(const std::string& name, const std::string& text, float along = 0.5f) {
    for (int i = 0; i < 30; ++i) frame();  // so that earlier clicks do not count
    click(name, along);
    click(name, along);
    for (const char c : text) {
      ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(c));
      frame();
    }
    press(enter_key);
    frame();
  }
  void choose(const std::string& row, const std::string& choice) {
    click(row);
    click(row + "/" + choice);
  }

  std::unique_ptr<ImguiContext> imgui_;
  std::unique_ptr<Panel> panel_;
  FrameStatistics statistics_;
};

TEST_F(PanelTest, ThePageOfTheVisitIsGolden) {
  visit_->halt(true);
  expect_golden("panel-visit");
}

TEST_F(PanelTest, SpeaksFrenchAndKeepsItsPlaces) {
  put_up(1.0f, design::Language::french);
  panel_->shows_keys = true;
  const std::string french = text();
  for (const char* word : {"Se déplacer", "À pied", "Lumière", "Scénarios", "Touches"})
    EXPECT_NE(french.find(word), std::string::npos) << word;
  for (const char* word : {"Moving", "Light", "Camera", "Keys"})
    EXPECT_EQ(french.find(word), std::string::npos) << word;
  for (const KeyHelp& help : key_help)
    EXPECT_NE(design::in_language(help.does, design::Language::french), help.does);
  panel_->shows_keys = false;
  click("Fly");
  EXPECT_EQ(visit_->mode(), Mode::fly);
}

TEST_F(PanelTest, AScenarioIsSwitchedByAClick) {
  click("scenario green");
  EXPECT_EQ(visit_->live().scenario(), "green");
  EXPECT_TRUE(sees("plane"));
  visit_->halt(true);
  expect_golden("panel-scenario");
  click("scenario base");
  EXPECT_EQ(visit_->live().scenario(), "");
  EXPECT_FALSE(sees("plane"));
}

TEST_F(PanelTest, TheVisitorIsMovedByButtonsAndLists) {
  click("Fly");
  EXPECT_EQ(visit_->mode(), Mode::fly);
  click("Follow");
  EXPECT_EQ(visit_->mode(), Mode::follow);
  choose("Vehicle", "vehicle 2");
  EXPECT_EQ(visit_->scene().objects[std::size_t(visit_->followed())].name, "vehicle 2");
  choose("Camera", "roof");
  EXPECT_NEAR(visit_->camera().position_in_world().z, 14.0f, 1e-3f);
  click("Walk");
  EXPECT_EQ(visit_->mode(), Mode::walk);
  choose("Tour", "arrival");
  EXPECT_TRUE(node("arrival").flag("running"));
}

TEST_F(PanelTest, LightIsDraggedAndWritten) {
  const auto sun = [this] { return azimuth_and_elevation_deg(visit_->scene().sun.direction_to_sun); };
  drag("Sun from", 40.0f);
  EXPECT_NEAR(sun().x, 235.0f, 2.0f) << "40 pixels of half a degree";
  EXPECT_NEAR(sun().y, 42.0f, 1e-3f) << "its height stays";
  write("Sun's height", "10");
  EXPECT_NEAR(sun().y, 10.0f, 1e-3f);
  write("Exposure", "2");
  EXPECT_NEAR(visit_->scene().exposure, 2.0f, 1e-5f);
  choose("Reflections", "shared cube map");
  EXPECT_EQ(methods::settings(visit_->scene()).method, "shared_cube_map");
}

/// A scene that leaves the choice of the method says so, and can be given it back.
TEST_F(PanelTest, TheMethodOfReflectionIsLeftToTheSceneAgain) {
  const auto method = [this] { return methods::settings(visit_->scene()).method; };
  const auto shows_automatic = [this] { return text().find(methods::automatic) != std::string::npos; };
  EXPECT_FALSE(shows_automatic()) << "the script names another";
  choose("Reflections", "automatic");
  EXPECT_EQ(method(), methods::automatic);
  EXPECT_TRUE(shows_automatic());
  choose("Reflections", "shared cube map");
  EXPECT_EQ(method(), "shared_cube_map");
  EXPECT_FALSE(shows_automatic());
  choose("Reflections", "automatic");
  EXPECT_EQ(method(), methods::automatic);
  EXPECT_TRUE(visit_->notices().empty()) << told();

  open("camera(name=street, position=\"-7 -11 1.7\", target=\"0 4 2.2\")\n");
  put_up(1.0f);
  EXPECT_TRUE(shows_automatic()) << "without a node reflection, too";
}

TEST_F(PanelTest, TheHourOfDayLightIsDraggedAndWritten) {
  open(R"(
dayLight(latitude=43.7, longitude=7.27, standardMeridian=2, julianDay=172, timeOfDay=10)
model(name=pavement, file="ground.glb")
camera(name=street, position="-7 -11 1.7", target="0 4 2.2")
)");
  put_up(1.0f);
  EXPECT_EQ(panel_->places().count("Sun from"), 0u) << "the sun follows from place and hour";
  const auto elevation = [this] { return azimuth_and_elevation_deg(visit_->scene().sun.direction_to_sun).y; };
  const float at_ten = elevation(), exposure = visit_->scene().exposure;
  write("Hour", "13.6");
  EXPECT_GT(elevation(), at_ten + 10.0f);
  EXPECT_LT(visit_->scene().exposure, exposure) << "day light sets it for the brighter hour";
  const float in_summer = elevation();
  write("Day", "355");
  EXPECT_NEAR(elevation(), in_summer - 46.9f, 1.0f) << "twice the tilt of the earth's axis";
  write("Hour", "99");
  EXPECT_LT(node("%dayLight").number("timeOfDay"), 24.0);

  write("Hour", "12");
  const float chosen_by_day_light = visit_->scene().exposure;
  write("Exposure", "2");
  EXPECT_NEAR(visit_->scene().exposure, 2.0f * chosen_by_day_light, 1e-4f * chosen_by_day_light);
  EXPECT_NEAR(visit_->exposure(), 2.0, 1e-9) << "the row shows what was chosen";
}

TEST_F(PanelTest, TrafficIsHaltedAndMovedOn) {
  click("Halt");
  EXPECT_TRUE(visit_->is_halted());
  const auto vehicle = [this] {
    return visit_->scene().objects[std::size_t(visit_->vehicles()[0])].world_from_model;
  };
  const glm::mat4 halted = vehicle();
  click("Step 0.1 s");
  EXPECT_NE(vehicle(), halted);
  click("Go on");
  EXPECT_FALSE(visit_->is_halted());
}

TEST_F(PanelTest, NodesAreFoundHiddenAndChanged) {
  click("Scene");
  click("node trees/visible");
  EXPECT_FALSE(sees("oak"));
  click("node trees/visible");
  EXPECT_TRUE(sees("oak"));

  click("node trees", 0.03f);  // its arrow
  click("node plane/visible");
  EXPECT_TRUE(sees("plane"));
  click("node oak");
  drag("heading", 80.0f);
  EXPECT_NEAR(glm::degrees(node("oak").angle("heading_deg")), 20.0f, 1.0f);
  write("position", "-5", 0.1f);
  EXPECT_EQ(node("oak").vec3("position"), glm::vec3(-5, 0, 0));
  click("visible");
  EXPECT_FALSE(sees("oak"));
  click("visible");

  visit_->halt(true);
  point_at(ImVec2(300, 300));
  expect_golden("panel-scene");
}

TEST_F(PanelTest, WhatIsOutOfRangeIsAnsweredAndChangesNothing) {
  click("Scene");
  click("node sun");
  const glm::vec3 before = visit_->scene().sun.direction_to_sun;
  write("elevation", "200");
  EXPECT_EQ(visit_->scene().sun.direction_to_sun, before);
  EXPECT_NEAR(glm::degrees(node("%sun").angle("elevation_deg")), 42.0, 1e-3);
  visit_->halt(true);
  point_at(ImVec2(300, 300));
  expect_golden("panel-refusal");
  write("elevation", "20");
  EXPECT_NEAR(glm::degrees(node("%sun").angle("elevation_deg")), 20.0, 1e-3);
}

TEST_F(PanelTest, TheTreeIsSearched) {
  click("Scene");
  click("find");
  for (const char c : std::string("oak")) {
    ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(c));
    frame();
  }
  EXPECT_TRUE(panel_->places().count("node oak"));
  EXPECT_TRUE(panel_->places().count("node trees")) << "around it";
  EXPECT_FALSE(panel_->places().count("node houses"));
  EXPECT_TRUE(ImGui::GetIO().WantTextInput) << "letters do not walk";
}

TEST_F(PanelTest, StatisticsAreGolden) {
  for (int i = 0; i < 90; ++i)
    statistics_.add(
        0.001 * (16.0 + 5.0 * ((i * 7) % 10 == 0) + 0.1 * (i % 13)),
        std::vector<gl::PassTime>{
            {"shadows", 0.0021}, {"reflections", 0.0052}, {"picture", 0.0064}, {"display", 0.0003}});
  visit_->halt(true);
  click("Statistics");
  point_at(ImVec2(300, 300));
  if (!gl::is_software()) GTEST_SKIP() << "skipped: the driver's name stands in the picture";
  expect_golden("panel-statistics");
}

TEST_F(PanelTest, TheKeysAreShownOnDemand) {
  visit_->halt(true);
  click("Keys  F1");
  EXPECT_TRUE(panel_->shows_keys);
  point_at(ImVec2(5, 5));
  expect_golden("panel-keys");
  click("Keys  F1");
  EXPECT_FALSE(panel_->shows_keys);
}

TEST_F(PanelTest, WhatIsClickedInThePictureIsChosenInTheTree) {
  visit_->halt(true);
  stage_->draw(visit_->camera(), 320, 240);
  const render::ObjectPicture objects = stage_->renderer().pick(visit_->camera(), 320, 240, false);
  const auto node_of = [&](const std::string& object) -> const scene::Node* {
    for (int y = 0; y < objects.height; ++y)
      for (int x = 0; x < objects.width; ++x)
        if (const std::uint32_t seen = *objects.at(x, y);
            seen != 0 && visit_->scene().objects[seen - 1].name == object)
          return visit_->node_at({x, y});
    ADD_FAILURE() << object << " is not in the picture";
    return nullptr;
  };
  EXPECT_EQ(node_of("corner"), &node("corner"));
  EXPECT_EQ(node_of("oak"), &node("oak"));
  const auto& all = visit_->scene().objects;
  const auto vehicle =
      std::find_if(all.begin(), all.end(), [](const auto& each) { return each.name == "vehicle 1"; });
  EXPECT_EQ(visit_->live().maker_of(visit_->scene(), int(vehicle - all.begin())), &node("%traffic"));
  EXPECT_EQ(visit_->node_at({160, 0}), nullptr) << "the sky";
  EXPECT_EQ(visit_->node_at({-1, 999}), nullptr);

  panel_->choose(visit_->live(), node("oak"));
  for (int i = 0; i < 3; ++i) frame();
  EXPECT_EQ(panel_->chosen(), &node("oak"));
  EXPECT_TRUE(panel_->places().contains("node oak")) << "its group is open";
  write("position", "-2", 0.1f);
  EXPECT_EQ(node("oak").vec3("position"), glm::vec3(-2, 0, 0)) << told();
}

TEST_F(PanelTest, PicturesAreTakenByAButton) {
  stage_->draw(visit_->camera(), 64, 48);
  click("Picture  P");
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "pictures/square-0001.png")) << told();
}

TEST_F(PanelTest, ThePictureHasTheWholeWindowWhenItIsClosed) {
  EXPECT_GT(panel_->width(), 200.0f);
  click("Close  F2");
  EXPECT_FALSE(panel_->is_open);
  EXPECT_EQ(panel_->width(), 0.0f);
  point_at(ImVec2(float(width) - 20.0f, 100.0f));
  EXPECT_FALSE(ImGui::GetIO().WantCaptureMouse) << "the mouse is the visitor's again";
}

TEST_F(PanelTest, ItGrowsWithTheScaleOfTheScreenAndLeavesHalfOfANarrowWindow) {
  const float at_1 = panel_->width();
  const float line_at_1 = ImGui::GetTextLineHeight();
  imgui_->rescale(1.25f, 1.0f);
  frame();
  EXPECT_NEAR(panel_->width(), 1.25f * at_1, 1.0f);
  EXPECT_NEAR(ImGui::GetTextLineHeight(), 1.25f * line_at_1, 1.0f);
  put_up(2.0f);
  EXPECT_EQ(panel_->width(), 0.5f * float(width));
  click("Fly");
  EXPECT_EQ(visit_->mode(), Mode::fly);
}

}  // namespace
}  // namespace parvis::viewer
