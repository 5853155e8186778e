// A backdrop of one brightness behind all else (shown_tree.cpp).
uniform float brightness;
out vec4 radiance;

void main() { radiance = vec4(vec3(brightness), 1.0f); }
