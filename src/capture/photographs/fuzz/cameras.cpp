// Any bytes as cameras in each format, and as a picture's header: cameras and sizes, or errors.
#include "capture/photographs/camera_files.h"
#include "capture/photographs/picture_header.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace parvis::photographs;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  (void)parse_viewpoints(text, "");
  (void)parse_gltf_cameras(text, "");
  (void)parse_thesis_cameras(text, "");
  (void)parse_camera_json(text, "");
  (void)parse_strecha_camera(text, "");
  (void)parse_picture_header(text, "");
  (void)is_whole_jpeg(text);
  return 0;
}
