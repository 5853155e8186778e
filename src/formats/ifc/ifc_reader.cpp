#include "formats/ifc/ifc_reader.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "base/colour.h"
#include "base/files.h"
#include "base/image_io.h"
#include "formats/ifc/ifc_shapes.h"
#include "formats/readers/packed_file.h"
#include "scene/data/placeholder.h"

namespace parvis::scene {
namespace {

constexpr double max_offset_m = 10000.0;     // farther away floats are coarser than a millimetre
constexpr float min_crease_cosine = 0.866f;  // 30 degrees: the sides of columns and pipes look round
constexpr double weld_m = 1e-4;              // corners closer than this are one

/// The usual look of objects of a kind where the file does not say.
IfcLook usual_look(const std::string& kind) {
  static const std::map<std::string, IfcLook, std::less<>> looks{
      {"IfcBeam", {{0.55f, 0.45f, 0.35f}, 1.0f}},    {"IfcCurtainWall", {{0.55f, 0.62f, 0.66f}, 0.4f}},
      {"IfcDoor", {{0.45f, 0.32f, 0.22f}, 1.0f}},    {"IfcPlate", {{0.55f, 0.62f, 0.66f}, 0.4f}},
      {"IfcRailing", {{0.25f, 0.26f, 0.28f}, 1.0f}}, {"IfcRoof", {{0.60f, 0.33f, 0.24f}, 1.0f}},
      {"IfcSite", {{0.42f, 0.50f, 0.32f}, 1.0f}},    {"IfcSlab", {{0.70f, 0.69f, 0.67f}, 1.0f}},
      {"IfcStair", {{0.68f, 0.67f, 0.65f}, 1.0f}},   {"IfcWall", {{0.90f, 0.88f, 0.83f}, 1.0f}},
      {"IfcWindow", {{0.62f, 0.70f, 0.74f}, 0.4f}},  {"IfcWallStandardCase", {{0.90f, 0.88f, 0.83f}, 1.0f}},
  };
  const auto found = looks.find(kind);
  return found == looks.end() ? IfcLook{} : found->second;
}

Material material_of(const std::string& kind, const IfcLook& look, bool is_closed) {
  Material material;
  material.name = kind;
  material.base_colour = linear_from_srgb(look.colour);
  material.alpha = look.alpha;
  if (look.picture) material.base_colour_texture = int(*look.picture);
  material.is_double_sided = !is_closed;
  if (look.alpha < 1.0f) {
    material.name += " glass";
    material.alpha_mode = Alpha::blend;
    material.roughness = 0.05f;
  }
  return material;
}

/// The body with its file's axes turned to those of the map.
void turn_to_map(const glm::dvec2& x_axis, IfcShape& shape) {
  for (glm::dvec3& corner : shape.corners)
    corner = {corner.x * x_axis.x - corner.y * x_axis.y, corner.x * x_axis.y + corner.y * x_axis.x, corner.z};
}

/// The point that becomes the scene's origin: the file's own, unless the building stands far from it.
glm::dvec3 origin_of(const std::vector<IfcShape>& shapes) {
  glm::dvec3 low(std::numeric_limits<double>::max()), high(-low);
  for (const IfcShape& shape : shapes)
    for (const glm::dvec3& corner : shape.corners) low = glm::min(low, corner), high = glm::max(high, corner);
  const glm::dvec2 middle = glm::round(0.5 * glm::dvec2(low + high));
  return glm::length(middle) > max_offset_m ? glm::dvec3(middle, 0.0) : glm::dvec3(0.0);
}

/// Metres along the surface, so that textures that repeat each metre lie level on walls and floors.
glm::vec2 plane_coordinates(glm::vec3 point, glm::vec3 normal) {
  if (std::abs(normal.z) > 0.7f) return {point.x, -point.y};
  const glm::vec2 along = glm::normalize(glm::vec2(-normal.y, normal.x));
  return {glm::dot(glm::vec2(point), along), -point.z};
}

/// Appends a body with flat faces; across an edge of less than 30 degrees the normals are shared.
void append_body(const IfcShape& shape, const glm::dvec3& origin, Mesh& mesh) {
  const std::size_t count = shape.corners.size();
  std::vector<glm::vec3> face_normals(count / 3);
  using Place = std::tuple<std::int64_t, std::int64_t, std::int64_t>;
  std::vector<std::pair<Place, std::size_t>> corners(count);
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 place = glm::round((shape.corners[i] - origin) / weld_m);
    corners[i] = {{std::int64_t(place.x), std::int64_t(place.y), std::int64_t(place.z)}, i};
    if (i % 3 == 0)
      face_normals[i / 3] = glm::vec3(
          glm::cross(shape.corners[i + 1] - shape.corners[i], shape.corners[i + 2] - shape.corners[i]));
  }
  std::ranges::sort(corners);
  std::vector<glm::vec3> normals(count);
  for (std::size_t first = 0, last = 0; first < count; first = last) {
    while (last < count && corners[last].first == corners[first].first) ++last;
    for (std::size_t i = first; i < last; ++i) {
      const glm::vec3 own = glm::normalize(face_normals[corners[i].second / 3]);
      glm::vec3 sum(0.0f);
      for (std::size_t k = first; k < last; ++k) {
        const glm::vec3 other = face_normals[corners[k].second / 3];
        if (glm::dot(own, other) >= min_crease_cosine * glm::length(other)) sum += other;
      }
      normals[corners[i].second] = glm::normalize(sum);
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 point(shape.corners[i] - origin);
    mesh.indices.push_back(std::uint32_t(mesh.positions.size()));
    mesh.positions.push_back(point);
    mesh.normals.push_back(normals[i]);
    mesh.uvs.push_back(shape.uvs.empty() ? plane_coordinates(point, normals[i]) : shape.uvs[i]);
  }
}

/// Storeys, objects and materials of the same name and look become one part.
class IfcAssembly {
 public:
  explicit IfcAssembly(const std::string& name) {
    model_.name = name;
    model_.nodes.front().name = name;
  }

  void add(const IfcShape& shape) {
    const IfcLook look = shape.look.value_or(usual_look(shape.kind));
    std::string object = shape.name.empty() ? shape.kind : shape.kind + " " + shape.name;
    if (shape.is_below_ground) object += " below ground";  // as is_below_ground of formats/terrain knows it
    const int material = material_for(shape.kind, look, shape.is_closed), node = node_for(shape.storey);
    const auto [part, is_new] = parts_.try_emplace({object, material, node}, model_.parts.size());
    if (is_new) {
      model_.parts.push_back({object, {}, material, node, look.alpha >= 1.0f});
    }
    append_body(shape, model_.origin, model_.parts[part->second].mesh);
  }
  void set_origin(const glm::dvec3& origin) { model_.origin = origin; }
  Model take() { return std::move(model_); }

 private:
  int material_for(const std::string& kind, const IfcLook& look, bool is_closed) {
    const auto [material, is_new] = materials_.try_emplace(
        {kind, look.colour.x, look.colour.y, look.colour.z, look.alpha, is_closed, look.picture},
        int(model_.materials.size()));
    if (is_new) model_.materials.push_back(material_of(kind, look, is_closed));
    return material->second;
  }
  int node_for(const std::string& storey) {
    if (storey.empty()) return 0;
    const auto [node, is_new] = nodes_.try_emplace(storey, int(model_.nodes.size()));
    if (is_new) model_.nodes.push_back({.name = storey, .parent = 0});
    return node->second;
  }

  Model model_;
  std::map<std::tuple<std::string, float, float, float, float, bool, std::optional<std::size_t>>, int>
      materials_;
  std::map<std::string, int> nodes_;
  std::map<std::tuple<std::string, int, int>, std::size_t> parts_;
};

/// Pictures that the file holds, and those beside it or below its folder.
std::vector<Texture> textures_of(const std::vector<IfcPicture>& pictures, const std::filesystem::path& file,
                                 Errors& warnings) {
  const Roots roots(file.parent_path());
  std::vector<Texture> textures;
  for (const IfcPicture& picture : pictures) {
    Result<Image8> image = [&]() -> Result<Image8> {
      if (!picture.bytes.empty())
        return read_image8(
            {reinterpret_cast<const std::uint8_t*>(picture.bytes.data()), picture.bytes.size()},
            picture.name);
      const Result<std::filesystem::path> path = roots.find(picture.name, {});
      return path ? read_image8(*path) : Result<Image8>(path.errors());
    }();
    if (!image)
      warnings.push_back(
          {image.errors().front().message + "; a checker stands for it: put the picture beside the IFC file",
           {file.string(), 0, 0}});
    textures.push_back({.name = picture.name,
                        .image = image ? *std::move(image) : placeholder_picture(),
                        .is_srgb = true,
                        .wrap_u = picture.repeats ? Wrap::repeat : Wrap::clamp,
                        .wrap_v = picture.repeats ? Wrap::repeat : Wrap::clamp});
  }
  return textures;
}

}  // namespace

Result<Model> read_ifc(const std::filesystem::path& file, Errors& warnings,
                       std::optional<glm::dvec2>* place_deg, const std::string& map, FileAccount* account) {
  Result<std::string> text = formats::read_unpacked(file);
  if (!text) return text.errors();
  Result<IfcBodies> bodies = ifc_bodies(*std::move(text), file.string(), warnings);
  if (!bodies) return bodies.errors();
  if (bodies->shapes.empty()) {
    Errors errors = std::move(warnings);  // of bodies that IFC++ makes nothing of
    warnings.clear();
    errors.push_back(error_at(FileLocation{file.string(), 0, 0}, "no object has a body{}",
                              errors.empty()
                                  ? ": export the building with its 3D geometry (representation \"Body\")"
                                  : " that can be shown"));
    return errors;
  }
  IfcAssembly assembly(formats::model_stem(file));
  if (account) *account = std::move(bodies->account);
  bodies->place = on_map(bodies->place, map);
  for (IfcShape& shape : bodies->shapes) turn_to_map(bodies->place.x_axis, shape);
  assembly.set_origin(origin_of(bodies->shapes));
  for (const IfcShape& shape : bodies->shapes) assembly.add(shape);
  Model model = assembly.take();
  model.origin += bodies->place.origin;
  model.map = bodies->place.map, model.true_north_deg = bodies->place.true_north_deg;
  if (place_deg) *place_deg = bodies->place.place_deg;
  model.textures = textures_of(bodies->pictures, file, warnings);
  for (const Part& part : model.parts)
    if (const Status status = check(part.mesh, part.object); !status)
      return Error{status.errors().front().message, {file.string(), 0, 0}};
  return model;
}

}  // namespace parvis::scene
