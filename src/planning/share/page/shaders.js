// Shaders of the page: Parvis's files of graphics/shading, which are GLSL ES as well, and the page's own.
import beyondLand from '../../../graphics/shading/beyond_land.glsl';
import bouncedLight from '../../../graphics/shading/bounced_light.glsl';
import glass from '../../../graphics/shading/glass.glsl';
import lighting from '../../../graphics/shading/lighting.glsl';
import realism from '../../../graphics/shading/realism.glsl';
import relief from '../../../graphics/shading/relief.glsl';
import shadow from '../../../graphics/shading/shadow.glsl';
import shadowFilter from '../../../graphics/shading/shadow_filter.glsl';
import sky from '../../../graphics/shading/sky.glsl';
import skyVisibility from '../../../graphics/shading/sky_visibility.glsl';
import srgb from '../../../graphics/shading/srgb.glsl';
import surface from '../../../graphics/shading/surface.glsl';
import textureFrame from '../../../graphics/shading/texture_frame.glsl';
import toneCurve from '../../../graphics/shading/tone_curve.glsl';
import frame from './frame.glsl';
import lookups from './lookups.glsl';
import skyMain from './sky.glsl';
import surfaceMain from './surface.glsl';

const head = 'precision highp float;\nprecision highp int;\n#define GLSL_FUNCTION\n';
const shared = [sky, beyondLand, surface, realism, srgb, toneCurve, shadow, frame].join('\n');

export const surfaceFragment =
    [head, shared, skyVisibility, bouncedLight, glass, lighting, textureFrame, shadowFilter, lookups, surfaceMain.replace('GLSL_OF_RELIEF\n', `${relief}\n`)].join('\n');
export const skyFragment = [head, shared, skyMain].join('\n');

export const surfaceVertex = `precision highp float;
in vec3 position;
in vec3 normal;
in vec2 uv;
#ifdef HAS_SECOND_UV
in vec2 uv1;
#endif
#ifdef HAS_COLOURS
in vec4 color;
#endif
uniform mat4 modelMatrix, viewMatrix, projectionMatrix;
out vec3 at;
out vec3 vertex_normal;
out vec2 uv_1;
out vec2 uv_2;
out vec4 vertex_colour;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  at = world.xyz;
  vertex_normal = transpose(inverse(mat3(modelMatrix))) * normal;
  uv_1 = uv;
  uv_2 = uv;
  vertex_colour = vec4(1.0);
#ifdef HAS_SECOND_UV
  uv_2 = uv1;
#endif
#ifdef HAS_COLOURS
  vertex_colour = color;
#endif
  gl_Position = projectionMatrix * viewMatrix * world;
}`;

export const skyVertex = `precision highp float;
in vec3 position;
out vec2 screen;
void main() {
  screen = position.xy;
  gl_Position = vec4(position.xy, 1.0, 1.0);
}`;

// Depth from the sun; what is cut out casts no shadow.
export const depthVertex = `precision highp float;
in vec3 position;
in vec2 uv;
uniform mat4 modelMatrix, viewMatrix, projectionMatrix;
out vec2 uv_1;
void main() {
  uv_1 = uv;
  gl_Position = projectionMatrix * viewMatrix * modelMatrix * vec4(position, 1.0);
}`;
export const depthFragment = `precision highp float;
uniform sampler2D base_map;
uniform mat3 base_from_uv;
uniform float alpha, alpha_cutoff;
in vec2 uv_1;
out vec4 colour;
void main() {
#ifdef HAS_HOLES
  if (texture(base_map, (base_from_uv * vec3(uv_1, 1.0)).xy).a * alpha < alpha_cutoff) discard;
#endif
  colour = vec4(1.0);
}`;
