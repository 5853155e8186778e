#include "bench/vegetation/grove.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <utility>

#include "base/random.h"
#include "base/reduction.h"
#include "graphics/gl/objects.h"
#include "graphics/render/light_source.h"
#include "graphics/shading/tone_curve.h"
#include "life/vegetation/plant_drawable.h"
#include "places/paper_city/round_mesh.h"
#include "scene/data/sun_shadows.h"

namespace parvis::bench {
namespace {

using vegetation::PlantDetail, vegetation::PlantSelection;

constexpr int shapes = 4;
constexpr float spacing_m = 11.0f;
constexpr std::size_t min_triangles = 1'000'000;  // of an oak

Result<scene::Scene> make_scene(Report& report) {
  scene::Scene scene;
  auto lawn = std::make_shared<scene::Model>();
  scene::Part part;
  part.mesh = city::panelled_box({-300, -300, -1}, {300, 300, 0}, 20.0f);
  lawn->parts.push_back(std::move(part));
  lawn->materials.emplace_back();
  lawn->materials.back().base_colour = {0.12f, 0.2f, 0.06f};
  scene::Object object;
  object.name = "lawn", object.model = std::move(lawn);
  scene.objects.push_back(std::move(object));
  const vegetation::PlantKind* oak = vegetation::find_kind("oak");
  Random random(12);
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  for (int i = 0; i < Grove::rows * Grove::columns; ++i) {
    auto shape = vegetation::shared_plant(scene.data<vegetation::PlantShelf>(),
                                          {oak, oak->height_m, 0.0f, std::uint64_t(1 + i % shapes)});
    if (!shape) return shape.errors();
    fewest = std::min(fewest, (*shape)->triangle_count());
    const int row = i / Grove::columns;
    const glm::vec3 foot(spacing_m * (float(i % Grove::columns) - 9.5f) + random.uniform(-2.0f, 2.0f),
                         spacing_m * float(row + 1) + random.uniform(-2.0f, 2.0f), 0.0f);
    const glm::mat4 world_from_plant =
        glm::rotate(glm::translate(glm::mat4(1.0f), foot), random.uniform(0.0f, 6.28f), glm::vec3(0, 0, 1));
    scene.data<vegetation::ScenePlants>().add({*shape, world_from_plant, true}, i);
  }
  report.note(fmt::format("{} oaks of {} triangles at least, {} shapes", Grove::rows * Grove::columns, fewest,
                          shapes));
  if (fewest < min_triangles) return error("the oaks have {} triangles, not a million", fewest);
  return scene;
}

}  // namespace

void CountedPlants::update(const scene::Scene& scene) {
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

void CountedPlants::prepare(const render::View& view, const render::Culling& culling) {
  plants_drawn_->prepare(view, culling);
  if (!is_counting_) return;
  if (view.kind != render::ViewKind::main && view.kind != render::ViewKind::shadow) return;
  selection_.choose(plants_, view, culling, detail_);
  views_.push_back({view.kind, selection_.statistics(), selection_.scale()});
}

void CountedPlants::draw(const render::View& view, render::Pass pass) {
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

std::vector<CountedPlants::View> CountedPlants::end() {
  is_counting_ = false;
  return std::exchange(views_, {});
}

Result<std::unique_ptr<Grove>> Grove::create(const BenchSetup& setup, Report& report) {
  Result<scene::Scene> scene = make_scene(report);
  if (!scene) return scene.errors();
  std::unique_ptr<Grove> grove(new Grove());
  grove->scene_ = *std::move(scene);
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
  drawables.furnish(grove->scene_);
  auto renderer = render::Renderer::create(grove->scene_, drawables, setup.house.get<render::Lights>().make);
  if (!renderer) return renderer.errors();
  grove->renderer_ = *std::move(renderer);
  return grove;
}

void Grove::show_rows(int shown) {
  int number = 0;
  for (vegetation::ScenePlant& plant : scene_.data<vegetation::ScenePlants>().items)
    plant.is_visible = number++ < shown * columns;
}

glm::vec3 Grove::show_one() {
  show_rows(0);
  vegetation::ScenePlant& plant = scene_.data<vegetation::ScenePlants>().items.front();
  plant.is_visible = true;
  Bounds crown;
  for (const vegetation::LeafCluster& cluster : plant.shape->clusters) crown.add(cluster.bounds);
  return transformed(plant.world_from_plant, crown).centre();
}

void Grove::let_cast(bool cast) {
  constexpr int no_node = -1;
  auto& casters = scene_.data<scene::SunShadows>().caster_nodes;
  casters.clear();  // of none: all cast
  if (!cast) casters.push_back({no_node, no_node});
  turn_sun(minute_of_sun_deg);
}

void Grove::turn_sun(float degrees) {
  glm::vec3& to_sun = scene_.sun.direction_to_sun;
  to_sun = glm::vec3(glm::rotate(glm::mat4(1.0f), glm::radians(degrees), glm::vec3(0, 0, 1)) *
                     glm::vec4(to_sun, 0.0f));
}

Status Grove::draw(const Camera& camera, const PlantDetail& detail, int scale) {
  scene_.data<PlantDetail>() = detail;
  Status status = render::draw_frame(*renderer_, scene_, {camera, scale * width, scale * height});
  scene_.data<PlantDetail>() = {};
  return status;
}

Result<Image8> Grove::picture(const Camera& camera, const PlantDetail& detail) {
  if (const Status status = draw(camera, detail); !status) return status.errors();
  return renderer_->read_picture(scene_.exposure);
}

Result<Image8> Grove::true_picture(const Camera& camera) {
  if (const Status status = draw(camera, {.is_full = true}, supersample); !status) return status.errors();
  return shading::tone_mapped_picture(reduced(renderer_->read_radiance(), supersample), scene_.exposure);
}

Result<std::vector<CountedPlants::View>> Grove::counted(const Camera& camera) {
  turn_sun(minute_of_sun_deg);
  plants_->begin();
  const Status status = draw(camera);
  std::vector<CountedPlants::View> views = plants_->end();
  if (!status) return status.errors();
  for (const CountedPlants::View& view : views)
    if (view.drawn != view.chosen.all())
      return error("a view draws {} primitives of plants, and has chosen {}", view.drawn, view.chosen.all());
  return views;
}

vegetation::PlantDetail Grove::detail_at(const Camera& camera, float scale) const {
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

CountedPlants::View Grove::chosen(const Camera& camera, const PlantDetail& detail) const {
  const render::View view = render::camera_view(camera, 0, width, height);
  std::vector<vegetation::PlacedPlant> plants;
  for (const vegetation::ScenePlant& plant : vegetation::scene_plants(scene_))
    plants.push_back(vegetation::placed(plant, int(scene_.objects.size() + plants.size())));
  PlantSelection selection;
  selection.choose(plants, view, render::Culling(view, nullptr), detail);
  return {view.kind, selection.statistics(), selection.scale()};
}

}  // namespace parvis::bench
