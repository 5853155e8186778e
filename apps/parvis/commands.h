// The subcommands. Each adds itself to the command line and, when the user names it, leaves what is to be
// done.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "base/result.h"

namespace parvis {

using Chosen = std::function<Status()>;

void add_view(CLI::App& app, Chosen& chosen);
void add_render(CLI::App& app, Chosen& chosen);
void add_bake(CLI::App& app, Chosen& chosen);
void add_reference(CLI::App& app, Chosen& chosen);
void add_compare(CLI::App& app, Chosen& chosen);
void add_check(CLI::App& app, Chosen& chosen);
void add_format(CLI::App& app, Chosen& chosen);
void add_export(CLI::App& app, Chosen& chosen);
void add_city(CLI::App& app, Chosen& chosen);
void add_plan(CLI::App& app, Chosen& chosen);
void add_photomontage(CLI::App& app, Chosen& chosen);
void add_sun(CLI::App& app, Chosen& chosen);
void add_facade(CLI::App& app, Chosen& chosen);
void add_car(CLI::App& app, Chosen& chosen);
void add_tree(CLI::App& app, Chosen& chosen);
void add_noise(CLI::App& app, Chosen& chosen);
void add_sound(CLI::App& app, Chosen& chosen);
void add_study(CLI::App& app, Chosen& chosen);
void add_soundserver(CLI::App& app, Chosen& chosen);
void add_share(CLI::App& app, Chosen& chosen);

inline constexpr void (*command_table[])(CLI::App&, Chosen&) = {
    add_view,   add_render, add_bake,  add_reference,    add_compare, add_check,  add_format,
    add_export, add_city,   add_plan,  add_photomontage, add_sun,     add_facade, add_tree,
    add_car,    add_noise,  add_sound, add_soundserver,  add_study,   add_share};

}  // namespace parvis
