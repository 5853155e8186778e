#include "formats/gltf/gltf_formats.h"

#include "formats/gltf/gltf_reader.h"
#include "formats/readers/readers.h"

namespace parvis::scene {

void furnish_gltf(House& house) {
  formats::Readers& readers = house.get<formats::Readers>();
  readers.add({".glb", ".gltf"},
              [](const std::filesystem::path& file, [[maybe_unused]] const formats::ModelReading& reading,
                 Errors& warnings) { return read_gltf(file, warnings); });
}

}  // namespace parvis::scene
