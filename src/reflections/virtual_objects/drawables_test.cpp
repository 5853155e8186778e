// What a room draws by itself, in curved mirrors, and its picture against what rays see of it.
#include <gtest/gtest.h>

#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/render/test_quads.h"
#include "reflections/reflector_maps/test_boxes.h"
#include "reflections/virtual_objects/virtual_objects.h"

namespace parvis::virtual_objects {
using namespace reflection_search;
using namespace reflector_maps;
namespace {

const glm::vec3 viewer{2.4f, -5.2f, 2.6f}, looked_at{0, 0, 1};

/// A ball among boxes, with a moving quad at its left and a static one before it, aslant over the floor.
class DrawablesTest : public gl::ContextTest {
 protected:
  DrawablesTest() {
    const auto quad = [](glm::vec3 centre, float turn, float tilt) {
      return glm::scale(glm::rotate(glm::rotate(placed(centre), turn, {0, 0, 1}), tilt, {1, 0, 0}),
                        glm::vec3(0.7f));
    };
    quads_ = {{quad({-1.6f, -2.4f, 1.4f}, 0.9f, 1.4f), true, true},
              {quad({1.0f, -2.6f, 0.8f}, 0.2f, 0.6f), false, true}};
    drawables_.add(render::test_quads_kind(quads_));
    drawables_.attach(scene_);
  }
  Compared draw(const render::Drawables& drawables) const {
    return draw_by(
        scene_, viewer, looked_at,
        [](const scene::Scene& shown, render::Renderer& renderer) {
          return make_virtual_objects(shown, renderer);
        },
        drawables);
  }

  render::TestQuads quads_;
  render::Drawables drawables_;
  scene::Scene scene_ = among_boxes(scene::sphere(glm::vec3(0.0f), 1.0f, 64),
                                    render::mirror_box(1.0f)->materials.front(), placed({0, 0, 1.1f}));
};

/// The shadows on the floor, the holes in them, the mirror image and the quads themselves.
TEST_F(DrawablesTest, PicturesAndMirrorImagesAreWhatRaysSee) {
  const Compared pictures = draw(drawables_);
  EXPECT_LT(pictures.flip(), 0.04) << "in the mirror";
  const Result<reference::Difference> whole = reference::compare(pictures.ours, pictures.traced, Image8());
  ASSERT_TRUE(whole) << to_string(whole.errors());
  EXPECT_LT(whole->flip, 0.03);

  // The control: without the quads both pictures are others, in the mirror, too.
  scene_.traced_kinds.clear();
  const Compared without = draw({});
  const Result<reference::Difference> missing =
      reference::compare(without.ours, pictures.traced, pictures.mirrors);
  ASSERT_TRUE(missing) << to_string(missing.errors());
  EXPECT_GT(missing->flip, 2.0 * pictures.flip());
}

TEST_F(DrawablesTest, PickingAndRaysGiveTheSameNumbers) {
  Camera camera;
  camera.world_from_camera = look_at(viewer, looked_at);
  Result<std::unique_ptr<render::Renderer>> renderer =
      render::Renderer::create(scene_, drawables_, light::sun_and_sky);
  ASSERT_TRUE(renderer) << to_string(renderer.errors());
  (*renderer)->begin_frame(scene_, camera);
  const render::ObjectPicture picked = (*renderer)->pick(camera, width, height, true);
  const reference::ObjectPicture traced =
      reference::trace_objects(reference::RayScene(scene_), camera, width, height);
  int differing = 0, of_quads = 0;
  for (std::size_t i = 0; i < picked.pixels.size(); ++i) {
    differing += picked.pixels[i] != traced.pixels[i];
    of_quads += traced.pixels[i] > scene_.objects.size();
  }
  EXPECT_GT(of_quads, 4000);
  EXPECT_LT(differing, 40) << "of " << picked.pixels.size();
}

}  // namespace
}  // namespace parvis::virtual_objects
