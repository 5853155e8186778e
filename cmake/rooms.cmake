# parvis_room(NAME FLOOR n [USES room... | USES_ALL_BELOW] [LIBRARIES target...] [PRIVATE_LIBRARIES target...]
#             [TEST_USES room...] [TEST_LIBRARIES target...] [IN_MODULES | SHARED])
# Makes the library parvis_NAME of the *.cpp of this folder and, where *_test.cpp lie beside them, the
# test program NAME_test. USES names the rooms whose headers may be included: script/check_floors holds
# the room to it; USES_ALL_BELOW, for the list of rooms alone, names every room of a lower floor. LIBRARIES are seen by the rooms above, too, because headers of the room name them; PRIVATE_LIBRARIES
# by its sources and tests alone. TEST_USES: rooms of any floor that its tests, fuzzers and test_*.h use beside USES.
# test_*.cpp are no part of the library: they make parvis_NAME_test_support, which the tests of rooms that use the room, and
# the benches, link.
# TEST_LIBRARIES are linked by its tests and fuzzers alone. IN_MODULES: modules (parvis_module) may use the room; each then
# has a copy of what it uses. SHARED: the library is a shared object, of which a process has one.
# GLSL files need no mention: the room gl embeds those of every room.
set(PARVIS_WARNINGS -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Wunused -Werror)

add_library(parvis_options INTERFACE)
# Nobody reads errno or the traps of floating point: without them square roots are one instruction and searches vectorise.
target_compile_options(parvis_options INTERFACE ${PARVIS_WARNINGS} -fno-math-errno -fno-trapping-math)
target_compile_definitions(parvis_options INTERFACE GLM_FORCE_XYZW_ONLY GLM_ENABLE_EXPERIMENTAL
                                                    GLM_FORCE_SILENT_WARNINGS)
target_include_directories(parvis_options INTERFACE ${CMAKE_SOURCE_DIR}/src)
if(PARVIS_SANITIZE)  # one build for tests and fuzzers; without PARVIS_WARNINGS, for clang has other ones than gcc
  set_property(TARGET parvis_options PROPERTY INTERFACE_COMPILE_OPTIONS
               -fsanitize=address,undefined,fuzzer-no-link -fno-sanitize-recover=undefined -fno-omit-frame-pointer -pthread)
  target_link_options(parvis_options INTERFACE -fsanitize=address,undefined)
endif()
# What becomes a part of shared objects. No function is replaced by another library's: all are inlined as in a program.
add_library(parvis_module_options INTERFACE)
target_compile_options(parvis_module_options INTERFACE -fPIC -fno-semantic-interposition)


# Tests are compiled with little optimisation: their time goes into the rooms that they call.
add_library(parvis_test_options INTERFACE)
target_compile_options(parvis_test_options INTERFACE $<$<CONFIG:Release>:-O1>)

add_library(parvis_test_main OBJECT ${CMAKE_SOURCE_DIR}/cmake/test_main.cpp)
target_link_libraries(parvis_test_main PRIVATE parvis_options PUBLIC GTest::gtest INTERFACE parvis_base)
target_compile_definitions(parvis_test_main PRIVATE PARVIS_SOURCE_DIR="${CMAKE_SOURCE_DIR}")

# Adds a test of one label: `unit` of rooms that do not draw, `draws` of rooms that use gl, `command` where the program is
# started, `dev` for what is no part of the product and of script/test only with --full. Those that take longest start first.
function(parvis_test name label)  # further arguments: the command
  add_test(NAME ${name} COMMAND ${ARGN})
  set(cost_unit 1)
  set(cost_draws 10)
  set(cost_command 100)
  set(cost_dev 1000)
  set_tests_properties(${name} PROPERTIES LABELS ${label} COST ${cost_${label}})
endfunction()

# A fuzzer for each file fuzz/NAME.cpp of the room, ROOM_NAME_fuzz; script/fuzz runs them. In other builds the same
# program only reads its seeds, fuzz/corpus/NAME/*, as a test.
function(parvis_fuzzers room)  # further arguments: libraries
  file(GLOB fuzzers CONFIGURE_DEPENDS fuzz/*.cpp)
  foreach(source ${fuzzers})
    get_filename_component(reader ${source} NAME_WE)
    set(program ${room}_${reader}_fuzz)
    file(GLOB inputs CONFIGURE_DEPENDS fuzz/corpus/${reader}/*)
    add_executable(${program} ${source})
    target_link_libraries(${program} PRIVATE parvis_${room} ${ARGN})
    if(PARVIS_SANITIZE)
      target_link_options(${program} PRIVATE -fsanitize=fuzzer)
    else()
      target_sources(${program} PRIVATE ${CMAKE_SOURCE_DIR}/cmake/read_seeds.cpp)
      if(inputs)
        parvis_test(${program} unit ${program} ${inputs})
      endif()
    endif()
  endforeach()
endfunction()

# Headers that nearly every source includes, compiled once for all rooms (half of the time of a typical source), and the
# same with GoogleTest for all tests. The preset tidy leaves them out: clang-tidy must see what each file includes itself.
set(common_headers <algorithm> <array> <cassert> <cmath> <cstdint> <cstring> <filesystem> <fstream> <functional> <limits> <map>
                   <memory> <numbers> <numeric> <optional> <ranges> <set> <span> <string> <string_view> <tuple>
                   <unordered_map> <utility> <variant> <vector> <fmt/format.h> <glm/glm.hpp> <glm/gtc/constants.hpp>
                   <glm/gtc/matrix_transform.hpp> <glm/gtc/quaternion.hpp>)
file(WRITE ${CMAKE_BINARY_DIR}/empty.cpp "")
add_library(parvis_pch STATIC ${CMAKE_BINARY_DIR}/empty.cpp)
target_link_libraries(parvis_pch PRIVATE parvis_options fmt::fmt glm::glm)
target_precompile_headers(parvis_pch PRIVATE ${common_headers})
add_library(parvis_module_pch STATIC ${CMAKE_BINARY_DIR}/empty.cpp)
target_link_libraries(parvis_module_pch PRIVATE parvis_options parvis_module_options fmt::fmt glm::glm)
target_precompile_headers(parvis_module_pch PRIVATE ${common_headers})
add_library(parvis_test_pch STATIC ${CMAKE_BINARY_DIR}/empty.cpp)
target_link_libraries(parvis_test_pch PRIVATE parvis_options parvis_test_options fmt::fmt glm::glm GTest::gtest)
target_precompile_headers(parvis_test_pch PRIVATE ${common_headers} <gtest/gtest.h>)

# The compiler cache takes this hash for the precompiled headers, whose bytes differ from one compilation to the next, so that objects
# are found again from another checkout (CCACHE_PCH_EXTSUM of script/build).
foreach(pch parvis_pch parvis_module_pch parvis_test_pch)
  string(SHA256 sum "${pch} ${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} ${CMAKE_BUILD_TYPE} ${PARVIS_SANITIZE} ${fmt_VERSION} ${glm_VERSION} ${GTest_VERSION} ${common_headers}")
  set(folder ${CMAKE_BINARY_DIR}/CMakeFiles/${pch}.dir)
  file(MAKE_DIRECTORY ${folder})
  foreach(extension gch pch)
    file(WRITE ${folder}/cmake_pch.hxx.${extension}.sum "${sum}")
  endforeach()
endforeach()

if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")  # without the time of day in it, so that the compiler cache knows it again
  target_compile_options(parvis_pch PRIVATE "SHELL:-Xclang -fno-pch-timestamp")
  target_compile_options(parvis_module_pch PRIVATE "SHELL:-Xclang -fno-pch-timestamp")
  target_compile_options(parvis_test_pch PRIVATE "SHELL:-Xclang -fno-pch-timestamp")
endif()

# With PARVIS_UNITY several sources of a target are compiled as one file. Names in unnamed namespaces are therefore unique within
# a room, those of its tests too, and differ from functions of the namespace around: one of the same signature would be hidden
# without a word. The preset develop, without batches, finds missing includes.
function(parvis_batches target)
  if(PARVIS_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  endif()
endfunction()

# Sets `result` to the names of all rooms of a floor below `floor`.
function(parvis_rooms_below floor result)
  file(GLOB files CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/*/CMakeLists.txt ${CMAKE_SOURCE_DIR}/src/*/*/CMakeLists.txt)
  set(names)
  foreach(file ${files})
    file(STRINGS ${file} line REGEX "^parvis_room\\(")
    if(line MATCHES "^parvis_room\\(([a-z_]+) FLOOR ([0-9]+)" AND CMAKE_MATCH_2 LESS floor)
      list(APPEND names ${CMAKE_MATCH_1})
    endif()
  endforeach()
  set(${result} ${names} PARENT_SCOPE)
endfunction()

# The library of base and the modules beside it (base/module.h); installed in lib/parvis, for the program in bin.
set(PARVIS_MODULE_FOLDER ${CMAKE_BINARY_DIR}/lib)
set(CMAKE_BUILD_RPATH_USE_ORIGIN ON)
set(CMAKE_INSTALL_RPATH $ORIGIN/../lib/parvis)

# parvis_module(NAME LIBRARIES target... [SOURCES file...]), before the parvis_room of its folder: NAME_module.cpp and the
# further sources and libraries become the module NAME (base/module.h), a shared object with a copy of what it uses of
# rooms, and are no part of the room's own library. Programs that link the room find the module built. The presets link
# modules with the system's linker: mold 1.10 takes every object of the rooms' archives into them, needed or not.
function(parvis_module name)
  cmake_parse_arguments(MODULE "" "" "SOURCES;LIBRARIES" ${ARGN})
  set(sources ${name}_module.cpp ${MODULE_SOURCES})
  add_library(parvis_${name}_module MODULE ${sources})
  target_link_libraries(parvis_${name}_module PRIVATE parvis_options parvis_module_options ${MODULE_LIBRARIES})
  set_target_properties(parvis_${name}_module PROPERTIES PREFIX "" OUTPUT_NAME parvis_${name} DEFINE_SYMBOL ""
                        LIBRARY_OUTPUT_DIRECTORY ${PARVIS_MODULE_FOLDER} INSTALL_RPATH $ORIGIN)
  install(TARGETS parvis_${name}_module LIBRARY DESTINATION lib/parvis)
  target_precompile_headers(parvis_${name}_module REUSE_FROM parvis_module_pch)
  parvis_batches(parvis_${name}_module)
  set(module_names ${module_names} ${name} PARENT_SCOPE)
  set(module_sources ${module_sources} ${sources} PARENT_SCOPE)
endfunction()

function(parvis_room name)
  cmake_parse_arguments(ROOM "USES_ALL_BELOW;IN_MODULES;SHARED" "FLOOR" "USES;LIBRARIES;PRIVATE_LIBRARIES;TEST_USES;TEST_LIBRARIES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  file(GLOB tests CONFIGURE_DEPENDS *_test.cpp)
  file(GLOB test_support CONFIGURE_DEPENDS test_*.cpp)
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$|/test_[a-z0-9_]*\\.cpp$")
  foreach(source ${module_sources})
    list(REMOVE_ITEM sources ${CMAKE_CURRENT_SOURCE_DIR}/${source})
  endforeach()
  if(ROOM_USES_ALL_BELOW)
    parvis_rooms_below(${ROOM_FLOOR} ROOM_USES)
  endif()
  set(tested_rooms ${name} ${ROOM_USES} ${ROOM_TEST_USES})
  list(TRANSFORM tested_rooms REPLACE "(.+)" "$<TARGET_NAME_IF_EXISTS:parvis_\\1_test_support>")
  list(TRANSFORM ROOM_USES PREPEND parvis_)
  list(TRANSFORM ROOM_TEST_USES PREPEND parvis_)

  if(sources)
    set(kind STATIC)
    set(pch parvis_pch)
    if(ROOM_SHARED)
      set(kind SHARED)
    endif()
    if(ROOM_IN_MODULES OR ROOM_SHARED)
      set(pch parvis_module_pch)
      set(module_options parvis_module_options)
    endif()
    add_library(parvis_${name} ${kind} ${sources})
    target_link_libraries(parvis_${name} PUBLIC parvis_options ${ROOM_USES} ${ROOM_LIBRARIES} PRIVATE ${ROOM_PRIVATE_LIBRARIES} ${module_options})
    target_precompile_headers(parvis_${name} REUSE_FROM ${pch})
    parvis_batches(parvis_${name})
    if(ROOM_SHARED)
      set_target_properties(parvis_${name} PROPERTIES DEFINE_SYMBOL "" LIBRARY_OUTPUT_DIRECTORY ${PARVIS_MODULE_FOLDER} INSTALL_RPATH $ORIGIN)
      install(TARGETS parvis_${name} LIBRARY DESTINATION lib/parvis)
    endif()
  else()  # headers and GLSL alone
    add_library(parvis_${name} INTERFACE)
    target_link_libraries(parvis_${name} INTERFACE parvis_options ${ROOM_USES} ${ROOM_LIBRARIES})
  endif()
  foreach(module ${module_names})
    # By its file: the module does not depend on itself as programs that link the room depend on it.
    target_link_libraries(parvis_${module}_module PRIVATE $<TARGET_FILE:parvis_${name}> ${ROOM_USES} ${ROOM_LIBRARIES} ${ROOM_PRIVATE_LIBRARIES})
    target_link_options(parvis_${module}_module PRIVATE -Wl,--exclude-libs,ALL -Wl,--as-needed)
    add_library(parvis_${module}_built INTERFACE)
    add_dependencies(parvis_${module}_built parvis_${module}_module)
    target_link_libraries(parvis_${name} INTERFACE parvis_${module}_built)
  endforeach()

  if(test_support)
    add_library(parvis_${name}_test_support STATIC EXCLUDE_FROM_ALL ${test_support})
    target_link_libraries(parvis_${name}_test_support PUBLIC parvis_${name} ${ROOM_TEST_USES} PRIVATE ${ROOM_PRIVATE_LIBRARIES})
    target_precompile_headers(parvis_${name}_test_support REUSE_FROM parvis_pch)
    parvis_batches(parvis_${name}_test_support)
  endif()

  if(tests)
    add_executable(${name}_test ${tests})
    target_link_libraries(${name}_test PRIVATE ${tested_rooms} parvis_${name} ${ROOM_TEST_USES} parvis_test_options ${ROOM_PRIVATE_LIBRARIES} ${ROOM_TEST_LIBRARIES} parvis_test_main)
    target_precompile_headers(${name}_test REUSE_FROM parvis_test_pch)
    parvis_batches(${name}_test)
    set(label unit)
    if(name STREQUAL gl OR "parvis_gl" IN_LIST ROOM_USES OR "parvis_gl" IN_LIST ROOM_TEST_USES)
      set(label draws)
    endif()
    parvis_test(${name} ${label} ${name}_test)
  endif()
  parvis_fuzzers(${name} ${ROOM_TEST_USES} ${ROOM_PRIVATE_LIBRARIES} ${ROOM_TEST_LIBRARIES})
endfunction()
