// Light at the vertices of moved objects: its rays, and what a running scene shows of it.
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>
#include <vector>

#include "base/bounds.h"
#include "base/files.h"
#include "base/parallel.h"
#include "base/random.h"
#include "bench/parts.h"
#include "formats/gltf/gltf_writer.h"
#include "graphics/light/vertex_light.h"
#include "graphics/reference/frame.h"
#include "graphics/reference/ray_scene.h"
#include "graphics/reference/shading_point.h"
#include "graphics/shading/sun.h"
#include "places/paper_city/paper_city.h"
#include "places/paper_city/street_plan.h"
#include "scene/data/vertex_irradiance.h"
#include "stage/stage.h"

namespace parvis::bench {
namespace {

/// East and north of the main crossing: its middle, and in the street to the north of it. At
/// the city's hour, 15:30 on a day in June, one side of that street lies in the sun, as the crossing does,
/// and the other in the shade. In the sun it is the crown of an orange tree between two street trees, 11 and
/// 18 m from their trunks.
inline constexpr glm::vec2 crown_on_crossing_m{0.0f}, crown_in_sun_m{5.0f, 52.0f},
    crown_in_shade_m{-5.0f, 20.0f};

constexpr const char* crown_name = "crown";
constexpr double frame_s = 1.0 / 30.0;
constexpr glm::vec3 leaf_colour{0.10f, 0.17f,
                                0.05f};  // a white crown would be lit by itself more than by the sky

/// 2,500 leaves of four vertices about a point six metres up, four metres across.
scene::Model crown() {
  constexpr int leaves = 2500;
  constexpr float radius_m = 2.0f, leaf_m = 0.12f;
  scene::Model model;
  scene::Part part;
  Random random(9);
  const auto any = [&] {
    const float x = random.uniform(-1.0f, 1.0f), y = random.uniform(-1.0f, 1.0f);
    return glm::vec3(x, y, random.uniform(-1.0f, 1.0f));
  };
  for (int leaf = 0; leaf < leaves; ++leaf) {
    const glm::vec3 middle = glm::vec3(0.0f, 0.0f, 6.0f) + radius_m * any();
    const glm::vec3 normal = glm::normalize(any() + 1e-4f);
    const glm::vec3 right = glm::normalize(
        glm::cross(normal, std::abs(normal.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0)));
    const glm::vec3 up = glm::cross(normal, right);
    const auto first = std::uint32_t(part.mesh.positions.size());
    for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
      part.mesh.positions.push_back(middle + leaf_m * (corner.x * right + corner.y * up));
      part.mesh.normals.push_back(normal);
      part.mesh.uvs.emplace_back(0.5f * corner + 0.5f);
    }
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) part.mesh.indices.push_back(first + corner);
  }
  model.parts.push_back(std::move(part));
  scene::Material leaf;
  leaf.base_colour = leaf_colour, leaf.metallic = 0.0f, leaf.roughness = 1.0f;
  model.materials.push_back(std::move(leaf));
  return model;
}
/// The city's files and the running scene that was read from them.
class CrownCity {
 public:
  /// Writes the city and the crown's model into `folder`, for any number of `open`.
  static void write(const BenchSetup& setup) { must(scene::write_gltf(setup.city() / "crown.glb", crown())); }
  /// `how_lit` is what stands between the parentheses of litVirtualObject: nothing, as it ships.
  static CrownCity open(const BenchSetup& setup, const char* how_lit);

  /// Moves the crown to a place east and north of the main crossing; `advance` shows it.
  void move(glm::vec2 from_crossing_m) {
    simulation_.scene.objects[crown_].world_from_model =
        glm::translate(glm::mat4(1.0f), glm::vec3(city::main_crossing() + from_crossing_m, 0.0f));
  }
  /// A message to the scene's dayLight. Fails as SceneClock::send.
  void send_to_sky(const std::string& message) { must(simulation_.clock.send("%dayLight", message)); }
  void advance() { simulation_.advance(frame_s); }
  /// Advances, and finishes what is spread over frames to come.
  void settle() {
    advance();
    simulation_.settle();
  }

  /// The crown's index in the scene.
  int object() const { return int(crown_); }
  const scene::Scene& scene() const { return simulation_.scene; }
  /// Irradiance of the crown's vertices, as renderers have it now.
  std::vector<glm::vec3> light() const {
    std::vector<glm::vec3> all;
    for (const auto& part : simulation_.scene.data<scene::VertexIrradiance>().of(crown_)->parts)
      all.insert(all.end(), part.front.begin(), part.front.end());
    return all;
  }
  /// The same vertices where they stand now, in the same order.
  std::vector<light::LitVertex> vertices() const {
    const scene::Object& object = simulation_.scene.objects[crown_];
    const std::vector<glm::mat4> pose = object.pose.empty() ? scene::rest_pose(*object.model) : object.pose;
    std::vector<light::LitVertex> vertices;
    for (const scene::Part& part : object.model->parts) {
      const glm::mat4 world_from_mesh = object.world_from_model * pose[std::size_t(part.node)];
      for (std::size_t v = 0; v < part.mesh.positions.size(); ++v)  // nothing is scaled
        vertices.push_back({glm::vec3(world_from_mesh * glm::vec4(part.mesh.positions[v], 1.0f)),
                            glm::normalize(glm::mat3(world_from_mesh) * part.mesh.normals[v])});
    }
    return vertices;
  }
  /// Their box.
  Bounds bounds() const {
    Bounds bounds;
    for (const light::LitVertex& vertex : vertices()) bounds.add(vertex.position);
    return bounds;
  }
  /// Fails where no wall stands within 8 m east or west of the middle of the crown: on a lawn all places have
  /// one light.
  void stands_beside_facade() const {
    constexpr float near_m = 8.0f;  // beside a lawn it would be 60
    const glm::vec3 middle = bounds().centre();
    const scene::Scene others = casters(false);
    const reference::RayScene around(others);
    for (const float east : {-1.0f, 1.0f})
      if (around.is_blocked({middle, {east, 0.0f, 0.0f}, 0.0f, near_m})) return;
    fail("the crown stands at {:.1f} {:.1f}, where no facade is within {} m", middle.x, middle.y, near_m);
  }
  /// Fails where anything else stands among the leaves, or where more than a few of them lie in the shade of
  /// other things: inside a street tree rays would end within a metre.
  void stands_free_in_sun(glm::vec3 to_sun) const {
    constexpr double max_share = 0.01;
    const scene::Scene others = casters(false);
    const reference::RayScene around(others);
    const std::vector<light::LitVertex> leaves = vertices();
    const glm::vec3 middle = bounds().centre();
    std::size_t met = 0, shaded = 0;
    for (const light::LitVertex& leaf : leaves) {
      const glm::vec3 inward = middle - leaf.position;
      const float distance_m = glm::length(inward);
      if (distance_m > 0.0f && around.is_blocked({leaf.position, inward / distance_m, 0.0f, distance_m}))
        ++met;
      if (around.is_blocked({leaf.position, to_sun})) ++shaded;
    }
    const double all = double(leaves.size());
    if (met == 0 && double(shaded) <= max_share * all) return;
    fail(
        "the crown at {:.1f} {:.1f} does not stand free in the sun: other things lie between {:.0f} % "
        "of its vertices and its middle, and shade {:.0f} %",
        middle.x, middle.y, 100.0 * double(met) / all, 100.0 * double(shaded) / all);
  }
  /// The geometry that casts light and shade on the crown: all that stands still, with the crown itself or
  /// without it.
  scene::Scene casters(bool with_crown) const {
    scene::Scene casters = simulation_.scene;
    casters.sky.picture = {};
    for (std::size_t o = 0; o < casters.objects.size(); ++o)
      if (o == crown_)
        casters.objects[o].is_visible = with_crown, casters.objects[o].is_dynamic = true;  // it has moved
      else if (casters.objects[o].is_dynamic)
        casters.objects[o].is_visible = false;
    return casters;
  }

 private:
  CrownCity(stage::Simulation simulation, std::size_t crown)
      : simulation_(std::move(simulation)), crown_(crown) {}

  stage::Simulation simulation_;
  std::size_t crown_;  ///< index of the object
};

CrownCity CrownCity::open(const BenchSetup& setup, const char* how_lit) {
  const auto script = setup.city() / "lit.xp";
  const std::string text = fmt::format(
      "include(file=\"paper_day.xp\")\nlitVirtualObject({}) {{ object(name=\"{}\", file=\"crown.glb\", "
      "grab=1) }}\n",
      how_lit, crown_name);
  must(write_file(script, text));
  stage::Simulation simulation = setup.simulation(script);
  for (std::size_t o = 0; o < simulation.scene.objects.size(); ++o)
    if (simulation.scene.objects[o].name == crown_name) return CrownCity(std::move(simulation), o);
  fail("the scene has no object \"{}\"", crown_name);
}
/// Root of the mean square of what is off, over all channels, as a share of the truth's mean.
double light_rmse_percent(const std::vector<glm::vec3>& light, const std::vector<glm::vec3>& truth) {
  double off = 0.0, mean = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const glm::dvec3 difference = glm::dvec3(light[i]) - glm::dvec3(truth[i]);
    off += glm::dot(difference, difference), mean += glm::dot(glm::dvec3(truth[i]), glm::dvec3(1.0));
  }
  return 100.0 * std::sqrt(off * 3.0 * double(truth.size())) / mean;
}

constexpr int few_rays = 64, many_rays = 1024;

/// The irradiance of a vertex by random rays, apart from VertexLight: no pattern is shared, and what a ray
/// hits gives back light by the texels there in place of the mean of its textures. The sun that comes
/// straight has rays all over its disc: leaves throw penumbras on each other.
glm::vec3 random_irradiance(const reference::RayScene& scene, const light::SkyTable& sky,
                            const light::LitVertex& vertex, int rays, reference::Passage& passage) {
  constexpr float pi = 3.14159265f, open_share = 0.5f;
  const glm::vec3 from = vertex.position + 1e-3f * vertex.normal;
  const auto sun_light = [&](glm::vec3 point, glm::vec3 normal) {
    const float facing = glm::dot(normal, sky.to_sun());
    const bool is_lit = facing > 0.0f && !scene.is_blocked({point, sky.to_sun(), 1e-4f, 1e30f}, passage);
    return is_lit ? facing * sky.sun_irradiance() : glm::vec3(0.0f);
  };
  glm::vec3 sum(0.0f);
  for (int i = 0; i < rays; ++i) {
    glm::vec3 direction;
    float square = 0.0f;
    do {
      for (int axis = 0; axis < 3; ++axis) direction[axis] = passage.random.uniform(-1.0f, 1.0f);
      square = glm::dot(direction, direction);
    } while (square > 1.0f || square < 1e-4f);
    direction /= std::sqrt(square);
    const float facing = glm::dot(direction, vertex.normal);
    if (facing <= 0.0f) continue;
    const std::optional<reference::Hit> hit = scene.nearest_hit({from, direction, 1e-4f, 1e30f}, passage);
    if (!hit) {
      sum += facing * sky.radiance(direction);
      continue;
    }
    const reference::ShadingPoint at = reference::shading_point(*hit, direction, 0.0f);
    const glm::vec3 normal = at.geometric_normal;
    const glm::vec3 irradiance =
        open_share * sky.irradiance(normal) + sun_light(at.position + 1e-3f * normal, normal);
    sum += facing * (1.0f - at.surface.metallic) * at.surface.base_colour / pi * irradiance;
  }
  const int sun_rays = std::max(1, rays / 64);
  const reference::Frame frame(sky.to_sun());
  glm::vec3 straight(0.0f);
  for (int i = 0; i < sun_rays; ++i) {
    const float radius = shading::sun_radius_rad * std::sqrt(passage.random.uniform()),
                turn = 2.0f * pi * passage.random.uniform();
    const glm::vec3 direction =
        glm::normalize(frame.in_world({radius * std::cos(turn), radius * std::sin(turn), 1.0f}));
    const float facing = glm::dot(direction, vertex.normal);
    if (facing > 0.0f && !scene.is_blocked({from, direction, 1e-4f, 1e30f}, passage))
      straight += facing * sky.sun_irradiance() / float(sun_rays);
  }
  return 4.0f * pi / float(rays) * sum + straight;
}

/// One object's rays, and what lights it.
class Relit {
 public:
  Relit(const reference::RayScene& rays, const light::SkyTable& sky, std::vector<light::LitVertex> vertices)
      : rays_(rays), sky_(sky), light_(std::move(vertices)) {}

  /// Milliseconds of its light from nothing, as what has moved is lit.
  double time_of(int count, light::Blocked blocked = light::Blocked::bounces) {
    light_.restart();
    return milliseconds([&] { light_.refine(rays_, sky_, count, blocked); });
  }
  /// The light that was traced last.
  std::vector<glm::vec3> light() const { return light_.irradiance(); }

 private:
  const reference::RayScene& rays_;
  const light::SkyTable& sky_;
  light::VertexLight light_;
};

/// Time of all vertices where the crown has moved to, and whether the light that was timed is right: against
/// that of many rays, with that of a crown that casts no shade on itself as control.
void measure_times(const CrownCity& city, const light::SkyTable& sky, const reference::RayScene& rays,
                   Report& report) {
  Relit crown(rays, sky, city.vertices());
  std::vector<double> few_ms(11), many_ms(3), sixteen_ms(11);
  for (double& sample : many_ms) sample = crown.time_of(many_rays);
  const std::vector<glm::vec3> truth = crown.light();
  for (double& sample : sixteen_ms) sample = crown.time_of(few_rays / 4);
  for (double& sample : few_ms) sample = crown.time_of(few_rays);
  const std::vector<glm::vec3> timed = crown.light();
  const double few = median(few_ms).value, many = median(many_ms).value;
  report.add("relight_10k_vertices_64_rays_ms", few);
  report.add("relight_10k_vertices_1024_rays_ms", many);

  // What is timed are rays: sixteen times as many take about sixteen times as long.
  const auto off_proportion = [&](double of_few) {
    const double growth = many / of_few * double(few_rays) / double(many_rays);
    return std::max(growth, 1.0 / growth);
  };
  report.add("relight_time_off_proportion_to_rays", off_proportion(few));
  report.add("relight_time_off_proportion_to_rays_of_a_quarter_of_them",
             off_proportion(median(sixteen_ms).value));

  report.add("relight_10k_vertices_64_rays_rmse_percent", light_rmse_percent(timed, truth));
  const scene::Scene around = city.casters(false);
  const reference::RayScene rays_around(around);
  Relit shadeless(rays_around, sky, city.vertices());
  shadeless.time_of(few_rays);
  report.add("relight_10k_vertices_64_rays_rmse_percent_without_its_own_shade",
             light_rmse_percent(shadeless.light(), truth));
}

/// The error of fewer vertices against random rays that share nothing with what is judged.
void measure_errors(const CrownCity& city, const light::SkyTable& sky, const reference::RayScene& rays,
                    Report& report) {
  constexpr std::size_t judged = 500;  // or a few less
  constexpr int true_rays = 65'536;
  const std::vector<light::LitVertex> all = city.vertices();
  std::vector<light::LitVertex> vertices;
  vertices.reserve(all.size());
  const std::size_t step = all.size() / judged | 1;  // odd: all corners of leaves take turns
  for (std::size_t v = 0; v < all.size(); v += step) vertices.push_back(all[v]);
  std::vector<glm::vec3> truth(vertices.size());
  parallel_for(vertices.size(), [&](std::size_t v) {
    reference::Passage passage{Random(v)};
    truth[v] = random_irradiance(rays, sky, vertices[v], true_rays, passage);
  });
  Relit crown(rays, sky, vertices);
  const auto off_percent = [&](int count, light::Blocked blocked = light::Blocked::bounces) {
    crown.time_of(count, blocked);
    return light_rmse_percent(crown.light(), truth);
  };
  report.add("relight_16_rmse_percent", off_percent(16));
  report.add("relight_256_rmse_percent", off_percent(256));
  report.add("relight_256_rmse_percent_without_bounces", off_percent(256, light::Blocked::dark));
}

constexpr int max_frames = 300;
constexpr double shown_in_the_end_percent = 2.0;  // off, with all rays

/// The frames after a change.
struct Course {
  double first_ms = 0.0, first_off = 0.0;
  std::vector<double> later_ms;
  int frames = 1;         ///< until one shows what shall be shown in the end, or no more were waited for
  double last_off = 0.0;  ///< when all rays are traced
};

Course course_of(CrownCity& shipped, const std::vector<glm::vec3>& truth) {
  Course course;
  course.first_ms = milliseconds([&] { shipped.advance(); });
  course.first_off = light_rmse_percent(shipped.light(), truth);
  bool is_reached = course.first_off <= shown_in_the_end_percent;
  while (course.later_ms.empty() || (!is_reached && course.frames < max_frames)) {
    course.later_ms.push_back(milliseconds([&] { shipped.advance(); }));
    if (is_reached) break;
    ++course.frames;
    is_reached = light_rmse_percent(shipped.light(), truth) <= shown_in_the_end_percent;
  }
  shipped.settle();
  course.last_off = light_rmse_percent(shipped.light(), truth);
  return course;
}

/// Controls of a change: the light before it, percent off, and the time of a frame that has all
/// rays.
struct Controls {
  double old_off, all_rays_ms;
};

/// `change` is part of the keys: "" after the jump, "sky_" after a new sky.
void report_course(const std::string& change, const Course& course, const Controls& controls,
                   Report& report) {
  const std::string key = "relight_shipped_" + change;
  report.add(key + "first_frame_rmse_percent", course.first_off);
  report.add(key + "first_frame_rmse_percent_of_the_old_light", controls.old_off);
  report.add(key + "last_rmse_percent", course.last_off);
  report.add(key + "old_light_rmse_percent", controls.old_off);
  report.add(key + "first_frame_ms", course.first_ms);
  report.add(key + "later_frame_ms", median(course.later_ms).value);
  report.add(key + "frame_ms_of_all_rays", controls.all_rays_ms);
  report.add(key + "frames_to_2_percent", course.frames);
  report.add(key + "frames_to_2_percent_of_the_old_light",
             controls.old_off <= shown_in_the_end_percent ? 1.0 : double(max_frames));
}

/// The same scene twice: as it ships, and with all rays in every frame.
struct Pair {
  CrownCity shipped, exact;

  void send_to_sky(const std::string& message) {
    shipped.send_to_sky(message);
    return exact.send_to_sky(message);
  }
  void move(glm::vec2 from_crossing_m) { shipped.move(from_crossing_m), exact.move(from_crossing_m); }
  void settle() { shipped.settle(), exact.settle(); }
  std::vector<glm::vec3> truth() {
    exact_ms = milliseconds([&] { exact.advance(); });
    return exact.light();
  }
  Controls controls(const std::vector<glm::vec3>& old, const std::vector<glm::vec3>& truth) const {
    return {light_rmse_percent(old, truth), exact_ms};
  }

  double exact_ms = 0.0;  ///< that the last truth took
};

/// One step after which there is no time for rays.
void measure_jump(Pair& pair, Report& report) {
  pair.move(crown_on_crossing_m);
  pair.settle();
  const std::vector<glm::vec3> old = pair.shipped.light();
  pair.move(crown_in_shade_m);
  const std::vector<glm::vec3> truth = pair.truth();
  const Course course = course_of(pair.shipped, truth);
  pair.shipped.stands_beside_facade();
  report_course("", course, pair.controls(old, truth), report);
}

/// Measures a drag by hand: a step in each frame, which never has time for rays, and each frame as the viewer
/// sees it.
void measure_drag(Pair& pair, bool is_quick, Report& report) {
  const int steps = is_quick ? 4 : 12;
  pair.move(crown_on_crossing_m);
  pair.settle();
  const std::vector<glm::vec3> old = pair.shipped.light();
  std::vector<double> off, frame_ms;
  Controls controls{};
  for (int step = 1; step <= steps; ++step) {
    pair.move(glm::mix(crown_on_crossing_m, crown_in_shade_m, float(step) / float(steps)));
    frame_ms.push_back(milliseconds([&] { pair.shipped.advance(); }));
    const std::vector<glm::vec3> truth = pair.truth();
    off.push_back(light_rmse_percent(pair.shipped.light(), truth));
    if (step == steps) controls = pair.controls(old, truth);
  }
  report.add("relight_shipped_drag_worst_frame_rmse_percent", std::ranges::max(off));
  report.add("relight_shipped_drag_rmse_percent_of_the_light_before", controls.old_off);
  report.add("relight_shipped_drag_frame_ms", median(frame_ms).value);
  report.add("relight_shipped_drag_frame_ms_of_all_rays", controls.all_rays_ms);
}

/// The sky of another hour from one frame to the next.
void measure_new_sky(Pair& pair, Report& report) {
  pair.send_to_sky("timeOfDay 6.4");
  pair.move(crown_in_shade_m);
  pair.settle();
  const std::vector<glm::vec3> old = pair.shipped.light();
  pair.send_to_sky("timeOfDay 12");
  // Both deliver the message in the frame in which they light.
  const std::vector<glm::vec3> truth = pair.truth();
  const Course course = course_of(pair.shipped, truth);
  report_course("sky_", course, pair.controls(old, truth), report);
}

}  // namespace

void measure_relighting(const BenchSetup& setup, Report& report) {
  CrownCity::write(setup);
  CrownCity city = CrownCity::open(setup, "");
  city.move(crown_in_sun_m);
  const light::SkyTable sky(city.scene());
  city.stands_free_in_sun(sky.to_sun());
  const scene::Scene casters = city.casters(true);
  const reference::RayScene rays(casters);
  measure_times(city, sky, rays, report);
  measure_errors(city, sky, rays, report);
}

void measure_lit_object(const BenchSetup& setup, Report& report) {
  CrownCity::write(setup);
  CrownCity shipped = CrownCity::open(setup, "");
  CrownCity exact = CrownCity::open(setup, "rays=4096, budget_ms=0");
  Pair pair{.shipped = std::move(shipped), .exact = std::move(exact)};
  measure_jump(pair, report);
  measure_drag(pair, setup.is_quick, report);
  return measure_new_sky(pair, report);
}

}  // namespace parvis::bench
