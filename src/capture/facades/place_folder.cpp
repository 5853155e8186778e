#include "capture/facades/place_folder.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>

#include "base/content_hash.h"
#include "base/files.h"
#include "base/image_io.h"
#include "base/path_inside.h"
#include "base/progress.h"
#include "capture/photographs/picture.h"
#include "capture/photographs/picture_header.h"
#include "capture/photographs/set_file.h"

namespace parvis::facades {
namespace fs = std::filesystem;
namespace {

using photographs::Photograph;

/// Margins that hold every transparent pixel of the picture's border, the same on opposite sides.
glm::ivec2 empty_margins(const Image8& image) {
  const auto is_full = [&](int x, int y) { return image.at(x, y)[3] > 0; };
  glm::ivec2 margin(0);
  const auto row_is_full = [&](int y) {
    for (int x = margin.x; x < image.width - margin.x; ++x)
      if (!is_full(x, y)) return false;
    return true;
  };
  const auto column_is_full = [&](int x) {
    for (int y = margin.y; y < image.height - margin.y; ++y)
      if (!is_full(x, y)) return false;
    return true;
  };
  const glm::ivec2 maximum(image.width / 8, image.height / 8);
  bool is_done = false;
  while (!is_done && margin.x < maximum.x && margin.y < maximum.y) {
    const bool rows = row_is_full(margin.y) && row_is_full(image.height - 1 - margin.y);
    const bool columns = column_is_full(margin.x) && column_is_full(image.width - 1 - margin.x);
    is_done = rows && columns;
    if (!rows) ++margin.y;
    if (!columns) ++margin.x;
  }
  return margin;
}

Image8 cropped(const Image8& image, glm::ivec2 margin) {
  Image8 part(image.width - 2 * margin.x, image.height - 2 * margin.y, 3);
  for (int y = 0; y < part.height; ++y)
    for (int x = 0; x < part.width; ++x) std::copy_n(image.at(x + margin.x, y + margin.y), 3, part.at(x, y));
  return part;
}

Result<fs::path> pinhole_file(const fs::path& folder, const Photograph& photograph) {
  return path_inside(folder, fs::path("pinhole") / (photograph.name + ".png"));
}
fs::path mask_beside(const fs::path& picture) { return fs::path(picture).replace_extension(".mask.png"); }

std::string named_content(std::string_view name, const fs::path& file) {
  const Result<std::string> bytes = read_file(file);
  if (!bytes) return fmt::format("{}: none\n", name);
  ContentHash hash;
  hash.add_text(*bytes);
  return fmt::format("{}: {} bytes, {:016x}\n", name, bytes->size(), hash.value());
}

/// All that the straightened picture depends on, and what it became, as text beside it: a picture that is not
/// what was made of this photograph is straightened once more.
std::string recipe_of(const Photograph& photograph, const fs::path& straight) {
  std::string text =
      fmt::format("{} {} x {}\n", int(photograph.lens.model), photograph.lens.width, photograph.lens.height);
  for (const double parameter : photograph.lens.parameters) text += fmt::format("{:.17g}\n", parameter);
  text += named_content("photograph", photograph.file) + named_content("picture", straight);
  if (!photograph.mask.empty())
    text += named_content("mask", photograph.mask) + named_content("picture's mask", mask_beside(straight));
  return text;
}

/// The mask of a photograph freed from distortion, as a file beside it; cropped by the same margins.
Result<fs::path> straight_mask(const fs::path& picture, const Photograph& photograph, glm::ivec2 margin) {
  const Result<Image8> masked = photographs::read_picture(photograph);
  if (!masked) return masked.errors();
  const Image8 straight = photographs::undistorted(photograph, *masked).image;
  Image8 mask(straight.width - 2 * margin.x, straight.height - 2 * margin.y, 1);
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x) *mask.at(x, y) = straight.at(x + margin.x, y + margin.y)[3];
  const fs::path file = mask_beside(picture);
  if (Status status = write_image(file, mask); !status) return status.errors();
  return file;
}

/// `straight` with the lens of its picture of width x height pixels, cropped by the same margins on opposite
/// sides.
Photograph with_cropped_lens(Photograph straight, int width, int height) {
  const glm::dvec2 margin(0.5 * (straight.lens.width - width), 0.5 * (straight.lens.height - height));
  const glm::dvec2 focal = photographs::focal_px(straight.lens),
                   centre = photographs::principal_point_px(straight.lens) - margin;
  straight.lens = photographs::pinhole_lens(width, height, focal.x, focal.y, centre.x, centre.y);
  return straight;
}

/// The photograph without distortion, as a file of its own unless it had none. One that is there is taken
/// over if it was made of the same picture and lens.
Result<Photograph> without_distortion(const fs::path& folder, const Photograph& photograph) {
  if (photographs::is_pinhole(photograph.lens)) return photograph;
  const Result<fs::path> inside = pinhole_file(folder, photograph);
  if (!inside) return inside.errors();
  const fs::path& file = *inside;
  const fs::path recipe_file = fs::path(file).replace_extension(".txt");
  std::error_code code;
  if (fs::exists(recipe_file, code))
    if (const Result<std::string> known = read_file(recipe_file, 1 << 16);
        known && *known == recipe_of(photograph, file))
      if (const auto header = photographs::read_picture_header(file)) {
        Photograph straight = photograph;
        straight.lens = photographs::undistorted(photograph.lens);
        straight.file = file;
        if (!photograph.mask.empty()) straight.mask = mask_beside(file);
        return with_cropped_lens(straight, header->width, header->height);
      }
  Photograph unmasked = photograph;
  unmasked.mask.clear();
  const Result<Image8> pixels = photographs::read_picture(unmasked);
  if (!pixels) return pixels.errors();
  photographs::Picture straight = photographs::undistorted(unmasked, *pixels);
  const glm::ivec2 margin = empty_margins(straight.image);
  const Image8 part = cropped(straight.image, margin);
  straight.photograph.file = file;
  if (Status status = write_image(file, part); !status) return status.errors();
  if (!photograph.mask.empty()) {
    const Result<fs::path> mask = straight_mask(file, photograph, margin);
    if (!mask) return mask.errors();
    straight.photograph.mask = *mask;
  }
  if (Status status = write_file(recipe_file, recipe_of(photograph, file)); !status) return status.errors();
  return with_cropped_lens(straight.photograph, part.width, part.height);
}

/// Layered pictures are called as the photographs, with another ending.
Status check_stems(const std::vector<Photograph>& photographs) {
  std::map<fs::path, std::string> names;
  for (const Photograph& photograph : photographs) {
    const auto [known, is_new] =
        names.try_emplace(fs::path(photograph.name).replace_extension(), photograph.name);
    if (!is_new)
      return error("{} and {} would have the same layered picture; rename one of them", known->second,
                   photograph.name);
  }
  return Ok{};
}

std::vector<std::string> words(const std::string& line) {
  // NAME "LAYER WITH SPACES" STATE
  std::vector<std::string> found;
  std::size_t at = 0;
  while (at < line.size()) {
    if (line[at] == ' ' || line[at] == '\r') {
      ++at;
    } else if (line[at] == '"') {
      const std::size_t end = std::min(line.find('"', at + 1), line.size());
      found.push_back(line.substr(at + 1, end - at - 1)), at = end + 1;
    } else {
      const std::size_t end = std::min(line.find(' ', at), line.size());
      found.push_back(line.substr(at, end - at)), at = end;
    }
  }
  return found;
}

}  // namespace

std::vector<NamedMesh> named_meshes(const scene::Model& model) {
  const std::vector<glm::mat4> pose = scene::rest_pose(model);
  std::vector<NamedMesh> meshes;
  for (const scene::Part& part : model.parts) {
    const std::string name = part.object.empty() ? model.name : part.object;
    auto known = std::ranges::find(meshes, name, &NamedMesh::name);
    if (known == meshes.end()) known = meshes.insert(meshes.end(), {name, {}});
    append(known->mesh, part.mesh, pose[std::size_t(part.node)]);
  }
  std::ranges::sort(meshes, {}, &NamedMesh::name);
  return meshes;
}

Result<PlaceSource> read_place(const fs::path& folder, std::vector<NamedMesh> meshes,
                               const std::vector<std::string>& left_out) {
  const Result<photographs::LoadedSet> loaded = photographs::read_photograph_set(folder);
  if (!loaded) return loaded.errors();
  PlaceSource source{folder, std::move(meshes), {}, loaded->problems};
  for (const std::string& name : left_out)
    if (!photographs::find(loaded->set, name))
      return error("{}: there is no photograph {} to leave out", folder.string(), name);
  if (Status status = check_stems(loaded->set.photographs); !status) return status.errors();
  Progress progress("removing distortion", loaded->set.photographs.size());
  for (const Photograph& photograph : loaded->set.photographs) {
    progress.advance();
    if (std::ranges::count(left_out, photograph.name) > 0) continue;
    const Result<Photograph> straight = without_distortion(folder, photograph);
    if (straight)
      source.photographs.push_back(*straight);
    else
      source.notes.insert(source.notes.end(), straight.errors().begin(), straight.errors().end());
  }
  if (source.photographs.empty() && !source.notes.empty()) return source.notes;
  return source;
}

Status write_choices(const fs::path& folder, const std::vector<FillingChoice>& choices) {
  std::string text = "# photograph \"layer\" accepted|refused|proposal; * stands for all, later lines win\n";
  Result<std::vector<FillingChoice>> all = read_choices(folder);
  if (!all) return all.errors();
  all->insert(all->end(), choices.begin(), choices.end());
  for (const FillingChoice& choice : *all)
    text += fmt::format("\"{}\" \"{}\" {}\n", choice.photograph, choice.layer,
                        filling_names[std::size_t(choice.state)]);
  return write_file(folder / "filling.txt", text);
}

Result<std::vector<FillingChoice>> read_choices(const fs::path& folder) {
  const fs::path file = folder / "filling.txt";
  std::error_code code;
  if (!fs::exists(file, code)) return std::vector<FillingChoice>();
  const Result<std::string> text = read_file(file, 1 << 24);
  if (!text) return text.errors();
  std::vector<FillingChoice> choices;
  Errors errors;
  std::istringstream lines(*text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::vector<std::string> parts = words(line.substr(0, line.find('#')));
    if (parts.empty()) continue;
    const auto state =
        parts.size() == 3 ? std::ranges::find(filling_names, parts[2]) : std::end(filling_names);
    if (state == std::end(filling_names) || state == std::begin(filling_names))
      errors.push_back(error_at({file.string(), number, 0},
                                "expected \"PHOTOGRAPH\" \"LAYER\" accepted|refused|proposal"));
    else
      choices.push_back({parts[0], parts[1], Filling(state - std::begin(filling_names))});
  }
  if (!errors.empty()) return errors;
  return choices;
}

namespace {

/// Whether a choice is about `layer` of `photograph`.
bool fits(const FillingChoice& choice, const std::string& photograph, const std::string& layer) {
  return (choice.photograph == "*" || choice.photograph == photograph) &&
         (choice.layer == "*" || choice.layer == layer);
}

/// False where there is no such layer.
bool apply_choice(const FillingChoice& choice, PlaceLayers& place) {
  bool is_found = false;
  for (std::size_t i = 0; i < place.names.size(); ++i)
    for (std::size_t l = 0; l < place.layered[i].layers.size(); ++l) {
      if (!fits(choice, place.names[i], place.layered[i].layers[l].name)) continue;
      is_found = true;
      if (place.filled[i].states[l] != Filling::none) place.filled[i].states[l] = choice.state;
    }
  for (std::size_t object = 0; object < place.surfaces.size(); ++object)
    if (fits(choice, surfaces_choice, place.model.objects[object].name))
      is_found = true, place.surfaces[object] = choice.state;
  return is_found;
}

}  // namespace

Errors apply_choices(const std::vector<FillingChoice>& choices, PlaceLayers& place) {
  Errors messages;
  for (const FillingChoice& choice : choices)
    if (!apply_choice(choice, place))
      messages.push_back(
          choice.photograph == surfaces_choice
              ? error("filling.txt: there is no surface \"{}\" any more; the choice is kept", choice.layer)
              : error("filling.txt: there is no layer \"{}\" of photograph {} any more; the choice is kept",
                      choice.layer, choice.photograph));
  return messages;
}

}  // namespace parvis::facades
