// CityJSON text sequences (CityJSONSeq, .city.jsonl; https://www.cityjson.org/cityjsonseq): a CityJSON file
// in the first line and one feature, with vertices and appearance of its own, in each that follows.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "base/result.h"

namespace parvis::scene {

/// The features of all lines as one CityJSON file. Errors name the line: no JSON, a first line that is no
/// CityJSON, another that is no CityJSONFeature.
Result<nlohmann::json> city_json_of_sequence(const std::filesystem::path& file, const std::string& text);

}  // namespace parvis::scene
