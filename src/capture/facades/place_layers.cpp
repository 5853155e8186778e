#include "capture/facades/place_layers.h"

#include <algorithm>
#include <cmath>

#include "base/colour.h"
#include "capture/facades/kept_layers.h"
#include "capture/facades/moved_shadows.h"

namespace parvis::facades {
namespace {

Image8 srgb_of(const ImageF& colours) {
  ImageF rgba(colours.width, colours.height, 4, 1.0f);
  for (std::size_t i = 0; i < colours.pixels.size(); ++i) rgba.pixels[i / 3 * 4 + i % 3] = colours.pixels[i];
  return srgb8_from_linear(rgba);
}

/// Takes the shadows out of the photographs that are blended and filled from, and out of the layers' pixels.
void flatten_shadows(std::vector<PreparedPhoto>& prepared, PlaceLayers& place) {
  const std::vector<ImageF> gains = shadow_gains(prepared);
  for (std::size_t i = 0; i < prepared.size(); ++i) {
    apply_gains(gains[i], prepared[i].colours);
    for (std::size_t l = 0; l < place.layered[i].layers.size(); ++l) {
      const PixelBox& box = place.layered[i].layers[l].box;
      Image8& pixels = place.originals[i][l];
      for (int y = 0; y < box.height; ++y)
        for (int x = 0; x < box.width; ++x) {
          const float gain = *gains[i].at(x + box.x, y + box.y);
          for (int c = 0; c < 3; ++c) {
            std::uint8_t& value = pixels.at(x, y)[c];
            value = std::uint8_t(std::lround(
                255.0f * srgb_from_linear(std::min(gain * linear_from_srgb(float(value) / 255.0f), 1.0f))));
          }
        }
    }
  }
}

void note(const Status& status, Errors& warnings) {
  if (!status) warnings.insert(warnings.end(), status.errors().begin(), status.errors().end());
}

/// Image layers and the photographs' own pixels in them.
void add_image_layers(std::span<const PreparedPhoto> prepared, PlaceLayers& place, Progress& progress) {
  for (std::size_t i = 0; i < prepared.size(); ++i) {
    const Errors& warnings = place.visibility[i].warnings;
    place.warnings.insert(place.warnings.end(), warnings.begin(), warnings.end());
    place.layered.push_back(image_layers(place.model, place.views[i], place.visibility[i]));
    place.originals.push_back(original_pixels(srgb_of(prepared[i].colours), place.layered[i]));
    progress.advance();
  }
}

/// Fills the layers of each photograph, unless that is kept.
void fill_layers(std::span<const PreparedPhoto> prepared, bool fills, const LayerKeeper* keeper,
                 PlaceLayers& place) {
  Progress progress("filling layers", prepared.size());
  for (std::size_t i = 0; i < prepared.size(); ++i) {
    std::optional<Filled> kept = keeper ? keeper->read_filled(place, i, fills) : std::nullopt;
    const bool is_kept = kept.has_value();
    const FillSettings fill{fills, fills, 1};
    place.filled.push_back(is_kept ? *std::move(kept)
                                   : filled_layers(place.layers(i), prepared, i, place.originals[i], fill));
    if (keeper && !is_kept) note(keeper->keep_filled(place, i, fills), place.warnings);
    progress.advance();
  }
}

}  // namespace

Result<PlaceLayers> place_layers(const std::vector<photographs::Photograph>& photos,
                                 const std::vector<NamedMesh>& meshes, const PlaceSettings& settings,
                                 const LayerKeeper* keeper) {
  Result<LayerModelResult> model = layer_model(meshes);
  if (!model) return model.errors();
  PlaceLayers place;
  place.model = std::move(model->model), place.warnings = std::move(model->warnings);

  std::vector<PreparedPhoto> prepared;
  std::optional<Progress> progress(std::in_place, "making layers", 2 * photos.size());
  for (const photographs::Photograph& photo : photos) {
    Result<PreparedPhoto> one = prepared_photo(photo, place.model);
    progress->advance();
    if (!one) {
      place.warnings.insert(place.warnings.end(), one.errors().begin(), one.errors().end());
      continue;
    }
    place.names.push_back(one->name), place.views.push_back(one->view);
    prepared.push_back(*std::move(one));
  }
  if (prepared.empty()) {
    place.warnings.push_back(
        error("there is no photograph to make layers of; expected at least one with its camera"));
    return place.warnings;
  }

  const std::optional<std::vector<ImageF>> kept_trust = keeper ? keeper->read_found(place) : std::nullopt;
  if (!kept_trust) place.visibility = visibility_layers(place.model, place.views, place.names);
  add_image_layers(prepared, place, *progress);
  if (std::ranges::all_of(place.visibility,
                          [](const VisibilityLayers& seen) { return seen.items.empty(); })) {
    place.warnings.push_back(
        error("no photograph sees anything of the model; give one in the frame of the cameras"));
    return place.warnings;
  }
  progress.reset();  // the next steps have bars of their own

  if (!kept_trust)
    place.balances = settings.balances_colours ? balances(prepared) : std::vector<Balance>(prepared.size());
  for (std::size_t i = 0; i < prepared.size(); ++i) apply(place.balances[i], prepared[i]);
  if (settings.flattens_shadows && settings.balances_colours) flatten_shadows(prepared, place);
  if (kept_trust)
    for (std::size_t i = 0; i < prepared.size(); ++i) prepared[i].trust = (*kept_trust)[i];
  else if (settings.finds_occluders)
    find_occluders(prepared);
  if (keeper && !kept_trust) note(keeper->keep_found(place, prepared), place.warnings);
  for (std::size_t i = 0; i < prepared.size(); ++i)
    if (!prepared[i].trust.empty()) distrust(prepared[i].trust, place.layered[i]);
  fill_layers(prepared, settings.fills, keeper, place);
  place.surfaces.assign(place.model.objects.size(), Filling::proposal);
  return place;
}

}  // namespace parvis::facades
