// Ink of a line; what it leaves bare of a sample stands in the picture's alpha.
flat in float ink;
out vec4 left_bare;

void main() { left_bare = vec4(0.0f, 0.0f, 0.0f, ink); }
