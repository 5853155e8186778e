#include "formats/gltf/gltf_packing.h"

#include <gtest/gtest.h>

#include "base/test_folder.h"
#include "formats/gltf/gltf_reader.h"
#include "formats/gltf/gltf_writer.h"
#include "scene/data/test_scene.h"

namespace parvis::scene {
namespace {

/// A box whose texture is 64 x 32 pixels, half of them see-through.
Model textured_box() {
  Model model =
      *model_of(box({-300.0f, -2.0f, 0.0f}, {-290.0f, 2.0f, 12.0f}), matt(glm::vec3(0.7f, 0.3f, 0.2f)));
  Texture texture;
  texture.name = "wall";
  texture.image = Image8(64, 32, 4, 200);
  for (int x = 0; x < 32; ++x)
    for (int y = 0; y < 32; ++y) texture.image.at(x, y)[3] = 0;
  model.textures.push_back(texture);
  model.materials.front().base_colour_texture = 0;
  model.parts.front().mesh.colours.assign(model.parts.front().mesh.positions.size(),
                                          glm::vec4(0.25f, 0.5f, 1.0f, 0.75f));
  return model;
}

TEST(GltfPacking, IsReadAsItWasButForItsPrecision) {
  Object object;
  object.name = "house";
  object.model = std::make_shared<const Model>(textured_box());
  object.world_from_model = glm::translate(glm::mat4(1.0f), glm::vec3(5.0f, 0.0f, 0.0f));
  const Object* const objects[] = {&object, &object};
  const Result<PackedGltf> packed = packed_gltf(objects, 16, 64);
  ASSERT_TRUE(packed) << to_string(packed.errors());
  ASSERT_EQ(packed->sharper.size(), 1u);
  EXPECT_EQ(packed->sharper.front().first, 0);
  EXPECT_EQ(packed->sharper.front().second.substr(0, 4), "RIFF");

  const TestFolder folder;
  folder.write("place.glb", packed->glb);
  Errors warnings;
  const Result<Model> read = read_gltf(folder.path() / "place.glb", warnings);
  ASSERT_TRUE(read) << to_string(read.errors());
  EXPECT_TRUE(warnings.empty()) << to_string(warnings);
  ASSERT_EQ(read->parts.size(), 2u);
  EXPECT_EQ(read->triangle_count(), 2 * object.model->triangle_count());
  const Bounds before = object.model->parts.front().mesh.bounds(), after = read->parts.front().mesh.bounds();
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(after.min[axis], before.min[axis], 1e-3f);
    EXPECT_NEAR(after.max[axis], before.max[axis], 1e-3f);
  }
  for (const glm::vec3& normal : read->parts.front().mesh.normals)
    EXPECT_NEAR(glm::length(normal), 1.0f, 0.01f);
  for (const glm::vec4& colour : read->parts.front().mesh.colours) EXPECT_NEAR(colour.w, 0.75f, 1e-4f);
  ASSERT_EQ(read->textures.size(), 1u);
  EXPECT_EQ(read->textures.front().image.width, 16);
}

}  // namespace
}  // namespace parvis::scene
