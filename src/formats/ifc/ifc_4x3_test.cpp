#include "formats/ifc/ifc_4x3.h"

#include <gtest/gtest.h>

namespace parvis::scene {
namespace {

TEST(Ifc4x3, FacesAreWrittenInTheOlderOrder) {
  EXPECT_EQ(ifc_4_of_4x3("#1=IFCTRIANGULATEDFACESET(#2,.T.,$,((1,2,3)),$);"),
            "#1=IFCTRIANGULATEDFACESET(#2,$,.T.,((1,2,3)),$);");
  EXPECT_EQ(ifc_4_of_4x3("#1= IFCTRIANGULATEDFACESET (#2, $, ((0.,0.,1.)), ((1,2,3)), $);"),
            "#1= IFCTRIANGULATEDFACESET (#2, ((0.,0.,1.)), $, ((1,2,3)), $);");
  for (const char* same :
       {"#1=IFCTRIANGULATEDFACESET(#2,$,.T.,((1,2,3)),$);", "#1=IFCTRIANGULATEDFACESET(#2,$,$,((1,2,3)),$);",
        "#1=IFCTRIANGULATEDFACESET(#2,((0.,0.,1.)),.F.,((1,2,3)),$);"})
    EXPECT_EQ(ifc_4_of_4x3(same), same);
}

TEST(Ifc4x3, TheHeaderNamesTheOlderSchema) {
  EXPECT_EQ(ifc_4_of_4x3("FILE_SCHEMA (('IFC4X3_ADD2'));#1=IFCWALL('IFC4X3');"),
            "FILE_SCHEMA (('IFC4'));#1=IFCWALL('IFC4X3');");
  for (const char* same : {"FILE_SCHEMA(('IFC4'));#1=IFCWALL('IFC4X3');", "FILE_SCHEMA(('IFC4X3", "'IFC4X3'"})
    EXPECT_EQ(ifc_4_of_4x3(same), same);
}

TEST(Ifc4x3, DamagedTextIsLeftAsItIs) {
  for (const char* text : {"", "IFCTRIANGULATEDFACESET", "IFCTRIANGULATEDFACESET(",
                           "IFCTRIANGULATEDFACESET(#1", "IFCTRIANGULATEDFACESET(#1,.T.",
                           "IFCTRIANGULATEDFACESET('a,b,c,d)", "IFCTRIANGULATEDFACESET(((((,.T.,$,("}) {
    EXPECT_EQ(ifc_4_of_4x3(text), text);
    EXPECT_EQ(kinds_beyond_ifc_4(text), "");
  }
}

TEST(Ifc4x3, KindsThatIfc4HasNotAreCounted) {
  EXPECT_EQ(kinds_beyond_ifc_4("#1=IFCWALL($);\n#2=IFCPAVEMENT($);\n#3 = IFCROAD($);\n#4=IFCPAVEMENT($);"),
            "2 IFCPAVEMENT, 1 IFCROAD");
  EXPECT_EQ(kinds_beyond_ifc_4("#1=IFCWALL('the IFCROAD');#2=IFCROADSIGN($);"), "");
  EXPECT_EQ(kinds_beyond_ifc_4("#1="), "");
  EXPECT_EQ(kinds_beyond_ifc_4("#1=IFCREINFORCEDSOIL($);#2=IFCIMPACTPROTECTIONDEVICE($);#3=IFCVEHICLE($);"),
            "1 IFCIMPACTPROTECTIONDEVICE, 1 IFCREINFORCEDSOIL, 1 IFCVEHICLE");
}

TEST(Ifc4x3, TheSchemaIsThatOfTheHeader) {
  EXPECT_EQ(schema_of_ifc("HEADER;FILE_SCHEMA(('IFC4X3_ADD2'));ENDSEC;"), "FILE_SCHEMA(('IFC4X3_ADD2'))");
  EXPECT_EQ(schema_of_ifc("FILE_SCHEMA(('IFC4"), "FILE_SCHEMA(('IFC4");
  EXPECT_EQ(schema_of_ifc("nothing"), "");
}

}  // namespace
}  // namespace parvis::scene
