// Items of a list that have their owner's value wherever they do not set their own.
#pragma once

#include <string>

#include "common/config/toml_reader.h"

namespace ramify {

/// Fills in the lists below `owner` whose rows say inherits_owner: each item gets the owner's value of every
/// row of the same key that `origins` does not name. Named tables are merged name by name. `prefix` is the
/// owner's dotted key, empty at the top.
void inherit_from_owners(const Table& table, void* owner, const std::string& prefix, const Origins& origins);

}  // namespace ramify
