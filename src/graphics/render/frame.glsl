// What is the same for all that one view draws: the uniform block, and in C++ the struct that renderer.cpp
// fills.
const float max_radiance = 30000.0f;  // targets hold half floats

UNIFORM_BLOCK(Frame) {
  mat4 clip_from_world;
  vec4 viewer_position;
  vec4 frame_to_sun;  // w: haze per metre
  vec4 frame_sun_irradiance;
  vec4 frame_spot;  // where the sun's light comes from if it is a spot light; w: cosine of half its cone; -2:
                    // it is none
  vec4 frame_haze;  // rgb; w: heading of the sky
  vec4 frame_sky_sh[9];
  mat4 frame_uvz_from_world[2];
  vec4 frame_shadow_texel;  // metres in the far and the near map; z: in texture coordinates; w: growth of the
                            // near map's
  vec4 frame_shadow_tiles[4];
  mat4 frame_inserted_uvz_from_world[2];  // maps of what casts shadows on photographs
  vec4 frame_inserted_texel;              // metres in the far and the near one; z: in texture coordinates
  vec4 frame_shadow_extra;  // x: tiles of the near map; y: 1 where traced_sun_texture holds this view's sun
  vec4 frame_size;          // pixels; z: levels of the sky
  vec4 frame_visibility_origin;  // of the sky visibility grid; w: lift
  vec4 frame_visibility_size;
  vec4 frame_lamps;           // xy: corner of the grid of lamps; z: metres per cell
  vec4 frame_lamp_cells;      // xy: cells of the grid; z: texel at which lamps begin
  vec4 frame_bounced_origin;  // of the grid of bounced light; w: lift
  vec4 frame_bounced_size;    // w: layers; 0: there is none
  vec4 frame_realism;         // realism_at
};
