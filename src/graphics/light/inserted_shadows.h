// The shadow maps of photographed surfaces. Their photographs hold the shadows that they cast on each other,
// so that these maps show all other things alone: what was inserted into the place.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "graphics/light/sun_shadow_maps.h"
#include "graphics/render/frame.h"

namespace parvis::light {

/// Two maps about the viewer, as SunShadowMaps without a fit, whatever the scene's method; there while the
/// scene has photographed surfaces (scene::TracedKind::is_recorded) and other things.
class InsertedShadows {
 public:
  /// `fixed` bounds all that does not move.
  explicit InsertedShadows(const Bounds& fixed) : fixed_(fixed) {}

  /// Takes over which things of the scene are photographed.
  void update(const scene::Scene& scene);
  /// Follows changes as render::ShadowMethod::renew.
  void renew(const render::FixedChange& change, const Bounds& fixed);
  /// Draws the maps as render::ShadowMethod::update.
  void draw(const Camera& camera, const scene::SunLight& sun, std::span<const Bounds> moving,
            const render::DrawView& draw);

  /// Binds the maps at render::inserted_shadow_unit.
  void bind() const;
  /// Its members of the block that all views share.
  void fill(render::Frame& frame) const;
  /// A copy for the ray tracer; no maps where nothing was inserted.
  shading::SunShadow read_back() const;

 private:
  std::vector<std::uint8_t> casters_;  ///< a flag per object and thing; empty: no maps are needed
  Bounds fixed_;
  std::unique_ptr<SunShadowMaps> maps_;
};

}  // namespace parvis::light
