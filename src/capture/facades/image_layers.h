// Image layers: the parts of a photograph, with their bounding boxes, that become layers of an image editor
// and projective textures (thesis 3.4.2 and 3.6.1).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/image.h"
#include "capture/facades/visibility_layers.h"

namespace parvis::facades {

/// A box of a photograph, in whole pixels from its top left.
struct PixelBox {
  int x = 0, y = 0, width = 0, height = 0;

  bool operator==(const PixelBox&) const = default;
  bool empty() const { return width <= 0 || height <= 0; }
  bool contains(int px, int py) const { return px >= x && py >= y && px < x + width && py < y + height; }
};
/// The smallest box around both; an empty box adds nothing.
PixelBox united(const PixelBox& a, const PixelBox& b);

/// One picture layer of a photograph: items of one visibility layer (section 3.4.2).
struct ImageLayer {
  std::string name;              ///< unique in its photograph, the same in every run: "L02-005 facade north"
  PixelBox box;                  ///< around all pixels that its items cover, hidden ones too
  std::uint32_t visibility = 0;  ///< visibility layer, 0 in front
  std::vector<std::uint32_t> items;  ///< of VisibilityLayers, ascending
};

/// A photograph in layers.
struct LayeredView {
  std::vector<ImageLayer> layers;  ///< front to back
  std::vector<std::uint32_t> layer_of_item;
  std::vector<Image8> masks;  ///< per layer, of its box, 2 channels: 255 where an item covers the pixel's
                              ///< centre; 255 where, too, the photograph sees it
};

/// Side of the smallest power-of-two texture that holds n pixels, n >= 1.
int power_of_two_side(int n);
/// A of equation 3.1: texels of the smallest texture with power-of-two sides, none less than `min_side`, that
/// holds the box.
std::int64_t texture_area(const PixelBox& box, int min_side);

/// Greedy clustering: merges the pair with A12 < A1 + A2 (equation 3.1) that saves most, until no pair saves
/// anything. Returns the groups, each ascending.
std::vector<std::vector<std::uint32_t>> merged_boxes(const std::vector<PixelBox>& boxes, int min_side);

/// Sides below which a texture is not counted smaller: tiny layers cost more in borders than they save, and
/// nobody edits them. A scanned mesh of 15,000 triangles then gives about as many layers per photograph (190)
/// as the thesis has (98 to 160).
inline constexpr int min_layer_side = 128;

/// Projects the items and merges them within each visibility layer.
LayeredView image_layers(const LayerModel& model, const View& view, const VisibilityLayers& visibility,
                         int min_side = min_layer_side);

/// Takes what hides the model in a photograph, and is no part of it (trust below one half), for not seen: it
/// is to be filled. `trust` has one value for each pixel of the photograph.
void distrust(const ImageF& trust, LayeredView& layered);

/// Left, right, bottom and top of a frustum at z = 1, as glFrustum takes them at its near plane.
struct Frustum {
  double x_min, x_max, y_min, y_max;
};
/// The frustum of a whole picture whose view may have its principal point anywhere.
Frustum frustum_of(const View& view);
/// The sheared frustum of a box of a picture (figure 3.12), for boxes counted from the picture's top. The
/// rows for y use h and h_i; the thesis prints w and w_i there, which is a slip: a layer lower than wide
/// would reach outside its box.
Frustum sheared(const Frustum& frustum, const PixelBox& box, int width, int height);

/// Projective texture matrix of a layer: (s q, t q, depth, q) of (x, y, z, 1) in world, with s and t in [0,
/// 1] from the box's top left and q = depth. The same mapping as the sheared frustum's.
glm::dmat4 texture_from_world(const View& view, const PixelBox& box);

}  // namespace parvis::facades
