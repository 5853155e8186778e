// A scene as plain data: built by the script reader, changed by simulation, read by the GPU scene and the ray
// tracer. Rooms that do not know each other exchange data here.
#pragma once

#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "base/camera.h"
#include "base/image.h"
#include "base/result.h"
#include "scene/data/model.h"
#include "scene/data/road_graph.h"
#include "scene/data/room_data.h"
#include "scene/data/traced_scene.h"

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
  bool is_dynamic = false;        ///< excluded from baked data; its shadow is re-rendered every frame
  bool takes_reflection = false;  ///< its mirror-like parts use the scene's reflection method
  bool is_visible = true;         ///< rendered, casts shadows, appears in reflections; may change at any time
  PlayedAnimation played = {};    ///< `animate` computes the pose and the deformed meshes
  std::vector<Mesh> deformed_meshes = {};  ///< deformed mesh of each part; empty: the model's meshes
  /// Materials in place of the model's, one for each of them: the same car in another paint. They share the
  /// model's meshes and textures, are as opaque, as two-sided and as mirror-like as those that they stand in
  /// for, and refract as these do. Null: the model's.
  std::shared_ptr<const std::vector<Material>> paint = nullptr;

  /// The present mesh of one of the model's parts: deformed, or the model's.
  const Mesh& mesh(std::size_t part) const {
    const bool is_deformed = !deformed_meshes.empty() && model->parts[part].deformation;
    return is_deformed ? deformed_meshes[part] : model->parts[part].mesh;
  }
  /// The materials of the model's parts: painted, or the model's.
  const std::vector<Material>& materials() const { return paint ? *paint : model->materials; }
};

/// The sun as a directional light.
struct Sun {
  glm::vec3 direction_to_sun{0.45f, -0.55f, 0.70f};  ///< unit length after loading
  glm::vec3 irradiance{3.0f, 2.75f, 2.35f};          ///< on a plane that faces it, W/m2 in each channel

  bool operator==(const Sun&) const = default;
};

/// The sky as an environment map.
struct Sky {
  ImageF picture;  ///< equirectangular, linear, top row = zenith; x = 0.5 looks north (+y); empty: plain blue
  float intensity = 1.0f;      ///< multiplies the picture
  float heading = 0.0f;        ///< radians, turns the picture about the zenith, clockwise from above
  std::filesystem::path file;  ///< the picture's; empty: it was made in memory
  int version = 0;             ///< of a computed picture: incremented whenever it changes
};

/// A camera of the scene, which may follow an object.
struct NamedCamera {
  std::string name;
  Camera camera;
  std::string follows;       ///< name of an object to stay with, or empty
  glm::vec3 offset_m{0.0f};  ///< from the followed object: forward, left, up
};

/// Everything that is rendered and simulated; a plain value that can be copied.
struct Scene {
  std::vector<Object> objects;
  std::vector<NamedCamera> cameras;
  Sun sun;
  Sky sky;
  float exposure = 1.0f;    ///< multiplies radiance before the tone curve
  float haze_per_m = 0.0f;  ///< extinction of the air
  RoadGraph roads;
  glm::dvec3 origin{0.0};  ///< georeferenced coordinates of the world's origin, zero where there are none
  std::string map;         ///< whose coordinates these are, as Model::map; empty: unknown
  double true_north_deg = 0.0;  ///< at the origin, clockwise from the y axis
  std::filesystem::path file;   ///< the script; empty: the scene was made in memory
  /// Kinds of things that rooms render themselves, beside the objects: those that the program has registered.
  std::vector<TracedKind> traced_kinds;
  RoomDataSet room_data;  ///< `data` finds what a room keeps here

  /// The data of type T that a room keeps in the scene, for changing.
  template <SceneData T>
  T& data() {
    return room_data.get<T>();
  }
  /// The same for reading; the type's default if it was not set.
  template <SceneData T>
  const T& data() const {
    return room_data.get<T>();
  }

  /// The items of type T in the order of the nodes that made them; `SceneBuilder::add` adds to them.
  template <SceneItem T>
  const std::vector<T>& items() const {
    return data<ItemsOf<T>>().items;
  }

  const NamedCamera* find_camera(const std::string& name) const;  ///< null if there is none
  /// The present camera: one that follows an object moves with it. Fails if no visible object has that name.
  Result<Camera> camera_now(const NamedCamera& named) const;
  std::size_t static_triangle_count() const;  ///< objects that are not dynamic
};

}  // namespace parvis::scene
