#include "graphics/light/preetham.h"

#include "graphics/shading/glsl.h"

namespace parvis::light {
namespace {

using namespace shading;
#include "graphics/light/preetham.glsl"

}  // namespace

glm::vec3 preetham_radiance_xyz(glm::vec3 direction, glm::vec3 to_sun, float turbidity) {
  return preetham_xyz(direction, to_sun, turbidity);
}

}  // namespace parvis::light
