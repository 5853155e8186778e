// The six faces of a local map (Meyer and Loscos 2003, section 4.4) in one picture: three tiles across, two
// up, in OpenGL's order and orientation of a cube map's faces. Each tile's outermost `border` texels show
// what lies beyond the face, so that filters and mipmaps find their neighbours.

// x, y: place on the face, from -1 to 1; z: the face that the direction meets.
GLSL_FUNCTION vec3 place_on_faces(vec3 d) {
  vec3 reach = abs(d);
  if (reach.x >= reach.y && reach.x >= reach.z)
    return vec3((d.x > 0.0f ? -d.z : d.z) / reach.x, -d.y / reach.x, d.x > 0.0f ? 0.0f : 1.0f);
  if (reach.y >= reach.z)
    return vec3(d.x / reach.y, (d.y > 0.0f ? d.z : -d.z) / reach.y, d.y > 0.0f ? 2.0f : 3.0f);
  return vec3((d.z > 0.0f ? d.x : -d.x) / reach.z, -d.y / reach.z, d.z > 0.0f ? 4.0f : 5.0f);
}

// Of length 1 along the face's axis; beyond the face for places beyond -1 to 1.
GLSL_FUNCTION vec3 direction_on_face(vec2 place, int face) {
  if (face == 0) return vec3(1.0f, -place.y, -place.x);
  if (face == 1) return vec3(-1.0f, -place.y, place.x);
  if (face == 2) return vec3(place.x, 1.0f, place.y);
  if (face == 3) return vec3(place.x, -1.0f, -place.y);
  if (face == 4) return vec3(place.x, -place.y, 1.0f);
  return vec3(-place.x, -place.y, -1.0f);
}

// South-west corner of a face's tile in the picture, in texels.
GLSL_FUNCTION vec2 tile_corner(int face, float tile) {
  int row = face / 3;
  return tile * vec2(float(face - 3 * row), float(row));
}

// Texels from the picture's corner of a direction.
GLSL_FUNCTION vec2 texel_on_tiles(vec3 direction, float tile, float border) {
  vec3 place = place_on_faces(direction);
  vec2 in_tile = (vec2(place.x, place.y) * 0.5f + vec2(0.5f)) * (tile - 2.0f * border) + vec2(border);
  return tile_corner(int(place.z), tile) + in_tile;
}

// Place on the face of a point of its tile, in texels from the tile's corner.
GLSL_FUNCTION vec2 place_of_texel(vec2 in_tile, float tile, float border) {
  return (in_tile - vec2(border)) * (2.0f / (tile - 2.0f * border)) - vec2(1.0f);
}
