// What the search for all vertices costs on the GPU, beside drawing them once more, and what grids save of
// it.
#include <glm/gtc/matrix_transform.hpp>

#include "bench/parts.h"
#include "bench/reflections/judged_method.h"
#include "graphics/gl/context.h"
#include "graphics/render/test_room.h"
#include "reflections/reflector_maps/bindings.h"
#include "reflections/reflector_maps/reflector_cache.h"
#include "reflections/reflector_maps/shown_patch.h"
#include "reflections/virtual_objects/search_settings.h"
#include "reflections/virtual_objects/vertex_search.h"
#include "reflections/virtual_objects/virtual_objects.h"

namespace parvis::bench {
namespace {

using namespace reflection_search;
using namespace reflector_maps;
using namespace virtual_objects;

constexpr int width = 1280, height = 720;
constexpr int small_width = 64, small_height = 36;  // few pixels: what is left is searching and interpolating
constexpr int turns = 31, quick_turns = 15, quick_turns_of_grids = 3;
constexpr float grid10_share = 0.096f;      // the paper's 9.6 %
constexpr int balls = 10, ball_rings = 50;  // 100,000 triangles round the mirror
constexpr float radians_per_turn = 6.28318531f;

/// Balls round an ellipsoid of 1, 0.6, 0.8, the last object.
scene::Scene balls_round_a_mirror() {
  scene::Scene scene;
  scene.sun.direction_to_sun = glm::normalize(glm::vec3(-0.5f, -0.4f, 0.8f));
  for (int i = 0; i < balls; ++i) {
    const float turn = radians_per_turn * float(i) / float(balls);
    const int ball = scene::add(
        scene,
        scene::model_of(scene::sphere({3.2f * std::cos(turn), 3.2f * std::sin(turn), 1.0f}, 0.6f, ball_rings),
                        scene::matt(glm::vec3(0.1f * float(i), 0.5f, 0.3f))),
        true);
    scene.objects[std::size_t(ball)].is_dynamic = true;  // so that it may vanish at no cost
  }
  Mesh ellipsoid;
  append(ellipsoid, scene::sphere(glm::vec3(0.0f), 1.0f, 64),
         glm::scale(glm::mat4(1.0f), {1.0f, 0.6f, 0.8f}));
  std::shared_ptr<scene::Model> mirror = scene::model_of(ellipsoid, scene::Material());
  mirror->materials = render::mirror_box(1.0f)->materials;
  mirror->name = "ellipsoid";
  const int object =
      scene::add(scene, mirror, true, glm::translate(glm::mat4(1.0f), glm::vec3(0.0f, 0.0f, 1.1f)));
  scene.objects[std::size_t(object)].takes_reflection = true;
  methods::settings(scene).method = "virtual_objects";
  methods::settings(scene).uses_level_of_detail = false;  // no virtual grids: every vertex is searched for
  return scene;
}

/// A target of the size of the picture, for a draw without light.
struct PlainTarget {
  gl::Texture objects = gl::texture_2d(GL_R32UI, width, height);
  gl::Texture depth = gl::texture_2d(GL_DEPTH_COMPONENT32F, width, height);
  gl::Framebuffer framebuffer = gl::Framebuffer::create();

  PlainTarget() {
    glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, objects.name(), 0);
    glNamedFramebufferTexture(framebuffer.name(), GL_DEPTH_ATTACHMENT, depth.name(), 0);
  }
};

void show_balls(scene::Scene& scene, bool is_visible) {
  for (int i = 0; i < balls; ++i) scene.objects[std::size_t(i)].is_visible = is_visible;
}

/// The search for all vertices of the balls, as it is done ahead of drawing them mirrored.
class SearchAhead {
 public:
  static SearchAhead create(const scene::Scene& scene, const render::Renderer& renderer) {
    const scene::Object& mirror = scene.objects[balls];
    const Reflector reflector = must(ReflectorCache(scene).reflector(mirror_source(scene, mirror)));
    VertexSearch search = must(VertexSearch::create(scene, renderer.gpu(), {{"ALL_PLAIN", ""}}));
    return SearchAhead(renderer, mirror.world_from_model, reflector, std::move(search));
  }

  void run(const Camera& camera) {
    for (const render::Item& item : renderer_.gpu().items())
      if (item.object < balls) search_.add(item, 0.0f);
    search_.search([&](const gl::Program& program) {
      GpuReflector::bind(program, reflector_.patches().front(), world_from_mirror_,
                         reflector_maps::reflector_unit);
      program.set("viewer_in_reflector", in_reflector(world_from_mirror_, camera.position_in_world()));
    });
  }

 private:
  SearchAhead(const render::Renderer& renderer, const glm::mat4& world_from_mirror,
              const Reflector& reflector, VertexSearch search)
      : renderer_(renderer),
        world_from_mirror_(world_from_mirror),
        reflector_(reflector),
        search_(std::move(search)) {}

  const render::Renderer& renderer_;
  glm::mat4 world_from_mirror_;
  GpuReflector reflector_;
  VertexSearch search_;
};

/// A share of the vertices that is searched for, by grids; 1: each vertex.
struct SearchedShare {
  float share;
  std::unique_ptr<methods::Reflections> reflections;
  std::vector<double> ms;  ///< of its passes with the balls, less those without
};

/// Measures the time that grids save where all is done on the GPU: the corners' pass and the vertices'
/// interpolation beside a search for each vertex.
void measure_grids_in_renderer(scene::Scene& scene, render::Renderer& renderer, const Camera& camera,
                               const BenchSetup& setup, Report& report) {
  std::vector<SearchedShare> shares;
  for (const float share : {1.0f, 0.143f, grid10_share, 0.055f, 0.041f}) {
    virtual_objects::search_settings(scene).grid_share = share;
    std::unique_ptr<methods::Reflections> made = must(make_virtual_objects(scene, renderer));
    shares.push_back({share, std::move(made), {}});
  }
  const auto passes_ms = [&](const SearchedShare& searched, bool has_balls) {
    show_balls(scene, has_balls);
    renderer.begin_frame(scene, camera);
    renderer.prepare_main_view(camera, small_width, small_height);
    return finished_ms([&] { searched.reflections->update(renderer, scene, camera); });
  };
  for (int turn = -1; turn < (setup.is_quick ? quick_turns_of_grids : turns);
       ++turn)  // the first makes what is made once
    for (SearchedShare& searched : shares) {
      const double without = passes_ms(searched, false), with = passes_ms(searched, true);
      if (turn >= 0) searched.ms.push_back(with - without);
    }
  for (const SearchedShare& searched : shares) {
    const Median over_all = ratio_in_turn(searched.ms, shares.front().ms);
    report.note(fmt::format("{:.1f} % of the vertices searched for in the renderer: {:.1f} ms, {:.3f} of all",
                            100.0f * searched.share, median(searched.ms).value, over_all.value));
    if (searched.share == grid10_share) report.add("grid10_over_all_time", over_all);
  }
}

}  // namespace

void measure_cost(const BenchSetup& setup, Report& report) {
  scene::Scene scene = balls_round_a_mirror();
  const auto made = renderer_of(scene);
  render::Renderer& renderer = *made;
  std::unique_ptr<methods::Reflections> reflections = must(make_virtual_objects(scene, renderer));
  must(renderer.set_reflection(reflections.get()));
  Camera camera;
  camera.world_from_camera = look_at({2.4f, -5.2f, 2.6f}, {0.0f, 0.0f, 1.0f});
  const PlainTarget target;
  render::View plain = render::camera_view(camera, target.framebuffer.name(), width, height);
  plain.kind = render::ViewKind::picking;
  plain.excluded_object = balls;

  SearchAhead ahead = SearchAhead::create(scene, renderer);

  // The pass of the vertices, which take what was searched for: what the reflector's own pixels, clearing and
  // resolving take is taken off. The search ahead of it draws, and is timed by itself.
  const auto passes_ms = [&](bool has_balls) {
    show_balls(scene, has_balls);
    renderer.begin_frame(scene, camera);
    renderer.prepare_main_view(camera, width, height);
    glEnable(GL_RASTERIZER_DISCARD);
    const double ms = finished_ms([&] { reflections->update(renderer, scene, camera); });
    glDisable(GL_RASTERIZER_DISCARD);
    return ms;
  };
  std::vector<double> ratios, search_ms, draw_ms;
  passes_ms(true);  // makes what is made once
  ahead.run(camera);
  renderer.draw_view(plain);
  for (int turn = 0; turn < (setup.is_quick ? quick_turns : turns); ++turn) {
    const double without = passes_ms(false);
    const double taken = passes_ms(true) - without;
    search_ms.push_back(finished_ms([&] { ahead.run(camera); }) + taken);
    draw_ms.push_back(finished_ms([&] { renderer.draw_view(plain); }));
    ratios.push_back((search_ms.back() + draw_ms.back()) / draw_ms.back());
  }
  report.add("all_vertices_over_extra_draw", median(ratios));
  measure_grids_in_renderer(scene, renderer, camera, setup, report);
}

}  // namespace parvis::bench
