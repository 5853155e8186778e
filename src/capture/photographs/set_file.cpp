#include "capture/photographs/set_file.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <unordered_map>

#include "base/files.h"
#include "base/json_guard.h"
#include "base/path_inside.h"
#include "capture/photographs/picture.h"

namespace parvis::photographs {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* file_name = "photographs.json";

/// As it is stored: relative to `folder` where there is such a path.
std::string stored(const fs::path& path, const fs::path& folder) {
  if (path.empty()) return "";
  const fs::path relative =
      fs::absolute(path).lexically_normal().lexically_relative(fs::absolute(folder).lexically_normal());
  return (relative.empty() ? fs::absolute(path) : relative).generic_string();
}

fs::path found(const std::string& stored_path, const fs::path& folder) {
  return stored_path.empty() ? fs::path() : (folder / stored_path).lexically_normal();
}

/// The file of a mask: in the place's folder, or in that of its pictures.
Result<fs::path> mask_file(const std::string& stored_path, const fs::path& folder, const fs::path& pictures) {
  const fs::path file = found(stored_path, folder);
  for (const fs::path& root : {folder, pictures})
    if (path_inside(root, fs::absolute(file))) return file;
  return error("{}: a mask outside of {} and of the photographs' folder; copy it there, and mend {}",
               stored_path, folder.string(), (folder / file_name).string());
}

using ByName = std::unordered_map<std::string, Photograph*>;

/// Gains of one photograph; false where the entry is none.
bool apply_gains(const Json& entry, const ByName& photographs) {
  if (!entry.is_object() || !entry.contains("name") || !entry["name"].is_string()) return false;
  const std::string name = entry["name"];
  const Json gain = entry.value("gain", Json::array());
  const auto found = photographs.find(name);
  if (found == photographs.end() || !gain.is_array() || gain.size() != 3) return true;
  for (int c = 0; c < 3; ++c) {
    if (!gain[std::size_t(c)].is_number() || !(gain[std::size_t(c)].get<double>() > 0.0)) return false;
    found->second->gain[c] = gain[std::size_t(c)].get<double>();
  }
  return true;
}

/// The mask of one photograph. Error: it lies elsewhere.
Status apply_mask(const Json& entry, const fs::path& folder, const fs::path& pictures,
                  const ByName& photographs) {
  if (!entry.contains("mask") || !entry["mask"].is_string()) return Done{};
  const Result<fs::path> mask = mask_file(entry["mask"], folder, pictures);
  if (!mask) return mask.errors();
  const auto found = photographs.find(entry["name"].get<std::string>());
  if (found != photographs.end()) found->second->mask = *mask;
  return Done{};
}

/// Four rows of four numbers.
Json rows_of(const glm::dmat4& matrix) {
  Json rows = Json::array();
  for (int row = 0; row < 4; ++row)
    rows.push_back({matrix[0][row], matrix[1][row], matrix[2][row], matrix[3][row]});
  return rows;
}

/// What `rows_of` made; nothing where it is something else.
std::optional<glm::dmat4> matrix_of(const Json& rows) {
  if (!rows.is_array() || rows.size() != 4) return std::nullopt;
  glm::dmat4 matrix(1.0);
  for (int row = 0; row < 4; ++row) {
    const Json& values = rows[std::size_t(row)];
    if (!values.is_array() || values.size() != 4) return std::nullopt;
    for (int column = 0; column < 4; ++column) {
      if (!values[std::size_t(column)].is_number()) return std::nullopt;
      matrix[column][row] = values[std::size_t(column)].get<double>();
    }
  }
  return matrix;
}

}  // namespace

Status write_photograph_set(const fs::path& folder, const PhotographSet& set,
                            const fs::path& picture_folder) {
  if (Status status = write_colmap_model(folder, colmap_model_of(set), ColmapFormat::binary); !status)
    return status;
  Json json{{"pictures", stored(picture_folder, folder)},
            {"photographs", Json::array()},
            {"world_from_given", rows_of(set.world_from_given)}};
  for (const Photograph& photograph : set.photographs) {
    Json entry{{"name", photograph.name},
               {"gain", {photograph.gain.x, photograph.gain.y, photograph.gain.z}},
               {"reprojection_error_px", photograph.reprojection_error_px}};
    if (!photograph.mask.empty()) entry["mask"] = stored(photograph.mask, folder);
    json["photographs"].push_back(std::move(entry));
  }
  return write_file(folder / file_name, json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

Result<LoadedSet> read_photograph_set(const fs::path& folder) {
  const std::string file = (folder / file_name).string();
  const Result<std::string> text = read_file(folder / file_name);
  if (!text)
    return error("{}: is no folder of calibrated photographs; parvis facade calibrate makes one",
                 folder.string());
  if (Status depth = check_json_depth(*text, file); !depth) return depth.errors();
  const Json json = Json::parse(*text, nullptr, false);
  if (!json.is_object() || !json.contains("pictures") || !json["pictures"].is_string())
    return error("{}: expected an object with \"pictures\", the folder of the photographs", file);
  const Result<ColmapModel> model = read_colmap_model(folder);
  if (!model) return model.errors();
  const fs::path pictures = found(json["pictures"], folder);
  LoadedSet loaded = photograph_set_of(*model, pictures);
  ByName photographs;
  for (Photograph& photograph : loaded.set.photographs) photographs.try_emplace(photograph.name, &photograph);
  const Json entries = json.value("photographs", Json::array());
  for (const Json& entry : entries)
    if (!apply_gains(entry, photographs))
      loaded.problems.push_back(
          error("{}: expected a name and three gains > 0 in {}", file, entry.dump().substr(0, 80)));
    else if (Status status = apply_mask(entry, folder, pictures, photographs); !status)
      return status.errors();
  if (json.contains("world_from_given")) {
    const std::optional<glm::dmat4> matrix = matrix_of(json["world_from_given"]);
    if (!matrix) return error("{}: expected four rows of four numbers in \"world_from_given\"", file);
    loaded.set.world_from_given = *matrix;
  }
  fit_to_files(loaded, pictures);
  return loaded;
}

}  // namespace parvis::photographs
