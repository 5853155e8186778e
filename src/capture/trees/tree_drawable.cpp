// The billboards of a view are put in order on the CPU: trees by distance, the cells of each exactly
// (cell_order.h). They are visited from front to back, so that those behind opaque crowns are left out
// (crown_cover.h), and drawn from back to front. Views with colour blend them; shadow maps and picking take
// each texel by its opacity's chance, so that a crown's shadow has the crown's density. Trees in front that
// are seen closer than by their photographs are drawn with detail (leaf_detail.h), by a program of their own.
//
// Limit: trees whose boxes overlap are in the order of their middles.
#include "capture/trees/tree_drawable.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "base/colour.h"
#include "capture/trees/billboard_math.h"
#include "capture/trees/cell_order.h"
#include "capture/trees/crown_cover.h"
#include "capture/trees/detail_tiles.h"
#include "capture/trees/level_choice.h"
#include "capture/trees/scene_tree.h"
#include "capture/trees/tree_atlas.h"
#include "capture/trees/tree_layer.h"
#include "graphics/gl/sampled_textures.h"
#include "graphics/render/bindings.h"
#include "graphics/render/static_things.h"
#include "graphics/render/stream_buffer.h"
#include "graphics/render/view_programs.h"
#include "scene/data/sun_shadows.h"

namespace parvis::trees {
namespace {

using render::Culling, render::Pass, render::View, render::ViewKind, render::ViewPrograms;

constexpr GLuint atlas_unit = render::first_drawable_unit, detail_unit = atlas_unit + 1;
constexpr float min_closer =
    1.0f;  // times closer than the photographs: below it leaf_detail.glsl adds nothing

// Of several samples in a pixel all are covered, or none: else neighbouring billboards leave a seam where
// each has some of them.
constexpr float margin_pixels = 0.75f, min_margin = 0.02f;

/// A billboard as tree_vertex.glsl reads it.
struct DrawnBillboard {
  glm::vec3 centre;
  float second_share;
  glm::vec3 half_right;
  float mip_level;
  glm::vec3 half_up;
  glm::vec4 slants;
  glm::vec4 base;
  glm::uvec4 tiles_and_thing;  ///< and layer of DetailTiles
  glm::vec4 extent;            ///< of the quad: what the textures show, with a margin
  glm::vec3 light_in_crown;
  glm::vec4 exit_distances;                 ///< of the quad's corners
  std::array<glm::vec2, 2> texture_scales;  ///< from the billboard to those of the photographs
  glm::vec4 detail_place;                   ///< in tiles of detail: the middle, and half a billboard
};

/// A rectangle on a billboard (-1..1).
struct Extent {
  glm::vec2 low{1.0f}, high{-1.0f};

  void add(glm::vec4 other, glm::vec2 scale) {
    low = glm::min(low, scale * glm::vec2(other)), high = glm::max(high, scale * glm::vec2(other.z, other.w));
  }
  glm::vec4 with_margin(float margin) const {
    return {glm::max(low, -1.0f) - margin, glm::min(high, 1.0f) + margin};
  }
};

/// Distance to the crown's end toward the sun from each corner of a quad, in the tree's frame.
glm::vec4 exit_distances(const Bounds& box, glm::vec3 centre, const BillboardFrame& frame, glm::vec4 extent,
                         glm::vec3 to_sun) {
  glm::vec4 distances;
  for (int corner = 0; corner < 4; ++corner) {
    const glm::vec2 place(corner & 1 ? extent.z : extent.x, corner & 2 ? extent.w : extent.y);
    const glm::vec2 m = place * frame.half_size_m;
    const glm::vec3 at = centre + m.x * frame.right + m.y * frame.up;
    distances[corner] = way_out(box, glm::clamp(at, box.min, box.max), to_sun);
  }
  return distances;
}

/// The billboards that one view shows.
struct DrawList {
  std::vector<DrawnBillboard> billboards;
  std::size_t detailed = 0;  ///< how many of them, the last ones, are drawn with detail
  GLintptr offset = 0;
  bool is_layered = false;  ///< blended by themselves, tree_layer.h
};

float scale_of(const glm::mat4& world_from_tree) {
  const glm::mat3 turn(world_from_tree);
  return std::max({glm::length(turn[0]), glm::length(turn[1]), glm::length(turn[2])});
}

bool is_blended(const View& view) { return view.kind != ViewKind::shadow && view.kind != ViewKind::picking; }

class TreeDrawable final : public render::Drawable {
 public:
  static Result<std::unique_ptr<render::Drawable>> create(const scene::Scene& scene, int first_thing) {
    const std::string vertex = "capture/trees/tree_vertex.glsl", surface = "capture/trees/tree_surface.glsl";
    Result<ViewPrograms> blended = ViewPrograms::create({vertex, surface, {{"IS_RECORDED", ""}}});
    if (!blended) return blended.errors();
    Result<ViewPrograms> detailed =
        ViewPrograms::create({vertex, surface, {{"IS_RECORDED", ""}, {"HAS_DETAIL", ""}}});
    if (!detailed) return detailed.errors();
    Result<ViewPrograms> by_chance =
        ViewPrograms::create({vertex, surface, {{"IS_RECORDED", ""}, {"HAS_HOLES", ""}}});
    if (!by_chance) return by_chance.errors();
    Result<TreeLayer> layer = TreeLayer::create();
    if (!layer) return layer.errors();
    std::unique_ptr<TreeDrawable> drawable(new TreeDrawable(
        first_thing, *std::move(blended), *std::move(detailed), *std::move(by_chance), *std::move(layer)));
    if (Status status = drawable->upload(scene); !status) return status.errors();
    drawable->update(scene);
    return std::unique_ptr<render::Drawable>(std::move(drawable));
  }

  void update(const scene::Scene& scene) override {
    const std::vector<SceneTree>& trees = scene_trees(scene);
    detail_ = scene.data<TreeDetail>();
    sun_ = scene::sun_light(scene);
    if (const Status status = upload(scene); !status) fmt::print(stderr, "{}", to_string(status.errors()));
    things_.begin_update(trees.size());
    trees_ = trees, bounds_.resize(trees.size()), casts_shadow_.resize(trees.size()), swaying_.clear();
    const auto& shadows = scene.data<scene::SunShadows>();
    const std::vector<int>& makers = scene.data<SceneTrees>().makers;
    for (std::size_t i = 0; i < trees.size(); ++i) {
      SceneTree& tree = trees_[i];
      tree.world_from_tree = tree.world_from_leaning_tree(), tree.lean_m = glm::vec2(0.0f);
      const Bounds all = transformed(tree.world_from_tree, tree.tree->box);
      const bool is_static = !tree.sways();
      // A tree that sways is no static thing, but keeps its number.
      things_.update(
          i, {is_static ? tree.tree.get() : nullptr, is_static ? tree.world_from_tree : glm::mat4(1.0f),
              is_static && tree.is_visible, all, is_static ? all : Bounds()});
      bounds_[i] = tree.is_visible ? all : Bounds();
      casts_shadow_[i] = shadows.casts_item_of(makers[i]);
      if (!is_static && tree.is_visible) swaying_.push_back(all);
    }
  }
  void renumber(int first_thing) override { first_thing_ = first_thing; }
  render::Extents extents() const override {
    render::Extents extents = things_.extents();
    extents.moving = swaying_, extents.things = bounds_;
    return extents;
  }

  void prepare(const View& view, const Culling& culling) override {
    DrawList& list = list_of(view);
    list.billboards.clear();
    std::vector<std::pair<float, std::size_t>> seen;
    const bool is_shadow = view.kind == ViewKind::shadow;
    for (std::size_t i = 0; i < trees_.size(); ++i)
      if (trees_[i].is_visible && (casts_shadow_[i] || !is_shadow) && atlas_.holds(trees_[i].tree.get()) &&
          culling.shows(first_thing_ + int(i), {trees_[i].sways(), things_.is_newcomer(i)}) &&
          culling.may_see(bounds_[i]) && !culling.is_hidden(bounds_[i]))
        seen.emplace_back(glm::distance(bounds_[i].centre(), view.position_in_world), i);
    std::ranges::sort(seen);
    const bool has_cover = view.kind == ViewKind::main || view.kind == ViewKind::cube_face;
    cover_.begin(view, has_cover ? detail_.min_visible : 0.0f);
    std::vector<TreeInView> in_view;
    in_view.reserve(seen.size());
    for (const auto& [distance, i] : seen)
      in_view.push_back({trees_[i].tree.get(), seen_tree(trees_[i], bounds_[i], view, culling)});
    TreeDetail detail = detail_;
    if (view.kind != ViewKind::main)
      detail.affordable_billboards = 0;  // shadows and reflections do with less
    const std::vector<std::size_t> levels = levels_in_view(in_view, detail);
    list.detailed = 0;
    bool is_detailed = is_blended(view);
    for (std::size_t k = 0; k < seen.size(); ++k) {
      add(seen[k].second, view, in_view[k].seen, levels[k], list.billboards);
      is_detailed &= is_closer_than_photographs(*in_view[k].tree, in_view[k].seen);
      if (is_detailed) list.detailed = list.billboards.size();
    }
    list.is_layered = view.kind == ViewKind::main && detail_.min_visible > 0.0f &&
                      list.billboards.size() > detail_.direct_billboards;
    if (list.is_layered) layer_.prepare(cover_);
    std::ranges::reverse(list.billboards);
    render::StreamBuffer& stream = view.kind == ViewKind::main ? main_stream_ : other_stream_;
    list.offset = stream.append(std::span<const DrawnBillboard>(list.billboards), 16);
  }

  void draw(const View& view, Pass pass) override {
    const DrawList& list = list_of(view);
    const bool blends = is_blended(view);
    if (pass != (blends ? Pass::blend : Pass::cutout) || list.billboards.empty()) return;
    if (list.is_layered) layer_.begin(view);
    const std::size_t usual = list.billboards.size() - list.detailed;
    draw_range(blends ? blended_ : by_chance_, view, {0, usual});
    draw_range(detailed_, view, {usual, list.detailed});
    if (list.is_layered) layer_.end(view);
  }

 private:
  /// Some of a view's billboards, by number.
  struct Range {
    std::size_t first, count;
  };
  void draw_range(const ViewPrograms& programs, const View& view, Range range) const {
    const gl::Program* program = range.count > 0 ? programs.use(view) : nullptr;
    if (!program) return;
    gl::bind_textures(*program, {{"tree_texels", atlas_unit, atlas_.texture()}});
    if (program->declares("detail_tiles"))
      gl::bind_textures(*program, {{"detail_tiles", detail_unit, detail_tiles_.texture()}});
    const bool is_main = view.kind == ViewKind::main;
    glVertexArrayVertexBuffer(
        vertex_array_.name(), 0, (is_main ? main_stream_ : other_stream_).name(),
        (is_main ? main_list_ : other_list_).offset + GLintptr(range.first * sizeof(DrawnBillboard)),
        sizeof(DrawnBillboard));
    glBindVertexArray(vertex_array_.name());
    glDisable(GL_CULL_FACE);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(range.count));
  }
  /// Does the view show some of the tree's pixels finer than its photographs?
  bool is_closer_than_photographs(const TreeLevels& tree, const SeenTree& seen) const {
    return detail_tiles_.layer(&tree) &&
           seen.pixels_per_metre * tree.detail.photographed_pixel_m > min_closer;
  }

  TreeDrawable(int first_thing, ViewPrograms blended, ViewPrograms detailed, ViewPrograms by_chance,
               TreeLayer layer)
      : first_thing_(first_thing),
        blended_(std::move(blended)),
        detailed_(std::move(detailed)),
        by_chance_(std::move(by_chance)),
        layer_(std::move(layer)),
        main_stream_(1 << 22),
        other_stream_(1 << 22) {
    const GLuint array = vertex_array_.name();
    const auto attribute = [&](GLuint index, GLint size, std::size_t offset) {
      glEnableVertexArrayAttrib(array, index);
      glVertexArrayAttribFormat(array, index, size, GL_FLOAT, GL_FALSE, GLuint(offset));
      glVertexArrayAttribBinding(array, index, 0);
    };
    attribute(0, 4, offsetof(DrawnBillboard, centre));
    attribute(1, 4, offsetof(DrawnBillboard, half_right));
    attribute(2, 3, offsetof(DrawnBillboard, half_up));
    attribute(3, 4, offsetof(DrawnBillboard, slants));
    attribute(4, 4, offsetof(DrawnBillboard, base));
    glEnableVertexArrayAttrib(array, 5);
    glVertexArrayAttribIFormat(array, 5, 4, GL_UNSIGNED_INT, offsetof(DrawnBillboard, tiles_and_thing));
    glVertexArrayAttribBinding(array, 5, 0);
    attribute(6, 4, offsetof(DrawnBillboard, extent));
    attribute(7, 3, offsetof(DrawnBillboard, light_in_crown));
    attribute(9, 4, offsetof(DrawnBillboard, exit_distances));
    attribute(8, 4, offsetof(DrawnBillboard, texture_scales));
    attribute(10, 4, offsetof(DrawnBillboard, detail_place));
    glVertexArrayBindingDivisor(array, 0, 1);
  }

  /// Trees that are new.
  Status upload(const scene::Scene& scene) {
    std::vector<const TreeLevels*> distinct;
    for (const SceneTree& tree : scene_trees(scene)) distinct.push_back(tree.tree.get());
    std::ranges::sort(distinct);
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    if (distinct == uploaded_) return Ok{};
    uploaded_ = distinct;
    crowns_ = {};
    Result<TreeAtlas> atlas = TreeAtlas::create(distinct);
    if (!atlas) return atlas.errors();
    atlas_ = *std::move(atlas), detail_tiles_ = DetailTiles::of(distinct);
    return Ok{};
  }

  /// Adds the visible billboards of a tree from front to back.
  void add(std::size_t i, const View& view, const SeenTree& seen, std::size_t level,
           std::vector<DrawnBillboard>& out) {
    const SceneTree& placed = trees_[i];
    const glm::mat4& world_from_tree = placed.world_from_tree;
    const glm::mat3 turn(world_from_tree);
    const float scale = scale_of(world_from_tree);
    const glm::vec3 eye(glm::inverse(world_from_tree) * glm::vec4(view.position_in_world, 1.0f));
    const BillboardTree& shown = placed.tree->levels[level];
    const float mip_level = TreeAtlas::mip_level(texel_size_m(shown) * seen.pixels_per_metre);
    order_.back_to_front(shown.grid, eye, cells_);
    const glm::vec3 to_sun = glm::normalize(glm::inverse(turn) * to_sun_at(bounds_[i].centre()));
    const std::vector<float>& sun = crowns_.shares(*placed.tree, to_sun)[level];
    const std::vector<float>&albedo_factor = placed.tree->crown.albedo_factor[level],
          &sky = placed.tree->crown.sky[level];
    const glm::vec3 cell_size_m = shown.grid.cell_size_m();
    const float half_cell_pixels =
        0.5f * std::min({cell_size_m.x, cell_size_m.y, cell_size_m.z}) * seen.pixels_per_metre;
    const float margin = std::clamp(margin_pixels / half_cell_pixels, min_margin, 1.0f);
    std::ranges::reverse(cells_);
    const std::uint32_t* detail_layer = detail_tiles_.layer(placed.tree.get());
    for (const std::uint32_t cell : cells_) {
      const glm::vec3 centre = shown.grid.centre(cell);
      const BillboardFrame frame = billboard_frame(centre, cell_size_m, eye);
      const CoveringBillboard covering{glm::vec3(world_from_tree * glm::vec4(centre, 1.0f)),
                                       turn * (frame.half_size_m.x * frame.right),
                                       turn * (frame.half_size_m.y * frame.up), frame.slants};
      const std::optional<glm::vec4> visible = cover_.visible_part(covering);
      if (!visible) continue;
      const ClosestViews closest = closest_views(shown, centre, frame.to_eye, int(cell));
      DrawnBillboard& b = out.emplace_back();
      b.mip_level = mip_level;
      b.centre = covering.centre;
      b.second_share = closest.weights[1];
      b.half_right = covering.half_right, b.half_up = covering.half_up;
      b.slants = frame.slants;
      const glm::vec4 base = glm::vec4(shown.base[cell]) / 255.0f;
      b.base = glm::vec4(linear_from_srgb(glm::vec3(base)), base.w);
      Extent extent;
      for (std::size_t v = 0; v < 2; ++v) {
        const std::size_t view_index = std::size_t(closest.views[v]);
        b.tiles_and_thing[glm::length_t(v)] = atlas_.tile(placed.tree.get(), level, view_index, cell);
        // A cell of the finest level is filled, so that its texture is stretched with its billboard; what
        // coarser ones show has a place within them.
        const glm::vec3 camera = shown.views[view_index].camera.position_in_world;
        b.texture_scales[v] =
            level == 0 ? glm::vec2(1.0f)
                       : frame.half_size_m / billboard_frame(centre, cell_size_m, camera).half_size_m;
        if (closest.weights[v] > 0.0f)
          extent.add(atlas_.extent(placed.tree.get(), level, view_index, cell, mip_level),
                     1.0f / b.texture_scales[v]);
      }
      b.extent = extent.with_margin(margin);
      b.extent = {glm::max(glm::vec2(b.extent), glm::vec2(*visible)),
                  glm::min(glm::vec2(b.extent.z, b.extent.w), glm::vec2(visible->z, visible->w))};
      const std::size_t stronger = closest.weights[1] > closest.weights[0] ? 1 : 0;
      cover_.add(covering, atlas_.mask(placed.tree.get(), level, std::size_t(closest.views[stronger]), cell),
                 b.texture_scales[stronger]);
      b.tiles_and_thing.z = std::uint32_t(first_thing_) + std::uint32_t(i);
      b.light_in_crown = {albedo_factor[cell], sun[cell], sky[cell]};
      if (detail_layer) {
        const LeafDetail& detail = placed.tree->detail;
        b.tiles_and_thing.w = *detail_layer;
        b.detail_place = glm::vec4(LeafDetail::offset_of(cell), frame.half_size_m / detail.width_m());
      }
      b.exit_distances = scale * exit_distances(placed.tree->box, centre, frame, b.extent, to_sun);
    }
  }

  /// Unit.
  glm::vec3 to_sun_at(glm::vec3 in_world) const {
    return glm::normalize(sun_.spot ? sun_.spot->position - in_world : sun_.direction_to_sun);
  }

  DrawList& list_of(const View& view) { return view.kind == ViewKind::main ? main_list_ : other_list_; }

  int first_thing_;
  TreeDetail detail_;
  CrownCover cover_;
  ViewPrograms blended_, detailed_, by_chance_;
  TreeLayer layer_;
  gl::VertexArray vertex_array_ = gl::VertexArray::create();
  TreeAtlas atlas_;
  DetailTiles detail_tiles_;
  std::vector<const TreeLevels*> uploaded_;
  std::vector<SceneTree> trees_;    // as of the last update
  render::StaticThings things_;     // those that stand still
  std::vector<Bounds> bounds_;      // of each tree; empty while it is hidden
  std::vector<bool> casts_shadow_;  // each tree
  std::vector<Bounds> swaying_;     // of those that sway and are visible
  // The main view's list and memory are its own: other views are drawn between its preparation and its
  // drawing.
  render::StreamBuffer main_stream_, other_stream_;
  DrawList main_list_, other_list_;
  scene::SunLight sun_;
  SunInCrowns crowns_;
  CellOrder order_;
  std::vector<std::uint32_t> cells_;
};

}  // namespace

SeenTree seen_tree(const SceneTree& tree, const Bounds& bounds, const View& view, const Culling& culling) {
  const glm::vec3 eye(glm::inverse(tree.world_from_tree) * glm::vec4(view.position_in_world, 1.0f));
  return {scale_of(tree.world_from_tree) * culling.pixels_per_metre(bounds),
          parallax(tree.tree->levels.front(), eye)};
}

render::DrawableKind scene_trees_kind() {
  render::DrawableKind kind;
  kind.traced = traced_trees();
  kind.make = [](const scene::Scene& scene, int first_thing) {
    return TreeDrawable::create(scene, first_thing);
  };
  return kind;
}

}  // namespace parvis::trees
