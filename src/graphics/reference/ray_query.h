// What Embree asks about the triangles that it finds along rays: does this one stop the ray?
#pragma once

#include <embree3/rtcore.h>

#include <span>

#include "graphics/reference/ray_scene.h"

namespace parvis::reference {

using Places = std::vector<std::unique_ptr<PlacedPart>>;

/// Instance of the joined triangles; that of place i is i + 1.
inline constexpr unsigned joined_instance = 0;
/// That of a place which is not joined.
inline unsigned instance_of(std::size_t place) { return unsigned(place + 1); }

/// Which place a hit belongs to.
inline std::size_t place_of(unsigned instance, unsigned geometry) {
  return instance == joined_instance ? geometry : instance - 1;
}

/// Do some queries of a scene in single precision have to ask about this part's triangles, whatever the rays?
/// Of opaque parts those alone do that see as the renderer draws.
inline bool needs_filter(const PlacedPart& part) {
  return part.material->alpha_mode != scene::Alpha::opaque || part.is_backdrop;
}

/// Embree's filter function of a geometry, for rays that see.
void filter_seen(const RTCFilterFunctionNArguments* arguments);
/// The same for rays to the light.
void filter_shadow(const RTCFilterFunctionNArguments* arguments);

}  // namespace parvis::reference
