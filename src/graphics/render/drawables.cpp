#include "graphics/render/drawables.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace parvis::render {

void Drawables::add(DrawableKind kind) {
  assert(kind.make && kind.traced.count && kind.traced.trace && "a drawable has a traced counterpart");
  assert(!find(kind.traced.name) && "two kinds of drawables have the same name");
  kinds_.push_back(std::move(kind));
}

const DrawableKind* Drawables::find(std::string_view name) const {
  const auto kind = std::ranges::find(kinds_, name, [](const DrawableKind& k) { return k.traced.name; });
  return kind == kinds_.end() ? nullptr : &*kind;
}

void Drawables::attach(scene::Scene& scene) const {
  scene.traced_kinds.clear();
  for (const DrawableKind& kind : kinds_) scene.traced_kinds.push_back(kind.traced);
}

Status Drawables::follow(const scene::Scene& scene, std::vector<Made>& made) const {
  Errors errors;
  scene::for_each_traced_kind(scene, [&](const scene::TracedKind& traced, int first_thing) {
    const auto known = std::ranges::find(made, traced.name, &Made::kind);
    if (known != made.end()) {
      if (std::exchange(known->first_thing, first_thing) != first_thing)
        known->drawable->renumber(first_thing);
      return;
    }
    const DrawableKind* kind = find(traced.name);
    if (!kind)
      return errors.push_back({fmt::format("the scene has {}, which nothing draws", traced.name), {}});
    Result<std::unique_ptr<Drawable>> drawable = kind->make(scene, first_thing);
    if (drawable)
      made.push_back({traced.name, first_thing, *std::move(drawable)});
    else
      errors.insert(errors.end(), drawable.errors().begin(), drawable.errors().end());
  });
  if (!errors.empty()) return errors;
  return Ok{};
}

}  // namespace parvis::render
