// Depth, stencil, and that nothing is shown there yet.
out vec4 radiance;

void main() { radiance = vec4(0.0f); }
