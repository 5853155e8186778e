// Virtual grids: flicker and pictures of a mesh between whose corners vertices are interpolated.
#include <algorithm>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>

#include "base/parallel.h"
#include "bench/parts.h"
#include "graphics/reference/tracer.h"
#include "graphics/shading/sky.h"
#include "graphics/shading/tone_curve.h"
#include "places/paper_city/mirror_bodies.h"
#include "reflections/reflection_search/reflection_search.h"
#include "reflections/reflection_search/test_ellipsoid.h"
#include "reflections/reflection_search/test_exact_reflection.h"
#include "reflections/virtual_objects/virtual_grid.h"
#include "scene/data/test_scene.h"

namespace parvis::bench {
namespace {

using namespace reflection_search;
using namespace virtual_objects;
using Search = ReflectionSearch<Ellipsoid>;

constexpr int width = 640, height = 480, samples_per_pixel = 9;
constexpr int frames = 120;
constexpr std::size_t stride = 20, quick_stride = 120;  // of the vertices whose flicker is measured
constexpr int paper_iterations = 9, newton_steps = 12, exact_starts = 8;
constexpr float search_ends = 2e-9f;    // error, 0.005 degrees
constexpr float grid10_share = 0.096f;  // the paper's 9.6 %
const Ellipsoid mirror{{1.0f, 0.6f, 0.8f}};

/// The whale of Meyer and Loscos, 1.8 m long, beside the mirror.
Mesh whale() {
  Mesh mesh;
  const glm::mat4 place = glm::scale(
      glm::rotate(glm::translate(glm::mat4(1.0f), {-1.5f, -1.5f, 0.2f}), 0.6f, {0, 0, 1}), glm::vec3(0.15f));
  for (const scene::Part& part : city::make_whale().parts) append(mesh, part.mesh, place);
  return mesh;
}

Camera camera_at(int frame) {
  const float turn = -0.35f + 0.7f * float(frame) / float(frames - 1);
  Camera camera;
  camera.vertical_fov = 0.5f;
  camera.world_from_camera = look_at({4.5f * std::sin(turn), -4.5f * std::cos(turn), 1.2f}, glm::vec3(0.0f));
  return camera;
}

/// How a point is searched for: where a mirror shows it, seen from `viewer`.
using Shows = std::function<VirtualPoint(glm::vec3 viewer, glm::vec3 vertex)>;

VirtualPoint shown(const Search::ReflectionPoint& point, Search& search, glm::vec3 vertex) {
  return {search.virtual_vertex(vertex, point.position, point.normal), false};
}

VirtualPoint by_newton(glm::vec3 viewer, glm::vec3 vertex) {
  Search search{mirror};
  const Search::ReflectionTask task{viewer, vertex, glm::vec3(0.0f)};
  const auto point = search.search_by_newton(task, search.first_direction(task), true, search.steady_growth,
                                             newton_steps, search_ends);
  VirtualPoint at = shown(point, search, vertex);
  at.is_lost = point.angle > found_angle;
  return at;
}

VirtualPoint by_midpoint(glm::vec3 viewer, glm::vec3 vertex) {
  Search search{mirror};
  const Search::ReflectionTask task{viewer, vertex, glm::vec3(0.0f)};
  return shown(search.search_by_midpoint(task, search.first_direction(task), paper_iterations, search_ends),
               search, vertex);
}

VirtualPoint exactly(glm::vec3 viewer, glm::vec3 vertex) {
  const std::vector<glm::dvec3> points =
      reflections_on_ellipsoid(glm::dvec3(mirror.radii), viewer, vertex, exact_starts);
  if (points.empty()) return {glm::vec3(0.0f), true};
  const glm::dvec3 p = points.front(), r(mirror.radii), normal = glm::normalize(p / (r * r));
  return {glm::vec3(glm::dvec3(vertex) - 2.0 * glm::dot(glm::dvec3(vertex) - p, normal) * normal), false};
}

std::vector<VirtualPoint> all_by(const Shows& shows, glm::vec3 viewer, std::span<const glm::vec3> vertices) {
  std::vector<VirtualPoint> points;
  points.reserve(vertices.size());
  for (const glm::vec3& vertex : vertices) points.push_back(shows(viewer, vertex));
  return points;
}

/// Virtual points by a grid whose corners are searched for.
std::vector<VirtualPoint> by_grid(const VirtualGrid& grid, const Shows& shows, glm::vec3 viewer,
                                  std::span<const glm::vec3> vertices) {
  const std::vector<VirtualPoint> corners = all_by(shows, viewer, grid.corners());
  std::vector<VirtualPoint> points(vertices.size());
  grid.interpolate(vertices, corners, points);
  return points;
}

/// A picture of the virtual mesh.
Image8 picture_of(const Mesh& mesh, const std::vector<VirtualPoint>& points) {
  Mesh image = mesh;
  image.indices.clear();
  for (std::size_t i = 0; i < points.size(); ++i) image.positions[i] = points[i].position;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
    if (!points[a].is_lost && !points[b].is_lost && !points[c].is_lost)
      image.indices.insert(image.indices.end(), {a, c, b});  // a mirror turns it round
  }
  scene::Scene scene;
  scene::add(scene, scene::model_of(std::move(image), scene::matt({0.7f, 0.5f, 0.3f})));
  const reference::RayScene rays(scene);
  reference::TraceOptions options;
  options.samples_per_pixel = samples_per_pixel;
  const reference::TracedPicture traced = reference::trace_picture(
      rays, scene, shading::make_sky_light({}, 1.0f, 0.0f), camera_at(frames / 2), width, height, options);
  return shading::tone_mapped_picture(traced.radiance, 1.0f);
}

glm::dvec2 pixel_of(const Camera& camera, glm::vec3 point) {
  const glm::dvec4 p =
      glm::dmat4(camera.clip_from_camera(float(width) / float(height)) * camera.camera_from_world()) *
      glm::dvec4(point, 1.0);
  return 0.5 * glm::dvec2(width, height) * glm::dvec2(p) / p.w;
}

/// Pixels that virtual vertices jump about the truth from frame to frame: the mean absolute second difference
/// of where they are, less where they should be.
double flicker_px(const std::vector<std::vector<glm::dvec2>>& off) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t f = 1; f + 1 < off.size(); ++f)
    for (std::size_t v = 0; v < off[f].size(); ++v) {
      const double jump = glm::length(off[f + 1][v] - 2.0 * off[f][v] + off[f - 1][v]);
      if (std::isfinite(jump)) sum += jump, ++count;
    }
  return count ? sum / double(count) : 0.0;
}

/// Mean distance of virtual vertices from where they should be.
double mean_px(const std::vector<std::vector<glm::dvec2>>& off) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const std::vector<glm::dvec2>& frame : off)
    for (const glm::dvec2 away : frame)
      if (const double distance = glm::length(away); std::isfinite(distance)) sum += distance, ++count;
  return count ? sum / double(count) : 0.0;
}

/// `flicker_ratio_grid`: both sides by the paper's nine iterations. The same of a grid whose corners Newton's
/// method finds, as in the shipped one, over the paper's vertices; here all grids are of one level, and no
/// vertex is searched for beside them.
void measure_flicker(const Mesh& mesh, const VirtualGrid& grid, const BenchSetup& setup, Report& report) {
  const std::size_t step = setup.is_quick ? quick_stride : stride;
  std::vector<glm::vec3> watched;
  watched.reserve(mesh.positions.size() / step + 1);
  for (std::size_t i = 0; i < mesh.positions.size(); i += step) watched.push_back(mesh.positions[i]);
  using Off = std::vector<std::vector<glm::dvec2>>;
  Off newton_off(frames), paper_grid_off(frames), fixed_off(frames), still_off(frames), turns_off(frames);
  // Controls: what one frame has shown stays where it is; the truth and nine iterations in turn.
  const std::vector<VirtualPoint> still =
      by_grid(grid, by_newton, camera_at(frames / 2).position_in_world(), mesh.positions);
  parallel_for(std::size_t(frames), [&](std::size_t f) {
    const Camera camera = camera_at(int(f));
    const glm::vec3 viewer = camera.position_in_world();
    const std::vector<VirtualPoint> by_newton_grid = by_grid(grid, by_newton, viewer, mesh.positions),
                                    paper_grid = by_grid(grid, by_midpoint, viewer, mesh.positions),
                                    fixed = all_by(by_midpoint, viewer, watched),
                                    truth = all_by(exactly, viewer, watched);
    for (std::size_t i = 0; i < watched.size(); ++i) {
      const glm::dvec2 right = truth[i].is_lost ? glm::dvec2(NAN) : pixel_of(camera, truth[i].position);
      newton_off[f].push_back(pixel_of(camera, by_newton_grid[i * step].position) - right);
      paper_grid_off[f].push_back(pixel_of(camera, paper_grid[i * step].position) - right);
      fixed_off[f].push_back(pixel_of(camera, fixed[i].position) - right);
      still_off[f].push_back(pixel_of(camera, still[i * step].position) - right);
      turns_off[f].push_back(f % 2 == 0 ? 0.0 * fixed_off[f].back() : fixed_off[f].back());
    }
  });
  const double of_newton = flicker_px(newton_off), of_paper_grid = flicker_px(paper_grid_off),
               of_fixed = flicker_px(fixed_off);
  report.note(fmt::format(
      "over {} frames vertices jump by {:.4f} px with a grid of 9.6 % by Newton's method, {:.4f} px "
      "with one by 9 midpoint iterations, {:.4f} px with 9 midpoint iterations each",
      frames, of_newton, of_paper_grid, of_fixed));
  report.add("flicker_ratio_grid", of_paper_grid / of_fixed);
  report.add("flicker_ratio_grid_over_fixed_iterations", of_newton / of_fixed);
  report.add("flicker_ratio_of_two_searches_in_turn", flicker_px(turns_off) / of_fixed);
  // Vertices that never move do not flicker, either: they are to be where they should.
  report.add("flicker_grid_off_px", mean_px(newton_off));
  report.add("flicker_still_off_px", mean_px(still_off));
}

Image8 where_different(const Image8& a, const Image8& b) {
  Image8 mask(a.width, a.height, 1, 0);
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      *mask.at(x, y) = std::equal(a.at(x, y), a.at(x, y) + 3, b.at(x, y)) ? 0 : 255;
  return mask;
}

/// `grid10_flip_over_all`: both sides by the paper's nine iterations. The same of a grid whose corners
/// Newton's method finds, over the paper's vertices.
void measure_pictures(const Mesh& mesh, Report& report) {
  const glm::vec3 viewer = camera_at(frames / 2).position_in_world();
  const Image8 truth = picture_of(mesh, all_by(exactly, viewer, mesh.positions));
  const std::vector<VirtualPoint> nothing(mesh.positions.size(), VirtualPoint{glm::vec3(0.0f), true});
  const Image8 mask = where_different(truth, picture_of(mesh, nothing));
  const auto flip_of = [&](const std::vector<VirtualPoint>& points) {
    return flip_between(picture_of(mesh, points), truth, mask);
  };
  const auto flip_of_grid = [&](float share, const Shows& shows) {
    return flip_of(by_grid(VirtualGrid(mesh.positions, share), shows, viewer, mesh.positions));
  };
  const double midpoint = flip_of(all_by(by_midpoint, viewer, mesh.positions)),
               paper_grid = flip_of_grid(grid10_share, by_midpoint), without = flip_of(nothing);
  report.add("grid10_flip_over_fixed_iterations", flip_of_grid(grid10_share, by_newton) / midpoint);
  report.add("grid10_flip_over_all", paper_grid / midpoint);
  report.add("grid10_flip_over_all_without_mesh", without / midpoint);
}

}  // namespace

void measure_grids(const BenchSetup& setup, Report& report) {
  const Mesh mesh = whale();
  measure_flicker(mesh, VirtualGrid(mesh.positions, grid10_share), setup, report);
  measure_pictures(mesh, report);
}

}  // namespace parvis::bench
