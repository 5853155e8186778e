// How much of a scene a picture shows: one scale from a sketch to a photograph.
#pragma once

#include "base/content_hash.h"
#include "scene/data/room_data.h"

namespace parvis::scene {

/// The scene's place on that scale.
struct Realism {
  static constexpr std::string_view name = "data.realism";
  static constexpr DataRole role = DataRole::settings;

  /// 0: edges and washes on paper; 1/4: a white model; 1/2: plain colours; 3/4: materials without gloss;
  /// 1: everything. Between two of them a picture goes over from one to the other.
  float level = 1.0f;

  bool operator==(const Realism&) const = default;
  /// Adds all of it.
  void hash(ContentHash& hash) const { hash.add(level); }
};

}  // namespace parvis::scene
