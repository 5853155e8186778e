#!/usr/bin/env bash
# libcitygml reads a building of CityGML 3 without polygons, with neither an exception nor a message; the same roof of
# CityGML 2 has its polygon.
. "$(dirname "$0")/packages.sh"
command -v g++ > /dev/null || { echo "cannot be had: g++"; exit 77; }
need libcitygml-dev=2.4.3-1+b1
polygon='<gml:MultiSurface><gml:surfaceMember><gml:Polygon gml:id="p"><gml:exterior><gml:LinearRing gml:id="g">
<gml:posList srsDimension="3">0 0 3 9 0 3 9 9 3 0 0 3</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember></gml:MultiSurface>'
cat > two.gml <<XML
<?xml version="1.0" encoding="UTF-8"?>
<core:CityModel xmlns:core="http://www.opengis.net/citygml/2.0" xmlns:gml="http://www.opengis.net/gml"
  xmlns:bldg="http://www.opengis.net/citygml/building/2.0">
<core:cityObjectMember><bldg:Building gml:id="b"><bldg:boundedBy><bldg:RoofSurface gml:id="r">
<bldg:lod2MultiSurface>$polygon</bldg:lod2MultiSurface>
</bldg:RoofSurface></bldg:boundedBy></bldg:Building></core:cityObjectMember></core:CityModel>
XML
cat > three.gml <<XML
<?xml version="1.0" encoding="UTF-8"?>
<core:CityModel xmlns:core="http://www.opengis.net/citygml/3.0" xmlns:gml="http://www.opengis.net/gml/3.2"
  xmlns:bldg="http://www.opengis.net/citygml/building/3.0" xmlns:con="http://www.opengis.net/citygml/construction/3.0">
<core:cityObjectMember><bldg:Building gml:id="b"><core:boundary><con:RoofSurface gml:id="r">
<core:lod2MultiSurface>$polygon</core:lod2MultiSurface>
</con:RoofSurface></core:boundary></bldg:Building></core:cityObjectMember></core:CityModel>
XML
cat > count.cpp <<'CPP'
#include <citygml/citygml.h>
#include <citygml/citymodel.h>
#include <citygml/cityobject.h>
#include <citygml/geometry.h>
#include <cstdio>
using namespace citygml;
unsigned objects, polygons;
void count(const Geometry& geometry) {
  polygons += geometry.getPolygonsCount();
  for (unsigned i = 0; i < geometry.getGeometriesCount(); ++i) count(geometry.getGeometry(i));
}
void count(const CityObject& object) {
  ++objects;
  for (unsigned i = 0; i < object.getGeometriesCount(); ++i) count(object.getGeometry(i));
  for (unsigned i = 0; i < object.getChildCityObjectsCount(); ++i) count(object.getChildCityObject(i));
}
int main(int, char** arguments) {
  ParserParams parameters;
  const auto city = load(arguments[1], parameters);
  for (unsigned i = 0; city && i < city->getNumRootCityObjects(); ++i) count(city->getRootCityObject(i));
  std::printf("%s: %s, %u objects, %u polygons\n", arguments[1], city ? "read" : "not read", objects, polygons);
}
CPP
g++ -w -I"$root/installed/usr/include" count.cpp -o count $(find "$root/installed" -name libcitygml.so) -Wl,--allow-shlib-undefined
for name in two three; do ./count $name.gml > $name.txt 2>&1; cat $name.txt; done
expect "CityGML 2 has its polygon" grep -q "^two.gml: read, [1-9][0-9]* objects, 1 polygons" two.txt
expect "CityGML 3 is read, without polygons" grep -q "^three.gml: read, [0-9]* objects, 0 polygons" three.txt
expect "nothing else is said" test "$(wc -l < three.txt)" -eq 1
