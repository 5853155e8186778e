// The shade that moving bodies cast around them under the sky: the C++ face of body_shade.glsl.
#pragma once

#include <optional>
#include <span>

#include "base/bounds.h"
#include "graphics/shading/body_shape.h"
#include "graphics/shading/glsl.h"

namespace parvis::shading {
#include "graphics/shading/body_shade.glsl"
#include "graphics/shading/body_shade_block.glsl"

/// The body of an object with these bounds and this shape within them, in its own frame. None where there is
/// nothing, or more than `max_body_m`, whose shape no box describes.
std::optional<Body> body_of(const Bounds& in_model, const BodyShape& shape, const glm::mat4& world_from_model,
                            int object);

/// The bodies near a viewer, and which of them shade each cell of the ground: the uniform block of
/// body_shade_block.glsl.
using BodyShade = Bodies;

/// The shade of the bodies nearest to the viewer: `max_bodies` in all and `bodies_per_cell` in each cell,
/// over a square of 156 m. Toward its border, and toward the farthest where there are more, their shade
/// fades.
BodyShade make_body_shade(std::span<const Body> bodies, vec3 viewer);

/// Share 0..1 of its sky that bodies leave to a surface; `object` does not shade itself.
float sky_share_beside_bodies(const BodyShade& shade, vec3 position, vec3 normal, int object);

}  // namespace parvis::shading
