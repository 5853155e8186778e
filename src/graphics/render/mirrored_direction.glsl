// For surfaces whose reflection depends on the mirrored direction alone: `look_along` of surface_body.glsl.

vec3 mirrored_direction;

void look_along(vec3 at, vec3 direction) { mirrored_direction = direction; }
