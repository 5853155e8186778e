// Models of Open Inventor 2 and VRML 1 and 2 (ISO/IEC 14772-1), read by Coin.
#pragma once

#include "formats/readers/readers.h"

namespace parvis::inventor {

/// Larger files are refused: as text, 256 MB hold some millions of triangles.
inline constexpr std::uint64_t max_bytes = std::uint64_t{256} << 20;
/// Nodes inside of nodes: Coin reads and walks them by recursion.
inline constexpr int max_nesting = 256;

/// Shapes of one name and material become one part; a shape without a name has that of the nearest node
/// around it that has one. Pictures lie below the file's folder. Refused with line and reason: what is no
/// text, nested too deep, or not understood by Coin. To be called in a worker (isolated_reader.h): Coin may
/// crash on damaged files.
Result<formats::FileContent> read_inventor(const std::filesystem::path& file,
                                           const formats::ModelReading& reading, Errors& warnings);

}  // namespace parvis::inventor
