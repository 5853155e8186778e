#include "capture/photographs/camera_files.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <optional>
#include <unordered_map>

#include "base/files.h"
#include "base/image_io.h"
#include "capture/photographs/picture.h"
#include "capture/photographs/picture_header.h"

namespace parvis::photographs {
namespace {
namespace fs = std::filesystem;

/// The pictures of a folder by what cameras call them: their name, their file's name, or that without
/// extension.
class PictureNames {
 public:
  explicit PictureNames(const fs::path& folder) {
    for (const std::string& picture : picture_names(folder)) {
      const fs::path path(picture);
      add(whole_, picture, picture);
      add(by_file_name_, path.filename().string(), picture);
      add(by_stem_, path.stem().string(), picture);
    }
  }

  /// The one picture that `name` means, or nothing.
  std::optional<std::string> find(const std::string& name) const {
    const fs::path wanted(name);
    if (const auto found = whole_.find(name); found != whole_.end()) return found->second;
    if (const auto found = by_file_name_.find(wanted.filename().string()); found != by_file_name_.end())
      return found->second;
    const auto found = by_stem_.find(wanted.stem().string());
    return found == by_stem_.end() ? std::nullopt : found->second;
  }

 private:
  using Pictures = std::unordered_map<std::string, std::optional<std::string>>;  ///< none: several

  static void add(Pictures& pictures, const std::string& key, const std::string& picture) {
    const auto [found, is_new] = pictures.try_emplace(key, picture);
    if (!is_new) found->second.reset();
  }

  Pictures whole_, by_file_name_, by_stem_;
};

/// Renames photographs to their pictures and puts them in order. Those without one keep their name:
/// `fit_to_files` names them.
void match_to_pictures(LoadedSet& loaded, const PictureNames& pictures, const fs::path& folder) {
  std::vector<Photograph>& photographs = loaded.set.photographs;
  for (Photograph& photograph : photographs) {
    photograph.name = pictures.find(photograph.name).value_or(photograph.name);
    photograph.file = folder / photograph.name;
  }
  std::vector<int> order(photographs.size()), new_index(photographs.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](int i) { return photographs[std::size_t(i)].name; });
  std::vector<Photograph> sorted;
  for (const int i : order) {
    new_index[std::size_t(i)] = int(sorted.size());
    sorted.push_back(std::move(photographs[std::size_t(i)]));
  }
  photographs = std::move(sorted);
  for (SparsePoint& point : loaded.set.points)
    for (Observation& observation : point.observations)
      observation.photograph = new_index[std::size_t(observation.photograph)];
}

/// A view with the size of its picture.
Result<Photograph> photograph_of_view(const ViewOfPicture& view, const PictureNames& pictures,
                                      const fs::path& folder) {
  const std::optional<std::string> name = pictures.find(view.name);
  if (!name) return error("{}: there is a camera but no picture of this name", view.name);
  const Result<PictureHeader> info = read_picture_header(folder / *name);
  if (!info) return info.errors();
  if (!(view.fov > 0.0) || !(view.fov < glm::radians(179.0)))
    return error("{}: its camera has a field of view of {} radians", view.name, view.fov);
  const bool across_width =
      view.across == ViewOfPicture::Across::width ||
      (view.across == ViewOfPicture::Across::smaller_side && info->width < info->height);
  const double focal = 0.5 * (across_width ? info->width : info->height) / std::tan(0.5 * view.fov);
  Photograph photograph;
  photograph.name = *name;
  photograph.file = folder / *name;
  photograph.lens =
      pinhole_lens(info->width, info->height, focal, focal, 0.5 * info->width, 0.5 * info->height);
  photograph.world_from_camera = view.world_from_camera;
  return photograph;
}

Result<LoadedSet> set_of_views(const Result<std::vector<ViewOfPicture>>& views, const PictureNames& pictures,
                               const fs::path& folder, const fs::path& source) {
  if (!views) return views.errors();
  if (views->empty()) return error("{}: holds no perspective camera", source.string());
  LoadedSet loaded;
  for (const ViewOfPicture& view : *views) {
    Result<Photograph> photograph = photograph_of_view(view, pictures, folder);
    if (photograph)
      loaded.set.photographs.push_back(std::move(*photograph));
    else
      loaded.problems.push_back(photograph.errors().front());
  }
  return loaded;
}

Result<LoadedSet> read_camera_folder(const fs::path& folder) {
  LoadedSet loaded;
  std::error_code code;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, code)) {
    if (entry.path().extension() != ".camera") continue;
    const Result<std::string> text = read_file(entry.path());
    Result<Photograph> photograph = text ? parse_strecha_camera(*text, entry.path().string()) : text.errors();
    if (!photograph) {
      loaded.problems.push_back(photograph.errors().front());
      continue;
    }
    photograph->name = entry.path().stem().string();  // NAME.jpg.camera
    loaded.set.photographs.push_back(std::move(*photograph));
  }
  return loaded;
}

Result<LoadedSet> read_folder(const fs::path& source, const fs::path& picture_folder) {
  std::error_code code;
  for (const fs::path& below : {fs::path("."), fs::path("sparse/0"), fs::path("colmap")}) {
    if (!fs::exists(source / below / "cameras.bin", code) &&
        !fs::exists(source / below / "cameras.txt", code))
      continue;
    const Result<ColmapModel> model = read_colmap_model((source / below).lexically_normal());
    if (!model) return model.errors();
    return photograph_set_of(*model, picture_folder);
  }
  return read_camera_folder(source);
}

Result<LoadedSet> read_source(const fs::path& source, const PictureNames& pictures, const fs::path& folder) {
  if (std::error_code code; fs::is_directory(source, code)) return read_folder(source, folder);
  const Result<std::string> text = read_file(source);
  if (!text) return text.errors();
  const std::string extension = source.extension().string(), name = source.string();
  if (extension == ".json") {
    Result<PhotographSet> set = parse_camera_json(*text, name);
    if (!set) return set.errors();
    return LoadedSet{std::move(*set), {}};
  }
  if (extension == ".camera") return read_camera_folder(source.parent_path());
  if (extension == ".wrl" || extension == ".iv")
    return set_of_views(parse_viewpoints(*text, name), pictures, folder, source);
  if (extension == ".gltf" || extension == ".glb")
    return set_of_views(parse_gltf_cameras(*text, name), pictures, folder, source);
  return set_of_views(parse_thesis_cameras(*text, name), pictures, folder, source);
}

}  // namespace

Result<LoadedSet> read_cameras(const fs::path& source, const fs::path& picture_folder) {
  const PictureNames pictures(picture_folder);
  Result<LoadedSet> loaded = read_source(source, pictures, picture_folder);
  if (!loaded) return loaded;
  match_to_pictures(*loaded, pictures, picture_folder);
  fit_to_files(*loaded, picture_folder);
  if (loaded->set.photographs.empty()) {
    Errors errors = loaded->problems;
    errors.push_back(
        error("{}: no camera of it belongs to a picture in {}", source.string(), picture_folder.string()));
    return errors;
  }
  return loaded;
}

}  // namespace parvis::photographs
