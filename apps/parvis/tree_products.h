// parvis tree organs, vary, export, figures: what is made of a tree that was captured.
#pragma once

#include "commands.h"

namespace parvis {

void add_tree_products(CLI::App& tree, Chosen& chosen);

}  // namespace parvis
