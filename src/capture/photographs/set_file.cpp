#include "capture/photographs/set_file.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
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

/// The path as it is stored: relative to `folder` where there is such a path.
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

/// The file, as text and parsed: an object with "pictures".
struct SetJson {
  std::string file, text;
  Json json;

  /// Where the character `offset` of the text stands.
  FileLocation place_of(std::size_t offset) const {
    const std::string_view before = std::string_view(text).substr(0, offset);
    return {file, int(std::ranges::count(before, '\n')) + 1,
            int(before.size() - (before.rfind('\n') + 1)) + 1};  // npos + 1 is 0
  }
  /// Where `entry` is named; the whole file where it is not.
  FileLocation place_of(const Json& entry) const {
    const std::size_t at = name_of(entry) ? text.find(Json(*name_of(entry)).dump()) : std::string::npos;
    return at == std::string::npos ? FileLocation{file, 0, 0} : place_of(at);
  }
  /// The file's entry of each photograph.
  Json entries() const { return json.value("photographs", Json::array()); }
  static std::optional<std::string> name_of(const Json& entry) {
    if (!entry.is_object() || !entry.contains("name") || !entry["name"].is_string()) return std::nullopt;
    return entry["name"].get<std::string>();
  }
};

Result<SetJson> read_set_json(const fs::path& folder) {
  SetJson set{(folder / file_name).string(), {}, {}};
  Result<std::string> text = read_file(folder / file_name);
  if (!text) return text.errors();
  set.text = *std::move(text);
  if (Status depth = check_json_depth(set.text, set.file); !depth) return depth.errors();
  try {
    set.json = Json::parse(set.text);
  } catch (const Json::parse_error& problem) {
    const std::string reason = json_reason(problem.what());  // "parse error at line 1, column 2: why"
    const std::size_t why = reason.find(": ");
    return error_at(set.place_of(std::max<std::size_t>(problem.byte, 1) - 1), "this is no JSON: {}",
                    why == std::string::npos ? reason : reason.substr(why + 2));
  }
  if (!set.json.is_object() || !set.json.contains("pictures") || !set.json["pictures"].is_string())
    return error("{}: expected an object with \"pictures\", the folder of the photographs", set.file);
  if (!set.entries().is_array()) return error("{}: expected a list in \"photographs\"", set.file);
  return set;
}

/// Nothing where they are not three numbers above 0; 1 where the entry has none.
std::optional<glm::dvec3> gain_of(const Json& entry) {
  glm::dvec3 gain(1.0);
  if (!entry.contains("gain")) return gain;
  const Json& values = entry["gain"];
  if (!values.is_array() || values.size() != 3) return std::nullopt;
  for (int c = 0; c < 3; ++c) {
    const Json& value = values[std::size_t(c)];
    if (!value.is_number() || !(value.get<double>() > 0.0)) return std::nullopt;
    gain[c] = value.get<double>();
  }
  return gain;
}

/// Empty where the entry has none. Errors: it is no path, or lies elsewhere.
Result<fs::path> mask_of(const Json& entry, const SetJson& set, const fs::path& folder) {
  if (!entry.contains("mask")) return fs::path();
  if (!entry["mask"].is_string())
    return error_at(set.place_of(entry), "expected the path of a picture in \"mask\"");
  if (entry["mask"].get_ref<const std::string&>().empty()) return fs::path();
  return mask_file(entry["mask"], folder, found(set.json["pictures"], folder));
}

Error no_entry(const Json& entry, const SetJson& set) {
  return error_at(set.place_of(entry), "expected a name and three gains > 0 in {}",
                  entry.dump().substr(0, 80));
}

/// Four rows of four numbers.
Json rows_of(const glm::dmat4& matrix) {
  Json rows = Json::array();
  for (int row = 0; row < 4; ++row)
    rows.push_back({matrix[0][row], matrix[1][row], matrix[2][row], matrix[3][row]});
  return rows;
}

/// The matrix from rows as `rows_of` writes them; nothing where it is something else.
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

Status write_photograph_set(const fs::path& folder, const PhotographSet& set, const fs::path& picture_folder,
                            const MasksAndGains& of_others) {
  if (Status status = write_colmap_model(folder, colmap_model_of(set), ColmapFormat::binary); !status)
    return status;
  Json json{{"pictures", stored(picture_folder, folder)},
            {"photographs", Json::array()},
            {"world_from_given", rows_of(set.world_from_given)}};
  const auto add = [&](const std::string& name, const fs::path& mask, glm::dvec3 gain) -> Json& {
    Json entry{{"name", name}, {"gain", {gain.x, gain.y, gain.z}}};
    if (!mask.empty()) entry["mask"] = stored(mask, folder);
    return json["photographs"].emplace_back(std::move(entry));
  };
  for (const Photograph& photograph : set.photographs)
    add(photograph.name, photograph.mask, photograph.gain)["reprojection_error_px"] =
        photograph.reprojection_error_px;
  for (const auto& [name, given] : of_others)
    if (!find(set, name)) add(name, given.mask, given.gain);
  return write_file(folder / file_name, json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

Result<MasksAndGains> read_masks_and_gains(const fs::path& folder) {
  MasksAndGains given;
  if (std::error_code code; !fs::exists(folder / file_name, code) && !code) return given;
  const Result<SetJson> set = read_set_json(folder);
  if (!set) return set.errors();
  Errors errors;
  for (const Json& entry : set->entries()) {
    const std::optional<std::string> name = SetJson::name_of(entry);
    const std::optional<glm::dvec3> gain = name ? gain_of(entry) : std::nullopt;
    if (!gain) {
      errors.push_back(no_entry(entry, *set));
      continue;
    }
    const Result<fs::path> mask = mask_of(entry, *set, folder);
    if (!mask) {
      errors.insert(errors.end(), mask.errors().begin(), mask.errors().end());
      continue;
    }
    if (!mask->empty() || *gain != glm::dvec3(1.0)) given[*name] = {*mask, *gain};
  }
  if (!errors.empty()) return errors;
  return given;
}

Result<LoadedSet> read_photograph_set(const fs::path& folder) {
  if (std::error_code code; !fs::is_regular_file(folder / file_name, code))
    return error("{}: is no folder of calibrated photographs; parvis facade calibrate makes one",
                 folder.string());
  const Result<SetJson> set = read_set_json(folder);
  if (!set) return set.errors();
  const Json& json = set->json;
  const Result<ColmapModel> model = read_colmap_model(folder);
  if (!model) return model.errors();
  const fs::path pictures = found(json["pictures"], folder);
  if (std::error_code code; !fs::is_directory(pictures, code))
    return error(
        "{}: the folder of the photographs is not there; put it back, or write into {} where it is now, "
        "as \"pictures\"",
        pictures.string(), set->file);
  LoadedSet loaded = photograph_set_of(*model, pictures);
  ByName photographs;
  for (Photograph& photograph : loaded.set.photographs) photographs.try_emplace(photograph.name, &photograph);
  for (const Json& entry : set->entries()) {
    const std::optional<std::string> name = SetJson::name_of(entry);
    const std::optional<glm::dvec3> gain = name ? gain_of(entry) : std::nullopt;
    if (!gain) {
      loaded.problems.push_back(no_entry(entry, *set));
      continue;
    }
    const Result<fs::path> mask = mask_of(entry, *set, folder);
    if (!mask) return mask.errors();
    if (const auto known = photographs.find(*name); known != photographs.end())
      known->second->gain = *gain, known->second->mask = *mask;
  }
  if (json.contains("world_from_given")) {
    const std::optional<glm::dmat4> matrix = matrix_of(json["world_from_given"]);
    if (!matrix) return error("{}: expected four rows of four numbers in \"world_from_given\"", set->file);
    loaded.set.world_from_given = *matrix;
  }
  fit_to_files(loaded, pictures);
  return loaded;
}

}  // namespace parvis::photographs
