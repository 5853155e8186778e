#include "scene/data/glass_pieces.h"

#include <gtest/gtest.h>

#include "scene/data/test_scene.h"

namespace parvis::scene {
namespace {

Material glass(float ior = 1.5f) {
  Material material;
  material.ior = ior;
  return material;
}

Mesh without_top(Mesh mesh) {
  mesh.indices.resize(mesh.indices.size() / 2);
  return mesh;
}

TEST(GlassPieces, OfAPartAreDistinguishedAndOpenOnesKnown) {
  Mesh mesh = sphere({-2, 0, 0}, 0.5f, 8);
  append(mesh, without_top(sphere({2, 0, 0}, 0.5f, 8)));
  append(mesh, box({0, 0, 0}, {1, 1, 1}));  // each side has corners of its own
  const std::vector<GlassPiece> found = glass_pieces(*model_of(mesh, glass()));
  ASSERT_EQ(found.size(), 3u);
  EXPECT_TRUE(found[0].is_closed);
  EXPECT_FALSE(found[1].is_closed);
  EXPECT_TRUE(found[2].is_closed);
  EXPECT_EQ(found[2].mesh.triangle_count(), 12u);
  EXPECT_LT(found[0].mesh.bounds().max.x, -1.4f);
  EXPECT_TRUE(glass_pieces(*model_of(mesh, matt({1, 1, 1}))).empty());
}

TEST(GlassPieces, MayBeOfSeveralPartsButOfOneGlass) {
  const Mesh whole = box({0, 0, 0}, {1, 1, 1});
  Mesh front = whole, back = whole;
  front.indices.resize(18);
  back.indices.erase(back.indices.begin(), back.indices.begin() + 18);
  Model model = *model_of(front, glass());
  model.parts.push_back({.object = "back", .mesh = back, .material = 1});
  model.materials.push_back(glass());
  const std::vector<GlassPiece> found = glass_pieces(model);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].is_closed);
  EXPECT_EQ(found[0].triangles.size(), 2u);
  model.materials[1].ior = 1.33f;
  ASSERT_EQ(glass_pieces(model).size(), 2u);
  EXPECT_FALSE(glass_pieces(model)[0].is_closed);
}

TEST(GlassPieces, CavitiesBelongToWhatTheyAreIn) {
  Mesh inside = sphere({0.1f, 0, 0}, 0.3f, 8), mesh = sphere({0, 0, 0}, 1.0f, 8);
  for (std::size_t i = 0; i < inside.indices.size(); i += 3)
    std::swap(inside.indices[i], inside.indices[i + 1]);
  append(mesh, inside);
  append(mesh, sphere({0.9f, 0.9f, 0.9f}, 0.1f, 8));  // in the ball's box, not in the ball
  const std::vector<GlassPiece> found = glass_pieces(*model_of(mesh, glass()));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_GT(found[0].mesh.triangle_count(), 1.5 * double(found[1].mesh.triangle_count()));
}

TEST(GlassPieces, OfAnotherGlassAreNoCavities) {
  Model model = *model_of(sphere({0, 0, 0}, 1.0f, 8), glass());
  model.parts.push_back({.object = "core", .mesh = sphere({0, 0, 0}, 0.3f, 8), .material = 1});
  model.materials.push_back(glass());
  ASSERT_EQ(glass_pieces(model).size(), 1u);
  model.materials[1].absorption_per_m = {9, 1, 9};
  const std::vector<GlassPiece> found = glass_pieces(model);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].material, 0);
  EXPECT_EQ(found[1].material, 1);
  EXPECT_LT(found[1].mesh.bounds().max.x, 0.4f);
}

/// Whichever way round the cavity's triangles run.
TEST(GlassPieces, HaveTheirGlassAsVolumeWithoutCavities) {
  const auto cube = [](float half) { return box(glm::vec3(-half), glm::vec3(half)); };
  Mesh mesh = cube(0.5f), cavity = cube(1.0f);
  for (std::size_t i = 0; i < cavity.indices.size(); i += 3)
    std::swap(cavity.indices[i], cavity.indices[i + 1]);
  append(mesh, cavity);
  append(mesh, cube(2.0f));
  const std::vector<GlassPiece> found = glass_pieces(*model_of(mesh, glass()));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].volume, 64.0 - 8.0 + 1.0, 1e-4) << "a body in the cavity of a body";
}

TEST(GlassPieces, AreClosedThoughBlocksStandFaceToFace) {
  Mesh mesh = box({0, 0, 0}, {1, 1, 1});
  append(mesh, box({0, 0, 1}, {1, 1, 2}));
  const std::vector<GlassPiece> found = glass_pieces(*model_of(mesh, glass()));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].is_closed);
}

TEST(GlassPieces, AreMadePartsOfTheirOwn) {
  Mesh mesh = sphere({-2, 0, 0}, 0.5f, 8);
  append(mesh, sphere({2, 0, 0}, 0.5f, 8));
  append(mesh, box({0, 0, 0}, {1, 1, 1}));
  Model model = *model_of(mesh, glass());
  model.parts[0].object = "lamp", model.parts[0].is_backdrop = true;
  std::size_t with_area = 0;
  for (const GlassPiece& piece : glass_pieces(model)) with_area += piece.mesh.triangle_count();
  divide_glass(model);
  ASSERT_EQ(model.parts.size(), 3u);
  EXPECT_EQ(model.triangle_count(), with_area);
  for (const Part& part : model.parts) {
    EXPECT_EQ(part.object, "lamp");
    EXPECT_TRUE(part.is_backdrop);
    EXPECT_LT(part.mesh.bounds().size().x, 1.1f);
  }
  for (const GlassPiece& piece : glass_pieces(model)) EXPECT_EQ(piece.triangles.size(), 1u);
  divide_glass(model);
  EXPECT_EQ(model.parts.size(), 3u) << "what is divided stays as it is";
}

/// A chandelier's pieces are found in a time that grows as their number does.
TEST(GlassPieces, ThousandsOfAPartAreEachTheirOwn) {
  constexpr int drops = 3000;
  Mesh mesh;
  for (int i = 0; i < drops; ++i)
    append(mesh, box(glm::vec3(i % 50, i / 50, 0), glm::vec3(i % 50, i / 50, 0) + 0.5f));
  Model model = *model_of(mesh, glass());
  divide_glass(model);
  ASSERT_EQ(model.parts.size(), std::size_t(drops));
  for (const Part& part : model.parts) {
    EXPECT_EQ(part.mesh.triangle_count(), 12u);
    EXPECT_EQ(part.mesh.positions.size(), 24u);
    EXPECT_LT(part.mesh.bounds().size().x, 0.6f);
  }
}

}  // namespace
}  // namespace parvis::scene
