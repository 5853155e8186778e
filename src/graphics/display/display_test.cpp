#include <gtest/gtest.h>

#include "base/random.h"
#include "graphics/display/display_file.h"
#include "graphics/display/screens.h"
#include "graphics/gl/test_context.h"

namespace parvis::display {
namespace {

/// A display of one wall and what else the text says.
std::string display_text(const std::string& walls, const std::string& more = "") {
  return "{\"parvis_display\": 1, " + more + " \"walls\": [" + walls + "]}";
}
const std::string front =
    R"({"name": "front", "lower_left": [-1, 2, 0], "lower_right": [1, 2, 0], "upper_right": [1, 2, 2], "pixels": [64, 48]})";

Display read(const std::string& text, const std::string& file = "room.json") {
  Result<Display> display = read_display_text(text, file);
  EXPECT_TRUE(display) << to_string(display.errors());
  return display ? *display : Display{};
}

std::string refused(const std::string& text, const std::string& file = "room.json") {
  const Result<Display> display = read_display_text(text, file);
  return display ? "" : to_string(display.errors());
}

TEST(DisplayTest, PointsAppearWhereTheirRaysHitTheWall) {
  Random random(50);
  const auto somewhere = [&](double reach) {
    const auto one = [&] { return double(random.uniform(-1.0f, 1.0f)) * reach; };
    return glm::dvec3(one(), one(), one());
  };
  Camera view;
  view.world_from_camera = look_at({40.0f, -25.0f, 12.0f}, {10.0f, 3.0f, 2.0f});
  int seen = 0;
  for (int i = 0; i < 300; ++i) {
    Display display;
    display.scale = i % 2 ? 1.0 : 50.0, display.is_upright = i % 3 != 0;
    Wall wall;
    const glm::dvec3 right = somewhere(2.0), up = glm::cross(right, somewhere(1.0));
    wall.lower_left = somewhere(3.0), wall.lower_right = wall.lower_left + right,
    wall.upper_left = wall.lower_left + up;
    const glm::dvec3 normal = glm::normalize(glm::cross(right, up));
    const glm::dvec3 eye = wall.lower_left + somewhere(2.0) + 2.5 * normal;
    if (!is_before(wall, eye) || glm::length(up) < 0.3) continue;
    const glm::dmat4 from_room = world_from_room(display, view);
    const Camera camera = wall_camera(wall, eye, from_room, view);
    const glm::dmat4 clip_from_world =
        glm::dmat4(camera.clip_from_camera(1.0f)) * glm::inverse(glm::dmat4(camera.world_from_camera));
    const glm::dvec3 point = eye - (1.0 + 5.0 * double(random.uniform(0.0f, 1.0f))) * normal + somewhere(1.0);
    const double along = glm::dot(wall.lower_left - eye, normal) / glm::dot(point - eye, normal);
    if (!(along > 0.0)) continue;
    const glm::dvec3 hit = eye + along * (point - eye) - wall.lower_left;
    const glm::dvec2 share(glm::dot(hit, right) / glm::dot(right, right),
                           glm::dot(hit, up) / glm::dot(up, up));
    const glm::dvec4 clip = clip_from_world * from_room * glm::dvec4(point, 1.0);
    // In floats a camera 50 m from the origin is exact to some micrometres.
    EXPECT_NEAR(0.5 + 0.5 * clip.x / clip.w, share.x, 1e-4 * (1.0 + std::abs(share.x))) << i;
    EXPECT_NEAR(0.5 + 0.5 * clip.y / clip.w, share.y, 1e-4 * (1.0 + std::abs(share.y))) << i;
    ++seen;
  }
  EXPECT_GT(seen, 100);
}

TEST(DisplayTest, TheRoomStandsWhereTheViewIs) {
  Camera view;
  view.world_from_camera = look_at({5.0f, 6.0f, 7.0f}, {5.0f, 16.0f, 2.0f});  // north, and down
  Display display;
  display.eye = {0.0, 0.0, 1.7};
  const auto at = [&](glm::dvec3 place) {
    return glm::dvec3(world_from_room(display, view) * glm::dvec4(place, 1.0));
  };
  EXPECT_LT(glm::distance(at({0, 0, 1.7}), glm::dvec3(5, 6, 7)), 1e-5);
  EXPECT_LT(glm::distance(at({0, 1, 1.7}), glm::dvec3(5, 7, 7)), 1e-5);  // level all the same
  display.is_upright = false, display.scale = 10.0;
  EXPECT_LT(glm::distance(at({0, 1, 1.7}), glm::dvec3(5, 6, 7) + 10.0 * glm::dvec3(view.forward_in_world())),
            1e-4);
}

TEST(DisplayTest, BothFormsOfParaViewsCornersAreOneWall) {
  const std::string
      head =
          "<pvx><Process Type=\"server\"><EyeSeparation Value=\"0.06\"/><Machine Geometry=\"800x600+5+6\" "
          "Environment=\"DISPLAY=:0.1\" LowerLeft=\"-1 -1 -2\" LowerRight=\"1 -1 -2\" ",
      tail = "/></Process></pvx>";
  const Display right = read(head + "UpperRight=\"1 1 -2\"" + tail, "a.pvx"),
                left = read(head + "UpperLeft=\"-1 1 -2\"" + tail, "a.pvx");
  ASSERT_EQ(right.walls.size(), 1u);
  ASSERT_EQ(left.walls.size(), 1u);
  EXPECT_EQ(right.walls[0].upper_left, left.walls[0].upper_left);
  EXPECT_EQ(right.walls[0].upper_left, glm::dvec3(-1, 2, 1));  // y up there, z up here
  EXPECT_EQ(right.walls[0].pixels, glm::ivec2(800, 600));
  EXPECT_EQ(right.walls[0].window.at, glm::ivec2(5, 6));
  EXPECT_EQ(right.walls[0].window.x_display, ":0.1");
  EXPECT_EQ(right.eye_separation_m, 0.06);
}

TEST(DisplayTest, NeighboursInOnePlaneOverlap) {
  const std::string
      one =
          R"({"name": "a", "lower_left": [-2, 2, 0], "lower_right": [0.5, 2, 0], "upper_left": [-2, 2, 2]})",
      two =
          R"({"name": "b", "lower_left": [-0.5, 2, 0], "lower_right": [2, 2, 0], "upper_left": [-0.5, 2, 2]})";
  const Display display = read(display_text(one + "," + two));
  EXPECT_NEAR(display.walls[0].overlap[1], 0.4, 1e-9);
  EXPECT_NEAR(display.walls[1].overlap[0], 0.4, 1e-9);
  EXPECT_EQ(display.walls[0].overlap[0] + display.walls[0].overlap[2] + display.walls[0].overlap[3], 0.0);
}

TEST(DisplayTest, WrongFilesAreRefusedInWords) {
  struct Case {
    std::string text, expected, file = "room.json";
  };
  std::string many = front;
  for (int i = 1; i < 300; ++i) many += "," + front;
  const std::string pvx = "<pvx><Machine LowerLeft=\"-1 -1 -2\" ";
  for (
      const Case& wrong : std::vector<Case>{
          {display_text(
               R"({"name": "a", "lower_left": [0, 1, 0], "lower_right": [1, 1, 0], "upper_right": [2, 1, 0]})"),
           "in a line"},
          {display_text(
               R"({"name": "a", "lower_left": [0, 1, 0], "lower_right": [1, 1, 0], "upper_right": [2, 1, 1]})"),
           "no right angle"},
          {display_text(
               R"({"name": "a", "lower_left": [1, 1, 0], "lower_right": [-1, 1, 0], "upper_right": [-1, 1, 2]})"),
           "its back"},
          {display_text(
               R"({"name": "a", "lower_left": [0, 1], "lower_right": [1, 1, 0], "upper_right": [1, 1, 1]})"),
           "lower_left: expected 3 numbers"},
          {display_text(front, "\"stereo\": \"shutter\","), "\"shutter\" is none of none, quad_buffer"},
          {display_text(front, "\"eyes\": [0, 0, 1],"),
           "\"eyes\" is no name of a value here; did you mean \"eye\"?"},
          {display_text(front, "\"eye\": [0, 0, 1e999],"), "room.json"},
          {display_text(front, "\"head\": \"a\", \"wand\": \"a\","), "is the head's, too"},
          {display_text(front + "," + front), "stands there twice"},
          {display_text(many), "300 walls; a display has 64 at most"},
          {display_text(""), "there is no wall"},
          {R"({"parvis_display": 2, "walls": []})",
           "\"parvis_display\" is of version 2; this program reads version 1"},
          {R"({"walls": []})", "expected an object with \"parvis_display\": 1"},
          {display_text(front).substr(0, 60), "room.json"},
          {display_text(R"({"name": "a", "cylinder": {"from_deg": -120, "to_deg": 120}})"),
           "too wide an angle"},
          {display_text(
               R"({"name": "a", "mesh": {"columns": 3, "points": [[0,1,0],[1,1,0],[0,1,1],[1,1,1]]}})"),
           "4 points are no rows of 3"},
          {pvx + "LowerRight=\"1 -1 -2\"/></pvx>", "a.pvx:1:6: a machine without corners", "a.pvx"},
          {pvx + "LowerRight=\"0/05 -1 -2\" UpperRight=\"1 1 -2\"/></pvx>",
           "LowerRight=\"0/05 -1 -2\": expected 3 numbers", "a.pvx"},
          {pvx + "LowerRight=\"1 -1 -2\" UpperRight=\"nan 1 -2\"/></pvx>", "expected 3 numbers", "a.pvx"},
          {"<pvx><Machine", "a.pvx:1:", "a.pvx"},
          {"<room/>", "expected ParaView's element <pvx>", "a.pvx"}})
    EXPECT_NE(refused(wrong.text, wrong.file).find(wrong.expected), std::string::npos)
        << wrong.text.substr(0, 200) << "\n"
        << refused(wrong.text, wrong.file);
}

TEST(DisplayTest, AnEyeThatGoesThroughAWallStaysBeforeIt) {
  const Display display = read(display_text(front));
  Camera view;
  const Camera camera = wall_camera(display.walls[0], {0.0, 5.0, 1.0}, glm::dmat4(1.0), view);
  EXPECT_NEAR(camera.position_in_world().y, 1.99f, 1e-5f);
}

class ScreensTest : public gl::ContextTest {
 protected:
  /// Pictures that the display's only projector shows of two pictures of one colour each, or of those given.
  std::vector<Image8> shown(const Display& display,
                            const std::function<Image8(const WallPicture&)>& picture_of) {
    const std::vector<WallPicture> pictures = pictures_of(display, {display.eye}, Camera());
    Result<Screens> screens = Screens::create(display, pictures);
    EXPECT_TRUE(screens) << to_string(screens.errors());
    for (std::size_t i = 0; i < pictures.size(); ++i) screens->put(i, picture_of(pictures[i]));
    screens->compose(display, pictures);
    std::vector<Image8> result;
    for (std::size_t i = 0; i < display.walls.size(); ++i) {
      result.push_back(screens->read(i));
      if (display.stereo == Stereo::quad_buffer) result.push_back(screens->read(i, Eye::right));
    }
    return result;
  }
};

Image8 filled(glm::ivec2 size, std::uint8_t value) { return Image8(size.x, size.y, 3, value); }

TEST_F(ScreensTest, StereoShowsEachEyeWhereItBelongs) {
  Display display = read(display_text(front));
  const auto black_left = [](const WallPicture& picture) {
    return filled(picture.size, picture.eye == Eye::right ? 255 : 0);
  };
  const std::map<Stereo, std::function<bool(int, int)>> is_right{
      {Stereo::none, [](int, int) { return false; }},
      {Stereo::side_by_side, [](int x, int) { return x >= 32; }},
      {Stereo::top_bottom, [](int, int y) { return y >= 24; }},
      {Stereo::interlaced, [](int, int y) { return y % 2 == 1; }},
      {Stereo::checkerboard, [](int x, int y) { return (x + y) % 2 == 1; }}};
  for (const auto& [stereo, expected] : is_right) {
    display.stereo = stereo;
    const Image8 picture = shown(display, black_left).front();
    int wrong = 0;
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) wrong += *picture.at(x, y) != (expected(x, y) ? 255 : 0);
    EXPECT_EQ(wrong, 0) << stereo_names[std::size_t(stereo)];
  }
  display.stereo = Stereo::quad_buffer;
  const std::vector<Image8> buffers = shown(display, black_left);
  EXPECT_EQ(*buffers[0].at(9, 9), 0);
  EXPECT_EQ(*buffers[1].at(9, 9), 255);
  display.stereo = Stereo::anaglyph;
  const Image8 anaglyph = shown(display, black_left).front();  // the right eye's white: cyan
  EXPECT_LT(anaglyph.at(9, 9)[0], 10);
  EXPECT_GT(anaglyph.at(9, 9)[1], 240);
  EXPECT_GT(anaglyph.at(9, 9)[2], 240);
}

TEST_F(ScreensTest, FlatPicturesPassAsTheyAre) {
  const Display display = read(display_text(front));
  Random random(3);
  Image8 noise(64, 48, 3);
  for (std::uint8_t& value : noise.pixels) value = std::uint8_t(random.index(256));
  const Image8 picture = shown(display, [&](const WallPicture&) { return noise; }).front();
  int most = 0;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x)
      for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(picture.at(x, y)[c] - noise.at(x, y)[c]));
  EXPECT_LE(most, 1);  // bilinear lookups at pixel centres, rounded
}

TEST_F(ScreensTest, ACurvedWallShowsThePointOnItsSurface) {
  const Display display = read(display_text(
      R"({"name": "a", "cylinder": {"radius_m": 3, "from_deg": -50, "to_deg": 50, "height_m": 2}, "pixels": [90, 40]})",
      "\"eye\": [0.4, 0.3, 1.2],"));
  const std::vector<WallPicture> pictures = pictures_of(display, {display.eye}, Camera());
  // A picture whose colours are its own coordinates.
  const Image8 picture = shown(display, [&](const WallPicture& of) {
                           Image8 ramps(of.size.x, of.size.y, 3);
                           for (int y = 0; y < of.size.y; ++y)
                             for (int x = 0; x < of.size.x; ++x) {
                               ramps.at(x, y)[0] = std::uint8_t(std::lround(255.0 * (x + 0.5) / of.size.x));
                               ramps.at(x, y)[1] =
                                   std::uint8_t(std::lround(255.0 * (1.0 - (y + 0.5) / of.size.y)));
                             }
                           return ramps;
                         }).front();
  for (int y = 0; y < 40; y += 3)
    for (int x = 0; x < 90; x += 4) {
      const float angle = glm::radians(-50.0f + 100.0f * (float(x) + 0.5f) / 90.0f);
      const glm::vec3 point(3.0f * std::sin(angle), 3.0f * std::cos(angle),
                            2.0f * (1.0f - (float(y) + 0.5f) / 40.0f));
      const glm::vec4 clip = pictures[0].clip_from_room * glm::vec4(point, 1.0f);
      const glm::vec2 at = 0.5f + 0.5f * glm::vec2(clip) / clip.w;
      EXPECT_NEAR(picture.at(x, y)[0], 255.0f * at.x, 1.6f) << x << "," << y;  // two roundings
      EXPECT_NEAR(picture.at(x, y)[1], 255.0f * at.y, 1.6f) << x << "," << y;
    }
}

TEST_F(ScreensTest, OverlappingProjectorsAddUpToOne) {
  const std::string
      one =
          R"({"name": "a", "lower_left": [-2, 2, 0], "lower_right": [0.5, 2, 0], "upper_left": [-2, 2, 2], "pixels": [250, 8]})",
      two =
          R"({"name": "b", "lower_left": [-0.5, 2, 0], "lower_right": [2, 2, 0], "upper_left": [-0.5, 2, 2], "pixels": [250, 8]})";
  for (const double gamma : {0.0, 2.2, 1.0}) {
    Display display = read(display_text(one + "," + two));
    display.gamma = gamma;
    const std::vector<Image8> both =
        shown(display, [](const WallPicture& of) { return filled(of.size, 200); });
    const auto light = [&](int value) {
      const double v = value / 255.0;
      return gamma > 0.0 ? std::pow(v, gamma) : v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    constexpr int dithered =
        8;  // pixels of a row whose mean is right: single ones differ by a value of 8 bits
    for (int x = 0; x + dithered <= 100; ++x) {
      double sum = 0.0;
      for (int i = x; i < x + dithered; ++i)
        sum += (light(*both[0].at(150 + i, 4)) + light(*both[1].at(i, 4))) / light(200) / dithered;
      EXPECT_NEAR(sum, 1.0, 0.004) << gamma << " " << x;
    }
    EXPECT_LT(*both[1].at(0, 4), 40);  // the ramps begin dark
  }
}

TEST_F(ScreensTest, AKeystoneIsAProjectiveMap) {
  const Display display = read(display_text(
      R"({"name": "a", "lower_left": [-1, 2, 0], "lower_right": [1, 2, 0], "upper_right": [1, 2, 2], "pixels": [200, 100],
          "keystone": [[0, 0], [1, 0], [0.75, 1], [0.25, 1]]})"));
  const Image8 picture = shown(display, [](const WallPicture& of) {
                           Image8 halves = filled(of.size, 255);  // white below, black above the middle
                           std::fill_n(halves.pixels.begin(), halves.pixels.size() / 2, std::uint8_t(0));
                           return halves;
                         }).front();
  EXPECT_EQ(*picture.at(10, 10), 0);  // beside the trapezium
  EXPECT_EQ(picture.at(10, 95)[0], 255);
  // The diagonals meet where the wall's middle is: 2/3 up.
  EXPECT_EQ(*picture.at(100, 100 - 62), 255);
  EXPECT_EQ(*picture.at(100, 100 - 70), 0);
}

}  // namespace
}  // namespace parvis::display
