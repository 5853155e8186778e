// Heads: a distance field of skull, face and ears, cast onto a grid of directions that is dense in the face,
// so that a texture lies on it; hair as a second surface over it.
//
// Measures are fractions of the height of the head, from chin to vertex; breadth, length and the places of
// eyes, nose and mouth follow the canon of drawing: eyes at half of the height, eyes one eye apart, the mouth
// a third of the way from nose to chin.
#pragma once

#include "life/people/body_field.h"
#include "scene/data/model.h"

namespace parvis::people {

/// How hair is worn.
enum class HairStyle : std::uint8_t { bald, cropped, parted, bob, long_hair, bun, pony_tail };

/// The traits by which faces differ.
struct HeadLook {
  glm::vec3 skin{0.6f, 0.4f, 0.3f};  ///< linear
  glm::vec3 hair{0.05f, 0.03f, 0.02f};
  glm::vec3 iris{0.12f, 0.07f, 0.04f};
  HairStyle style = HairStyle::parted;
  float beard = 0.0f;  ///< 0: shaven, 1: full
  float age = 35.0f;
  bool is_female = false;
  bool has_make_up = false;
  float nose = 0.0f, jaw = 0.0f, cheeks = 0.0f, lips = 0.0f, eyes = 0.0f;  ///< -1..1: small to large
};

/// A head in the bind pose.
class HeadField {
 public:
  HeadField(const BodyField& body, const HeadLook& look);

  /// Model space from fractions of the head: origin below the ears at the height of the chin.
  glm::vec3 in_model(glm::vec3 p) const { return origin_ + size_m_ * p; }
  float size_m() const { return size_m_; }  ///< from chin to vertex

  float face(glm::vec3 p) const;   ///< skin, with ears and neck; p in fractions of the head
  float skull(glm::vec3 p) const;  ///< the same without ears, nose and lips
  float hair(glm::vec3 p) const;   ///< outer surface of the hair, inside the skin where there is none
  /// Negative where hair grows.
  float hairline(glm::vec3 p) const;

 private:
  float front(glm::vec3 p, float d) const;
  float nose_and_lips(glm::vec3 p, float d) const;

  HeadLook look_;
  glm::vec3 origin_;
  float size_m_;
};

/// The skin of head and neck with texture coordinates, `columns` x `rows` cells.
Mesh head_mesh(const HeadField& field, int columns, int rows);
/// Its texture: eyes, brows, lips, cheeks, beard.
Image8 face_texture(const HeadField& field, const HeadLook& look, int size);
/// Hair; empty for the bald.
Mesh hair_mesh(const HeadField& field, const HeadLook& look, int columns, int rows);
/// Strands, as a multiplier of the hair's colour.
Image8 strand_texture(int size);
/// The normals of the same strands.
Image8 strand_normals(int size);

}  // namespace parvis::people
