#include "graphics/realism/edge_lines.h"

#include <algorithm>
#include <cstddef>

#include "base/parallel.h"
#include "graphics/realism/feature_edges.h"
#include "graphics/render/bindings.h"
#include "graphics/shading/realism.h"
#include "scene/data/realism.h"

namespace parvis::realism {
namespace {

/// GL_INT_2_10_10_10_REV, normalised; the two bits of w: -1 for a mark.
std::uint32_t packed(const glm::vec3& normal, bool is_marked) {
  const auto bits = [](float value) {
    return std::uint32_t(int(std::lround(511.0f * std::clamp(value, -1.0f, 1.0f)))) & 0x3ffu;
  };
  return bits(normal.x) | bits(normal.y) << 10 | bits(normal.z) << 20 | (is_marked ? 3u : 0u) << 30;
}

gl::VertexArray make_vertex_array() {
  gl::VertexArray array = gl::VertexArray::create();
  const auto attribute = [&](GLuint index, GLint size, GLenum type, GLuint offset) {
    glEnableVertexArrayAttrib(array.name(), index);
    glVertexArrayAttribFormat(array.name(), index, size, type, type != GL_FLOAT, offset);
    glVertexArrayAttribBinding(array.name(), index, 0);
  };
  attribute(0, 3, GL_FLOAT, 0);
  attribute(1, 3, GL_FLOAT, 12);
  attribute(2, 4, GL_INT_2_10_10_10_REV, 24);
  attribute(3, 4, GL_INT_2_10_10_10_REV, 28);
  glVertexArrayBindingDivisor(array.name(), 0, 1);
  return array;
}

/// Ink fades out where its lines would lie closer than these distances apart, pixels.
float share_at(float distance_px, float none_px, float all_px) {
  const float t = std::clamp((distance_px - none_px) / (all_px - none_px), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

glm::mat4 world_from_mesh(const render::Item& item) {
  const glm::vec4* rows = item.record.rows;
  return glm::transpose(glm::mat4(rows[0], rows[1], rows[2], glm::vec4(0, 0, 0, 1)));
}

}  // namespace

Result<std::unique_ptr<EdgeLines>> EdgeLines::create(const render::GpuScene& gpu) {
  Result<gl::Program> program =
      gl::Program::create("graphics/realism/edge_lines.vert", "graphics/realism/edge_lines.frag");
  if (!program) return program.errors();
  render::assign_bindings(*program);
  return std::unique_ptr<EdgeLines>(new EdgeLines(gpu, *std::move(program)));
}

EdgeLines::EdgeLines(const render::GpuScene& gpu, gl::Program program)
    : gpu_(gpu), program_(std::move(program)), vertex_array_(make_vertex_array()) {}

std::size_t EdgeLines::add(const scene::Model& model) {
  static_assert(sizeof(Record) == 32);
  const std::size_t first_range = ranges_.size();
  for (const PartEdges& part : feature_edges(model)) {
    ranges_.push_back({std::uint32_t(records_.size()), std::uint32_t(part.edges.size()), part.spacing_m});
    for (const Edge& edge : part.edges)
      records_.push_back({edge.from, edge.to, packed(edge.normal, edge.is_drawn_always),
                          packed(edge.other_normal, edge.is_drawn_always)});
  }
  return first_range;
}

void EdgeLines::update(const scene::Scene& scene) {
  ink_ = shading::ink_at(scene.data<scene::Realism>().level);
  if (ink_ <= 0.0f) return;
  const std::size_t known = records_.size();
  for (std::size_t o = first_range_.size(); o < scene.objects.size(); ++o) {
    const scene::Model& model = *scene.objects[o].model;
    const auto [found, is_new] = first_range_of_model_.try_emplace(&model, 0);
    if (is_new) found->second = add(model);
    first_range_.push_back(found->second);
  }
  if (records_.size() == known) return;
  buffer_ = gl::immutable_buffer(std::span<const Record>(records_));
  glVertexArrayVertexBuffer(vertex_array_.name(), 0, buffer_.name(), 0, sizeof(Record));
}

void EdgeLines::prepare(const render::View& view, const render::Culling& culling) {
  if (view.kind != render::ViewKind::main) return;
  draws_.clear();
  if (ink_ <= 0.0f) return;
  for (std::size_t i = 0; i < gpu_.items().size(); ++i) {
    const render::Item& item = gpu_.items()[i];
    if (std::size_t(item.object) >= first_range_.size()) break;
    const std::size_t part = i - gpu_.first_item(item.object);
    const Range& range = ranges_[first_range_[std::size_t(item.object)] + part];
    if (range.count == 0 || !gpu_.is_visible(item.object) ||
        !culling.shows(item.object, {gpu_.is_moving(item.object), gpu_.is_newcomer(item.object)}) ||
        !culling.may_see(item.bounds) || culling.is_hidden(item.bounds))
      continue;
    const float pixels_per_metre = culling.pixels_per_metre(item.bounds);
    const float crease_share = share_at(pixels_per_metre * range.spacing_m, 1.5f, 5.0f);
    const float outline_share = share_at(pixels_per_metre * glm::length(item.bounds.size()), 4.0f, 14.0f);
    if (crease_share > 0.0f || outline_share > 0.0f)
      draws_.push_back({i, range, crease_share, outline_share});
  }
}

void EdgeLines::draw(const render::View& view, render::Pass pass) {
  if (view.kind != render::ViewKind::main || pass != render::Pass::blend || ink_ <= 0.0f) return;
  glBindVertexArray(vertex_array_.name());
  program_.use();
  render::GpuScene::cull_faces(false);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);
  // Cut-out surfaces have left their coverage in alpha: all of the picture is bare at first.
  const GLfloat bare[4]{0.0f, 0.0f, 0.0f, 1.0f};
  glClearBufferfv(GL_COLOR, 0, bare);
  glBlendFuncSeparate(GL_ZERO, GL_ONE, GL_ZERO, GL_ONE_MINUS_SRC_ALPHA);
  for (const Draw& line : draws_) {
    const render::Item& item = gpu_.items()[line.item];
    for (GLuint row = 0; row < 3; ++row) glVertexAttrib4fv(4 + row, &item.record.rows[row].x);
    const glm::vec3 eye(glm::inverse(world_from_mesh(item)) * glm::vec4(view.position_in_world, 1.0f));
    glVertexAttrib4f(7, eye.x, eye.y, eye.z, line.crease_share);
    glVertexAttrib4f(8, line.outline_share, ink_, 0.0f, 0.0f);
    glDrawArraysInstancedBaseInstance(GL_TRIANGLE_STRIP, 0, 4, GLsizei(line.range.count), line.range.first);
  }
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

}  // namespace parvis::realism
