// The light of lamps over that of sun and sky: tables and depth maps on the GPU.
#pragma once

#include <memory>
#include <vector>

#include "graphics/gl/objects.h"
#include "graphics/render/light_over.h"
#include "graphics/shading/lamps.h"

namespace parvis::lamps {

/// Lamps on the GPU. Those on static objects have depth maps, which rays find when they are lit and where
/// static things near them change; those on moving objects shine through walls.
class LampLight final : public render::LightOver {
 public:
  explicit LampLight(std::unique_ptr<render::LightSource> below);

  bool update(const scene::Scene& scene) override;
  void renew(const scene::Scene& scene, const render::GpuScene& gpu, const render::FixedChange& change,
             const Bounds& fixed) override;
  void draw_shadows(const Camera& camera, std::span<const Bounds> moving,
                    const render::DrawView& draw) override;
  void bind() const override;
  void fill(render::Frame& frame) const override;
  const shading::LampTable* lamps() const override { return table_.empty() ? nullptr : &table_; }
  /// How many depth maps rays have found so far.
  std::size_t maps_traced() const { return maps_traced_; }

 private:
  void take_over_maps(const std::vector<shading::Lamp>& before, std::size_t layers);
  bool trace_maps(const scene::Scene& scene);
  void upload_maps();
  void show(std::vector<shading::Lamp> lamps);

  std::vector<shading::Lamp> still_, moving_;  ///< that burn; still ones know their layers
  std::vector<std::uint16_t> depths_;          ///< of `still_`
  std::vector<bool> is_mapped_;                ///< by still lamp: its map is up to date
  bool has_other_layers_ = false;              ///< since the maps were uploaded
  std::size_t maps_traced_ = 0;
  bool has_new_maps_ = false;  ///< since the table was made
  bool has_warned_of_count_ = false;
  shading::LampTable table_;  ///< what is on the GPU
  std::vector<glm::uvec4> texels_;
  gl::Texture table_texture_, maps_;
  int table_rows_ = 0, layers_ = 0;
};

/// Lamps over another light.
render::MakeLight with_lamps(render::MakeLight below);

}  // namespace parvis::lamps
