// The pixels that show a patch of a reflector.
layout(location = 0) in vec3 reflector_position;

uniform mat4 clip_from_reflector;

void main() { gl_Position = clip_from_reflector * vec4(reflector_position, 1.0f); }
