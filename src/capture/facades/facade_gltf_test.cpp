#include "capture/facades/facade_gltf.h"

#include <gtest/gtest.h>

#include "base/files.h"
#include "capture/facades/baked_texture.h"
#include "capture/facades/coarse_model_file.h"
#include "capture/facades/test_street.h"
#include "formats/gltf/gltf_reader.h"
#include "formats/gltf/test_validator.h"

namespace parvis::facades {
namespace {
namespace fs = std::filesystem;

PackedFacade packed_street() {
  const Photos input;
  const Result<PlaceLayers> place = place_layers(input.photos, street());
  EXPECT_TRUE(place);
  return packed_facade(*place);
}

TEST(BakedTexture, EachPointHasItsColour) {
  const PackedFacade facade = packed_street();
  const BakedTexture baked = baked_texture(facade, 512);
  EXPECT_LE(baked.picture.width, 512);
  ASSERT_EQ(baked.uvs.size(), facade.corners.size());
  const glm::vec2 size(float(baked.picture.width), float(baked.picture.height));
  std::size_t compared = 0;
  for (std::size_t t = 0; t < facade.triangle_count(); ++t) {
    if (facade.surfaces[facade.surface_of_triangle[t]] != "near") continue;
    for (const glm::vec3 b :
         {glm::vec3(1, 1, 1) / 3.0f, glm::vec3(0.6f, 0.2f, 0.2f), glm::vec3(0.2f, 0.2f, 0.6f)}) {
      glm::vec3 point(0.0f);
      glm::vec2 uv(0.0f);
      for (std::size_t k = 0; k < 3; ++k)
        point += b[int(k)] * facade.corners[3 * t + k], uv += b[int(k)] * baked.uvs[3 * t + k];
      const std::uint8_t* p = baked.picture.at(int(uv.x * size.x), int(uv.y * size.y));
      const glm::vec3 truth = pattern(glm::dvec3(point));
      for (int c = 0; c < 3; ++c) {
        const float expected = 255.0f * srgb_from_linear(truth[c]);
        EXPECT_NEAR(float(p[c]), expected, 16.0f) << t << " " << c << ": balanced over four exposures";
        ++compared;
      }
    }
  }
  EXPECT_EQ(compared, 18u);
}

TEST(BakedTexture, ItFitsIntoTheSideThatIsGiven) {
  const PackedFacade facade = packed_street();
  const BakedTexture fine = baked_texture(facade, 1024), coarse = baked_texture(facade, 128);
  EXPECT_LE(coarse.picture.width, 128);
  EXPECT_GT(fine.picture.width, coarse.picture.width);
  for (const glm::vec2& uv : coarse.uvs) EXPECT_TRUE(uv.x >= 0 && uv.y >= 0 && uv.x <= 1 && uv.y <= 1);
}

TEST(FacadeGltf, OtherProgramsSeeATextureAndWeTheLayers) {
  const PackedFacade facade = packed_street();
  const TestFolder folder;
  const fs::path file = folder.path() / "street.glb";
  const Status status = write_facade_gltf(file, facade, 512);
  ASSERT_TRUE(status) << to_string(status.errors());

  Errors warnings;
  const Result<scene::Model> model = scene::read_gltf(file, warnings);
  ASSERT_TRUE(model) << to_string(model.errors());
  EXPECT_EQ(model->triangle_count(), facade.triangle_count());
  ASSERT_EQ(model->textures.size(), 1u);
  EXPECT_EQ(model->materials.at(std::size_t(model->parts[0].material)).emission_texture, 0);

  const Result<PackedFacade> back = read_facade_gltf(file);
  ASSERT_TRUE(back) << to_string(back.errors());
  EXPECT_EQ(back->blocks, facade.blocks);
  EXPECT_EQ(back->tiles, facade.tiles);
  EXPECT_EQ(back->depths, facade.depths);
  EXPECT_EQ(back->corners, facade.corners);
  EXPECT_EQ(back->lists, facade.lists);
  EXPECT_EQ(back->surfaces, facade.surfaces);
  ASSERT_EQ(back->photos.size(), facade.photos.size());
  EXPECT_EQ(back->photos[2].view.camera_from_world, facade.photos[2].view.camera_from_world);
  EXPECT_EQ(back->photos[2].view.fx, facade.photos[2].view.fx);
  EXPECT_EQ(back->photos[3].balance.scale, facade.photos[3].balance.scale);

  scene::expect_valid_gltf(folder.path());
}

TEST(FacadeGltf, TheBackdropIsMarkedForThoseWhoSeeTheModel) {
  PackedFacade facade = packed_street();
  for (std::string& surface : facade.surfaces)
    if (surface == "far") surface = backdrop_name;
  const TestFolder folder;
  const fs::path file = folder.path() / "street.glb";
  ASSERT_TRUE(write_facade_gltf(file, facade, 512));
  Errors warnings;
  const Result<scene::Model> model = scene::read_gltf(file, warnings);
  ASSERT_TRUE(model) << to_string(model.errors());
  std::size_t backdrops = 0;
  for (const scene::Part& part : model->parts) {
    EXPECT_EQ(part.is_backdrop, part.object == backdrop_name) << part.object;
    EXPECT_EQ(part.casts_shadow, !part.is_backdrop) << part.object;
    backdrops += part.is_backdrop ? 1 : 0;
  }
  EXPECT_EQ(backdrops, 1u);
}

TEST(FacadeGltf, WhatIsNoFacadeIsRefused) {
  PackedFacade facade = packed_street();
  const TestFolder folder;
  const fs::path file = folder.path() / "street.glb";
  ASSERT_TRUE(write_meshes(file, street()));
  EXPECT_NE(to_string(read_facade_gltf(file).errors()).find("PARVIS_layered_photographs"), std::string::npos);
  ASSERT_TRUE(write_facade_gltf(file, facade, 64));
  ASSERT_TRUE(read_facade_gltf(file));
  std::string bytes = *read_file(file);
  // The first candidate becomes a layer that is not there.
  const std::string first(reinterpret_cast<const char*>(facade.candidates.data()),
                          facade.candidates.size() * sizeof(std::uint32_t));
  bytes[bytes.find(first) + 2] = '\x7f';
  ASSERT_TRUE(write_file(file, bytes));
  EXPECT_NE(to_string(read_facade_gltf(file).errors()).find("a layer that is not there"), std::string::npos);
  facade.candidates[0] = 999999;
  EXPECT_FALSE(write_facade_gltf(file, facade, 64));
  EXPECT_EQ(*read_file(file), bytes) << "what was there stays";
  fs::resize_file(file, fs::file_size(file) / 2);
  EXPECT_FALSE(read_facade_gltf(file));
}

}  // namespace
}  // namespace parvis::facades
