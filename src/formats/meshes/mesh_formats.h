// The allow list of mesh formats that assimp reads for us, each recognised by its content, too.
#pragma once

#include "formats/readers/readers.h"

namespace parvis::scene {

/// Adds OBJ, PLY, STL, OFF, COLLADA, FBX, 3DS, 3MF, AC3D, LightWave objects and DirectX files: formats that
/// hold one model. Formats that list further files of any kind (LWS, X3D, IRR) are none of them.
void add_mesh_formats(formats::Readers& readers);

}  // namespace parvis::scene
