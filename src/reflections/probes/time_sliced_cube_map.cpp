#include <algorithm>
#include <utility>

#include "reflections/probes/methods.h"

namespace parvis::probes {
namespace {

constexpr int cube_forgotten_after = 120;  // frames unseen

}  // namespace

void TimeSlicedCubeMap::draw_next_face(render::Renderer& renderer,
                                       const methods::VisibleReflector& reflector) {
  Sliced& sliced = maps_.at(reflector.object);
  sliced.map.draw_face(renderer, sliced.next_face, reflector.centre, reflector.object, render::Subjects::all,
                       reflector.shown);
  sliced.next_face = (sliced.next_face + 1) % 6;
  sliced.drawn_at = ++faces_so_far_;
  ++faces_drawn_;
}

void TimeSlicedCubeMap::update_maps(render::Renderer& renderer, const scene::Scene& scene,
                                    const std::vector<methods::VisibleReflector>& reflectors) {
  if (light_jump_.has_come(renderer, scene)) maps_.clear();
  for (auto& [object, sliced] : maps_) ++sliced.idle_frames;
  waiting_.clear();
  for (const methods::VisibleReflector& reflector : reflectors) {
    const auto [place, is_new] = maps_.try_emplace(reflector.object, methods::CubeMap(resolution_));
    place->second.idle_frames = 0;
    if (is_new)  // a map with empty faces would be black
      draw_whole(place->second.map, renderer, reflector);
    else
      waiting_.push_back(reflector);
  }
  if (!waiting_.empty()) {
    std::ranges::sort(waiting_, {}, [&](const methods::VisibleReflector& reflector) {
      return std::pair(maps_.at(reflector.object).drawn_at, reflector.object);
    });
    const std::size_t faces = slicing_.faces_per_frame > 0
                                  ? std::min(std::size_t(slicing_.faces_per_frame), 6 * waiting_.size())
                                  : waiting_.size();
    for (std::size_t i = 0; i < faces; ++i) draw_next_face(renderer, waiting_[i % waiting_.size()]);
    for (std::size_t i = 0; i < std::min(faces, waiting_.size()); ++i)
      update_levels(maps_.at(waiting_[i].object).map);
  }
  std::erase_if(maps_, [](const auto& entry) { return entry.second.idle_frames > cube_forgotten_after; });
}

void TimeSlicedCubeMap::bind(const gl::Program& program, int object) {
  bind_map(program, maps_.at(object).map);
}

}  // namespace parvis::probes
