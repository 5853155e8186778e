// What multiple_environment_maps.frag reads: the main view's mirror rays, the city's height field, and the
// reference maps with the table that says which maps lie around a place.
uniform highp sampler2DArray ray_starts;  // xyz; w: roughness of the base
uniform highp sampler2DArray
    ray_directions;     // octahedral; z: roughness of the coat, w: the object's number plus 1
uniform int ray_layer;  // of these two: the first ray of pixels, or the second of those that surfaces share
uniform int reflecting_object;

uniform highp sampler2D heights;
uniform highp sampler2DArray map_colours;
uniform highp sampler2DArray map_glosses;
uniform highp sampler2DArray map_distances;
uniform highp usampler2D map_choice;  // four maps per ground cell
uniform highp sampler2D map_places;
#include "reflections/environment_rays/map_block.glsl"
