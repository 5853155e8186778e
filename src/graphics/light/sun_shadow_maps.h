// Two-cascade sun shadow map (shading/shadow.glsl). The far cascade covers the static scene and is rendered
// once. The near cascade follows the viewer; its static depth is cached and rendered again only after the
// viewer has moved far enough. Each frame restores the texels that dynamic casters have dirtied from that
// cache, then draws the casters. While nothing moves there is no cache: the map itself is the static depth.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/bounds.h"
#include "base/image.h"
#include "graphics/gl/objects.h"
#include "graphics/render/bindings.h"
#include "graphics/render/light_source.h"
#include "graphics/render/view.h"
#include "graphics/shading/shadow.h"

namespace parvis::light {

/// Where the near map lies for a view, in place of a square about the viewer.
struct NearMap {
  glm::mat4 clip_from_world{1.0f};
  float texel_m = 1.0f;  ///< of a map of `map_size` texels, as ShadowMaps::texel_m
  float growth = 0.0f;   ///< ShadowMaps::growth
  int tile_count = 0;    ///< 0 or 4
  std::array<glm::vec4, shading::max_shadow_tiles> tiles{};  ///< ShadowMaps::tiles

  bool operator==(const NearMap&) const = default;
};

/// Fits the near map to what a view shows, in every frame; `fixed` bounds all that does not move.
using FitNearMap = std::function<NearMap(const Camera&, const scene::SunLight&, const Bounds& fixed)>;

/// The far map of the whole place and the near map, whose static part is kept.
class SunShadowMaps final : public render::ShadowMethod {
 public:
  /// Texels along a side of each map.
  static constexpr int map_size = 4096;

  /// `fixed` bounds all that does not move, in the world. Without `fit` the near map is a square about the
  /// viewer that stays until the viewer has gone some way.
  SunShadowMaps(const scene::SunLight& sun, const Bounds& fixed, FitNearMap fit = {});

  /// Fixed things appeared, vanished or moved: the next update, which must be of the same frame, draws what
  /// came into the maps, and those parts again that something left. `fixed` bounds all that does not move
  /// now.
  void renew(const render::FixedChange& change, const Bounds& fixed) override;

  /// Calls `draw` for each map that must be drawn for a viewer; for all of them when the sun has moved.
  /// `moving` bounds each thing that moves.
  void update(const Camera& camera, const scene::SunLight& sun, std::span<const Bounds> moving,
              const render::DrawView& draw) override;

  /// Draws held things over the near map; the next call or update takes them out again.
  void cast_held(const Bounds& casters, const render::DrawView& draw) override;

  void bind() const override { bind(render::shadow_unit); }
  /// The maps, at a texture unit.
  void bind(GLuint unit) const;
  const shading::ShadowMaps& maps() const override { return maps_; }
  shading::SunShadow read_back() const override;

 private:
  struct Square {
    glm::ivec2 corner, size;
  };
  void turn_to(const scene::SunLight& sun);
  render::View aim(int map, glm::vec3 centre, float half_width_m);
  render::View aim_spot(const scene::Spot& spot, int map);
  render::View shadow_view(int map, const glm::mat4& clip_from_world, float texel_m);
  void aim_near(glm::vec3 position);
  void aim_near(const NearMap& near);
  void draw_near_fixed(const render::DrawView& draw, bool is_apart);
  void keep_near_fixed();
  void draw_far(const render::DrawView& draw);
  void draw_changed(const render::DrawView& draw);
  void draw_postponed(const render::DrawView& draw);
  void redraw(render::View view, int map, std::span<const Bounds> boxes, render::Subjects subjects,
              const render::DrawView& draw) const;
  void draw_newcomers(render::View view, int map, std::span<const Bounds> boxes,
                      const render::DrawView& draw) const;
  bool near_map_serves(const Bounds& box) const;
  void put_back(const Square& square);
  Square square_of(int map, const Bounds& box) const;
  Bounds texels_of(int map, const Bounds& box) const;

  Bounds fixed_;
  FitNearMap fit_;
  scene::SunLight sun_;
  glm::vec3 to_sun_{0.0f};
  glm::mat3 sun_from_world_;  ///< rows: right, up, toward the sun
  Bounds fixed_in_sun_;
  gl::Texture depth_;       ///< a layer for each map
  gl::Texture near_fixed_;  ///< the near map without dynamic casters, where that `is_apart_`
  std::array<gl::Framebuffer, shading::shadow_map_count> framebuffers_;
  gl::Framebuffer near_fixed_framebuffer_;
  shading::ShadowMaps maps_{};
  render::View far_view_;
  std::vector<render::View> near_views_;  ///< of each tile
  std::optional<NearMap> near_;           ///< as it was fitted last
  std::vector<Square> drawn_over_;        ///< of the near map, by what moved
  std::optional<Square> held_over_;       ///< of the near map, by what is held
  bool far_is_drawn_ = false;
  bool is_apart_ = false;          ///< something moves, or has moved since the near map was drawn
  render::FixedChange change_;     ///< of this frame
  std::vector<Bounds> postponed_;  ///< changed parts of the far map that nobody looks up: the near one serves
  glm::vec3 near_centre_{1e30f};
};

}  // namespace parvis::light
