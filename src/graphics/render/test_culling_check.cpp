#include "graphics/render/test_culling_check.h"

#include <algorithm>

#include "graphics/render/frustum.h"

namespace parvis::render {

CullingCheck check_culling(Renderer& renderer, const scene::Scene& scene, const Camera& camera, int width,
                           int height) {
  std::vector<std::uint8_t> is_seen(scene.objects.size() + 1, 0);
  for (const std::uint32_t object_and_one : renderer.pick(camera, width, height, false).pixels)
    if (object_and_one < is_seen.size()) is_seen[object_and_one] = 1;  // else a room's own
  renderer.prepare_main_view(camera, width, height);
  const std::vector<int>& drawn = renderer.visible_objects();

  const View view = camera_view(camera, 0, width, height);
  const Frustum frustum(view.clip_from_world);
  CullingCheck check;
  for (std::size_t o = 0; o < scene.objects.size(); ++o) {
    if (!scene.objects[o].is_dynamic || !frustum.may_see(renderer.gpu().object_bounds()[o])) continue;
    const bool is_drawn = std::binary_search(drawn.begin(), drawn.end(), int(o));
    if (is_seen[o + 1]) {
      check.false_culls += !is_drawn;
    } else {
      ++check.hidden;
      check.hidden_culled += !is_drawn;
    }
  }
  return check;
}

}  // namespace parvis::render
