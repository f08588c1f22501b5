// Items of a list that have their owner's value wherever they do not set their own.
#pragma once

#include <string>

#include "common/config/toml_reader.h"

namespace ramify {

/// Fills in the lists below `owner` whose rows say inherits_owner: each item gets the owner's value of every
/// row of the same key that `origins` does not name. Named tables are merged name by name. `prefix` is the
/// owner's dotted key, empty at the top.
void inherit_from_owners(const Table& table, void* owner, const std::string& prefix, const Origins& origins);

/// Appends to the list `row` of `table` the item that an empty one in a config stands for; returns it.
void* append_item(const Table& table, void* owner, const FieldRow& row);

/// After `owner` was changed by hand from what it was, `before`: items of the lists that inherit have the new
/// values wherever they had the old ones. Of lists within items nothing follows. O(items * members).
void follow_owner(const Table& table, void* before, void* owner);

}  // namespace ramify
