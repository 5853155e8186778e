#include "probes/methods.h"

namespace parvis::probes {
namespace {

constexpr int faces_a_frame = 1;      // for each reflector: a map is whole after six frames
constexpr int forgotten_after = 120;  // frames unseen

}  // namespace

void TimeSlicedCubeMap::update_maps(render::Renderer& renderer,
                                    const std::vector<render::Reflector>& reflectors) {
  for (auto& [object, sliced] : maps_) ++sliced.idle_frames;
  for (const render::Reflector& reflector : reflectors) {
    const auto [place, is_new] = maps_.try_emplace(reflector.object, render::CubeMap(settings_.resolution));
    Sliced& sliced = place->second;
    sliced.idle_frames = 0;
    if (is_new) {  // a map with empty faces would be black
      draw_whole(sliced.map, renderer, reflector.centre, reflector.object);
      continue;
    }
    for (int i = 0; i < faces_a_frame; ++i) {
      sliced.map.draw_face(renderer, sliced.next_face, reflector.centre, reflector.object);
      sliced.next_face = (sliced.next_face + 1) % 6;
      ++faces_drawn_;
    }
    sliced.map.update_levels();
  }
  std::erase_if(maps_, [](const auto& entry) { return entry.second.idle_frames > forgotten_after; });
}

void TimeSlicedCubeMap::bind(const gl::Program& program, int object) {
  bind_map(program, maps_.at(object).map);
}

}  // namespace parvis::probes
