// Which edits a folder's layered pictures hold: what differs between a picture and the copy that was kept
// when it was written, on the model and with the cameras of that time.
#include <algorithm>
#include <filesystem>
#include <map>

#include "base/files.h"
#include "base/path_inside.h"
#include "base/progress.h"
#include "capture/facades/coarse_model_file.h"
#include "capture/facades/kept_layers.h"
#include "capture/facades/place_folder.h"
#include "capture/facades/place_recipe.h"
#include "capture/photographs/colmap_set.h"
#include "capture/photographs/picture.h"
#include "formats/gltf/gltf_reader.h"

namespace parvis::facades {
namespace fs = std::filesystem;
namespace {

fs::path psd_file(const fs::path& folder, const std::string& photograph) {
  return (folder / photograph).replace_extension(".psd");
}
fs::path edits_file(const fs::path& folder, const std::string& photograph) {
  return (folder / "layers" / "edits" / photograph).replace_extension(".edits");
}

bool are_equal(const fs::path& a, const fs::path& b) {
  const Result<std::string> in_a = read_file(a), in_b = read_file(b);
  return in_a && in_b && *in_a == *in_b;
}

/// Where a picture is kept until it is written in both places: whoever is stopped between has edited nothing.
fs::path next_file(const fs::path& written, const std::string& photograph) {
  return psd_file(written / "next", photograph);
}

/// Whether the layered picture of a photograph is not what was written last.
bool is_edited(const fs::path& folder, const std::string& photograph) {
  const fs::path now = psd_file(folder / "layers", photograph), written = folder / "layers" / "written";
  std::error_code code;
  return fs::exists(now, code) && !are_equal(now, psd_file(written, photograph)) &&
         !are_equal(now, next_file(written, photograph));
}

/// The photographs that the pictures were written of: their cameras alone, wherever their files are now.
Result<photographs::PhotographSet> written_cameras(const fs::path& written) {
  const Result<photographs::ColmapModel> model = photographs::read_colmap_model(written);
  if (!model) return model.errors();
  return photographs::photograph_set_of(*model, written).set;
}

/// Pictures that somebody saved after they were written.
std::vector<std::string> edited_photographs(const fs::path& folder) {
  std::vector<std::string> names;
  const fs::path written = folder / "layers" / "written";
  std::error_code code;
  if (!fs::exists(written / "cameras.bin", code)) return names;
  const Result<photographs::PhotographSet> set = written_cameras(written);
  if (!set) return names;
  for (const photographs::Photograph& photo : set->photographs) {
    if (fs::exists(psd_file(written, photo.name), code) && is_edited(folder, photo.name))
      names.push_back(photo.name);
  }
  return names;
}

/// The layers of the time when the pictures were written, of some photographs.
struct WrittenLayers {
  std::vector<std::string> names;
  std::vector<View> views;
  LayerModel model;
  std::vector<VisibilityLayers> visibility;
};

Result<WrittenLayers> written_layers(const fs::path& folder) {
  const fs::path written = folder / "layers" / "written";
  const Result<photographs::PhotographSet> set = written_cameras(written);
  if (!set) return set.errors();
  Errors warnings;
  const Result<scene::Model> model = scene::read_gltf(written / "model.glb", warnings);
  if (!model) return model.errors();
  Result<LayerModelResult> layers = layer_model(named_meshes(*model));
  if (!layers) return layers.errors();
  WrittenLayers result{{}, {}, std::move(layers->model), {}};
  for (const photographs::Photograph& photo : set->photographs) {
    const Result<View> view = view_of(photo);
    if (!view) return view.errors();
    result.names.push_back(photo.name), result.views.push_back(*view);
  }
  result.visibility = visibility_layers(result.model, result.views, result.names);
  return result;
}

/// Transparent layers: what a picture lacks of them is in neither of two pictures that are compared.
LayerPixels blank_layers(const LayeredView& layered) {
  LayerPixels pixels;
  for (const ImageLayer& layer : layered.layers) pixels.emplace_back(layer.box.width, layer.box.height, 4);
  return pixels;
}

/// Collects one picture's edits into its file, and takes the picture for the one that was written.
Status collect(const fs::path& folder, const WrittenLayers& written, std::size_t i, Errors& messages) {
  const std::string& name = written.names[i];
  const fs::path now = psd_file(folder / "layers", name),
                 then = psd_file(folder / "layers" / "written", name);
  const Result<PsdPicture> before = read_psd(then), after = read_psd(now);
  if (!before) return before.errors();
  if (!after) return after.errors();
  const View& view = written.views[i];
  const LayeredView layered = image_layers(written.model, view, written.visibility[i]);
  const Result<ReadLayers> old_pixels =
      read_layers(*before, layered, blank_layers(layered), view.width, view.height, then.string());
  if (!old_pixels) return old_pixels.errors();
  const Result<ReadLayers> new_pixels =
      read_layers(*after, layered, old_pixels->pixels, view.width, view.height, now.string());
  if (!new_pixels) return new_pixels.errors();
  messages.insert(messages.end(), new_pixels->messages.begin(), new_pixels->messages.end());
  const LayersOfModel layers{written.model, view, written.visibility[i], layered};
  LayerEdits edits = edits_of(layers, old_pixels->pixels, new_pixels->pixels);
  const fs::path file = edits_file(folder, name);
  std::error_code code;
  if (fs::exists(file, code)) {
    const Result<LayerEdits> earlier = read_edits(file);
    if (!earlier) return earlier.errors();
    edits = joined(*earlier, edits);
  }
  if (Status status = write_edits(file, edits); !status) return status;
  const Result<std::string> bytes = read_file(now);
  if (!bytes) return bytes.errors();
  return write_file(then, *bytes);
}

/// Collects the edits of all pictures. A picture that cannot be read is named, and left as it is.
Errors collect_edits(const fs::path& folder) {
  Errors messages;
  const std::vector<std::string> edited = edited_photographs(folder);
  if (edited.empty()) return messages;
  const Result<WrittenLayers> written = written_layers(folder);
  if (!written) return written.errors();
  for (std::size_t i = 0; i < written->names.size(); ++i)
    if (std::ranges::count(edited, written->names[i]) > 0)
      if (const Status status = collect(folder, *written, i, messages); !status)
        messages.insert(messages.end(), status.errors().begin(), status.errors().end());
  return messages;
}

/// Marks what differs between two states of the layers as painted.
void mark_painted(const LayerPixels& before, Filled& filled) {
  for (std::size_t l = 0; l < before.size(); ++l)
    for (std::size_t p = 0; p < before[l].pixels.size(); p += 4)
      if (!std::equal(before[l].pixels.begin() + std::ptrdiff_t(p),
                      before[l].pixels.begin() + std::ptrdiff_t(p + 4),
                      filled.pixels[l].pixels.begin() + std::ptrdiff_t(p)))
        filled.sources[l].pixels[p / 4] = std::uint8_t(FillSource::painted);
}

Errors paint(const LayerEdits& edits, std::size_t i, PlaceLayers& place) {
  const LayerPixels before = place.filled[i].pixels;
  AppliedEdits applied = apply(edits, place.layers(i), place.names[i], place.filled[i].pixels);
  mark_painted(before, place.filled[i]);
  return std::move(applied.messages);
}

/// Paint of photograph `from` as photograph `to` shows it; pixels that were made transparent stay there.
LayerEdits carried(const LayerEdits& edits, const PlaceLayers& place, std::size_t from, std::size_t to) {
  const View &a = place.views[from], &b = place.views[to];
  LayerEdits result;
  std::multimap<std::pair<int, int>, std::pair<std::size_t, const EditedPixel*>> painted;
  for (const ObjectEdits& object : edits) {
    for (const EditedPixel& pixel : object.pixels)
      if (pixel.rgba[3] > 0) painted.insert({{pixel.x, pixel.y}, {result.size(), &pixel}});
    result.push_back({object.object, object.layer, {}});
  }
  const ItemBuffer seen = item_buffer(place.model, b);
  for (int y = 0; y < b.height; ++y)
    for (int x = 0; x < b.width; ++x) {
      if (seen.triangles[seen.index(x, y)] == no_triangle_seen) continue;
      const float depth = seen.depths[seen.index(x, y)];
      const glm::dvec3 in_a = a.to_camera(b.to_world({x + 0.5, y + 0.5}, double(depth)));
      if (!(in_a.z > 0.0)) continue;
      const glm::dvec2 at = glm::floor(a.to_pixel(in_a));
      if (!(at.x >= 0.0 && at.y >= 0.0 && at.x < a.width && at.y < a.height)) continue;
      const auto [first, last] = painted.equal_range({int(at.x), int(at.y)});
      for (auto found = first; found != last; ++found)
        if (const auto& [object, pixel] = found->second;
            std::abs(in_a.z - double(pixel->depth)) < double(same_surface_tolerance) * in_a.z)
          result[object].pixels.push_back({x, y, depth, pixel->rgba});
    }
  return result;
}

std::size_t pixel_count(const LayerEdits& edits) {
  std::size_t count = 0;
  for (const ObjectEdits& object : edits) count += object.pixels.size();
  return count;
}

/// Paints the edits of each photograph; and, where `settings` say so, carries them into the others, below
/// these photographs' own.
void paint_all(const fs::path& folder, const PlaceSettings& settings, PlaceLayers& place) {
  std::map<std::size_t, LayerEdits> edits;
  std::error_code code;
  for (std::size_t i = 0; i < place.names.size(); ++i) {
    const fs::path file = edits_file(folder, place.names[i]);
    if (!fs::exists(file, code)) continue;
    Result<LayerEdits> read = read_edits(file);
    if (read)
      edits[i] = *std::move(read);
    else
      append(place.warnings, read.errors());
  }
  for (const auto& [from, painted] : edits) {
    std::string others;
    for (std::size_t to = 0; to < place.names.size(); ++to) {
      if (to == from) continue;
      const LayerEdits there = carried(painted, place, from, to);
      if (pixel_count(there) == 0) continue;
      others += (others.empty() ? "" : ", ") + place.names[to];
      if (settings.carries_edits) paint(there, to, place);
    }
    if (!others.empty() && !settings.carries_edits)
      place.warnings.push_back(
          error("{}: other photographs show what was painted in it as it was ({}): views between them mix "
                "both. --carry-edits paints it into those, too",
                place.names[from], others));
  }
  for (const auto& [i, painted] : edits) append(place.warnings, paint(painted, i, place));
}

/// Layers and edits are read and written inside the place's own folder alone.
Status check_files(const PlaceSource& source) {
  for (const photographs::Photograph& photo : source.photographs)
    for (const fs::path& file :
         {psd_file("layers", photo.name), psd_file(fs::path("layers") / "written", photo.name),
          next_file(fs::path("layers") / "written", photo.name), edits_file("", photo.name)})
      if (const Result<fs::path> inside = path_inside(source.folder, file); !inside) return inside.errors();
  return Ok{};
}

/// Changes that were not collected, because they could not be read, are not written over.
Status check_collected(const PlaceSource& source, const PlaceLayers& place) {
  Errors errors;
  for (const std::string& name : place.names)
    if (is_edited(source.folder, name))
      errors.push_back(
          error("{}: somebody has changed it, and the changes could not be taken over; save it as a PSD of "
                "8-bit RGB with its layers, or move it elsewhere to have it written again",
                psd_file(source.folder / "layers", name).string()));
  return errors.empty() ? Status(Ok{}) : Status(errors);
}

}  // namespace

Result<PlaceLayers> make_place(const PlaceSource& source, const PlaceSettings& settings) {
  if (const Status status = check_files(source); !status) return status.errors();
  Errors notes = source.notes;
  append(notes, collect_edits(source.folder));
  const LayerKeeper keeper(source.folder, layers_key(source, settings));
  Result<PlaceLayers> place = place_layers(source.photographs, source.meshes, settings, &keeper);
  if (!place) return place;
  append(place->warnings, notes);
  const Result<std::vector<FillingChoice>> choices = read_choices(source.folder);
  if (!choices) return choices.errors();
  append(place->warnings, apply_choices(*choices, *place));
  paint_all(source.folder, settings, *place);
  return place;
}

Status write_layered_pictures(const PlaceSource& source, const PlaceLayers& place) {
  if (Status status = check_collected(source, place); !status) return status;
  const fs::path folder = source.folder / "layers", written = folder / "written";
  Progress progress("writing layered pictures", place.names.size());
  for (std::size_t i = 0; i < place.names.size(); ++i) {
    const auto photo = std::ranges::find(source.photographs, place.names[i], &photographs::Photograph::name);
    photographs::Photograph unmasked = *photo;
    unmasked.mask.clear();
    const Result<Image8> picture = photographs::read_picture(unmasked);
    if (!picture) return picture.errors();
    const PsdPicture psd =
        layered_picture(*picture, place.layered[i], chosen_pixels(place.filled[i], place.originals[i]),
                        item_buffer(place.model, place.views[i]).depths);
    const fs::path next = next_file(written, place.names[i]);
    for (const fs::path& file : {next, psd_file(folder, place.names[i]), psd_file(written, place.names[i])})
      if (Status status = write_psd(file, psd); !status) return status;
    std::error_code code;
    fs::remove(next, code);
    progress.advance();
  }
  photographs::PhotographSet set;
  for (const photographs::Photograph& photo : source.photographs)
    if (std::ranges::count(place.names, photo.name) > 0) set.photographs.push_back(photo);
  if (Status status = write_meshes(written / "model.glb", source.meshes); !status) return status;
  return photographs::write_colmap_model(written, photographs::colmap_model_of(set),
                                         photographs::ColmapFormat::binary);
}

}  // namespace parvis::facades
