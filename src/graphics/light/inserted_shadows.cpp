#include "graphics/light/inserted_shadows.h"

#include <algorithm>

namespace parvis::light {

void InsertedShadows::update(const scene::Scene& scene) {
  std::vector<std::uint8_t> casters(scene.objects.size(), 1);
  scene::for_each_traced_kind(scene, [&](const scene::TracedKind& kind, int first_thing) {
    casters.resize(std::size_t(first_thing + kind.count(scene)), std::uint8_t(kind.is_recorded ? 0 : 1));
  });
  const auto casting = std::ranges::count(casters, 1);
  if (casting == 0 || std::size_t(casting) == casters.size()) casters.clear();
  if (casters != casters_) maps_.reset();  // what casts is another: the maps are drawn again
  casters_ = std::move(casters);
}

void InsertedShadows::renew(const render::FixedChange& change, const Bounds& fixed) {
  fixed_.add(fixed);
  if (maps_) maps_->renew(change, fixed);
}

void InsertedShadows::draw(const Camera& camera, const scene::SunLight& sun, std::span<const Bounds> moving,
                           const render::DrawView& draw) {
  if (casters_.empty()) return;
  if (!maps_) maps_ = std::make_unique<SunShadowMaps>(sun, fixed_);
  maps_->update(camera, sun, moving, [&](render::View view) {
    view.shown_objects = &casters_;
    draw(view);
  });
}

void InsertedShadows::bind() const {
  if (maps_) maps_->bind(render::inserted_shadow_unit);
}

void InsertedShadows::fill(render::Frame& frame) const {
  frame.frame_inserted_texel = glm::vec4(0.0f);
  if (!maps_) return;
  const shading::ShadowMaps& maps = maps_->maps();
  for (int i = 0; i < shading::shadow_map_count; ++i)
    frame.frame_inserted_uvz_from_world[i] = maps.uvz_from_world[i];
  frame.frame_inserted_texel = glm::vec4(maps.texel_m, maps.texel_uv, 0.0f);
}

shading::SunShadow InsertedShadows::read_back() const {
  return maps_ ? maps_->read_back() : shading::SunShadow{};
}

}  // namespace parvis::light
