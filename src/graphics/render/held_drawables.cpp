#include "graphics/render/held_drawables.h"

namespace parvis::render {

Status HeldDrawables::follow(const scene::Scene& held, const Drawables& kinds) {
  if (!objects_) {
    Result<SceneDrawable> made = SceneDrawable::create(held);
    if (!made) return made.errors();
    objects_.emplace(*std::move(made));
  }
  if (Status status = kinds.follow(held, others_); !status) return status;
  all_.assign(1, &*objects_);
  for (const Drawables::Made& other : others_) all_.push_back(other.drawable.get());
  for (Drawable* drawable : all_) drawable->update(held);
  return Ok{};
}

}  // namespace parvis::render
