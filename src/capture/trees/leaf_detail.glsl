// Leaves closer than the photographs saw them: a pattern synthesised from the photographs' textures
// (leaf_detail.h) at a quarter and at a sixteenth of the width of their pixels, for shaders and, as C++
// (graphics/shading/glsl.h), for rays. Its mean is 0, and so is the mean of what it changes: opacity and
// premultiplied colour over some of its texels are those of the texture.
const float detail_texels_per_photographed_pixel = 4.0f;
const float detail_octave = 4.0f;           // the second pattern is so many times finer than the first
const float second_detail_offset = 0.371f;  // of the second pattern's place, in widths of the tile
const float min_closer = 1.25f, all_closer = 2.5f;  // times closer than the photographs: none, all of it

/// How much of the detail is shown where pixels are `closer` times finer than the photographs'.
GLSL_FUNCTION float detail_share(float closer) { return smoothstep(min_closer, all_closer, closer); }

/// Linear, premultiplied colour with detail: x changes the opacity (-1..1: all the way to 0 or to 1 of what
/// is half opaque, nothing of what is opaque), y the brightness (relative).
GLSL_FUNCTION vec4 with_detail(vec4 colour, vec2 detail) {
  float alpha = colour.w + min(colour.w, 1.0f - colour.w) * detail.x;
  float factor = (1.0f + detail.y) * alpha / max(colour.w, 1e-6f);
  return vec4(colour.x * factor, colour.y * factor, colour.z * factor, alpha);
}
