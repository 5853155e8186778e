#include "capture/view_dependent_objects/model_pairs.h"

#include <algorithm>
#include <glm/gtc/constants.hpp>
#include <map>

#include "base/camera_check.h"
#include "base/files.h"
#include "capture/photographs/camera_files.h"

namespace parvis::view_dependent_objects {
namespace {

using photographs::ViewOfPicture;

constexpr std::uint64_t max_camera_bytes = std::uint64_t{256} << 20;  // a model may be the camera's file

std::string names_of(const std::vector<ViewOfPicture>& views) {
  std::vector<std::string> names;
  for (const ViewOfPicture& view : views) {
    names.push_back('"' + view.name + '"');
    if (names.size() == 10) break;
  }
  return fmt::format("{}{}", fmt::join(names, ", "), views.size() > names.size() ? ", ..." : "");
}

/// The viewpoints of a file; none is an error.
Result<std::vector<ViewOfPicture>> viewpoints_in(const std::filesystem::path& file) {
  const Result<std::string> text = read_file(file, max_camera_bytes);
  if (!text) return text.errors();
  const std::string extension = file.extension().string();
  Result<std::vector<ViewOfPicture>> views = extension == ".glb" || extension == ".gltf"
                                                 ? photographs::parse_gltf_cameras(*text, file.string())
                                                 : photographs::parse_viewpoints(*text, file.string());
  if (views && views->empty())
    return error_at(
        {file.string(), 0, 0},
        "holds no Viewpoint (VRML 2) and no PerspectiveCamera (VRML 1, Inventor): add one, or give "
        "camera=\"x y z h p r fov aspect\"");
  return views;
}

/// Reads the attributes one after the other.
class PairReader {
 public:
  explicit PairReader(const scene::Node& node) : node_(node) {}

  Result<std::vector<ModelPair>> read() {
    for (const scene::NodeAttribute& attribute : node_.attributes) {
      const std::string& name = attribute.schema->name;
      if (name == "file") begin_pair(attribute);
      if (name == "camera") take_camera(attribute);
      if (name == "cameraFile") take_file(attribute);
      if (name == "cameraName") take_name(attribute);
    }
    end_pair();
    if (pairs_.empty() && errors_.empty())
      errors_.push_back(error_at(node_.where, "vdobject needs pairs of file= and a camera"));
    if (!errors_.empty()) return errors_;
    return std::move(pairs_);
  }

 private:
  void begin_pair(const scene::NodeAttribute& attribute) {
    end_pair();
    pairs_.push_back({std::get<std::filesystem::path>(attribute.value), {}, attribute.where});
    last_file_ = pairs_.back().file;
    is_open_ = true;
  }

  /// Ends the pair before the next file=, or the last.
  void end_pair() {
    if (camera_file_) look_into(*camera_file_);
    camera_file_ = nullptr;
    if (is_open_)
      errors_.push_back(
          error_at(pairs_.back().where,
                   "this model has no camera: give camera=, cameraFile= or cameraName= after it"));
    is_open_ = false;
  }

  /// A pair takes one camera; false, with an error, where there is no pair that waits for one.
  bool may_take(const scene::NodeAttribute& attribute) {
    if (is_open_) return true;
    errors_.push_back(error_at(attribute.where, "{}= {}", attribute.schema->name,
                               pairs_.empty() ? "stands before any file=: give the model first"
                                              : "is a second camera of the same model"));
    return false;
  }

  void take_camera(const scene::NodeAttribute& attribute) {
    if (!may_take(attribute)) return;
    is_open_ = false;
    const Result<std::vector<ViewOfPicture>> views = photographs::parse_thesis_cameras(
        "camera=\"" + std::get<std::string>(attribute.value) + '"', attribute.where.file);
    if (views && views->size() == 1)
      take(views->front(), attribute.where);
    else
      errors_.push_back(error_at(
          attribute.where, "expected camera=\"x y z h p r fov aspect\": 8 numbers, fov between 0 and 180"));
  }

  /// Takes a file, whose content is examined when it is known whether a name follows.
  void take_file(const scene::NodeAttribute& attribute) {
    if (!may_take(attribute)) return;
    is_open_ = false;
    last_file_ = std::get<std::filesystem::path>(attribute.value);
    camera_file_ = &attribute;
  }

  void look_into(const scene::NodeAttribute& attribute) {
    const Result<std::vector<ViewOfPicture>>& views = viewpoints_of_last_file();
    if (!views) return fail(views.errors(), attribute.where);
    if (views->size() > 1)
      return errors_.push_back(error_at(attribute.where, "holds {} viewpoints: say which by cameraName= ({})",
                                        views->size(), names_of(*views)));
    take(views->front(), attribute.where);
  }

  void take_name(const scene::NodeAttribute& attribute) {
    if (!camera_file_ && !may_take(attribute)) return;
    is_open_ = false, camera_file_ = nullptr;
    const std::string& name = std::get<std::string>(attribute.value);
    const std::string extension = last_file_.extension().string();
    if (extension != ".wrl" && extension != ".iv" && extension != ".glb" && extension != ".gltf")
      return errors_.push_back(error_at(
          attribute.where,
          "the file named last, {}, is no VRML and has no cameras by name; give cameraFile= before it",
          last_file_.filename().string()));
    const Result<std::vector<ViewOfPicture>>& views = viewpoints_of_last_file();
    if (!views) return fail(views.errors(), attribute.where);
    const auto found = std::ranges::find(*views, name, &ViewOfPicture::name);
    if (found == views->end())
      return errors_.push_back(error_at(attribute.where, "{} has no camera \"{}\"; it has {}",
                                        last_file_.filename().string(), name, names_of(*views)));
    take(*found, attribute.where);
  }

  /// A file may be the camera's of many pairs; it is read once.
  const Result<std::vector<ViewOfPicture>>& viewpoints_of_last_file() {
    const auto known = viewpoints_.find(last_file_);
    return known != viewpoints_.end()
               ? known->second
               : viewpoints_.emplace(last_file_, viewpoints_in(last_file_)).first->second;
  }

  void take(const ViewOfPicture& view, const FileLocation& where) {
    const glm::vec3 place(view.world_from_camera[3]);
    const std::string named = view.name.empty() ? "" : fmt::format(" \"{}\"", view.name);
    if (!glm::all(glm::lessThanEqual(glm::abs(place), glm::vec3(max_coordinate_m))))
      errors_.push_back(
          error_at(where, "the viewpoint{} stands further than {:g} m away", named, max_coordinate_m));
    if (!(view.fov > 0.0 && view.fov < glm::pi<double>()))
      errors_.push_back(
          error_at(where, "the viewpoint{} sees {:.6g} degrees: expected more than 0 and less than 180",
                   named, glm::degrees(view.fov)));
    pairs_.back().viewpoint = place;
  }

  void fail(const Errors& errors, const FileLocation& where) {
    for (const Error& each : errors) errors_.push_back(error_at(where, "{}", to_string(each)));
  }

  const scene::Node& node_;
  std::vector<ModelPair> pairs_;
  Errors errors_;
  std::filesystem::path last_file_;
  std::map<std::filesystem::path, Result<std::vector<ViewOfPicture>>> viewpoints_;
  const scene::NodeAttribute* camera_file_ = nullptr;  ///< that may be followed by a name
  bool is_open_ = false;                               ///< the last pair waits for its camera
};

}  // namespace

Result<std::vector<ModelPair>> model_pairs(const scene::Node& node) { return PairReader(node).read(); }

}  // namespace parvis::view_dependent_objects
