#include "reflections/probes/methods.h"

namespace parvis::probes {

void SharedCubeMap::update_maps(render::Renderer& renderer, const scene::Scene&,
                                const std::vector<methods::VisibleReflector>& reflectors) {
  if (!reflectors.empty()) draw_whole(map_, renderer, reflectors.front());
}

}  // namespace parvis::probes
