# Every library that Parvis links, all of them Debian packages; docs/dependencies.md says why each is here.
find_package(PkgConfig REQUIRED)
find_package(fmt REQUIRED)
find_package(glm REQUIRED)
find_package(TBB REQUIRED)
find_package(OpenImageIO REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(assimp REQUIRED)
find_package(embree 3 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(EXPAT REQUIRED)
find_package(draco REQUIRED)
find_package(Eigen3 REQUIRED)
find_package(meshoptimizer REQUIRED)
find_package(glfw3 REQUIRED)
find_package(GTest REQUIRED)
find_package(Coin REQUIRED)
find_package(ZLIB REQUIRED)
find_package(BZip2 REQUIRED)
find_package(Threads REQUIRED)

pkg_check_modules(epoxy REQUIRED IMPORTED_TARGET epoxy)
pkg_check_modules(egl REQUIRED IMPORTED_TARGET egl)
pkg_check_modules(glu REQUIRED IMPORTED_TARGET glu)
pkg_check_modules(imgui REQUIRED IMPORTED_TARGET imgui)  # with its backends for GLFW and OpenGL 3
pkg_check_modules(gdal REQUIRED IMPORTED_TARGET gdal)
pkg_check_modules(tiff REQUIRED IMPORTED_TARGET libtiff-4)
pkg_check_modules(proj REQUIRED IMPORTED_TARGET proj)
pkg_check_modules(mpi REQUIRED IMPORTED_TARGET ompi-c)
pkg_check_modules(sqlite3 REQUIRED IMPORTED_TARGET sqlite3)
pkg_check_modules(cairo REQUIRED IMPORTED_TARGET cairo)
pkg_check_modules(qrencode REQUIRED IMPORTED_TARGET libqrencode)
pkg_check_modules(sndfile REQUIRED IMPORTED_TARGET sndfile)
pkg_check_modules(ebur128 REQUIRED IMPORTED_TARGET libebur128)
pkg_check_modules(openal REQUIRED IMPORTED_TARGET openal)
pkg_check_modules(liblo REQUIRED IMPORTED_TARGET liblo)
pkg_check_modules(sdl2 REQUIRED IMPORTED_TARGET sdl2)
set_target_properties(PkgConfig::sdl2 PROPERTIES INTERFACE_COMPILE_OPTIONS "")  # -D_REENTRANT, which precompiled headers lack
pkg_check_modules(spnav REQUIRED IMPORTED_TARGET spnav)
find_library(citygml_library citygml REQUIRED)  # its .pc asks for packages that Debian's does not bring

# libosmium is headers alone; what it reads OpenStreetMap's two formats with is linked by those who include it.
find_path(osmium_headers osmium/io/reader.hpp REQUIRED)
find_path(protozero_headers protozero/pbf_reader.hpp REQUIRED)
add_library(parvis_osmium INTERFACE)
target_link_libraries(parvis_osmium INTERFACE EXPAT::EXPAT ZLIB::ZLIB Threads::Threads)
target_include_directories(parvis_osmium SYSTEM INTERFACE ${osmium_headers} ${protozero_headers})

# Recast brings no configuration.
find_library(recast_library Recast REQUIRED)
find_library(detour_library Detour REQUIRED)
find_path(recast_headers Recast.h PATH_SUFFIXES recastnavigation REQUIRED)
add_library(parvis_recast INTERFACE)
target_link_libraries(parvis_recast INTERFACE ${recast_library} ${detour_library})
target_include_directories(parvis_recast SYSTEM INTERFACE ${recast_headers})

# IFC++ brings no configuration; its geometry, in headers, uses the CSG library carve.
find_library(ifc_library IfcPlusPlus REQUIRED)
find_library(carve_library carve REQUIRED)
find_path(ifc_headers ifcpp/reader/ReaderSTEP.h REQUIRED)
add_library(parvis_ifcplusplus INTERFACE)
target_link_libraries(parvis_ifcplusplus INTERFACE ${ifc_library} ${carve_library})
target_include_directories(parvis_ifcplusplus SYSTEM INTERFACE ${ifc_headers})
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  target_compile_options(parvis_ifcplusplus INTERFACE -fdelayed-template-parsing -Wno-delayed-template-parsing-in-cxx20)  # carve has a template that never compiles
endif()

# Debian's OpenImageIO names OpenCV's headers, which its own do not need and its package does not bring.
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "")
target_link_libraries(OpenImageIO::OpenImageIO INTERFACE Imath::Imath)
