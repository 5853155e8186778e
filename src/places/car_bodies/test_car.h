// Small cars for tests: the sides of a body with arches and panes, and wheels.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "scene/data/model.h"
#include "scene/data/part_division.h"

namespace parvis::car_bodies::test {

inline constexpr float axle_x = 1.3f, arch_z = 0.3f, arch_radius = 0.36f;
inline constexpr float half_width = 0.85f, shoulder_z = 0.85f, roof_z = 1.4f;

/// Adds a quad, its normal by the order of its corners.
inline void add_quad(scene::Part& part, const glm::vec3 (&corners)[4], glm::vec2 uv_low = glm::vec2(0.0f),
                     glm::vec2 uv_high = glm::vec2(0.0f)) {
  const std::uint32_t first = std::uint32_t(part.mesh.positions.size());
  const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
  const glm::vec2 uvs[4]{uv_low, {uv_high.x, uv_low.y}, uv_high, {uv_low.x, uv_high.y}};
  for (std::size_t k = 0; k < 4; ++k) {
    part.mesh.positions.push_back(corners[k]);
    part.mesh.normals.push_back(normal);
    part.mesh.uvs.push_back(uvs[k]);
  }
  for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) part.mesh.indices.push_back(first + k);
}

/// The left half in one colour, the right half in another one; sRGB and alpha.
inline scene::Texture picture(const std::string& name, glm::u8vec4 left, glm::u8vec4 right) {
  scene::Texture texture{.name = name, .image = Image8(8, 8, 4, 255)};
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      const glm::u8vec4 colour = x < 4 ? left : right;
      for (int channel = 0; channel < 4; ++channel) texture.image.at(x, y)[channel] = colour[channel];
    }
  return texture;
}

/// Colours of the body's picture.
inline constexpr glm::u8vec4 blue(30, 60, 200, 255), grey(120, 122, 124, 255);

/// Sides of a body 4.4 m long with two round arches, a bonnet at +x, and a cabin whose panes are grey in the
/// picture: left half blue paint, right half grey glass.
inline scene::Model bare_body() {
  scene::Model model;
  model.textures.push_back(picture("body", blue, grey));
  model.materials.push_back({.name = "body", .base_colour = glm::vec3(1.0f), .base_colour_texture = 0});
  scene::Part part;
  part.object = "shell";
  const auto arch = [](float x) {
    float low = 0.12f;
    for (const float axle : {-axle_x, axle_x})
      if (const float off = x - axle; std::abs(off) < arch_radius)
        low = std::max(low, arch_z + std::sqrt(arch_radius * arch_radius - off * off));
    return low;
  };
  constexpr float step = 0.02f;
  constexpr int steps = 220, cabin_begin = 15, cabin_end = 145;
  for (int i = 0; i < steps; ++i)
    for (const float y : {-half_width, half_width}) {
      const float x = -2.2f + float(i) * step, low = arch(x + 0.5f * step);
      add_quad(part, {{x, y, low}, {x + step, y, low}, {x + step, y, shoulder_z}, {x, y, shoulder_z}},
               {0.05f, 0.1f}, {0.45f, 0.9f});
      if (i >= cabin_begin && i < cabin_end)
        add_quad(part, {{x, y, shoulder_z}, {x + step, y, shoulder_z}, {x + step, y, roof_z}, {x, y, roof_z}},
                 {0.55f, 0.3f}, {0.8f, 0.6f});
    }
  model.parts.push_back(part);
  return model;
}

/// Makes the triangles of part 0 whose middle `takes` a part of their own; the last one.
template <class Takes>
scene::Part& set_apart(scene::Model& model, const std::string& object, const Takes& takes) {
  const Mesh& mesh = model.parts[0].mesh;
  std::vector<bool> is_taken(mesh.triangle_count());
  for (std::size_t i = 0; i < is_taken.size(); ++i) {
    glm::vec3 middle(0.0f);
    for (std::size_t k = 0; k < 3; ++k) middle += mesh.positions[mesh.indices[3 * i + k]] / 3.0f;
    is_taken[i] = takes(middle);
  }
  scene::Part taken = scene::split_off(model.parts[0], is_taken);
  taken.object = object;
  model.parts.push_back(std::move(taken));
  return model.parts.back();
}

/// Where bare_body has its panes.
inline bool is_above_shoulder(glm::vec3 at) { return at.z > shoulder_z; }

/// A body whose panes are an object of their own, "panes", with material 1 and no picture.
inline scene::Model body_with_panes(const scene::Material& material) {
  scene::Model model = bare_body();
  model.materials.push_back(material);
  set_apart(model, "panes", is_above_shoulder).material = 1;
  return model;
}

/// A disc about the y axis with a tread: a wheel.
inline void add_disc(scene::Part& part, glm::vec3 centre, float radius, float width, int corners = 24) {
  const auto at = [&](int i, float r, float y) {
    const float angle = glm::two_pi<float>() * float(i) / float(corners);
    return centre + glm::vec3(r * std::cos(angle), y, r * std::sin(angle));
  };
  const float half = 0.5f * width;
  for (int i = 0; i < corners; ++i) {
    add_quad(part,
             {at(i, radius, -half), at(i + 1, radius, -half), at(i + 1, radius, half), at(i, radius, half)});
    for (const float y : {-half, half})
      add_quad(part, {at(i, 0.1f * radius, y), at(i, radius, y), at(i + 1, radius, y),
                      at(i + 1, 0.1f * radius, y)});
  }
}

inline constexpr float wheel_radius = 0.31f, wheel_width = 0.2f, wheel_y = 0.72f;

/// A car with four wheels that are objects "Circle", "Circle.001" and so on, in the body's frame and
/// material.
inline scene::Model car_with_wheels() {
  scene::Model model = bare_body();
  int number = 0;
  for (const float x : {-axle_x, axle_x})
    for (const float y : {-wheel_y, wheel_y}) {
      scene::Part wheel;
      wheel.object = number == 0 ? "Circle" : "Circle.00" + std::to_string(number);
      ++number;
      add_disc(wheel, {x, y, wheel_radius}, wheel_radius, wheel_width);
      model.parts.push_back(std::move(wheel));
    }
  return model;
}

/// The model as a file has it that is turned or in another unit.
inline scene::Model moved(scene::Model model, const glm::mat4& file_from_car) {
  for (scene::Part& part : model.parts) {
    Mesh mesh;
    append(mesh, part.mesh, file_from_car);
    part.mesh = std::move(mesh);
  }
  return model;
}

/// A rotation, counter-clockwise about the axis.
inline glm::mat4 turned_about(glm::vec3 axis, float degrees) {
  return glm::rotate(glm::mat4(1.0f), glm::radians(degrees), axis);
}

/// The same scale along all axes.
inline glm::mat4 scaled(float factor) { return glm::scale(glm::mat4(1.0f), glm::vec3(factor)); }

}  // namespace parvis::car_bodies::test
