#include "graphics/render/scene_drawable.h"

#include <algorithm>
#include <bit>

#include "graphics/render/bindings.h"
#include "graphics/render/foliage_levels.h"
#include "graphics/render/mesh_levels.h"

namespace parvis::render {
namespace {

gl::VertexArray make_vertex_array() {
  gl::VertexArray array = gl::VertexArray::create();
  const GLuint name = array.name();
  const auto attribute = [&](GLuint index, GLint size, GLuint offset, GLuint binding) {
    glEnableVertexArrayAttrib(name, index);
    glVertexArrayAttribFormat(name, index, size, GL_FLOAT, GL_FALSE, offset);
    glVertexArrayAttribBinding(name, index, binding);
  };
  attribute(0, 3, 0, 0);   // position
  attribute(1, 3, 12, 0);  // normal
  attribute(2, 2, 24, 0);  // uv
  attribute(9, 1, 32, 0);  // openness
  for (GLuint row = 0; row < 3; ++row) attribute(3 + row, 4, 16 * row, 1);
  glEnableVertexArrayAttrib(name, 6);
  glVertexArrayAttribIFormat(name, 6, 1, GL_UNSIGNED_INT, 48);  // object
  glVertexArrayAttribBinding(name, 6, 1);
  glEnableVertexArrayAttrib(name, 7);
  glVertexArrayAttribIFormat(name, 7, 2, GL_INT, offsetof(Item::Record, vertex_data));
  glVertexArrayAttribBinding(name, 7, 1);
  glEnableVertexArrayAttrib(name, 8);
  glVertexArrayAttribIFormat(name, 8, 2, GL_INT, offsetof(Item::Record, first_light));
  glVertexArrayAttribBinding(name, 8, 1);
  glVertexArrayBindingDivisor(name, 1, 1);
  return array;
}

/// The buffers of the geometry, which are others when it has grown.
void attach_geometry(const gl::VertexArray& array, const GpuScene& gpu) {
  glVertexArrayVertexBuffer(array.name(), 0, gpu.vertex_buffer(), 0, sizeof(GpuGeometry::Vertex));
  glVertexArrayElementBuffer(array.name(), gpu.index_buffer());
  if (gpu.detail_buffer() == 0) return;
  const auto attribute = [&](GLuint index, GLint size, GLuint offset) {
    glEnableVertexArrayAttrib(array.name(), index);
    glVertexArrayAttribFormat(array.name(), index, size, GL_FLOAT, GL_FALSE, offset);
    glVertexArrayAttribBinding(array.name(), index, 2);
  };
  glVertexArrayVertexBuffer(array.name(), 2, gpu.detail_buffer(), 0, sizeof(GpuGeometry::Detail));
  attribute(10, 4, 0);   // colour; without the buffer its alpha is 1, OpenGL's default
  attribute(11, 2, 16);  // second uv
}

// Of a surface that stands beside its place, in pixels.
constexpr float max_error_px = 0.25f, max_mirror_error_px = 0.1f;

/// How much larger a mesh stands in the world, along the edge of its frame that grows most.
float size_of(const Item::Record& record) {
  float maximum = 0.0f;
  for (int edge = 0; edge < 3; ++edge)
    maximum = std::max(
        maximum, glm::length(glm::vec3(record.rows[0][edge], record.rows[1][edge], record.rows[2][edge])));
  return maximum;
}

}  // namespace

Result<SceneDrawable> SceneDrawable::create(const scene::Scene& scene) {
  GpuScene gpu(scene);
  Programs programs;
  Result<SurfacePrograms> surface = SurfacePrograms::create({}, gpu.materials());
  if (!surface) return surface.errors();
  programs.surface = *std::move(surface);
  const auto make = [](const char* vertex, const char* fragment, gl::Program& program) -> Status {
    Result<gl::Program> made = gl::Program::create(vertex, fragment);
    if (!made) return made.errors();
    program = *std::move(made);
    assign_bindings(program);
    return Ok{};
  };
  for (const Status& status :
       {make("graphics/render/depth.vert", "graphics/render/depth.frag", programs.depth),
        make("graphics/render/depth.vert", "graphics/render/solid_depth.frag", programs.solid_depth),
        make("graphics/render/depth.vert", "graphics/render/picking.frag", programs.picking)})
    if (!status) return status.errors();
  return SceneDrawable(std::move(gpu), std::move(programs));
}

SceneDrawable::SceneDrawable(GpuScene gpu, Programs programs)
    : gpu_(std::move(gpu)), programs_(std::move(programs)), vertex_array_(make_vertex_array()) {
  attach_geometry(vertex_array_, gpu_);
}

void SceneDrawable::update(const scene::Scene& scene) {
  gpu_.update(scene);
  attach_geometry(vertex_array_, gpu_);
}

Extents SceneDrawable::extents() const {
  return {gpu_.fixed_bounds(), gpu_.moving_bounds(), gpu_.bodies(), gpu_.object_bounds(),
          &gpu_.fixed_change()};
}

Status SceneDrawable::set_reflection(SurfaceShader* shader) {
  reflection_ = nullptr;
  if (shader && !shader->programs_) {
    Result<SurfacePrograms> made = SurfacePrograms::create(shader->source(), gpu_.mirror_materials());
    if (!made) return made.errors();
    shader->programs_ = *std::move(made);
  }
  reflection_ = shader;
  return Ok{};
}

/// The room above shades mirrors in the main view alone: in others they show the sky, or what a room's own
/// programs show.
bool SceneDrawable::is_mirror_in(const View& view, const Item& item) const {
  return item.is_mirror && reflection_ && view.kind == ViewKind::main;
}

/// The coarsest level that looks like the mesh. Reflections show errors of a surface enlarged.
int SceneDrawable::level_of(const Item& item, const Culling& culling) const {
  const std::span<const LevelRange> levels = gpu_.levels_of(gpu_.parts()[std::size_t(item.part)]);
  if (levels.empty()) return 0;
  const float max_error_m =
      (item.is_mirror ? max_mirror_error_px : max_error_px) / culling.pixels_per_metre(item.bounds);
  const float size = size_of(item.record);
  const auto too_coarse = std::ranges::find_if(
      levels, [&](const LevelRange& level) { return level.error_m * size > max_error_m; });
  return int(too_coarse - levels.begin());
}

/// Pass; then what both faces show of, mirrors by object, material, part and level: neighbours in this order
/// share a draw. What blends is ordered from back to front instead.
std::uint64_t SceneDrawable::sort_key(const Item& item, int level, const View& view) const {
  const PartRange& part = gpu_.parts()[std::size_t(item.part)];
  const GpuMaterial& material = gpu_.materials()[std::size_t(part.material)];
  const std::uint64_t pass = std::uint64_t(material.pass) << 62;
  static_assert(max_mesh_levels < 8 && max_foliage_levels < 8);
  const std::uint64_t mesh = std::uint64_t(item.part) << 3 | std::uint64_t(level);
  if (material.pass == Pass::blend) {
    const float distance_m = glm::distance(item.bounds.centre(), view.position_in_world);
    return pass | (std::uint64_t(~std::bit_cast<std::uint32_t>(distance_m)) << 22) | mesh;
  }
  return pass | (std::uint64_t(material.is_double_sided) << 61) |
         (std::uint64_t(is_mirror_in(view, item) ? item.object + 1 : 0) << 42) |
         (std::uint64_t(part.material) << 22) | mesh;
}

/// Dynamic objects only when near: an occluder must look larger than what it hides.
void SceneDrawable::sort(ViewList& list) {
  std::ranges::sort(list.order, {},
                    [](const ViewList::Entry& entry) { return std::pair(entry.key, entry.item); });
}

bool SceneDrawable::refracts(const Item& item) const {
  const PartRange& part = gpu_.parts()[std::size_t(item.part)];
  return (gpu_.materials()[std::size_t(part.material)].features & surface_is_glass) != 0;
}

void SceneDrawable::gather(const View& view, const Culling& culling, ViewList& list) {
  list.order.clear();
  list.statistics = {};
  const std::vector<Item>& items = gpu_.items();
  for (std::size_t i = 0; i < items.size(); ++i) {
    const Item& item = items[i];
    const bool is_left_out =  // of a mirror that is seen in itself, what does not mirror is shown
        item.object == view.excluded_object && (view.kind != ViewKind::mirrored || item.is_mirror);
    if (is_left_out || std::ranges::count(view.left_out_items, std::uint32_t(i)) > 0) continue;
    if (!view.shows_glass && refracts(item)) continue;
    const Standing standing{gpu_.is_moving(item.object), gpu_.is_newcomer(item.object)};
    if (!gpu_.is_visible(item.object) || !culling.shows(item.object, standing)) continue;
    if (view.kind == ViewKind::shadow && !item.casts_shadow) continue;
    if (!culling.may_see(item.bounds)) continue;
    ++list.statistics.items_in_frustum;
    if (culling.is_hidden(item.bounds)) {
      ++list.statistics.items_hidden;
      continue;
    }
    const int level =
        view.kind == ViewKind::mirrored || view.kind == ViewKind::picking ? 0 : level_of(item, culling);
    list.order.push_back({sort_key(item, level, view), int(i), level});
    if (view.kind == ViewKind::mirrored) list.order.back().vertex_data = view.virtual_vertices->add(item);
  }
  sort(list);
}

/// Gathers the mirrors that the main view shows: the nearest in each pixel, be it of glass.
void SceneDrawable::gather_mirrors(const View& view, ViewList& list) const {
  constexpr std::uint64_t below_pass = (std::uint64_t(1) << 62) - 1;
  list.order.clear();
  list.statistics = {};
  for (const ViewList::Entry& entry : main_list_.order) {
    const Item& item = gpu_.items()[std::size_t(entry.item)];
    if (item.is_mirror && view.shows(item.object))
      list.order.push_back({sort_key(item, entry.level, view) & below_pass, entry.item, entry.level});
  }
  sort(list);
}

void SceneDrawable::batch(const View& view, ViewList& list) const {
  list.records.clear();
  list.commands.clear();
  for (std::vector<Batch>& batches : list.batches) batches.clear();
  for (const auto& [key, index, level, vertex_data] : list.order) {
    const Item& item = gpu_.items()[std::size_t(index)];
    const PartRange& part = gpu_.parts()[std::size_t(item.part)];
    const MeshRange& mesh =
        level == 0 ? part : static_cast<const MeshRange&>(gpu_.levels_of(part)[std::size_t(level - 1)]);
    const int mirror_object = is_mirror_in(view, item) ? item.object : -1;
    std::vector<Batch>& batches = list.batches[key >> 62];
    if (batches.empty() || batches.back().material != part.material ||
        batches.back().mirror_object != mirror_object)
      batches.push_back({part.material, mirror_object, std::uint32_t(list.commands.size()), 0});
    if (batches.back().command_count > 0 && list.commands.back().first_index == mesh.first_index &&
        list.commands.back().count == mesh.index_count) {
      ++list.commands.back().instances;
    } else {
      list.commands.push_back(
          {mesh.index_count, 1, mesh.first_index, mesh.base_vertex, std::uint32_t(list.records.size())});
      ++batches.back().command_count;
    }
    list.records.push_back(item.record);
    list.records.back().vertex_data = vertex_data;
    list.statistics.triangles += mesh.index_count / 3;
  }
  list.statistics.draws = int(list.commands.size());
}

void SceneDrawable::prepare(const View& view, const Culling& culling) {
  ViewList& list = view.kind == ViewKind::main ? main_list_ : other_list_;
  if (view.kind == ViewKind::mirrors)
    gather_mirrors(view, list);
  else
    gather(view, culling, list);
  batch(view, list);
  list.first_record = list.record_store.append(std::span<const Item::Record>(list.records), 64);
  list.first_command = list.command_store.append(std::span<const Command>(list.commands), 4);
  if (view.kind == ViewKind::mirrored) view.virtual_vertices->prepare();
  if (view.kind != ViewKind::main) return;
  visible_objects_.clear();
  for (const ViewList::Entry& entry : list.order)
    visible_objects_.push_back(gpu_.items()[std::size_t(entry.item)].object);
  std::sort(visible_objects_.begin(), visible_objects_.end());
  visible_objects_.erase(std::unique(visible_objects_.begin(), visible_objects_.end()),
                         visible_objects_.end());
}

void SceneDrawable::draw_commands(const ViewList& list, std::uint32_t first, std::uint32_t count) const {
  const std::size_t offset = std::size_t(list.first_command) + sizeof(Command) * first;
  // OpenGL takes the place in the bound buffer as a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr)
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, reinterpret_cast<const void*>(offset),
                              GLsizei(count), 0);
}

/// Geometry without holes needs no material to draw its depth: two calls at most.
void SceneDrawable::draw_depth(const ViewList& list) const {
  programs_.solid_depth.use();
  const std::vector<Batch>& batches = list.batches[std::size_t(Pass::opaque)];
  for (std::size_t i = 0, next; i < batches.size(); i = next) {
    const bool is_double_sided = gpu_.materials()[std::size_t(batches[i].material)].is_double_sided;
    std::uint32_t commands = 0;
    for (next = i; next < batches.size(); ++next) {
      if (gpu_.materials()[std::size_t(batches[next].material)].is_double_sided != is_double_sided) break;
      commands += batches[next].command_count;
    }
    GpuScene::cull_faces(!is_double_sided);
    draw_commands(list, batches[i].first_command, commands);
  }
}

const gl::Program& SceneDrawable::program_for(const View& view, const Batch& batch) const {
  if (view.kind == ViewKind::shadow) return programs_.depth;
  if (view.kind == ViewKind::picking) return programs_.picking;
  if (view.kind == ViewKind::mirrored)
    return view.virtual_vertices->program_of(gpu_.materials()[std::size_t(batch.material)]);
  if (view.kind == ViewKind::mirrors)
    return view.surface_programs->of(gpu_.materials()[std::size_t(batch.material)], false);
  const SurfacePrograms& programs = batch.mirror_object >= 0 ? *reflection_->programs_ : programs_.surface;
  return programs.of(gpu_.materials()[std::size_t(batch.material)],
                     view.kind == ViewKind::main && !view.has_one_sample);
}

void SceneDrawable::draw(const View& view, Pass pass) {
  const ViewList& list = list_of(view);
  const std::vector<Batch>& batches = list.batches[std::size_t(pass)];
  if (batches.empty()) return;
  glVertexArrayVertexBuffer(vertex_array_.name(), 1, list.record_store.name(), list.first_record,
                            sizeof(Item::Record));
  glBindVertexArray(vertex_array_.name());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, list.command_store.name());
  if (view.kind == ViewKind::shadow && pass == Pass::opaque) return draw_depth(list);

  if (view.has_one_sample &&
      pass == Pass::opaque) {  // then hidden surfaces are not shaded: see the experiment
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    draw_depth(list);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  }
  gpu_.bind_vertex_light();
  const gl::Program* current = nullptr;
  for (const Batch& batch : batches) {
    const gl::Program& program = program_for(view, batch);
    if (current != &program) {
      program.use();
      if (view.kind == ViewKind::mirrored) view.virtual_vertices->bind(program);
    }
    current = &program;
    if (batch.mirror_object >= 0) reflection_->bind(program, batch.mirror_object);
    gpu_.bind_material(batch.material);
    if (view.kind == ViewKind::mirrored) GpuScene::cull_faces(false);
    draw_commands(list, batch.first_command, batch.command_count);
  }
}

}  // namespace parvis::render
