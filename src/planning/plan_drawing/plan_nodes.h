// The nodes of plans under a place: a drawing, and a picture with a world file.
#pragma once

#include <glm/glm.hpp>

namespace parvis::scene {
class NodeRegistry;
class SceneBuilder;
struct Node;
struct NodeSchema;
}  // namespace parvis::scene

namespace parvis::plan_drawing {

/// Adds `planDrawing`.
void add_drawing_node(scene::NodeRegistry& registry);
/// Adds `planPicture`.
void add_picture_node(scene::NodeRegistry& registry);

/// The attributes that both have: placement, height, visible.
void add_plan_attributes(scene::NodeSchema& schema);

/// World from a plan whose own frame has its origin at `origin` on the map. The first georeferenced thing of
/// a scene gives the scene its origin; a plan that lies near zero stands in the node's own frame.
glm::mat4 world_from_plan(const scene::Node& node, const glm::dvec3& origin, scene::SceneBuilder& builder);

}  // namespace parvis::plan_drawing
