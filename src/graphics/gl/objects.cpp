#include "graphics/gl/objects.h"

namespace parvis::gl {

Texture texture_2d(GLenum format, int width, int height, int levels) {
  Texture texture = Texture::create(GLenum(GL_TEXTURE_2D));
  glTextureStorage2D(texture.name(), levels, format, width, height);
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER,
                      levels > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
  glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

}  // namespace parvis::gl
