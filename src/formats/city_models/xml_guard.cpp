#include "formats/city_models/xml_guard.h"

#include <expat.h>

#include <memory>

#include "formats/readers/packed_file.h"

namespace parvis::scene {
namespace {

constexpr int deepest_element = 500;  // elements in each other: a reader that recurses would run out of stack

struct Watch {
  XML_Parser parser = nullptr;
  const XmlElement& on_element;
  int depth = 0;
  std::string root, problem;

  void stop(std::string why) {
    if (!problem.empty()) return;
    problem = std::move(why);
    XML_StopParser(parser, XML_FALSE);
  }
};

void on_doctype(void* user, const char*, const char*, const char*, int) {
  static_cast<Watch*>(user)->stop("a DOCTYPE is refused, for it may name external entities; remove it");
}

void on_start(void* user, const char* name, const char** attributes) {
  Watch& look = *static_cast<Watch*>(user);
  if (++look.depth > deepest_element)
    look.stop(fmt::format("elements stand more than {} deep in each other", deepest_element));
  if (look.on_element) look.on_element(name, attributes);
  if (!look.root.empty()) return;
  look.root = name;
  for (; *attributes; attributes += 2)
    if (std::string(attributes[0]).starts_with("xmlns")) look.root += std::string(" ") + attributes[1];
}

void on_end(void* user, const char*) { --static_cast<Watch*>(user)->depth; }

}  // namespace

Result<XmlText> read_xml(const std::filesystem::path& file, const XmlElement& on_element) {
  Result<std::string> bytes = formats::read_unpacked(file);
  if (!bytes) return bytes.errors();
  const std::unique_ptr<std::remove_pointer_t<XML_Parser>, void (*)(XML_Parser)> parser(
      XML_ParserCreate(nullptr), XML_ParserFree);
  Watch look{parser.get(), on_element, 0, {}, {}};
  XML_SetUserData(parser.get(), &look);
  XML_SetStartDoctypeDeclHandler(parser.get(), on_doctype);
  XML_SetElementHandler(parser.get(), on_start, on_end);
  constexpr std::size_t piece = 1 << 20;
  for (std::size_t at = 0; at == 0 || at < bytes->size(); at += piece) {
    const std::size_t length = std::min(piece, bytes->size() - at);
    const bool is_last = at + length == bytes->size();
    if (XML_Parse(parser.get(), bytes->data() + at, int(length), is_last) == XML_STATUS_OK) continue;
    const FileLocation where{file.string(), int(XML_GetCurrentLineNumber(parser.get())),
                             int(XML_GetCurrentColumnNumber(parser.get())) + 1};
    if (!look.problem.empty()) return Error{look.problem, where};
    return error_at(where, "this is no well-formed XML: {}", XML_ErrorString(XML_GetErrorCode(parser.get())));
  }
  return XmlText{*std::move(bytes), look.root};
}

}  // namespace parvis::scene
