#include "graphics/render/gpu_vertex_light.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "graphics/render/bindings.h"
#include "scene/data/scene.h"

namespace parvis::render {
namespace {

constexpr int row_px = 1024;  // as vertex_light_lookup.glsl has it

static_assert(scene::max_lit_texels < std::size_t{row_px} * 16384, "OpenGL 4.5 has textures of that height");

}  // namespace

void GpuVertexLight::reserve(const scene::Scene& scene) {
  const auto& lit = scene.data<scene::VertexIrradiance>();
  const std::size_t known = places_.size();
  const auto take = [&](std::size_t count) { return int(std::exchange(texels_, texels_ + count)); };
  for (std::size_t o = 0; o < lit.objects.size(); ++o) {
    if (!lit.of(o) || places_.contains(o)) continue;
    for (const scene::LitVertices::PartLight& part : lit.of(o)->parts) {
      const int front = take(part.front.size());
      places_[o].parts.emplace_back(front, part.behind.empty() ? front : take(part.behind.size()));
    }
  }
  if (places_.size() == known) return;
  assert(texels_ <= scene::max_lit_texels);
  for (auto& [object, place] : places_) place.up = nullptr;
  const int rows = std::max(int((texels_ + row_px - 1) / row_px), 1);
  texture_ = gl::texture_2d(GL_RGBA32F, row_px, rows);
  glTextureParameteri(texture_.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(texture_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  constexpr float dark[4]{};
  glClearTexImage(texture_.name(), 0, GL_RGBA, GL_FLOAT, dark);
  update(scene);
}

/// Row by row: a run of vertices begins and ends anywhere.
void GpuVertexLight::write(const std::vector<glm::vec3>& light, int first) {
  for (std::size_t done = 0; done < light.size();) {
    const int at = first + int(done), x = at % row_px;
    const std::size_t count = std::min(std::size_t(row_px - x), light.size() - done);
    row_.clear();
    for (std::size_t i = 0; i < count; ++i) row_.emplace_back(light[done + i], 0.0f);
    glTextureSubImage2D(texture_.name(), 0, x, at / row_px, GLsizei(count), 1, GL_RGBA, GL_FLOAT,
                        row_.data());
    done += count;
  }
}

void GpuVertexLight::update(const scene::Scene& scene) {
  const auto& lit = scene.data<scene::VertexIrradiance>();
  for (auto& [object, place] : places_) {
    const scene::LitVertices* light = lit.of(object);
    if (!light || lit.objects[object] == place.up || light->parts.size() != place.parts.size()) continue;
    place.up = lit.objects[object];
    for (std::size_t p = 0; p < place.parts.size(); ++p) {
      write(light->parts[p].front, place.parts[p].x);
      if (place.parts[p].y != place.parts[p].x) write(light->parts[p].behind, place.parts[p].y);
    }
  }
}

glm::ivec2 GpuVertexLight::first_texels(std::size_t object, std::size_t part) const {
  const auto place = places_.find(object);
  return place == places_.end() ? glm::ivec2(0) : place->second.parts[part];
}

void GpuVertexLight::bind() const {
  if (texture_) glBindTextureUnit(vertex_light_unit, texture_.name());
}

}  // namespace parvis::render
