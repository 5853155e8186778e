// A page about a place's layers: what each photograph sees, what is proposed and from where, and memory.
#pragma once

#include <filesystem>

#include "capture/facades/packed_facade.h"

namespace parvis::facades {

/// Each pixel in the colour of its nearest layer, darkened where the photograph does not see the surface
/// (figure 3.3).
Image8 layer_map(const PlaceLayers& place, std::size_t photo);

/// Where the pixels of all layers come from: grey what the photograph sees; where anything is hidden, the
/// least certain source: blue other photographs, orange patches, red smooth, violet painted.
Image8 coverage_map(const PlaceLayers& place, std::size_t photo);

/// Writes `folder`/index.html and its pictures.
Status write_report(const std::filesystem::path& folder, const PlaceLayers& place,
                    const PackedFacade& facade);

}  // namespace parvis::facades
