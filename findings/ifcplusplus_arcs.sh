#!/usr/bin/env bash
# IFC++ draws an arc of a circle that is trimmed by points (IfcTrimmedCurve, .CARTESIAN.) from an angle of -1 radian where a
# point lies at the height of the circle's middle, measures it in the world's axes where the circle's are turned, and trims
# no ellipse, with neither an exception nor a message. The same arcs trimmed by parameters, of circles, are right.
. "$(dirname "$0")/packages.sh"
command -v g++ > /dev/null || { echo "cannot be had: g++"; exit 77; }
need libifcplusplus-dev=0~git20190402.13744d5+dfsg-2+b1
arc() {  # name, what is trimmed, the trims: half a turn from (1, 0) to (-1, 0), or a quarter from (1, 0) to (0, 1)
  cat > "$1.ifc" << STEP
ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('','',(''),(''),'','','');
FILE_SCHEMA(('IFC4'));
ENDSEC;
DATA;
#1=IFCSIUNIT(*,.LENGTHUNIT.,\$,.METRE.);
#2=IFCSIUNIT(*,.PLANEANGLEUNIT.,\$,.RADIAN.);
#3=IFCUNITASSIGNMENT((#1,#2));
#4=IFCPROJECT('0000000000000000000001',\$,'p',\$,\$,\$,\$,(),#3);
#5=IFCCARTESIANPOINT((0.,0.));
#6=IFCDIRECTION((0.,1.));
#7=IFCAXIS2PLACEMENT2D(#5,\$);
#8=IFCAXIS2PLACEMENT2D(#5,#6);
#9=$2;
#10=IFCCARTESIANPOINT((1.,0.));
#11=IFCCARTESIANPOINT((-1.,0.));
#12=IFCCARTESIANPOINT((0.6,0.8));
#13=IFCCARTESIANPOINT((-0.6,0.8));
#20=IFCTRIMMEDCURVE(#9,$3);
ENDSEC;
END-ISO-10303-21;
STEP
}
arc parameters 'IFCCIRCLE(#7,1.)' '(IFCPARAMETERVALUE(0.)),(IFCPARAMETERVALUE(3.14159265358979)),.T.,.PARAMETER.'
arc points 'IFCCIRCLE(#7,1.)' '(#10),(#11),.T.,.CARTESIAN.'
arc turned 'IFCCIRCLE(#8,1.)' '(#12),(#13),.T.,.CARTESIAN.'
arc ellipse 'IFCELLIPSE(#7,1.,1.)' '(IFCPARAMETERVALUE(0.)),(IFCPARAMETERVALUE(3.14159265358979)),.T.,.PARAMETER.'
cat > arcs.cpp << 'CPP'
#include <ifcpp/IFC4/include/IfcTrimmedCurve.h>
#include <ifcpp/geometry/Carve/GeometryConverter.h>
#include <ifcpp/model/BuildingModel.h>
#include <ifcpp/reader/ReaderSTEP.h>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>
int main(int, char** arguments) {
  std::cout.rdbuf(nullptr), std::wcout.rdbuf(nullptr);
  std::stringstream text;
  text << std::ifstream(arguments[1]).rdbuf();
  auto building = std::make_shared<BuildingModel>();
  GeometryConverter converter(building);
  std::string content = text.str();
  ReaderSTEP().loadModelFromString(content, building);
  const auto curve = std::dynamic_pointer_cast<IfcTrimmedCurve>(building->getMapIfcEntities().at(20));
  std::vector<vec3> points, starts;
  converter.getRepresentationConverter()->getCurveConverter()->convertIfcCurve(curve, points, starts);
  const vec3 &a = points.front(), &b = points.back();
  std::printf("%s: from (%.2f %.2f) to (%.2f %.2f)\n", arguments[1], a.x + 0.0, a.y + 0.0, b.x + 0.0, b.y + 0.0);
}
CPP
g++ -w -std=c++17 -I"$root/installed/usr/include" arcs.cpp -o arcs $(find "$root/installed" -name libIfcPlusPlus.so -o -name libcarve.so) -Wl,--allow-shlib-undefined
for name in parameters points turned ellipse; do ./arcs $name.ifc > $name.txt 2>&1; cat $name.txt; done
expect "parameters give half a turn" grep -qE "from \(1\.00 0\.00\) to \(-1\.00 -?0\.00\)" parameters.txt
expect "points at the height of the middle do not" bash -c '! grep -qE "from \(1\.00 0\.00\) to \(-1\.00 -?0\.00\)" points.txt'
expect "nor those of a circle whose axes are turned" bash -c '! grep -qE "from \(0\.60 0\.80\) to \(-0\.60 0\.80\)" turned.txt'
expect "an ellipse stays whole" bash -c '! grep -qE "to \(-1\.00 -?0\.00\)" ellipse.txt'
