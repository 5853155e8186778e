// The least that a textured place can cost in the same house, to time facades against: the same triangles
// with one texture, without light.
#pragma once

#include <memory>

#include "base/image.h"
#include "capture/facades/packed_facade.h"
#include "graphics/render/drawables.h"

namespace parvis::bench {

/// A square of noise, 8-bit sRGB, which no cache knows by heart.
Image8 plain_texture();
/// Where each corner of a facade takes it from: its place in the facade's frame.
std::vector<glm::vec2> plain_uvs(const facades::PackedFacade& facade);

/// One thing: the facade's surfaces with `plain_texture` in the cheapest format that decodes sRGB, with
/// mipmaps; no light, no tone curve, no photographs to choose. Rays see the same.
render::DrawableKind plain_texture_kind(std::shared_ptr<const facades::PackedFacade> facade);

}  // namespace parvis::bench
