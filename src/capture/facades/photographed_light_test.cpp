// The sun of photographs of a small place whose shadows are computed, against the sun that they were computed
// with.
#include "capture/facades/photographed_light.h"

#include <cmath>
#include <functional>

#include "base/files.h"
#include "capture/facades/test_street.h"

namespace parvis::facades {
namespace {

constexpr double ground_z = -2.0, wall_y = 14.0;
constexpr double max_error_deg = 2.0;

struct Block {
  glm::dvec3 low, high;
};
const std::vector<Block> blocks{{{-5, 7, ground_z}, {-2.5, 9, 2}},
                                {{1, 8, ground_z}, {3.5, 9.5, 0.5}},
                                {{5.5, 6, ground_z}, {6.5, 7, 3}}};

/// A court: ground, a wall and three blocks.
std::vector<NamedMesh> court() {
  std::vector<NamedMesh> meshes{wall("wall", wall_y, -16, 16, ground_z, 8),
                                quad("ground", {-16, 2, ground_z}, {32, 0, 0}, {0, 12, 0})};
  for (std::size_t i = 0; i < blocks.size(); ++i)
    meshes.push_back(box(fmt::format("block_{}", i), glm::vec3(blocks[i].low), glm::vec3(blocks[i].high)));
  return meshes;
}

bool block_is_hit(const Block& block, glm::dvec3 origin, glm::dvec3 direction) {
  double first = 1e-6, last = 1e9;
  for (int axis = 0; axis < 3; ++axis) {
    double a = (block.low[axis] - origin[axis]) / direction[axis],
           b = (block.high[axis] - origin[axis]) / direction[axis];
    if (a > b) std::swap(a, b);
    first = std::max(first, a), last = std::min(last, b);
  }
  return first < last;
}

/// The side of the court that a point belongs to.
glm::dvec3 normal_at(glm::dvec3 p) {
  for (const Block& block : blocks)
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {-1.0, 1.0}) {
        const double face = side < 0.0 ? block.low[axis] : block.high[axis];
        const glm::dvec3 inside = glm::clamp(p, block.low, block.high);
        if (std::abs(p[axis] - face) > 1e-4 || glm::length(p - inside) > 1e-4 || (axis == 2 && side < 0.0))
          continue;
        glm::dvec3 normal(0.0);
        normal[axis] = side;
        return normal;
      }
  return std::abs(p.y - wall_y) < 1e-4 ? glm::dvec3(0, -1, 0) : glm::dvec3(0, 0, 1);
}

/// Paint with a fine pattern, and some dark windows in the wall.
double paint_at(glm::dvec3 p) {
  const double pattern = 0.5 + 0.08 * std::sin(5.0 * p.x + 3.0 * p.z) * std::sin(4.0 * p.y);
  const bool is_window =
      std::abs(p.y - wall_y) < 1e-4 && p.z > 4.0 && p.z < 5.5 && std::fmod(p.x + 16.0, 4.0) < 1.0;
  return is_window ? 0.12 : pattern;
}

/// A court under a sun: the sky gives a quarter of its light.
glm::vec3 sunlit(glm::dvec3 p, glm::dvec3 to_sun) {
  const glm::dvec3 normal = normal_at(p);
  double light = 0.25;
  bool is_shaded = false;
  for (const Block& block : blocks) is_shaded = is_shaded || block_is_hit(block, p + 1e-4 * normal, to_sun);
  if (!is_shaded) light += 0.9 * std::max(glm::dot(normal, to_sun), 0.0);
  return glm::vec3(float(paint_at(p) * light));
}

PackedFacade photographed_court(const std::function<glm::vec3(glm::dvec3)>& colour) {
  const TestFolder folder;
  const std::vector<NamedMesh> meshes = court();
  std::vector<photographs::Photograph> photos;
  for (int i = 0; i < 5; ++i)
    photos.push_back(photograph_of(meshes, colour, folder, fmt::format("{:04}.png", i),
                                   test_view(480, 360, {3.0 * i - 6.0, -1.0, 1.0}), 1.0f));
  PlaceSettings settings;
  settings.balances_colours = settings.finds_occluders = false;
  const Result<PlaceLayers> place = place_layers(photos, meshes, settings);
  EXPECT_TRUE(place) << to_string(place ? Errors{} : place.errors());
  return place ? packed_facade(*place) : PackedFacade{};
}

double degrees_between(glm::vec3 a, glm::dvec3 b) {
  return glm::degrees(std::acos(std::clamp(glm::dot(glm::dvec3(a), b), -1.0, 1.0)));
}

TEST(PhotographedLight, TheSunThatCastTheShadowsIsFound) {
  for (const glm::dvec3 given :
       {glm::dvec3(0.5, -0.6, 0.7), glm::dvec3(-0.7, -0.4, 0.5), glm::dvec3(0.2, -0.3, 0.9)}) {
    const glm::dvec3 to_sun = glm::normalize(given);
    const Result<PhotographedLight> light =
        find_photographed_light(photographed_court([&](glm::dvec3 p) { return sunlit(p, to_sun); }));
    ASSERT_TRUE(light);
    EXPECT_FALSE(light->is_overcast) << light->agreement;
    EXPECT_LT(degrees_between(light->to_sun, to_sun), max_error_deg)
        << light->agreement << ": " << light->to_sun.x << " " << light->to_sun.y << " " << light->to_sun.z;
    // The sun gives 0.9 where the sky gives 0.25: on a plane that faces it more than three times as much.
    const float of_sun = light->sun_irradiance.y, of_sky = light->sky.at(128, 10)[1] * 3.14159265f;
    EXPECT_GT(of_sun, 1.5f * of_sky);
    EXPECT_LT(of_sun, 8.0f * of_sky);
  }
}

TEST(PhotographedLight, AnotherSunAgreesLess) {
  const glm::dvec3 to_sun = glm::normalize(glm::dvec3(0.5, -0.6, 0.7));
  const glm::dvec3 away = glm::normalize(glm::dvec3(-0.5, -0.6, 0.7));
  const Result<PhotographedLight> light =
      find_photographed_light(photographed_court([&](glm::dvec3 p) { return sunlit(p, away); }));
  ASSERT_TRUE(light);
  EXPECT_GT(degrees_between(light->to_sun, to_sun), 40.0);
}

TEST(PhotographedLight, DarkPaintIsNoShadow) {
  // Stripes that no sun casts, half of them dark.
  const Result<PhotographedLight> light = find_photographed_light(photographed_court([](glm::dvec3 p) {
    const bool is_dark = std::fmod(p.x + p.y + 40.0, 1.4) < 0.7;
    return glm::vec3(float(paint_at(p) * (is_dark ? 0.15 : 0.6)));
  }));
  ASSERT_TRUE(light);
  EXPECT_GT(light->points, 1000u);
  EXPECT_TRUE(light->is_overcast) << light->agreement;
  EXPECT_EQ(light->sun_irradiance, glm::vec3(0.0f));
}

TEST(PhotographedLight, APlaceWithoutPhotographsIsAnError) {
  EXPECT_FALSE(find_photographed_light(PackedFacade{}));
}

TEST(PhotographedLight, AChangedSceneIsKept) {
  const TestFolder folder;
  PhotographedLight light;
  light.sky = ImageF(16, 8, 3, 0.4f);
  light.is_overcast = false, light.to_sun = {0, 0.6f, 0.8f}, light.sun_irradiance = {3, 2, 1};
  ASSERT_TRUE(write_photographed_light(folder.path(), light));
  const std::string written = *read_file(folder.path() / "light.xp");
  EXPECT_NE(written.find("sun(direction=\"0.0000 0.6000 0.8000\", irradiance=\"3.000 2.000 1.000\")"),
            std::string::npos)
      << written;
  light.is_overcast = true;
  ASSERT_TRUE(write_photographed_light(folder.path(), light));
  EXPECT_NE(read_file(folder.path() / "light.xp")->find("irradiance=\"0 0 0\""), std::string::npos);
  const std::string changed = "// mine\n" + written;
  ASSERT_TRUE(write_file(folder.path() / "light.xp", changed));
  EXPECT_FALSE(write_photographed_light(folder.path(), light));
  EXPECT_EQ(*read_file(folder.path() / "light.xp"), changed);
}

}  // namespace
}  // namespace parvis::facades
