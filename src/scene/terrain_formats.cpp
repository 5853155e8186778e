#include "scene/terrain_formats.h"

#include "scene/readers.h"
#include "scene/terrain.h"

namespace parvis::scene {

void furnish_terrain(House& house) {
  formats::Readers& readers = house.get<formats::Readers>();
  readers.add({".tif", ".tiff"},
              [](const std::filesystem::path& file, [[maybe_unused]] const formats::ModelReading& reading,
                 Errors& warnings) { return read_terrain(file, reading.cell_m, warnings); });
}

}  // namespace parvis::scene
