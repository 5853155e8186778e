// Kept are the decisions alone; pixels of photographs and the image layers, which are found in no time, are
// not. Masks and sources have long runs of one value.
#include "capture/facades/kept_layers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "base/kept_parts.h"
#include "base/path_inside.h"

namespace parvis::facades {
namespace fs = std::filesystem;
namespace {

constexpr SealedKind found_kind{"PVFOUN_1", "layers of a place"}, filled_kind{"PVFILL_1", "filling"};
/// New faces of a cut model per triangle: each cut makes one and a triangle more, each face that is split as
/// many as it has triangles. Only what a foreign file asks for is more.
constexpr std::uint64_t max_new_faces = 4;

/// How often each value comes, and the values.
template <class T>
void append_runs(std::string& bytes, const std::vector<T>& values) {
  std::vector<std::uint32_t> counts;
  std::vector<T> of_runs;
  for (const T& value : values)
    if (!of_runs.empty() && of_runs.back() == value)
      ++counts.back();
    else
      counts.push_back(1), of_runs.push_back(value);
  append_values(bytes, counts), append_values(bytes, of_runs);
}

/// Writes all of `values`; false where the runs have another length.
template <class T>
bool take_runs(ByteReader& reader, std::vector<T>& values) {
  const auto counts = reader.take_values<std::uint32_t>();
  const auto of_runs = reader.take_values<T>();
  if (counts.size() != of_runs.size()) return false;
  std::size_t at = 0;
  for (std::size_t r = 0; r < counts.size(); ++r) {
    if (counts[r] > values.size() - at) return false;
    std::fill_n(values.begin() + std::ptrdiff_t(at), counts[r], of_runs[r]);
    at += counts[r];
  }
  return at == values.size();
}

void append_model(std::string& bytes, const LayerModel& model) {
  std::vector<std::array<glm::dvec3, 3>> corners;
  std::vector<glm::uvec3> numbers;
  corners.reserve(model.triangles.size()), numbers.reserve(model.triangles.size());
  for (const LayerTriangle& triangle : model.triangles) {
    corners.push_back(triangle.corners);
    numbers.emplace_back(triangle.object, triangle.face, triangle.source);
  }
  append_value(bytes, model.face_count), append_values(bytes, corners), append_values(bytes, numbers);
}

/// The triangles of `model` after its cuts; false where they do not fit its objects.
bool take_triangles(ByteReader& reader, LayerModel& model) {
  const auto faces = reader.take<std::uint32_t>();
  const auto corners = reader.take_values<std::array<glm::dvec3, 3>>();
  const auto numbers = reader.take_values<glm::uvec3>();
  if (corners.size() != numbers.size() || faces > model.face_count + max_new_faces * corners.size())
    return false;
  model.triangles.clear(), model.face_count = faces;
  model.triangles.reserve(corners.size());
  for (std::size_t t = 0; t < corners.size(); ++t) {
    const glm::uvec3 n = numbers[t];
    if (n.x >= model.objects.size() || n.y >= faces || n.z >= model.source_count) return false;
    for (const glm::dvec3& corner : corners[t])
      if (!std::isfinite(corner.x + corner.y + corner.z)) return false;
    model.triangles.push_back({corners[t], n.x, n.y, n.z});
  }
  return true;
}

void append_visibility(std::string& bytes, const VisibilityLayers& visibility) {
  std::vector<std::uint32_t> objects;
  std::vector<std::int64_t> faces;
  for (const LayerItem& item : visibility.items) objects.push_back(item.object), faces.push_back(item.face);
  append_values(bytes, objects), append_values(bytes, faces);
  append_value(bytes, std::uint32_t(visibility.layers.size()));
  for (const std::vector<std::uint32_t>& layer : visibility.layers) append_values(bytes, layer);
  append_value(bytes, std::uint64_t(visibility.cuts));
  append_value(bytes, std::uint32_t(visibility.warnings.size()));
  for (const Error& warning : visibility.warnings) append_text(bytes, warning.message);
}

/// False where items are not of the model, or not each in one layer.
bool take_visibility(ByteReader& reader, const LayerModel& model, VisibilityLayers& visibility) {
  const auto objects = reader.take_values<std::uint32_t>();
  const auto faces = reader.take_values<std::int64_t>();
  if (objects.size() != faces.size()) return false;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i] >= model.objects.size() || faces[i] < -1 || faces[i] >= std::int64_t(model.face_count))
      return false;
    visibility.items.push_back({objects[i], faces[i]});
  }
  std::vector<char> is_in_layer(objects.size(), 0);
  for (auto count = reader.take<std::uint32_t>(); count > 0 && !reader.has_ended_early(); --count) {
    visibility.layers.push_back(reader.take_values<std::uint32_t>());
    for (const std::uint32_t item : visibility.layers.back())
      if (item >= is_in_layer.size() || std::exchange(is_in_layer[item], char(1))) return false;
  }
  visibility.cuts = std::size_t(reader.take<std::uint64_t>());
  for (auto count = reader.take<std::uint32_t>(); count > 0 && !reader.has_ended_early(); --count)
    visibility.warnings.push_back({reader.take_text(), {}});
  return std::ranges::count(is_in_layer, char(0)) == 0;
}

/// Whether the floats hold it that colours are balanced in.
bool is_finite(const Balance& balance) {
  float sum = 0.0f;
  for (std::size_t c = 0; c < 3; ++c) sum += float(balance.scale[c]) + float(balance.offset[c]);
  return std::isfinite(sum);
}

bool is_proposed(std::uint8_t source) { return source > std::uint8_t(FillSource::seen); }

}  // namespace

Result<KeptParts> LayerKeeper::parts(const SealedKind& kind, std::string_view extension) const {
  const Result<fs::path> folder = path_inside(folder_, fs::path("layers") / "kept");
  if (!folder) return folder.errors();
  return KeptParts(*folder, kind, extension, FolderOf::program);
}

std::optional<std::vector<ImageF>> LayerKeeper::read_found(PlaceLayers& place) const {
  const Result<KeptParts> from = parts(found_kind, ".found");
  if (!from) return std::nullopt;
  const std::optional<std::string> content = from->find("all", key_);
  if (!content) return std::nullopt;
  ByteReader reader(*content);
  if (reader.take<std::uint32_t>() != place.names.size()) return std::nullopt;
  for (const std::string& name : place.names)
    if (reader.take_text() != name) return std::nullopt;
  LayerModel model = place.model;
  if (!take_triangles(reader, model)) return std::nullopt;
  std::vector<VisibilityLayers> visibility(place.names.size());
  std::vector<Balance> balances(place.names.size());
  std::vector<ImageF> trusts(place.names.size());
  for (std::size_t i = 0; i < place.names.size(); ++i) {
    if (!take_visibility(reader, model, visibility[i])) return std::nullopt;
    balances[i] = reader.take<Balance>();
    if (!is_finite(balances[i])) return std::nullopt;
    if (reader.take<std::uint8_t>() == 0) continue;  // trusted everywhere
    trusts[i] = ImageF(place.views[i].width, place.views[i].height, 1);
    if (!take_runs(reader, trusts[i].pixels)) return std::nullopt;
    if (!std::ranges::all_of(trusts[i].pixels, [](float trust) { return trust >= 0.0f && trust <= 1.0f; }))
      return std::nullopt;
  }
  if (!reader.is_at_end()) return std::nullopt;
  place.model = std::move(model);
  place.visibility = std::move(visibility), place.balances = std::move(balances);
  return trusts;
}

Status LayerKeeper::keep_found(const PlaceLayers& place, std::span<const PreparedPhoto> prepared) const {
  const Result<KeptParts> to = parts(found_kind, ".found");
  if (!to) return to.errors();
  std::string bytes;
  append_value(bytes, std::uint32_t(place.names.size()));
  for (const std::string& name : place.names) append_text(bytes, name);
  append_model(bytes, place.model);
  for (std::size_t i = 0; i < place.names.size(); ++i) {
    append_visibility(bytes, place.visibility[i]);
    append_value(bytes, place.balances[i]);
    append_value(bytes, std::uint8_t(!prepared[i].trust.empty()));
    if (!prepared[i].trust.empty()) append_runs(bytes, prepared[i].trust.pixels);
  }
  return to->keep("all", key_, bytes);
}

std::optional<Filled> LayerKeeper::read_filled(const PlaceLayers& place, std::size_t photo,
                                               bool fills) const {
  const Result<KeptParts> from = parts(filled_kind, fills ? ".filled" : ".smooth");
  if (!from) return std::nullopt;
  const std::optional<std::string> content = from->find(place.names[photo], key_);
  if (!content) return std::nullopt;
  ByteReader reader(*content);
  const LayerPixels& originals = place.originals[photo];
  if (reader.take<std::uint32_t>() != originals.size()) return std::nullopt;
  Filled filled{originals, {}, std::vector<Filling>(originals.size(), Filling::none)};
  for (std::size_t l = 0; l < originals.size(); ++l) {
    Image8& sources = filled.sources.emplace_back(originals[l].width, originals[l].height, 1);
    if (!take_runs(reader, sources.pixels)) return std::nullopt;
    const auto colours = reader.take_values<glm::u8vec3>();
    std::size_t next = 0;
    for (std::size_t p = 0; p < sources.pixels.size(); ++p) {
      if (sources.pixels[p] > std::uint8_t(FillSource::painted)) return std::nullopt;
      if (!is_proposed(sources.pixels[p])) continue;
      if (next == colours.size()) return std::nullopt;
      const glm::u8vec3 colour = colours[next++];
      for (int c = 0; c < 3; ++c) filled.pixels[l].pixels[4 * p + std::size_t(c)] = colour[c];
    }
    if (next != colours.size()) return std::nullopt;
    if (next > 0) filled.states[l] = Filling::proposal;
  }
  if (!reader.is_at_end()) return std::nullopt;
  return filled;
}

Status LayerKeeper::keep_filled(const PlaceLayers& place, std::size_t photo, bool fills) const {
  const Result<KeptParts> to = parts(filled_kind, fills ? ".filled" : ".smooth");
  if (!to) return to.errors();
  const Filled& filled = place.filled[photo];
  std::string bytes;
  append_value(bytes, std::uint32_t(filled.pixels.size()));
  for (std::size_t l = 0; l < filled.pixels.size(); ++l) {
    const std::vector<std::uint8_t>& sources = filled.sources[l].pixels;
    append_runs(bytes, sources);
    std::vector<glm::u8vec3> colours;
    for (std::size_t p = 0; p < sources.size(); ++p)
      if (const std::uint8_t* pixel = filled.pixels[l].pixels.data() + 4 * p; is_proposed(sources[p]))
        colours.emplace_back(pixel[0], pixel[1], pixel[2]);
    append_values(bytes, colours);
  }
  return to->keep(place.names[photo], key_, bytes);
}

}  // namespace parvis::facades
