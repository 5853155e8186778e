// What an artist painted on the layers of a photograph, kept apart from the layers: when the model or the
// cameras change, layers are rebuilt and the edits applied again where they still belong.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "capture/facades/layered_picture.h"

namespace parvis::facades {

/// A pixel of the photograph on a surface, as it was painted. Pixels of the photograph stay where they are
/// when its camera is calibrated again; which layer they are in is decided by the surface.
struct EditedPixel {
  std::int32_t x = 0, y = 0;
  float depth = 0.0f;  ///< of the surface when it was painted
  std::array<std::uint8_t, 4> rgba{};
};

/// Edits of one object of the model in one photograph.
struct ObjectEdits {
  std::string object;
  std::string layer;  ///< that it was painted on, for messages
  std::vector<EditedPixel> pixels;
};
using LayerEdits = std::vector<ObjectEdits>;

/// Layers of a photograph with the model they were made of.
struct LayersOfModel {
  const LayerModel& model;
  const View& view;
  const VisibilityLayers& visibility;
  const LayeredView& layered;
};

/// The pixels that differ between `before` and `after`, by object. Colour below full transparency is no edit.
LayerEdits edits_of(const LayersOfModel& layers, const LayerPixels& before, const LayerPixels& after);

/// A surface is the one that was painted if it is of the same object and its depth differs by less than this
/// part.
inline constexpr float same_surface_tolerance = 0.05f;

/// The outcome of painting edits on rebuilt layers.
struct AppliedEdits {
  std::size_t applied = 0;  ///< pixels
  LayerEdits unplaced;      ///< what no longer has a surface: never dropped, to be kept with the edits
  Errors messages;          ///< an entry per object and layer with unplaced pixels: how many, where, why
};

/// Paints `edits` on the layers of a changed model or camera.
AppliedEdits apply(const LayerEdits& edits, const LayersOfModel& layers, const std::string& photograph,
                   LayerPixels& pixels);

/// `later` painted over `earlier`.
LayerEdits joined(const LayerEdits& earlier, const LayerEdits& later);

/// Writes edits as a file, whole or not at all.
Status write_edits(const std::filesystem::path& file, const LayerEdits& edits);
/// Reads what write_edits has written; errors name the file.
Result<LayerEdits> read_edits(const std::filesystem::path& file);

}  // namespace parvis::facades
