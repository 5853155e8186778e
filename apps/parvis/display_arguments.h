// The arguments of commands that can show a scene on the walls of a room.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "base/known_names.h"
#include "graphics/display/display_file.h"
#include "stage/walls.h"

namespace parvis {

struct DisplayArguments {
  std::filesystem::path file;      ///< empty: none
  std::string stereo;              ///< empty: the file's
  std::vector<double> eye;         ///< empty: the file's
  std::vector<std::string> walls;  ///< empty: all

  /// --display, --stereo, --eye, --wall.
  void add(CLI::App& command) {
    CLI::Option* on = command.add_option(
        "--display", file, "The walls of a room, in place of one picture (.json, ParaView's .pvx)");
    const auto only_with_it = [&](CLI::Option* option) { return option->needs(on)->group("Displays"); };
    only_with_it(command.add_option("--stereo", stereo, "In place of the file's"))
        ->check(CLI::IsMember(
            std::vector<std::string>(display::stereo_names.begin(), display::stereo_names.end())));
    only_with_it(command.add_option("--eye", eye, "Where the eye is in the room: x,y,z in metres"))
        ->delimiter(',')
        ->expected(3);
    only_with_it(command.add_option("--wall", walls, "This wall alone, by name; may repeat"));
  }
  bool is_given() const { return !file.empty(); }

  /// The display with what the command line changes of it.
  Result<display::Display> read() const {
    Result<display::Display> read = display::read_display(file);
    if (!read) return read;
    if (!stereo.empty()) read->stereo = *display::stereo_named(stereo);
    if (!eye.empty())
      for (const display::Wall& wall : read->walls)
        if (!display::is_before(wall, {eye[0], eye[1], eye[2]}))
          return error("--eye {},{},{}: that is not before wall \"{}\"", eye[0], eye[1], eye[2], wall.name);
    std::vector<std::string> names;
    for (const display::Wall& wall : read->walls) names.push_back(wall.name);
    for (const std::string& wall : walls)
      if (std::ranges::find(names, wall) == names.end())
        return error("--wall {}: {} has no such wall{}", wall, file.string(), names_that_exist(wall, names));
    if (!walls.empty())
      std::erase_if(read->walls, [&](const display::Wall& wall) {
        return std::ranges::find(walls, wall.name) == walls.end();
      });
    return read;
  }
  /// The head that looks: where --eye has it, else where the display does.
  display::Head head(const display::Display& display) const {
    return {eye.empty() ? display.eye : glm::dvec3(eye[0], eye[1], eye[2])};
  }
};

}  // namespace parvis
