// The methods themselves, each named as scripts name it.
#pragma once

#include <deque>
#include <map>
#include <optional>

#include "reflections/probes/reflections.h"

namespace parvis::probes {

/// The paper's "no reflection": shading by the lights alone.
class NoReflection final : public render::Reflections {
 public:
  std::string fragment_shader() const override { return "reflections/probes/no_reflection.frag"; }
  void bind(const gl::Program&, int) override {}

 private:
  void update_maps(render::Renderer&, const scene::Scene&, const std::vector<render::Reflector>&) override {}
};

/// A map for each reflector, drawn anew every frame. With level of detail its resolution follows the
/// reflector's size on the screen, and those that are far share one map.
class RerenderedCubeMap final : public CubeMapReflections {
 public:
  explicit RerenderedCubeMap(const scene::Reflection& reflection) : settings_(reflection) {}
  void bind(const gl::Program& program, int object) override;
  const render::CubeMap* surroundings_of(int object) const override { return map_of_object_.at(object); }

 private:
  void update_maps(render::Renderer& renderer, const scene::Scene& scene,
                   const std::vector<render::Reflector>& reflectors) override;
  render::CubeMap& take(int resolution);

  scene::Reflection settings_;
  std::multimap<int, std::unique_ptr<render::CubeMap>> free_, used_;  ///< by resolution
  std::map<int, const render::CubeMap*> map_of_object_;
};

/// A map for each reflector, of which a face is drawn a frame; or so many faces a frame in all as the script
/// says, those first that have waited longest.
class TimeSlicedCubeMap final : public CubeMapReflections {
 public:
  explicit TimeSlicedCubeMap(const scene::Reflection& reflection) : settings_(reflection) {}
  void bind(const gl::Program& program, int object) override;
  const render::CubeMap* surroundings_of(int object) const override { return &maps_.at(object).map; }

 private:
  struct Sliced {
    render::CubeMap map;
    int next_face = 0;
    int idle_frames = 0;
    std::int64_t drawn_at = 0;  ///< of its latest face, counted in faces
  };
  void update_maps(render::Renderer& renderer, const scene::Scene& scene,
                   const std::vector<render::Reflector>& reflectors) override;
  void draw_next_face(render::Renderer& renderer, const render::Reflector& reflector);

  scene::Reflection settings_;
  std::map<int, Sliced> maps_;  ///< by object
  std::int64_t faces_so_far_ = 0;
  std::vector<render::Reflector> waiting_;  ///< reflectors whose maps were there before this frame
};

/// One map for all reflectors, drawn every frame about the one that is largest on the screen.
class SharedCubeMap final : public CubeMapReflections {
 public:
  explicit SharedCubeMap(const scene::Reflection& reflection) : map_(reflection.resolution) {}
  void bind(const gl::Program& program, int) override { bind_map(program, map_); }
  const render::CubeMap* surroundings_of(int) const override { return &map_; }

 private:
  void update_maps(render::Renderer& renderer, const scene::Scene& scene,
                   const std::vector<render::Reflector>& reflectors) override;

  render::CubeMap map_;
};

/// Maps at fixed places along the roads, drawn once without what moves, each looked up as the inside of a box
/// fitted to the street around it.
class BoxProjectedProbe final : public CubeMapReflections {
 public:
  explicit BoxProjectedProbe(const scene::Scene& scene);
  void bind(const gl::Program& program, int object) override;
  const render::CubeMap* surroundings_of(int object) const override {
    const Probe& probe = *probe_of_object_.at(object);
    return probe.map ? &*probe.map : nullptr;
  }

 private:
  struct Probe {
    glm::vec3 position;
    glm::vec2 heading;  ///< cosine and sine of the street's direction
    std::optional<render::CubeMap> map;
    glm::vec3 box_centre{0.0f}, box_half_size{0.0f};
    int idle_frames = 0;
  };
  void update_maps(render::Renderer& renderer, const scene::Scene& scene,
                   const std::vector<render::Reflector>& reflectors) override;
  void forget_surroundings() override;
  void bake(Probe& probe, render::Renderer& renderer);

  int resolution_;
  std::deque<Probe> probes_;  ///< places stay when one is added
  std::map<int, const Probe*> probe_of_object_;
};

}  // namespace parvis::probes
