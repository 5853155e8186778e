#include "places/car_bodies/car_copy.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "places/car_bodies/car_survey.h"
#include "scene/data/part_division.h"

namespace parvis::car_bodies {
namespace {

/// Pairs are in order of x, left before right.
std::string wheel_name(std::size_t wheel, std::size_t count) {
  const std::size_t axle = wheel / 2, last = count / 2 - 1;
  const std::string place = axle == last ? "front"
                            : axle == 0  ? "rear"
                                         : fmt::format("axle_{}", last - axle + 1);
  return fmt::format("wheel_{}_{}", place, wheel % 2 == 0 ? "left" : "right");
}

/// Adds `part` to a node of the copy, its vertices in the node's frame.
void add_part(scene::Model& copy, scene::Part part, const glm::mat4& node_from_part, int node) {
  if (part.mesh.indices.empty()) return;
  Mesh mesh;
  append(mesh, part.mesh, node_from_part);
  part.mesh = std::move(mesh);
  part.node = node, part.deformation = nullptr;
  copy.parts.push_back(std::move(part));
}

/// The triangles of a part that belong to no wheel, then those of each wheel.
std::vector<std::vector<std::uint32_t>> triangles_of(const scene::Part& part, std::size_t index,
                                                     const std::vector<OwnWheel>& wheels) {
  std::vector<std::vector<std::uint32_t>> lists(wheels.size() + 1);
  std::vector<bool> is_taken(part.mesh.triangle_count(), false);
  for (std::size_t i = 0; i < wheels.size(); ++i)
    if (const auto found = wheels[i].triangles.find(index); found != wheels[i].triangles.end()) {
      lists[i + 1] = found->second;
      for (const std::uint32_t triangle : found->second) is_taken[triangle] = true;
    }
  for (std::uint32_t triangle = 0; triangle < is_taken.size(); ++triangle)
    if (!is_taken[triangle]) lists[0].push_back(triangle);
  return lists;
}

scene::Model copied(const scene::Model& model, const CarSurvey& found) {
  scene::Model copy;
  copy.name = model.name;
  copy.textures = model.textures;
  copy.materials = model.materials;
  copy.nodes = {{.name = "car"}};
  for (std::size_t i = 0; i < found.wheels.size(); ++i)
    copy.nodes.push_back(
        {.name = wheel_name(i, found.wheels.size()), .parent = 0, .translation = found.wheels[i].centre});
  const Body body(model, found.frame.car_from_model());
  for (std::size_t i = 0; i < model.parts.size(); ++i) {
    scene::Part rigid = model.parts[i];
    rigid.deformation = nullptr;
    std::vector<scene::Part> pieces = scene::divided(rigid, triangles_of(rigid, i, found.wheels));
    for (std::size_t piece = 0; piece < pieces.size(); ++piece) {
      const glm::mat4 node_from_car = glm::translate(
          glm::mat4(1.0f), -glm::vec3(copy.nodes[piece].translation));  // node 0 stands at the origin
      add_part(copy, std::move(pieces[piece]), node_from_car * body.car_from_part(i), int(piece));
    }
  }
  return copy;
}

}  // namespace

Result<std::optional<CarCopy>> car_copy(const scene::Model& model, const std::string& file) {
  const Result<CarSurvey> found = survey(model, file);
  if (!found) return found.errors();
  if (found->copy_reason.empty()) return std::optional<CarCopy>();
  CarCopy copy{copied(model, *found), remarks(found->frame)};
  copy.remark += fmt::format("// The model is a copy of {}, for {}.\n", file, found->copy_reason);
  return std::optional<CarCopy>(std::move(copy));
}

}  // namespace parvis::car_bodies
