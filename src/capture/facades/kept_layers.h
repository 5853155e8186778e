// What is finished of a place's layers, kept in its folder while they are made: a stage that was stopped, and
// every later stage, goes on from there. Files of other photographs, models or settings, and damaged ones,
// count as absent.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "base/kept_parts.h"
#include "capture/facades/place_layers.h"
#include "capture/facades/prepared_photo.h"

namespace parvis::facades {

/// Reads and writes layers/kept/ of one place: `all.found` has what takes all photographs together, and
/// NAME.filled (NAME.smooth: without proposals) what one photograph's layers were filled with.
class LayerKeeper {
 public:
  /// `key` is a hash of all that the layers are made of.
  LayerKeeper(std::filesystem::path folder, std::uint64_t key) : folder_(std::move(folder)), key_(key) {}

  /// Takes over the cut model, visibility layers and balances of a place whose uncut model, names and views
  /// are known. Returns each photograph's trust; nothing, and `place` as it was, where they are not kept.
  std::optional<std::vector<ImageF>> read_found(PlaceLayers& place) const;
  /// Keeps them. Errors name the file.
  Status keep_found(const PlaceLayers& place, std::span<const PreparedPhoto> prepared) const;

  /// The pixels with which the layers of a photograph were filled, its layers and original pixels being
  /// known.
  std::optional<Filled> read_filled(const PlaceLayers& place, std::size_t photo, bool fills) const;
  /// Keeps it. Errors name the file.
  Status keep_filled(const PlaceLayers& place, std::size_t photo, bool fills) const;

 private:
  Result<KeptParts> parts(const SealedKind& kind, std::string_view extension) const;

  std::filesystem::path folder_;
  std::uint64_t key_ = 0;
};

}  // namespace parvis::facades
