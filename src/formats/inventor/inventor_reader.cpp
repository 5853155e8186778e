#include "formats/inventor/inventor_reader.h"

#include "formats/inventor/coin_module.h"

namespace parvis::inventor {

Result<formats::FileContent> read_inventor(const std::filesystem::path& file,
                                           const formats::ModelReading& reading, Errors& warnings) {
  return coin.call(&CoinFunctions::read, file, reading, warnings);
}

}  // namespace parvis::inventor
