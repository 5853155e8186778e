#include "capture/trees/crossed_billboards.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "base/colour.h"
#include "base/parallel.h"
#include "capture/trees/billboard_math.h"

namespace parvis::trees {
namespace {

constexpr int fallback_height = 512;    // pixels of a picture of the model
constexpr float fallback_far = 100.0f;  // heights of the tree: from there a view is nearly parallel

glm::vec3 level_direction(glm::vec3 from, glm::vec3 to) {
  const glm::vec3 way(to.x - from.x, to.y - from.y, 0.0f);
  const float length = glm::length(way);
  return length > 0.0f ? way / length : glm::vec3(0.0f, 1.0f, 0.0f);
}

ImageF premultiplied(const Image8& picture) {
  ImageF result = linear_from_srgb8(picture);
  for (std::size_t i = 0; i < result.pixels.size(); i += 4)
    for (std::size_t c = 0; c < 3; ++c) result.pixels[i + c] *= result.pixels[i + 3];
  return result;
}

/// Bilinear; nothing beyond the picture.
glm::vec4 colour_at(const ImageF& picture, glm::vec2 pixel) {
  const glm::vec2 at = pixel - 0.5f, low = glm::floor(at), f = at - low;
  glm::vec4 sum(0.0f);
  for (int k = 0; k < 4; ++k) {
    const int x = int(low.x) + (k & 1), y = int(low.y) + (k >> 1);
    if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) continue;
    const float* p = picture.at(x, y);
    sum += (k & 1 ? f.x : 1.0f - f.x) * (k >> 1 ? f.y : 1.0f - f.y) * glm::vec4(p[0], p[1], p[2], p[3]);
  }
  return sum;
}

/// Where a ray intersects one of the planes, metres.
std::optional<float> distance_to(const CrossedBillboards& billboards, std::size_t which, const ViewRay& ray) {
  const float along = glm::dot(ray.direction, billboards.normals[which]);
  if (std::abs(along) < 1e-6f) return std::nullopt;
  const float distance = glm::dot(billboards.middle - ray.origin, billboards.normals[which]) / along;
  return distance > 0.0f ? std::optional(distance) : std::nullopt;
}

}  // namespace

CrossedBillboards crossed_billboards(std::span<const TreeView> views, const Bounds& tree) {
  assert(views.size() >= 2);
  CrossedBillboards result;
  result.middle = tree.centre();
  const auto facing = [&](const TreeView& view) {
    return level_direction(result.middle, view.camera.position_in_world);
  };
  const glm::vec3 first = facing(views.front());
  const TreeView& second = *std::ranges::min_element(
      views, {}, [&](const TreeView& view) { return std::abs(glm::dot(first, facing(view))); });
  const std::array<const TreeView*, 2> chosen{&views.front(), &second};
  for (std::size_t i = 0; i < 2; ++i) {
    result.normals[i] = facing(*chosen[i]), result.cameras[i] = chosen[i]->camera;
    result.photographs[i] = premultiplied(chosen[i]->picture);
  }
  return result;
}

ImageF render_crossed_billboards(const CrossedBillboards& billboards, const Pinhole& camera) {
  ImageF picture(camera.width, camera.height, 4);
  parallel_for(std::size_t(camera.height), [&](std::size_t row) {
    for (int x = 0; x < camera.width; ++x) {
      const ViewRay ray = camera.ray({float(x) + 0.5f, float(row) + 0.5f});
      std::array<glm::vec4, 2> colours{glm::vec4(0.0f), glm::vec4(0.0f)};
      std::array<float, 2> distances{1e30f, 1e30f};
      for (std::size_t i = 0; i < 2; ++i) {
        const std::optional<float> distance = distance_to(billboards, i, ray);
        if (!distance) continue;
        const glm::vec3 seen = billboards.cameras[i].project(ray.origin + *distance * ray.direction);
        if (seen.z <= 0.0f) continue;
        colours[i] = colour_at(billboards.photographs[i], glm::vec2(seen)), distances[i] = *distance;
      }
      const std::size_t front = distances[0] <= distances[1] ? 0 : 1;
      const glm::vec4 colour = display::over(colours[front], colours[1 - front]);
      for (int c = 0; c < 4; ++c) picture.at(x, int(row))[c] = colour[c];
    }
  });
  return picture;
}

namespace {

/// A view along a level direction that the tree's box fills, from far away.
Pinhole far_camera(const Bounds& box, glm::vec3 to_camera, float half_width_m) {
  Camera camera;
  const float distance_m = fallback_far * box.size().z;
  camera.world_from_camera = look_at(box.centre() + distance_m * to_camera, box.centre());
  const int width = std::max(4, int(std::lround(2.0f * half_width_m / box.size().z * fallback_height)));
  Pinhole pinhole = pinhole_of(camera, width, fallback_height);
  pinhole.focal = glm::vec2(fallback_height / box.size().z * distance_m);
  return pinhole;
}

scene::Texture texture_of(ImageF premultiplied, std::string name) {
  for (std::size_t i = 0; i < premultiplied.pixels.size(); i += 4)
    for (std::size_t c = 0; c < 3; ++c)
      premultiplied.pixels[i + c] /= std::max(premultiplied.pixels[i + 3], 1e-4f);
  scene::Texture texture;
  texture.name = std::move(name), texture.image = srgb8_from_linear(premultiplied),
  texture.set_repeats(false);
  return texture;
}

}  // namespace

scene::Model crossed_model(const BillboardTree& tree) {
  scene::Model model;
  model.name = "captured tree";
  const Bounds box = tree.grid.box();
  const auto facing = [&](std::size_t view) {
    return level_direction(box.centre(), tree.views[view].camera.position_in_world);
  };
  std::size_t second = 0;
  for (std::size_t i = 1; i < tree.views.size(); ++i)
    if (std::abs(glm::dot(facing(0), facing(i))) < std::abs(glm::dot(facing(0), facing(second)))) second = i;
  for (const std::size_t view : {std::size_t(0), second}) {
    const glm::vec3 to_camera = tree.views.empty() ? glm::vec3(0, -1, 0) : facing(view);
    const glm::vec3 right(-to_camera.y, to_camera.x, 0.0f), half = 0.5f * box.size();
    const float half_width_m = std::abs(right.x) * half.x + std::abs(right.y) * half.y;
    const int number = int(model.parts.size());
    model.textures.push_back(texture_of(render_billboards(tree, far_camera(box, to_camera, half_width_m)),
                                        fmt::format("tree_{}", number)));
    scene::Material material;
    material.name = fmt::format("tree {}", number), material.base_colour = glm::vec3(1.0f);
    material.base_colour_texture = number, material.alpha_mode = scene::Alpha::cutout;
    material.is_double_sided = true;
    model.materials.push_back(material);
    scene::Part part;
    part.object = material.name, part.material = number;
    for (int corner = 0; corner < 4; ++corner) {
      const float x = corner & 1 ? 1.0f : -1.0f, y = corner & 2 ? 1.0f : -1.0f;
      part.mesh.positions.push_back(box.centre() + x * half_width_m * right + glm::vec3(0, 0, y * half.z));
      part.mesh.normals.push_back(to_camera);
      part.mesh.uvs.emplace_back(0.5f + 0.5f * x, 0.5f - 0.5f * y);
    }
    part.mesh.indices = {0, 1, 3, 0, 3, 2};
    model.parts.push_back(std::move(part));
  }
  if (tree.trunk) {
    scene::Model trunk = model_of(*tree.trunk);
    const int texture = int(model.textures.size()), material = int(model.materials.size());
    trunk.materials.front().base_colour_texture = texture, trunk.parts.front().material = material;
    model.textures.push_back(std::move(trunk.textures.front()));
    model.materials.push_back(std::move(trunk.materials.front()));
    model.parts.push_back(std::move(trunk.parts.front()));
  }
  return model;
}

}  // namespace parvis::trees
