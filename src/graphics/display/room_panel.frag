// A rectangle of one colour, or with a texture.
uniform sampler2D panel_texture;
uniform vec4 colour_and_texture;  // w: 0 where the texture is shown
in vec2 panel_share;
out vec4 colour;

void main() {
  colour = colour_and_texture.w > 0.0f ? vec4(colour_and_texture.rgb, 1.0f)
                                       : textureLod(panel_texture, panel_share, 0.0f);
}
