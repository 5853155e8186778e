// The sky behind the place, the land below its horizon, and the sun's disc.

uniform vec3 viewer;
uniform mat4 world_from_clip;
in vec2 screen;
out vec4 colour;

const float sun_radius = 0.00465;       // radians
const float sun_solid_angle = 6.79e-5;  // steradians

void main() {
  vec4 far = world_from_clip * vec4(screen, 1.0, 1.0);
  vec3 direction = normalize(far.xyz / far.w - viewer);
  float from_centre = length(direction - to_sun) / sun_radius;
  float share = clamp((1.0 - from_centre) / max(fwidth(from_centre), 1e-6) + 0.5, 0.0, 1.0);
  vec3 behind = beyond_land(sky_radiance(direction, 0.0), direction.z, haze_per_m, haze_radiance);
  colour = vec4(displayed(behind + share / sun_solid_angle * sun_irradiance), 1.0);
}
