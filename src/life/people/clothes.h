// What people wear and carry, as surfaces over the body: each garment is a field of its own, so that it hangs
// over what is below it, with folds at joints and a hem; openings are cut out of it.
#pragma once

#include <vector>

#include "base/image.h"
#include "life/people/body_field.h"

namespace parvis::people {

enum class Top : std::uint8_t { t_shirt, blouse, pullover, jacket, coat };
enum class Bottom : std::uint8_t { trousers, jeans, shorts, skirt, dress };
enum class Bag : std::uint8_t { none, backpack, shoulder_bag };
enum class Hat : std::uint8_t { none, cap, woollen };

/// The clothes that somebody wears.
struct Outfit {
  Top top = Top::pullover;
  Bottom bottom = Bottom::trousers;
  Bag bag = Bag::none;
  Hat hat = Hat::none;
};

/// Materials of a person's model, in this order.
enum Surface : std::uint8_t {
  face_skin,
  skin,
  hair,
  top_cloth,
  shirt,
  bottom_cloth,
  shoe,
  accessory,
  surface_count
};

/// A mesh, its material, and the bones that move it.
struct Garment {
  const char* name;
  Mesh mesh;  ///< with colours: shade in folds
  Surface surface = top_cloth;
  Moves moves = Moves::top;
};

/// Yarns of cloth in shades of white, a tile of 10 cm, sRGB.
Image8 cloth_texture(int size);

/// Everything but the head; cells are about `detail` times those of a near view.
std::vector<Garment> dressed(const BodyField& body, const Outfit& outfit, float detail);

}  // namespace parvis::people
