// Lamps: spheres that shine all round or into a cone. Their light falls off with the square of the distance
// and ends at their reach (Karis 2013, Real Shading in Unreal Engine 4); what stands in its way is kept as
// distances in all directions, an octahedral depth map per lamp.

struct Lamp {
  vec4 place;  // xyz: middle, in the world; w: reach, metres
  vec4 power;  // rgb: W/sr; w: layer of its depth map, plus 1; 0: it has none and shines through everything
  vec4 axis;   // unit; w: cosine of half the cone; -2: all round
  vec4 body;   // rgb: radiance of its glass; w: radius
};

const int lamp_map_px = 96, lamp_map_border = 1;  // texels per side, and of its border

// Irradiance on a plane that faces the lamp, in its unhindered light. `to_lamp` is a unit vector.
GLSL_FUNCTION vec3 lamp_irradiance(Lamp lamp, vec3 to_lamp, float distance_m) {
  float far = distance_m / lamp.place.w;
  float within = clamp(1.0f - far * far * far * far, 0.0f, 1.0f);
  float nearest = max(distance_m, lamp.body.w);
  float edge = lamp.axis.w;
  float cone = -dot(to_lamp, vec3(lamp.axis.x, lamp.axis.y, lamp.axis.z));
  float share = edge < -1.5f ? 1.0f : smoothstep(edge, edge + 0.5f * (1.0f - edge), cone);
  return (within * within * share / (nearest * nearest)) * vec3(lamp.power.x, lamp.power.y, lamp.power.z);
}

// Radiance of what lies within the lamp: its glass.
GLSL_FUNCTION vec3 lamp_glow(Lamp lamp, float distance_m) {
  return distance_m < lamp.body.w ? vec3(lamp.body.x, lamp.body.y, lamp.body.z) : vec3(0.0f);
}

// Where the depth map of the lamp says whether a surface is lit: texture coordinates, layer, and the depth to
// be compared, as a share of the reach. It is nearer than the surface by as much as that slopes within a
// texel; moving the point along its normal instead would move the edges of shadows at grazing light.
GLSL_FUNCTION vec4 lamp_map_coordinates(Lamp lamp, vec3 position, vec3 geometric_normal) {
  vec3 from_lamp = position + 0.02f * geometric_normal - vec3(lamp.place.x, lamp.place.y, lamp.place.z);
  float distance_m = max(length(from_lamp), 1e-3f);
  from_lamp /= distance_m;
  float cosine = max(abs(dot(from_lamp, geometric_normal)), 0.12f);
  float texel = 0.03f;  // radians
  float slope = texel * (0.7f + sqrt(1.0f - cosine * cosine) / cosine);
  vec2 at = layer_uv(from_lamp, float(lamp_map_px), float(lamp_map_border));
  return vec4(at.x, at.y, lamp.power.w - 1.0f, (distance_m * (1.0f - slope) - 0.03f) / lamp.place.w);
}

// What all lamps do to a surface.
struct LampLight {
  vec3 irradiance;         // on the surface
  vec3 irradiance_behind;  // on its other side, for leaves
  vec3 highlight;          // radiance toward the viewer
  vec3 glow;
};

GLSL_FUNCTION LampLight no_lamp_light() { return LampLight(vec3(0.0f), vec3(0.0f), vec3(0.0f), vec3(0.0f)); }

// Adds light of `irradiance` (on a plane that faces it) from `to_lamp`.
GLSL_FUNCTION LampLight with_lamp(LampLight light, Surface s, vec3 to_viewer, vec3 to_lamp, vec3 irradiance) {
  float n_dot_l = dot(s.normal, to_lamp);
  float lit = clamp(n_dot_l, 0.0f, 1.0f);
  light.irradiance += lit * irradiance;
  light.irradiance_behind += max(-n_dot_l, 0.0f) * irradiance;
  vec3 h = normalize(to_viewer + to_lamp);
  float n_dot_h = clamp(dot(s.normal, h), 0.0f, 1.0f);
  float n_dot_v = clamp(dot(s.normal, to_viewer), 1e-4f, 1.0f);
  float facing = schlick_weight(clamp(dot(to_viewer, h), 0.0f, 1.0f));
  vec3 f0 = specular_f0(s);
  vec3 mirrored =
      (f0 + (vec3(1.0f) - f0) * facing) * ggx_specular(s.roughness, max(lit, 1e-4f), n_dot_v, n_dot_h);
  if (s.clear_coat > 0.0f)
    mirrored += vec3(s.clear_coat * (0.04f + 0.96f * facing) *
                     ggx_specular(s.clear_coat_roughness, max(lit, 1e-4f), n_dot_v, n_dot_h));
  light.highlight += lit * mirrored * irradiance;
  return light;
}

// Radiance toward the viewer.
GLSL_FUNCTION vec3 lamp_radiance(Surface s, vec3 to_viewer, LampLight light) {
  float n_dot_v = clamp(dot(s.normal, to_viewer), 1e-4f, 1.0f);
  vec3 diffuse = (1.0f - s.metallic) / pi * s.base_colour * (vec3(1.0f) - base_reflectance(s, n_dot_v));
  vec3 scattered = diffuse * (light.irradiance + s.translucency * light.irradiance_behind);
  return (1.0f - fresnel_of_coat(s, n_dot_v)) * scattered + light.highlight + light.glow;
}
