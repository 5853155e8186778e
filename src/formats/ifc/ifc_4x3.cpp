#include "formats/ifc/ifc_4x3.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <vector>

namespace parvis::scene {
namespace {

/// Entities with a shape, or that hold others, which IFC 4X3 added (ISO 16739-1:2024, annex on changes).
constexpr std::array<std::string_view, 47> added{{"IFCALIGNMENT",
                                                  "IFCBEARING",
                                                  "IFCBOREHOLE",
                                                  "IFCBRIDGE",
                                                  "IFCBRIDGEPART",
                                                  "IFCBUILTELEMENT",
                                                  "IFCBUILTSYSTEM",
                                                  "IFCCAISSONFOUNDATION",
                                                  "IFCCONVEYORSEGMENT",
                                                  "IFCCOURSE",
                                                  "IFCDEEPFOUNDATION",
                                                  "IFCDIRECTRIXDERIVEDREFERENCESWEPTAREASOLID",
                                                  "IFCDISTRIBUTIONBOARD",
                                                  "IFCEARTHWORKSCUT",
                                                  "IFCEARTHWORKSELEMENT",
                                                  "IFCEARTHWORKSFILL",
                                                  "IFCELECTRICFLOWTREATMENTDEVICE",
                                                  "IFCFACILITY",
                                                  "IFCFACILITYPARTCOMMON",
                                                  "IFCGEOMODEL",
                                                  "IFCGEOSLICE",
                                                  "IFCGEOTECHNICALSTRATUM",
                                                  "IFCGRADIENTCURVE",
                                                  "IFCIMPACTPROTECTIONDEVICE",
                                                  "IFCKERB",
                                                  "IFCLINEARELEMENT",
                                                  "IFCLIQUIDTERMINAL",
                                                  "IFCMARINEFACILITY",
                                                  "IFCMARINEPART",
                                                  "IFCMOBILETELECOMMUNICATIONSAPPLIANCE",
                                                  "IFCMOORINGDEVICE",
                                                  "IFCNAVIGATIONELEMENT",
                                                  "IFCPAVEMENT",
                                                  "IFCRAIL",
                                                  "IFCRAILWAY",
                                                  "IFCREFERENT",
                                                  "IFCREINFORCEDSOIL",
                                                  "IFCROAD",
                                                  "IFCSECTIONEDSOLIDHORIZONTAL",
                                                  "IFCSECTIONEDSURFACE",
                                                  "IFCSEGMENTEDREFERENCECURVE",
                                                  "IFCSIGN",
                                                  "IFCSIGNAL",
                                                  "IFCTENDONCONDUIT",
                                                  "IFCTRACKELEMENT",
                                                  "IFCTRIANGULATEDIRREGULARNETWORK",
                                                  "IFCVEHICLE"}};
static_assert(std::ranges::is_sorted(added), "they are found by halving");
constexpr std::string_view blanks = " \t\r\n";

/// Where the next attribute of an entity begins, behind a comma on the entity's own level; nothing where the
/// entity ends. `at` is the beginning of an attribute.
std::optional<std::size_t> next_attribute(std::string_view text, std::size_t at) {
  bool is_text = false;
  for (int depth = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '\'') is_text = !is_text;
    if (is_text) continue;
    if (c == '(') ++depth;
    if (c == ')' && --depth < 0) return std::nullopt;
    if (c == ',' && depth == 0) return at + 1;
  }
  return std::nullopt;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string_view::npos ? std::string_view() : text.substr(first);
}

/// Exchanges the second and the third attribute of the faces whose attributes begin at `first`, where the
/// second says whether they are closed, or the third is a list of normals.
void reorder(std::string& text, std::size_t first) {
  const auto second = next_attribute(text, first);
  const auto third = second ? next_attribute(text, *second) : std::nullopt;
  const auto fourth = third ? next_attribute(text, *third) : std::nullopt;
  if (!fourth) return;
  const std::string closed = text.substr(*second, *third - *second - 1),
                    normals = text.substr(*third, *fourth - *third - 1);
  const bool is_new_order = trimmed(closed).starts_with('.') || trimmed(normals).starts_with('(');
  if (is_new_order) text.replace(*second, *fourth - *second - 1, normals + "," + closed);
}

/// Writes a move onto a map (IfcRigidOperation), and one whose axes have factors, as the conversion that IFC
/// 4 has.
void rename_map_operations(std::string& text) {
  constexpr std::string_view conversion = "IFCMAPCONVERSION", measure = "IFCLENGTHMEASURE(";
  for (const std::string_view name :
       {std::string_view("IFCRIGIDOPERATION"), std::string_view("IFCMAPCONVERSIONSCALED")})
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
      const std::size_t open = text.find_first_not_of(blanks, at + name.size());
      if (open == std::string::npos || text[open] != '(') continue;
      std::vector<std::string> attributes;
      std::size_t begin = open + 1;
      for (auto next = next_attribute(text, begin); next; next = next_attribute(text, begin))
        attributes.push_back(text.substr(begin, *next - 1 - begin)), begin = *next;
      const std::size_t end = text.find(')', begin);  // the last attribute is a number or the height
      if (end == std::string::npos) return;
      attributes.push_back(text.substr(begin, end - begin));
      const bool is_rigid = name == "IFCRIGIDOPERATION";
      if (attributes.size() < (is_rigid ? 5U : 8U)) continue;
      for (std::string& attribute : attributes)
        if (const std::string_view value = trimmed(attribute); value.starts_with(measure))
          attribute = value.substr(measure.size(), value.find(')') - measure.size());
      attributes.resize(is_rigid ? 5 : 8);
      if (is_rigid) attributes.resize(8, "$");
      text.replace(at, end - at, fmt::format("{}({}", conversion, fmt::join(attributes, ",")));
    }
}

/// IFC++ reads no entity of a schema whose name it does not know.
void rename_schema(std::string& text) {
  constexpr std::string_view newer = "'IFC4X3", older = "'IFC4'";
  const std::size_t header = text.find("FILE_SCHEMA"), end = text.find(';', header);
  const std::size_t begin = header == std::string::npos ? header : text.find(newer, header);
  if (begin == std::string::npos || begin > end) return;
  const std::size_t quote = text.find('\'', begin + 1);
  if (quote != std::string::npos) text.replace(begin, quote + 1 - begin, older);
}

}  // namespace

std::string schema_of_ifc(std::string_view text) {
  constexpr std::size_t longest = 200;
  const std::size_t schema = text.find("FILE_SCHEMA");
  if (schema == std::string_view::npos) return "";
  return std::string(text.substr(schema, std::min(text.find(';', schema) - schema, longest)));
}

std::string kinds_beyond_ifc_4(std::string_view text) {
  std::array<std::size_t, added.size()> counts{};
  // Instances are "#12=IFCPAVEMENT(": names in texts have no '=' before them, but for some that mean to.
  for (std::size_t at = text.find('='); at != std::string_view::npos; at = text.find('=', at + 1)) {
    const std::size_t begin = text.find_first_not_of(blanks, at + 1);
    if (begin == std::string_view::npos) break;
    std::size_t end = begin;
    while (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '_'))
      ++end;
    const auto found = std::ranges::lower_bound(added, text.substr(begin, end - begin));
    if (found != added.end() && *found == text.substr(begin, end - begin))
      ++counts[std::size_t(found - added.begin())];
  }
  std::string list;
  for (std::size_t i = 0; i < added.size(); ++i)
    if (counts[i] > 0) list += fmt::format("{}{} {}", list.empty() ? "" : ", ", counts[i], added[i]);
  return list;
}

std::string ifc_4_of_4x3(std::string text) {
  rename_schema(text);
  constexpr std::string_view faces = "IFCTRIANGULATEDFACESET";
  for (std::size_t at = text.find(faces); at != std::string::npos; at = text.find(faces, at + faces.size())) {
    const std::size_t open = text.find_first_not_of(blanks, at + faces.size());
    if (open != std::string::npos && text[open] == '(') reorder(text, open + 1);
  }
  rename_map_operations(text);
  return text;
}

}  // namespace parvis::scene
