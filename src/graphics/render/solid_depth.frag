// Depth of what has no holes.
void main() {}
