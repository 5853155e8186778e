#include "capture/facades/surface_colours.h"

#include <gtest/gtest.h>

#include "capture/facades/shown_colours.h"
#include "capture/facades/test_street.h"

namespace parvis::facades {
namespace {

/// The street with a courtyard behind the cameras, that none of them sees.
struct Courtyard {
  Photos input;
  PlaceLayers place;

  explicit Courtyard(bool has_ground) {
    std::vector<NamedMesh> meshes = street();
    if (has_ground) meshes.push_back(quad("ground", {-8, 2, -2.5}, {16, 0, 0}, {0, 4, 0}));
    meshes.push_back(wall("back", -6, -4, 4, -2, 3));
    meshes.push_back(quad("yard", {-4, -6, -2}, {8, 0, 0}, {0, 4, 0}));
    const auto colour = [](glm::dvec3 p) {
      return p.z < -2.4 ? glm::vec3(0.02f, 0.5f, 0.02f) : glm::vec3(0.5f, 0.02f, 0.02f);
    };
    std::vector<photographs::Photograph> photos;
    for (int i = 0; i < 2; ++i)
      photos.push_back(photograph_of(meshes, colour, input.folder, fmt::format("yard_{}.png", i),
                                     test_view(160, 120, {double(i), 0, 0}), 1.0f));
    Result<PlaceLayers> made = place_layers(photos, meshes);
    EXPECT_TRUE(made) << to_string(made ? Errors{} : made.errors());
    if (made) place = *std::move(made);
  }
  /// Looking back into the courtyard.
  View back() const {
    View view = test_view(64, 48, {0.5, 0, 0});
    view.camera_from_world = glm::transpose(glm::dmat3(-1, 0, 0, 0, 0, -1, 0, -1, 0));
    return view;
  }
};

/// The proposed colour of the first corner of a surface.
glm::u8vec3 proposed(const PackedFacade& facade, const std::string& surface) {
  for (std::size_t t = 0; t < facade.triangle_count(); ++t)
    if (facade.surfaces[facade.surface_of_triangle[t]] == surface) return facade.fallback[3 * t];
  ADD_FAILURE() << surface;
  return no_colour;
}

TEST(SurfaceColours, WhatIsNowhereSeenLooksLikeWhatLiesAsItDoes) {
  const PackedFacade facade = packed_facade(Courtyard(true).place);
  const glm::ivec3 wall(proposed(facade, "back")), floor(proposed(facade, "yard"));
  EXPECT_GT(wall.x, wall.y + 100) << "a wall is coloured as walls";
  EXPECT_GT(floor.y, floor.x + 100) << "and a floor as the ground";
  const glm::ivec3 without_ground(proposed(packed_facade(Courtyard(false).place), "yard"));
  EXPECT_GT(without_ground.x, without_ground.y + 40) << "without any ground as the place";
}

TEST(SurfaceColours, EveryPixelHasAProposedColourUntilItIsRefused) {
  Courtyard yard(true);
  const View back = yard.back();
  EXPECT_EQ(shown_shares(packed_facade(yard.place), {&back, 1}).filled_percent, 100.0);
  EXPECT_EQ(shown_shares(packed_facade(yard.place), {&back, 1}).layered_percent, 0.0);
  for (std::size_t object = 0; object < yard.place.surfaces.size(); ++object)
    if (yard.place.model.objects[object].name == "back") yard.place.surfaces[object] = Filling::refused;
  const PackedFacade refused = packed_facade(yard.place);
  const double left = shown_shares(refused, {&back, 1}).filled_percent;
  EXPECT_LT(left, 90.0);
  EXPECT_GT(left, 10.0) << "the yard's ground was not refused";
  EXPECT_EQ(proposed(refused, "back"), no_colour);
  EXPECT_NE(proposed(refused, "yard"), no_colour);
  EXPECT_EQ(shown_shares(refused, {&yard.place.views[0], 1}).filled_percent, 100.0);
}

}  // namespace
}  // namespace parvis::facades
