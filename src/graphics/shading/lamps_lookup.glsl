// The light of all lamps near a surface. Needs shading/lamps.glsl, and from the host:
//   uvec4 lamp_cell(vec3 position)   numbers, plus 1, of the lamps that reach the cell: two in each word
//   Lamp lamp_of(int number)
//   float lamp_visible(Lamp lamp, vec3 position, vec3 geometric_normal)   share 0..1 of it that is seen
//
// A software renderer runs the body of a loop once more than it has rounds where the condition comes first:
// these loops check it last, and one over all words stands for one per word.

// Number of the first lamp in a cell's words, which are filled from the front; below 0: none.
GLSL_FUNCTION int first_lamp(uvec4 cell) { return int(cell.x & 65535u) - 1; }

GLSL_FUNCTION uvec4 without_first_lamp(uvec4 cell) {
  cell.x >>= 16u;
  return cell.x != 0u ? cell : uvec4(cell.y, cell.z, cell.w, 0u);
}

GLSL_FUNCTION LampLight lamp_light(Surface s, vec3 position, vec3 geometric_normal, vec3 to_viewer) {
  LampLight light = no_lamp_light();
  uvec4 cell = lamp_cell(position);
  do {
    int number = first_lamp(cell);
    if (number >= 0) {
      Lamp lamp = lamp_of(number);
      vec3 to_lamp = vec3(lamp.place.x, lamp.place.y, lamp.place.z) - position;
      float distance_m = max(length(to_lamp), 1e-3f);
      to_lamp /= distance_m;
      vec3 irradiance = lamp_irradiance(lamp, to_lamp, distance_m);
      irradiance *= lamp_visible(lamp, position, geometric_normal);
      light = with_lamp(light, s, to_viewer, to_lamp, irradiance);
      light.glow += lamp_glow(lamp, distance_m);
    }
    cell = without_first_lamp(cell);
  } while (cell.x != 0u);
  return light;
}

// Their irradiance alone.
GLSL_FUNCTION vec3 irradiance_of_lamps(vec3 position, vec3 normal) {
  vec3 sum = vec3(0.0f);
  uvec4 cell = lamp_cell(position);
  do {
    int number = first_lamp(cell);
    if (number >= 0) {
      Lamp lamp = lamp_of(number);
      vec3 to_lamp = vec3(lamp.place.x, lamp.place.y, lamp.place.z) - position;
      float distance_m = max(length(to_lamp), 1e-3f);
      to_lamp /= distance_m;
      sum += max(dot(normal, to_lamp), 0.0f) * lamp_visible(lamp, position, normal) *
             lamp_irradiance(lamp, to_lamp, distance_m);
    }
    cell = without_first_lamp(cell);
  } while (cell.x != 0u);
  return sum;
}
