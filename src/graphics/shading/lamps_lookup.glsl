// The light of all lamps near a surface. Needs shading/lamps.glsl, and from the host:
//   uvec4 lamp_cell(vec3 position)   numbers, plus 1, of the lamps that reach the cell: two in each word
//   Lamp lamp_of(int number)
//   float lamp_visible(Lamp lamp, vec3 position, vec3 geometric_normal)   share 0..1 of it that is seen
GLSL_FUNCTION LampLight lamp_light(Surface s, vec3 position, vec3 geometric_normal, vec3 to_viewer) {
  LampLight light = no_lamp_light();
  uvec4 cell = lamp_cell(position);
  for (int i = 0; i < 4; ++i) {
    for (uint word = cell[i]; word != 0u; word >>= 16u) {
      Lamp lamp = lamp_of(int(word & 65535u) - 1);
      vec3 to_lamp = vec3(lamp.place.x, lamp.place.y, lamp.place.z) - position;
      float distance_m = max(length(to_lamp), 1e-3f);
      to_lamp /= distance_m;
      vec3 irradiance = lamp_irradiance(lamp, to_lamp, distance_m);
      irradiance *= lamp_visible(lamp, position, geometric_normal);
      light = with_lamp(light, s, to_viewer, to_lamp, irradiance);
      light.glow += lamp_glow(lamp, distance_m);
    }
  }
  return light;
}

// Their irradiance alone.
GLSL_FUNCTION vec3 irradiance_of_lamps(vec3 position, vec3 normal) {
  vec3 sum = vec3(0.0f);
  uvec4 cell = lamp_cell(position);
  for (int i = 0; i < 4; ++i) {
    for (uint word = cell[i]; word != 0u; word >>= 16u) {
      Lamp lamp = lamp_of(int(word & 65535u) - 1);
      vec3 to_lamp = vec3(lamp.place.x, lamp.place.y, lamp.place.z) - position;
      float distance_m = max(length(to_lamp), 1e-3f);
      to_lamp /= distance_m;
      sum += max(dot(normal, to_lamp), 0.0f) * lamp_visible(lamp, position, normal) *
             lamp_irradiance(lamp, to_lamp, distance_m);
    }
  }
  return sum;
}
