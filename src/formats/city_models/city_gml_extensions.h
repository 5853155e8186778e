// CityGML without what application domain extensions (ADE) add to it: libcitygml refuses a whole file for one
// city object that it does not know.
#pragma once

#include <string>

#include "scene/data/file_account.h"

namespace parvis::scene {

/// The same city in elements of CityGML and GML alone. A city object of another schema becomes a generic one,
/// which keeps its geometry as far as that is written in properties of CityGML; other elements of such
/// schemas are erased with all that they hold, as are members that only refer to an object elsewhere. Each is
/// named in the account. `xml` is well-formed, without a DOCTYPE (read_xml), and comes back as it is where
/// there is nothing of this, or where its namespaces cannot be read.
std::string without_gml_extensions(std::string xml, FileAccount& account);

}  // namespace parvis::scene
