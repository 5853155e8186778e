// The frame of a surface's texture gradients, and normal mapping within it (glTF 2.0, section 3.9.3).

// Steps along a surface and what texture coordinates make of them: a triangle's two edges, or two pixels'
// differences.
struct TextureFrame {
  vec3 step_1;  // metres, in the world
  vec3 step_2;
  vec2 uv_1;
  vec2 uv_2;
};

// The unit `normal` turned by `texel`, the normal map's value in 0..1, times `scale`: +x along u, +y against
// v.
GLSL_FUNCTION vec3 mapped_normal(TextureFrame frame, vec3 normal, vec3 texel, float scale) {
  float determinant = frame.uv_1.x * frame.uv_2.y - frame.uv_1.y * frame.uv_2.x;
  vec3 along_u = (frame.step_1 * frame.uv_2.y - frame.step_2 * frame.uv_1.y) * sign(determinant);
  vec3 along_v = (frame.step_2 * frame.uv_1.x - frame.step_1 * frame.uv_2.x) * sign(determinant);
  vec3 tangent = along_u - normal * dot(normal, along_u);
  float size = dot(tangent, tangent);
  if (size < 1e-20f || determinant == 0.0f) return normal;
  tangent *= inversesqrt(size);
  vec3 bitangent = cross(normal, tangent);
  bitangent *= dot(bitangent, along_v) > 0.0f ? -1.0f : 1.0f;
  vec3 n = texel * 2.0f - vec3(1.0f);
  return normalize((tangent * n.x + bitangent * n.y) * scale + normal * max(n.z, 0.01f));
}
