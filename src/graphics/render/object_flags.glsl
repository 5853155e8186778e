// The attribute `object` of a vertex: an object's number and, in the highest bit, that it receives no
// shadows.
const uint no_shadow_received = 0x80000000u;
