#include "capture/view_dependent_objects/object_textures.h"

#include <algorithm>

#include "base/parallel.h"
#include "graphics/gl/sampled_textures.h"
#include "graphics/render/bindings.h"
#include "graphics/render/gpu_scene.h"
#include "scene/data/mip_levels.h"

namespace parvis::view_dependent_objects {
namespace {

#include "capture/view_dependent_objects/view_table_layout.glsl"

struct Corner {
  glm::vec3 position, normal;
};

gl::Texture table_texture(std::vector<glm::vec4> table) {
  const int rows = std::max(int((table.size() + view_table_px - 1) / view_table_px), 1);
  table.resize(std::size_t(rows) * view_table_px, glm::vec4(0.0f));
  gl::Texture texture = gl::texture_2d(GL_RGBA32F, view_table_px, rows);
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTextureSubImage2D(texture.name(), 0, 0, 0, view_table_px, rows, GL_RGBA, GL_FLOAT, table.data());
  return texture;
}

gl::Texture picture_array(const std::vector<scene::Texture>& pictures) {
  std::vector<std::vector<Image8>> levels(pictures.size());
  parallel_for(levels.size(), [&](std::size_t i) { levels[i] = scene::smaller_mip_levels(pictures[i], 0); });
  const Image8& first = pictures.front().image;
  gl::Texture array = gl::Texture::create(GLenum(GL_TEXTURE_2D_ARRAY));
  const GLuint name = array.name();
  glTextureStorage3D(name, 1 + int(levels.front().size()), GL_SRGB8_ALPHA8, first.width, first.height,
                     int(pictures.size()));
  for (std::size_t i = 0; i < levels.size(); ++i)
    for (std::size_t level = 0; level <= levels[i].size(); ++level) {
      const Image8& image = level == 0 ? pictures[i].image : levels[i][level - 1];
      glTextureSubImage3D(name, int(level), 0, 0, int(i), image.width, image.height, 1, GL_RGBA,
                          GL_UNSIGNED_BYTE, image.pixels.data());
    }
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  if (render::has_fast_anisotropy()) glTextureParameterf(name, GL_TEXTURE_MAX_ANISOTROPY, 16.0f);
  const GLint wrap = pictures.front().wrap_u == scene::Wrap::repeat ? GL_REPEAT : GL_CLAMP_TO_EDGE;
  glTextureParameteri(name, GL_TEXTURE_WRAP_S, wrap);
  glTextureParameteri(name, GL_TEXTURE_WRAP_T, wrap);
  return array;
}

}  // namespace

Result<ObjectTextures> ObjectTextures::create(const BlendedModel& model) {
  GLint max_layers = 0;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &max_layers);
  if (model.pictures.size() > std::size_t(max_layers))
    return error(
        "a view-dependent object has {} pictures; this graphics hardware holds {} at once. Join the "
        "pictures of each viewpoint",
        model.pictures.size(), max_layers);
  ObjectTextures made;
  std::vector<Corner> corners;
  for (std::size_t i = 0; i < model.corners.size(); ++i)
    corners.push_back({model.corners[i], model.normals[i]});
  made.corners_ = gl::immutable_buffer(std::span<const Corner>(corners));
  made.vertices_ = gl::VertexArray::create();
  const GLuint name = made.vertices_.name();
  glVertexArrayVertexBuffer(name, 0, made.corners_.name(), 0, sizeof(Corner));
  for (GLuint attribute = 0; attribute < 2; ++attribute) {
    glEnableVertexArrayAttrib(name, attribute);
    glVertexArrayAttribBinding(name, attribute, 0);
    glVertexArrayAttribFormat(name, attribute, 3, GL_FLOAT, GL_FALSE, attribute * sizeof(glm::vec3));
  }
  made.table_ = table_texture(model.table);
  made.pictures_ = picture_array(model.pictures);
  return made;
}

void ObjectTextures::bind(const gl::Program& program) const {
  gl::bind_textures(program, {{"view_table", render::first_drawable_unit, table_.name()},
                              {"view_pictures", render::first_drawable_unit + 1, pictures_.name()}});
  glBindVertexArray(vertices_.name());
}

}  // namespace parvis::view_dependent_objects
