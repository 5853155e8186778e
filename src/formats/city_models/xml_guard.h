// Looks through an XML file before a library reads it that would follow external entities.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "base/result.h"

namespace parvis::scene {

struct XmlText {
  std::string bytes;
  std::string root;  ///< name of the outermost element and its namespaces, as written
};

/// Called for each element as it begins: its name, and its attributes as names and values in turn, then null.
using XmlElement = std::function<void(const char* name, const char** attributes)>;

/// The bytes of a file, unpacked (formats/readers/packed_file.h). One that is not well-formed, or declares a
/// DOCTYPE (and so could name external entities, or entities that grow), is refused with its line.
Result<XmlText> read_xml(const std::filesystem::path& file, const XmlElement& on_element = {});

}  // namespace parvis::scene
