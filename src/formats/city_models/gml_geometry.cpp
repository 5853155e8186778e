#include "formats/city_models/gml_geometry.h"

#include <expat.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "formats/city_models/xml_pieces.h"

namespace parvis::scene {
namespace {

constexpr int deepest_reference = 8;  // a surface that refers to itself would go on for ever

/// An element of which something may have to be written otherwise.
struct GmlElement {
  std::string name;                  ///< without its prefix
  std::size_t begin = 0, inner = 0;  ///< where its first tag begins, and ends
  std::size_t inner_end = 0, end = 0;
  bool is_reversed = false;          ///< of an OrientableSurface
  std::string reference;             ///< of the base surface of one, to an element elsewhere; without '#'
  bool needs_list = false;           ///< a ring that is no list of positions in three dimensions
  std::vector<std::string> numbers;  ///< of a ring, three a point, as the file writes them
};

/// An open element: the form of the positions where the parser is.
struct GmlOpen {
  std::string name;
  std::size_t dimensions = 3;
  std::size_t element = 0;  ///< index, or none
};

std::string_view local_name(std::string_view name) {
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

class GmlGeometry {
 public:
  explicit GmlGeometry(const std::string& xml) : xml_(xml) {}

  bool read() {
    const std::unique_ptr<std::remove_pointer_t<XML_Parser>, void (*)(XML_Parser)> parser(
        XML_ParserCreate(nullptr), XML_ParserFree);
    parser_ = parser.get();
    XML_SetUserData(parser_, this);
    XML_SetElementHandler(
        parser_,
        [](void* self, const char* name, const char** attributes) {
          static_cast<GmlGeometry*>(self)->start(local_name(name), attributes);
        },
        [](void* self, const char* name) { static_cast<GmlGeometry*>(self)->finish(local_name(name)); });
    XML_SetCharacterDataHandler(parser_, [](void* self, const char* text, int length) {
      GmlGeometry& geometry = *static_cast<GmlGeometry*>(self);
      if (geometry.takes_text_) geometry.text_.append(text, std::size_t(length));
    });
    return parse_in_pieces(parser_, xml_);
  }

  std::string written() const {
    std::string text;
    text.reserve(xml_.size() + xml_.size() / 8);
    write(0, xml_.size(), false, 0, text);
    return text;
  }

 private:
  static constexpr std::size_t none = ~std::size_t(0);

  void start(std::string_view name, const char** attributes) {
    const auto begin = std::size_t(XML_GetCurrentByteIndex(parser_));
    GmlOpen open{std::string(name), open_.empty() ? 3 : open_.back().dimensions, none};
    std::string id, reference;
    bool is_reversed = false;
    decimal_ = ".", cs_ = ",", ts_ = " ";
    for (; *attributes; attributes += 2) {
      const std::string_view key = local_name(attributes[0]), value(attributes[1]);
      if (key == "srsDimension") open.dimensions = value == "2" ? 2 : 3;
      if (key == "id") id = value;
      if (key == "href" && value.starts_with('#')) reference = value.substr(1);
      if (key == "orientation") is_reversed = value == "-";
      if (key == "decimal") decimal_ = value;
      if (key == "cs") cs_ = value;
      if (key == "ts") ts_ = value;
    }
    const bool is_ring = name == "LinearRing", is_oriented = name == "OrientableSurface";
    if (is_ring || is_oriented || !id.empty()) {
      open.element = elements_.size();
      GmlElement& element = elements_.emplace_back();
      element.name = name;
      element.begin = begin, element.inner = begin + std::size_t(XML_GetCurrentByteCount(parser_));
      element.is_reversed = is_oriented && is_reversed;
      if (!id.empty()) by_id_.emplace(id, open.element);
      if (is_ring) ring_ = open.element;
    }
    if (name == "baseSurface" && !reference.empty() && !open_.empty() && open_.back().element != none)
      elements_[open_.back().element].reference = reference;
    takes_text_ = ring_ != none && (name == "posList" || name == "pos" || name == "coordinates" ||
                                    (!open_.empty() && open_.back().name == "coord"));
    text_.clear();
    open_.push_back(std::move(open));
  }

  void finish(std::string_view name) {
    const GmlOpen open = std::move(open_.back());
    open_.pop_back();
    if (takes_text_) take_positions(name, open.dimensions);
    takes_text_ = false;
    if (name == "coord" && ring_ != none) {  // an element for each number
      GmlElement& ring = elements_[ring_];
      ring.needs_list = true;
      ring.numbers.resize((ring.numbers.size() + 2) / 3 * 3, "0");
    }
    if (open.element == none) return;
    GmlElement& element = elements_[open.element];
    element.inner_end = std::size_t(XML_GetCurrentByteIndex(parser_));
    element.end = element.inner_end + std::size_t(XML_GetCurrentByteCount(parser_));
    if (ring_ == open.element) ring_ = none;
  }

  void take_positions(std::string_view name, std::size_t dimensions) {
    GmlElement& ring = elements_[ring_];
    const bool is_list_of_tuples = name == "coordinates";
    ring.needs_list = ring.needs_list || is_list_of_tuples || dimensions == 2 ||
                      (!open_.empty() && open_.back().name == "Point");
    std::string_view rest = text_;
    const std::string white_space = " \t\r\n";
    const auto next = [&](std::string_view& from, const std::string& separators) {
      const std::size_t begin = std::min(from.find_first_not_of(separators), from.size());
      from.remove_prefix(begin);
      const std::size_t end = std::min(from.find_first_of(separators), from.size());
      std::string word(from.substr(0, end));
      from.remove_prefix(end);
      return word;
    };
    const auto add = [&](std::string number) {
      if (decimal_ != "." && decimal_.size() == 1) std::ranges::replace(number, decimal_[0], '.');
      ring.numbers.push_back(std::move(number));
    };
    if (!is_list_of_tuples) {
      std::size_t count = 0;
      for (std::string word = next(rest, white_space); !word.empty(); word = next(rest, white_space)) {
        add(word);
        if (++count % dimensions == 0 && dimensions == 2) ring.numbers.emplace_back("0");
      }
      return;
    }
    const std::string between_tuples = ts_ == " " ? white_space : ts_;
    for (std::string tuple = next(rest, between_tuples); !tuple.empty(); tuple = next(rest, between_tuples)) {
      std::string_view of_tuple = tuple;
      std::size_t count = 0;
      for (std::string word = next(of_tuple, cs_ + white_space); !word.empty() && count < 3; ++count)
        add(word), word = next(of_tuple, cs_ + white_space);
      for (; count > 0 && count < 3; ++count) ring.numbers.emplace_back("0");
    }
  }

  /// The text from `from` to `to`, with rings turned where `flipped`; a copy has no ids of its own.
  void write(std::size_t from, std::size_t to, bool flipped, int depth, std::string& text) const {
    auto element = std::ranges::lower_bound(elements_, from, {}, &GmlElement::begin);
    const auto copy = [&](std::size_t end) {
      const std::size_t begin = text.size();
      text.append(xml_, from, end - from);
      if (depth > 0) erase_ids(begin, text);
      from = end;
    };
    for (; element != elements_.end() && element->begin < to; ++element) {
      if (element->begin < from) continue;
      const bool is_turned = flipped != element->is_reversed;
      if (element->name == "LinearRing" && (element->needs_list || flipped)) {
        copy(element->inner);
        write_ring(*element, flipped, text);
        from = element->inner_end;
      } else if (element->name == "OrientableSurface" && is_turned) {
        copy(element->begin);
        const auto target = by_id_.find(element->reference);
        if (!element->reference.empty() && target != by_id_.end() && depth < deepest_reference) {
          write(elements_[target->second].begin, elements_[target->second].end, true, depth + 1, text);
        } else {
          write(element->inner, element->inner_end, true, depth, wrapped(*element, text));
          text.append(xml_, element->inner_end, element->end - element->inner_end);
        }
        from = element->end;
      } else if (element->name == "OrientableSurface" && element->is_reversed) {  // turned twice
        copy(element->begin);
        write(element->inner, element->inner_end, false, depth, wrapped(*element, text));
        text.append(xml_, element->inner_end, element->end - element->inner_end);
        from = element->end;
      }
    }
    if (from < to) copy(to);
  }

  /// The text with the first tag of an element.
  std::string& wrapped(const GmlElement& element, std::string& text) const {
    return text.append(xml_, element.begin, element.inner - element.begin);
  }

  void write_ring(const GmlElement& ring, bool flipped, std::string& text) const {
    const std::string_view tag = std::string_view(xml_).substr(ring.begin + 1, ring.inner - ring.begin - 1);
    const std::size_t colon = tag.find(':'), name_end = tag.find_first_of(" \t\r\n>/");
    const std::string prefix(colon < name_end ? tag.substr(0, colon + 1) : std::string_view());
    text += '<' + prefix + "posList>";
    const std::size_t points = ring.numbers.size() / 3;
    for (std::size_t i = 0; i < points; ++i)
      for (std::size_t k = 0; k < 3; ++k) text += ring.numbers[3 * (flipped ? points - 1 - i : i) + k] + ' ';
    text += "</" + prefix + "posList>";
  }

  /// Erases the identifiers of a copy, which is no other element of the same name.
  static void erase_ids(std::size_t from, std::string& text) {
    for (std::size_t at = text.find(":id=", from); at != std::string::npos; at = text.find(":id=", at)) {
      const std::size_t begin = text.find_last_of(" \t\r\n", at);
      const std::size_t quote = at + 4 < text.size() ? at + 4 : at;
      const std::size_t end = text.find(text[quote], quote + 1);
      if (begin == std::string::npos || begin < from || end == std::string::npos) return;
      text.erase(begin, end + 1 - begin);
      at = begin;
    }
  }

  const std::string& xml_;
  XML_Parser parser_ = nullptr;
  std::vector<GmlElement> elements_;  ///< by their beginnings
  std::unordered_map<std::string, std::size_t> by_id_;
  std::vector<GmlOpen> open_;
  std::size_t ring_ = none;  ///< that is open
  bool takes_text_ = false;
  std::string text_, decimal_, cs_, ts_;
};

}  // namespace

std::string plain_gml_geometry(std::string xml) {
  const auto has = [&](std::string_view words) { return xml.find(words) != std::string::npos; };
  const bool is_plain = !has("OrientableSurface") && !has(":coordinates") && !has("<coordinates") &&
                        !has("srsDimension=\"2\"") && !has("srsDimension='2'") && !has("pointProperty") &&
                        !has("pointRep") && !has(":coord>") && !has("<coord>");
  if (is_plain) return xml;
  GmlGeometry geometry(xml);
  return geometry.read() ? geometry.written() : xml;
}

}  // namespace parvis::scene
