// People who are far from all eyes: shown as pictures of their meshes (life/people/person_pictures.h), and
// traced as those meshes.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "base/content_hash.h"
#include "graphics/render/drawables.h"
#include "life/people/person_pictures.h"
#include "scene/data/room_data.h"

namespace parvis::crowd {

/// All people of a crowd as they are when they are far. Those who are nearer are hidden here and objects of
/// the scene; the pictures still cast the shadows of all but the nearest, whose meshes do
/// (scene::ShadowProxies).
struct FarPeople {
  /// Somebody at all levels, with pictures in the colours of all looks of this shape.
  struct Shape {
    people::Someone who;
    people::PersonLevels levels;
    people::PersonPictures pictures;
  };
  /// A shape in colours.
  struct Look {
    int shape = 0;
    int colours = 0;  ///< index into the shape's `pictures.colours`
    people::Colours worn;
  };
  /// One person now.
  struct Person {
    int look = 0;
    glm::vec3 place{0.0f};  ///< on the ground, world, metres
    float heading = 0.0f;   ///< radians, counter-clockwise from +x
    int posture = people::walking_pictures;
    bool is_shown = false, casts_shadow = false;
  };
  std::vector<Shape> shapes;
  std::vector<Look> looks;
  std::vector<Person> people;

  const Shape& shape_of(const Person& person) const {
    return shapes[std::size_t(looks[std::size_t(person.look)].shape)];
  }
};

/// The FarPeople of a running scene; null where it has no generated crowd.
struct SharedFarPeople {
  static constexpr std::string_view name = "crowd.far_people";
  static constexpr scene::DataRole role = scene::DataRole::settings;  // they follow from the crowd that moves
  std::shared_ptr<FarPeople> now;

  /// Adds nothing: the state of a moment; see SceneData.
  void hash(ContentHash&) const {}
};

/// Draws and traces them; thing n is person n.
render::DrawableKind far_people_kind();

}  // namespace parvis::crowd
