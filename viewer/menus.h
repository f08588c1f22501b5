// The bar of menus, the line of state below everything, the sheet of keys and the questions.
#pragma once

#include "viewer/workbench.h"

namespace ramify {

void show_menus(Workbench& bench);
void show_status(Workbench& bench);
void show_help(Workbench& bench);
void show_prompt(Workbench& bench);

}  // namespace ramify
