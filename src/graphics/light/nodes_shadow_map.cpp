#include "graphics/light/nodes_shadow_map.h"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "graphics/light/shadow_settings.h"
#include "scene/script/attribute.h"
#include "scene/script/live_scene.h"
#include "scene/script/scene_builder.h"

namespace parvis::light {
namespace {

constexpr const char* no_shadows = "none";  // the method of those who compare with a place that has shadows

std::vector<std::string> method_names() {
  std::vector<std::string> names(shadow_technique_names.begin(), shadow_technique_names.end());
  names.emplace_back(no_shadows);
  return names;
}

/// The node's casters and receivers until all nodes are built.
struct ShadowGroups {
  static constexpr std::string_view name = "light.shadow_groups";
  static constexpr scene::DataRole role = scene::DataRole::settings;

  std::vector<std::pair<std::string, FileLocation>> casters, receivers;

  void hash(ContentHash& hash) const {
    for (const auto* groups : {&casters, &receivers})
      for (const auto& [group, where] : *groups) hash.add_text(group);
  }
};

scene::NodeSchema shadow_map_schema() {
  using namespace scene::attribute;
  return {
      .type = "shadowMap",
      .help =
          "How the shadows of the sun are found, and a lamp in the sun's place. A scene without this node "
          "has "
          "cached_cascades.",
      .attributes =
          {choice("method",
                  "cached_cascades: two maps about the viewer, kept from frame to frame; cascades: four, "
                  "fitted to the view; perspective: the thesis's; light_space_perspective: its successor; "
                  "rays: exact, with the sun's disc where nothing has moved; none: the sun shines through "
                  "everything",
                  method_names())
               .by_default(shadow_technique_names[0])
               .live(),
           reference(
               "casters",
               "these, and what is in these groups, alone cast shadows, beside vehicles of traffic; without "
               "it all do",
               {"group", "model", "object", "plant", "tree", "facade", "vdobject"})
               .repeatable()
               .kept(),
           reference("receivers",
                     "of models and objects, these and those of these groups alone receive them; without it "
                     "all do. What photographs show has shadow_strength for that",
                     {"group", "model", "object"})
               .repeatable()
               .kept(),
           flag("updateNear",
                "fitted maps begin at the nearest surface in view, not at the camera's near plane")
               .by_default("1")
               .live(),
           integer("sun_samples",
                   "of method rays: directions to the sun's disc for each pixel of a still picture")
               .between(1, max_sun_samples)
               .by_default("16")
               .live(),
           flag("spot", "a spot light at lightPosition stands in the sun's place, as bright at any distance")
               .by_default("0")
               .live(),
           vec3("lightPosition", "of the spot light")
               .in("m")
               .by_default("0 0 10")
               .spelled({"lightposition"})
               .live(),
           vec3(
               "lightDirection",
               "in which the light shines, of any length; without it the sun's, and of a spot light downward")
               .spelled({"lightdirection"})
               .live(),
           number("lightAngle", "opening of the spot light's cone")
               .in("degrees")
               .between(0.1, 170.0)
               .by_default("45")
               .spelled({"lightangle"})
               .live()},
      .example =
          "shadowMap(method=\"light_space_perspective\")\n"
          "timer(period_s=10, onTime=\"5, %shadowMap, lightAngle 30\")",
      .is_unique = true,
      .is_implied = true};
}

void build_shadow_map(const scene::Node& node, scene::SceneBuilder& builder) {
  ShadowSettings& settings = builder.scene.data<ShadowSettings>();
  for (std::size_t i = 0; i < shadow_technique_names.size(); ++i)
    if (node.text("method") == shadow_technique_names[i]) settings.technique = ShadowTechnique(i);
  if (node.text("method") == no_shadows) settings.technique = ShadowTechnique::none;
  settings.updates_near = node.flag("updateNear");
  settings.sun_samples = int(node.integer("sun_samples"));
  settings.to_light.reset();
  std::optional<scene::Spot>& spot = builder.scene.data<scene::SunShadows>().spot;
  spot.reset();
  if (node.gives("lightDirection")) {
    const glm::vec3 along = node.vec3("lightDirection");
    if (glm::length(along) < 1e-6f)
      return builder.fail(error_at(node.where_of("lightDirection"),
                                   "the light's direction has no length; give \"0 0 -1\", say"));
    settings.to_light = -glm::normalize(along);
  }
  if (node.flag("spot")) {
    spot = {node.vec3("lightPosition"), glm::radians(0.5f * float(node.number("lightAngle")))};
    if (!settings.to_light) settings.to_light = glm::vec3(0.0f, 0.0f, 1.0f);
  }
  replace_sun(builder.scene);

  ShadowGroups& groups = builder.scene.data<ShadowGroups>();
  groups = {};
  for (const scene::NodeAttribute& attribute : node.attributes) {
    if (attribute.schema->name == "casters") groups.casters.emplace_back(attribute.text, attribute.where);
    if (attribute.schema->name == "receivers") groups.receivers.emplace_back(attribute.text, attribute.where);
  }
}

/// Whether the node or one inside it makes something that stands in the scene.
bool holds_any(const scene::Node& node) {
  const bool is_around_others = node.schema->type == "group" || node.schema->type == "scenario";
  return !is_around_others || std::ranges::any_of(node.children, holds_any);
}

/// All objects but those in the groups refuse; none where no group is named. Returns the groups' nodes.
std::vector<scene::NodeRange> choose(scene::SceneBuilder& builder,
                                     const std::vector<std::pair<std::string, FileLocation>>& groups,
                                     const char* role, std::vector<bool>& refuses) {
  std::vector<scene::NodeRange> nodes;
  if (groups.empty()) return nodes;
  refuses.assign(builder.scene.objects.size(), true);
  std::set<std::string> chosen;
  for (const auto& [group, where] : groups) {
    if (!chosen.insert(group).second) continue;
    const scene::Node* node = builder.find(group);
    if (!node || !holds_any(*node)) {
      builder.fail(error_at(where, "\"{}\" holds nothing that could {} a shadow", group, role));
      continue;
    }
    nodes.push_back(builder.range_of(*node));
    for (const int object : builder.objects_of(group)) refuses[std::size_t(object)] = false;
  }
  return nodes;
}

/// The same in a scene that runs, for objects that have come and groups that hold other nodes now.
std::vector<scene::NodeRange> choose_again(const scene::LiveScene& live, std::size_t object_count,
                                           const std::vector<std::pair<std::string, FileLocation>>& groups,
                                           std::vector<bool>& refuses) {
  std::vector<scene::NodeRange> nodes;
  if (groups.empty()) return nodes;
  refuses.assign(object_count, true);
  for (const auto& [group, where] : groups)
    if (const scene::Node* node = live.find(group)) {
      nodes.push_back(live.range_of(*node));
      for (const int object : live.objects_of(*node)) refuses[std::size_t(object)] = false;
    }
  return nodes;
}

}  // namespace

void add_shadow_map_node(scene::NodeRegistry& registry) {
  registry.add(shadow_map_schema(), build_shadow_map);
  registry.add_finish_step([](scene::SceneBuilder& builder) {
    const ShadowGroups groups = builder.scene.data<ShadowGroups>();
    if (groups.casters.empty() && groups.receivers.empty()) return;
    scene::SunShadows& shadows = builder.scene.data<scene::SunShadows>();
    shadows.caster_nodes = choose(builder, groups.casters, "cast", shadows.casts_none);
    choose(builder, groups.receivers, "receive", shadows.receives_none);
  });
  registry.add_follow_step([](const scene::LiveScene& live, scene::Scene& scene) {
    const ShadowGroups groups = scene.data<ShadowGroups>();
    if (groups.casters.empty() && groups.receivers.empty()) return;
    scene::SunShadows& shadows = scene.data<scene::SunShadows>();
    shadows.caster_nodes = choose_again(live, scene.objects.size(), groups.casters, shadows.casts_none);
    choose_again(live, scene.objects.size(), groups.receivers, shadows.receives_none);
  });
}

}  // namespace parvis::light
