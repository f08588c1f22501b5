// The one table an engine writes about its parameters. The TOML reader and writer, --set, `ramify params` and
// later the viewer walk these tables; no other code names a key.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "common/base/geometry.h"
#include "common/config/schedule.h"
#include "common/config/sketch.h"

namespace ramify {

enum class FieldKind {
  number,
  integer,
  seed,
  boolean,
  choice,
  vector,
  schedule,
  sketch,
  text,
  path,
  group,
  list,
  map
};

/// What a table says about a parameter beside its key and place. Every number has a finite range.
struct FieldInfo {
  double min = 0.0;
  double max = 0.0;
  bool is_above_min = false;              // min itself is not allowed
  std::string unit = {};                  // empty for pure numbers
  std::string help = {};                  // one line
  std::string source = {};                // paper and equation
  std::vector<std::string> choices = {};  // names of an enum's values 0, 1, ...
  std::string over = "step";              // what a schedule's first numbers are
  bool is_top_level = false;    // stands at the top of a config, not in the engine's table (seed, steps)
  bool inherits = false;        // list: an item starts as a copy of the one before it
  bool inherits_owner = false;  // list: an item has its owner's value where it does not set its own
};

struct FieldRow;
using Table = std::vector<FieldRow>;

/// A table's row with the type of its owner erased: what the walker sees. Functions take the owner's address.
struct FieldRow {
  std::string key;
  FieldKind kind = FieldKind::number;
  FieldInfo info;
  std::function<void*(void* owner)> member;  // address of the member; its type follows from `kind`
  std::function<void(void* member, const void* other)> copy;  // assigns another owner's member
  std::function<const Table&()> child;                        // group, list, map: the table of what they hold

  // choice
  std::function<int(const void* member)> choice;
  std::function<void(void* member, int value)> choose;
  // list
  std::function<std::size_t(const void* member)> size;
  std::function<void*(void* member, std::size_t index)> item;
  std::function<void(void* member)> clear;    // also of a map
  std::function<void*(void* member)> append;  // a default item, or a copy of the last (info.inherits)
  std::function<void(void* member, std::size_t index)> remove;
  // map
  std::function<std::vector<std::string>(const void* member)> names;
  std::function<void*(void* member, const std::string& name)> named;  // made with defaults if it is new
  std::function<void(void* member, const std::string& name)> remove_named;
};

/// What a struct must have to stand in a table: a table of its own.
template <class T>
concept HasFields = requires {
  { T::fields() } -> std::same_as<const Table&>;
};

/// {key, member, info}: a row of the table of P. Members may be double, int, std::uint64_t (a seed), bool, an
/// enum, Vec3, Schedule, Sketch, std::string, a file's path, a struct with a table of its own, a vector of
/// such or a map of named ones. A path is read relative to the folder of the file that names it and kept so
/// that it opens from the working directory.
template <class P>
struct Field : FieldRow {
  template <class M>
  Field(std::string field_key, M P::*field_member, FieldInfo field_info) {
    key = std::move(field_key);
    info = std::move(field_info);
    member = [field_member](void* owner) -> void* { return &(static_cast<P*>(owner)->*field_member); };
    copy = [](void* to, const void* from) { *static_cast<M*>(to) = *static_cast<const M*>(from); };
    set_kind<M>();
  }

 private:
  template <class M>
  struct ListOf : std::false_type {};
  template <class T>
  struct ListOf<std::vector<T>> : std::true_type {
    using Item = T;
  };
  template <class M>
  struct MapOf : std::false_type {};
  template <class T>
  struct MapOf<std::map<std::string, T>> : std::true_type {
    using Item = T;
  };

  template <class M>
  void set_kind() {
    if constexpr (std::is_same_v<M, double>) {
      kind = FieldKind::number;
    } else if constexpr (std::is_same_v<M, int>) {
      kind = FieldKind::integer;
    } else if constexpr (std::is_same_v<M, std::uint64_t>) {
      kind = FieldKind::seed;
    } else if constexpr (std::is_same_v<M, bool>) {
      kind = FieldKind::boolean;
    } else if constexpr (std::is_same_v<M, Vec3>) {
      kind = FieldKind::vector;
    } else if constexpr (std::is_same_v<M, Schedule>) {
      kind = FieldKind::schedule;
    } else if constexpr (std::is_same_v<M, Sketch>) {
      kind = FieldKind::sketch;
    } else if constexpr (std::is_same_v<M, std::string>) {
      kind = FieldKind::text;
    } else if constexpr (std::is_same_v<M, std::filesystem::path>) {
      kind = FieldKind::path;
    } else if constexpr (std::is_enum_v<M>) {
      kind = FieldKind::choice;
      choice = [](const void* value) { return static_cast<int>(*static_cast<const M*>(value)); };
      choose = [](void* value, int chosen) { *static_cast<M*>(value) = static_cast<M>(chosen); };
    } else if constexpr (ListOf<M>::value) {
      set_list<typename ListOf<M>::Item>();
    } else if constexpr (MapOf<M>::value) {
      set_map<typename MapOf<M>::Item>();
    } else {
      static_assert(HasFields<M>, "a member of this type cannot stand in a table");
      kind = FieldKind::group;
      child = []() -> const Table& { return M::fields(); };
    }
  }

  template <class T>
  void set_list() {
    kind = FieldKind::list;
    child = []() -> const Table& { return T::fields(); };
    size = [](const void* list) { return static_cast<const std::vector<T>*>(list)->size(); };
    item = [](void* list, std::size_t index) -> void* {
      return &(*static_cast<std::vector<T>*>(list))[index];
    };
    clear = [](void* list) { static_cast<std::vector<T>*>(list)->clear(); };
    append = [inherits = info.inherits](void* list) -> void* {
      auto& items = *static_cast<std::vector<T>*>(list);
      T added = inherits && !items.empty() ? items.back() : T{};
      items.push_back(std::move(added));
      return &items.back();
    };
    remove = [](void* list, std::size_t index) {
      auto& items = *static_cast<std::vector<T>*>(list);
      items.erase(items.begin() + static_cast<std::ptrdiff_t>(index));
    };
  }

  template <class T>
  void set_map() {
    kind = FieldKind::map;
    child = []() -> const Table& { return T::fields(); };
    names = [](const void* map) {
      std::vector<std::string> result;
      for (const auto& entry : *static_cast<const std::map<std::string, T>*>(map)) {
        result.push_back(entry.first);
      }
      return result;
    };
    clear = [](void* map) { static_cast<std::map<std::string, T>*>(map)->clear(); };
    named = [](void* map, const std::string& name) -> void* {
      return &(*static_cast<std::map<std::string, T>*>(map))[name];
    };
    remove_named = [](void* map, const std::string& name) {
      static_cast<std::map<std::string, T>*>(map)->erase(name);
    };
  }
};

template <class P>
Table make_table(std::initializer_list<Field<P>> rows) {
  return Table(rows.begin(), rows.end());
}

/// The rows of several tables, one after the other.
Table joined(std::initializer_list<Table> tables);

/// The rows of Base for a table of P, which is derived from it.
template <class P, class Base>
Table rows_of_base() {
  Table rows = Base::fields();
  for (FieldRow& row : rows) {
    row.member = [member = row.member](void* owner) {
      return member(static_cast<Base*>(static_cast<P*>(owner)));
    };
  }
  return rows;
}

/// "0 to 1", "more than 0 to 100", "true or false", "light | space": what a field allows, for messages and
/// help.
std::string allowed_values(const FieldRow& row);

/// The nearest of `known` by edit distance, or empty if none is near enough to suggest.
std::string nearest_name(std::string_view name, const std::vector<std::string>& known);

}  // namespace ramify
