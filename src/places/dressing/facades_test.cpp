#include "places/dressing/facades.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "base/mesh.h"
#include "base/random.h"
#include "base/test_data.h"
#include "formats/readers/readers.h"
#include "places/dressing/brick_texture.h"
#include "places/dressing/test_walls.h"
#include "rooms/rooms.h"
#include "scene/data/model_parts.h"

namespace parvis::dressing {
namespace {

/// Two walls that meet at a corner, and a roof, in one part.
scene::Model house(float width, float height) {
  scene::Model model;
  model.materials.emplace_back();
  scene::Part part;
  part.object = "building";
  add_quad(part.mesh, {0, 0, 2}, {width, 0, 2}, {width, 0, 2 + height}, {0, 0, 2 + height});
  add_quad(part.mesh, {width, 0, 2}, {width, 9, 2}, {width, 9, 2 + height}, {width, 0, 2 + height});
  add_quad(part.mesh, {0, 0, 2 + height}, {width, 0, 2 + height}, {width, 9, 2 + height}, {0, 9, 2 + height});
  fill_normals(part.mesh);
  part.mesh.uvs.resize(part.mesh.positions.size());
  model.parts.push_back(std::move(part));
  return model;
}

TEST(Facades, HoldWholeBaysAndStoreys) {
  scene::Model model = house(12.2f, 9.0f);
  EXPECT_EQ(add_facades(model, "build*"), 4u);
  EXPECT_EQ(model.parts[0].mesh.triangle_count(), 2u);  // the roof
  const auto is_whole = [](float value) { return std::abs(value - std::round(value)) < 2e-3f; };
  int strips = 0;
  for (std::size_t i = 1; i < model.parts.size(); ++i) {
    const Mesh& walls = model.parts[i].mesh;
    EXPECT_TRUE(check(walls, "walls").ok());
    if (model.materials[std::size_t(model.parts[i].material)].name == "brick wall") continue;
    ++strips;
    glm::vec2 low(1e9f), high(-1e9f);
    for (const glm::vec2& uv : walls.uvs) {
      low = glm::min(low, uv), high = glm::max(high, uv);
      const float rows = -uv.y * brick_storeys;
      EXPECT_TRUE(is_whole(rows) || is_whole(rows + 0.01f))
          << rows << ": whole, or up to a seam of a hundredth";
    }
    EXPECT_TRUE(is_whole(low.x * brick_bays) && is_whole(high.x * brick_bays)) << low.x << " " << high.x;
  }
  EXPECT_EQ(strips, 2) << "street level and the storeys above";
}

double area_of(const scene::Model& model, std::string_view target) {
  double area = 0.0;
  for (const std::size_t index : scene::matching_parts(model, target)) {
    const Mesh& mesh = model.parts[index].mesh;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      const glm::vec3 a = mesh.positions[mesh.indices[i]];
      area += 0.5 * double(glm::length(glm::cross(mesh.positions[mesh.indices[i + 1]] - a,
                                                  mesh.positions[mesh.indices[i + 2]] - a)));
    }
  }
  return area;
}

/// A wall that faces south, as a polygon of its own.
void add_wall(scene::Model& model, float x0, float x1, float foot, float top, float y = 0.0f,
              bool north = false) {
  Mesh& mesh = model.parts.front().mesh;
  if (north)
    add_quad(mesh, {x1, y, foot}, {x0, y, foot}, {x0, y, top}, {x1, y, top});
  else
    add_quad(mesh, {x0, y, foot}, {x1, y, foot}, {x1, y, top}, {x0, y, top});
  fill_normals(mesh);
  mesh.uvs.resize(mesh.positions.size());
}

double fraction_of(const scene::Model& model, const char* material) {
  return area_of(model, material) / area_of(model, "facade*");
}

TEST(Facades, NoWallIsLostOrDoubled) {
  scene::Model rows = no_walls();
  Random random(3);
  double area = 0.0;
  for (float x = 0.0f; x < 300.0f;) {
    const float width = random.uniform(0.3f, 14.0f), top = random.uniform(1.0f, 20.0f);
    add_wall(rows, x, x + width, random.uniform(-0.5f, 0.5f), top);
    x += width;
  }
  area = area_of(rows, "building");
  add_facades(rows, "*");
  EXPECT_NEAR(area_of(rows, "facade"), area, 1e-5 * area);
  for (const char* name : {"cities/delft_context.city.json", "cities/DenHaag_01.city.json"}) {
    const auto file = shared_data(name);
    if (!file) GTEST_SKIP() << name;
    Errors warnings;
    Result<scene::Model> city = rooms::all_registries().get<formats::Readers>().read(*file, {}, warnings);
    ASSERT_TRUE(city) << to_string(city.errors());
    const double walls = area_of(*city, "WallSurface");
    add_facades(*city, "WallSurface");
    EXPECT_NEAR(area_of(*city, "facade") + area_of(*city, "WallSurface"), walls, 1e-5 * walls) << name;
  }
}

/// A wall's clipping may lose nothing but rounding.
void expect_all_kept(scene::Model model, const char* what) {
  const double area = area_of(model, "building");
  add_facades(model, "*");
  EXPECT_NEAR(area_of(model, "facade"), area, 1e-5 * area) << what;
}

TEST(Facades, NarrowLongAndPointedWallsAreKept) {
  scene::Model narrow = no_walls(), low = no_walls(), jagged = no_walls(), spire = no_walls();
  add_wall(narrow, 0.0f, 0.04f, 0.0f, 9.0f);
  expect_all_kept(narrow, "4 cm wide");
  add_wall(low, 0.0f, 9.0f, 0.0f, 0.04f);
  expect_all_kept(low, "4 cm high");
  Mesh& saw = jagged.parts.front().mesh;
  for (int i = 0; i < 900; ++i) {
    const std::uint32_t first = std::uint32_t(saw.positions.size());
    const float x = float(i);
    saw.positions.insert(saw.positions.end(), {{x, 0, 0}, {x, 0, i == 450 ? 30.0f : 5.0f + float(i % 2)}});
    if (i > 0)
      saw.indices.insert(saw.indices.end(), {first - 2, first, first + 1, first - 2, first + 1, first - 1});
  }
  Mesh& tip = spire.parts.front().mesh;
  tip.positions = {{0, 0, 0}, {4, 0, 0}, {2, 0, 60}}, tip.indices = {0, 1, 2};
  for (scene::Model* model : {&jagged, &spire}) {
    fill_normals(model->parts.front().mesh);
    model->parts.front().mesh.uvs.resize(model->parts.front().mesh.positions.size());
  }
  expect_all_kept(jagged, "900 corners, one of them high");
  expect_all_kept(spire, "a spire");
}

TEST(Facades, WallsWithoutAWidthHaveFiniteTextureCoordinates) {
  scene::Model slivers = no_walls();  // whose sides round to one place along the wall
  Mesh& mesh = slivers.parts.front().mesh;
  for (int i = 0; i < 40; ++i) {
    const float x = 1000.0f + 30.0f * float(i), y = 0.3f * x;
    const std::uint32_t first = std::uint32_t(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {{x, y, 0}, {x, y, 9}});
    if (i % 2 == 0)
      mesh.positions.emplace_back(std::nextafter(x, 1e9f), y, 0);
    else
      mesh.positions.emplace_back(x, std::nextafter(y, 1e9f), 0);
    mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2});
  }
  for (glm::vec3& p : mesh.positions) p = {0.8f * p.x - 0.6f * p.y, 0.6f * p.x + 0.8f * p.y, p.z};
  fill_normals(mesh);
  mesh.uvs.resize(mesh.positions.size());
  EXPECT_GT(add_facades(slivers, "*"), 10u);
  for (const scene::Part& part : slivers.parts)
    for (const glm::vec2 uv : part.mesh.uvs)
      EXPECT_TRUE(std::isfinite(uv.x) && std::isfinite(uv.y)) << part.object;
}

/// sRGB of the front at a place, as its parts of this material paint it; nothing where they do not.
std::optional<glm::ivec3> painted_at(const scene::Model& model, const char* material, glm::vec2 place) {
  for (const std::size_t index : scene::matching_parts(model, material)) {
    const Mesh& mesh = model.parts[index].mesh;
    const scene::Material& paint = model.materials[std::size_t(model.parts[index].material)];
    const Image8& image = model.textures[std::size_t(paint.base_colour_texture)].image;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      const auto corner = [&](std::size_t k) {
        const glm::vec3 p = mesh.positions[mesh.indices[i + k]];
        return glm::dvec2(p.x, p.z);
      };
      const glm::dmat2 sides(corner(1) - corner(0), corner(2) - corner(0));
      const glm::dvec2 at = glm::inverse(sides) * (glm::dvec2(place) - corner(0));
      if (!(at.x >= 0.0 && at.y >= 0.0 && at.x + at.y <= 1.0)) continue;
      const auto uv = [&](std::size_t k) { return mesh.uvs[mesh.indices[i + k]]; };
      const glm::vec2 t = uv(0) + float(at.x) * (uv(1) - uv(0)) + float(at.y) * (uv(2) - uv(0));
      const glm::vec2 pixel = (t - glm::floor(t)) * glm::vec2(image.width, image.height);
      const std::uint8_t* rgb =
          image.at(std::min(int(pixel.x), image.width - 1), std::min(int(pixel.y), image.height - 1));
      return glm::ivec3(rgb[0], rgb[1], rgb[2]);
    }
  }
  return std::nullopt;
}

TEST(Facades, DoorsStandOnTheGroundAndHaveTheSizeOfDoors) {
  scene::Model front = no_walls();
  add_wall(front, 0.0f, 6.0f, 2.0f, 11.0f);
  add_facades(front, "*", 1);
  constexpr float step_m = 0.05f;
  glm::vec2 low(1e9f), high(-1e9f);  // of the door's leaf, whose paint is green or blue between red bricks
  int painted = 0;
  for (float z = 2.025f; z < 6.0f; z += step_m)
    for (float x = 0.025f; x < 6.0f; x += step_m) {
      const std::optional<glm::ivec3> colour = painted_at(front, "street level", {x, z});
      if (!colour || std::max(colour->y, colour->z - 7) <= colour->x + 8) continue;
      low = glm::min(low, {x, z}), high = glm::max(high, {x, z}), ++painted;
    }
  const glm::vec2 size = high - low + step_m;
  EXPECT_LT(low.y, 2.4f) << "above the step";
  EXPECT_NEAR(size.x, 0.9f, 0.2f);
  EXPECT_NEAR(size.y, 2.1f, 0.25f);
  EXPECT_GT(float(painted) * step_m * step_m, 0.85f * size.x * size.y) << "one door, not two";
}

TEST(Facades, HousesHaveDoorsAtTheStreetAndPartyWallsAreBlank) {
  scene::Model free_wall = no_walls();
  add_wall(free_wall, 0.0f, 12.0f, 0.0f, 9.0f);
  add_facades(free_wall, "*");
  EXPECT_GT(area_of(free_wall, "street level"), 30.0);
  EXPECT_GT(area_of(free_wall, "facade"), 60.0);
  EXPECT_LT(fraction_of(free_wall, "brick wall"), 0.02);
  scene::Model party = no_walls();
  add_wall(party, 0.0f, 12.0f, 0.0f, 9.0f);
  add_wall(party, 0.0f, 12.0f, 0.0f, 6.0f, -0.1f, true);  // of the next house
  add_facades(party, "*");
  EXPECT_NEAR(fraction_of(party, "brick wall"), 1.0, 1e-3);
}

/// A box of walls from one height to another, of 4.5 m by 12 m, over an underside where one is wanted.
scene::Model bridge(float low, float high, bool has_underside) {
  scene::Model model;
  for (const char* name : {"WallSurface", "OuterCeilingSurface"}) {
    model.materials.emplace_back();
    model.materials.back().name = name;
  }
  scene::Part walls, underside;
  const std::array<glm::vec2, 4> plan{{{0, 0}, {4.5f, 0}, {4.5f, 12}, {0, 12}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::vec2 a = plan[i], b = plan[(i + 1) % 4];
    add_quad(walls.mesh, {a, low}, {b, low}, {b, high}, {a, high});
  }
  add_quad(underside.mesh, {plan[3], low}, {plan[2], low}, {plan[1], low}, {plan[0], low});
  underside.material = 1;
  for (scene::Part* part : {&walls, &underside}) {
    fill_normals(part->mesh);
    part->mesh.uvs.resize(part->mesh.positions.size());
    if (part == &walls || has_underside) model.parts.push_back(*part);
  }
  return model;
}

bool has_material(const scene::Model& model, const char* name) {
  return std::ranges::any_of(model.parts, [&](const scene::Part& part) {
    return model.materials[std::size_t(part.material)].name == name;
  });
}

TEST(Facades, WallsThatHangInTheAirHaveWindowsAndNoDoors) {
  scene::Model standing = bridge(5.0f, 12.0f, false), hanging = bridge(5.0f, 12.0f, true);
  EXPECT_EQ(add_facades(standing, "WallSurface"), 8u);
  EXPECT_EQ(add_facades(hanging, "WallSurface"), 8u);
  EXPECT_TRUE(has_material(standing, "street level"));
  EXPECT_FALSE(has_material(hanging, "street level"));
  EXPECT_TRUE(has_material(hanging, "facade")) << "windows";
}

TEST(Facades, GablesAboveTheEavesHaveNoWindows) {
  scene::Model gable = no_walls();
  Mesh& mesh = gable.parts.front().mesh;
  mesh.positions = {{0, 0, 0}, {8, 0, 0}, {8, 0, 6}, {4, 0, 10}, {0, 0, 6}};
  mesh.indices = {0, 1, 2, 0, 2, 4, 4, 2, 3};
  fill_normals(mesh);
  mesh.uvs.resize(mesh.positions.size());
  add_facades(gable, "*");
  for (const std::size_t index : scene::matching_parts(gable, "facade")) {
    const scene::Part& part = gable.parts[index];
    if (gable.materials[std::size_t(part.material)].name == "brick wall") continue;
    for (const glm::vec3& p : part.mesh.positions) EXPECT_LE(p.z, 6.05f);
  }
  EXPECT_NEAR(area_of(gable, "brick wall"), 16.0, 0.6);
}

TEST(Facades, WindowsAndPicturesOfTheModelAreKept) {
  scene::Model glazed = no_walls();
  add_wall(glazed, 0.0f, 12.0f, 0.0f, 9.0f);
  glazed.materials.emplace_back();
  glazed.materials.back().name = "Window";
  scene::Part window;
  window.object = "Window", window.material = 1;
  add_quad(window.mesh, {2, -0.05f, 3}, {3, -0.05f, 3}, {3, -0.05f, 5}, {2, -0.05f, 5});
  glazed.parts.push_back(window);
  glazed.materials.emplace_back();
  glazed.materials.back().name = "oak Door";
  scene::Part door;
  door.object = "leaf", door.material = 2;
  add_quad(door.mesh, {5, -0.05f, 0}, {6, -0.05f, 0}, {6, -0.05f, 2}, {5, -0.05f, 2});
  glazed.parts.push_back(door);
  for (const char* target : {"building", "*"}) {
    scene::Model dressed = glazed;
    EXPECT_EQ(add_facades(dressed, target), 2u) << target;
    EXPECT_NEAR(fraction_of(dressed, "brick wall"), 1.0, 1e-3) << target;
    EXPECT_NEAR(area_of(dressed, "Window"), 2.0, 1e-6) << target;
    EXPECT_NEAR(area_of(dressed, "leaf"), 2.0, 1e-6) << target;
  }
  scene::Model pictured = no_walls();
  add_wall(pictured, 0.0f, 12.0f, 0.0f, 9.0f);
  pictured.textures.emplace_back();
  pictured.materials.front().base_colour_texture = 0;
  EXPECT_EQ(add_facades(pictured, "*"), 0u);
}

TEST(Facades, OnlyWhatIsNamedAsAnOpeningIsNoWall) {
  const auto dressed = [](const char* material) {
    scene::Model model = no_walls();
    add_wall(model, 0.0f, 12.0f, 0.0f, 9.0f);
    model.materials.front().name = material;
    return add_facades(model, "*");
  };
  for (const char* wall : {"WallWithWindows", "Doorstep", "", "indoor paint"})
    EXPECT_EQ(dressed(wall), 2u) << wall;
  for (const char* opening : {"window", "Door_12", "front DOOR", "IfcWindow Casement:1400x1600", "doors"})
    EXPECT_EQ(dressed(opening), 0u) << opening;
}

TEST(Facades, HousesOfARowDifferAndASeedChangesThem) {
  const auto dressed = [](std::uint64_t seed) {
    scene::Model row = no_walls();
    for (int i = 0; i < 12; ++i)
      add_wall(row, 6.0f * float(i), 6.0f * float(i) + 6.0f, 0.0f, 6.0f + float(i % 4) * 1.5f);
    add_facades(row, "*", seed);
    std::set<int> materials;
    for (const scene::Part& part : row.parts) materials.insert(part.material);
    return materials;
  };
  const std::set<int> houses = dressed(1);
  EXPECT_GT(houses.size(), 4u);
  EXPECT_EQ(houses, dressed(1));
  EXPECT_NE(houses, dressed(2));
}

/// A wall of a building of this kind, dressed.
scene::Model dressed_wall(const std::string& kind, float width = 12.0f, float top = 9.0f) {
  scene::Model model = no_walls();
  add_wall(model, 0.0f, width, 0.0f, top);
  model.parts.front().object = "WallSurface " + kind;
  add_facades(model, "WallSurface*", 3);
  return model;
}

/// How many rows of the sheet "facade" a wall shows.
float rows_of(const scene::Model& model, float rows_on_sheet) {
  float low = 1e9f, high = -1e9f;
  for (const std::size_t index : scene::matching_parts(model, "facade"))
    if (const scene::Part& part = model.parts[index];
        model.materials[std::size_t(part.material)].name == "facade")
      for (const glm::vec2 uv : part.mesh.uvs) low = std::min(low, uv.y), high = std::max(high, uv.y);
  return (high - low) * rows_on_sheet;
}

/// The fraction of a wall, as its colours and the glass of its texture show, that is smooth: panes.
double glass_fraction(const scene::Model& model) {
  double glass = 0.0, all = 0.0;
  for (const scene::Part& part : model.parts) {
    const scene::Material& paint = model.materials[std::size_t(part.material)];
    if (part.mesh.indices.empty() || paint.surface_texture == scene::no_index) continue;
    const Image8& surface = model.textures[std::size_t(paint.surface_texture)].image;
    for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
      const auto uv = [&](std::size_t k) { return part.mesh.uvs[part.mesh.indices[i + k]]; };
      const auto at = [&](std::size_t k) { return part.mesh.positions[part.mesh.indices[i + k]]; };
      const double area = 0.5 * double(glm::length(glm::cross(at(1) - at(0), at(2) - at(0))));
      constexpr int steps = 60;
      int smooth = 0, count = 0;
      for (int a = 0; a < steps; ++a)
        for (int b = 0; a + b < steps; ++b, ++count) {
          const glm::vec2 t =
              uv(0) + (float(a) / steps) * (uv(1) - uv(0)) + (float(b) / steps) * (uv(2) - uv(0));
          const glm::vec2 pixel = (t - glm::floor(t)) * glm::vec2(surface.width, surface.height);
          smooth += surface.at(std::min(int(pixel.x), surface.width - 1),
                               std::min(int(pixel.y), surface.height - 1))[1] < 50;
        }
      glass += area * double(smooth) / double(count), all += area;
    }
  }
  return glass / all;
}

TEST(Facades, WithoutAKindWallsAreThoseOfNoCertainTime) {
  const scene::Model named = dressed_wall(""), known = dressed_wall("dwelling");
  for (const scene::Model* model : {&named, &known})
    EXPECT_EQ(model->materials.size(), 1u + 3 * brick_colour_count) << "the common bricks alone";
  EXPECT_NEAR(rows_of(named, brick_storeys), 2.0f, 1e-3f);
}

TEST(Facades, NamesOfOtherModelsAreNoKinds) {
  scene::Model model = no_walls();
  add_wall(model, 0.0f, 12.0f, 0.0f, 9.0f);
  model.parts.front().object = "plaster office";
  add_facades(model, "*");
  EXPECT_EQ(model.materials.size(), 1u + 3 * brick_colour_count);
}

TEST(Facades, AsManyStoreysAsTheFileSays) {
  for (const int storeys : {2, 3, 4}) {
    const std::string word = fmt::format("{}-storeys", storeys);
    EXPECT_NEAR(rows_of(dressed_wall(word, 12.0f, 10.4f), brick_storeys), float(storeys - 1), 1e-3f) << word;
    EXPECT_NEAR(rows_of(dressed_wall("1946-1974 " + word, 12.0f, 10.4f), 2.0f), float(storeys - 1), 1e-3f);
  }
  EXPECT_NEAR(rows_of(dressed_wall("40-storeys", 12.0f, 9.0f), brick_storeys), 2.0f, 1e-3f)
      << "storeys of 22 cm are not believed";
}

TEST(Facades, StoreysOfTheNineteenthCenturyAreHigherThanThoseAfterTheWar) {
  EXPECT_LT(rows_of(dressed_wall("1870-1918", 12.0f, 20.0f), 2.0f) + 0.5f,
            rows_of(dressed_wall("1946-1974", 12.0f, 20.0f), 2.0f));
}

TEST(Facades, UsesHaveTheirWindows) {
  const double dwelling = glass_fraction(dressed_wall("dwelling 1946-1974")),
               office = glass_fraction(dressed_wall("office 1946-1974")),
               shop = glass_fraction(dressed_wall("shop 1946-1974")),
               church = glass_fraction(dressed_wall("church 1870-1918", 20.0f, 12.0f));
  EXPECT_GT(dwelling, 0.1);
  EXPECT_GT(office, 1.3 * dwelling) << "bands of windows";
  EXPECT_GT(shop, dwelling) << "a shop front";
  EXPECT_GT(church, 0.1);
  for (const char* blank : {"industry", "industry 1975-1999", "shed 1946-1974", "shed"})
    EXPECT_LT(glass_fraction(dressed_wall(blank)), 0.01) << blank << ": gates at most";
}

TEST(Facades, TheFilesMaterialsAndColoursAreUsed) {
  const auto plain_name = [](const std::string& kind) {
    const scene::Model model = dressed_wall(kind, 1.2f);
    return model.materials.back().name;
  };
  EXPECT_EQ(plain_name("plaster"), "plaster wall");
  EXPECT_EQ(plain_name("1946-1974 stone white"), "stone wall");
  EXPECT_EQ(plain_name("brick"), "brick wall");
  const auto mean = [](const std::string& kind) {
    const scene::Model model = dressed_wall(kind, 1.2f);
    const Image8& image = model.textures[std::size_t(model.materials.back().base_colour_texture)].image;
    glm::vec3 sum(0.0f);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        sum += glm::vec3(image.at(x, y)[0], image.at(x, y)[1], image.at(x, y)[2]);
    return sum / float(image.width * image.height);
  };
  EXPECT_GT(mean("plaster white").z, mean("plaster yellow").z + 30.0f);
  EXPECT_GT(mean("plaster red").x, mean("plaster green").x + 10.0f);
}

TEST(Facades, NeighboursOfTwoKindsInOnePlaneKeepTheirOwn) {
  scene::Model row = no_walls();
  add_wall(row, 0.0f, 10.0f, 0.0f, 9.0f);
  row.parts.front().object = "WallSurface church";
  row.parts.push_back(row.parts.front());
  row.parts.back().object = "WallSurface dwelling";
  row.parts.back().mesh = {};
  add_quad(row.parts.back().mesh, {10, 0, 0}, {20, 0, 0}, {20, 0, 9}, {10, 0, 9});
  fill_normals(row.parts.back().mesh);
  row.parts.back().mesh.uvs.resize(4);
  add_facades(row, "*", 1);
  for (const std::size_t index : scene::matching_parts(row, "street level"))
    for (const glm::vec3& p : row.parts[index].mesh.positions)
      EXPECT_GT(p.x, 9.9f) << "churches have no street level";
  EXPECT_NEAR(area_of(row, "facade"), 180.0, 0.01);
}

TEST(Facades, KindsOfARowDifferAndASeedChangesThem) {
  const auto colours = [](std::uint64_t seed) {
    scene::Model row = no_walls();
    for (int i = 0; i < 12; ++i)
      add_wall(row, 6.0f * float(i), 6.0f * float(i) + 6.0f, 0.0f, 6.0f + float(i % 4) * 1.5f);
    row.parts.front().object = "WallSurface dwelling before-1870";
    add_facades(row, "*", seed);
    std::vector<double> areas;
    for (const scene::Part& part : row.parts)
      areas.push_back(double(part.mesh.positions.size()) + 1e-3 * double(part.material));
    return areas;
  };
  EXPECT_GT(colours(1).size(), 4u);
  EXPECT_EQ(colours(1), colours(1));
  EXPECT_NE(colours(1), colours(2));
}

TEST(Facades, SmallWallsArePlain) {
  scene::Model model = house(12.0f, 1.5f);
  add_facades(model, "*");
  EXPECT_EQ(model.materials[std::size_t(model.parts[1].material)].name, "brick wall");
}

TEST(Facades, WithoutOpeningsWallsAreBricksAlone) {
  scene::Model model = house(12.0f, 6.0f);
  add_facades(model, "*", 1, false);
  ASSERT_EQ(model.parts.size(), 2u);
  EXPECT_EQ(model.materials[std::size_t(model.parts[1].material)].name, "brick wall");
}

TEST(Facades, WithoutWallsNothingChanges) {
  scene::Model model = house(8.0f, 6.0f);
  EXPECT_EQ(add_facades(model, "no such name"), 0u);
  EXPECT_EQ(model.parts.size(), 1u);
  EXPECT_TRUE(model.textures.empty());
}

TEST(BrickWalls, RepeatWithoutASeam) {
  // Neighbours across the border differ no more than neighbours elsewhere do on average.
  const Image8 image = brick_wall_pictures(BrickSheet::storeys, 1).colours[0];
  const auto difference = [&](int left, int right) {
    float sum = 0.0f;
    for (int y = 0; y < image.height; ++y)
      sum += std::abs(float(image.at(left, y)[0]) - float(image.at(right, y)[0]));
    return sum / float(image.height);
  };
  float inside = 0.0f;
  for (int x = 0; x < 60; ++x) inside = std::max(inside, difference(x, x + 1));
  EXPECT_LE(difference(image.width - 1, 0), 1.2f * inside);
}

}  // namespace
}  // namespace parvis::dressing
