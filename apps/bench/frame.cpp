// Frames of the paper's city with and without reflections (table 1 of Meyer and Loscos 2003), culling, and a
// mirror ball and box against the ray tracer in textured surroundings two thousand radii away: there a cube
// map is exact, and FLIP shows whether directions, faces and filters are right.
#include "reflections/methods/frame.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "bench/parts.h"
#include "bench/reflections/judged_method.h"
#include "bench/reflections/views.h"
#include "graphics/render/test_culling_check.h"
#include "graphics/render/test_room.h"
#include "graphics/shading/tone_curve.h"
#include "reflections/probes/methods.h"

namespace parvis::bench {
namespace {

constexpr int map_resolution = 1024;
// A map has one centre: its error falls with distance. Far walls leave what this check is for: directions,
// faces, filters.
constexpr float far_radii = 2000.0f;
constexpr float near_radii = 50.0f;

Mesh ball() {
  constexpr int rings = 96, sectors = 192;
  Mesh mesh;
  for (int r = 0; r <= rings; ++r)
    for (int s = 0; s <= sectors; ++s) {
      const float polar = 3.14159265f * float(r) / rings, azimuth = 6.2831853f * float(s) / sectors;
      const glm::vec3 n(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                        std::cos(polar));
      mesh.positions.push_back(n);
      mesh.normals.push_back(n);
      mesh.uvs.emplace_back(0.0f);
    }
  for (std::uint32_t r = 0; r < rings; ++r)
    for (std::uint32_t s = 0; s < sectors; ++s) {
      const std::uint32_t a = r * (sectors + 1) + s, b = a + sectors + 1;
      mesh.indices.insert(mesh.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
    }
  return mesh;
}

/// A cube of half size `half`; turned inside out it is a room.
Mesh cube(float half, bool is_room) {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0f, 1.0f}) {
      glm::vec3 n(0.0f), u(0.0f);
      n[axis] = side, u[(axis + 1) % 3] = 1.0f;
      const glm::vec3 v = glm::cross(n, u);
      const std::uint32_t first = std::uint32_t(mesh.positions.size());
      for (const glm::vec2 corner :
           {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
        mesh.positions.push_back(half * (n + corner.x * u + corner.y * v));
        mesh.normals.push_back(is_room ? -n : n);
        // each side of the room shows another part of the picture
        const glm::vec2 tile(float(axis), side > 0.0f ? 1.0f : 0.0f);
        mesh.uvs.push_back((tile + 0.5f * corner + 0.5f) / glm::vec2(3.0f, 2.0f));
      }
      if (is_room)
        mesh.indices.insert(mesh.indices.end(), {first, first + 2, first + 1, first, first + 3, first + 2});
      else
        mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
    }
  return mesh;
}

/// Six different walls of soft, coloured patches.
Image8 wall_picture() {
  constexpr int cell = 48, across = 8;
  Image8 picture(3 * cell * across, 2 * cell * across, 4, 255);
  std::vector<glm::vec3> colours(std::size_t{3 * across} * std::size_t{2 * across});
  Random random(11);
  for (glm::vec3& colour : colours)
    colour = {random.uniform(40, 230), random.uniform(40, 230), random.uniform(40, 230)};
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const glm::vec3 colour =
          colours[std::size_t(y / cell) * std::size_t{3 * across} + std::size_t(x / cell)];
      for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = std::uint8_t(colour[c]);
    }
  return picture;
}

scene::Scene mirror_scene(Mesh mirror, float room_half_m) {
  scene::Material wall;
  wall.base_colour = glm::vec3(0.0f);
  wall.roughness = 1.0f;
  wall.emission = glm::vec3(1.0f);
  wall.emission_texture = 0;
  auto room = std::make_shared<scene::Model>();
  room->textures.push_back({"walls", wall_picture(), true, scene::Wrap::clamp, scene::Wrap::clamp});
  room->materials = {wall};
  room->parts = {{"room", cube(room_half_m, true), 0, 0, false}};

  auto reflector = render::mirror_box(1.0f);  // for its material
  reflector->parts = {{"mirror", std::move(mirror), 0, 0, true}};

  scene::Scene scene;
  scene.sun.irradiance = glm::vec3(0.0f);
  scene.objects.push_back({"room", room, glm::mat4(1.0f), {}, false, false});
  scene.objects.push_back({"mirror", reflector, glm::mat4(1.0f), {}, true, true});
  methods::settings(scene) = {"rerendered_cube_map", map_resolution, false};
  return scene;
}

/// The re-rendered map with its -y and +x faces exchanged.
class SwappedFaces final : public probes::CubeMapReflections {
 public:
  void bind(const gl::Program& program, int) override { bind_map(program, map_); }

 private:
  void update_maps(render::Renderer& renderer, const scene::Scene&,
                   const std::vector<methods::VisibleReflector>& reflectors) override {
    for (int face = 0; face < 6; ++face)
      map_.draw_face(renderer, face, reflectors.front().centre, reflectors.front().object);
    const gl::Texture kept = gl::texture_2d(GL_RGBA16F, map_resolution, map_resolution);
    const auto copy = [](GLuint from, GLenum from_target, int from_layer, GLuint to, GLenum to_target,
                         int to_layer) {
      glCopyImageSubData(from, from_target, 0, 0, 0, from_layer, to, to_target, 0, 0, 0, to_layer,
                         map_resolution, map_resolution, 1);
    };
    constexpr int first = 0, second = 3;
    copy(map_.texture(), GL_TEXTURE_CUBE_MAP, first, kept.name(), GL_TEXTURE_2D, 0);
    copy(map_.texture(), GL_TEXTURE_CUBE_MAP, second, map_.texture(), GL_TEXTURE_CUBE_MAP, first);
    copy(kept.name(), GL_TEXTURE_2D, 0, map_.texture(), GL_TEXTURE_CUBE_MAP, second);
    map_.update_levels();
  }

  methods::CubeMap map_{map_resolution};
};

double flip_of(Mesh mirror, float radii, bool swaps_faces = false) {
  const scene::Scene scene = mirror_scene(std::move(mirror), radii);
  const auto renderer = renderer_of(scene);
  std::unique_ptr<methods::Reflections> reflections;
  if (swaps_faces)
    reflections = std::make_unique<SwappedFaces>();
  else
    reflections = std::make_unique<probes::RerenderedCubeMap>(scene);
  must(renderer->set_reflection(reflections.get()));
  Camera camera;
  camera.world_from_camera = look_at({1.2f, -3.0f, 0.9f}, {0, 0, 0});
  const render::EyeView view{camera, full_picture.x, full_picture.y};
  must(methods::draw_frame(*renderer, scene, reflections.get(), view));
  const Image8 drawn = renderer->read_picture(scene.exposure);
  const reference::TracedPicture truth = methods::trace_frame(*renderer, scene, view);
  return flip_between(drawn, shading::tone_mapped_picture(truth.radiance, scene.exposure), truth.mirror_mask);
}

/// Times whole frames of each method in alternating order.
void time_frames(stage::Stage& stage, const Camera& camera, int cars, int repeats, Report& report) {
  const auto methods = judged_methods(stage, {{"none", usual("none")},
                                              {"rerendered", usual("rerendered_cube_map")},
                                              {"rerendered_lod", usual("rerendered_cube_map", true)},
                                              {"mem", usual("multiple_environment_maps")},
                                              {"mem_lod", usual("multiple_environment_maps", true)}});
  std::vector<std::vector<double>> samples(methods.size());
  for (int repeat = 0; repeat < repeats; ++repeat)
    for (std::size_t i = 0; i < methods.size(); ++i) {
      const std::size_t m = repeat % 2 == 0 ? i : methods.size() - 1 - i;
      draw(stage, methods[m], camera, full_picture);  // makes what is made once
      samples[m].push_back(finished_ms([&] { draw_again(stage, methods[m], camera, full_picture); }));
    }
  for (std::size_t m = 0; m < methods.size(); ++m)
    report.add(fmt::format("frame_ms_{}_{}", methods[m].name, cars), median(samples[m]));
}

/// How far the passes of frames add up to other than the frames by the clock; the control leaves out each
/// frame's longest pass.
void measure_pass_times(stage::Stage& stage, const Camera& camera, Report& report) {
  constexpr int frames = 8;
  std::vector<double> off, off_of_others;
  double timed_ms = 0.0;
  for (int frame = 0; frame <= frames * gl::PassTimes::timed_every + 1; ++frame) {
    const double ms = finished_ms([&] { stage.draw(camera, full_picture.x, full_picture.y); });
    const int since_timed = frame % gl::PassTimes::timed_every;
    if (since_timed == 0) timed_ms = ms;
    if (since_timed != 1 || frame == 1) continue;  // the first frame makes what is made once
    double sum_ms = 0.0, longest_ms = 0.0;
    for (const gl::PassTime& pass : stage.pass_times().latest())
      sum_ms += 1e3 * pass.seconds, longest_ms = std::max(longest_ms, 1e3 * pass.seconds);
    off.push_back(100.0 * std::abs(sum_ms / timed_ms - 1.0));
    off_of_others.push_back(100.0 * std::abs((sum_ms - longest_ms) / timed_ms - 1.0));
  }
  report.add("pass_times_off_frame_percent", *std::ranges::max_element(off));
  report.add("pass_times_off_frame_percent_without_the_longest", *std::ranges::min_element(off_of_others));
}

/// Cars that are hidden by what stands before them: how many are culled, and whether one is that has a pixel.
void measure_occlusion(stage::Stage& stage, std::size_t views, Report& report) {
  render::CullingCheck all;
  for (const Camera& camera : street_views(stage.scene(), views, 1.6f, 0.0f, full_picture)) {
    stage.renderer().begin_frame(stage.scene(), camera);
    const render::CullingCheck one =
        render::check_culling(stage.renderer(), stage.scene(), camera, full_picture.x, full_picture.y);
    all.hidden += one.hidden, all.hidden_culled += one.hidden_culled, all.false_culls += one.false_culls;
  }
  report.add("occlusion_culled_percent", all.hidden > 0 ? 100.0 * all.hidden_culled / all.hidden : 0.0);
  report.add("false_culls", all.false_culls);
  report.note(fmt::format("{} of {} hidden cars in the frustum are culled, over {} views", all.hidden_culled,
                          all.hidden, views));
}

}  // namespace

void measure_frames(const BenchSetup& setup, Report& report) {
  const scene::Scene city = setup.scene(setup.city() / "paper.xp");
  report.add("triangles", double(city.static_triangle_count()));
  keep_maps(city, usual("multiple_environment_maps"));
  for (const auto& [cars, minimum, maximum] : {std::tuple{15, 3, 5}, std::tuple{30, 10, 10}}) {
    const auto stage = stage_with(city, cars);
    const Camera camera = view_of_cars(*stage, minimum, maximum, full_picture, report);
    time_frames(*stage, camera, cars, setup.is_quick ? 7 : 21, report);
    if (cars < 30) {
      measure_pass_times(*stage, camera, report);
      continue;
    }
    measure_occlusion(*stage, setup.is_quick ? 80 : 400, report);
  }
}

void measure_mirrors(const BenchSetup& /*setup*/, Report& report) {
  const Mesh box = cube(0.9f, false);
  report.add("ball_flip", flip_of(ball(), far_radii));
  report.add("ball_flip_faces_swapped", flip_of(ball(), far_radii, true));
  report.add("box_flip", flip_of(box, far_radii));
  report.add("box_flip_faces_swapped", flip_of(box, far_radii, true));
  report.note(fmt::format("at 50 radii, where the map's one centre shows: ball {:.4f}, box {:.4f}",
                          flip_of(ball(), near_radii), flip_of(box, near_radii)));
}

}  // namespace parvis::bench
