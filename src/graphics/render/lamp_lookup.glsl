// The scene's lamps: at texture unit 8 a table of cells and, after them, lamps of four texels; at unit 9
// their depth maps.
#include "graphics/render/frame.glsl"
#include "graphics/shading/octahedral.glsl"
#include "graphics/shading/surface.glsl"
#include "graphics/shading/lamps.glsl"

uniform highp usampler2D lamp_table;
uniform highp sampler2DArrayShadow lamp_maps;

#include "graphics/render/lamp_table_layout.glsl"

uvec4 lamp_texel(int number) {
  return texelFetch(lamp_table, ivec2(number % lamp_table_px, number / lamp_table_px), 0);
}

uvec4 lamp_cell(vec3 position) {
  ivec2 cell = ivec2(floor((position.xy - frame_lamps.xy) / frame_lamps.z));
  ivec2 cells = ivec2(frame_lamp_cells.xy);  // none where no lamp is lit
  if (min(cell.x, cell.y) < 0 || cell.x >= cells.x || cell.y >= cells.y) return uvec4(0u);
  return lamp_texel(cell.y * cells.x + cell.x);
}

Lamp lamp_of(int number) {
  int first = int(frame_lamp_cells.z) + texels_per_lamp * number;
  return Lamp(uintBitsToFloat(lamp_texel(first)), uintBitsToFloat(lamp_texel(first + 1)),
              uintBitsToFloat(lamp_texel(first + 2)), uintBitsToFloat(lamp_texel(first + 3)));
}

float lamp_visible(Lamp lamp, vec3 position, vec3 geometric_normal) {
  if (lamp.power.w < 0.5f) return 1.0f;
  return texture(lamp_maps, lamp_map_coordinates(lamp, position, geometric_normal));
}

#include "graphics/shading/lamps_lookup.glsl"
