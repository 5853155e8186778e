#include "formats/city_models/building_attributes.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <glm/glm.hpp>
#include <initializer_list>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

namespace parvis::scene {
namespace {

using Use = BuildingUse;

// Names of attributes, as `plain` writes them. The Netherlands, Germany, Switzerland, France, Spain, Italy,
// Finland, Japan and New York publish under these; the first one with a value that is understood counts.
constexpr std::array<std::string_view, 17> year_names{"yearofconstruction",
                                                      "oorspronkelijkbouwjaar",
                                                      "dateofconstruction",
                                                      "bouwjaar",
                                                      "baujahr",
                                                      "constructionyear",
                                                      "yearbuilt",
                                                      "gbauj",
                                                      "yearconstructed",
                                                      "buildyear",
                                                      "constructiondate",
                                                      "anneeconstruction",
                                                      "dateconstruction",
                                                      "anoconstruccion",
                                                      "annocostruzione",
                                                      "valmistumisvuosi",
                                                      "startdate"};
constexpr std::array<std::string_view, 16> use_names{"function",         "usage",
                                                     "gebruiksdoel",     "gebruiksdoelen",
                                                     "gebaeudefunktion", "gebaudefunktion",
                                                     "funktion",         "gfk",
                                                     "usage1",           "usage2",
                                                     "currentuse",       "buildinguse",
                                                     "buildingtype",     "buildingfunction",
                                                     "landuse",          "class"};
constexpr std::string_view register_name = "gklas";  // of Switzerland
constexpr std::array<std::string_view, 13> storey_names{"storeysaboveground",
                                                        "b3bouwlagen",
                                                        "bouwlagen",
                                                        "anzahlderoberirdischengeschosse",
                                                        "anzahlgeschosse",
                                                        "geschosse",
                                                        "gastw",
                                                        "nombredetages",
                                                        "nombreetages",
                                                        "nbetages",
                                                        "numberoffloorsaboveground",
                                                        "numfloors",
                                                        "numberoffloors"};

/// Lower case without accents, and without what is neither letter nor digit: "Année_construction" becomes
/// "anneeconstruction", "bldg:yearOfConstruction" "yearofconstruction".
std::string plain(std::string_view text, bool is_name) {
  constexpr std::array<std::pair<std::string_view, char>, 28> accents{
      {{"ä", 'a'}, {"Ä", 'a'}, {"à", 'a'}, {"á", 'a'}, {"â", 'a'}, {"å", 'a'}, {"Å", 'a'},
       {"ö", 'o'}, {"Ö", 'o'}, {"ó", 'o'}, {"ô", 'o'}, {"ø", 'o'}, {"ü", 'u'}, {"Ü", 'u'},
       {"ú", 'u'}, {"û", 'u'}, {"é", 'e'}, {"É", 'e'}, {"è", 'e'}, {"ê", 'e'}, {"ë", 'e'},
       {"í", 'i'}, {"ï", 'i'}, {"ç", 'c'}, {"ñ", 'n'}, {"ß", 's'}, {"ł", 'l'}, {"ś", 's'}}};
  if (is_name)
    if (const std::size_t colon = text.rfind(':'); colon != std::string_view::npos)
      text.remove_prefix(colon + 1);
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const unsigned char c = static_cast<unsigned char>(text[i]);
    if (c < 128) {
      if (std::isalnum(c)) result += char(std::tolower(c));
      continue;
    }
    const auto accent =
        std::ranges::find(accents, text.substr(i, 2), &std::pair<std::string_view, char>::first);
    if (accent != accents.end()) result += accent->second, ++i;
  }
  return result;
}

std::optional<int> leading_number(std::string_view text) {
  int value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  return problem == std::errc() ? std::optional(value) : std::nullopt;
}

/// The epoch of a year as registers write it: "1911", "1911-05-03", "~1890", "1890s", "before 1900", "C18",
/// "late C19".
BuildingEpoch epoch_in(std::string_view text) {
  constexpr int first_year = 1006;  // the Dutch register writes 1005 where it knows no year
  constexpr int last_year = 2100;
  for (std::size_t i = 0; i + 4 <= text.size(); ++i) {
    const auto is_digit = [&](std::size_t k) {
      return k < text.size() && std::isdigit(static_cast<unsigned char>(text[k])) != 0;
    };
    if (!is_digit(i) || (i > 0 && is_digit(i - 1))) continue;
    const int year = leading_number(text.substr(i, 4)).value_or(0);
    if (!is_digit(i + 4) && is_digit(i + 3) && year >= first_year && year <= last_year) return epoch_of(year);
  }
  if (const std::size_t century = text.find('C'); century != std::string_view::npos)
    if (const int which = leading_number(text.substr(century + 1)).value_or(0); which > 10 && which < 22) {
      const int offset = text.starts_with("late") ? -15 : text.starts_with("early") ? -85 : -50;
      return epoch_of(100 * which + offset);
    }
  return BuildingEpoch::unknown;
}

/// Codes up to a number, and their use; lists ascend.
struct Codes {
  int last;
  Use use;
};

Use use_in(std::span<const Codes> codes, int code) {
  const auto found = std::ranges::lower_bound(codes, code, {}, &Codes::last);
  return found == codes.end() ? Use::unknown : found->use;
}

// CityGML 2.0, annex C: _AbstractBuilding_function and _usage.
constexpr std::array<Codes, 16> functions{{{999, Use::unknown},
                                           {1020, Use::dwelling},
                                           {1060, Use::unknown},  // dwellings over something else
                                           {1070, Use::dwelling},
                                           {1080, Use::shop},
                                           {1110, Use::dwelling},
                                           {1150, Use::office},
                                           {1200, Use::shop},
                                           {1300, Use::unknown},
                                           {1460, Use::industry},
                                           {1590, Use::shed},
                                           {1600, Use::industry},
                                           {1650, Use::shed},
                                           {1860, Use::industry},
                                           {1950, Use::shed},
                                           {2200, Use::office}}};
constexpr std::array<Codes, 2> churches{{{2200, Use::unknown}, {2280, Use::church}}};
constexpr std::array<Codes, 2> clinics{{{2290, Use::unknown}, {2400, Use::office}}};
// The same annex: _AbstractBuilding_class, for buildings without function and usage.
constexpr std::array<Codes, 15> classes{{{999, Use::unknown},
                                         {1000, Use::dwelling},
                                         {1010, Use::unknown},
                                         {1020, Use::office},
                                         {1030, Use::shop},
                                         {1070, Use::unknown},
                                         {1080, Use::church},
                                         {1090, Use::shed},
                                         {1100, Use::office},
                                         {1110, Use::industry},
                                         {1140, Use::office},
                                         {1150, Use::industry},
                                         {1160, Use::industry},
                                         {1170, Use::shed},
                                         {1180, Use::unknown}}};
// ALKIS, the German register, AX_Gebaeude: the digits after "31001_".
constexpr std::array<Codes, 22> alkis{
    {{999, Use::unknown},   {1099, Use::dwelling}, {1199, Use::unknown},  {1312, Use::dwelling},
     {1313, Use::shed},     {1999, Use::dwelling}, {2000, Use::unknown},  {2019, Use::shop},
     {2049, Use::office},   {2056, Use::shop},     {2060, Use::industry}, {2099, Use::unknown},
     {2299, Use::industry}, {2399, Use::unknown},  {2499, Use::shed},     {2699, Use::industry},
     {2799, Use::shed},     {3038, Use::office},   {3047, Use::church},   {3079, Use::office},
     {3080, Use::unknown},  {3100, Use::office}}};
// PLATEAU of Japan.
constexpr std::array<Codes, 12> plateau{{{400, Use::unknown},
                                         {401, Use::office},
                                         {402, Use::shop},
                                         {403, Use::unknown},
                                         {404, Use::shop},
                                         {412, Use::dwelling},
                                         {414, Use::shop},
                                         {415, Use::unknown},
                                         {422, Use::office},
                                         {431, Use::industry},
                                         {441, Use::industry},
                                         {451, Use::shed}}};
// GKLAS, the Swiss register, after Eurostat's classification of types of constructions.
constexpr std::array<Codes, 13> gklas{{{1109, Use::unknown},
                                       {1130, Use::dwelling},
                                       {1212, Use::unknown},
                                       {1220, Use::office},
                                       {1231, Use::shop},
                                       {1241, Use::unknown},
                                       {1242, Use::shed},
                                       {1252, Use::industry},
                                       {1261, Use::unknown},
                                       {1264, Use::office},
                                       {1265, Use::unknown},
                                       {1271, Use::shed},
                                       {1272, Use::church}}};

struct Stem {
  std::string_view letters;
  Use use;
};
// What words of uses contain, in the order in which they are sought: a "Wohn- und Geschäftshaus" has shops.
constexpr std::array<Stem, 84> stems{{
    {"kirch", Use::church},      {"church", Use::church},      {"chapel", Use::church},
    {"kapelle", Use::church},    {"eglise", Use::church},      {"kerkgebouw", Use::church},
    {"religi", Use::church},     {"iglesia", Use::church},     {"chiesa", Use::church},
    {"kosciol", Use::church},    {"kyrka", Use::church},       {"worship", Use::church},
    {"mosque", Use::church},     {"moschee", Use::church},     {"synagog", Use::church},
    {"cathedral", Use::church},  {"basilica", Use::church},    {"garage", Use::shed},
    {"carport", Use::shed},      {"parking", Use::shed},       {"parkhaus", Use::shed},
    {"schuppen", Use::shed},     {"shed", Use::shed},          {"scheune", Use::shed},
    {"barn", Use::shed},         {"stable", Use::shed},        {"cowshed", Use::shed},
    {"stallgeb", Use::shed},     {"annexe", Use::shed},        {"berging", Use::shed},
    {"gartenhaus", Use::shed},   {"greenhouse", Use::shed},    {"treibhaus", Use::shed},
    {"agricol", Use::shed},      {"agricultur", Use::shed},    {"landwirt", Use::shed},
    {"retail", Use::shop},       {"shop", Use::shop},          {"winkel", Use::shop},
    {"kaufhaus", Use::shop},     {"einkauf", Use::shop},       {"geschaft", Use::shop},
    {"geschaeft", Use::shop},    {"handel", Use::shop},        {"commerc", Use::shop},
    {"store", Use::shop},        {"magasin", Use::shop},       {"supermar", Use::shop},
    {"kiosk", Use::shop},        {"office", Use::office},      {"burogeb", Use::office},
    {"buerogeb", Use::office},   {"kantoor", Use::office},     {"bureau", Use::office},
    {"verwaltung", Use::office}, {"administra", Use::office},  {"government", Use::office},
    {"school", Use::office},     {"schule", Use::office},      {"ecole", Use::office},
    {"education", Use::office},  {"onderwijs", Use::office},   {"universit", Use::office},
    {"hospital", Use::office},   {"krankenhaus", Use::office}, {"gezondheid", Use::office},
    {"publicserv", Use::office}, {"industr", Use::industry},   {"factory", Use::industry},
    {"fabrik", Use::industry},   {"usine", Use::industry},     {"werkstatt", Use::industry},
    {"workshop", Use::industry}, {"warehouse", Use::industry}, {"lagerhal", Use::industry},
    {"lagergeb", Use::industry}, {"hangar", Use::industry},    {"gewerbe", Use::industry},
    {"wohn", Use::dwelling},     {"woon", Use::dwelling},      {"resid", Use::dwelling},
    {"dwelling", Use::dwelling}, {"vivienda", Use::dwelling},  {"detached", Use::dwelling},
}};

Use use_in_words(std::string_view text) {
  const std::string words = plain(text, false);
  for (const Stem& stem : stems)
    if (words.find(stem.letters) != std::string::npos) return stem.use;
  return Use::unknown;
}

/// The use of a code that stands alone or behind its list's number or address: "1120", "31001_2020",
/// ".../codes/1000".
Use use_in_value(const std::string& text, bool is_class) {
  const std::size_t last = text.find_last_not_of("0123456789");
  const std::string_view digits = std::string_view(text).substr(last == std::string::npos ? 0 : last + 1);
  const std::string_view before = std::string_view(text).substr(0, text.size() - digits.size());
  const int code = leading_number(digits).value_or(0);
  if (before.ends_with("31001_")) return use_in(alkis, code);
  if (before.ends_with("51009_")) return Use::shed;  // ALKIS: roofs on posts, silos, towers
  if (before.empty() || before.ends_with('/') || before.ends_with('#')) {
    if (digits.size() == 3) return use_in(plateau, code);
    if (digits.size() == 4) {
      if (is_class) return use_in(classes, code);
      for (const std::span<const Codes> list :
           {std::span<const Codes>(functions), std::span<const Codes>(churches),
            std::span<const Codes>(clinics)})
        if (const Use use = use_in(list, code); use != Use::unknown) return use;
      return Use::unknown;
    }
  }
  return use_in_words(text);
}

std::uint8_t storeys_in(std::string_view text) {
  constexpr int max_storeys = 200;
  const int storeys = leading_number(text).value_or(0);
  return storeys > 0 && storeys <= max_storeys ? std::uint8_t(storeys) : std::uint8_t(0);
}

struct Colour {
  std::string_view name;
  WallTint tint;
  int srgb;
};
// Names of CSS and of mappers.
constexpr std::array<Colour, 28> colours{
    {{"white", WallTint::white, 0xFFFFFF},    {"snow", WallTint::white, 0xFFFAFA},
     {"ivory", WallTint::white, 0xFFFFF0},    {"whitesmoke", WallTint::white, 0xF5F5F5},
     {"silver", WallTint::grey, 0xC0C0C0},    {"lightgrey", WallTint::grey, 0xD3D3D3},
     {"lightgray", WallTint::grey, 0xD3D3D3}, {"grey", WallTint::grey, 0x808080},
     {"gray", WallTint::grey, 0x808080},      {"darkgrey", WallTint::dark, 0x606060},
     {"darkgray", WallTint::dark, 0x606060},  {"black", WallTint::dark, 0x1C1C1C},
     {"dimgray", WallTint::dark, 0x696969},   {"beige", WallTint::yellow, 0xF5F5DC},
     {"yellow", WallTint::yellow, 0xE8D060},  {"cream", WallTint::yellow, 0xFFFDD0},
     {"khaki", WallTint::yellow, 0xF0E68C},   {"wheat", WallTint::yellow, 0xF5DEB3},
     {"tan", WallTint::yellow, 0xD2B48C},     {"orange", WallTint::yellow, 0xE0903C},
     {"red", WallTint::red, 0xA83A30},        {"pink", WallTint::red, 0xF0B8BC},
     {"salmon", WallTint::red, 0xFA8072},     {"maroon", WallTint::brown, 0x6A2822},
     {"brown", WallTint::brown, 0x7A4A32},    {"sienna", WallTint::brown, 0xA0522D},
     {"green", WallTint::green, 0x4E8A5C},    {"blue", WallTint::blue, 0x4468A0}}};

glm::vec3 srgb_of(int hex) { return glm::vec3(hex >> 16, (hex >> 8) & 255, hex & 255) / 255.0f; }

/// The colour of "fff", "b04030".
std::optional<glm::vec3> rgb_of_hex(std::string_view digits) {
  const std::size_t each = digits.size() == 3 ? 1 : 2;
  if (digits.size() != 3 * each) return std::nullopt;
  glm::vec3 rgb(0.0f);
  for (std::size_t i = 0; i < 3; ++i) {
    unsigned value = 0;
    const char* begin = digits.data() + each * i;
    if (std::from_chars(begin, begin + each, value, 16).ptr != begin + each) return std::nullopt;
    rgb[int(i)] = float(value) / (each == 1 ? 15.0f : 255.0f);
  }
  return rgb;
}

/// The class of a colour by its lightness and hue.
WallTint tint_of(glm::vec3 rgb) {
  const float high = std::max({rgb.x, rgb.y, rgb.z}), low = std::min({rgb.x, rgb.y, rgb.z});
  if (high < 0.3f) return WallTint::dark;
  if (high - low < 0.12f * high) return high > 0.85f ? WallTint::white : WallTint::grey;
  if (rgb.x == high) {
    const float to_yellow = (rgb.y - rgb.z) / (high - low);  // 0: red, 1: yellow
    if (to_yellow > 0.5f) return high > 0.55f ? WallTint::yellow : WallTint::brown;
    return high > 0.55f ? WallTint::red : WallTint::brown;
  }
  return rgb.y == high ? WallTint::green : WallTint::blue;
}

const Colour* named_colour(std::string_view name) {
  const auto found = std::ranges::find(colours, name, &Colour::name);
  return found == colours.end() ? nullptr : &*found;
}

/// A colour with a word before it: "light_green".
struct Shade {
  std::string_view word;
  float to_white;  ///< negative: to black
};
constexpr std::array<Shade, 3> shades{{{"light", 0.45f}, {"dark", -0.4f}, {"pale", 0.6f}}};

/// A colour that a value names.
struct FoundColour {
  WallTint tint;
  glm::vec3 srgb;
};

std::optional<FoundColour> found_colour(const std::string& text) {
  if (text.starts_with('#')) {
    const std::optional<glm::vec3> rgb = rgb_of_hex(std::string_view(text).substr(1));
    return rgb ? std::optional(FoundColour{tint_of(*rgb), *rgb}) : std::nullopt;
  }
  const std::string name = plain(text, false);
  if (const Colour* colour = named_colour(name)) return FoundColour{colour->tint, srgb_of(colour->srgb)};
  for (const Shade& shade : shades)
    if (name.starts_with(shade.word))
      if (const Colour* base = named_colour(std::string_view(name).substr(shade.word.size())))
        return FoundColour{base->tint,
                           glm::mix(srgb_of(base->srgb), glm::vec3(shade.to_white > 0.0f ? 1.0f : 0.0f),
                                    std::abs(shade.to_white))};
  return std::nullopt;
}

WallTint tint_in(const std::string& text) {
  const std::optional<FoundColour> found = found_colour(text);
  return found ? found->tint : WallTint::unknown;
}

/// The first of some tags that is there.
const std::string& first_tag(const OsmTags& tags, std::initializer_list<const char*> keys) {
  for (const char* key : keys)
    if (const std::string& value = tag(tags, key); !value.empty()) return value;
  static const std::string none;
  return none;
}

WallFinish finish_in(const std::string& text) {
  constexpr std::array<std::pair<std::string_view, WallFinish>, 14> finishes{{
      {"brick", WallFinish::brick},
      {"plaster", WallFinish::plaster},
      {"stucco", WallFinish::plaster},
      {"render", WallFinish::plaster},
      {"sandstone", WallFinish::stone},
      {"limestone", WallFinish::stone},
      {"stone", WallFinish::stone},
      {"granite", WallFinish::stone},
      {"concrete", WallFinish::concrete},
      {"cement", WallFinish::concrete},
      {"metal", WallFinish::metal},
      {"steel", WallFinish::metal},
      {"timber", WallFinish::wood},
      {"wood", WallFinish::wood},
  }};
  const std::string words = plain(text, false);
  for (const auto& [word, finish] : finishes)
    if (words.find(word) != std::string::npos) return finish;
  return WallFinish::unknown;
}

Use use_of(const OsmTags& tags) {
  const auto is_given = [&](const char* key) { return !tag(tags, key).empty() && tag(tags, key) != "no"; };
  const std::string& building = tag(tags, is_given("building") ? "building" : "building:part");
  if (tag(tags, "amenity") == "place_of_worship") return Use::church;
  if (is_given("shop")) return Use::shop;
  // Whole words; other words are sought for their stems.
  constexpr std::array<std::pair<std::string_view, Use>, 34> words{{
      {"house", Use::dwelling},
      {"terrace", Use::dwelling},
      {"bungalow", Use::dwelling},
      {"farm", Use::dwelling},
      {"villa", Use::dwelling},
      {"cabin", Use::dwelling},
      {"apartments", Use::unknown},
      {"hut", Use::shed},
      {"service", Use::shed},
      {"roof", Use::shed},
      {"farm_auxiliary", Use::shed},
      {"sty", Use::shed},
      {"commercial", Use::office},
      {"civic", Use::office},
      {"public", Use::office},
      {"kindergarten", Use::office},
      {"college", Use::office},
      {"townhall", Use::office},
      {"clinic", Use::office},
      {"library", Use::office},
      {"public_building", Use::office},
      {"shrine", Use::church},
      {"temple", Use::church},
      {"monastery", Use::dwelling},
      {"restaurant", Use::shop},
      {"cafe", Use::shop},
      {"bar", Use::shop},
      {"pub", Use::shop},
      {"bank", Use::shop},
      {"pharmacy", Use::shop},
      {"fast_food", Use::shop},
      {"manufacture", Use::industry},
      {"hangar", Use::industry},
      {"transformer_tower", Use::industry},
  }};
  for (const std::string& value : {building, tag(tags, "amenity"), tag(tags, "building:use")}) {
    const auto whole = std::ranges::find(words, value, &std::pair<std::string_view, Use>::first);
    const Use use = whole != words.end() ? whole->second : use_in_words(value);
    if (use != Use::unknown) return use;
  }
  if (is_given("office")) return Use::office;
  return use_in_words(tag(tags, "man_made") + ' ' + tag(tags, "landuse"));
}

}  // namespace

BuildingKind kind_of_building(const BuildingAttributes& attributes) {
  BuildingAttributes by_name;
  for (const auto& [name, value] : attributes) by_name.emplace(plain(name, true), value);
  const auto value_of = [&](std::string_view name) {
    const auto found = by_name.find(std::string(name));
    return found == by_name.end() ? std::string() : found->second;
  };
  BuildingKind kind;
  for (const std::string_view name : year_names)
    if (kind.epoch == BuildingEpoch::unknown) kind.epoch = epoch_in(value_of(name));
  for (const std::string_view name : use_names)
    if (kind.use == Use::unknown) kind.use = use_in_value(value_of(name), name == "class");
  if (kind.use == Use::unknown) kind.use = use_in(gklas, leading_number(value_of(register_name)).value_or(0));
  for (const std::string_view name : storey_names)
    if (kind.storeys == 0) kind.storeys = storeys_in(value_of(name));
  return kind;
}

BuildingKind kind_of_osm_building(const OsmTags& tags) {
  BuildingKind kind;
  kind.use = use_of(tags);
  kind.epoch = epoch_in(tag(tags, "start_date"));
  kind.storeys = storeys_in(tag(tags, "building:levels"));
  kind.finish = finish_in(first_tag(
      tags, {"building:material", "building:facade:material", "facade:material", "building:cladding"}));
  kind.tint = tint_in(first_tag(tags, {"building:colour", "building:color", "building:facade:colour"}));
  return kind;
}

std::optional<glm::vec3> colour_in(const std::string& text) {
  const std::optional<FoundColour> found = found_colour(text);
  return found ? std::optional(found->srgb) : std::nullopt;
}

}  // namespace parvis::scene
