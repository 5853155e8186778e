#include "formats/terrain/terrain_formats.h"

#include "formats/readers/readers.h"
#include "formats/terrain/terrain.h"

namespace parvis::scene {

void furnish_terrain(House& house) {
  formats::Readers& readers = house.get<formats::Readers>();
  readers.add({".tif", ".tiff"},
              [](const std::filesystem::path& file, [[maybe_unused]] const formats::ModelReading& reading,
                 Errors& warnings) { return read_terrain(file, reading.cell_m, warnings); });
}

}  // namespace parvis::scene
