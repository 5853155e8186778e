#include "reflections/methods/registry.h"

#include <algorithm>
#include <cassert>

namespace parvis::methods {

void Registry::add(Method method) {
  assert(method.make && bool(method.is_wanted) == method.is_overlay);
  assert(std::ranges::none_of(methods_, [&](const Method& other) { return other.name == method.name; }) &&
         "a method of reflection is added twice");
  methods_.push_back(std::move(method));
}

std::vector<std::string> Registry::names() const {
  std::vector<std::string> names;
  for (const Method& method : methods_)
    if (!method.is_overlay) names.push_back(method.name);
  return names;
}

std::string Registry::name_of(const scene::Scene& scene) const {
  const std::string& named = settings(scene).method;
  if (!named.empty() && named != automatic) return named;
  const auto suited = std::ranges::find_if(
      methods_, [&](const Method& method) { return method.suits && method.suits(scene); });
  const auto chosen = suited != methods_.end() ? suited : std::ranges::find_if(methods_, &Method::is_default);
  return chosen == methods_.end() ? std::string() : chosen->name;
}

std::vector<scene::AttributeSchema> Registry::attributes() const {
  std::vector<scene::AttributeSchema> attributes;
  for (const Method& method : methods_)
    for (const scene::AttributeSchema& attribute : method.attributes)
      if (std::ranges::find(attributes, attribute.name, &scene::AttributeSchema::name) == attributes.end())
        attributes.push_back(attribute);
  return attributes;
}

void Registry::read(const scene::Node& node, Settings& settings) const {
  for (const Method& method : methods_)
    if (method.read) method.read(node, settings);
}

Result<const Method*> Registry::find(const std::string& name) const {
  for (const Method& method : methods_)
    if (!method.is_overlay && method.name == name) return &method;
  return error("\"{}\" is no method of reflection: expected one of {}", name, fmt::join(names(), ", "));
}

Status Registry::prepare(scene::Scene& scene) const {
  const Result<const Method*> chosen = method_of(scene);
  if (!chosen) return chosen.errors();
  for (const Method& method : methods_)
    if (method.prepare && (&method == *chosen || (method.is_overlay && method.is_wanted(scene))))
      method.prepare(scene);
  return Ok{};
}

bool Registry::reads_baked(const scene::Scene& scene, const std::string& bake_step) const {
  const Result<const Method*> chosen = method_of(scene);
  return !chosen ||
         std::ranges::find((*chosen)->unused_bake_steps, bake_step) == (*chosen)->unused_bake_steps.end();
}

Result<std::unique_ptr<Reflections>> Registry::make_one(const Method& method, const scene::Scene& scene,
                                                        render::Renderer& renderer) const {
  std::unique_ptr<Reflections> below;
  if (!method.lies_over.empty()) {
    const Result<const Method*> lower = find(method.lies_over);
    if (!lower) return lower.errors();
    Result<std::unique_ptr<Reflections>> made = make_one(**lower, scene, renderer);
    if (!made) return made.errors();
    below = *std::move(made);
  }
  return method.make(scene, renderer, std::move(below));
}

Result<std::unique_ptr<Reflections>> Registry::make(const scene::Scene& scene,
                                                    render::Renderer& renderer) const {
  const Result<const Method*> chosen = method_of(scene);
  if (!chosen) return chosen.errors();
  Result<std::unique_ptr<Reflections>> made = make_one(**chosen, scene, renderer);
  for (const Method& overlay : methods_)
    if (made && overlay.is_overlay && overlay.is_wanted(scene))
      made = overlay.make(scene, renderer, *std::move(made));
  return made;
}

}  // namespace parvis::methods
