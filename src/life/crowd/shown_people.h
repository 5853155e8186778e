// Generated people as objects of a scene, at four levels of detail: who is near an eye is shown in full, who
// is far by a mesh whose edges are a few pixels long there.
#pragma once

#include <span>
#include <vector>

#include "life/people/person_model.h"
#include "life/people/walking_body.h"
#include "scene/data/scene.h"

namespace parvis::crowd {

/// The people of a crowd. Memory is bounded: at most `max_looks` of them differ.
class ShownPeople {
 public:
  static constexpr int max_looks = 40, max_shapes = 14;

  /// Makes the bodies of so many people; the same seed makes the same.
  ShownPeople(std::size_t people, std::uint64_t seed);

  /// Adds their objects to a scene, all of them distant; `names` are those of the people.
  void add_to(scene::Scene& scene, std::span<const std::string> names, bool is_visible);

  /// Shows or hides all of them from now on.
  void set_visible(scene::Scene& scene, bool is_visible);

  /// Hides one of them who has gone, or shows them again.
  void set_away(scene::Scene& scene, std::size_t person, bool is_away);

  /// The body of a person.
  const people::BodyField& body(std::size_t person) const;
  /// Speed at which a person of this body walks who is `relative` times as fast as an adult.
  float speed(std::size_t person, float adult_m_s) const;

  /// Where a person is now and how.
  void place(std::size_t person, const people::Lead& lead, const people::Posture& posture);
  /// Puts the places into the scene, at the levels that were chosen last.
  void show(scene::Scene& scene) const;
  /// Chooses levels by the distances to the eyes, and shows who has changed.
  void adapt(scene::Scene& scene, std::span<const glm::vec3> eyes);

  std::size_t size() const { return people_.size(); }
  /// The level of detail at which a person is shown.
  people::Detail level(std::size_t person) const { return people_[person].level; }

 private:
  /// Somebody at all levels; people of one shape share the meshes.
  struct Shape {
    people::Someone who;
    people::PersonLevels levels;
  };
  /// A shape in colours, with the objects that show whoever of that look is near.
  struct Look {
    int shape = 0;
    people::Colours colours;
    std::shared_ptr<const std::vector<scene::Material>> paint;           ///< of near and middle
    std::array<std::vector<std::size_t>, people::detail_count> objects;  ///< of the scene, but distant ones
  };
  struct ShownPerson {
    int look = 0;
    std::size_t own_object = 0, object = 0;  ///< own: distant; object: the one that shows the person now
    people::Detail level = people::Detail::distant;
    people::Lead lead;
    people::Posture posture;
    std::string name;
    bool is_away = false;
  };

  void show_person(scene::Scene& scene, std::size_t person) const;
  const Shape& shape_of(const Look& look) const { return shapes_[std::size_t(look.shape)]; }

  std::vector<Shape> shapes_;
  std::vector<Look> looks_;
  std::vector<ShownPerson> people_;
  bool is_visible_ = true;
};

}  // namespace parvis::crowd
