// The place as plain data: what the script reader builds, simulation moves, and both the GPU scene and the
// ray tracer read. Rooms that do not know each other meet here.
#pragma once

#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/camera.h"
#include "base/image.h"
#include "base/result.h"
#include "scene/model.h"
#include "scene/road_graph.h"
#include "scene/room_data.h"
#include "scene/traced_scene.h"

namespace parvis::scene {

/// Which of its model's animations an object plays, over and over.
struct PlayedAnimation {
  int animation = no_index;  ///< of Model::animations; no_index: none
  float speed = 1.0f;
  double start_s = 0.0;  ///< how far the animation is when the scene begins
};

/// A placed model. Several objects may share one model: they are drawn together.
struct Object {
  std::string name;
  std::shared_ptr<const Model> model;
  glm::mat4 world_from_model{1.0f};
  std::vector<glm::mat4> pose;    ///< model_from_node of each node; empty: the model's rest pose
  bool is_dynamic = false;        ///< moves: has no part in baked things, throws its own shadow
  bool takes_reflection = false;  ///< its mirror-like parts use the scene's reflection method
  bool is_visible = true;         ///< is drawn, throws shadows, stands in reflections; may change at any time
  PlayedAnimation played = {};    ///< `animate` writes the pose and bends the meshes
  std::vector<Mesh> bent_meshes = {};  ///< of each part: as it is bent now; empty: the model's

  /// Of one of the model's parts, as it is now.
  const Mesh& mesh(std::size_t part) const {
    const bool is_bent = !bent_meshes.empty() && model->parts[part].deformation;
    return is_bent ? bent_meshes[part] : model->parts[part].mesh;
  }
};

struct Sun {
  glm::vec3 direction_to_sun{0.45f, -0.55f, 0.70f};  ///< unit length after loading
  glm::vec3 irradiance{3.0f, 2.75f, 2.35f};          ///< on a plane that faces it, W/m2 in each channel

  bool operator==(const Sun&) const = default;
};

struct Sky {
  ImageF picture;  ///< equirectangular, linear, top row = zenith; x = 0.5 looks north (+y); empty: plain blue
  float intensity = 1.0f;      ///< multiplies the picture
  float heading = 0.0f;        ///< radians, turns the picture about the zenith, clockwise from above
  std::filesystem::path file;  ///< the picture's; empty: it was made in memory
  int version = 0;             ///< of a picture that is computed: counted up whenever it changes
};

struct NamedCamera {
  std::string name;
  Camera camera;
  std::string follows;       ///< name of an object to stay with, or empty
  glm::vec3 offset_m{0.0f};  ///< from the followed object: forward, left, up
};

/// How mirror-like parts of moving objects see their surroundings. Each name is a method; `script_name`
/// spells it.
enum class ReflectionMethod : std::uint8_t {
  none,
  rerendered_cube_map,
  time_sliced_cube_map,
  shared_cube_map,
  box_projected_probe,
  multiple_environment_maps,
  local_environment_maps,
  simple_blend,
  virtual_objects
};
inline constexpr std::array reflection_method_names{"none",
                                                    "rerendered_cube_map",
                                                    "time_sliced_cube_map",
                                                    "shared_cube_map",
                                                    "box_projected_probe",
                                                    "multiple_environment_maps",
                                                    "local_environment_maps",
                                                    "simple_blend",
                                                    "virtual_objects"};

/// What of a method is shown in place of its reflections, to look into it.
enum class ReflectionView : std::uint8_t {
  radiance,  ///< nothing else
  mesh,      ///< of local maps, in red
  weights    ///< of the two reference maps, red and green; blue where neither sees what is mirrored
};
inline constexpr std::array reflection_view_names{"radiance", "mesh", "weights"};

/// How the reflection point of a vertex is searched for.
enum class ReflectionSearch : std::uint8_t { newton, midpoint };
inline constexpr std::array reflection_search_names{"newton", "midpoint"};

struct Reflection {
  ReflectionMethod method = ReflectionMethod::rerendered_cube_map;
  int resolution = 128;              ///< pixels along a face's edge
  bool uses_level_of_detail = true;  ///< resolution by size on screen; far objects share one map
  int most_maps = 240;               ///< reference maps, of the methods that have any
  ReflectionView shown = ReflectionView::radiance;
  float budget_ms = 0.0f;         ///< of a frame, held by choosing levels of detail; 0: none
  int faces_a_frame = 0;          ///< of time-sliced maps, over all reflectors; 0: one for each of them
  float virtual_within_m = 0.0f;  ///< what stands wholly so near to a mirror is drawn as virtual objects
  float virtual_grid = 1.0f;  ///< of a mesh's vertices, the greatest share of corners; 1: each vertex itself
  ReflectionSearch search = ReflectionSearch::newton;
  int iterations = 9;  ///< of the midpoint search
  int bounces = 1;     ///< of the ray tracer and virtual objects: 2, mirrors show what mirrors show

  /// All, or what stands near?
  bool has_virtual_objects() const {
    return method == ReflectionMethod::virtual_objects || virtual_within_m > 0.0f;
  }

  bool operator==(const Reflection&) const = default;
};

/// Where and how reference maps are taken, as far as the script says.
struct ReferenceMapPlan {
  std::vector<glm::vec3> places;  ///< in the world; empty: they place themselves
  int most = 0, resolution = 0;   ///< 0: as Reflection has them
  float cell_m = 1.0f;            ///< of the heights that mirrored rays walk through
  bool is_compressed = false;
};

/// Traffic to be put on the road graph.
struct TrafficDemand {
  int vehicles = 0;
  std::uint64_t seed = 1;
  std::vector<std::shared_ptr<const Model>> models;  ///< x forward, wheels as nodes whose names hold "wheel"
  bool is_visible = true;                            ///< hidden vehicles drive on
  glm::vec2 centre{0.0f};  ///< vehicles keep to the streets within `radius_m` of it, where these lead on
  float radius_m = std::numeric_limits<float>::max();
};

struct Scene {
  std::vector<Object> objects;
  std::vector<NamedCamera> cameras;
  Sun sun;
  Sky sky;
  float exposure = 1.0f;    ///< multiplies radiance before the tone curve
  float haze_per_m = 0.0f;  ///< extinction of the air
  Reflection reflection;
  ReferenceMapPlan reference_maps;
  RoadGraph roads;
  TrafficDemand traffic;
  glm::dvec3 origin{0.0};      ///< georeferenced coordinates of the world's origin, zero where there are none
  std::filesystem::path file;  ///< the script; empty: the scene was made in memory
  /// What rooms draw by themselves, beside the objects; of those rooms that the program has.
  std::vector<TracedKind> traced_kinds;
  RoomDataSet room_data;  ///< `data` finds what a room keeps here

  /// What a room keeps in the scene; reading one that nobody has set gives the type's default.
  template <SceneData T>
  T& data() {
    return room_data.get<T>();
  }
  template <SceneData T>
  const T& data() const {
    return room_data.get<T>();
  }

  const NamedCamera* find_camera(const std::string& name) const;
  /// Where a camera is now: it may stay with an object, which must be there to be seen.
  Result<Camera> camera_now(const NamedCamera& named) const;
  std::size_t static_triangle_count() const;
};

}  // namespace parvis::scene
