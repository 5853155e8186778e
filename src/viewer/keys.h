// The window's own keys, as people read them: in the help overlay, on the terminal, in docs/window.md.
#pragma once

#include <array>

namespace parvis::viewer {

struct KeyHelp {
  const char* keys;
  const char* does;
};

inline constexpr std::array key_help{
    KeyHelp{"W A S D", "move"},
    KeyHelp{"Q  E", "down, up"},
    KeyHelp{"Shift", "hurries"},
    KeyHelp{"drag", "looks about"},
    KeyHelp{"wheel", "changes speed, or distance when following"},
    KeyHelp{"1", "walks"},
    KeyHelp{"2", "flies"},
    KeyHelp{"3", "follows the next vehicle"},
    KeyHelp{"Tab", "shows the next scenario"},
    KeyHelp{"Space", "halts the traffic, or lets it go on"},
    KeyHelp{"N", "moves halted traffic on by a tenth of a second"},
    KeyHelp{"P", "takes a picture"},
    KeyHelp{"M", "mutes the sound, or lets it be heard"},
    KeyHelp{"PgDn PgUp", "toward a sketch, toward a photograph"},
    KeyHelp{"K  F3", "what can be placed; the planner's tool"},
    KeyHelp{"4  5  6", "planning: plan, street, balcony"},
    KeyHelp{"V  U  M  C", "planning: select, surface, measure, compare designs"},
    KeyHelp{"Shift+C", "planning: two designs in colours, with a slider, side by side"},
    KeyHelp{"G  R  Z", "planning: move, turn, resize what is selected"},
    KeyHelp{"Q  E", "planning: turn what hangs on the pointer"},
    KeyHelp{"arrows", "planning: move by 1 cm; Shift 10 cm, Ctrl 1 m"},
    KeyHelp{"Ctrl", "planning: +Z undo, +Y redo, +S save, +D copy, +A all"},
    KeyHelp{"Ctrl+K", "planning: any command by its name"},
    KeyHelp{"Ctrl + -", "larger and smaller text"},
    KeyHelp{"F1", "shows these keys"},
    KeyHelp{"F2", "opens and closes the panel"},
    KeyHelp{"Esc", "closes this, then the window"}};

}  // namespace parvis::viewer
