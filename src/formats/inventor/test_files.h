// Small files of Inventor and VRML for tests.
#pragma once

namespace parvis::inventor {

/// VRML 2: a red square under a transform, a textured one, two viewpoints.
inline constexpr const char* squares_vrml = R"(#VRML V2.0 utf8
DEF front Viewpoint { position 0 1 6 description "front" }
DEF side Viewpoint { position 6 1 0 orientation 0 1 0 1.5708 description "side" }
Transform { translation 2 0 0 children [
  DEF red Shape {
    appearance Appearance { material Material { diffuseColor 1 0 0 } }
    geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] } coordIndex [ 0 1 2 3 -1 ] }
  } ] }
DEF painted Shape {
  appearance Appearance { material Material { } texture ImageTexture { url "paint.png" } }
  geometry IndexedFaceSet { solid FALSE coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] }
    texCoord TextureCoordinate { point [ 0 0, 1 0, 1 1, 0 1 ] } coordIndex [ 0 1 2 3 -1 ] }
}
)";

/// Inventor 2.1: a cube, a textured square with an inline picture, a camera.
inline constexpr const char* cube_inventor = R"(#Inventor V2.1 ascii
Separator {
  PerspectiveCamera { position 0 0 8 heightAngle 0.7 }
  DEF block Separator { Material { diffuseColor 0.2 0.4 0.6 } Translation { translation 0 3 0 } Cube { width 2 } }
  DEF chequer Separator {
    Texture2 { image 2 2 3 0xff0000 0x00ff00 0x0000ff 0xffffff }
    Coordinate3 { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] }
    TextureCoordinate2 { point [ 0 0, 1 0, 1 1, 0 1 ] }
    FaceSet { numVertices 4 }
  }
}
)";

}  // namespace parvis::inventor
