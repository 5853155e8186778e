// Whether a packed place is still what its sources make: so that a walk that is asked for twice is made once.
#pragma once

#include "capture/facades/place_folder.h"

namespace parvis::facades {

/// Whether place.facade and place.xp are there, made of this source as it is now: model, cameras,
/// photographs, masks, decisions about proposals, layered pictures (an artist's edits), and settings.
bool is_packed(const PlaceSource& source, const PlaceSettings& settings);

/// A hash of all that the place's layers are made of, edits and decisions aside: model, cameras, the content
/// of photographs and masks, and settings; whether they are filled with proposals does not count.
std::uint64_t layers_key(const PlaceSource& source, const PlaceSettings& settings);

/// Keeps what the packed place was made of in the folder's packed.txt.
Status remember_packed(const PlaceSource& source, const PlaceSettings& settings);

}  // namespace parvis::facades
