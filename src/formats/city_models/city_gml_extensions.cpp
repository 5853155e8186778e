#include "formats/city_models/city_gml_extensions.h"

#include <expat.h>

#include <algorithm>
#include <memory>
#include <string_view>
#include <vector>

#include "formats/city_models/xml_pieces.h"

namespace parvis::scene {
namespace {

constexpr std::string_view generics_2 = "http://www.opengis.net/citygml/generics/2.0",
                           generics_3 = "http://www.opengis.net/citygml/generics/3.0",
                           version_3 = "http://www.opengis.net/citygml/3.0";

/// CityGML, GML, addresses, X3D and the rest that CityGML itself is written with.
bool is_of_city_gml(std::string_view uri) {
  for (const std::string_view known : {"http://www.opengis.net/", "http://www.citygml.org/citygml/1/",
                                       "http://www.w3.org/", "urn:oasis:", "http://www.web3d.org/"})
    if (uri.starts_with(known)) return true;
  return uri.empty();
}

/// A text that takes the place of a part of the file.
struct Replacement {
  std::size_t begin = 0, end = 0;
  std::string text;
};

class GmlExtensions {
 public:
  GmlExtensions(const std::string& xml, FileAccount account) : xml_(xml), account_(std::move(account)) {}

  bool read() {
    const std::unique_ptr<std::remove_pointer_t<XML_Parser>, void (*)(XML_Parser)> parser(
        XML_ParserCreateNS(nullptr, '\n'), XML_ParserFree);
    parser_ = parser.get();
    XML_SetUserData(parser_, this);
    XML_SetElementHandler(
        parser_,
        [](void* self, const char* name, const char**) { static_cast<GmlExtensions*>(self)->start(name); },
        [](void* self, const char*) { static_cast<GmlExtensions*>(self)->finish(); });
    return parse_in_pieces(parser_, xml_);
  }

  const FileAccount& account() const { return account_; }

  std::string written() const {
    std::string text;
    text.reserve(xml_.size());
    std::size_t from = 0;
    for (const Replacement& replacement : replacements_) {
      text.append(xml_, from, replacement.begin - from);
      text += replacement.text;
      from = replacement.end;
    }
    return text.append(xml_, from);
  }

 private:
  enum class Role : unsigned char { plain, member, renamed, erased };
  struct Element {
    Role role = Role::plain;
    std::size_t begin = 0;
    std::string name = {};  ///< of an extension's
    bool is_blank = true;   ///< no element is left in it
    bool has_lost = false;  ///< elements that stood in it
  };

  void start(std::string_view name) {
    const std::size_t colon = name.find('\n');
    const std::string_view uri = colon == std::string_view::npos ? "" : name.substr(0, colon);
    const std::string_view local = colon == std::string_view::npos ? name : name.substr(colon + 1);
    if (open_.empty() && uri == version_3) generics_ = generics_3;
    if (erased_ > 0) {
      ++erased_;
      polygons_ += local == "Polygon" || local == "Triangle";
      return;
    }
    const bool is_member = !open_.empty() && open_.back().role == Role::member;
    Element element{Role::plain, std::size_t(XML_GetCurrentByteIndex(parser_))};
    if (local == "cityObjectMember" || local == "featureMember" || local == "groupMember") {
      element.role = Role::member;
    } else if (!open_.empty() && !is_of_city_gml(uri)) {
      element.name = local;
      if (is_member) {
        element.role = Role::renamed;
        rename(element.begin);
      } else {
        element.role = Role::erased;
        erased_ = 1, polygons_ = 0;
      }
    }
    open_.push_back(std::move(element));
  }

  void finish() {
    if (erased_ > 1) return void(--erased_);
    const Element element = std::move(open_.back());
    open_.pop_back();
    // Of a tag that is both first and last expat reports an end without length, behind it.
    const auto last_tag = std::size_t(XML_GetCurrentByteIndex(parser_));
    const auto length = std::size_t(XML_GetCurrentByteCount(parser_));
    if (element.role == Role::erased) {
      erased_ = 0;
      erase(element.begin, last_tag + length);
      account_.left_out("elements of extensions", "they are no part of CityGML", element.name);
      account_.left_out("polygons of extensions", "what they belong to is no part of CityGML", element.name,
                        polygons_);
      return;
    }
    // libcitygml takes no property without the object that it is for.
    const bool is_empty_member = element.role == Role::member && element.is_blank;
    if (!open_.empty() &&
        (is_empty_member || (element.has_lost && element.is_blank && element.role == Role::plain)))
      return erase(element.begin, last_tag + length);
    if (!open_.empty()) open_.back().is_blank = false;
    if (element.role == Role::renamed) {
      if (length > 0) replacements_.push_back({last_tag, last_tag + length, "</gen:GenericCityObject>"});
      account_.changed("city objects", "kinds of extensions are shown by their geometry alone", element.name);
    }
  }

  /// Erases an element of the one that is open, with what was replaced in it.
  void erase(std::size_t begin, std::size_t end) {
    while (!replacements_.empty() && replacements_.back().begin >= begin) replacements_.pop_back();
    replacements_.push_back({begin, end, ""});
    open_.back().has_lost = true;
  }

  /// Makes the first tag that begins at `begin` that of a generic city object. Its attributes stay as they
  /// are written, for they may declare namespaces.
  void rename(std::size_t begin) {
    const std::size_t name_end = std::min(xml_.find_first_of(" \t\r\n/>", begin), xml_.size());
    replacements_.push_back(
        {begin, name_end, fmt::format("<gen:GenericCityObject xmlns:gen=\"{}\"", generics_)});
  }

  const std::string& xml_;
  FileAccount account_;
  XML_Parser parser_ = nullptr;
  std::string_view generics_ = generics_2;
  std::vector<Element> open_;
  std::vector<Replacement> replacements_;  ///< in the order of the text
  int erased_ = 0;                         ///< elements that are open within one that is erased, and itself
  std::size_t polygons_ = 0;               ///< within it
};

/// Whether a namespace of others is declared, or a member refers to what stands elsewhere.
bool may_have_extensions(std::string_view xml) {
  for (const std::string_view reference : {"Member xlink:href", "Member/>", "Member></"})
    if (xml.find(reference) != std::string_view::npos) return true;
  constexpr std::string_view attribute = "xmlns";
  for (std::size_t at = xml.find(attribute); at != std::string_view::npos; at = xml.find(attribute, at + 1)) {
    const std::size_t quote = xml.find_first_of("\"'", at);
    if (quote != std::string_view::npos &&
        !is_of_city_gml(xml.substr(quote + 1, xml.find(xml[quote], quote + 1) - quote - 1)))
      return true;
  }
  return false;
}

}  // namespace

std::string without_gml_extensions(std::string xml, FileAccount& account) {
  const bool is_utf_16 = xml.starts_with("\xfe\xff") || xml.starts_with("\xff\xfe");
  if (is_utf_16 || !may_have_extensions(xml)) return xml;
  GmlExtensions extensions(xml, account);
  if (!extensions.read()) return xml;
  account = extensions.account();
  return extensions.written();
}

}  // namespace parvis::scene
