#include "graphics/lamps/lamp_light.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <map>
#include <utility>

#include "base/parallel.h"
#include "graphics/lamps/lamp_maps.h"
#include "graphics/reference/scene_lamps.h"
#include "graphics/render/bindings.h"

namespace parvis::lamps {
namespace {

#include "graphics/render/lamp_table_layout.glsl"

bool is_same(const shading::Lamp& a, const shading::Lamp& b) {
  return a.place == b.place && glm::vec3(a.power) == glm::vec3(b.power) && a.axis == b.axis &&
         a.body == b.body;
}

/// The key of a depth map: place, reach and radius.
using MapKey = std::array<float, 5>;
MapKey map_key(const shading::Lamp& lamp) {
  return {lamp.place.x, lamp.place.y, lamp.place.z, lamp.place.w, lamp.body.w};
}

int max_layers() {
  GLint layers = 0;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &layers);
  return layers;
}

bool reaches(const shading::Lamp& lamp, const Bounds& region) {
  const glm::vec3 middle(lamp.place);
  return glm::distance(glm::clamp(middle, region.min, region.max), middle) < lamp.place.w;
}

}  // namespace

LampLight::LampLight(std::unique_ptr<render::LightSource> below) : LightOver(std::move(below)) {}

/// Lamps that burned before, and still do, keep their maps, in the layers that they have now.
void LampLight::take_over_maps(const std::vector<shading::Lamp>& before, std::size_t layers) {
  std::map<MapKey, std::size_t> known;
  for (std::size_t i = 0; i < is_mapped_.size(); ++i)
    if (is_mapped_[i]) known.emplace(map_key(before[i]), i);
  const std::vector<std::uint16_t> depths =
      std::exchange(depths_, std::vector<std::uint16_t>(layers * map_texels, 65535));
  is_mapped_.assign(layers, false);
  for (std::size_t i = 0; i < layers; ++i) {
    const auto found = known.find(map_key(still_[i]));
    if (found == known.end()) continue;
    std::copy_n(depths.begin() + std::ptrdiff_t(found->second * map_texels), map_texels,
                depths_.begin() + std::ptrdiff_t(i * map_texels));
    is_mapped_[i] = true;
  }
  has_other_layers_ = true;
}

/// Makes the maps that are missing; true where the maps on the GPU are other ones then.
bool LampLight::trace_maps(const scene::Scene& scene) {
  const auto missing = std::ranges::count(is_mapped_, false);
  if (is_mapped_.empty() || (missing == 0 && !has_other_layers_)) return false;
  if (missing > 0) {
    const reference::RayScene rays(scene);
    const std::size_t mapped = is_mapped_.size();  // fewer than `still_` where the driver has fewer layers
    parallel_for(mapped, [&](std::size_t i) {
      if (!is_mapped_[i])
        trace_map(scene, rays, still_[i], std::span(depths_).subspan(i * map_texels, map_texels));
    });
    is_mapped_.assign(mapped, true);
    maps_traced_ += std::size_t(missing);
  }
  has_new_maps_ = true, has_other_layers_ = false;
  upload_maps();
  return true;
}

void LampLight::upload_maps() {
  const int side = shading::lamp_map_px;
  if (layers_ != int(is_mapped_.size())) {
    layers_ = int(is_mapped_.size());
    maps_ = gl::Texture::create(GLenum(GL_TEXTURE_2D_ARRAY));
    glTextureStorage3D(maps_.name(), 1, GL_DEPTH_COMPONENT16, side, side, layers_);
    glTextureParameteri(maps_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(maps_.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(maps_.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(maps_.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTextureParameteri(maps_.name(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTextureParameteri(maps_.name(), GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  }
  glTextureSubImage3D(maps_.name(), 0, 0, 0, 0, side, side, layers_, GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT,
                      depths_.data());
}

bool LampLight::update(const scene::Scene& scene) {
  const bool has_changed_below = LightOver::update(scene);
  std::vector<shading::Lamp> still = reference::lit_lamps(scene, reference::LampKind::still);
  moving_ = reference::lit_lamps(scene, reference::LampKind::moving);

  const std::size_t burning = still.size() + moving_.size();
  if (burning > shading::max_lamps && !std::exchange(has_warned_of_count_, true))
    fmt::print(stderr, "warning: {} lamps burn; {} shine, those of vehicles last\n", burning,
               shading::max_lamps);
  const std::size_t layers = std::min(still.size(), std::size_t(max_layers()));
  for (std::size_t i = 0; i < layers; ++i) still[i].power.w = float(i + 1);
  const bool has_same_places = std::ranges::equal(still, still_, {}, map_key, map_key);
  const bool is_changed = !std::ranges::equal(still, still_, is_same);
  const std::vector<shading::Lamp> before = std::exchange(still_, std::move(still));
  if (!has_same_places) {
    if (layers < still_.size())
      fmt::print(
          stderr,
          "warning: {} lamps burn; the graphics driver holds depth maps of {}, the others cast no shadows\n",
          still_.size(), layers);
    take_over_maps(before, layers);
  }
  return trace_maps(scene) || is_changed || has_changed_below;
}

void LampLight::renew(const scene::Scene& scene, const render::GpuScene& gpu,
                      const render::FixedChange& change, const Bounds& fixed) {
  LightOver::renew(scene, gpu, change, fixed);
  for (std::size_t i = 0; i < is_mapped_.size(); ++i) {
    const auto touches = [&](const Bounds& region) { return reaches(still_[i], region); };
    if (std::ranges::any_of(change.gone, touches) || std::ranges::any_of(change.come, touches))
      is_mapped_[i] = false;
  }
}

/// Pictures of the static scene alone show no lamps of moving things, either.
void LampLight::draw_shadows(const Camera& camera, std::span<const Bounds> moving,
                             const render::DrawView& draw) {
  std::vector<shading::Lamp> lamps = still_;
  if (!moving.empty()) lamps.insert(lamps.end(), moving_.begin(), moving_.end());
  show(std::move(lamps));
  LightOver::draw_shadows(camera, moving, draw);
}

void LampLight::show(std::vector<shading::Lamp> lamps) {
  if (lamps.empty() && table_.empty()) return;
  if (!std::exchange(has_new_maps_, false) && std::ranges::equal(lamps, table_.lamps, is_same)) return;
  table_ = shading::make_lamp_table(std::move(lamps));
  table_.depths = depths_;
  const std::size_t used = table_.near.size() + texels_per_lamp * table_.lamps.size();
  const int rows = std::max(1, int((used + lamp_table_px - 1) / lamp_table_px));
  texels_.assign(std::size_t(rows) * lamp_table_px, glm::uvec4(0u));
  std::copy(table_.near.begin(), table_.near.end(), texels_.begin());
  static_assert(sizeof(shading::Lamp) == texels_per_lamp * sizeof(glm::uvec4));
  if (!table_.lamps.empty())
    std::memcpy(texels_.data() + table_.near.size(), table_.lamps.data(),
                table_.lamps.size() * sizeof(shading::Lamp));
  if (rows > table_rows_) {
    table_rows_ = rows;
    table_texture_ = gl::Texture::create(GLenum(GL_TEXTURE_2D));
    glTextureStorage2D(table_texture_.name(), 1, GL_RGBA32UI, lamp_table_px, rows);
    glTextureParameteri(table_texture_.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(table_texture_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  }
  glTextureSubImage2D(table_texture_.name(), 0, 0, 0, lamp_table_px, rows, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                      texels_.data());
}

void LampLight::bind() const {
  LightOver::bind();
  if (table_texture_) glBindTextureUnit(render::lamp_table_unit, table_texture_.name());
  if (maps_) glBindTextureUnit(render::lamp_maps_unit, maps_.name());
}

void LampLight::fill(render::Frame& frame) const {
  LightOver::fill(frame);
  if (table_.empty()) return;
  frame.frame_lamps = glm::vec4(table_.corner, table_.cell_m, 0.0f);
  frame.frame_lamp_cells = glm::vec4(table_.cells, float(table_.near.size()), 0.0f);
}

render::MakeLight with_lamps(render::MakeLight below) {
  return [below = std::move(below)](const scene::Scene& scene,
                                    const Bounds& fixed) -> Result<std::unique_ptr<render::LightSource>> {
    Result<std::unique_ptr<render::LightSource>> light = below(scene, fixed);
    if (!light) return light.errors();
    return std::unique_ptr<render::LightSource>(std::make_unique<LampLight>(*std::move(light)));
  };
}

}  // namespace parvis::lamps
