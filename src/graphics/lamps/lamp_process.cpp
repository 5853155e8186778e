#include "graphics/lamps/lamp_process.h"

#include <map>
#include <utility>

#include "base/known_names.h"
#include "scene/data/model_parts.h"
#include "scene/data/name_pattern.h"
#include "scene/data/object_names.h"
#include "scene/data/scene.h"

namespace parvis::lamps {
namespace {

using ObjectsByName = std::multimap<std::string_view, const scene::Object*>;

std::vector<const scene::Object*> objects_called(const ObjectsByName& objects, const std::string& pattern) {
  const bool is_name = !scene::is_pattern(pattern);
  std::vector<const scene::Object*> found;
  for (auto each = is_name ? objects.lower_bound(pattern) : objects.begin();
       each != (is_name ? objects.upper_bound(pattern) : objects.end()); ++each)
    if (is_name || scene::matches(pattern, each->first)) found.push_back(each->second);
  return found;
}

std::set<std::string> parts_of(const std::vector<const scene::Object*>& objects) {
  std::set<std::string> names;
  for (const scene::Object* object : objects)
    for (const scene::Part& part : object->model->parts) names.insert(part.object);
  return names;
}

/// Lamps that name something, and their nodes. Nodes that are hidden, with their group or for the scenario,
/// have made no lamp.
void find_named(const scene::Nodes& nodes, const std::set<LampNames>& made,
                std::map<LampNames, const scene::Node*>& found) {
  for (const scene::Node& node : nodes) {
    find_named(node.children, made, found);
    if (node.schema->type != "lamp") continue;
    const LampNames names{node.text("of"), node.text("shows"), node.text("part")};
    if (made.contains(names)) found.try_emplace(names, &node);
  }
}

}  // namespace

void LampProcess::begin(scene::Scene& scene, action::SharedByProcesses& shared) {
  live_ = &shared.live;
  scene::show_what_lamps_show(scene);
}

void LampProcess::present(scene::Scene& scene, double /*ahead_s*/) {
  scene::show_what_lamps_show(scene);
  if (live_ && checked_ != live_->scenario()) warn_of_idle(scene);
}

void LampProcess::warn_of_idle(const scene::Scene& scene) {
  constexpr int max_warnings = 10;
  checked_ = live_->scenario();
  std::set<LampNames> made;
  for (const scene::Lamp& lamp : scene.items<scene::Lamp>())
    if (LampNames names{lamp.of, lamp.shows, lamp.part}; looked_at_.insert(names).second)
      made.insert(std::move(names));
  std::map<LampNames, const scene::Node*> named;
  find_named(live_->nodes(), made, named);
  ObjectsByName objects_by_name;
  for (const scene::Object& object : scene.objects) objects_by_name.emplace(object.name, &object);
  int warnings = 0;
  for (const auto& [names, node] : named) {
    for (const char* attribute : {"of", "shows"})
      if (const std::string& pattern = node->text(attribute);
          !pattern.empty() && objects_called(objects_by_name, pattern).empty()) {
        warn(error_at(node->where_of(attribute), "lamp: no object is called \"{}\"{}", pattern,
                      names_that_exist(pattern, scene::object_names(scene))));
        ++warnings;
      }
    const std::string& part = node->text("part");
    const std::vector<const scene::Object*> objects = part.empty()
                                                          ? std::vector<const scene::Object*>()
                                                          : objects_called(objects_by_name, node->text("of"));
    if (!objects.empty())
      if (const std::set<std::string> parts = parts_of(objects); !parts.contains(part)) {
        warn(error_at(node->where_of("part"), "lamp: no part of \"{}\" is called \"{}\"{}", node->text("of"),
                      part, names_that_exist(part, std::vector(parts.begin(), parts.end()))));
        ++warnings;
      }
    if (warnings >= max_warnings) return;
  }
}

}  // namespace parvis::lamps
