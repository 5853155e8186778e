#!/usr/bin/env bash
# IFC++ puts an IfcBlock and an IfcRectangularPyramid with their middle where their corner belongs, the pyramid half as high,
# takes the radius of an IfcSphere for metres in a file in millimetres, makes nothing of a primitive that is an item of a
# representation by itself, extrudes along a direction of length 5 five times as far as the depth says, and turns a profile by
# 4.7 radians as by degrees where the file names no unit of angles (by 1.5 as by radians), with neither an exception nor an
# error. An IfcRightCircularCylinder in an IfcCsgSolid is right.
. "$(dirname "$0")/packages.sh"
command -v g++ > /dev/null || { echo "cannot be had: g++"; exit 77; }
need libifcplusplus-dev=0~git20190402.13744d5+dfsg-2+b1
solid() {  # name, a solid at (1 m, 2 m, 3 m), the item that is shown: #20, a solid of it, or #21, itself
  cat > "$1.ifc" << STEP
ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('','',(''),(''),'','','');
FILE_SCHEMA(('IFC4'));
ENDSEC;
DATA;
#1=IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);
#2=IFCUNITASSIGNMENT((#1));
#3=IFCCARTESIANPOINT((0.,0.,0.));
#4=IFCAXIS2PLACEMENT3D(#3,\$,\$);
#5=IFCGEOMETRICREPRESENTATIONCONTEXT(\$,'Model',3,1.E-5,#4,\$);
#6=IFCPROJECT('0000000000000000000001',\$,'p',\$,\$,\$,\$,(#5),#2);
#7=IFCLOCALPLACEMENT(\$,#4);
#8=IFCBUILDING('0000000000000000000002',\$,'b',\$,\$,#7,\$,\$,.ELEMENT.,\$,\$,\$);
#9=IFCRELAGGREGATES('0000000000000000000003',\$,\$,\$,#6,(#8));
#10=IFCSLAB('0000000000000000000004',\$,'s',\$,\$,#7,#11,\$,\$);
#11=IFCPRODUCTDEFINITIONSHAPE(\$,\$,(#12));
#12=IFCSHAPEREPRESENTATION(#5,'Body','CSG',($3));
#13=IFCRELCONTAINEDINSPATIALSTRUCTURE('0000000000000000000005',\$,\$,\$,(#10),#8);
#14=IFCCARTESIANPOINT((1000.,2000.,3000.));
#15=IFCAXIS2PLACEMENT3D(#14,\$,\$);
#16=IFCDIRECTION((3.,0.,4.));
#17=IFCRECTANGLEPROFILEDEF(.AREA.,\$,\$,2000.,2000.);
#18=IFCDIRECTION((0.,1.,0.));
#19=IFCAXIS1PLACEMENT(#22,#18);
#22=IFCCARTESIANPOINT((2000.,0.,0.));
#20=IFCCSGSOLID(#21);
#21=$2;
ENDSEC;
END-ISO-10303-21;
STEP
}
solid cylinder 'IFCRIGHTCIRCULARCYLINDER(#15,3000.,1000.)' '#20'
solid block 'IFCBLOCK(#15,4000.,2000.,1000.)' '#20'
solid pyramid 'IFCRECTANGULARPYRAMID(#15,4000.,2000.,3000.)' '#20'
solid sphere 'IFCSPHERE(#15,1000.)' '#20'
solid alone 'IFCBLOCK(#15,4000.,2000.,1000.)' '#21'
solid extrusion 'IFCEXTRUDEDAREASOLID(#17,#15,#16,5000.)' '#21'
solid quarter 'IFCREVOLVEDAREASOLID(#17,#15,#19,1.5707963)' '#21'
solid most 'IFCREVOLVEDAREASOLID(#17,#15,#19,4.7123889)' '#21'
cat > solids.cpp << 'CPP'
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
  int errors = 0;
  converter.setMessageCallBack(&errors, [](void* count, std::shared_ptr<StatusCallback::Message> message) {
    if (message->m_message_type == StatusCallback::MESSAGE_TYPE_ERROR) ++*static_cast<int*>(count);
  });
  std::string content = text.str();
  ReaderSTEP().loadModelFromString(content, building);
  converter.convertGeometry();
  bool is_any = false;
  for (const auto& [id, product] : converter.getShapeInputData())
    for (const auto& representation : product->m_vec_representations)
      for (const auto& item : representation->m_vec_item_data)
        for (const auto& set : item->m_meshsets) {
          const auto box = set->getAABB();
          is_any = true;
          std::printf("%s: %.1f..%.1f, %.1f..%.1f, %.1f..%.1f m", arguments[1], box.pos.x - box.extent.x, box.pos.x + box.extent.x,
                      box.pos.y - box.extent.y, box.pos.y + box.extent.y, box.pos.z - box.extent.z, box.pos.z + box.extent.z);
        }
  std::printf("%s, %d errors\n", is_any ? "" : (std::string(arguments[1]) + ": no body").c_str(), errors);
}
CPP
g++ -w -std=c++17 -I"$root/installed/usr/include" solids.cpp -o solids $(find "$root/installed" -name libIfcPlusPlus.so -o -name libcarve.so) -Wl,--allow-shlib-undefined
for name in cylinder block pyramid sphere alone extrusion quarter most; do ./solids $name.ifc > $name.txt 2>&1; cat $name.txt; done
expect "a cylinder stands at its place" grep -qF "0.0..2.0, 1.0..3.0, 3.0..6.0 m, 0 errors" cylinder.txt
expect "a block of 4 x 2 x 1 m does not begin at its corner (1, 2, 3)" grep -qF -- "-1.0..3.0, 1.0..3.0, 2.5..3.5 m, 0 errors" block.txt
expect "nor a pyramid, which is 1.5 m high in place of 3" grep -qF -- "-1.0..3.0, 1.0..3.0, 3.0..4.5 m, 0 errors" pyramid.txt
expect "a sphere of 1000 mm has a radius of 1000 m" grep -qF -- "-998.0..1002.0" sphere.txt
expect "a block that is an item by itself is lost" grep -qF "no body, 0 errors" alone.txt
expect "an extrusion by 5 m along (3, 0, 4) rises by 20 m in place of 4" grep -qF -- "0.0..17.0, 1.0..3.0, 3.0..23.0 m, 0 errors" extrusion.txt
expect "a quarter of a turn is one" grep -qF -- "0.0..3.0, 1.0..3.0, 3.0..6.0 m" quarter.txt
expect "three quarters are 4.7 degrees" bash -c '! grep -qF -- "0.0..6.0, 1.0..3.0, 0.0..6.0 m" most.txt'
