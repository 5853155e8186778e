#include <algorithm>
#include <bit>

#include "reflections/probes/methods.h"

namespace parvis::probes {
namespace {

constexpr float shared_below_px = 40.0f;  // smaller reflectors show too little for a map of their own
constexpr float texels_per_pixel =
    0.5f;  // a face spans a quarter turn, of which a body shows a part in half its width
constexpr int min_resolution = 16;

int resolution_for(float size_px, int maximum) {
  const int wanted = int(std::bit_ceil(unsigned(std::max(size_px * texels_per_pixel, 1.0f))));
  return std::clamp(wanted, std::min(min_resolution, maximum), maximum);
}

}  // namespace

methods::CubeMap& RerenderedCubeMap::take(int resolution) {
  if (const auto free = free_.find(resolution); free != free_.end())
    return *used_.insert(free_.extract(free))->second;
  return *used_.emplace(resolution, std::make_unique<methods::CubeMap>(resolution))->second;
}

void RerenderedCubeMap::update_maps(render::Renderer& renderer, const scene::Scene&,
                                    const std::vector<methods::VisibleReflector>& reflectors) {
  free_.merge(used_);
  map_of_object_.clear();
  const methods::CubeMap* shared = nullptr;
  for (const methods::VisibleReflector& reflector : reflectors) {
    const bool is_far = settings_.uses_level_of_detail && reflector.size_px < shared_below_px;
    if (is_far && shared) {
      map_of_object_[reflector.object] = shared;
      continue;
    }
    methods::CubeMap& map =
        take(settings_.uses_level_of_detail ? resolution_for(reflector.size_px, settings_.resolution)
                                            : settings_.resolution);
    draw_whole(map, renderer, reflector);
    map_of_object_[reflector.object] = &map;
    if (is_far) shared = &map;
  }
}

void RerenderedCubeMap::bind(const gl::Program& program, int object) {
  bind_map(program, *map_of_object_.at(object));
}

}  // namespace parvis::probes
