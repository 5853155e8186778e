// What a surface is lit by, after frame.glsl and shadow_filter.glsl.

ShadowMaps shadow_maps() {
  ShadowMaps maps;
  maps.uvz_from_world[0] = far_uvz;
  maps.uvz_from_world[1] = near_uvz;
  maps.texel_m = shadow_texel_m;
  maps.texel_uv = shadow_texel_uv;
  maps.growth = 0.0;
  maps.tile_count = 0;
  return maps;
}

vec4 visibility_cell(vec3 position, vec3 normal) {
  return textureLod(
      visibility_map,
      sky_visibility_coordinates(
          SkyVisibilityGrid(visibility_origin.xyz, visibility_size, visibility_origin.w), position, normal),
      0.0);
}

BouncedCell bounced_cell(vec3 position, vec3 normal) {
  BouncedCell cell = BouncedCell(vec4(0.0), vec3(0.0), vec3(1.0));
  if (bounced_layers > 0.5) {
    vec3 uvw = bounced_coordinates(
        BouncedGrid(bounced_origin.xyz, bounced_size, bounced_origin.w, bounced_layers), position, normal);
    cell.lobe = bounced_scale * textureLod(bounced_map, uvw, 0.0);
    cell.colour = textureLod(bounced_map, uvw + vec3(0.0, 0.0, 1.0 / 3.0), 0.0).rgb;
    cell.sky = textureLod(bounced_map, uvw + vec3(0.0, 0.0, 2.0 / 3.0), 0.0).rgb;
  }
  return cell;
}

vec3 surroundings(vec4 cell, BouncedCell bounced, vec3 direction, float roughness) {
  return sky_share_of_direction(cell, direction) * sky_radiance(direction, roughness) +
         bounced_radiance(bounced, direction);
}
