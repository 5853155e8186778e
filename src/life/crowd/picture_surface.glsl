// The surface that a person's picture shows.
uniform highp sampler2DArray picture_shapes;   // normals in the person's frame, coverage
uniform highp sampler2DArray picture_colours;  // of what the person wears

flat in vec4 picture_layers;  // of shape and colours; cosine and sine of the heading

Surface surface_at(SeenPoint seen, inout float sun, out float alpha) {
  vec4 shape = texture(picture_shapes, vec3(uv, picture_layers.x));
  alpha = shape.a;
  vec3 n = 2.0f * shape.rgb - 1.0f;
  vec2 turn = picture_layers.zw;
  Surface s;
  s.normal = normalize(vec3(turn.x * n.x - turn.y * n.y, turn.y * n.x + turn.x * n.y, n.z) +
                       vec3(0.0f, 0.0f, 1e-4f));
  s.base_colour = texture(picture_colours, vec3(uv, picture_layers.y)).rgb;
  s.metallic = 0.0f;
  s.roughness = 0.85f;
  s.clear_coat = 0.0f;
  s.clear_coat_roughness = 0.03f;
  s.translucency = 0.0f;
  s.occlusion = 1.0f;
  s.emission = vec3(0.0f);
  return s;
}
