#include "life/crowd/shown_people.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "base/random.h"
#include "scene/data/object_animation.h"
#include "scene/data/shadow_proxies.h"

namespace parvis::crowd {
namespace {

using people::Detail;

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

ShownPeople::ShownPeople(std::size_t people, std::uint64_t seed)
    : far_(std::make_shared<FarPeople>()), people_(people) {
  const std::size_t looks = std::min<std::size_t>(people, max_looks),
                    shapes = std::min<std::size_t>(looks, max_shapes);
  std::vector<std::optional<FarPeople::Shape>> made(shapes);
  const auto number_of = [&](std::size_t shape) { return seed * 1009u + shape; };
  const auto worn_by = [&](std::size_t look) {
    return people::colours_of(people::someone(number_of(look % shapes)), seed * 7919u + look);
  };
  parallel_for(shapes, [&](std::size_t i) {
    const people::Someone who = people::someone(number_of(i));
    people::PersonLevels levels = people::make_levels(who, people::colours_of(who, number_of(i)));
    std::vector<people::Colours> worn;
    for (std::size_t look = i; look < looks; look += shapes) worn.push_back(worn_by(look));
    people::PersonPictures pictures = people::make_pictures(levels, who, worn);
    made[i].emplace(FarPeople::Shape{who, std::move(levels), std::move(pictures)});
  });
  for (std::optional<FarPeople::Shape>& shape : made) far_->shapes.push_back(*std::move(shape));
  for (std::size_t i = 0; i < looks; ++i) {
    const people::Colours worn = worn_by(i);
    far_->looks.push_back({int(i % shapes), int(i / shapes), worn});
    Look look;
    look.shape = int(i % shapes);
    look.paint = std::make_shared<const std::vector<scene::Material>>(
        people::painted(*shape_of(look).levels.models.front(), worn));
    looks_.push_back(std::move(look));
  }
  far_->people.resize(people);
  for (std::size_t p = 0; p < people; ++p) far_->people[p].look = int(p % looks);
  for (std::size_t p = 0; p < people; ++p) people_[p].look = int(p % looks);
}

void ShownPeople::add_to(scene::Scene& scene, std::span<const std::string> names, bool is_visible) {
  is_visible_ = is_visible;
  const auto nothing = std::make_shared<const scene::Model>();
  for (std::size_t p = 0; p < people_.size(); ++p) {
    people_[p].name = names[p];
    people_[p].own_object = people_[p].object = scene.objects.size();
    scene.objects.push_back(posed_object(names[p], nothing, nullptr));
  }
  const std::size_t per_look = (people_.size() + looks_.size() - 1) / std::max<std::size_t>(looks_.size(), 1);
  for (std::size_t i = 0; i < looks_.size(); ++i)
    for (const Detail detail : {Detail::near, Detail::middle, Detail::far})
      for (std::size_t k = 0; k < std::min(max_per_look[std::size_t(detail)], per_look); ++k) {
        const FarPeople::Shape& shape = shape_of(looks_[i]);
        const bool is_one_part = detail == Detail::far;
        looks_[i].objects[std::size_t(detail)].push_back(scene.objects.size());
        if (detail != Detail::near) scene.data<scene::ShadowProxies>().add(scene.objects.size());
        scene.objects.push_back(posed_object(fmt::format("person of look {}", i + 1),
                                             shape.levels.models[std::size_t(detail)],
                                             is_one_part ? nullptr : looks_[i].paint));
        if (is_one_part)
          scene.objects.back().deformed_meshes[0].colours = people::painted_vertices(
              shape.levels.covers[std::size_t(detail)], shape.who, far_->looks[i].worn);
      }
  scene.data<SharedFarPeople>().now = far_;
}

void ShownPeople::set_visible(scene::Scene& scene, bool is_visible) {
  is_visible_ = is_visible;
  for (std::size_t p = 0; p < people_.size(); ++p) set_away(scene, p, people_[p].is_away);
}

void ShownPeople::set_away(scene::Scene& scene, std::size_t person, bool is_away) {
  ShownPerson& it = people_[person];
  it.is_away = is_away;
  scene.objects[it.object].is_visible = is_visible_ && !is_away;
  show_far(person);
}

const people::BodyField& ShownPeople::body(std::size_t person) const {
  return shape_of(looks_[std::size_t(people_[person].look)]).levels.body;
}

float ShownPeople::speed(std::size_t person, float adult_m_s) const {
  const FarPeople::Shape& shape = shape_of(looks_[std::size_t(people_[person].look)]);
  const float old =
      std::clamp((shape.who.person.age - 55.0f) / 40.0f, 0.0f, 1.0f);  // Weidmann 1993, figure 14
  return adult_m_s * std::sqrt(shape.levels.body.shape().leg() / adult_leg_m) * (1.0f - 0.35f * old);
}

void ShownPeople::place(std::size_t person, const people::Lead& lead, int picture) {
  people_[person].lead = lead, people_[person].picture = picture;
}

void ShownPeople::show_far(std::size_t person) const {
  const ShownPerson& it = people_[person];
  FarPeople::Person& far = far_->people[person];
  far.place = it.lead.place, far.heading = it.lead.heading, far.posture = it.picture;
  const bool is_here = is_visible_ && !it.is_away;
  far.is_shown = is_here && it.level == Detail::distant,
  far.casts_shadow = is_here && it.level != Detail::near;
}

void ShownPeople::show_person(scene::Scene& scene, std::size_t person, const PostureOf& posture_of) const {
  const ShownPerson& it = people_[person];
  show_far(person);
  scene::Object& object = scene.objects[it.object];
  object.name = it.name;
  object.is_visible = is_visible_ && !it.is_away;
  object.world_from_model =
      glm::rotate(glm::translate(glm::mat4(1.0f), it.lead.place), it.lead.heading, glm::vec3(0, 0, 1));
  if (object.model->parts.empty()) return;
  const std::vector<glm::mat4> pose = people::pose_of(body(person).skeleton(), posture_of(person));
  for (std::size_t p = 0; p < object.model->parts.size(); ++p)
    if (const scene::Part& part = object.model->parts[p]; part.deformation)
      scene::deform(*part.deformation, {}, pose, part.node, object.deformed_meshes[p]);
}

void ShownPeople::show(scene::Scene& scene, const PostureOf& posture_of) const {
  if (!is_visible_) {  // cameras that follow them move with them
    for (const ShownPerson& it : people_)
      scene.objects[it.object].world_from_model =
          glm::rotate(glm::translate(glm::mat4(1.0f), it.lead.place), it.lead.heading, glm::vec3(0, 0, 1));
    return;
  }
  parallel_for(
      people_.size(),
      [&](std::size_t p) {
        if (!people_[p].is_away) show_person(scene, p, posture_of);
      },
      16);
}

void ShownPeople::adapt(scene::Scene& scene, std::span<const glm::vec3> eyes, const PostureOf& posture_of) {
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
      const float reach = detail_ * reach_m[std::size_t(finer)];
      if (distance > reach * (it.level <= finer ? hysteresis : 1.0f)) continue;
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
  parallel_for(changed.size(), [&](std::size_t i) { show_person(scene, changed[i], posture_of); });
}

}  // namespace parvis::crowd
