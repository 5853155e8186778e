// Looks through an XML file before a library reads it that would follow external entities.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "base/result.h"

namespace parvis::scene {

/// Refuses a file that is not well-formed, or declares a DOCTYPE (and so could name external entities, or
/// entities that grow), with its line. Tells `on_root` the name of the root element and its namespaces, as
/// written.
Status check_xml(const std::filesystem::path& file, const std::string& bytes,
                 const std::function<void(const std::string& name_and_namespaces)>& on_root);

}  // namespace parvis::scene
