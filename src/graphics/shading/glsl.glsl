// The GLSL side of glsl.h: what shared files need to compile as shaders.
#define GLSL_FUNCTION
#define GLSL_OUT(type) out type
#define UNIFORM_BLOCK(name) layout(std140) uniform name
