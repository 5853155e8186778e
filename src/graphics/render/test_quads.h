// The second drawable, for the tests of all rooms that show or trace drawables: textured quads with holes,
// whose colour depends on the viewing direction.
#pragma once

#include "base/image.h"
#include "graphics/render/bindings.h"
#include "graphics/render/drawables.h"
#include "graphics/render/view_programs.h"
#include "graphics/shading/glsl.h"

namespace parvis::render {

/// One quad of the scene.
struct TestQuad {
  glm::mat4 world_from_quad{1.0f};  ///< the quad is -1..1 in x and y, seen from +z
  bool is_dynamic = false, is_visible = true;
};

/// The quads of a scene. They belong to the test, which may change them while the scene is shown.
using TestQuads = std::vector<TestQuad>;

namespace test_quads_shared {
using namespace parvis::shading;
#include "graphics/render/test_quads_shared.glsl"
}  // namespace test_quads_shared

/// The quads' texture, 8x8 texels without filtering: red and green increase with x and y; alpha cuts out the
/// four corners.
inline Image8 test_quad_texture() {
  Image8 image(8, 8, 4);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      std::uint8_t* texel = image.at(x, y);
      texel[0] = std::uint8_t(32 * x), texel[1] = std::uint8_t(32 * y), texel[2] = (x + y) % 2 ? 200 : 40;
      const bool is_corner = (x < 2 || x > 5) && (y < 2 || y > 5);
      texel[3] = is_corner ? 0 : 255;
    }
  return image;
}

/// The quad in its own frame, finely tessellated: curved mirrors reflect vertices and connect them by
/// straight edges.
inline Mesh test_quad_mesh() {
  constexpr int cells = 24;
  Mesh mesh;
  for (int y = 0; y <= cells; ++y)
    for (int x = 0; x <= cells; ++x) {
      const glm::vec2 uv(float(x) / cells, float(y) / cells);
      mesh.positions.emplace_back(2.0f * uv - 1.0f, 0.0f);
      mesh.normals.emplace_back(0.0f, 0.0f, 1.0f);
      mesh.uvs.push_back(uv);
    }
  for (int y = 0; y < cells; ++y)
    for (int x = 0; x < cells; ++x) {
      const auto at = [&](int i, int j) { return std::uint32_t((y + j) * (cells + 1) + x + i); };
      for (const std::uint32_t corner : {at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1)})
        mesh.indices.push_back(corner);
    }
  return mesh;
}

/// The quad's surface for the ray tracer.
class TestQuadSurface final : public scene::TracedSurface {
 public:
  scene::TracedPoint point(const scene::TracedHit& hit) const override {
    const std::uint8_t* texel = texel_at(hit.uv);
    scene::TracedPoint point;
    point.normal = hit.normal;
    point.base_colour = glm::vec3(texel[0], texel[1], texel[2]) / 255.0f;
    point.roughness = 1.0f;
    point.emission = test_quads_shared::emission_toward(hit.to_viewer);
    return point;
  }
  float alpha(const scene::TracedHit& hit) const override { return float(texel_at(hit.uv)[3]) / 255.0f; }
  scene::Alpha alpha_mode() const override { return scene::Alpha::cutout; }

 private:
  const std::uint8_t* texel_at(glm::vec2 uv) const {
    const glm::ivec2 texel = glm::clamp(glm::ivec2(glm::floor(8.0f * uv)), 0, 7);
    return texture_.at(texel.x, texel.y);
  }
  Image8 texture_ = test_quad_texture();
};

/// The quads' drawable; all are drawn in the cutout pass.
class TestQuadDrawable final : public Drawable {
 public:
  /// `quads` must outlive the drawable; fails only if a shader does not compile.
  static Result<std::unique_ptr<Drawable>> create(const TestQuads& quads, int first_thing) {
    Result<ViewPrograms> programs = ViewPrograms::create({"graphics/render/test_quads_vertex.glsl",
                                                          "graphics/render/test_quads_surface.glsl",
                                                          {{"HAS_HOLES", ""}, {"HAS_BACKS", ""}}});
    if (!programs) return programs.errors();
    return std::unique_ptr<Drawable>(new TestQuadDrawable(quads, first_thing, *std::move(programs)));
  }

  void update(const scene::Scene&) override {
    change_ = {};
    moving_.clear();
    for (std::size_t i = 0; i < quads_.size(); ++i) {
      const TestQuad& quad = quads_[i];
      Bounds bounds = transformed(quad.world_from_quad, {glm::vec3(-1, -1, 0), glm::vec3(1, 1, 0)});
      if (!quad.is_visible) bounds = {};
      if (quad.is_dynamic && quad.is_visible) moving_.push_back(bounds);
      is_newcomer_[i] = !quad.is_dynamic && bounds.min != bounds_[i].min;
      if (is_newcomer_[i]) {
        if (!bounds_[i].empty()) change_.gone.push_back(bounds_[i]);
        if (!bounds.empty()) change_.come.push_back(bounds);
      }
      if (!quad.is_dynamic) fixed_.add(bounds);
      bounds_[i] = bounds;
    }
  }
  void renumber(int first_thing) override { first_thing_ = first_thing; }
  Extents extents() const override { return {fixed_, moving_, {}, bounds_, &change_}; }

  void prepare(const View& view, const Culling& culling) override {
    std::vector<std::size_t>& list = list_of(view);
    list.clear();
    for (std::size_t i = 0; i < quads_.size(); ++i)
      if (quads_[i].is_visible &&
          culling.shows(first_thing_ + int(i), {quads_[i].is_dynamic, is_newcomer_[i] != 0}) &&
          culling.may_see(bounds_[i]) && !culling.is_hidden(bounds_[i]))
        list.push_back(i);
  }

  void draw(const View& view, Pass pass) override {
    if (pass != Pass::cutout || list_of(view).empty()) return;
    const gl::Program* program = programs_.use(view);
    if (!program) return;
    glBindVertexArray(vertex_array_.name());
    glBindTextureUnit(first_drawable_unit, texture_.name());
    program->set("quad_texture", int(first_drawable_unit));
    glDisable(GL_CULL_FACE);
    for (const std::size_t i : list_of(view)) {
      program->set("world_from_quad", quads_[i].world_from_quad);
      program->set("quad_object", first_thing_ + int(i));
      glDrawElements(GL_TRIANGLES, GLsizei(mesh_.indices.size()), GL_UNSIGNED_INT, nullptr);
    }
  }

  /// Indices of the quads that the main view drew.
  const std::vector<std::size_t>& drawn() const { return main_list_; }

 private:
  TestQuadDrawable(const TestQuads& quads, int first_thing, ViewPrograms programs)
      : quads_(quads),
        first_thing_(first_thing),
        programs_(std::move(programs)),
        vertices_(gl::immutable_buffer(std::span<const glm::vec3>(mesh_.positions))),
        indices_(gl::immutable_buffer(std::span<const std::uint32_t>(mesh_.indices))),
        bounds_(quads.size()),
        is_newcomer_(quads.size()) {
    const GLuint array = vertex_array_.name();
    glVertexArrayVertexBuffer(array, 0, vertices_.name(), 0, sizeof(glm::vec3));
    glVertexArrayElementBuffer(array, indices_.name());
    glEnableVertexArrayAttrib(array, 0);
    glVertexArrayAttribFormat(array, 0, 3, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(array, 0, 0);
    const Image8 image = test_quad_texture();
    texture_ = gl::texture_2d(GL_RGBA8, 8, 8);
    glTextureParameteri(texture_.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(texture_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTextureSubImage2D(texture_.name(), 0, 0, 0, 8, 8, GL_RGBA, GL_UNSIGNED_BYTE, image.pixels.data());
    update({});
  }
  std::vector<std::size_t>& list_of(const View& view) {
    return view.kind == ViewKind::main ? main_list_ : other_list_;
  }

  const TestQuads& quads_;
  int first_thing_;
  ViewPrograms programs_;
  Mesh mesh_ = test_quad_mesh();
  gl::Buffer vertices_, indices_;
  gl::VertexArray vertex_array_ = gl::VertexArray::create();
  gl::Texture texture_;
  Bounds fixed_;
  std::vector<Bounds> bounds_, moving_;
  std::vector<std::uint8_t> is_newcomer_;
  FixedChange change_;
  std::vector<std::size_t> main_list_, other_list_;
};

/// The registered kind; `quads` must outlive everything made of it.
inline DrawableKind test_quads_kind(const TestQuads& quads) {
  DrawableKind kind;
  kind.traced.name = "test quads";
  kind.traced.count = [&quads](const scene::Scene&) { return int(quads.size()); };
  kind.traced.trace = [&quads](const scene::Scene&, scene::TracedScene& traced) {
    const auto mesh = std::make_shared<const Mesh>(test_quad_mesh());
    const auto surface = std::make_shared<const TestQuadSurface>();
    for (std::size_t i = 0; i < quads.size(); ++i)
      traced.add(mesh, surface, quads[i].world_from_quad,
                 {int(i), quads[i].is_dynamic, quads[i].is_visible, true});
  };
  kind.make = [&quads](const scene::Scene&, int first_thing) {
    return TestQuadDrawable::create(quads, first_thing);
  };
  return kind;
}

}  // namespace parvis::render
