#include "formats/meshes/material_mask.h"

#include <algorithm>
#include <sstream>

#include "base/colour.h"
#include "scene/script/schema.h"

namespace parvis::scene {
namespace {

constexpr float usual_tolerance = 0.1f, usual_grey = 0.05f;

/// The part of `uv` that a repeating picture shows; 1 stays 1, the picture's far edge.
glm::vec2 wrapped(glm::vec2 uv) {
  for (int axis = 0; axis < 2; ++axis)
    if (uv[axis] < 0.0f || uv[axis] > 1.0f) uv[axis] -= std::floor(uv[axis]);
  return uv;
}

glm::vec3 texel(const Image8& image, int x, int y) {
  const std::uint8_t* pixel = image.at(x, y);
  return glm::vec3(pixel[0], pixel[1], pixel[2]) / 255.0f;
}

glm::vec3 texel(const Image8& image, glm::vec2 uv) {
  return texel(image, std::min(int(uv.x * float(image.width)), image.width - 1),
               std::min(int(uv.y * float(image.height)), image.height - 1));
}

/// sRGB colour of a material at a point of its picture.
glm::vec3 colour_at(const Model& model, const Material& material, glm::vec2 uv) {
  if (material.base_colour_texture == no_index) return srgb_from_linear(material.base_colour);
  const Image8& image = model.textures[std::size_t(material.base_colour_texture)].image;
  const glm::vec3 linear = linear_from_srgb(texel(image, uv)) * material.base_colour;
  return srgb_from_linear(linear);
}

glm::vec2 centroid_uv(const Part& part, const Material& material, std::size_t triangle) {
  glm::vec2 sum(0.0f);
  for (std::size_t corner = 0; corner < 3; ++corner)
    sum += part.mesh.uvs[part.mesh.indices[3 * triangle + corner]];
  return wrapped(glm::vec2(material.texture_from_mesh_uv * glm::vec3(sum / 3.0f, 1.0f)));
}

bool is_inside(const MaterialMask::Box& box, glm::vec2 uv) {
  return uv.x >= box.min.x && uv.x <= box.max.x && uv.y >= box.min.y && uv.y <= box.max.y;
}

bool is_grey(float tolerance, glm::vec3 srgb) {
  return std::max({srgb.x, srgb.y, srgb.z}) - std::min({srgb.x, srgb.y, srgb.z}) <= tolerance;
}

bool is_near(const MaterialMask::Colour& colour, glm::vec3 srgb) {
  const glm::vec3 difference = glm::abs(colour.srgb - srgb);
  return std::max({difference.x, difference.y, difference.z}) <= colour.tolerance;
}

bool holds_at(const MaterialMask& mask, glm::vec2 uv, glm::vec3 srgb) {
  return (!mask.box || is_inside(*mask.box, uv)) && (!mask.colour || is_near(*mask.colour, srgb)) &&
         (!mask.grey || is_grey(*mask.grey, srgb));
}

/// Takes the numbers at the head of `words`, `count` at most.
std::vector<double> take_numbers(std::istringstream& words, std::size_t count) {
  std::vector<double> numbers;
  while (numbers.size() < count) {
    const std::istringstream::pos_type before = words.tellg();
    std::string word;
    if (!(words >> word)) break;
    const std::vector<double> number = parse_numbers(word);
    if (number.size() != 1) {
      words.seekg(before);
      break;
    }
    numbers.push_back(number[0]);
  }
  words.clear();
  return numbers;
}

}  // namespace

Result<MaterialMask> parse_mask(std::string_view text, const FileLocation& where) {
  const Error mismatch =
      error_at(where,
               "mask=\"{}\": expected \"object\", \"box u0 v0 u1 v1\" (0..1, v down from the top) "
               "\"colour #RRGGBB tolerance\" (0..1), \"grey tolerance\", or several of them",
               text.substr(0, 60));
  MaterialMask mask;
  std::istringstream words{std::string(text)};
  std::string word;
  bool is_empty = true;
  while (words >> word) {
    is_empty = false;
    if (word == "object") continue;
    if (word == "box" && !mask.box) {
      const std::vector<double> n = take_numbers(words, 4);
      if (n.size() != 4 || n[0] >= n[2] || n[1] >= n[3]) return mismatch;
      mask.box = {glm::vec2(n[0], n[1]), glm::vec2(n[2], n[3])};
    } else if (word == "colour" && !mask.colour && words >> word) {
      const auto rgb = parse_value({.name = "mask", .type = AttributeType::colour}, word, Roots(""), where);
      const std::vector<double> tolerance = take_numbers(words, 1);
      if (!rgb || !word.starts_with('#')) return mismatch;
      const float allowed = tolerance.empty() ? usual_tolerance : float(tolerance[0]);
      mask.colour = {srgb_from_linear(std::get<glm::vec3>(*rgb)), allowed};
    } else if (word == "grey" && !mask.grey) {
      const std::vector<double> tolerance = take_numbers(words, 1);
      mask.grey = tolerance.empty() ? usual_grey : float(tolerance[0]);
    } else {
      return mismatch;
    }
  }
  if (is_empty) return mismatch;
  return mask;
}

bool lies_in(const MaterialMask& mask, const Model& model, const Part& part, std::size_t triangle) {
  const Material& material = model.materials[std::size_t(part.material)];
  const glm::vec2 uv = centroid_uv(part, material, triangle);
  return holds_at(mask, uv, colour_at(model, material, uv));
}

Image8 painted(const Image8& picture, std::span<const MaterialMask> masks, glm::vec3 colour) {
  const glm::vec3 srgb = 255.0f * srgb_from_linear(glm::clamp(colour, 0.0f, 1.0f)) + 0.5f;
  const glm::vec2 size(picture.width, picture.height);
  Image8 result = picture;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const glm::vec2 uv = (glm::vec2(x, y) + 0.5f) / size;
      const glm::vec3 old = texel(picture, x, y);
      const bool is_taken = std::any_of(masks.begin(), masks.end(),
                                        [&](const MaterialMask& mask) { return holds_at(mask, uv, old); });
      if (!is_taken) continue;
      for (int channel = 0; channel < 3; ++channel) result.at(x, y)[channel] = std::uint8_t(srgb[channel]);
      if (result.channels == 4) result.at(x, y)[3] = 255;
    }
  return result;
}

}  // namespace parvis::scene
