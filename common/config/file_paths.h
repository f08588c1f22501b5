// The files that a config names.
#pragma once

#include "common/config/field.h"

namespace ramify {

/// Makes every path below `owner` absolute, so that its config means the same files from any folder.
void make_paths_absolute(const Table& table, void* owner);

}  // namespace ramify
