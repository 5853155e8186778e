// planPicture: a picture with a world file as ground under a place.
#include <array>

#include "base/image_io.h"
#include "formats/drawings/drawing_facts.h"
#include "planning/plan_drawing/plan_nodes.h"
#include "planning/plan_drawing/world_file.h"
#include "scene/script/attribute.h"
#include "scene/script/node_registry.h"
#include "scene/script/scene_builder.h"

namespace parvis::plan_drawing {
namespace {

using namespace scene::attribute;

constexpr int max_side_px = 16'384;  // of a texture
constexpr int cells = 32;            // along a side: curved mirrors place vertices only
constexpr double near_m = 10'000.0;  // about zero: a plan of its own, not on the map

scene::NodeSchema picture_schema() {
  scene::NodeSchema schema{
      .type = "planPicture",
      .help =
          "A picture with a world file (.pgw, .jgw, .tfw) that lies flat under the place or over it: an "
          "aerial "
          "photograph, a scanned plan.",
      .attributes = {text("name", "by which other nodes refer to it"),
                     file("file", "the picture; its world file lies beside it").required(),
                     choice("unit", "of the world file's numbers", {"mm", "cm", "dm", "m", "km", "in", "ft"})
                         .by_default("m")},
      .stands_in = {scene::top_level, "group", "scenario"},
      .example = "planPicture(file=\"plans/aerial.jpg\")"};
  add_plan_attributes(schema);
  return schema;
}

/// Where a picture of `size` lies on the map, in metres.
struct Place {
  WorldFile world;
  glm::dvec2 size{0.0};
  double unit_m = 1.0;

  /// `share` runs from 0 to 1 over the picture.
  glm::dvec2 at(glm::dvec2 share) const { return unit_m * world.at(share * size); }
  glm::dvec3 origin() const {
    const glm::dvec2 middle = at({0.5, 0.5});
    return glm::length(middle) < near_m ? glm::dvec3(0.0) : glm::dvec3(glm::floor(middle), 0.0);
  }
};

/// A flat grid with the picture on it, facing up.
Mesh laid_flat(const Place& place) {
  Mesh mesh;
  const glm::dvec2 origin(place.origin());
  for (int y = 0; y <= cells; ++y)
    for (int x = 0; x <= cells; ++x) {
      const glm::dvec2 share = glm::dvec2(x, y) / double(cells);
      mesh.positions.emplace_back(glm::vec2(place.at(share) - origin), 0.0f);
      mesh.normals.emplace_back(0.0f, 0.0f, 1.0f);
      mesh.uvs.emplace_back(share);
    }
  const glm::dvec2 right = place.at({1, 0}) - place.at({0, 0}), down = place.at({0, 1}) - place.at({0, 0});
  const bool is_mirrored = right.x * down.y - right.y * down.x > 0.0;
  for (int y = 0; y < cells; ++y)
    for (int x = 0; x < cells; ++x) {
      const auto at = [&](int i, int j) { return std::uint32_t((y + j) * (cells + 1) + x + i); };
      std::array corners{at(0, 0), at(0, 1), at(1, 1), at(0, 0), at(1, 1), at(1, 0)};
      if (is_mirrored) std::swap(corners[1], corners[2]), std::swap(corners[4], corners[5]);
      mesh.indices.insert(mesh.indices.end(), corners.begin(), corners.end());
    }
  return mesh;
}

Result<scene::Model> picture_model(const std::filesystem::path& file, double unit_m) {
  const Result<WorldFile> world = read_world_file(file);
  if (!world) return world.errors();
  Result<Image8> image = read_image8(file);
  if (!image) return image.errors();
  if (std::max(image->width, image->height) > max_side_px)
    return error_at({file.string(), 0, 0}, "the picture has {} x {} pixels; expected at most {} along a side",
                    image->width, image->height, max_side_px);
  const Place place{*world, {image->width, image->height}, unit_m};
  scene::Model model;
  model.name = file.stem().string();
  model.nodes.front().name = model.name;
  model.origin = place.origin();
  scene::Texture texture{.name = model.name, .image = *std::move(image)};
  texture.set_repeats(false);
  model.textures.push_back(std::move(texture));
  scene::Material material;
  material.name = model.name, material.base_colour = glm::vec3(1.0f), material.roughness = 1.0f;
  material.base_colour_texture = 0;
  model.materials.push_back(material);
  scene::Part part;
  part.object = model.name, part.mesh = laid_flat(place), part.casts_shadow = false, part.is_backdrop = true;
  model.parts.push_back(std::move(part));
  return model;
}

void build_picture(const scene::Node& node, scene::SceneBuilder& builder) {
  const std::filesystem::path file = node.file("file");
  const std::string unit = node.text("unit");
  scene::Object object;
  object.model = builder.shared_model(
      fmt::format("{}?picture&unit={}", file.string(), unit), [&]() -> std::shared_ptr<const scene::Model> {
        Result<scene::Model> model = picture_model(file, formats::metres_of_unit(unit).value_or(1.0));
        if (model) return std::make_shared<const scene::Model>(*std::move(model));
        builder.fail(model.errors(), node.where_of("file"));
        return nullptr;
      });
  if (!object.model) return;
  object.name = node.gives("name") ? node.text("name") : file.stem().string();
  object.world_from_model = world_from_plan(node, object.model->origin, builder);
  object.is_visible = builder.is_visible() && node.flag("visible");
  builder.add(std::move(object));
}

}  // namespace

void add_picture_node(scene::NodeRegistry& registry) { registry.add(picture_schema(), build_picture); }

}  // namespace parvis::plan_drawing
