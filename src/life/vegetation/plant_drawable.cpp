// Every view chooses forms and counts (plant_selection.h) and draws all plants with four calls: triangles of
// leaves, points, triangles of wood, lines. Nothing is allocated in a frame once the lists have their sizes.
//
// Limit: no occlusion culling within a plant, and mirrors with curved surfaces show a sample of coarse
// leaves.
#include "life/vegetation/plant_drawable.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "graphics/render/bindings.h"
#include "graphics/render/gpu_scene.h"
#include "graphics/render/screen_scale.h"
#include "graphics/render/static_things.h"
#include "graphics/render/stream_buffer.h"
#include "graphics/render/view_programs.h"
#include "life/vegetation/bark.h"
#include "life/vegetation/plant_buffers.h"
#include "life/vegetation/plant_selection.h"
#include "life/vegetation/scene_plant.h"
#include "scene/data/mip_levels.h"
#include "scene/data/sun_shadows.h"

namespace parvis::vegetation {
namespace {

using render::Culling, render::Pass, render::View, render::ViewKind, render::ViewPrograms;

/// Commands as glMultiDrawElementsIndirect and glMultiDrawArraysIndirect read them.
struct IndexedCommand {
  std::uint32_t count, instances, first_index;
  std::int32_t base_vertex;
  std::uint32_t record;
};
struct ArrayCommand {
  std::uint32_t count, instances, first, record;
};

/// The draw list of one view, and its memory: the main view's is its own, for other views are drawn between
/// its preparation and its drawing.
struct DrawList {
  PlantSelection selection;
  std::vector<PlantRecord> records;
  std::vector<IndexedCommand> leaves, wood;
  std::vector<ArrayCommand> points, lines;
  std::vector<std::uint32_t> commands;  ///< all of them
  render::StreamBuffer record_store{1 << 20}, command_store{1 << 18};
  GLintptr first_record = 0, first_leaf = 0, first_wood = 0, first_point = 0, first_line = 0;
  float pixels_at_w_1 = 1.0f;
};

gl::Texture upload(const scene::Texture& source) {
  gl::Texture texture = render::mipmapped(source, scene::smaller_mip_levels(source, 0));
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_T, GL_REPEAT);
  return texture;
}

PlantRecord record_of(const PlacedPlant& plant) {
  const glm::mat4 rows = glm::transpose(plant.world_from_plant);
  return {{rows[0], rows[1], rows[2]},
          {1.0f, 0.0f, 1.0f, plant.scale},
          {},
          {},
          {std::uint32_t(plant.thing), 0, 0, 0}};
}

/// Appends commands word by word; returns their offset in bytes.
template <class Command>
GLintptr append(const std::vector<Command>& commands, std::vector<std::uint32_t>& words) {
  const std::size_t first = words.size(), count = sizeof(Command) / sizeof(std::uint32_t) * commands.size();
  words.resize(first + count);
  if (count > 0) std::memcpy(words.data() + first, commands.data(), count * sizeof(std::uint32_t));
  return GLintptr(first * sizeof(std::uint32_t));
}

class PlantDrawable final : public render::Drawable {
 public:
  static Result<std::unique_ptr<render::Drawable>> create(const scene::Scene& scene, int first_thing) {
    std::unique_ptr<PlantDrawable> drawable(new PlantDrawable(first_thing));
    const auto link = [](ViewPrograms& programs, const char* vertex, const char* surface,
                         gl::Defines defines) -> Status {
      defines.emplace_back("IS_LEAF", "");
      Result<ViewPrograms> linked = ViewPrograms::create({vertex, surface, std::move(defines)});
      if (!linked) return linked.errors();
      programs = *std::move(linked);
      return Ok{};
    };
    constexpr const char *leaf = "life/vegetation/leaf_vertex.glsl",
                         *wood = "life/vegetation/wood_vertex.glsl",
                         *speck = "graphics/render/speck_surface.glsl";
    for (const Status& status :
         {link(drawable->leaf_programs_, leaf, "life/vegetation/leaf_material.glsl", {{"HAS_BACKS", ""}}),
          link(drawable->point_programs_, leaf, speck, {{"IS_POINT", ""}, {"IS_SPECK", ""}}),
          link(drawable->wood_programs_, wood, "life/vegetation/wood_material.glsl", {}),
          link(drawable->line_programs_, wood, speck, {{"IS_LINE", ""}, {"IS_SPECK", ""}})})
      if (!status) return status.errors();
    drawable->update(scene);
    return std::unique_ptr<render::Drawable>(std::move(drawable));
  }

  void renumber(int first_thing) override { first_thing_ = first_thing; }
  void update(const scene::Scene& scene) override {
    const std::vector<ScenePlant>& plants = scene_plants(scene);
    const bool is_new_detail = !(detail_ == scene.data<PlantDetail>());  // kept shadow maps show another
    detail_ = scene.data<PlantDetail>();
    const auto& shadows = scene.data<scene::SunShadows>();
    const std::vector<int>& makers = scene.data<ScenePlants>().makers;
    upload_shapes(plants);
    things_.begin_update(plants.size(), !is_new_detail);
    plants_.resize(plants.size());
    for (std::size_t i = 0; i < plants.size(); ++i) {
      const ScenePlant& plant = plants[i];
      const Bounds all = transformed(plant.world_from_plant, plant.shape->bounds);
      things_.update(i, {plant.shape.get(), plant.world_from_plant, plant.is_visible, all, all});
      plants_[i] = placed(plant, first_thing_ + int(i));
      plants_[i].is_newcomer = things_.is_newcomer(i);
      plants_[i].casts_shadow = shadows.casts_item_of(makers[i]);
    }
  }
  render::Extents extents() const override { return things_.extents(); }

  void prepare(const View& view, const Culling& culling) override {
    DrawList& list = list_of(view);
    list.selection.choose(plants_, view, culling, detail_);
    list.records.clear(), list.leaves.clear(), list.wood.clear(), list.points.clear(), list.lines.clear();
    for (const SelectedLeaves& part : list.selection.leaves()) add(part, list);
    for (const SelectedWood& part : list.selection.wood()) add(part, list);
    list.pixels_at_w_1 = render::ScreenScale(view).pixels_per_metre_at(1.0f);
    list.first_record = list.record_store.append(std::span<const PlantRecord>(list.records), 64);
    // In one piece: a store that is full is replaced, with all that was appended to it.
    list.commands.clear();
    const GLintptr leaf = append(list.leaves, list.commands), wood = append(list.wood, list.commands),
                   point = append(list.points, list.commands), line = append(list.lines, list.commands);
    const GLintptr first = list.command_store.append(std::span<const std::uint32_t>(list.commands), 4);
    list.first_leaf = first + leaf, list.first_wood = first + wood;
    list.first_point = first + point, list.first_line = first + line;
  }

  void draw(const View& view, Pass pass) override {
    const DrawList& list = list_of(view);
    if (pass != Pass::opaque || list.records.empty()) return;
    glDisable(GL_CULL_FACE);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, list.command_store.name());
    glBindTextureUnit(render::first_drawable_unit, bark_.name());
    const auto at = [](GLintptr offset) {
      // OpenGL takes the place in the bound buffer as a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr)
      return reinterpret_cast<const void*>(offset);
    };
    if (begin(view, list, wood_programs_, buffers_.wood(), list.wood.size()))
      glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, at(list.first_wood),
                                  GLsizei(list.wood.size()), 0);
    if (begin(view, list, leaf_programs_, buffers_.leaves(), list.leaves.size()))
      glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_SHORT, at(list.first_leaf),
                                  GLsizei(list.leaves.size()), 0);
    glEnable(GL_PROGRAM_POINT_SIZE);
    if (begin(view, list, point_programs_, buffers_.points(), list.points.size()))
      glMultiDrawArraysIndirect(GL_POINTS, at(list.first_point), GLsizei(list.points.size()), 0);
    glDisable(GL_PROGRAM_POINT_SIZE);
    glLineWidth(line_px);
    if (begin(view, list, line_programs_, buffers_.lines(), list.lines.size()))
      glMultiDrawArraysIndirect(GL_LINES, at(list.first_line), GLsizei(list.lines.size()), 0);
    glLineWidth(1.0f);
  }

 private:
  explicit PlantDrawable(int first_thing) : first_thing_(first_thing), bark_(upload(bark_texture())) {}

  void upload_shapes(const std::vector<ScenePlant>& plants) {
    const auto is_missing = [&](const ScenePlant& plant) { return !buffers_.find(plant.shape.get()); };
    if (std::ranges::none_of(plants, is_missing)) return;
    PlantBuffers::Shapes shapes;
    for (const ScenePlant& plant : plants) shapes.push_back(plant.shape);
    std::ranges::sort(shapes);
    shapes.erase(std::unique(shapes.begin(), shapes.end()), shapes.end());
    buffers_ = PlantBuffers(std::move(shapes));
  }

  bool begin(const View& view, const DrawList& list, const ViewPrograms& programs, GLuint array,
             std::size_t commands) const {
    const gl::Program* program = commands > 0 ? programs.use(view) : nullptr;
    if (!program) return false;
    if (program->declares("bark_texture")) program->set("bark_texture", int(render::first_drawable_unit));
    if (program->declares("pixels_at_w_1")) {  // of leaves
      program->set("pixels_at_w_1", list.pixels_at_w_1);
      program->set("min_point_px", view.kind == ViewKind::shadow ? 0.0f : 1.0f);
    }
    glVertexArrayVertexBuffer(array, 1, list.record_store.name(), list.first_record, sizeof(PlantRecord));
    glBindVertexArray(array);
    return true;
  }

  /// Leaves of a cluster or a plant: real ones, then coarse ones, then points.
  void add(const SelectedLeaves& part, DrawList& list) const {
    const PlacedPlant& plant = plants_[part.plant];
    const PlantShape& shape = *plant.shape;
    const PlantKind& kind = shape.kind();
    const ShapeRange& range = *buffers_.find(&shape);
    const auto record = std::uint32_t(list.records.size());
    list.records.push_back(record_of(plant));
    PlantRecord& said = list.records.back();
    const float shown = part.shares.shown;
    said.shown = {shown, fading_share(shown), detail_.keeps_area ? std::sqrt(area_growth(shown)) : 1.0f,
                  plant.scale};
    said.dark = {kind.dark, kind.veins};
    said.light = {kind.light, std::floor(256.0f * kind.translucency) + kind.roughness};
    if (part.cluster < 0) {
      const auto count = std::uint32_t(std::ceil(shown * float(shape.leaves.size())));
      if (count > 0) list.points.push_back({count, 1, range.points, record});
      return;
    }
    const LeafCluster& cluster = shape.clusters[std::size_t(part.cluster)];
    const std::uint32_t full = cluster_end(shape, cluster, part.shares.full),
                        simple = cluster_end(shape, cluster, part.shares.simple),
                        last = cluster_end(shape, cluster, shown);
    const auto add_triangles = [&](std::uint32_t from, std::uint32_t to, bool is_full) {
      const LeafTemplate& form = is_full ? full_leaf(kind.leaf) : simple_leaf(kind.leaf);
      if (to > from)
        list.leaves.push_back(
            {(to - from) * std::uint32_t(form.indices.size()), 1,
             PlantBuffers::first_index(kind.leaf, is_full),
             std::int32_t((is_full ? range.full : range.simple) + from * std::uint32_t(form.points.size())),
             record});
    };
    add_triangles(cluster.first, full, true);
    add_triangles(full, simple, false);
    if (last > simple) list.points.push_back({last - simple, 1, range.clustered_points + simple, record});
  }

  void add(const SelectedWood& part, DrawList& list) const {
    const PlacedPlant& plant = plants_[part.plant];
    const PlantShape& shape = *plant.shape;
    const ShapeRange& range = *buffers_.find(&shape);
    const auto record = std::uint32_t(list.records.size());
    list.records.push_back(record_of(plant));
    list.records.back().dark = {shape.kind().bark, 0.0f};
    if (part.shares.pieces > 0)
      list.wood.push_back(
          {shape.pieces[part.shares.pieces - 1].end, 1, range.wood_index, std::int32_t(range.wood), record});
    if (part.shares.twigs > 0) list.lines.push_back({2 * part.shares.twigs, 1, range.lines, record});
  }

  DrawList& list_of(const View& view) { return view.kind == ViewKind::main ? main_list_ : other_list_; }

  int first_thing_;
  ViewPrograms leaf_programs_, point_programs_, wood_programs_, line_programs_;
  gl::Texture bark_;
  PlantBuffers buffers_;
  PlantDetail detail_;
  std::vector<PlacedPlant> plants_;  // as of the last update
  render::StaticThings things_;
  DrawList main_list_, other_list_;
};

}  // namespace

render::DrawableKind scene_plants_kind() {
  render::DrawableKind kind;
  kind.traced = traced_plants();
  kind.make = [](const scene::Scene& scene, int first_thing) {
    return PlantDrawable::create(scene, first_thing);
  };
  return kind;
}

}  // namespace parvis::vegetation
