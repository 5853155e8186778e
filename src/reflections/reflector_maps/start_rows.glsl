// How the texture of a reflector map lays out its starting points: in rows below the map, four texels each.
// GLSL that is C++, too.

const int starts_in_row = 8;
