#include "bench/facades/plain_texture.h"

#include <cmath>

#include "base/bounds.h"
#include "base/colour.h"
#include "capture/facades/placed_facade.h"
#include "graphics/gl/objects.h"
#include "graphics/render/bindings.h"
#include "graphics/render/view_programs.h"

namespace parvis::bench {
namespace {

constexpr int texture_side = 1024, texture_levels = 11;
constexpr float uvs_per_metre = 0.2f;

Mesh plain_mesh(const facades::PackedFacade& facade) {
  Mesh mesh = facades::mesh_of(facade);
  mesh.uvs = plain_uvs(facade);
  return mesh;
}

/// One texel, linear, for rays.
class PlainSurface final : public scene::TracedSurface {
 public:
  scene::TracedPoint point(const scene::TracedHit& hit) const override {
    scene::TracedPoint point;
    point.normal = hit.to_viewer;
    point.base_colour = glm::vec3(0.0f), point.metallic = 1.0f, point.roughness = 1.0f;
    const glm::vec2 at = float(texture_side) * (hit.uv - glm::floor(hit.uv));
    const std::uint8_t* texel =
        texture_.at(std::min(int(at.x), texture_side - 1), std::min(int(at.y), texture_side - 1));
    point.emission = linear_from_srgb(glm::vec3(texel[0], texel[1], texel[2]) / 255.0f);
    return point;
  }

 private:
  Image8 texture_ = plain_texture();
};

class PlainDrawable final : public render::Drawable {
 public:
  static Result<std::unique_ptr<render::Drawable>> create(const facades::PackedFacade& facade,
                                                          int first_thing) {
    Result<render::ViewPrograms> programs =
        render::ViewPrograms::create({"capture/facades/test_plain_texture_vertex.glsl",
                                      "capture/facades/test_plain_texture_surface.glsl",
                                      {{"HAS_BACKS", ""}, {"IS_RECORDED", ""}}});
    if (!programs) return programs.errors();
    return std::unique_ptr<render::Drawable>(new PlainDrawable(facade, first_thing, *std::move(programs)));
  }

  render::Extents extents() const override { return {bounds_, {}, {}, {&bounds_, 1}, nullptr}; }
  void prepare(const render::View&, const render::Culling&) override {}
  void draw(const render::View& view, render::Pass pass) override {
    if (pass != render::Pass::opaque) return;
    const gl::Program* program = programs_.use(view);
    if (!program) return;
    glBindVertexArray(vertex_array_.name());
    glBindTextureUnit(render::first_drawable_unit, texture_.name());
    program->set("plain_texture", int(render::first_drawable_unit));
    program->set("plain_thing", first_thing_);
    glDisable(GL_CULL_FACE);
    glDrawArrays(GL_TRIANGLES, 0, corners_);
  }

 private:
  PlainDrawable(const facades::PackedFacade& facade, int first_thing, render::ViewPrograms programs)
      : first_thing_(first_thing), programs_(std::move(programs)), bounds_(facade.bounds()) {
    const Mesh mesh = plain_mesh(facade);
    corners_ = GLsizei(mesh.positions.size());
    positions_ = gl::immutable_buffer(std::span<const glm::vec3>(mesh.positions));
    normals_ = gl::immutable_buffer(std::span<const glm::vec3>(mesh.normals));
    uvs_ = gl::immutable_buffer(std::span<const glm::vec2>(mesh.uvs));
    add_attribute(0, positions_, 3), add_attribute(1, normals_, 3), add_attribute(2, uvs_, 2);
    const Image8 image = plain_texture();
    texture_ = gl::texture_2d(GL_SRGB8_ALPHA8, texture_side, texture_side, texture_levels);
    const GLuint name = texture_.name();
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_REPEAT);
    glTextureSubImage2D(name, 0, 0, 0, texture_side, texture_side, GL_RGBA, GL_UNSIGNED_BYTE,
                        image.pixels.data());
    glGenerateTextureMipmap(name);
  }
  void add_attribute(GLuint attribute, const gl::Buffer& buffer, int components) {
    const GLuint array = vertex_array_.name();
    glVertexArrayVertexBuffer(array, attribute, buffer.name(), 0, GLsizei(sizeof(float)) * components);
    glEnableVertexArrayAttrib(array, attribute);
    glVertexArrayAttribFormat(array, attribute, components, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(array, attribute, attribute);
  }

  int first_thing_;
  render::ViewPrograms programs_;
  Bounds bounds_;
  GLsizei corners_ = 0;
  gl::Buffer positions_, normals_, uvs_;
  gl::VertexArray vertex_array_ = gl::VertexArray::create();
  gl::Texture texture_;
};

}  // namespace

Image8 plain_texture() {
  Image8 image(texture_side, texture_side, 4);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = std::uint8_t(std::uint32_t(i) * 2654435761u >> 24);
  return image;
}

std::vector<glm::vec2> plain_uvs(const facades::PackedFacade& facade) {
  std::vector<glm::vec2> uvs;
  for (const glm::vec3& corner : facade.corners)
    uvs.push_back(uvs_per_metre * glm::vec2(corner.x + corner.y, corner.z));
  return uvs;
}

render::DrawableKind plain_texture_kind(std::shared_ptr<const facades::PackedFacade> facade) {
  render::DrawableKind kind;
  kind.traced.name = "plain texture";
  kind.traced.count = [](const scene::Scene&) { return 1; };
  kind.traced.trace = [facade](const scene::Scene&, scene::TracedScene& traced) {
    traced.add(std::make_shared<const Mesh>(plain_mesh(*facade)), std::make_shared<const PlainSurface>(),
               glm::mat4(1.0f), {0, false, true, true});
  };
  kind.make = [facade](const scene::Scene&, int first_thing) {
    return PlainDrawable::create(*facade, first_thing);
  };
  return kind;
}

}  // namespace parvis::bench
