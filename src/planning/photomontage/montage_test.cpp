#include "planning/photomontage/montage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/colour.h"
#include "base/test_folder.h"
#include "graphics/gl/test_context.h"
#include "planning/photomontage/caption.h"
#include "planning/photomontage/lens_view.h"
#include "rooms/rooms.h"

namespace parvis::photomontage {
namespace {

constexpr const char* court = R"(
sun(direction="0 -1 1")
model(name="floor", file="floor.obj", up=z)
design(name="stone") { placed(name=bench, kind=bench_stone, position="0 0 0", heading_deg=180) }
camera(name="street", position="0 -8 2", target="0 0 0.5", fov_deg=50)
)";
constexpr const char* floor_model = "v -20 -20 0\nv 20 -20 0\nv 20 20 0\nv -20 20 0\nf 1 2 3 4\n";

class PhotomontageTest : public gl::ContextTest {
 protected:
  PhotomontageTest() {
    folder_.write("court.xp", court), folder_.write("floor.obj", floor_model);
    Result<stage::Simulation> simulation =
        stage::open_simulation(rooms::all_registries(), folder_.path() / "court.xp", {});
    if (!simulation) throw std::runtime_error(to_string(simulation.errors()));
    simulation->settle();
    camera_ = *simulation->camera("street");
    stage_ = *stage::Stage::create(*std::move(simulation));
  }
  /// A grey photograph of this size by the scene's camera.
  MontageJob job(int width, int height) const {
    MontageJob job;
    job.photograph = photographs::photograph_of(camera_, "grey.png", width, height);
    job.picture = Image8(width, height, 4, 128);
    job.design = "stone";
    return job;
  }
  glm::dvec2 shown(const MontageJob& job, glm::dvec3 place) const {
    return *photographs::pixel_of_world(job.photograph, place);
  }

  TestFolder folder_;
  Camera camera_;
  std::unique_ptr<stage::Stage> stage_;
};

/// Middle of the pixels that differ from the photograph's grey, and their number.
std::pair<glm::dvec2, int> changed(const Image8& picture) {
  glm::dvec2 sum(0.0);
  int count = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      if (picture.at(x, y)[0] != 128) sum += glm::dvec2(x + 0.5, y + 0.5), ++count;
  return {sum / double(std::max(count, 1)), count};
}

TEST_F(PhotomontageTest, ShowsTheDesignWhereItStandsAndKeepsAllElse) {
  const MontageJob grey = job(320, 240);
  const Result<Montage> montage = make_montage(*stage_, grey);
  ASSERT_TRUE(montage) << to_string(montage.errors());
  const auto [middle, count] = changed(montage->picture);
  EXPECT_LT(glm::distance(middle, shown(grey, {0, 0, 0.25})), 12.0);  // with its shade behind it
  EXPECT_GT(montage->covered, 0.005);
  EXPECT_GT(montage->shaded, 0.0);
  EXPECT_LT(count, 320 * 240 / 4);
  const std::uint8_t* corner = montage->picture.at(0, 239);
  EXPECT_EQ(corner[0], 128);
}

TEST_F(PhotomontageTest, DarkensThePhotographInTheShadeOfTheDesign) {
  const MontageJob grey = job(320, 240);
  const Result<Montage> montage = make_montage(*stage_, grey);
  ASSERT_TRUE(montage);
  const glm::dvec2 shade = shown(grey, {0.3, 0.45, 0.0});  // the sun stands in the south, 45 degrees high
  const glm::dvec2 lit = shown(grey, {3.0, 0.45, 0.0});
  EXPECT_LT(montage->picture.at(int(shade.x), int(shade.y))[0], 115);
  EXPECT_EQ(montage->picture.at(int(lit.x), int(lit.y))[0], 128);
}

TEST_F(PhotomontageTest, BendsTheDesignAsTheLensDoes) {
  MontageJob bent = job(320, 240);
  const double focal = photographs::focal_px(bent.photograph.lens).x;
  bent.photograph.lens.model = photographs::LensModel::simple_radial;
  bent.photograph.lens.parameters = {focal, 240.0, 120.0, -0.2};  // off the middle, barrel-shaped
  const Result<Montage> montage = make_montage(*stage_, bent);
  ASSERT_TRUE(montage) << to_string(montage.errors());
  EXPECT_LT(glm::distance(changed(montage->picture).first, shown(bent, {0, 0, 0.25})), 12.0);
  EXPECT_GT(glm::distance(shown(bent, {0, 0, 0.25}), shown(job(320, 240), {0, 0, 0.25})), 40.0);
  const Result<LensView> view = view_of(bent.photograph, 2);
  ASSERT_TRUE(view);
  for (const glm::dvec3 place : {glm::dvec3(0, 0, 0.3), glm::dvec3(-2, 4, 0), glm::dvec3(1, 2, 1)}) {
    const glm::dvec3 in_camera =
        glm::dvec3(glm::inverse(bent.photograph.world_from_camera) * glm::dvec4(place, 1.0));
    const FrustumTangents& edges = *view->camera.off_axis;
    const glm::dvec2 drawn(
        (in_camera.x / -in_camera.z - edges.left) / (edges.right - edges.left) * view->width,
        (edges.top - in_camera.y / -in_camera.z) / (edges.top - edges.bottom) * view->height);
    EXPECT_LT(glm::distance(*view->drawn_pixel(bent.photograph.lens, shown(bent, place)), drawn), 0.01);
  }
}

TEST_F(PhotomontageTest, HidesTheDesignBehindWhatAMaskSays) {
  MontageJob grey = job(160, 120);
  grey.in_front = Image8(160, 120, 1, 255);
  const Result<Montage> montage = make_montage(*stage_, grey);
  ASSERT_TRUE(montage);
  EXPECT_EQ(changed(montage->picture).second, 0);
}

TEST_F(PhotomontageTest, TakesTheColourOfTheLightFromAGreyPixel) {
  MontageJob blue = job(160, 120);
  for (std::size_t i = 2; i < blue.picture.pixels.size(); i += 4) blue.picture.pixels[i] = 180;
  const auto blueness = [&](const MontageJob& job) {
    const Result<Montage> montage = make_montage(*stage_, job);
    const glm::dvec2 bench = shown(job, {0, 0, 0.45});
    const std::uint8_t* pixel = montage->picture.at(int(bench.x), int(bench.y));
    return double(pixel[2]) / std::max(double(pixel[0]), 1.0);
  };
  const double before = blueness(blue);
  blue.grey = glm::ivec2(10, 110);
  EXPECT_GT(blueness(blue), 1.2 * before);
  blue.grey = glm::ivec2(200, 110);
  EXPECT_FALSE(make_montage(*stage_, blue));
}

TEST_F(PhotomontageTest, SaysWhyThereIsNone) {
  MontageJob other = job(64, 48);
  other.design = "ston";
  EXPECT_NE(to_string(make_montage(*stage_, other).errors()).find("stone"), std::string::npos);
  MontageJob away = job(64, 48);
  away.photograph.world_from_camera = glm::dmat4(look_at({0, -8, 2}, {0, -20, 2}));
  EXPECT_NE(to_string(make_montage(*stage_, away).errors()).find("sees nothing of the design"),
            std::string::npos);
  MontageJob wide = job(64, 48);
  wide.photograph.lens = photographs::centred_lens(64, 48, 2.9);
  EXPECT_NE(to_string(make_montage(*stage_, wide).errors()).find("75 degrees"), std::string::npos);
  MontageJob sky = job(64, 48);
  sky.photograph.world_from_camera = glm::dmat4(look_at({0, -8, 2}, {0, -6, 9}));
  EXPECT_NE(to_string(make_montage(*stage_, sky).errors()).find("shows nothing of the scene"),
            std::string::npos);
}

TEST(Caption, StandsBelowThePictureInBlackOnWhite) {
  const Image8 picture(300, 200, 3, 90);
  const Result<Image8> whole =
      with_caption(picture, "Design \"stone\" with many words that need lines of their own");
  ASSERT_TRUE(whole) << to_string(whole.errors());
  EXPECT_EQ(whole->width, 300);
  EXPECT_GT(whole->height, 230);
  EXPECT_TRUE(std::equal(picture.pixels.begin(), picture.pixels.end(), whole->pixels.begin()));
  const auto strip = whole->pixels.begin() + std::ptrdiff_t(picture.pixels.size());
  EXPECT_LT(*std::min_element(strip, whole->pixels.end()), 40);
  EXPECT_EQ(*std::max_element(strip, whole->pixels.end()), 255);
}

}  // namespace
}  // namespace parvis::photomontage
