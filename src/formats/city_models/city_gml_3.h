// CityGML 3 as CityGML 2, which libcitygml reads.
#pragma once

#include <string>

#include "base/result.h"

namespace parvis::scene {

/// True if the namespaces of an outermost element (XmlText::root) are those of CityGML 3.
bool is_city_gml_3(const std::string& root);

/// The same city in the elements of CityGML 2: module "construction" is part of "building", properties of
/// "core" are those of their modules, attributes and texture coordinates are written as version 2 has them.
/// Spaces of traffic, storeys and sections of roads have no counterpart: what they contain belongs to what
/// contains them. What version 2 knows nothing of (versions, time series, point clouds, other schemas) is
/// left out. `xml` is well-formed, without a DOCTYPE (read_xml). Error: a prefix without a namespace, by its
/// line.
Result<std::string> city_gml_2_of(const std::string& xml, const FileLocation& where);

}  // namespace parvis::scene
