// Bounced light over another light: follows sun, sky and the lamps of that light; read from beside the scene,
// or traced, when static things change.
#pragma once

#include <memory>
#include <vector>

#include "graphics/bounced_light/lamp_shares.h"
#include "graphics/bounced_light/transfer.h"
#include "graphics/gl/objects.h"
#include "graphics/render/light_over.h"

namespace parvis::bounced_light {

/// Bounced light on the GPU.
class BouncedOver final : public render::LightOver {
 public:
  /// Nothing is traced before the first frame.
  explicit BouncedOver(std::unique_ptr<render::LightSource> below) : LightOver(std::move(below)) {}

  bool update(const scene::Scene& scene) override;
  void bind() const override;
  void fill(render::Frame& frame) const override;
  const shading::BouncedLight* bounced() const override { return light_.empty() ? nullptr : &light_; }

 private:
  /// An object that light bounces off.
  struct Standing {
    int object;
    glm::mat4 world_from_model;
    bool operator==(const Standing&) const = default;
  };
  static std::vector<Standing> standing_in(const scene::Scene& scene);
  void upload();

  std::vector<Standing> standing_;  ///< of which `transfer_` is made
  bool is_traced_ = false;
  Transfer transfer_;
  LampShares lamp_shares_;  ///< on the patches of `transfer_`
  scene::Sun sun_;
  shading::BouncedLight light_;
  gl::Texture texture_;
};

/// Bounced light over another light, in scenes that ask for it.
render::MakeLight with_bounced_light(render::MakeLight below);

}  // namespace parvis::bounced_light
