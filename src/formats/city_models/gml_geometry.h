// Geometry of GML that libcitygml passes over or misreads, as it reads it.
#pragma once

#include <string>

namespace parvis::scene {

/// The same city with every ring as one list of positions in three dimensions, where it is written otherwise:
/// as gml:coordinates (with their separators), as gml:coord, as points, or in two dimensions
/// (srsDimension="2", of the list or of what it stands in), which lie at height 0. Rings of an
/// OrientableSurface whose orientation is "-" run the other way; where it refers to a surface elsewhere, a
/// copy of that stands in its place. `xml` is well-formed, without a DOCTYPE (read_xml), and comes back as it
/// is where there is nothing of this.
std::string plain_gml_geometry(std::string xml);

}  // namespace parvis::scene
