#!/usr/bin/env bash
# libcitygml reads no object of a valid CityGML 2 file that holds, beside a building, one city object of an application
# domain extension, though the standard lets any schema add such objects (OGC 12-019, 10.13). The building alone is read.
. "$(dirname "$0")/packages.sh"
command -v g++ > /dev/null || { echo "cannot be had: g++"; exit 77; }
need libcitygml-dev=2.4.3-1+b1
building='<core:cityObjectMember><bldg:Building gml:id="b"><bldg:boundedBy><bldg:RoofSurface gml:id="r"><bldg:lod2MultiSurface>
<gml:MultiSurface><gml:surfaceMember><gml:Polygon gml:id="p"><gml:exterior><gml:LinearRing gml:id="g">
<gml:posList srsDimension="3">0 0 3 9 0 3 9 9 3 0 0 3</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember></gml:MultiSurface>
</bldg:lod2MultiSurface></bldg:RoofSurface></bldg:boundedBy></bldg:Building></core:cityObjectMember>'
extension='<core:cityObjectMember><fence:Fence gml:id="f"><gml:name>garden fence</gml:name></fence:Fence></core:cityObjectMember>'
write() {  # FILE MEMBERS
  cat > "$1" <<XML
<?xml version="1.0" encoding="UTF-8"?>
<core:CityModel xmlns:core="http://www.opengis.net/citygml/2.0" xmlns:gml="http://www.opengis.net/gml"
  xmlns:bldg="http://www.opengis.net/citygml/building/2.0" xmlns:fence="http://example.org/fence/1.0">
$2</core:CityModel>
XML
}
write alone.gml "$building"
write beside.gml "$building$extension"
cat > count.cpp <<'CPP'
#include <citygml/citygml.h>
#include <citygml/citymodel.h>
#include <cstdio>
#include <exception>
int main(int, char** arguments) {
  try {
    const auto city = citygml::load(arguments[1], citygml::ParserParams());
    std::printf("%s: %s, %u objects\n", arguments[1], city ? "read" : "not read", city ? city->getNumRootCityObjects() : 0);
  } catch (const std::exception& refused) {
    std::printf("%s: refused, 0 objects: %s\n", arguments[1], refused.what());
  }
}
CPP
g++ -w -I"$root/installed/usr/include" count.cpp -o count $(find "$root/installed" -name libcitygml.so) -Wl,--allow-shlib-undefined
for name in alone beside; do ./count $name.gml > $name.txt 2>&1 || true; cat $name.txt; done
expect "the building alone is read" grep -q "^alone.gml: read, 1 objects" alone.txt
expect "with the extension's object beside it, nothing is" grep -Eq "^beside.gml: (read|not read|refused), 0 objects" beside.txt
