// What drawing a captured place costs beside the same surfaces with one plain texture.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/bounds.h"
#include "base/colour.h"
#include "base/image.h"
#include "base/image_io.h"
#include "base/test_data.h"
#include "bench/facades/places.h"
#include "bench/reflections/judged_method.h"
#include "capture/facades/facade_drawable.h"
#include "capture/facades/layer_model.h"
#include "capture/facades/packed_facade.h"
#include "capture/facades/place_folder.h"
#include "capture/facades/place_model.h"
#include "capture/facades/placed_facade.h"
#include "capture/facades/test_measure_place.h"
#include "capture/photographs/calibrate.h"
#include "capture/photographs/camera_files.h"
#include "capture/photographs/photograph.h"
#include "capture/photographs/picture.h"
#include "formats/meshes/assimp_reader.h"
#include "graphics/gl/context.h"
#include "graphics/gl/objects.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/render/bindings.h"
#include "graphics/render/drawables.h"
#include "graphics/render/renderer.h"
#include "graphics/render/view_programs.h"

namespace parvis::bench {
namespace {

constexpr int texture_side = 1024, texture_levels = 11;
constexpr float uvs_per_metre = 0.2f;

/// Where each corner of a facade takes it from: its place in the facade's frame.
std::vector<glm::vec2> plain_uvs(const facades::PackedFacade& facade) {
  std::vector<glm::vec2> uvs;
  for (const glm::vec3& corner : facade.corners)
    uvs.push_back(uvs_per_metre * glm::vec2(corner.x + corner.y, corner.z));
  return uvs;
}

/// A square of noise, 8-bit sRGB, which no cache knows by heart.
Image8 plain_texture() {
  Image8 image(texture_side, texture_side, 4);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = std::uint8_t(std::uint32_t(i) * 2654435761u >> 24);
  return image;
}

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
  static std::unique_ptr<render::Drawable> create(const facades::PackedFacade& facade, int first_thing) {
    render::ViewPrograms programs =
        must(render::ViewPrograms::create({"capture/facades/test_plain_texture_vertex.glsl",
                                           "capture/facades/test_plain_texture_surface.glsl",
                                           {{"HAS_BACKS", ""}, {"IS_RECORDED", ""}}}));
    return std::unique_ptr<render::Drawable>(new PlainDrawable(facade, first_thing, std::move(programs)));
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

/// One thing: the facade's surfaces with `plain_texture` in the cheapest format that decodes sRGB, with
/// mipmaps; no light, no tone curve, no photographs to choose. Rays see the same.
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

using facades::PackedFacade;

/// Time of a main view of `scene`, and its picture.
class TimedScene {
 public:
  static TimedScene create(scene::Scene scene, const render::Drawables& drawables) {
    auto held = std::make_unique<scene::Scene>(std::move(scene));
    std::unique_ptr<render::Renderer> renderer =
        must(render::Renderer::create(*held, drawables, light::sun_and_sky));
    return TimedScene(std::move(held), std::move(renderer));
  }
  /// Milliseconds of the picture alone, without what chooses photographs for the eye before it.
  double draw(const Camera& camera) {
    constexpr int width = 640, height = 480;
    renderer_->begin_frame(*scene_, camera);
    renderer_->prepare_main_view(camera, width, height);
    return finished_ms([&] { renderer_->draw_main_view(); });
  }
  /// The last picture drawn.
  ImageF picture() { return renderer_->read_radiance(); }

 private:
  TimedScene(std::unique_ptr<scene::Scene> scene, std::unique_ptr<render::Renderer> renderer)
      : scene_(std::move(scene)), renderer_(std::move(renderer)) {}
  std::unique_ptr<scene::Scene> scene_;
  std::unique_ptr<render::Renderer> renderer_;
};

TimedScene unlit_scene(std::shared_ptr<const PackedFacade> facade) {
  render::Drawables drawables;
  drawables.add(plain_texture_kind(std::move(facade)));
  scene::Scene scene;
  drawables.attach(scene);
  return TimedScene::create(std::move(scene), drawables);
}

TimedScene facade_scene(const facades::PlacedFacade& placed, facades::Compared compared) {
  render::Drawables drawables;
  drawables.add(facades::facades_kind(compared));
  scene::Scene scene;
  scene.data<scene::ItemsOf<facades::PlacedFacade>>().add(placed, 0);
  drawables.attach(scene);
  return TimedScene::create(std::move(scene), drawables);
}

/// Pixels in which a picture shows something else than that of nothing, percent.
double shown_percent(const ImageF& picture, const ImageF& nothing) {
  std::size_t shown = 0;
  const std::size_t pixels = std::size_t(picture.width) * std::size_t(picture.height);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      shown += !std::equal(picture.at(x, y), picture.at(x, y) + 3, nothing.at(x, y));
  return 100.0 * double(shown) / double(pixels);
}

}  // namespace

void measure_drawing(std::shared_ptr<const PackedFacade> facade, const Camera& camera, bool is_quick,
                     Report& report) {
  facades::PlacedFacade placed;
  placed.facade = facade;
  facades::PlacedFacade hidden = placed, without_photographs = placed;
  hidden.is_visible = false;
  auto bare = std::make_shared<PackedFacade>(*facade);
  for (glm::uvec2& list : bare->lists) list.y = 0;
  without_photographs.facade = bare;
  TimedScene ours = facade_scene(placed, facades::Compared::chosen),
             all = facade_scene(placed, facades::Compared::all),
             nothing = facade_scene(hidden, facades::Compared::chosen),
             bare_colours = facade_scene(without_photographs, facades::Compared::all),
             unlit = unlit_scene(facade);
  std::vector<double> plain_ms, ours_ms, all_ms, nothing_ms;
  for (int i = 0; i < (is_quick ? 9 : 31); ++i)
    for (auto& [scene, ms] :
         {std::pair{&unlit, &plain_ms}, {&ours, &ours_ms}, {&all, &all_ms}, {&nothing, &nothing_ms}})
      ms->push_back(scene->draw(camera));
  ours.draw(camera), bare_colours.draw(camera);
  const std::string key = "draw_over_plain_texture_time";
  report.add(key, ratio_in_turn(ours_ms, plain_ms));
  report.add(key + "_all_photographs", ratio_in_turn(all_ms, plain_ms).value);
  report.add(key + "_nothing", ratio_in_turn(nothing_ms, plain_ms).value);
  // A place that is not drawn would be fast: what is timed has to cover what the plain texture covers, and
  // proposed colours alone would be fast, too: it has to show photographs.
  const ImageF empty = nothing.picture(), shown = ours.picture(), bare_picture = bare_colours.picture();
  const double plain_percent = shown_percent(unlit.picture(), empty);
  report.add("draw_shown_percent", shown_percent(shown, empty), minimum(plain_percent),
             {{"draw_shown_percent_control_hidden", shown_percent(empty, empty)}});
  report.add("draw_photographs_percent", shown_percent(shown, bare_picture), minimum(0.9 * plain_percent),
             {{"draw_photographs_percent_control_none", shown_percent(bare_picture, bare_picture)}});
}

}  // namespace parvis::bench
