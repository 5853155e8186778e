#include "capture/facades/held_out.h"

#include <algorithm>
#include <cmath>

#include "base/colour.h"
#include "capture/facades/baselines.h"

namespace parvis::facades {

namespace {

/// 0 where the layers do not count a pixel of the model as seen.
ImageF trust_of(const LayeredView& layered, const PreparedPhoto& photo) {
  ImageF trust(photo.view.width, photo.view.height, 1);
  for (std::size_t i = 0; i < trust.pixels.size(); ++i) trust.pixels[i] = !std::isfinite(photo.depths[i]);
  for (std::size_t l = 0; l < layered.layers.size(); ++l) {
    const PixelBox& box = layered.layers[l].box;
    for (int y = 0; y < box.height; ++y)
      for (int x = 0; x < box.width; ++x)
        if (layered.masks[l].at(x, y)[1]) *trust.at(x + box.x, y + box.y) = 1.0f;
  }
  return trust;
}

}  // namespace

Image8 model_mask(const LayerModel& model, const View& view) {
  const ItemBuffer seen = item_buffer(model, view);
  Image8 mask(view.width, view.height, 1);
  for (std::size_t i = 0; i < mask.pixels.size(); ++i)
    mask.pixels[i] = seen.triangles[i] == no_triangle_seen ? 0 : 255;
  return mask;
}

Image8 rgba8_of(const ImageF& srgb) {
  Image8 bytes(srgb.width, srgb.height, 4);
  for (std::size_t i = 0; i < bytes.pixels.size(); ++i)
    bytes.pixels[i] = std::uint8_t(std::lround(255.0f * std::clamp(srgb.pixels[i], 0.0f, 1.0f)));
  return bytes;
}

std::vector<PreparedPhoto> prepared_as_layers(const std::vector<photographs::Photograph>& used,
                                              const PlaceLayers& place) {
  std::vector<PreparedPhoto> prepared;
  for (std::size_t i = 0; i < place.names.size(); ++i) {
    const auto photo = std::ranges::find(used, place.names[i], &photographs::Photograph::name);
    Result<PreparedPhoto> one = prepared_photo(*photo, place.model);
    if (!one) continue;
    apply(place.balances[i], *one);
    one->trust = trust_of(place.layered[i], *one);
    prepared.push_back(*std::move(one));
  }
  return prepared;
}

Image8 coloured_by_layers(Image8 shown, const std::vector<ColourSource>& sources) {
  for (std::size_t p = 0; p < sources.size(); ++p)
    if (sources[p] != ColourSource::layers) shown.pixels[4 * p + 3] = 0;
  return shown;
}

std::vector<MethodView> views_of_methods(const PlaceLayers& place, const PackedFacade& facade,
                                         const std::vector<PreparedPhoto>& prepared, const View& view) {
  DrawnFacade drawn(facade);
  ShownColours colours(facade);
  std::vector<MethodView> views{
      {"layers", coloured_by_layers(rgba8_of(drawn.view(view)), colours.sources(view))}};
  for (const BaselineMethod method : baseline_methods)
    views.push_back({name_of(method), srgb8_from_linear(baseline_view(method, place.model, view, prepared))});
  return views;
}

}  // namespace parvis::facades
