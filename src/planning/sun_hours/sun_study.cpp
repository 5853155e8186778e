#include "planning/sun_hours/sun_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "base/file_set.h"
#include "base/image_io.h"
#include "base/parallel.h"
#include "formats/gltf/gltf_writer.h"
#include "planning/sun_hours/finer_mesh.h"
#include "planning/sun_hours/sun_plan.h"
#include "scene/data/surroundings.h"
#include "scene/data/traced_scene.h"

namespace parvis::sun_hours {
namespace {

constexpr std::size_t max_cells = 16'000'000, max_vertices = 12'000'000;
constexpr float study_lift_m = 0.02f;  // rays start so far off their surface
constexpr float ground_rise_m = 2.5f;  // what lies higher above the lowest surface around is built
constexpr double ground_reach_m = 20.0;

using VisitMesh = std::function<void(const Mesh& mesh, const glm::mat4& world_from_mesh)>;

/// The scene for rays to the sun: without dynamic objects, which stand somewhere else in an hour. All else
/// counts, whatever `shadowMap` says of casters.
scene::Scene still_scene(const scene::Scene& scene) {
  scene::Scene still = scene;
  for (scene::Object& object : still.objects) object.is_visible = object.is_visible && !object.is_dynamic;
  return still;
}

/// Opaque meshes of what a room draws by itself.
class OpaqueThings final : public scene::TracedScene {
 public:
  explicit OpaqueThings(const VisitMesh& visit) : visit_(visit) {}

  void add(std::shared_ptr<const Mesh> mesh, std::shared_ptr<const scene::TracedSurface> surface,
           const glm::mat4& world_from_mesh, const scene::TracedPlacing& placing) override {
    if (placing.is_visible && !placing.is_dynamic && !placing.is_backdrop &&
        surface->alpha_mode() == scene::Alpha::opaque)
      visit_(*mesh, world_from_mesh);
  }
  void add(std::shared_ptr<const scene::Model> /*model*/, const glm::mat4& /*world_from_model*/,
           const scene::TracedPlacing& /*placing*/) override {}

 private:
  const VisitMesh& visit_;
};

/// Parts that stand still and are seen, and photographed surfaces, without backdrops: what has hours of sun.
/// Leaves cast shadows, but have none. `has_surroundings`: with land that goes on to the horizon.
void for_each_surface(const scene::Scene& scene, const VisitMesh& visit, bool has_surroundings = true) {
  for (const scene::Object& object : scene.objects) {
    if (object.is_dynamic || !object.is_visible) continue;
    if (!has_surroundings && scene::surrounds_place(scene, object)) continue;
    const std::vector<glm::mat4> pose = object.pose.empty() ? scene::rest_pose(*object.model) : object.pose;
    for (const scene::Part& part : object.model->parts)
      if (object.model->materials[std::size_t(part.material)].alpha_mode == scene::Alpha::opaque &&
          !part.is_backdrop)
        visit(part.mesh, object.world_from_model * pose[std::size_t(part.node)]);
  }
  OpaqueThings photographed(visit);
  scene::for_each_traced_kind(scene, [&](const scene::TracedKind& kind, int /*first_thing*/) {
    if (kind.is_recorded) kind.trace(scene, photographed);
  });
}

/// Bounds of the place; those of the land around it where there is nothing else.
Bounds bounds_of(const scene::Scene& scene) {
  Bounds bounds;
  for (const bool has_surroundings : {false, true}) {
    for_each_surface(
        scene,
        [&](const Mesh& mesh, const glm::mat4& world_from_mesh) {
          bounds.add(transformed(world_from_mesh, mesh.bounds()));
        },
        has_surroundings);
    if (bounds.min.x <= bounds.max.x) break;
  }
  return bounds;
}

/// The surface below a point.
struct SurfaceBelow {
  glm::vec3 position;
  const reference::PlacedPart* place;
};

/// A backdrop stands for all that is far away, leaves let light through.
bool is_solid(const reference::PlacedPart& place) {
  return place.material->alpha_mode == scene::Alpha::opaque && !place.is_backdrop;
}

/// The first solid surface below a point.
std::optional<SurfaceBelow> surface_below(const reference::RayScene& rays, glm::vec3 from) {
  for (int pass = 0; pass < 64; ++pass) {
    const std::optional<reference::Hit> hit = rays.nearest_hit({from, {0, 0, -1}, 1e-4f, 1e30f});
    if (!hit) return std::nullopt;
    from.z -= hit->distance_m + 1e-3f;
    if (is_solid(*hit->place)) return SurfaceBelow{from, hit->place};
  }
  return std::nullopt;
}

/// Whether something faces down over a point that rays from above have passed: a building inside out, or a
/// roof of one side.
bool is_below_backs(const reference::RayScene& rays, glm::vec3 ground) {
  const auto hit = rays.nearest_hit({ground + glm::vec3(0, 0, study_lift_m), {0, 0, 1}, 1e-4f, 1e30f});
  return hit && is_solid(*hit->place);
}

/// `named`: the surfaces that are judged, and ground whatever their height; null: those that lie low.
void find_ground(const reference::RayScene& rays, float top, const NamedSurfaces* named,
                 const JudgedGround& judged, SunStudy& study) {
  const std::vector<std::uint8_t> inside =
      judged.outline.empty()
          ? std::vector<std::uint8_t>(study.cells.size(), 1)
          : cells_inside(judged.outline, study.corner, study.cell_m, study.columns, study.rows);
  std::vector<std::uint8_t> is_named(study.cells.size(), 0);
  parallel_for(
      study.cells.size(),
      [&](std::size_t i) {
        const std::size_t row = i / std::size_t(study.columns), column = i % std::size_t(study.columns);
        const glm::dvec2 at = study.corner + study.cell_m * (glm::dvec2(double(column), double(row)) + 0.5);
        const auto surface = surface_below(rays, {float(at.x), float(at.y), top + 1.0f});
        if (!surface) return;
        study.cells[i].kind = GroundCell::Kind::built;
        study.cells[i].position = surface->position;
        is_named[i] = named && named->has(*surface->place) ? 1 : 0;
      },
      256);
  // The lowest surface around, by a minimum over rows, then over columns.
  const int reach = std::max(1, int(ground_reach_m / study.cell_m));
  const auto lowest = [&](const std::vector<float>& heights, int step_x, int step_y) {
    std::vector<float> result(heights.size());
    parallel_for(
        heights.size(),
        [&](std::size_t i) {
          const int x = int(i % std::size_t(study.columns)), y = int(i / std::size_t(study.columns));
          float minimum = 1e30f;
          for (int k = -reach; k <= reach; ++k) {
            const int nx = x + k * step_x, ny = y + k * step_y;
            if (nx < 0 || ny < 0 || nx >= study.columns || ny >= study.rows) continue;
            minimum =
                std::min(minimum, heights[std::size_t(ny) * std::size_t(study.columns) + std::size_t(nx)]);
          }
          result[i] = minimum;
        },
        256);
    return result;
  };
  std::vector<float> heights;
  heights.reserve(study.cells.size());
  for (const GroundCell& cell : study.cells)
    heights.push_back(cell.kind == GroundCell::Kind::nothing ? 1e30f : cell.position.z);
  const std::vector<float> around = lowest(lowest(heights, 1, 0), 0, 1);
  std::atomic<std::size_t> covered = 0;
  parallel_for(
      study.cells.size(),
      [&](std::size_t i) {
        GroundCell& cell = study.cells[i];
        if (cell.kind == GroundCell::Kind::nothing) return;
        const bool is_low = heights[i] - around[i] < ground_rise_m;
        if (!is_low && is_named[i] == 0) return;
        if (is_below_backs(rays, cell.position)) {
          covered += is_low ? 1 : 0;
          return;
        }
        cell.kind = GroundCell::Kind::ground;
        cell.is_judged = inside[i] != 0 && (!named || is_named[i] != 0);
      },
      256);
  study.covered_m2 = double(covered) * study.cell_m * study.cell_m;
}

Result<SunStudy> laid_out(const Bounds& bounds, const SunStudyOptions& options) {
  SunStudy study;
  study.cell_m = options.cell_m;
  const glm::dvec4 area =
      options.area.value_or(glm::dvec4(bounds.min.x, bounds.min.y, bounds.max.x, bounds.max.y));
  study.corner = glm::min(glm::dvec2(area.x, area.y), glm::dvec2(area.z, area.w));
  const glm::dvec2 size = glm::max(glm::dvec2(area.x, area.y), glm::dvec2(area.z, area.w)) - study.corner;
  const glm::dvec2 counts = glm::ceil(size / options.cell_m);
  if (!(counts.x >= 1.0 && counts.y >= 1.0)) return error("the area of the sun study is empty");
  if (counts.x * counts.y > double(max_cells))
    return error(
        "{:.0f} x {:.0f} m in cells of {} m are {:.0f} cells; at most {} are studied: take a larger cell or "
        "a smaller area",
        size.x, size.y, options.cell_m, counts.x * counts.y, max_cells);
  study.columns = int(counts.x), study.rows = int(counts.y);
  study.cells.resize(std::size_t(study.columns) * std::size_t(study.rows));
  return study;
}

/// The surfaces in the area, in triangles no larger than a cell.
Status gather_surfaces(const scene::Scene& scene, const SunStudyOptions& options, SunStudy& study) {
  const glm::vec2 low(study.corner),
      high = low + glm::vec2(study.cell_m * glm::dvec2(study.columns, study.rows));
  std::size_t refused = 0;
  for_each_surface(scene, [&](const Mesh& source, const glm::mat4& world_from_mesh) {
    const Bounds bounds = transformed(world_from_mesh, source.bounds());
    const bool is_inside =
        bounds.max.x > low.x && bounds.min.x < high.x && bounds.max.y > low.y && bounds.min.y < high.y;
    if (!is_inside || refused != 0) return;
    Mesh mesh;
    append(mesh, source, world_from_mesh);
    append_finer(study.surfaces, mesh, float(options.cell_m), low, high);
    if (study.surfaces.positions.size() > max_vertices) refused = study.surfaces.positions.size();
  });
  if (refused != 0)
    return error(
        "the surfaces have more than {} vertices in cells of {} m: take a larger cell, a smaller area, or "
        "the ground alone",
        max_vertices, options.cell_m);
  return Ok{};
}

/// Hours of all points: each process finds those of its blocks.
std::vector<float> divided_hours(const reference::RayScene& rays, const std::vector<SunPoint>& points,
                                 const SunStudyOptions& options) {
  constexpr std::size_t block = 1024;
  std::vector<SunPoint> own;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (options.processes.has(i / block)) own.push_back(points[i]), places.push_back(i);
  const std::vector<float> found = sun_hours(rays, own, options.period);
  std::vector<float> hours(points.size(), 0.0f);
  for (std::size_t k = 0; k < places.size(); ++k) hours[places[k]] = found[k];
  options.processes.sum(hours);  // of one number and noughts: the same bits in any order
  return hours;
}

}  // namespace

Result<SunStudy> study_sun(const scene::Scene& scene, const SunStudyOptions& options) {
  const scene::Scene still = still_scene(scene);
  const Bounds bounds = bounds_of(still);
  if (bounds.min.x > bounds.max.x)
    return error("the scene has nothing that stands still: there is nothing to study");
  Result<SunStudy> made = laid_out(bounds, options);
  if (!made) return made;
  SunStudy& study = *made;

  std::optional<NamedSurfaces> named;
  if (!options.judged.names.empty()) {
    Result<NamedSurfaces> found = NamedSurfaces::find(still, options.judged.names);
    if (!found) return found.errors();
    named = *std::move(found);
  }
  const reference::RayScene rays(still);
  find_ground(rays, bounds.max.z, named ? &*named : nullptr, options.judged, study);
  study.is_chosen = !options.judged.is_all();
  if (study.is_chosen && std::ranges::none_of(study.cells, &GroundCell::is_judged))
    return error(
        "nothing of the ground that is to be judged is open from above in the area of the study; check its "
        "names, its outline and the area");
  if (options.has_facades)
    if (Status status = gather_surfaces(still, options, study); !status) return status.errors();

  std::vector<SunPoint> points;
  points.reserve(study.cells.size() + study.surfaces.positions.size() + 1);
  for (const GroundCell& cell : study.cells) points.push_back(lifted(cell.position, {0, 0, 1}));
  for (std::size_t i = 0; i < study.surfaces.positions.size(); ++i)
    points.push_back(lifted(study.surfaces.positions[i], study.surfaces.normals[i]));
  points.push_back({{0.0f, 0.0f, bounds.max.z + 1.0f}, {0, 0, 1}});  // nothing stands higher
  const std::vector<float> hours = divided_hours(rays, points, options);
  study.max_hours = std::max(double(hours.back()), 1e-3);
  for (std::size_t i = 0; i < study.cells.size(); ++i) study.cells[i].hours = hours[i];
  study.surface_hours.assign(hours.begin() + std::ptrdiff_t(study.cells.size()), hours.end() - 1);
  for (std::size_t i = 0; i < study.surfaces.uvs.size(); ++i)
    study.surfaces.uvs[i] = {0.002f + 0.996f * study.surface_hours[i] / float(study.max_hours), 0.5f};
  return made;
}

SunPoint lifted(glm::vec3 position, glm::vec3 normal) { return {position + study_lift_m * normal, normal}; }

OpenSpaceRule open_space_rule(const SunStudy& study) {
  std::size_t open = 0, sunny = 0;
  for (const GroundCell& cell : study.cells)
    if (cell.is_judged) ++open, sunny += double(cell.hours) >= OpenSpaceRule::min_hours ? 1 : 0;
  return {open ? double(sunny) / double(open) : 0.0, double(open) * study.cell_m * study.cell_m};
}

std::string to_string(const OpenSpaceRule& rule) {
  return fmt::format("{:.0f} m2, {:.1f} % with {:g} h or more", rule.area_m2, 100.0 * rule.share,
                     OpenSpaceRule::min_hours);
}

namespace {

Status write_model(const std::filesystem::path& file, const SunStudy& study) {
  scene::Texture scale{.name = "sun_hours",
                       .image = Image8(256, 4, 4, 255),
                       .wrap_u = scene::Wrap::clamp,
                       .wrap_v = scene::Wrap::clamp};
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 256; ++x) {
      const glm::u8vec3 colour(glm::round(hours_colour((x + 0.5) / 256.0)));
      std::copy_n(&colour[0], 3, scale.image.at(x, y));
    }
  scene::Material material{.name = "sun hours"};
  material.base_colour = glm::vec3(1.0f), material.base_colour_texture = 0, material.roughness = 1.0f;
  scene::Model model;
  model.textures.push_back(std::move(scale));
  model.materials.push_back(std::move(material));
  model.nodes.emplace_back();
  scene::Part part;
  part.mesh = study.surfaces;
  part.material = 0, part.node = 0;
  model.parts.push_back(std::move(part));
  return scene::write_gltf(file, model);
}

/// A table of upright surfaces; the plan has the rest.
std::string facade_table(const SunStudy& study) {
  constexpr float steep = 0.7f;  // sine of 45 degrees
  std::string table = "x_m,y_m,z_m,normal_x,normal_y,normal_z,hours\n";
  for (std::size_t i = 0; i < study.surfaces.positions.size(); ++i) {
    const glm::vec3 at = study.surfaces.positions[i], normal = study.surfaces.normals[i];
    if (std::abs(normal.z) < steep)
      table += fmt::format("{:.2f},{:.2f},{:.2f},{:.3f},{:.3f},{:.3f},{:.3f}\n", at.x, at.y, at.z, normal.x,
                           normal.y, normal.z, study.surface_hours[i]);
  }
  return table;
}

}  // namespace

Status write_sun_study(const std::filesystem::path& prefix, const SunStudy& study) {
  const auto with = [&](const char* extension) { return std::filesystem::path(prefix.string() + extension); };
  const Result<std::string> plan = encode_image(sun_plan(study).picture, with(".png").string());
  if (!plan) return plan.errors();
  std::string table = "x_m,y_m,z_m,kind,hours,judged\n";
  for (const GroundCell& cell : study.cells)
    if (cell.kind != GroundCell::Kind::nothing)
      table += fmt::format("{:.2f},{:.2f},{:.2f},{},{:.3f},{}\n", cell.position.x, cell.position.y,
                           cell.position.z, cell.kind == GroundCell::Kind::ground ? "ground" : "built",
                           cell.hours, cell.is_judged ? 1 : 0);
  std::vector<FileContent> files{{with(".png"), *plan}, {with(".csv"), std::move(table)}};
  if (study.surfaces.indices.empty()) return write_together(files);
  files.push_back({with("_facades.csv"), facade_table(study)});
  return write_together(files, [&] { return write_model(with(".glb"), study); });
}

}  // namespace parvis::sun_hours
