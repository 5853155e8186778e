// The families of node types of this room; each has a file nodes_FAMILY.cpp.
#pragma once

namespace parvis::scene {

class NodeRegistry;

void add_grouping_nodes(NodeRegistry& registry);  ///< include, group
void add_model_nodes(NodeRegistry& registry);     ///< model
void add_material_nodes(NodeRegistry& registry);  ///< material
void add_wheel_nodes(NodeRegistry& registry);     ///< wheels
void add_light_nodes(NodeRegistry& registry);     ///< sun, sky, air, exposure
void add_camera_nodes(NodeRegistry& registry);    ///< camera
void add_scenario_nodes(NodeRegistry& registry);  ///< scenario, override
void add_road_nodes(NodeRegistry& registry);      ///< road, paving, traffic

}  // namespace parvis::scene
