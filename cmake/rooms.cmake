# parvis_room(NAME FLOOR n [USES room...] [LIBRARIES target...])
# Makes the library parvis_NAME of the *.cpp of this folder and, where *_test.cpp lie beside them, the
# test program NAME_test. USES names the rooms whose headers may be included: script/check_floors holds
# the room to it. GLSL files need no mention: src/gl embeds those of every room.
set(PARVIS_WARNINGS -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Wunused -Werror)

add_library(parvis_options INTERFACE)
target_compile_options(parvis_options INTERFACE ${PARVIS_WARNINGS})
target_compile_definitions(parvis_options INTERFACE GLM_FORCE_XYZW_ONLY GLM_ENABLE_EXPERIMENTAL
                                                    GLM_FORCE_SILENT_WARNINGS)
target_include_directories(parvis_options INTERFACE ${CMAKE_SOURCE_DIR}/src)
if(PARVIS_FUZZ)
  set_property(TARGET parvis_options PROPERTY INTERFACE_COMPILE_OPTIONS -fsanitize=fuzzer-no-link)  # other warnings than gcc's
endif()
if(PARVIS_SANITIZE)
  target_compile_options(parvis_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined
                                                  -fno-omit-frame-pointer)
  target_link_options(parvis_options INTERFACE -fsanitize=address,undefined)
endif()

# A fuzzer for each file fuzz/NAME.cpp of the room, ROOM_NAME_fuzz; script/fuzz runs them. In other builds the same
# program only reads the inputs once found, fuzz/found/NAME-*, as a test.
function(parvis_fuzzers room)
  file(GLOB fuzzers CONFIGURE_DEPENDS fuzz/*.cpp)
  foreach(source ${fuzzers})
    get_filename_component(reader ${source} NAME_WE)
    set(program ${room}_${reader}_fuzz)
    add_executable(${program} ${source})
    target_link_libraries(${program} PRIVATE parvis_${room})
    if(PARVIS_FUZZ)
      target_link_options(${program} PRIVATE -fsanitize=fuzzer)
    else()
      target_sources(${program} PRIVATE ${CMAKE_SOURCE_DIR}/cmake/read_found_inputs.cpp)
      file(GLOB found CONFIGURE_DEPENDS fuzz/found/${reader}-*)
      add_test(NAME ${program} COMMAND ${program} ${found})
    endif()
  endforeach()
endfunction()

function(parvis_room name)
  cmake_parse_arguments(ROOM "" "FLOOR" "USES;LIBRARIES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  file(GLOB tests CONFIGURE_DEPENDS *_test.cpp)
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
  list(TRANSFORM ROOM_USES PREPEND parvis_)

  if(NOT sources)
    add_library(parvis_${name} INTERFACE)
    return()
  endif()
  add_library(parvis_${name} STATIC ${sources})
  target_link_libraries(parvis_${name} PUBLIC parvis_options ${ROOM_USES} ${ROOM_LIBRARIES})

  if(tests)
    add_executable(${name}_test ${tests})
    target_link_libraries(${name}_test PRIVATE parvis_${name} GTest::gtest_main)
    target_compile_definitions(${name}_test PRIVATE PARVIS_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
    add_test(NAME ${name} COMMAND ${name}_test)
  endif()
  parvis_fuzzers(${name})
endfunction()
