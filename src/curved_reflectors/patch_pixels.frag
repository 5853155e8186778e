// Depth and stencil alone.
void main() {}
