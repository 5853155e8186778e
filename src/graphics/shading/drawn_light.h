// What a renderer knows of the light that it draws a picture in, so that a ray tracer can agree with it.
#pragma once

#include "graphics/shading/body_shade.h"
#include "graphics/shading/bounced_light.h"
#include "graphics/shading/lamps.h"
#include "graphics/shading/shadow.h"
#include "graphics/shading/sky_visibility.h"

namespace parvis::shading {

struct DrawnLight {
  SunShadow shadow;
  const SkyVisibility* sky_visibility;  ///< both the renderer's own, as of its last frame
  const BodyShade* body_shade;
  bool has_exact_shadows = false;         ///< the tracer traces the sun by itself, in place of `shadow`
  const LampTable* lamps = nullptr;       ///< null: no lamp is lit
  const BouncedLight* bounced = nullptr;  ///< null: there is none
  SunShadow inserted_shadow = {};  ///< of what casts shadows on photographs; without maps: nothing does
};

}  // namespace parvis::shading
