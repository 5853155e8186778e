#include "reflections/environment_rays/mirrored_bodies.h"

#include <algorithm>
#include <utility>

#include "base/content_hash.h"
#include "base/parallel.h"
#include "graphics/gl/sampled_textures.h"
#include "reflections/methods/bindings.h"

namespace parvis::environment_rays {
namespace {

constexpr std::size_t max_fields = 100;  // upon one another in a texture as high as any driver allows

gl::Texture room_for(std::size_t fields) {
  constexpr int columns = mirrored_bodies_shared::field_columns;
  const glm::ivec3 size = BodyField::size();
  const int rows = (int(std::max(fields, std::size_t{1})) + columns - 1) / columns;
  gl::Texture texture = gl::Texture::create(GL_TEXTURE_3D);
  glTextureStorage3D(texture.name(), 1, GL_RGBA8, columns * size.x, size.y, rows * size.z);
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    glTextureParameteri(texture.name(), wrap, GL_CLAMP_TO_EDGE);
  return texture;
}

/// The place of a field in the texture.
glm::ivec3 corner_of(std::size_t field) {
  constexpr int columns = mirrored_bodies_shared::field_columns;
  return glm::ivec3(int(field) % columns, 0, int(field) / columns) * BodyField::size();
}

}  // namespace

MirroredBodies::MirroredBodies(const scene::Scene& scene)
    : fields_(room_for(0)), block_(gl::Buffer::create()) {
  glNamedBufferStorage(block_.name(), sizeof(mirrored_bodies_shared::MirroredBodies), nullptr,
                       GL_DYNAMIC_STORAGE_BIT);
  bodies_.reserve(max_bodies), middles_.reserve(max_bodies), objects_.reserve(max_bodies),
      reflector_of_body_.reserve(max_bodies);
  add_objects(scene);
}

void MirroredBodies::follow_objects(const scene::Scene& scene) {
  if (scene.objects.size() > field_of_object_.size()) add_objects(scene);
}

/// The levels of detail of a skinned body share the field of the first one: their bones rest in the same
/// places.
MirroredBodies::Look MirroredBodies::look_of(const scene::Object& object) {
  if (object.deformed_meshes.empty()) return {object.model.get(), object.paint.get()};
  ContentHash bones;
  bones.add_text(object.model->name);
  for (const scene::ModelNode& node : object.model->nodes)
    bones.add(node.translation), bones.add(node.parent);
  return {first_of_bones_.try_emplace(bones.value(), object.model.get()).first->second, nullptr};
}

void MirroredBodies::add_objects(const scene::Scene& scene) {
  std::vector<const scene::Object*> looks;  // new ones
  const std::size_t known = boxes_.size();
  for (std::size_t o = field_of_object_.size(); o < scene.objects.size(); ++o) {
    const scene::Object& object = scene.objects[o];
    field_of_object_.push_back(-1);
    if (!object.is_dynamic || !object.model) continue;
    const Look look = look_of(object);
    if (!field_of_look_.contains(look) && known + looks.size() < max_fields) {
      field_of_look_.emplace(look, int(known + looks.size()));
      looks.push_back(&object);
    }
    if (const auto field = field_of_look_.find(look);
        field != field_of_look_.end() &&
        (std::size_t(field->second) >= known || !boxes_[std::size_t(field->second)].empty()))
      field_of_object_.back() = field->second;
  }
  body_of_object_.resize(scene.objects.size(), -1);
  by_distance_.reserve(scene.objects.size());
  if (looks.empty()) return;
  std::vector<BodyField> fields(looks.size());
  parallel_for(looks.size(),
               [&](std::size_t i) { fields[i] = body_field(*looks[i]->model, looks[i]->materials()); });
  std::ranges::transform(fields, std::back_inserter(boxes_), &BodyField::box);
  for (int& field : field_of_object_)
    if (field >= 0 && boxes_[std::size_t(field)].empty()) field = -1;

  const gl::Texture before = std::exchange(fields_, room_for(boxes_.size()));
  const glm::ivec3 size = BodyField::size();
  for (std::size_t i = 0; i < known; ++i) {
    const glm::ivec3 at = corner_of(i);
    glCopyImageSubData(before.name(), GL_TEXTURE_3D, 0, at.x, at.y, at.z, fields_.name(), GL_TEXTURE_3D, 0,
                       at.x, at.y, at.z, size.x, size.y, size.z);
  }
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const glm::ivec3 at = corner_of(known + i);
    if (!fields[i].cells.empty())
      glTextureSubImage3D(fields_.name(), 0, at.x, at.y, at.z, size.x, size.y, size.z, GL_RGBA,
                          GL_UNSIGNED_BYTE, fields[i].cells.data());
  }
}

void MirroredBodies::update(const scene::Scene& scene,
                            const std::vector<methods::VisibleReflector>& reflectors) {
  const glm::vec3 viewer = reflectors.front().centre;
  by_distance_.clear(), bodies_.clear(), middles_.clear(), objects_.clear();
  for (std::size_t o = 0; o < scene.objects.size(); ++o) {
    body_of_object_[o] = -1;
    if (field_of_object_[o] < 0 || !scene.objects[o].is_visible) continue;
    const glm::vec3 at(scene.objects[o].world_from_model[3]);
    by_distance_.emplace_back(glm::distance(at, viewer), int(o));
  }
  const std::size_t count = std::min(by_distance_.size(), std::size_t(max_bodies));
  std::ranges::partial_sort(by_distance_, by_distance_.begin() + std::ptrdiff_t(count));
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t o = std::size_t(by_distance_[i].second);
    const glm::mat4& world_from_model = scene.objects[o].world_from_model;
    const Bounds& box = boxes_[std::size_t(field_of_object_[o])];
    const glm::vec3 middle(world_from_model * glm::vec4(box.centre(), 1.0f));
    Body body{};
    for (int axis = 0; axis < 3; ++axis) {
      const glm::vec3 edge(world_from_model[axis]);
      const float scale = std::max(glm::length(edge), 1e-6f);
      body.box_from_world[axis] = glm::vec4(edge / scale, -glm::dot(edge / scale, middle));
      body.half_size_m[axis] = 0.5f * scale * box.size()[axis];
    }
    body.half_size_m.w = float(field_of_object_[o]);
    body_of_object_[o] = int(bodies_.size());
    bodies_.push_back(body), middles_.push_back(middle), objects_.push_back(int(o));
  }
  find_neighbours(reflectors);
  glNamedBufferSubData(block_.name(), 0, GLsizeiptr(sizeof(Body) * bodies_.size()), bodies_.data());
}

void MirroredBodies::find_neighbours(const std::vector<methods::VisibleReflector>& reflectors) {
  reflector_of_body_.assign(bodies_.size(), nullptr);
  for (const methods::VisibleReflector& reflector : reflectors)
    if (const int body = body_of(reflector.object); body >= 0)
      reflector_of_body_[std::size_t(body)] = &reflector;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const methods::VisibleReflector* reflector = reflector_of_body_[i];
    by_distance_.clear();
    for (std::size_t k = 0; k < bodies_.size(); ++k)
      if (const float distance_m = glm::distance(middles_[i], middles_[k]);
          distance_m < reach_m && !(reflector && reflector->is_overlaid(objects_[k])))
        by_distance_.emplace_back(distance_m, int(k));
    const std::size_t count = std::min(by_distance_.size(), std::size_t(max_nearby));
    std::ranges::partial_sort(by_distance_, by_distance_.begin() + std::ptrdiff_t(count));
    for (std::size_t n = 0; n < count; ++n)
      bodies_[i].near[int(n / 4)] |= glm::uint(by_distance_[n].second + 1) << (8 * (n % 4));
  }
}

void MirroredBodies::prepare(const gl::Program& program, GLuint unit) const {
  glBindBufferBase(GL_UNIFORM_BUFFER, methods::first_method_block, block_.name());
  if (const GLuint index = glGetUniformBlockIndex(program.name(), "MirroredBodies");
      index != GL_INVALID_INDEX)
    glUniformBlockBinding(program.name(), index, methods::first_method_block);
  gl::bind_textures(program, {{"body_fields", unit, fields_.name()}});
}

}  // namespace parvis::environment_rays
