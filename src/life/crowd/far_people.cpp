// Every view chooses for each person the picture nearest to its direction and draws all of them with one
// call: a rectangle each, no larger than what the picture covers.
#include "life/crowd/far_people.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/gtc/matrix_transform.hpp>

#include "base/bounds.h"
#include "graphics/gl/objects.h"
#include "graphics/render/bindings.h"
#include "graphics/render/stream_buffer.h"
#include "graphics/render/view_programs.h"
#include "scene/data/deformation.h"

namespace parvis::crowd {
namespace {

using people::Detail, render::Culling, render::Pass, render::View, render::ViewKind, render::ViewPrograms;

constexpr float arms_reach = 0.36f, above_head = 1.08f;  // in statures, of whoever walks
constexpr float min_height_px = 1.5f;  // smaller ones are left out of views but the main one

/// An instance of picture_vertex.glsl.
struct PictureRecord {
  glm::vec4 foot, right, up, edges, texels;
  glm::uvec4 numbers;
};

void attach_attributes(const gl::VertexArray& made) {
  const GLuint array = made.name();
  for (GLuint i = 0; i < 5; ++i) {
    glEnableVertexArrayAttrib(array, i);
    glVertexArrayAttribFormat(array, i, 4, GL_FLOAT, GL_FALSE, GLuint(i * sizeof(glm::vec4)));
    glVertexArrayAttribBinding(array, i, 0);
  }
  glEnableVertexArrayAttrib(array, 5);
  glVertexArrayAttribIFormat(array, 5, 4, GL_UNSIGNED_INT, GLuint(offsetof(PictureRecord, numbers)));
  glVertexArrayAttribBinding(array, 5, 0);
  glVertexArrayBindingDivisor(array, 0, 1);
}

/// Layers of images of one size.
gl::Texture upload_layers(const std::vector<const Image8*>& layers, GLenum format, int levels) {
  gl::Texture texture = gl::Texture::create(GLenum(GL_TEXTURE_2D_ARRAY));
  const GLuint name = texture.name();
  glTextureStorage3D(name, levels, format, layers.front()->width, layers.front()->height,
                     GLsizei(layers.size()));
  for (std::size_t i = 0; i < layers.size(); ++i)
    glTextureSubImage3D(name, 0, 0, 0, GLint(i), layers[i]->width, layers[i]->height, 1, GL_RGBA,
                        GL_UNSIGNED_BYTE, layers[i]->pixels.data());
  glGenerateTextureMipmap(name);
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

/// The pictures of a crowd as textures.
struct PictureTextures {
  gl::Texture shapes, colours;
  std::vector<std::uint32_t> layer_of_look;  ///< of `colours`
};

PictureTextures upload(const FarPeople& crowd) {
  PictureTextures textures;
  std::vector<const Image8*> shapes, colours;
  for (const FarPeople::Shape& shape : crowd.shapes) shapes.push_back(&shape.pictures.shapes);
  for (const FarPeople::Look& look : crowd.looks) {
    textures.layer_of_look.push_back(std::uint32_t(colours.size()));
    colours.push_back(&crowd.shapes[std::size_t(look.shape)].pictures.colours[std::size_t(look.colours)]);
  }
  textures.shapes = upload_layers(shapes, GL_RGBA8, people::picture_levels),
  textures.colours = upload_layers(colours, GL_SRGB8_ALPHA8, people::picture_levels - 1);
  return textures;
}

/// The part of somebody that hides the sky, as that of objects is found.
struct PictureBody {
  Bounds in_model;
  shading::BodyShape shape;
};

PictureBody body_of(const FarPeople::Shape& shape) {
  const scene::Part& part = shape.levels.models[std::size_t(Detail::distant)]->parts.front();
  Mesh mesh = part.mesh;
  scene::deform(*part.deformation, {},
                people::pose_of(shape.levels.body.skeleton(),
                                people::pictured_posture(shape.levels.body, people::walking_pictures)),
                part.node, mesh);
  const shading::BodyMesh stands{&mesh, glm::mat4(1.0f)};
  return {mesh.bounds(), shading::body_shape(std::span(&stands, 1))};
}

glm::mat4 world_from(const FarPeople::Person& person) {
  return glm::rotate(glm::translate(glm::mat4(1.0f), person.place), person.heading, glm::vec3(0, 0, 1));
}

class FarPeopleDrawable final : public render::Drawable {
 public:
  static Result<std::unique_ptr<render::Drawable>> create(const scene::Scene& scene, int first_thing) {
    Result<ViewPrograms> programs =
        ViewPrograms::create({"life/crowd/picture_vertex.glsl",
                              "life/crowd/picture_surface.glsl",
                              {{"IS_LEAF", ""}, {"HAS_HOLES", ""}, {"HAS_BACKS", ""}}});
    if (!programs) return programs.errors();
    std::unique_ptr<FarPeopleDrawable> drawable(new FarPeopleDrawable(first_thing, *std::move(programs)));
    drawable->update(scene);
    return std::unique_ptr<render::Drawable>(std::move(drawable));
  }

  void renumber(int first_thing) override { first_thing_ = first_thing; }

  void update(const scene::Scene& scene) override {
    const std::shared_ptr<FarPeople>& now = scene.data<SharedFarPeople>().now;
    if (now != crowd_) {
      crowd_ = now;
      bodies_of_shapes_.clear();
      if (crowd_ && !crowd_->looks.empty()) textures_ = upload(*crowd_);
      for (std::size_t i = 0; crowd_ && i < crowd_->shapes.size(); ++i)
        bodies_of_shapes_.push_back(body_of(crowd_->shapes[i]));
    }
    bounds_.assign(crowd_ ? crowd_->people.size() : 0, Bounds{});
    moving_.clear(), bodies_.clear();
    for (std::size_t i = 0; i < bounds_.size(); ++i) {
      const FarPeople::Person& person = crowd_->people[i];
      if (!person.is_shown && !person.casts_shadow) continue;
      const std::size_t shape = std::size_t(crowd_->looks[std::size_t(person.look)].shape);
      const float height = crowd_->shapes[shape].pictures.stature_m, reach = arms_reach * height;
      bounds_[i] = {person.place - glm::vec3(reach, reach, 0.03f),
                    person.place + glm::vec3(reach, reach, above_head * height)};
      if (!person.is_shown) continue;  // an object of the scene has the rest
      moving_.push_back(bounds_[i]);
      if (const auto body =
              shading::body_of(bodies_of_shapes_[shape].in_model, bodies_of_shapes_[shape].shape,
                               world_from(person), first_thing_ + int(i)))
        bodies_.push_back(*body);
    }
  }

  render::Extents extents() const override { return {{}, moving_, bodies_, bounds_, nullptr}; }

  void prepare(const View& view, const Culling& culling) override {
    DrawList& list = list_of(view);
    list.records.clear();
    for (std::size_t i = 0; i < bounds_.size(); ++i) {
      const FarPeople::Person& person = crowd_->people[i];
      if (view.kind == ViewKind::shadow ? !person.casts_shadow : !person.is_shown) continue;
      if (!culling.shows(first_thing_ + int(i), {true, false})) continue;
      if (!culling.may_see(bounds_[i])) continue;
      if (view.kind != ViewKind::main &&
          culling.pixels_per_metre(bounds_[i]) * bounds_[i].size().z < min_height_px)
        continue;
      if (culling.is_hidden(bounds_[i])) continue;
      list.records.push_back(record_of(i, view.position_in_world));
    }
    list.first_record = list.store.append(std::span<const PictureRecord>(list.records), 64);
  }

  void draw(const View& view, Pass pass) override {
    const DrawList& list = list_of(view);
    if (pass != Pass::cutout || list.records.empty()) return;
    const gl::Program* program = programs_.use(view);
    if (!program) return;
    glBindTextureUnit(render::first_drawable_unit, textures_.shapes.name());
    glBindTextureUnit(render::first_drawable_unit + 1, textures_.colours.name());
    if (program->declares("picture_shapes")) program->set("picture_shapes", int(render::first_drawable_unit));
    if (program->declares("picture_colours"))
      program->set("picture_colours", int(render::first_drawable_unit + 1));
    glDisable(GL_CULL_FACE);
    glVertexArrayVertexBuffer(array_.name(), 0, list.store.name(), list.first_record, sizeof(PictureRecord));
    glBindVertexArray(array_.name());
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(list.records.size()));
  }

 private:
  /// The draw list of one view; the main view's is its own, as other views are drawn between its preparation
  /// and its drawing.
  struct DrawList {
    std::vector<PictureRecord> records;
    render::StreamBuffer store{1 << 18};
    GLintptr first_record = 0;
  };

  FarPeopleDrawable(int first_thing, ViewPrograms programs)
      : first_thing_(first_thing), programs_(std::move(programs)) {
    attach_attributes(array_);
  }

  DrawList& list_of(const View& view) { return view.kind == ViewKind::main ? main_list_ : other_list_; }

  /// The picture of a person as seen from a place: upright in its own plane, turned to the viewer.
  PictureRecord record_of(std::size_t number, glm::vec3 viewer) const {
    const FarPeople::Person& person = crowd_->people[number];
    const FarPeople::Look& look = crowd_->looks[std::size_t(person.look)];
    const people::PersonPictures& pictures = crowd_->shapes[std::size_t(look.shape)].pictures;
    const float height = pictures.stature_m, cos = std::cos(person.heading), sin = std::sin(person.heading);
    const glm::vec3 to_viewer = viewer - (person.place + glm::vec3(0.0f, 0.0f, 0.5f * height));
    const int direction = people::nearest_picture(
        {cos * to_viewer.x + sin * to_viewer.y, cos * to_viewer.y - sin * to_viewer.x, to_viewer.z});
    const int ring = direction < people::picture_rings[0].azimuths ? 0 : 1;
    const people::PictureRing& seen_from = people::picture_rings[std::size_t(ring)];
    const float flat = glm::length(glm::vec2(to_viewer)), elevation = glm::radians(seen_from.elevation_deg);
    const glm::vec2 toward = flat > 1e-3f ? glm::vec2(to_viewer) / flat : glm::vec2(cos, sin);
    const glm::vec3 right(-toward.y, toward.x, 0.0f);
    const glm::vec3 up(-std::sin(elevation) * toward, std::cos(elevation));
    const glm::ivec4 covered = pictures.covered[people::PersonPictures::index(direction, person.posture)];
    // A pixel more on all sides, into which filters spread.
    const glm::vec2 size(people::picture_width_px, people::picture_height_px);
    const glm::vec2 low = glm::max(glm::vec2(covered.x, covered.y) - 1.0f, glm::vec2(0.0f)),
                    high = glm::min(glm::vec2(covered.z, covered.w) + 1.0f, size);
    const float m_per_px = height / people::picture_px_per_stature;
    const auto across = [&](float x) { return (x - 0.5f * size.x) * m_per_px; };
    const auto above = [&](float y) { return (size.y - y) * m_per_px + seen_from.lowest * height; };
    const glm::vec2 first(float(direction) * size.x, float(person.posture) * size.y),
        all(float(pictures.shapes.width), float(pictures.shapes.height));
    const glm::vec2 low_texel = (first + low) / all, high_texel = (first + high) / all;
    PictureRecord record{};
    record.foot = {person.place, height};
    record.right = {right, cos}, record.up = {up, sin};
    record.edges = {across(low.x), above(high.y), across(high.x), above(low.y)};
    record.texels = {low_texel.x, high_texel.y, high_texel.x, low_texel.y};
    record.numbers = {std::uint32_t(look.shape), textures_.layer_of_look[std::size_t(person.look)],
                      std::uint32_t(first_thing_ + int(number)), 0};
    return record;
  }

  int first_thing_;
  ViewPrograms programs_;
  gl::VertexArray array_ = gl::VertexArray::create();
  PictureTextures textures_;
  std::shared_ptr<FarPeople> crowd_;
  std::vector<PictureBody> bodies_of_shapes_;
  std::vector<Bounds> bounds_, moving_;
  std::vector<shading::Body> bodies_;
  DrawList main_list_, other_list_;
};

scene::TracedKind traced_far_people() {
  scene::TracedKind kind;
  kind.name = "far people";
  kind.count = [](const scene::Scene& scene) {
    const std::shared_ptr<FarPeople>& crowd = scene.data<SharedFarPeople>().now;
    return crowd ? int(crowd->people.size()) : 0;
  };
  kind.trace = [](const scene::Scene& scene, scene::TracedScene& traced) {
    const std::shared_ptr<FarPeople>& crowd = scene.data<SharedFarPeople>().now;
    for (std::size_t i = 0; crowd && i < crowd->people.size(); ++i) {
      const FarPeople::Person& person = crowd->people[i];
      if (!person.is_shown) continue;
      const FarPeople::Shape& shape = crowd->shape_of(person);
      const auto level = std::size_t(Detail::distant);
      auto model = std::make_shared<scene::Model>(*shape.levels.models[level]);
      scene::Part& part = model->parts.front();
      scene::deform(*part.deformation, {},
                    people::pose_of(shape.levels.body.skeleton(),
                                    people::pictured_posture(shape.levels.body, person.posture)),
                    part.node, part.mesh);
      part.mesh.colours = people::painted_vertices(shape.levels.covers[level], shape.who,
                                                   crowd->looks[std::size_t(person.look)].worn);
      part.deformation = nullptr;
      traced.add(std::move(model), world_from(person), {int(i), true, true, true});
    }
  };
  return kind;
}

}  // namespace

render::DrawableKind far_people_kind() {
  render::DrawableKind kind;
  kind.traced = traced_far_people();
  kind.make = [](const scene::Scene& scene, int first_thing) {
    return FarPeopleDrawable::create(scene, first_thing);
  };
  return kind;
}

}  // namespace parvis::crowd
