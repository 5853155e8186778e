// People as skinned models: a body of an age, sex and build, its face and hair, its clothes.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "life/people/clothes.h"
#include "life/people/gait.h"
#include "life/people/head.h"

namespace parvis::people {

/// All that makes somebody.
struct Someone {
  Person person;
  HeadLook head;
  Outfit outfit;
};

/// How finely a person is modelled.
enum class Detail : std::uint8_t {
  near,    ///< 10,000 vertices: bears a look from two metres
  middle,  ///< a fourth
  far,     ///< a tenth, one mesh
  distant  ///< 180 vertices at most, one mesh
};
inline constexpr int detail_count = 4;

/// Colours of what somebody wears, linear.
struct Colours {
  glm::vec3 top{0.2f}, shirt{0.7f}, bottom{0.06f}, shoes{0.03f}, accessory{0.1f};
};

/// Somebody by a number: the same number gives the same person.
Someone someone(std::uint64_t number);
/// The same, of a given sex and age.
Someone someone(std::uint64_t number, Sex sex, float age);
/// Colours by a number, as `someone` may wear them.
Colours colours_of(const Someone& who, std::uint64_t number);

/// A person's model: x forward, feet at z = 0; a node for each bone (skeleton.h). Animations: "walk" on the
/// spot, "stand", "wait", "talk", "phone", "sit".
struct PersonMesh {
  BodyField body;
  std::shared_ptr<const scene::Model> model;
};
/// Makes a person; `speed_m_s` is that of the animation "walk". Whose hands hold a handle keeps them there in
/// all animations.
PersonMesh make_person(const Someone& who, const Colours& colours, float speed_m_s = 1.3f,
                       bool holds_handle = false);

/// Somebody at every level of detail. Models of the levels `far` and `distant` have one part and one
/// material: what somebody wears is in the colours of their vertices.
struct PersonLevels {
  BodyField body;
  std::array<std::shared_ptr<const scene::Model>, detail_count> models;
  /// The surfaces and shades that the vertices of a model of one part show.
  struct Cover {
    std::vector<Surface> surfaces;  ///< of each vertex
    std::vector<glm::vec4> shades;  ///< of folds; of the face, its colour
  };
  std::array<Cover, detail_count> covers;
};
/// Makes somebody at every level, without animations; models of one part are in these colours.
PersonLevels make_levels(const Someone& who, const Colours& colours);
/// Colours of the vertices of a model of one part.
std::vector<glm::vec4> painted_vertices(const PersonLevels::Cover& cover, const Someone& who,
                                        const Colours& colours);

/// The materials of a model in other colours.
std::vector<scene::Material> painted(const scene::Model& model, const Colours& colours);

}  // namespace parvis::people
