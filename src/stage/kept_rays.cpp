#include "stage/kept_rays.h"

#include <algorithm>
#include <span>

#include "base/content_hash.h"

namespace parvis::stage {
namespace {

std::uint64_t casters(const scene::Scene& scene) {
  ContentHash hash;
  scene.data<scene::SunShadows>().hash(hash);
  return hash.value();
}

/// Can a hierarchy of one follow the other? Their objects and models are the same, but for new ones, and what
/// mirrors and casts shadows.
bool can_follow(const scene::Scene& a, const scene::Scene& b) {
  const auto is_same = [](const scene::Object& one, const scene::Object& other) {
    return one.model == other.model && one.paint == other.paint &&
           one.takes_reflection == other.takes_reflection && one.is_dynamic == other.is_dynamic &&
           one.deformed_meshes.size() == other.deformed_meshes.size();
  };
  if (b.objects.size() < a.objects.size()) return false;
  const auto known = std::span(b.objects).first(a.objects.size());
  return std::ranges::equal(a.objects, known, is_same) && casters(a) == casters(b);
}

}  // namespace

std::optional<KeptRays::Moment> KeptRays::of(const scene::Scene& scene, std::chrono::milliseconds patience) {
  if (building_.valid()) {
    if (building_.wait_for(patience) != std::future_status::ready) return std::nullopt;
    kept_ = building_.get();
  }
  if (kept_ && !can_follow(kept_->scene, scene)) kept_.reset();
  if (!kept_) {
    building_ = std::async(std::launch::async, [source = std::make_shared<const scene::Scene>(scene)] {
      return std::make_unique<Kept>(*source);
    });
    return std::nullopt;
  }
  kept_->scene.objects.resize(scene.objects.size());  // moved, not copied: meshes stay where they are
  kept_->scene = scene;
  kept_->rays.update(kept_->scene);
  return Moment{&kept_->rays, &kept_->scene};
}

}  // namespace parvis::stage
