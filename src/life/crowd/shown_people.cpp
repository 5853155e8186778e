#include "life/crowd/shown_people.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "base/random.h"
#include "scene/data/object_animation.h"

namespace parvis::crowd {
namespace {

using people::Detail;

// At 1280 x 720 and 55 degrees a pixel is 1.4 mm wide per metre: a level is left where its error is a pixel.
constexpr std::array<float, people::detail_count> level_reach_m{5.0f, 14.0f, 30.0f,
                                                                std::numeric_limits<float>::max()};
constexpr float hysteresis = 1.12f;                          // of who has a finer level already
constexpr std::array<std::size_t, 3> max_per_look{1, 2, 5};  // where several people share a look

constexpr float adult_leg_m = 0.86f;

/// An object of a model that this room poses itself.
scene::Object posed_object(std::string name, std::shared_ptr<const scene::Model> model,
                           std::shared_ptr<const std::vector<scene::Material>> paint) {
  scene::Object object;
  object.name = std::move(name), object.model = std::move(model), object.paint = std::move(paint);
  scene::play(object, {});
  object.is_visible = false;
  return object;
}

}  // namespace

ShownPeople::ShownPeople(std::size_t people, std::uint64_t seed) : people_(people) {
  const std::size_t looks = std::min<std::size_t>(people, max_looks),
                    shapes = std::min<std::size_t>(looks, max_shapes);
  std::vector<std::optional<Shape>> made(shapes);
  parallel_for(shapes, [&](std::size_t i) {
    const std::uint64_t number = seed * 1009u + i;
    const people::Someone who = people::someone(number);
    made[i].emplace(Shape{who, people::make_levels(who, people::colours_of(who, number))});
  });
  for (std::optional<Shape>& shape : made) shapes_.push_back(*std::move(shape));
  for (std::size_t i = 0; i < looks; ++i) {
    Look look;
    look.shape = int(i % shapes);
    const Shape& shape = shape_of(look);
    look.colours = people::colours_of(shape.who, seed * 7919u + i);
    look.paint = std::make_shared<const std::vector<scene::Material>>(
        people::painted(*shape.levels.models.front(), look.colours));
    looks_.push_back(std::move(look));
  }
  for (std::size_t p = 0; p < people; ++p) people_[p].look = int(p % looks);
}

void ShownPeople::add_to(scene::Scene& scene, std::span<const std::string> names, bool is_visible) {
  is_visible_ = is_visible;
  const auto add = [&](std::string name, const Look& look, Detail detail) {
    const Shape& shape = shape_of(look);
    const bool is_one_part = detail >= Detail::far;
    scene.objects.push_back(posed_object(std::move(name), shape.levels.models[std::size_t(detail)],
                                         is_one_part ? nullptr : look.paint));
    if (is_one_part)
      scene.objects.back().deformed_meshes[0].colours =
          people::painted_vertices(shape.levels.covers[std::size_t(detail)], shape.who, look.colours);
    return scene.objects.size() - 1;
  };
  for (std::size_t p = 0; p < people_.size(); ++p) {
    people_[p].name = names[p];
    people_[p].own_object = people_[p].object =
        add(names[p], looks_[std::size_t(people_[p].look)], Detail::distant);
  }
  const std::size_t per_look = (people_.size() + looks_.size() - 1) / std::max<std::size_t>(looks_.size(), 1);
  for (std::size_t i = 0; i < looks_.size(); ++i)
    for (const Detail detail : {Detail::near, Detail::middle, Detail::far})
      for (std::size_t k = 0; k < std::min(max_per_look[std::size_t(detail)], per_look); ++k)
        looks_[i].objects[std::size_t(detail)].push_back(
            add(fmt::format("person of look {}", i + 1), looks_[i], detail));
}

void ShownPeople::set_visible(scene::Scene& scene, bool is_visible) {
  is_visible_ = is_visible;
  for (const ShownPerson& it : people_) scene.objects[it.object].is_visible = is_visible && !it.is_away;
}

void ShownPeople::set_away(scene::Scene& scene, std::size_t person, bool is_away) {
  ShownPerson& it = people_[person];
  it.is_away = is_away;
  scene.objects[it.object].is_visible = is_visible_ && !is_away;
}

const people::BodyField& ShownPeople::body(std::size_t person) const {
  return shape_of(looks_[std::size_t(people_[person].look)]).levels.body;
}

float ShownPeople::speed(std::size_t person, float adult_m_s) const {
  const Shape& shape = shape_of(looks_[std::size_t(people_[person].look)]);
  const float old =
      std::clamp((shape.who.person.age - 55.0f) / 40.0f, 0.0f, 1.0f);  // Weidmann 1993, figure 14
  return adult_m_s * std::sqrt(shape.levels.body.shape().leg() / adult_leg_m) * (1.0f - 0.35f * old);
}

void ShownPeople::place(std::size_t person, const people::Lead& lead, const people::Posture& posture) {
  people_[person].lead = lead, people_[person].posture = posture;
}

void ShownPeople::show_person(scene::Scene& scene, std::size_t person) const {
  const ShownPerson& it = people_[person];
  scene::Object& object = scene.objects[it.object];
  object.name = it.name;
  object.is_visible = is_visible_ && !it.is_away;
  object.world_from_model =
      glm::rotate(glm::translate(glm::mat4(1.0f), it.lead.place), it.lead.heading, glm::vec3(0, 0, 1));
  const std::vector<glm::mat4> pose = people::pose_of(body(person).skeleton(), it.posture);
  for (std::size_t p = 0; p < object.model->parts.size(); ++p)
    if (const scene::Part& part = object.model->parts[p]; part.deformation)
      scene::deform(*part.deformation, {}, pose, part.node, object.deformed_meshes[p]);
}

void ShownPeople::show(scene::Scene& scene) const {
  if (!is_visible_) {  // cameras that follow them move with them
    for (const ShownPerson& it : people_)
      scene.objects[it.object].world_from_model =
          glm::rotate(glm::translate(glm::mat4(1.0f), it.lead.place), it.lead.heading, glm::vec3(0, 0, 1));
    return;
  }
  parallel_for(
      people_.size(),
      [&](std::size_t p) {
        if (!people_[p].is_away) show_person(scene, p);
      },
      4);
}

void ShownPeople::adapt(scene::Scene& scene, std::span<const glm::vec3> eyes) {
  if (!is_visible_ || eyes.empty()) return;
  std::vector<std::pair<float, std::size_t>> by_distance;
  for (std::size_t p = 0; p < people_.size(); ++p) {
    float distance = std::numeric_limits<float>::max();
    for (const glm::vec3 eye : people_[p].is_away ? std::span<const glm::vec3>() : eyes)
      distance = std::min(distance, glm::distance(eye, people_[p].lead.place + glm::vec3(0, 0, 1.2f)));
    by_distance.emplace_back(distance, p);
  }
  std::ranges::sort(by_distance);
  std::vector<std::array<std::size_t, people::detail_count>> used(looks_.size());
  std::vector<std::size_t> changed, chosen(people_.size());
  for (const auto& [distance, p] : by_distance) {
    ShownPerson& it = people_[p];
    const auto look = std::size_t(it.look);
    Detail level = Detail::distant;
    std::size_t object = it.own_object;
    for (const Detail finer : {Detail::near, Detail::middle, Detail::far}) {
      const std::vector<std::size_t>& objects = looks_[look].objects[std::size_t(finer)];
      std::size_t& next = used[look][std::size_t(finer)];
      if (distance > level_reach_m[std::size_t(finer)] * (it.level <= finer ? hysteresis : 1.0f)) continue;
      if (next == objects.size()) continue;
      level = finer, object = objects[next++];
      break;
    }
    chosen[p] = object;
    it.level = level;
  }
  for (std::size_t p = 0; p < people_.size(); ++p)
    if (chosen[p] != people_[p].object) {
      scene.objects[people_[p].object].is_visible = false;
      changed.push_back(p);
    }
  for (const std::size_t p : changed) people_[p].object = chosen[p];
  parallel_for(changed.size(), [&](std::size_t i) { show_person(scene, changed[i]); });
}

}  // namespace parvis::crowd
