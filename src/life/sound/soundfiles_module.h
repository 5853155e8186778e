// The module `soundfiles`: what of this room knows libsndfile and libebur128.
#pragma once

#include <string_view>

#include "base/module.h"
#include "life/sound/recording.h"

namespace parvis::sound {

/// The functions of the module.
struct SoundFileFunctions {
  /// Decodes a file's bytes, resamples them and measures their loudness; errors begin with `name`.
  Result<Recording> (*decode)(std::string_view bytes, const std::string& name);
};

/// Loaded in the workers' server when the first sound file is read.
inline constexpr Module<SoundFileFunctions> sound_files("soundfiles");

}  // namespace parvis::sound
