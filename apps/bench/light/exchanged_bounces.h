// The light of one hour with the bounced light of another: a control that pictures with bounced light must
// beat.
#pragma once

#include <memory>

#include "graphics/render/light_over.h"

namespace parvis::bench {

/// The light below, over which lies the bounced light of a second source that follows a scene of its own.
class ExchangedBounces final : public render::LightOver {
 public:
  ExchangedBounces(std::unique_ptr<render::LightSource> below, std::unique_ptr<render::LightSource> other)
      : LightOver(std::move(below)), other_(std::move(other)) {}

  /// The hour whose bounced light is shown from now on.
  void show_bounces_of(const scene::Scene& other_hour) { other_->update(other_hour); }

  /// The other source binds all of its light first, and this one all but the bounced light over it.
  void bind() const override {
    other_->bind();
    LightOver::bind();
  }
  void fill(render::Frame& frame) const override {
    LightOver::fill(frame);
    render::Frame of_other{};
    other_->fill(of_other);
    frame.frame_bounced_origin = of_other.frame_bounced_origin;
    frame.frame_bounced_size = of_other.frame_bounced_size;
  }
  const shading::BouncedLight* bounced() const override { return other_->bounced(); }

 private:
  std::unique_ptr<render::LightSource> other_;
};

}  // namespace parvis::bench
