// The billboards of a view are put in order on the CPU: trees by distance, the cells of each exactly
// (cell_order.h). Views with colour blend them; shadow maps and picking take each texel by its opacity's
// chance, so that a crown's shadow has the crown's density.
//
// Limit: trees whose boxes overlap are in the order of their middles.
#include "capture/trees/tree_drawable.h"

#include <algorithm>
#include <numeric>

#include "base/colour.h"
#include "capture/trees/billboard_math.h"
#include "capture/trees/cell_order.h"
#include "capture/trees/scene_tree.h"
#include "capture/trees/tree_atlas.h"
#include "graphics/render/bindings.h"
#include "graphics/render/stream_buffer.h"
#include "graphics/render/view_programs.h"
#include "scene/data/sun_shadows.h"

namespace parvis::trees {
namespace {

using render::Culling, render::Pass, render::View, render::ViewKind, render::ViewPrograms;

// Of several samples in a pixel all are covered, or none: else neighbouring billboards leave a seam where
// each has some of them.
constexpr float margin_pixels = 0.75f, min_margin = 0.02f;

/// A billboard as tree_vertex.glsl reads it.
struct DrawnBillboard {
  glm::vec3 centre;
  float second_share;
  glm::vec3 half_right, half_up;
  glm::vec4 slants;
  glm::vec4 base;
  glm::uvec3 tiles_and_thing;
  float reach;  ///< how far the quad goes beyond the billboard: its pixels choose by their centres
  glm::vec4 light_in_crown;
};

/// What one view shows.
struct DrawList {
  std::vector<DrawnBillboard> billboards;
  GLintptr offset = 0;
};

bool is_blended(const View& view) { return view.kind != ViewKind::shadow && view.kind != ViewKind::picking; }

class TreeDrawable final : public render::Drawable {
 public:
  static Result<std::unique_ptr<render::Drawable>> create(const scene::Scene& scene, int first_thing) {
    const std::string vertex = "capture/trees/tree_vertex.glsl", surface = "capture/trees/tree_surface.glsl";
    Result<ViewPrograms> blended = ViewPrograms::create({vertex, surface, {{"IS_LEAF", ""}}});
    if (!blended) return blended.errors();
    Result<ViewPrograms> by_chance =
        ViewPrograms::create({vertex, surface, {{"IS_LEAF", ""}, {"HAS_HOLES", ""}}});
    if (!by_chance) return by_chance.errors();
    std::unique_ptr<TreeDrawable> drawable(
        new TreeDrawable(first_thing, *std::move(blended), *std::move(by_chance)));
    if (Status status = drawable->upload(scene); !status) return status.errors();
    drawable->update(scene);
    return std::unique_ptr<render::Drawable>(std::move(drawable));
  }

  void update(const scene::Scene& scene) override {
    const std::vector<SceneTree>& trees = scene_trees(scene);
    max_texel_pixels_ = scene.data<TreeDetail>().max_texel_pixels;
    sun_ = scene::sun_light(scene);
    change_ = {};
    fixed_ = {};
    if (const Status status = upload(scene); !status) fmt::print(stderr, "{}", to_string(status.errors()));
    is_newcomer_.assign(trees.size(), 0);
    for (std::size_t i = trees.size(); i < trees_.size(); ++i)
      if (!bounds_[i].empty()) change_.gone.push_back(bounds_[i]);
    const std::size_t before = trees_.size();
    trees_.resize(trees.size()), bounds_.resize(trees.size());
    for (std::size_t i = 0; i < trees.size(); ++i) {
      const SceneTree& tree = trees[i];
      const Bounds all = transformed(tree.world_from_tree, tree.tree->box);
      fixed_.add(all);
      const bool is_same = i < before && trees_[i].tree == tree.tree &&
                           trees_[i].is_visible == tree.is_visible &&
                           trees_[i].world_from_tree == tree.world_from_tree;
      if (is_same) continue;
      if (i < before && !bounds_[i].empty()) change_.gone.push_back(bounds_[i]), change_.has_moved = true;
      bounds_[i] = tree.is_visible ? all : Bounds();
      if (tree.is_visible) change_.come.push_back(all), is_newcomer_[i] = 1;
      trees_[i] = tree;
    }
  }
  render::Extents extents() const override { return {fixed_, {}, {}, bounds_, &change_}; }

  void prepare(const View& view, const Culling& culling) override {
    DrawList& list = list_of(view);
    list.billboards.clear();
    std::vector<std::pair<float, std::size_t>> seen;
    for (std::size_t i = 0; i < trees_.size(); ++i)
      if (trees_[i].is_visible && atlas_.holds(trees_[i].tree.get()) &&
          culling.shows(first_thing_ + int(i), {false, is_newcomer_[i] != 0}) &&
          culling.may_see(bounds_[i]) && !culling.is_hidden(bounds_[i]))
        seen.emplace_back(glm::distance(bounds_[i].centre(), view.position_in_world), i);
    std::ranges::sort(seen, std::greater<>());
    for (const auto& [distance, i] : seen) add(i, view.position_in_world, culling, list.billboards);
    render::StreamBuffer& stream = view.kind == ViewKind::main ? main_stream_ : other_stream_;
    list.offset = stream.append(std::span<const DrawnBillboard>(list.billboards), 16);
  }

  void draw(const View& view, Pass pass) override {
    const DrawList& list = list_of(view);
    const bool blends = is_blended(view);
    if (pass != (blends ? Pass::blend : Pass::cutout) || list.billboards.empty()) return;
    const gl::Program* program = (blends ? blended_ : by_chance_).use(view);
    if (!program) return;
    glBindTextureUnit(render::first_drawable_unit, atlas_.texture());
    program->set("tree_texels", int(render::first_drawable_unit));
    glVertexArrayVertexBuffer(vertex_array_.name(), 0,
                              (view.kind == ViewKind::main ? main_stream_ : other_stream_).name(),
                              list.offset, sizeof(DrawnBillboard));
    glBindVertexArray(vertex_array_.name());
    glDisable(GL_CULL_FACE);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(list.billboards.size()));
  }

 private:
  TreeDrawable(int first_thing, ViewPrograms blended, ViewPrograms by_chance)
      : first_thing_(first_thing),
        blended_(std::move(blended)),
        by_chance_(std::move(by_chance)),
        main_stream_(1 << 22),
        other_stream_(1 << 22) {
    const GLuint array = vertex_array_.name();
    const auto attribute = [&](GLuint index, GLint size, std::size_t offset) {
      glEnableVertexArrayAttrib(array, index);
      glVertexArrayAttribFormat(array, index, size, GL_FLOAT, GL_FALSE, GLuint(offset));
      glVertexArrayAttribBinding(array, index, 0);
    };
    attribute(0, 4, offsetof(DrawnBillboard, centre));
    attribute(1, 3, offsetof(DrawnBillboard, half_right));
    attribute(2, 3, offsetof(DrawnBillboard, half_up));
    attribute(3, 4, offsetof(DrawnBillboard, slants));
    attribute(4, 4, offsetof(DrawnBillboard, base));
    glEnableVertexArrayAttrib(array, 5);
    glVertexArrayAttribIFormat(array, 5, 3, GL_UNSIGNED_INT, offsetof(DrawnBillboard, tiles_and_thing));
    glVertexArrayAttribBinding(array, 5, 0);
    attribute(6, 1, offsetof(DrawnBillboard, reach));
    attribute(7, 4, offsetof(DrawnBillboard, light_in_crown));
    glVertexArrayBindingDivisor(array, 0, 1);
  }

  /// Trees that are new.
  Status upload(const scene::Scene& scene) {
    std::vector<const TreeLevels*> distinct;
    for (const SceneTree& tree : scene_trees(scene)) distinct.push_back(tree.tree.get());
    std::ranges::sort(distinct);
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    if (distinct == uploaded_) return Done{};
    uploaded_ = distinct;
    crowns_ = {};
    Result<TreeAtlas> atlas = TreeAtlas::create(distinct);
    if (!atlas) return atlas.errors();
    atlas_ = *std::move(atlas);
    return Done{};
  }

  /// A tree's billboards, from back to front.
  void add(std::size_t i, glm::vec3 eye_in_world, const Culling& culling, std::vector<DrawnBillboard>& out) {
    const SceneTree& placed = trees_[i];
    const glm::mat4& world_from_tree = placed.world_from_tree;
    const glm::mat3 turn(world_from_tree);
    const float scale = std::max({glm::length(turn[0]), glm::length(turn[1]), glm::length(turn[2])});
    const float pixels_per_metre = scale * culling.pixels_per_metre(bounds_[i]);
    const std::size_t level = level_for(*placed.tree, pixels_per_metre, max_texel_pixels_);
    const BillboardTree& shown = placed.tree->levels[level];
    const glm::vec3 eye(glm::inverse(world_from_tree) * glm::vec4(eye_in_world, 1.0f));
    order_.back_to_front(shown.grid, eye, cells_);
    const glm::vec3 to_sun = glm::normalize(glm::inverse(turn) * to_sun_at(bounds_[i].centre()));
    const std::vector<float>& sun = crowns_.shares(*placed.tree, to_sun)[level];
    const std::vector<float>&albedo_factor = placed.tree->crown.albedo_factor[level],
          &sky = placed.tree->crown.sky[level];
    const glm::vec3 cell_size_m = shown.grid.cell_size_m();
    const float half_cell_pixels =
        0.5f * std::min({cell_size_m.x, cell_size_m.y, cell_size_m.z}) * pixels_per_metre;
    const float reach = 1.0f + std::clamp(margin_pixels / half_cell_pixels, min_margin, 1.0f);
    for (const std::uint32_t cell : cells_) {
      const glm::vec3 centre = shown.grid.centre(cell);
      const BillboardFrame frame = billboard_frame(centre, cell_size_m, eye);
      const ClosestViews closest = closest_views(shown, centre, frame.to_eye);
      DrawnBillboard& b = out.emplace_back();
      b.reach = reach;
      b.centre = glm::vec3(world_from_tree * glm::vec4(centre, 1.0f));
      b.second_share = closest.weights[1];
      b.half_right = turn * (frame.half_size_m.x * frame.right);
      b.half_up = turn * (frame.half_size_m.y * frame.up);
      b.slants = frame.slants;
      const glm::vec4 base = glm::vec4(shown.base[cell]) / 255.0f;
      b.base = glm::vec4(linear_from_srgb(glm::vec3(base)), base.w);
      for (int v = 0; v < 2; ++v)
        b.tiles_and_thing[v] =
            atlas_.tile(placed.tree.get(), level, std::size_t(closest.views[std::size_t(v)]), cell);
      b.tiles_and_thing.z = std::uint32_t(first_thing_) + std::uint32_t(i);
      b.light_in_crown = {albedo_factor[cell], sun[cell], sky[cell],
                          scale * way_out(placed.tree->box, centre, to_sun)};
    }
  }

  /// Unit.
  glm::vec3 to_sun_at(glm::vec3 in_world) const {
    return glm::normalize(sun_.spot ? sun_.spot->position - in_world : sun_.direction_to_sun);
  }

  DrawList& list_of(const View& view) { return view.kind == ViewKind::main ? main_list_ : other_list_; }

  int first_thing_;
  float max_texel_pixels_ = TreeDetail().max_texel_pixels;
  ViewPrograms blended_, by_chance_;
  gl::VertexArray vertex_array_ = gl::VertexArray::create();
  TreeAtlas atlas_;
  std::vector<const TreeLevels*> uploaded_;
  std::vector<SceneTree> trees_;  // as of the last update
  std::vector<Bounds> bounds_;
  std::vector<std::uint8_t> is_newcomer_;
  Bounds fixed_;
  render::FixedChange change_;
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

render::DrawableKind scene_trees_kind() {
  render::DrawableKind kind;
  kind.traced = traced_trees();
  kind.make = [](const scene::Scene& scene, int first_thing) {
    return TreeDrawable::create(scene, first_thing);
  };
  return kind;
}

}  // namespace parvis::trees
