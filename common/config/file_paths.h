// The files that a config names.
#pragma once

#include <filesystem>
#include <functional>

#include "common/config/field.h"

namespace ramify {

/// Calls visit for every path below `owner` that is not empty, in the order of the table.
void for_each_path(const Table& table, void* owner, const std::function<void(std::filesystem::path&)>& visit);

/// Makes every path below `owner` absolute, so that its config means the same files from any folder.
void make_paths_absolute(const Table& table, void* owner);

}  // namespace ramify
