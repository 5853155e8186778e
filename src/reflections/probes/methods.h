// Baseline reflection methods: cube maps that differ in where and when they are rendered. room.cpp gives them
// their names in scripts.
#pragma once

#include <deque>
#include <map>
#include <optional>

#include "graphics/gl/uniform_block.h"
#include "graphics/shading/glsl.h"
#include "reflections/methods/bindings.h"
#include "reflections/methods/light_jump.h"
#include "reflections/methods/settings.h"
#include "reflections/probes/cube_map_reflections.h"

namespace parvis::probes {

namespace boxes_shared {
using namespace parvis::shading;
#include "reflections/probes/probe_boxes_block.glsl"
}  // namespace boxes_shared

/// Settings of time_sliced_cube_map.
struct TimeSlicing {
  static constexpr std::string_view name = "probes.time_slicing";
  static constexpr scene::DataRole role = scene::DataRole::settings;

  int faces_per_frame = 0;  ///< over all reflectors; 0: one per reflector

  /// Adds `faces_per_frame`; see SceneData.
  void hash(ContentHash& hash) const { hash.add(faces_per_frame); }
};

/// The paper's "no reflection": lighting alone.
class NoReflection final : public methods::Reflections {
 public:
  explicit NoReflection(const scene::Scene&) {}
  render::SurfaceSource source() const override {
    return {.fragment = "reflections/probes/no_reflection.frag"};
  }
  void bind(const gl::Program&, int) override {}

 private:
  void update_maps(render::Renderer&, const scene::Scene&,
                   const std::vector<methods::VisibleReflector>&) override {}
};

/// One cube map per reflector, re-rendered every frame. With level of detail its resolution follows the
/// reflector's size in the image, and distant reflectors share one map.
class RerenderedCubeMap final : public CubeMapReflections {
 public:
  /// Reads the common settings of reflection methods. Without a filter: for mirrors that are all smooth.
  explicit RerenderedCubeMap(const scene::Scene& scene, std::optional<methods::LobeFilter> filter = {})
      : CubeMapReflections(std::move(filter)), settings_(methods::settings(scene)) {}
  void bind(const gl::Program& program, int object) override;
  const methods::CubeMap* surroundings_of(int object) const override { return map_of_object_.at(object); }

 private:
  void update_maps(render::Renderer& renderer, const scene::Scene& scene,
                   const std::vector<methods::VisibleReflector>& reflectors) override;
  methods::CubeMap& take(int resolution);

  methods::Settings settings_;
  std::multimap<int, std::unique_ptr<methods::CubeMap>> free_, used_;  ///< by resolution
  std::map<int, const methods::CubeMap*> map_of_object_;
};

/// One cube map per reflector, of which one face is re-rendered per frame; or as many faces per frame in all
/// as the script sets, the oldest first.
class TimeSlicedCubeMap final : public CubeMapReflections {
 public:
  TimeSlicedCubeMap(const scene::Scene& scene, methods::LobeFilter filter)
      : CubeMapReflections(std::move(filter)),
        resolution_(methods::settings(scene).resolution),
        slicing_(methods::own_settings<TimeSlicing>(scene)) {}
  void bind(const gl::Program& program, int object) override;
  const methods::CubeMap* surroundings_of(int object) const override { return &maps_.at(object).map; }

 private:
  struct Sliced {
    methods::CubeMap map;
    int next_face = 0;
    int idle_frames = 0;
    std::int64_t drawn_at = 0;  ///< of its latest face, counted in faces
  };
  void update_maps(render::Renderer& renderer, const scene::Scene& scene,
                   const std::vector<methods::VisibleReflector>& reflectors) override;
  void draw_next_face(render::Renderer& renderer, const methods::VisibleReflector& reflector);

  int resolution_;
  TimeSlicing slicing_;
  methods::LightJump light_jump_;
  std::map<int, Sliced> maps_;  ///< by object
  std::int64_t faces_so_far_ = 0;
  std::vector<methods::VisibleReflector> waiting_;  ///< reflectors whose maps were there before this frame
};

/// One cube map for all reflectors, re-rendered every frame around the one that is largest in the image.
class SharedCubeMap final : public CubeMapReflections {
 public:
  /// Allocates a map of the resolution that the scene sets.
  SharedCubeMap(const scene::Scene& scene, methods::LobeFilter filter)
      : CubeMapReflections(std::move(filter)), map_(methods::settings(scene).resolution) {}
  void bind(const gl::Program& program, int) override { bind_map(program, map_); }
  const methods::CubeMap* surroundings_of(int) const override { return &map_; }

 private:
  void update_maps(render::Renderer& renderer, const scene::Scene& scene,
                   const std::vector<methods::VisibleReflector>& reflectors) override;

  methods::CubeMap map_;
};

/// Cube maps at fixed places along the roads, rendered once without dynamic objects; lookups are corrected by
/// a box fitted to the street around each. A body shows the two nearest, blended by distance.
class BoxProjectedProbe final : public CubeMapReflections {
 public:
  BoxProjectedProbe(const scene::Scene& scene, methods::LobeFilter filter);
  render::SurfaceSource source() const override {
    render::SurfaceSource surface = CubeMapReflections::source();
    surface.defines.emplace_back("BLENDS_BOXES", "1");
    return surface;
  }
  void bind(const gl::Program& program, int object) override;
  const methods::CubeMap* surroundings_of(int object) const override {
    const Probe& probe = *probes_of_object_.at(object).nearest;
    return probe.map ? &*probe.map : nullptr;
  }

 private:
  struct Probe {
    glm::vec3 position;
    glm::vec2 heading;  ///< cosine and sine of the street's direction
    std::optional<methods::CubeMap> map;
    glm::vec3 box_centre{0.0f}, box_half_size{0.0f};
    int idle_frames = 0;
  };
  /// The probes that a body shows.
  struct ProbePair {
    Probe *nearest, *second;  ///< the same where there is only one
    float second_share;       ///< of the second
  };
  void update_maps(render::Renderer& renderer, const scene::Scene& scene,
                   const std::vector<methods::VisibleReflector>& reflectors) override;
  void forget_surroundings() override;
  ProbePair probes_about(glm::vec3 place);
  void bake(Probe& probe, render::Renderer& renderer);

  int resolution_;
  std::deque<Probe> probes_;  ///< places stay when one is added
  std::map<int, ProbePair> probes_of_object_;
  gl::UniformBlock<boxes_shared::ProbeBoxes> boxes_{"ProbeBoxes", methods::first_method_block};
};

}  // namespace parvis::probes
