#!/usr/bin/env bash
# IFC++ counts each knot of a B-spline curve (IfcBSplineCurveWithKnots) once more than its multiplicity says and takes its weights from
# the second one on, so that the curve runs elsewhere; of a line that is trimmed at 1 and 2 it draws the part from 1 to 3. Neither an
# exception nor a message says so.
. "$(dirname "$0")/packages.sh"
command -v g++ > /dev/null || { echo "cannot be had: g++"; exit 77; }
need libifcplusplus-dev=0~git20190402.13744d5+dfsg-2+b1
cat > curves.ifc << 'STEP'
ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('','',(''),(''),'','','');
FILE_SCHEMA(('IFC4'));
ENDSEC;
DATA;
#1=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);
#3=IFCUNITASSIGNMENT((#1));
#4=IFCPROJECT('0000000000000000000001',$,'p',$,$,$,$,(),#3);
#5=IFCCARTESIANPOINT((1.,0.));
#6=IFCCARTESIANPOINT((1.,2.));
#7=IFCCARTESIANPOINT((5.,2.));
#8=IFCCARTESIANPOINT((5.,0.));
#9=IFCDIRECTION((1.,0.));
#10=IFCVECTOR(#9,1.);
#11=IFCLINE(#5,#10);
#20=IFCBSPLINECURVEWITHKNOTS(3,(#5,#6,#7,#8),.UNSPECIFIED.,.F.,.F.,(4,4),(0.,1.),.UNSPECIFIED.);
#21=IFCTRIMMEDCURVE(#11,(IFCPARAMETERVALUE(1.)),(IFCPARAMETERVALUE(2.)),.T.,.PARAMETER.);
ENDSEC;
END-ISO-10303-21;
STEP
cat > curves.cpp << 'CPP'
#include <ifcpp/IFC4/include/IfcCurve.h>
#include <ifcpp/geometry/Carve/GeometryConverter.h>
#include <ifcpp/model/BuildingModel.h>
#include <ifcpp/reader/ReaderSTEP.h>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>
int main() {
  std::cout.rdbuf(nullptr), std::wcout.rdbuf(nullptr);
  std::stringstream text;
  text << std::ifstream("curves.ifc").rdbuf();
  auto building = std::make_shared<BuildingModel>();
  GeometryConverter converter(building);
  std::string content = text.str();
  ReaderSTEP().loadModelFromString(content, building);
  for (const int id : {20, 21}) {
    const auto curve = std::dynamic_pointer_cast<IfcCurve>(building->getMapIfcEntities().at(id));
    std::vector<vec3> points, starts;
    converter.getRepresentationConverter()->getCurveConverter()->convertIfcCurve(curve, points, starts);
    std::printf("#%d:", id);
    for (const vec3& point : points) std::printf(" (%.2f %.2f)", point.x + 0.0, point.y + 0.0);
    std::printf("\n");
  }
}
CPP
g++ -w -std=c++17 -I"$root/installed/usr/include" curves.cpp -o curves $(find "$root/installed" -name libIfcPlusPlus.so -o -name libcarve.so) -Wl,--allow-shlib-undefined
./curves | tee curves.txt
expect "the spline from (1, 0) to (5, 0), half way at (3, 1.5), does not run there" bash -c '! grep -qE "^#20: \(1\.00 0\.00\).*\(5\.00 0\.00\)$" curves.txt'
expect "the line is trimmed at 1 and 3" grep -qE "^#21: \(2\.00 0\.00\) \(4\.00 0\.00\)" curves.txt
