// Lets GLSL that is mathematics compile as C++ over glm, so that the ray tracer and the unit tests run the
// very shader code. Such a file has literals with 'f', no swizzles, no implicit conversions, no `in`/`out`
// but through the macros. Include it, then the .glsl file inside namespace parvis::shading.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace parvis::shading {

using glm::abs, glm::clamp, glm::cross, glm::dot, glm::exp, glm::exp2, glm::floor, glm::fract, glm::length,
    glm::log2;
using glm::ivec2, glm::uvec4, glm::vec2, glm::vec3, glm::vec4, glm::mat3, glm::mat4;
using glm::max, glm::min, glm::mix, glm::normalize, glm::pow, glm::reflect, glm::sign, glm::sin, glm::cos,
    glm::sqrt;
using glm::smoothstep, glm::step, glm::atan, glm::acos, glm::asin, glm::transpose, glm::inversesqrt;

}  // namespace parvis::shading

#define GLSL_FUNCTION inline  ///< before every shared function; empty in GLSL
#define GLSL_OUT(type) type&  ///< an output parameter; `out type` in GLSL
/// Declares a uniform block in GLSL and the struct of its bytes in C++: of mat4, vec4 and arrays of them,
/// then floats, which std140 lays out as C++ does.
#define UNIFORM_BLOCK(name) struct name
