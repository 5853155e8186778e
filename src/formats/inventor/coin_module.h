// The module `coin`: what of this room knows Coin.
#pragma once

#include "base/module.h"
#include "formats/readers/readers.h"

namespace parvis::inventor {

/// The functions of the module that calls Coin.
struct CoinFunctions {
  Result<formats::FileContent> (*read)(const std::filesystem::path& file,
                                       const formats::ModelReading& reading, Errors& warnings);
};

/// Loaded in the workers' server when the first file of its formats is read.
inline constexpr Module<CoinFunctions> coin("coin");

}  // namespace parvis::inventor
