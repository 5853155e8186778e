#include "places/paper_city/car.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "base/colour.h"
#include "base/content_hash.h"
#include "formats/meshes/wheel.h"
#include "places/paper_city/car_body.h"
#include "synthesis/lettering.h"
#include "synthesis/window_texture.h"

namespace parvis::city {
namespace {

constexpr int rubber = int(CarSurface::count), alloy = rubber + 1, number_plate = rubber + 2,
              shadow = rubber + 3;

scene::Material material(const char* name, glm::vec3 colour, float metallic, float roughness) {
  scene::Material m;
  m.name = name, m.base_colour = colour, m.metallic = metallic, m.roughness = roughness;
  return m;
}

scene::Material coated(scene::Material m) {
  m.clear_coat = 1.0f, m.clear_coat_roughness = 0.03f, m.is_mirror_like = true;
  return m;
}

scene::Texture texture(const char* name, const Image8& image) {
  scene::Texture result;
  result.name = name, result.image = image, result.set_repeats(false);
  return result;
}

/// Black, with an alpha that fades toward the edges of an oblong.
Image8 shadow_picture() {
  Image8 image(64, 64, 4, 0);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const glm::vec2 p = glm::abs(glm::vec2(float(x) + 0.5f, float(y) + 0.5f) / 32.0f - 1.0f);
      const float side = std::pow(std::pow(p.x, 5.0f) + std::pow(p.y, 5.0f), 0.2f);
      image.at(x, y)[3] = std::uint8_t(205.0f * glm::smoothstep(1.0f, 0.55f, side));
    }
  return image;
}

Image8 plate_picture(std::string_view text) {
  synthesis::SurfaceCanvas canvas(256, 56, 0.52f, 0.11f, synthesis::matt(glm::vec3(0.62f), 0.0f, 0.4f));
  canvas.fill({0.0f, 0.0f, 0.045f, 0.11f}, synthesis::matt(glm::vec3(0.01f, 0.05f, 0.4f), 0.0f, 0.4f));
  const float height = 0.05f, width = synthesis::lettering_width(text, height);
  synthesis::paint_lettering(canvas, text, 0.045f + 0.5f * (0.475f - width), 0.02f, height,
                             synthesis::matt(glm::vec3(0.01f), 0.0f, 0.4f));
  return canvas.pictures(1, 1).colour;
}

/// A number of its own for each kind and paint: two letters, four digits, two letters.
std::string plate_number(const std::string& name) {
  ContentHash hash;
  hash.add_text(name);
  std::uint64_t rest = hash.value();
  const auto next = [&](std::uint64_t count) {
    const std::uint64_t value = rest % count;
    rest /= count;
    return value;
  };
  std::string number = "PV 0000 AA";
  for (const std::size_t i : {3, 4, 5, 6}) number[i] = char('0' + next(10));
  for (const std::size_t i : {8, 9}) number[i] = char('A' + next(26));
  return number;
}

void add_textures(scene::Model& model) {
  model.textures = {texture("plate", plate_picture(plate_number(model.name))),
                    texture("contact_shadow", shadow_picture())};
}

}  // namespace

std::vector<scene::Material> car_materials(const CarPaint& paint) {
  const float flake_roughness = paint.metallic > 0.0f ? 0.42f : 0.55f;
  std::vector<scene::Material> materials{
      coated(material("paint", paint.colour, paint.metallic, flake_roughness)),
      coated(material("glass", glm::vec3(0.012f, 0.014f, 0.014f), 0.0f, 0.06f)),
      material("black", glm::vec3(0.018f), 0.0f, 0.55f),
      material("chrome", glm::vec3(0.62f, 0.63f, 0.64f), 1.0f, 0.08f),
      coated(material("lamp", glm::vec3(0.55f, 0.57f, 0.6f), 0.6f, 0.2f)),
      coated(material("tail_lamp", glm::vec3(0.42f, 0.012f, 0.01f), 0.0f, 0.3f)),
      coated(material("indicator", glm::vec3(0.6f, 0.2f, 0.02f), 0.0f, 0.3f)),
      material("rubber", glm::vec3(0.02f), 0.0f, 0.85f),
      material("alloy", glm::vec3(0.55f, 0.56f, 0.58f), 1.0f, 0.28f),
      material("plate", glm::vec3(1.0f), 0.0f, 0.4f),
      material("contact_shadow", glm::vec3(0.0f), 0.0f, 1.0f)};
  materials[std::size_t(CarSurface::chrome)].is_mirror_like = true;
  materials[number_plate].base_colour_texture = 0;
  scene::Material& below = materials[shadow];
  below.base_colour_texture = 1, below.alpha_mode = scene::Alpha::blend;
  return materials;
}

namespace {

void add_part(scene::Model& model, const char* object, Mesh mesh, int material_index, int node = 0) {
  if (mesh.indices.empty()) return;
  scene::Part part;
  part.object = object, part.mesh = std::move(mesh), part.material = material_index, part.node = node;
  model.parts.push_back(std::move(part));
}

/// An ellipsoid: the housing of a mirror.
Mesh ellipsoid(glm::vec3 centre, glm::vec3 radii) {
  constexpr std::uint32_t around = 12, up = 8;
  Mesh mesh;
  for (std::uint32_t j = 0; j <= up; ++j)
    for (std::uint32_t i = 0; i <= around; ++i) {
      const float turn = 6.2831853f * float(i) / float(around),
                  tilt = 3.14159265f * (float(j) / float(up) - 0.5f);
      const glm::vec3 out(std::cos(tilt) * std::cos(turn), std::cos(tilt) * std::sin(turn), std::sin(tilt));
      mesh.positions.push_back(centre + radii * out), mesh.normals.push_back(glm::normalize(out / radii));
      mesh.uvs.push_back({float(i) / float(around), float(j) / float(up)});
    }
  for (std::uint32_t j = 0; j < up; ++j)
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t a = j * (around + 1) + i, b = a + around + 1;
      if (j > 0) mesh.indices.insert(mesh.indices.end(), {a, a + 1, b + 1});
      if (j + 1 < up) mesh.indices.insert(mesh.indices.end(), {a, b + 1, b});
    }
  return mesh;
}

/// A rectangle with its foot's left end at `corner` as it is seen from outside.
Mesh rectangle(glm::vec3 corner, glm::vec3 right, glm::vec3 up) {
  Mesh mesh;
  const glm::vec3 normal = glm::normalize(glm::cross(right, up));
  mesh.positions = {corner, corner + right, corner + right + up, corner + up};
  mesh.normals.assign(4, normal);
  mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

void add_plates(scene::Model& model, const CarShape& shape, const Bounds& box) {
  const float width = 0.52f, height = 0.11f, z = shape.plate_height, proud = 0.012f;
  add_part(model, "plate_front",
           rectangle({box.max.x + proud, -0.5f * width, z}, {0, width, 0}, {0, 0, height}), number_plate);
  add_part(model, "plate_rear",
           rectangle({box.min.x - proud, 0.5f * width, z}, {0, -width, 0}, {0, 0, height}), number_plate);
}

void add_shadow(scene::Model& model, const Bounds& box) {
  const float wider = 0.2f, z = 0.012f;
  const glm::vec3 size = box.size() + 2.0f * wider;
  add_part(model, "contact_shadow",
           rectangle({box.min.x - wider, box.min.y - wider, z}, {size.x, 0, 0}, {0, size.y, 0}), shadow);
  model.parts.back().casts_shadow = false;
}

void add_wheels(scene::Model& model, const CarShape& shape) {
  scene::WheelShape form;
  form.radius_m = shape.wheel_radius, form.width_m = shape.wheel_width,
  form.rim_radius_m = 0.66f * shape.wheel_radius;
  form.segments = shape.wheel_segments, form.has_round_shoulders = shape.has_round_tyre_shoulders;
  const scene::Model wheel = scene::make_wheel(form);
  struct Place {
    const char* name;
    float x, y;
  };
  const float front = shape.front_axle_x, rear = shape.rear_axle_x, y = shape.half_track;
  for (const Place& place : {Place{"wheel_front_left", front, y}, Place{"wheel_front_right", front, -y},
                             Place{"wheel_rear_left", rear, y}, Place{"wheel_rear_right", rear, -y}}) {
    scene::ModelNode node;
    node.name = place.name, node.parent = 0, node.translation = {place.x, place.y, shape.wheel_radius};
    model.nodes.push_back(node);
    const glm::mat4 turned =  // the wheel's outer side looks to +y
        place.y > 0.0f ? glm::mat4(1.0f) : glm::mat4(glm::mat3(-1, 0, 0, 0, -1, 0, 0, 0, 1));
    for (const scene::Part& part : wheel.parts) {
      Mesh mesh;
      append(mesh, part.mesh, turned);
      add_part(model, part.object.c_str(), std::move(mesh), part.object == "rim" ? alloy : rubber,
               int(model.nodes.size()) - 1);
    }
  }
}

}  // namespace

scene::Model make_car(const CarShape& shape, const CarPaint& paint) {
  scene::Model model;
  model.name = shape.name + "_" + paint.name;
  model.nodes[0].name = model.name;
  add_textures(model);
  model.materials = car_materials(paint);
  CarMeshes body = body_meshes(shape);
  Bounds box;
  for (const Mesh& mesh : body) box.add(mesh.bounds());
  for (std::size_t i = 0; i < body.size(); ++i)
    add_part(model, model.materials[i].name.c_str(), std::move(body[i]), int(i));
  for (const float side : {1.0f, -1.0f}) {
    const glm::vec3 place(shape.mirror.x, side * shape.mirror.y, shape.mirror.z);
    const glm::vec3 arm = place - glm::vec3(0.0f, side * shape.mirror_radii.y, 0.45f * shape.mirror_radii.z);
    add_part(model, "mirror", ellipsoid(place, shape.mirror_radii), int(CarSurface::paint));
    add_part(model, "mirror_arm", ellipsoid(arm, {0.05f, 0.09f, 0.025f}), int(CarSurface::black));
  }
  add_plates(model, shape, box);
  add_wheels(model, shape);
  add_shadow(model, box);
  return model;
}

std::vector<VehicleKind> city_vehicles() {
  const CarPaint white{"white", linear_from_srgb8(0xE6, 0xE6, 0xE2)}, black{"black", glm::vec3(0.012f)};
  const CarPaint silver{"silver", linear_from_srgb8(0xA8, 0xAC, 0xB0), 0.5f};
  const CarPaint grey{"grey", linear_from_srgb8(0x5A, 0x5F, 0x64), 0.4f};
  const CarPaint blue{"blue", linear_from_srgb8(0x1E, 0x46, 0x86), 0.2f},
      red{"red", linear_from_srgb8(0xA0, 0x1C, 0x1C)};
  const CarPaint green{"green", linear_from_srgb8(0x1E, 0x6A, 0x58)};
  return {{saloon_shape(), {silver, black, white, blue, red}},
          {hatchback_shape(), {grey, red, white}},
          {van_shape(), {white, grey}},
          {bus_shape(), {green}}};
}

std::vector<scene::Model> city_cars() {
  std::vector<scene::Model> cars;
  for (const VehicleKind& kind : city_vehicles())
    for (const CarPaint& paint : kind.paints) cars.push_back(make_car(kind.shape, paint));
  return cars;
}

}  // namespace parvis::city
