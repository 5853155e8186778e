// Generated people in a scene, at four levels of detail: who is near an eye is an object with a mesh that is
// fine enough there; who is far from all eyes is a picture (far_people.h).
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "life/crowd/far_people.h"
#include "life/people/walking_body.h"
#include "scene/data/scene.h"

namespace parvis::crowd {

/// The people of a crowd. Memory is bounded: at most `max_looks` of them differ.
class ShownPeople {
 public:
  static constexpr int max_looks = 40, max_shapes = 14;
  /// Distances from the eye up to which levels of detail are used; beyond the last one a texel of the
  /// pictures is a pixel of 1280 x 720 at 55 degrees, and meshes have more triangles than a person has
  /// pixels.
  static constexpr std::array<float, people::detail_count - 1> reach_m{4.0f, 8.0f, 19.0f};

  /// Makes the bodies of so many people; the same seed makes the same.
  ShownPeople(std::size_t people, std::uint64_t seed);

  /// The posture of a person now.
  using PostureOf = std::function<people::Posture(std::size_t person)>;

  /// Adds their objects to a scene, all of them far; `names` are those of the people. A person who is far is
  /// an object without parts, which has the person's name and place.
  void add_to(scene::Scene& scene, std::span<const std::string> names, bool is_visible);

  /// Shows or hides all of them from now on.
  void set_visible(scene::Scene& scene, bool is_visible);

  /// Hides one of them who has gone, or shows them again.
  void set_away(scene::Scene& scene, std::size_t person, bool is_away);

  /// The body of a person.
  const people::BodyField& body(std::size_t person) const;
  /// Speed at which a person of this body walks who is `relative` times as fast as an adult.
  float speed(std::size_t person, float adult_m_s) const;

  /// Where a person is now, and the picture of those of people::picture_of that shows how.
  void place(std::size_t person, const people::Lead& lead, int picture);
  /// Puts the places into the scene, at the levels that were chosen last.
  void show(scene::Scene& scene, const PostureOf& posture_of) const;
  /// Chooses levels by the distances to the eyes, and shows who has changed.
  void adapt(scene::Scene& scene, std::span<const glm::vec3> eyes, const PostureOf& posture_of);

  /// The share of their usual distances up to which people are shown at the finer levels.
  void set_detail(float share) { detail_ = share; }

  std::size_t size() const { return people_.size(); }
  /// The level of detail at which a person is shown.
  people::Detail level(std::size_t person) const { return people_[person].level; }

 private:
  /// A shape in colours, with the objects that show whoever of that look is near.
  struct Look {
    int shape = 0;
    std::shared_ptr<const std::vector<scene::Material>> paint;           ///< of near and middle
    std::array<std::vector<std::size_t>, people::detail_count> objects;  ///< of the scene, by level
  };
  struct ShownPerson {
    int look = 0;
    std::size_t own_object = 0,
                object = 0;  ///< own: without parts; object: the one that shows the person now
    people::Detail level = people::Detail::distant;
    people::Lead lead;
    int picture = people::walking_pictures;
    std::string name;
    bool is_away = false;
  };

  void show_person(scene::Scene& scene, std::size_t person, const PostureOf& posture_of) const;
  void show_far(std::size_t person) const;
  const FarPeople::Shape& shape_of(const Look& look) const { return far_->shapes[std::size_t(look.shape)]; }

  std::shared_ptr<FarPeople> far_;
  std::vector<Look> looks_;
  std::vector<ShownPerson> people_;
  bool is_visible_ = true;
  float detail_ = 1.0f;  ///< see set_detail
};

}  // namespace parvis::crowd
