// Points and lines of grown plants against their real geometry, and what they cost.
#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "base/random.h"
#include "base/reduction.h"
#include "bench/parts.h"
#include "graphics/gl/objects.h"
#include "graphics/render/frame_views.h"
#include "graphics/render/light_source.h"
#include "graphics/render/renderer.h"
#include "graphics/shading/tone_curve.h"
#include "life/vegetation/plant_drawable.h"
#include "life/vegetation/plant_selection.h"
#include "life/vegetation/scene_plant.h"
#include "scene/data/sun_shadows.h"
#include "synthesis/round_mesh.h"

namespace parvis::bench {
namespace {

using vegetation::PlantDetail, vegetation::PlantSelection;

/// The drawable of all plants, which counts what it draws in each view of a frame: the main one and those of
/// shadow maps.
class CountedPlants final : public render::Drawable {
 public:
  /// Counts of one view.
  struct View {
    render::ViewKind kind;
    vegetation::PlantStatistics chosen;  ///< what the view is to draw
    float scale;                         ///< below 1 the budget is kept by it: PlantSelection::scale
    std::size_t drawn = 0;               ///< primitives that OpenGL has counted
  };

  explicit CountedPlants(std::unique_ptr<render::Drawable> plants) : plants_drawn_(std::move(plants)) {}

  void update(const scene::Scene& scene) override {
    plants_drawn_->update(scene);
    if (!is_counting_) return;
    detail_ = scene.data<PlantDetail>();
    const auto& shadows = scene.data<scene::SunShadows>();
    const std::vector<int>& makers = scene.data<vegetation::ScenePlants>().makers;
    plants_.clear();
    for (const vegetation::ScenePlant& plant : vegetation::scene_plants(scene)) {
      const std::size_t number = plants_.size();
      plants_.push_back(vegetation::placed(plant, int(scene.objects.size() + number)));
      plants_.back().casts_shadow = shadows.casts_item_of(makers[number]);
    }
  }
  render::Extents extents() const override { return plants_drawn_->extents(); }
  std::span<render::QualityWish> quality_wishes(const render::View& view,
                                                const render::Culling& culling) override {
    return plants_drawn_->quality_wishes(view, culling);
  }
  void prepare(const render::View& view, const render::Culling& culling) override;
  void draw(const render::View& view, render::Pass pass) override {
    // The main view is drawn after others that were prepared later.
    const auto counted = std::ranges::find(views_.rbegin(), views_.rend(), view.kind, &View::kind);
    if (counted == views_.rend()) return plants_drawn_->draw(view, pass);
    const gl::Query primitives = gl::Query::create(GLenum(GL_PRIMITIVES_GENERATED));
    glBeginQuery(GL_PRIMITIVES_GENERATED, primitives.name());
    plants_drawn_->draw(view, pass);
    glEndQuery(GL_PRIMITIVES_GENERATED);
    GLuint64 count = 0;
    glGetQueryObjectui64v(primitives.name(), GL_QUERY_RESULT, &count);
    counted->drawn += std::size_t(count);
  }

  /// Counts from now on.
  void begin() { is_counting_ = true; }
  /// The views since `begin`; counts no more, so that frames which are timed take no time for it.
  std::vector<View> end() {
    is_counting_ = false;
    return std::exchange(views_, {});
  }

 private:
  std::unique_ptr<render::Drawable> plants_drawn_;
  bool is_counting_ = false;
  std::vector<vegetation::PlacedPlant> plants_;
  vegetation::PlantDetail detail_;
  vegetation::PlantSelection selection_;
  std::vector<View> views_;
};

/// Angle by which the sun turns in a minute.
inline constexpr float minute_of_sun_deg = 0.25f;

constexpr int rows = 10, columns = 20, shapes = 4;
constexpr float spacing_m = 11.0f;
constexpr std::size_t min_triangles = 1'000'000;  // of an oak

scene::Scene make_scene(Report& report) {
  scene::Scene scene;
  auto lawn = std::make_shared<scene::Model>();
  scene::Part part;
  part.mesh = synthesis::panelled_box({-300, -300, -1}, {300, 300, 0}, 20.0f);
  lawn->parts.push_back(std::move(part));
  lawn->materials.emplace_back();
  lawn->materials.back().base_colour = {0.12f, 0.2f, 0.06f};
  scene::Object object;
  object.name = "lawn", object.model = std::move(lawn);
  scene.objects.push_back(std::move(object));
  const vegetation::PlantKind* oak = vegetation::find_kind("oak");
  Random random(12);
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  for (int i = 0; i < rows * columns; ++i) {
    auto shape = must(vegetation::shared_plant(scene.data<vegetation::PlantCache>(),
                                               {oak, oak->height_m, 0.0f, std::uint64_t(1 + i % shapes)}));
    fewest = std::min(fewest, shape->triangle_count());
    const int row = i / columns;
    const glm::vec3 foot(spacing_m * (float(i % columns) - 9.5f) + random.uniform(-2.0f, 2.0f),
                         spacing_m * float(row + 1) + random.uniform(-2.0f, 2.0f), 0.0f);
    const glm::mat4 world_from_plant =
        glm::rotate(glm::translate(glm::mat4(1.0f), foot), random.uniform(0.0f, 6.28f), glm::vec3(0, 0, 1));
    scene.data<vegetation::ScenePlants>().add({shape, world_from_plant, true}, i);
  }
  report.note(fmt::format("{} oaks of {} triangles at least, {} shapes", rows * columns, fewest, shapes));
  if (fewest < min_triangles) fail("the oaks have {} triangles, not a million", fewest);
  return scene;
}
void CountedPlants::prepare(const render::View& view, const render::Culling& culling) {
  plants_drawn_->prepare(view, culling);
  if (!is_counting_) return;
  if (view.kind != render::ViewKind::main && view.kind != render::ViewKind::shadow) return;
  selection_.choose(plants_, view, culling, detail_);
  views_.push_back({view.kind, selection_.statistics(), selection_.scale()});
}
/// 200 oaks of a million triangles each, of four shapes, in ten rows.
class Grove {
 public:
  static constexpr int width = 640, height = 360;

  /// Fails if the oaks have fewer triangles, or if the renderer does. Needs a current OpenGL context.
  static std::unique_ptr<Grove> create(Report& report) {
    scene::Scene scene = make_scene(report);
    std::unique_ptr<Grove> grove(new Grove());
    grove->scene_ = std::move(scene);
    render::Drawables drawables;
    render::DrawableKind kind = vegetation::scene_plants_kind();
    kind.make = [make = kind.make, plants = &grove->plants_](
                    const scene::Scene& of, int first_thing) -> Result<std::unique_ptr<render::Drawable>> {
      Result<std::unique_ptr<render::Drawable>> made = make(of, first_thing);
      if (!made) return made;
      auto counted = std::make_unique<CountedPlants>(*std::move(made));
      *plants = counted.get();
      return std::unique_ptr<render::Drawable>(std::move(counted));
    };
    drawables.add(std::move(kind));
    drawables.attach(grove->scene_);
    grove->renderer_ = must(render::Renderer::create(grove->scene_, drawables,
                                                     rooms::all_registries().get<render::Lights>().make));
    return grove;
  }
  Grove(const Grove&) = delete;

  /// Shows the rows of trees that are nearest to the lawn: the real geometry of all takes minutes.
  void show_rows(int shown) {
    int number = 0;
    for (vegetation::ScenePlant& plant : scene_.data<vegetation::ScenePlants>().items)
      plant.is_visible = number++ < shown * columns;
  }
  /// Shows one tree alone, and returns the middle of its crown.
  glm::vec3 show_one() {
    show_rows(0);
    vegetation::ScenePlant& plant = scene_.data<vegetation::ScenePlants>().items.front();
    plant.is_visible = true;
    Bounds crown;
    for (const vegetation::LeafCluster& cluster : plant.shape->clusters) crown.add(cluster.bounds);
    return transformed(plant.world_from_plant, crown).centre();
  }
  /// Whether trees cast shadows, as they do at first.
  void let_cast(bool cast) {
    constexpr int no_node = -1;
    auto& casters = scene_.data<scene::SunShadows>().caster_nodes;
    casters.clear();  // of none: all cast
    if (!cast) casters.push_back({no_node, no_node});
    turn_sun(minute_of_sun_deg);
  }
  /// Turns the sun about the vertical, so that the next frame draws its shadow maps again.
  void turn_sun(float degrees) {
    glm::vec3& to_sun = scene_.sun.direction_to_sun;
    to_sun = glm::vec3(glm::rotate(glm::mat4(1.0f), glm::radians(degrees), glm::vec3(0, 0, 1)) *
                       glm::vec4(to_sun, 0.0f));
  }

  /// A frame as it ships, or in some detail with `scale` times the pixels of a picture, across and down.
  void draw(const Camera& camera, const vegetation::PlantDetail& detail = {}, int scale = 1) {
    scene_.data<PlantDetail>() = detail;
    const Status status = render::draw_frame(*renderer_, scene_, {camera, scale * width, scale * height});
    scene_.data<PlantDetail>() = {};
    must(status);
  }
  /// The picture of such a frame.
  Image8 picture(const Camera& camera, const vegetation::PlantDetail& detail = {}) {
    draw(camera, detail);
    return renderer_->read_picture(scene_.exposure);
  }
  /// The real geometry, whose pixels are the mean of many samples: leaves are smaller than pixels, and the
  /// few samples that a picture has of each show which of them they hit, not what a crown looks like.
  Image8 true_picture(const Camera& camera) {
    draw(camera, {.is_full = true}, supersample);
    return shading::tone_mapped_picture(reduced(renderer_->read_radiance(), supersample), scene_.exposure);
  }
  /// Samples of a true picture over those of a picture, across and down.
  static constexpr int supersample = 4;

  /// Primitives that the main view of a camera would draw in some detail; nothing is drawn.
  CountedPlants::View chosen(const Camera& camera, const vegetation::PlantDetail& detail) const {
    const render::View view = render::camera_view(camera, 0, width, height);
    std::vector<vegetation::PlacedPlant> plants;
    for (const vegetation::ScenePlant& plant : vegetation::scene_plants(scene_))
      plants.push_back(vegetation::placed(plant, int(scene_.objects.size() + plants.size())));
    PlantSelection selection;
    selection.choose(plants, view, render::Culling(view, nullptr), detail);
    return {view.kind, selection.statistics(), selection.scale()};
  }
  /// The detail by which a picture of `camera` shows plants as if its resolution were smaller by `scale`, at
  /// most 1: the largest budget that is kept by no larger a factor.
  vegetation::PlantDetail detail_at(const Camera& camera, float scale) const {
    constexpr int no_budget = 1 << 30;
    vegetation::PlantDetail few, many;
    few.max_primitives = 1, many.max_primitives = no_budget;
    while (many.max_primitives - few.max_primitives > 1) {
      vegetation::PlantDetail middle;
      middle.max_primitives = few.max_primitives + (many.max_primitives - few.max_primitives) / 2;
      (chosen(camera, middle).scale <= scale ? few : many) = middle;
    }
    return few;
  }
  /// Primitives of all views of a frame whose shadow maps are drawn again, the sun having moved. Fails where
  /// one of them draws other primitives than it has chosen.
  std::vector<CountedPlants::View> counted(const Camera& camera) {
    turn_sun(minute_of_sun_deg);
    plants_->begin();
    draw(camera);
    std::vector<CountedPlants::View> views = plants_->end();
    for (const CountedPlants::View& view : views)
      if (view.drawn != view.chosen.all())
        fail("a view draws {} primitives of plants, and has chosen {}", view.drawn, view.chosen.all());
    return views;
  }

 private:
  Grove() = default;

  scene::Scene scene_;
  CountedPlants* plants_ = nullptr;  ///< the renderer's
  std::unique_ptr<render::Renderer> renderer_;
};

/// A step of a viewer: a fiftieth of the way to the tree, as a walker's in a tenth of a second from seven
/// metres.
constexpr float nearer = 0.98f;

/// Where leaves of 5 to 8 pixels change from points to coarse ones, one by one, a transition without blending
/// would change all of them at once: the control takes that way in one step.
constexpr float nearer_at_once = 5.0f / 8.0f;
constexpr float farthest_m = 45.0f, nearest_m = 7.0f;
constexpr float angle = 0.32f;  ///< so narrow that the crown fills the picture where forms change
/// A step of a viewer who looks round in twelve seconds: what is turned in a tenth of a second.
constexpr float turn_deg = 3.0f;
constexpr int steps_round = 120;

Camera looking_at(glm::vec3 crown, float distance_m) {
  Camera camera;
  camera.world_from_camera = look_at(crown + glm::vec3(0.0f, -distance_m, 0.0f), crown);
  camera.vertical_fov = angle;
  return camera;
}

/// FLIP between the picture of a camera and the same with the forms of another scale of the resolution: what
/// changes by the forms alone, while nothing in the picture moves.
double pop(Grove& grove, const Camera& camera, float other_scale) {
  return flip_between(grove.picture(camera), grove.picture(camera, grove.detail_at(camera, other_scale)));
}

/// The largest pops of many views.
struct Pops {
  double flip = 0.0, at_once = 0.0;  ///< of the step before; of forms that change in one step
  std::size_t view = 0;              ///< that has the largest `flip`
};

/// A view after a step, and by which the resolution that forms go by is smaller: there, before the step, and
/// before one of all that forms change over.
struct Step {
  Camera camera;
  float scale, scale_before, scale_at_once;

  /// A factor's logarithm.
  float change() const { return std::abs(std::log(scale / scale_before)); }
};

Pops largest_pops(Grove& grove, const std::vector<Step>& steps) {
  Pops largest;
  for (std::size_t s = 0; s < steps.size(); ++s) {
    const Step& step = steps[s];
    const double flip = pop(grove, step.camera, step.scale_before),
                 at_once = pop(grove, step.camera, step.scale_at_once);
    if (flip > largest.flip) largest.flip = flip, largest.view = s;
    largest.at_once = std::max(largest.at_once, at_once);
  }
  return largest;
}

float distance_at(int place, int places) {
  return farthest_m * std::pow(nearest_m / farthest_m, float(place) / float(std::max(places - 1, 1)));
}

/// One tree, from afar to near: its forms change by its size alone.
void measure_approach(bool is_quick, Grove& grove, Report& report) {
  const int places = is_quick ? 8 : 24;
  const glm::vec3 crown = grove.show_one();
  std::vector<Step> steps;
  steps.reserve(std::size_t(places));
  for (int i = 0; i < places; ++i) {
    const float distance_m = distance_at(i, places);
    const Camera now = looking_at(crown, distance_m);
    const auto before = [&](float share) {
      return share * grove.chosen(looking_at(crown, distance_m / share), {}).scale;
    };
    steps.push_back({now, grove.chosen(now, {}).scale, before(nearer), before(nearer_at_once)});
  }
  const Pops pops = largest_pops(grove, steps);
  grove.show_rows(rows);
  if (!(pops.flip > 0.0)) fail("no form of the tree changes from {} m to {} m", farthest_m, nearest_m);
  report.add("vegetation_pop_flip", pops.flip);
  report.add("vegetation_pop_flip_without_blending", pops.at_once);
}

/// A camera under the first trees: the lawn lies on one side, the grove on the other.
Camera looking_round(int step) {
  constexpr glm::vec3 eye{5.0f, 5.0f, 1.7f};
  const float heading = glm::radians(turn_deg * float(step));
  Camera camera;
  camera.world_from_camera = look_at(eye, eye + glm::vec3(std::sin(heading), std::cos(heading), 0.04f));
  return camera;
}

/// All trees, around a viewer who turns: what comes into view takes from the budget of what is there.
void measure_turning(bool is_quick, Grove& grove, Report& report) {
  std::vector<Step> steps;
  steps.reserve(steps_round);
  float before = grove.chosen(looking_round(-1), {}).scale;
  for (int i = 0; i < steps_round; ++i) {
    const Camera now = looking_round(i);
    const float scale = grove.chosen(now, {}).scale;
    steps.push_back({now, scale, before, nearer_at_once * scale});
    before = scale;
  }
  std::ranges::sort(steps, std::greater<>(), &Step::change);
  if (!(steps.front().change() > 0.0f))
    fail("the budget of primitives changes no form as a viewer turns round");
  steps.resize(is_quick ? 3 : 12);
  const Pops pops = largest_pops(grove, steps);
  report.add("vegetation_pop_flip_turning", pops.flip);
  report.add("vegetation_pop_flip_turning_without_blending", pops.at_once);
}

void measure_pops(const BenchSetup& setup, Grove& grove, Report& report) {
  grove.let_cast(false);  // maps of shadows would follow the budget that stands for another view
  measure_approach(setup.is_quick, grove, report);
  measure_turning(setup.is_quick, grove, report);
}

constexpr float closer = 0.4f;  // of a view's angle

/// Views under the first trees, from the lawn before all of them, and from above.
std::vector<Camera> grove_views() {
  std::vector<Camera> cameras(3);
  cameras[0].world_from_camera = look_at({5.0f, 5.0f, 1.7f}, {0.0f, 60.0f, 4.0f});
  cameras[1].world_from_camera = look_at({0.0f, -60.0f, 1.7f}, {0.0f, 60.0f, 5.0f});
  cameras[2].world_from_camera = look_at({-60.0f, -40.0f, 25.0f}, {0.0f, 50.0f, 3.0f});
  for (Camera& camera : cameras) camera.vertical_fov = 0.8f;
  return cameras;
}

/// Times of frames under a sun that moves from frame to frame, so that each draws its shadow maps again.
std::vector<double> frame_times(Grove& grove, Camera camera, int frames) {
  std::vector<double> times_ms;
  for (int i = 0; i <= frames; ++i) {
    camera.world_from_camera =
        glm::translate(glm::mat4(1.0f), {0.02f, 0.02f, 0.0f}) * camera.world_from_camera;
    grove.turn_sun(minute_of_sun_deg);
    const double ms = milliseconds([&] {
      grove.draw(camera);
      glFinish();
    });
    if (i > 0) times_ms.push_back(ms);
  }
  return times_ms;
}

/// Costs of the views of the grove: the slowest frames, the largest counts.
struct Cost {
  std::vector<double> slowest_ms;
  double in_view = 0.0, of_real_geometry = 0.0;  ///< primitives; those of the real geometry in a main view

  void add(Grove& grove, const Camera& camera, int frames, const std::string& name, Report& report) {
    const std::vector<double> ms = frame_times(grove, camera, frames);
    if (slowest_ms.empty() || median(ms).value > median(slowest_ms).value) slowest_ms = ms;
    const auto views = grove.counted(camera);
    long main_views = 0, shadow_views = 0;
    for (const CountedPlants::View& view : views) {
      const bool is_shadow = view.kind == render::ViewKind::shadow;
      ++(is_shadow ? shadow_views : main_views);
      in_view = std::max(in_view, double(view.drawn));
      report.note(fmt::format(
          "{}, {}: {} triangles, {} points, {} lines{}", name, is_shadow ? "a shadow map" : "the view itself",
          view.chosen.triangles, view.chosen.points, view.chosen.lines,
          view.scale < 1.0f ? fmt::format(", kept to the budget by {:.2f} of the resolution", view.scale)
                            : std::string(", below the budget by themselves")));
    }
    if (main_views != 1 || shadow_views == 0)
      fail("{}: a frame under a new sun has drawn {} main and {} shadow views", name, main_views,
           shadow_views);
    of_real_geometry =
        std::max(of_real_geometry, double(grove.chosen(camera, {.is_full = true}).chosen.all()));
  }
};

/// Pictures of the grove against its real geometry.
struct Quality {
  double flip = 0.0, flip_thin = 0.0;  ///< the largest; area not kept
  double flip_bare = 1e9;              ///< the smallest of a lawn without trees
  std::vector<double> full_ms;         ///< what the real geometry took

  /// Adds the figures of so many rows of trees, in the forms that the view has of all of them.
  void add(Grove& grove, const Camera& camera, int shown, const std::string& name, Report& report) {
    const float scale_of_all = grove.chosen(camera, {}).scale;
    grove.show_rows(shown);
    const PlantDetail as_shipped = shown < rows ? grove.detail_at(camera, scale_of_all) : PlantDetail();
    PlantDetail without_area = as_shipped;
    without_area.keeps_area = false;
    const Image8 truth = grove.true_picture(camera);
    const auto flip_of = [&](const Image8& picture) { return flip_between(picture, truth); };
    Image8 real_geometry;
    full_ms.push_back(milliseconds([&] { real_geometry = grove.picture(camera, {.is_full = true}); }));
    const double full = flip_of(real_geometry), shipped = flip_of(grove.picture(camera, as_shipped)),
                 thin = flip_of(grove.picture(camera, without_area));
    grove.show_rows(0);
    const double bare = flip_of(grove.picture(camera));
    grove.show_rows(rows);
    flip = std::max(flip, shipped), flip_thin = std::max(flip_thin, thin);
    flip_bare = std::min(flip_bare, bare);
    report.note(fmt::format("{}: FLIP {:.4f}, area not kept {:.4f}; real geometry: {:.4f}, in {:.1f} s", name,
                            shipped, thin, full, full_ms.back() / 1e3));
  }
};

}  // namespace

/// A grove of 200 oaks of a million triangles each. Quality and cost are measured in the same views, and
/// closer, where trees fill the picture.
void measure_vegetation(const BenchSetup& setup, Report& report) {
  const auto made = Grove::create(report);
  Grove& grove = *made;
  constexpr int quick_rows = 2;
  const std::vector<Camera> views = grove_views();
  Cost cost;
  Quality quality;
  for (std::size_t v = 0; v < views.size(); ++v)
    for (const float part_of_angle : {1.0f, closer}) {
      Camera camera = views[v];
      camera.vertical_fov *= part_of_angle;
      const bool is_left_out = setup.is_quick && (v == 2 || (v == 0 && part_of_angle == closer));
      if (is_left_out) continue;
      const std::string name = fmt::format("view {} at {} of its angle", v, part_of_angle);
      cost.add(grove, camera, setup.is_quick ? 5 : 15, name, report);
      quality.add(grove, camera, setup.is_quick ? quick_rows : rows, name, report);
    }
  if (!(quality.flip_bare > 0.05))
    fail("a lawn without trees has a FLIP of {}: the trees are not drawn", quality.flip_bare);
  const Median frame = median(cost.slowest_ms);
  report.add("vegetation_fps_200_trees_1m_triangles",
             Median{1e3 / frame.value, 1e3 / frame.high, 1e3 / frame.low});
  report.add("vegetation_fps_real_geometry_control", 1e3 / median(quality.full_ms).value);
  report.add("vegetation_primitives", cost.in_view);
  report.add("vegetation_primitives_real_geometry_control", cost.of_real_geometry);
  report.add("vegetation_flip", quality.flip);
  report.add("vegetation_flip_area_not_kept_control", quality.flip_thin);
  report.add("vegetation_flip_without_trees_control", quality.flip_bare);
  measure_pops(setup, grove, report);
}

}  // namespace parvis::bench
