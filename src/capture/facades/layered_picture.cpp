#include "capture/facades/layered_picture.h"

#include <algorithm>
#include <cmath>

namespace parvis::facades {
namespace {

Image8 depth_picture(const std::vector<float>& depths, int width, int height) {
  float near = std::numeric_limits<float>::infinity(), far = 0.0f;
  for (const float depth : depths)
    if (std::isfinite(depth)) near = std::min(near, depth), far = std::max(far, depth);
  Image8 grey(width, height, 4, 255);
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const float range = 1.0f / near - 1.0f / far;
    const float white = !std::isfinite(depths[i]) ? 0.0f
                        : range > 0.0f            ? (1.0f / depths[i] - 1.0f / far) / range
                                                  : 1.0f;
    for (std::size_t c = 0; c < 3; ++c) grey.pixels[4 * i + c] = std::uint8_t(std::lround(255.0f * white));
  }
  return grey;
}

Image8 seen_mask(const Image8& masks) {
  Image8 seen(masks.width, masks.height, 1);
  for (std::size_t i = 0; i < seen.pixels.size(); ++i) seen.pixels[i] = masks.pixels[2 * i + 1];
  return seen;
}

Image8 with_channels(const Image8& image, int channels) {
  Image8 result(image.width, image.height, channels, 255);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < std::min(channels, image.channels); ++c) result.at(x, y)[c] = image.at(x, y)[c];
  return result;
}

/// Whether a layer's mask hides something: it is enabled, and not the one that was written, which some
/// editors enable. `masks`: of the image layer in `box`.
bool is_masked(const PsdLayer& layer, const Image8& masks, const PixelBox& box) {
  if (!layer.is_mask_enabled || layer.mask.empty()) return false;
  for (int y = 0; y < box.height; ++y)
    for (int x = 0; x < box.width; ++x)
      if (layer.box.contains(x + box.x, y + box.y) &&
          *layer.mask.at(x + box.x - layer.box.x, y + box.y - layer.box.y) != masks.at(x, y)[1])
        return true;
  return false;
}

/// The part of an edited layer that lies in `box`, with its mask where that counts, and its opacity; what the
/// editor left outside its layer is transparent.
Image8 part_in(const PsdLayer& layer, const PixelBox& box, bool uses_mask) {
  Image8 part(box.width, box.height, 4);
  for (int y = 0; y < box.height; ++y)
    for (int x = 0; x < box.width; ++x) {
      if (!layer.box.contains(x + box.x, y + box.y)) continue;
      const int from_x = x + box.x - layer.box.x, from_y = y + box.y - layer.box.y;
      std::copy_n(layer.pixels.at(from_x, from_y), 4, part.at(x, y));
      const int shown =
          uses_mask ? (*layer.mask.at(from_x, from_y) * layer.opacity + 127) / 255 : int(layer.opacity);
      std::uint8_t& alpha = part.at(x, y)[3];
      alpha = std::uint8_t((alpha * shown + 127) / 255);
    }
  return part;
}

/// Names the effects of an editor on a layer that are not read back.
std::string not_read(const PsdLayer& layer) {
  std::string what;
  if (layer.blend != "norm") what += fmt::format("its blend mode \"{}\", ", layer.blend);
  if (layer.is_clipped) what += "its clipping to the layer below, ";
  if (layer.is_in_masked_group) what += "the mask of its group, ";
  return what.substr(0, what.size() - std::min<std::size_t>(what.size(), 2));
}

/// Editors may crop a layer to what is not transparent: that still is the layer. Anything else is another
/// size or place.
bool is_cropped_only(const PsdLayer& layer, const PixelBox& box) {
  return layer.box.x >= box.x && layer.box.y >= box.y && layer.box.x + layer.box.width <= box.x + box.width &&
         layer.box.y + layer.box.height <= box.y + box.height;
}

/// Index of the image layer that a layer with an unknown name was: the only one not found yet with its box;
/// -1: none.
int renamed_from(const PsdLayer& layer, const LayeredView& layered, const std::vector<bool>& was_found) {
  int match = -1;
  for (std::size_t i = 0; i < layered.layers.size(); ++i) {
    if (was_found[i] || layered.layers[i].box != layer.box) continue;
    if (match >= 0) return -1;
    match = int(i);
  }
  return match;
}

bool is_ours(const PsdLayer& layer) {
  return layer.name == photograph_layer_name || layer.name == depth_layer_name;
}

}  // namespace

LayerPixels original_pixels(const Image8& photograph, const LayeredView& layered) {
  LayerPixels result;
  for (std::size_t i = 0; i < layered.layers.size(); ++i) {
    const PixelBox& box = layered.layers[i].box;
    Image8& pixels = result.emplace_back(box.width, box.height, 4);
    for (int y = 0; y < box.height; ++y)
      for (int x = 0; x < box.width; ++x) {
        std::copy_n(photograph.at(x + box.x, y + box.y), 3, pixels.at(x, y));
        pixels.at(x, y)[3] = layered.masks[i].at(x, y)[0];
      }
  }
  return result;
}

PsdPicture layered_picture(const Image8& photograph, const LayeredView& layered, const LayerPixels& pixels,
                           const std::vector<float>& depths) {
  PsdPicture picture;
  picture.width = photograph.width, picture.height = photograph.height;
  picture.flat = with_channels(photograph, 3);
  const PixelBox all{0, 0, photograph.width, photograph.height};
  picture.layers.push_back({photograph_layer_name, all, with_channels(photograph, 4), {}, false, false, 255});
  for (std::size_t i = layered.layers.size(); i-- > 0;)
    picture.layers.push_back({layered.layers[i].name, layered.layers[i].box, pixels[i],
                              seen_mask(layered.masks[i]), false, false, 255});
  picture.layers.push_back({depth_layer_name,
                            all,
                            depth_picture(depths, photograph.width, photograph.height),
                            {},
                            false,
                            true,
                            255});
  return picture;
}

Result<ReadLayers> read_layers(const PsdPicture& edited, const LayeredView& layered,
                               const LayerPixels& written, int width, int height, const std::string& name) {
  if (edited.width != width || edited.height != height)
    return error(
        "{}: the picture was resized to {} x {}; expected {} x {}, the photograph's size; undo the change of "
        "size in the "
        "image editor",
        name, edited.width, edited.height, width, height);
  ReadLayers result{written, std::vector<bool>(layered.layers.size(), false), {}};
  if (edited.file_bits == 16)
    result.messages.push_back(error("{}: has 16 bits per channel; its layers are rounded to 8", name));

  const auto take = [&](const PsdLayer& layer, std::size_t i) {
    result.was_found[i] = true;
    if (layer.is_hidden) {
      result.messages.push_back(
          error("{}: layer \"{}\" is hidden, or in a hidden group; it stays as it was: show it, and save",
                name, layer.name));
      return;
    }
    if (const std::string what = not_read(layer); !what.empty())
      result.messages.push_back(
          error("{}: layer \"{}\": {} is left out; merge the layer in the image editor to keep what it shows",
                name, layer.name, what));
    if (!is_cropped_only(layer, layered.layers[i].box))
      result.messages.push_back(
          error("{}: layer \"{}\" was moved or resized: {} x {} at {},{}, expected {} x {} at {},{}; what "
                "lies outside its old "
                "rectangle is left out",
                name, layer.name, layer.box.width, layer.box.height, layer.box.x, layer.box.y,
                layered.layers[i].box.width, layered.layers[i].box.height, layered.layers[i].box.x,
                layered.layers[i].box.y));
    const PixelBox& box = layered.layers[i].box;
    result.pixels[i] = part_in(layer, box, is_masked(layer, layered.masks[i], box));
  };

  std::vector<const PsdLayer*> unknown;
  for (const PsdLayer& layer : edited.layers) {
    if (is_ours(layer)) continue;
    const auto at = std::ranges::find(layered.layers, layer.name, &ImageLayer::name);
    const std::size_t i = std::size_t(at - layered.layers.begin());
    if (at == layered.layers.end())
      unknown.push_back(&layer);
    else if (result.was_found[i])
      result.messages.push_back(
          error("{}: layer \"{}\" is there twice; the lower one is taken", name, layer.name));
    else
      take(layer, i);
  }
  for (const PsdLayer* layer : unknown) {
    const int match = renamed_from(*layer, layered, result.was_found);
    if (match < 0) {
      result.messages.push_back(
          error("{}: layer \"{}\" ({} x {} at {},{}) is none of the layers that were written (new, or merged "
                "of several?); it is "
                "left out; paint on the layers that are there",
                name, layer->name, layer->box.width, layer->box.height, layer->box.x, layer->box.y));
      continue;
    }
    const std::string& old_name = layered.layers[std::size_t(match)].name;
    result.messages.push_back(
        error("{}: layer \"{}\" was renamed; by its rectangle it is \"{}\"", name, layer->name, old_name));
    take(*layer, std::size_t(match));
  }
  for (std::size_t i = 0; i < layered.layers.size(); ++i)
    if (!result.was_found[i])
      result.messages.push_back(
          error("{}: layer \"{}\" is missing (deleted, or merged into another?); it stays as it was", name,
                layered.layers[i].name));
  return result;
}

}  // namespace parvis::facades
