// camera: a named place to look from.
#include <glm/gtc/matrix_transform.hpp>

#include "scene/script/attribute.h"
#include "scene/script/node_registry.h"
#include "scene/script/placement.h"
#include "scene/script/scene_builder.h"
#include "scene/script/script_nodes.h"

namespace parvis::scene {
namespace {

using namespace attribute;

/// The width over height at which fov_deg is the horizontal field of view.
constexpr float nominal_aspect = 16.0f / 9.0f;
/// The range of sight from a hill: as far as terrain_plane goes on around a place.
constexpr float sight_m = 50'000.0f;

NodeSchema camera_schema() {
  return {
      .type = "camera",
      .help =
          "A named place to look from, towards a target or by heading and pitch; or one that stays with a "
          "moving object: it looks at that, or by heading_deg and pitch_deg from it, as a driver does.",
      .attributes =
          {text("name", "what parvis render --camera takes").required(),
           vec3("position", "of the eye").in("m").by_default("0 0 1.6").live(),
           vec3("target", "the point to look at").in("m").replacing({"heading_deg", "pitch_deg"}).live(),
           angle("heading_deg",
                 "compass direction: 0 north, 90 east; with follows: from where the object heads")
               .in("degrees")
               .by_default("0")
               .replacing({"target"})
               .live(),
           angle("pitch_deg", "upward from the horizon")
               .in("degrees")
               .between(-90, 90)
               .by_default("0")
               .replacing({"target"})
               .live(),
           angle("roll_deg", "turn about the line of sight, clockwise as the camera is turned")
               .in("degrees")
               .between(-180, 180)
               .by_default("0")
               .live(),
           angle("fov_deg", "horizontal field of view at 16:9")
               .in("degrees")
               .between(1, 170)
               .by_default("65")
               .live(),
           number("parallel",
                  "a parallel projection, as of a plan: height of what it shows, in place of fov_deg")
               .in("m")
               .between(0.1, 1e6)
               .live(),
           reference("follows", "name of the object to stay with"),
           vec3("offset", "of the eye from the followed object: forward, left, up")
               .in("m")
               .by_default("-7 2.5 1.8")
               .live()},
      .example = "camera(name=\"street\", position=\"12 -4 1.6\", target=\"40 10 4\", fov_deg=60)",
      .messages = {{"look", "the visitor looks from it", {}}}};
}

/// The camera's own turn about its line of sight.
glm::mat4 rolled(const Node& node) {
  return glm::rotate(glm::mat4(1.0f), -node.angle("roll_deg"), glm::vec3(0.0f, 0.0f, 1.0f));
}

glm::mat4 world_from_camera(const Node& node) {
  const glm::vec3 eye = node.vec3("position");
  if (node.gives("target")) {
    const glm::vec3 view = node.vec3("target") - eye;
    const bool is_vertical = glm::length(glm::vec2(view)) < 1e-4f * glm::length(view);
    return look_at(eye, node.vec3("target"),
                   is_vertical ? glm::vec3(0.0f, 1.0f, 0.0f) : glm::vec3(0.0f, 0.0f, 1.0f));
  }
  // A camera looks along its -z: lying flat it looks down, so it is first raised to the horizon.
  return glm::translate(glm::mat4(1.0f), eye) * turned(node.angle("heading_deg")) *
         glm::rotate(glm::mat4(1.0f), glm::half_pi<float>() + node.angle("pitch_deg"),
                     glm::vec3(1.0f, 0.0f, 0.0f));
}

/// The matrix without the scale that groups may have: a camera stays rigid.
glm::mat4 rigid(const glm::mat4& matrix) {
  glm::mat4 result = matrix;
  for (int axis = 0; axis < 3; ++axis) result[axis] = glm::normalize(matrix[axis]);
  return result;
}

/// Reads where a camera that follows stands and looks from the object. Identity: it looks at the object.
void follow(const Node& node, SceneBuilder& builder, NamedCamera& camera) {
  camera.offset_m = node.vec3("offset");
  camera.camera.world_from_camera = glm::mat4(1.0f);
  if (node.gives("heading_deg") || node.gives("pitch_deg"))
    camera.camera.world_from_camera =
        turned(node.angle("heading_deg")) *
        glm::rotate(glm::mat4(1.0f), glm::half_pi<float>() + node.angle("pitch_deg"),
                    glm::vec3(1.0f, 0.0f, 0.0f)) *
        rolled(node);
  for (const char* unused : {"position", "target"})
    if (node.gives(unused))
      builder.warn(
          error_at(node.where_of(unused),
                   "camera \"{}\" follows \"{}\": {}= is not used; offset= says where it stands from "
                   "there, heading_deg= and pitch_deg= where it looks",
                   camera.name, camera.follows, unused));
}

void build_camera(const Node& node, SceneBuilder& builder) {
  if (node.gives("target") && (node.gives("heading_deg") || node.gives("pitch_deg")))
    return builder.fail(error_at(node.where_of("target"),
                                 "a camera takes target= or heading_deg= and pitch_deg=, "
                                 "not both"));
  if (node.gives("target") && glm::length(node.vec3("target") - node.vec3("position")) < 1e-4f)
    return builder.fail(error_at(node.where_of("target"), "the target lies in the eye; move one of them"));
  NamedCamera camera;
  camera.name = node.text("name");
  camera.camera.world_from_camera =
      rigid(builder.world_from_parent() * world_from_camera(node) * rolled(node));
  camera.camera.vertical_fov = vertical_fov(node.angle("fov_deg"), nominal_aspect);
  if (node.gives("parallel")) {
    constexpr float min_distance_m = 10.0f;
    camera.camera.parallel =
        ParallelView{float(node.number("parallel")), std::max(node.vec3("position").z, min_distance_m)};
  }
  camera.camera.far_m = sight_m;
  camera.follows = node.text("follows");
  if (!camera.follows.empty()) follow(node, builder, camera);
  builder.add(std::move(camera));
}

}  // namespace

void add_camera_nodes(NodeRegistry& registry) { registry.add(camera_schema(), build_camera); }

}  // namespace parvis::scene
