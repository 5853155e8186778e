#!/usr/bin/env bash
# libcitygml reads a ring of gml:coordinates as one without points, every position of srsDimension="2" with a third number
# of the next, and both orientations of an OrientableSurface alike, with neither an exception nor a message.
. "$(dirname "$0")/packages.sh"
command -v g++ > /dev/null || { echo "cannot be had: g++"; exit 77; }
need libcitygml-dev=2.4.3-1+b1
file() {
  cat > "$1.gml" << XML
<?xml version="1.0" encoding="UTF-8"?>
<core:CityModel xmlns:core="http://www.opengis.net/citygml/2.0" xmlns:gml="http://www.opengis.net/gml"
  xmlns:bldg="http://www.opengis.net/citygml/building/2.0">
<core:cityObjectMember><bldg:Building gml:id="b"><bldg:lod1MultiSurface><gml:MultiSurface><gml:surfaceMember>$2
</gml:surfaceMember></gml:MultiSurface></bldg:lod1MultiSurface></bldg:Building></core:cityObjectMember></core:CityModel>
XML
}
polygon() { echo "<gml:Polygon gml:id=\"p\"><gml:exterior><gml:LinearRing>$1</gml:LinearRing></gml:exterior></gml:Polygon>"; }
list=$(polygon '<gml:posList>0 0 3 9 0 3 9 9 3 0 0 3</gml:posList>')
file list "$list"
file coordinates "$(polygon '<gml:coordinates>0,0,3 9,0,3 9,9,3 0,0,3</gml:coordinates>')"
file plane "$(polygon '<gml:posList srsDimension="2">0 0 9 0 9 9 0 0</gml:posList>')"
for sign in + -; do
  file "oriented$sign" "<gml:OrientableSurface orientation=\"$sign\"><gml:baseSurface>$list</gml:baseSurface></gml:OrientableSurface>"
done
cat > rings.cpp << 'CPP'
#include <citygml/citygml.h>
#include <citygml/citymodel.h>
#include <citygml/cityobject.h>
#include <citygml/geometry.h>
#include <citygml/linearring.h>
#include <citygml/polygon.h>
#include <cstdio>
using namespace citygml;
void print(const Geometry& geometry) {
  for (unsigned i = 0; i < geometry.getPolygonsCount(); ++i) {
    std::printf(" ring");
    for (const auto& v : geometry.getPolygon(i)->exteriorRing()->getVertices()) std::printf(" (%g %g %g)", v.x, v.y, v.z);
  }
  for (unsigned i = 0; i < geometry.getGeometriesCount(); ++i) print(geometry.getGeometry(i));
}
int main(int, char** arguments) {
  ParserParams parameters;
  parameters.tesselate = false, parameters.keepVertices = true;
  const auto city = load(arguments[1], parameters);
  std::printf("%s:", arguments[1]);
  for (unsigned i = 0; city && i < city->getNumRootCityObjects(); ++i)
    for (unsigned k = 0; k < city->getRootCityObject(i).getGeometriesCount(); ++k) print(city->getRootCityObject(i).getGeometry(k));
  std::puts("");
}
CPP
g++ -w -I"$root/installed/usr/include" rings.cpp -o rings $(find "$root/installed" -name libcitygml.so) -Wl,--allow-shlib-undefined
for name in list coordinates plane oriented+ oriented-; do ./rings $name.gml > $name.txt 2>&1; cat $name.txt; done
expect "a posList has its points" grep -qF "list.gml: ring (0 0 3) (9 0 3) (9 9 3) (0 0 3)" list.txt
expect "gml:coordinates have none" grep -qxF "coordinates.gml: ring" coordinates.txt
expect "two dimensions are read as three" grep -qF "plane.gml: ring (0 0 9) (0 9 9)" plane.txt
expect "both orientations are alike" cmp -s <(cut -d: -f2 oriented+.txt) <(cut -d: -f2 oriented-.txt)
