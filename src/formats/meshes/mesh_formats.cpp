#include "formats/meshes/mesh_formats.h"

#include "formats/meshes/assimp_reader.h"
#include "formats/readers/content.h"
#include "formats/readers/isolated_reader.h"

namespace parvis::scene {
namespace {

bool is_text(std::string_view front) { return front.find('\0') == std::string_view::npos; }
bool is_ply(std::string_view front) { return front.starts_with("ply"); }
/// A binary one begins with any 80 bytes and a count.
bool is_stl(std::string_view front) { return front.starts_with("solid") || front.size() >= 84; }
bool is_off(std::string_view front) { return front.substr(0, 16).find("OFF") != std::string_view::npos; }
bool is_fbx(std::string_view front) {
  return front.starts_with("Kaydara FBX Binary") ||
         (is_text(front) && front.find("FBX") != std::string_view::npos);
}
bool is_3ds(std::string_view front) { return front.starts_with("MM"); }
bool is_zip(std::string_view front) { return front.starts_with("PK\x03\x04"); }
bool is_ac3d(std::string_view front) { return front.starts_with("AC3D"); }
bool is_lightwave(std::string_view front) { return front.starts_with("FORM"); }
bool is_directx(std::string_view front) { return front.starts_with("xof "); }

Result<formats::FileContent> read_mesh(const std::filesystem::path& file,
                                       const formats::ModelReading& reading, Errors& warnings) {
  return read_assimp_content(file, reading.up, warnings);
}

}  // namespace

void add_mesh_formats(formats::Readers& readers) {
  const formats::ReadModel read = formats::isolated<read_mesh>();
  readers.add({".obj"}, read, is_text);
  readers.add({".ply"}, read, is_ply);
  readers.add({".stl"}, read, is_stl);
  readers.add({".off"}, read, is_off);
  readers.add({".dae"}, read, formats::looks_like_xml);
  readers.add({".fbx"}, read, is_fbx);
  readers.add({".3ds"}, read, is_3ds);
  readers.add({".3mf"}, read, is_zip);
  readers.add({".ac"}, read, is_ac3d);
  readers.add({".lwo"}, read, is_lightwave);
  readers.add({".x"}, read, is_directx);
}

}  // namespace parvis::scene
