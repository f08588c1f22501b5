#include "common/config/toml_reader.h"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>

#include "common/base/errors.h"

namespace ramify {
namespace {

std::string joined(const std::string& prefix, std::string_view key) {
  return prefix.empty() ? std::string(key) : fmt::format("{}.{}", prefix, key);
}

std::string_view type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "a whole number";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    default:
      return "a date or time";
  }
}

/// What stands where something else should, a short text with its words.
std::string described(const toml::node& node) {
  constexpr std::size_t kShort = 40;  // bytes
  const auto* text = node.as_string();
  if (!text || text->get().size() > kShort) return std::string(type_name(node));
  return fmt::format("a string, '{}'", text->get());
}

const FieldRow* find_row(const Table& table, std::string_view key) {
  const auto row = std::find_if(table.begin(), table.end(), [&](const FieldRow& r) { return r.key == key; });
  return row == table.end() ? nullptr : &*row;
}

/// The dotted key, below `table`, of a row called `key`, looked for in groups: somebody who writes `lambda`
/// at the top means `growth.lambda`.
std::string key_in_groups(const Table& table, std::string_view key, const std::string& prefix) {
  for (const FieldRow& row : table) {
    if (row.kind != FieldKind::group || &row.child() == &table) continue;
    if (find_row(row.child(), key)) return joined(joined(prefix, row.key), key);
  }
  return {};
}

/// One walk over a table and the TOML that goes into it.
class Reader {
 public:
  /// `file` names the text; without lines all messages begin with it instead of FILE:LINE. Paths in the text
  /// start from `folder`.
  Reader(std::string file, bool has_lines, std::filesystem::path folder, Origins& origins)
      : file_(std::move(file)), has_lines_(has_lines), folder_(std::move(folder)), origins_(origins) {}

  void read_table(const Table& table, void* owner, const toml::table& values, const std::string& prefix,
                  const std::vector<std::string>& but_for = {}) {
    // toml++ sorts by key; the first mistake in the file is the one to report.
    std::vector<std::pair<std::string_view, const toml::node*>> entries;
    for (const auto& [key, node] : values) entries.emplace_back(key.str(), &node);
    std::stable_sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
      return a.second->source().begin.line < b.second->source().begin.line;
    });
    for (const auto& [key, node] : entries) {
      if (std::find(but_for.begin(), but_for.end(), key) != but_for.end()) continue;
      read_field(known_row(table, key, prefix, *node), owner, *node, joined(prefix, key));
    }
  }

  /// Follows a dotted key and reads `node` at its end.
  void assign(const Table& table, void* owner, std::string_view key, const toml::node& node) {
    const Table* rows = &table;
    std::string path;
    while (true) {
      const std::string_view name = next_name(key);
      const FieldRow& row = known_row(*rows, name, path, node);
      path = joined(path, name);
      if (key.empty()) return read_field(row, owner, node, path);

      void* member = row.member(owner);
      switch (row.kind) {
        case FieldKind::group:
          owner = member;
          break;
        case FieldKind::list:
          owner = listed_item(row, member, next_name(key), path, node);
          break;
        case FieldKind::map:
          owner = named_item(row, member, next_name(key), path);
          break;
        default:
          fail(node, joined(path, key), fmt::format("'{}' holds no keys ({})", path, allowed_values(row)));
      }
      rows = &row.child();
      if (key.empty()) {
        const toml::table* values = node.as_table();
        if (!values) fail(node, path, fmt::format("{} (a table)", described(node)));
        return read_table(*rows, owner, *values, path);
      }
    }
  }

 private:
  [[noreturn]] void fail(const toml::node& node, const std::string& key, const std::string& problem) const {
    throw ConfigError(where(node), key, problem);
  }

  std::string where(const toml::node& node) const {
    return has_lines_ ? fmt::format("{}:{}", file_, node.source().begin.line) : file_;
  }

  const FieldRow& known_row(const Table& table, std::string_view key, const std::string& prefix,
                            const toml::node& node) const {
    if (const FieldRow* row = find_row(table, key)) return *row;
    std::vector<std::string> names;
    for (const FieldRow& row : table) names.push_back(row.key);
    std::string meant = key_in_groups(table, key, prefix);
    if (meant.empty()) {
      const std::string nearest = nearest_name(key, names);
      if (!nearest.empty()) meant = joined(prefix, nearest);
    }
    fail(node, joined(prefix, key),
         meant.empty() ? fmt::format("unknown key (known: {})", fmt::join(names, ", "))
                       : fmt::format("unknown key; did you mean '{}'?", meant));
  }

  /// Cuts the first name off a dotted key.
  static std::string_view next_name(std::string_view& key) {
    const std::size_t dot = key.find('.');
    const std::string_view name = key.substr(0, dot);
    key = dot == std::string_view::npos ? std::string_view{} : key.substr(dot + 1);
    return name;
  }

  void* listed_item(const FieldRow& row, void* list, std::string_view name, std::string& path,
                    const toml::node& node) const {
    const std::size_t count = row.size(list);
    std::size_t number = 0;
    const bool is_number = !name.empty() && name.size() < 9 &&
                           std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (is_number) number = std::stoul(std::string(name));
    const std::string list_path = path;
    path = joined(path, name);
    if (count == 0)
      fail(node, path, fmt::format("{} is empty (set the whole list: {}=[...])", list_path, list_path));
    if (number < 1 || number > count) {
      fail(node, path, fmt::format("'{}' is no item of {} (1 to {})", name, list_path, count));
    }
    return row.item(list, number - 1);
  }

  void* named_item(const FieldRow& row, void* map, std::string_view name, std::string& path) const {
    path = joined(path, name);
    return row.named(map, std::string(name));
  }

  void read_field(const FieldRow& row, void* owner, const toml::node& node, const std::string& path) {
    void* member = row.member(owner);
    switch (row.kind) {
      case FieldKind::number:
        *static_cast<double*>(member) = number(row, node, path);
        break;
      case FieldKind::integer:
        *static_cast<int*>(member) = static_cast<int>(integer(row, node, path));
        break;
      case FieldKind::seed:
        *static_cast<std::uint64_t*>(member) = seed(row, node, path);
        break;
      case FieldKind::boolean:
        *static_cast<bool*>(member) = boolean(row, node, path);
        break;
      case FieldKind::choice:
        row.choose(member, choice(row, node, path));
        break;
      case FieldKind::vector:
        *static_cast<Vec3*>(member) = vector(row, node, path);
        break;
      case FieldKind::schedule:
        *static_cast<Schedule*>(member) = schedule(row, node, path);
        break;
      case FieldKind::sketch:
        *static_cast<Sketch*>(member) = sketch(row, node, path);
        break;
      case FieldKind::text:
        *static_cast<std::string*>(member) = text(row, node, path);
        break;
      case FieldKind::path:
        *static_cast<std::filesystem::path*>(member) = file_path(row, node, path);
        break;
      case FieldKind::group:
        read_table(row.child(), member, table(row, node, path), path);
        break;
      case FieldKind::list:
        read_list(row, member, node, path);
        break;
      case FieldKind::map:
        read_map(row, member, node, path);
        break;
    }
    origins_[path] = where(node);
  }

  const toml::table& table(const FieldRow& row, const toml::node& node, const std::string& path) const {
    if (const toml::table* values = node.as_table()) return *values;
    fail(node, path, fmt::format("{} ({})", described(node), allowed_values(row)));
  }

  /// An array is the whole list; a table, such as [pathplan.levels.2], changes the items it names.
  void read_list(const FieldRow& row, void* list, const toml::node& node, const std::string& path) {
    if (const toml::table* named = node.as_table()) return change_items(row, list, *named, path);
    const toml::array* items = node.as_array();
    if (!items) fail(node, path, fmt::format("{} ({})", described(node), allowed_values(row)));
    row.clear(list);
    std::size_t number = 0;
    for (const toml::node& item : *items) {
      const std::string item_path = joined(path, std::to_string(++number));
      const toml::table* values = item.as_table();
      if (!values) fail(item, item_path, fmt::format("{} (a table)", described(item)));
      read_table(row.child(), row.append(list), *values, item_path);
    }
  }

  void change_items(const FieldRow& row, void* list, const toml::table& named, const std::string& path) {
    for (const auto& [key, value] : named) {
      std::string item_path = path;
      void* item = listed_item(row, list, key.str(), item_path, value);
      const toml::table* values = value.as_table();
      if (!values) fail(value, item_path, fmt::format("{} (a table)", described(value)));
      read_table(row.child(), item, *values, item_path);
      origins_[item_path] = where(value);
    }
  }

  void read_map(const FieldRow& row, void* map, const toml::node& node, const std::string& path) {
    for (const auto& [key, value] : table(row, node, path)) {
      const std::string item_path = joined(path, key.str());
      const toml::table* values = value.as_table();
      if (!values) fail(value, item_path, fmt::format("{} (a table)", described(value)));
      read_table(row.child(), row.named(map, std::string(key.str())), *values, item_path);
    }
  }

  double number(const FieldRow& row, const toml::node& node, const std::string& path) const {
    double value = 0.0;
    if (const auto* whole = node.as_integer()) {
      value = static_cast<double>(whole->get());
    } else if (const auto* real = node.as_floating_point()) {
      value = real->get();
    } else {
      fail(node, path, fmt::format("{} ({})", described(node), allowed_values(row)));
    }
    const FieldInfo& info = row.info;
    const bool is_allowed =
        value >= info.min && value <= info.max && !(info.is_above_min && value == info.min);
    if (!is_allowed) fail(node, path, fmt::format("{} is out of range ({})", value, allowed_values(row)));
    return value;
  }

  std::int64_t integer(const FieldRow& row, const toml::node& node, const std::string& path) const {
    const auto* whole = node.as_integer();
    if (!whole) {
      const auto* real = node.as_floating_point();
      fail(node, path,
           real ? fmt::format("{} is no whole number ({})", real->get(), allowed_values(row))
                : fmt::format("{} ({})", described(node), allowed_values(row)));
    }
    const std::int64_t value = whole->get();
    const bool is_allowed =
        static_cast<double>(value) >= row.info.min && static_cast<double>(value) <= row.info.max;
    if (!is_allowed) fail(node, path, fmt::format("{} is out of range ({})", value, allowed_values(row)));
    return value;
  }

  std::uint64_t seed(const FieldRow& row, const toml::node& node, const std::string& path) const {
    const auto* whole = node.as_integer();
    if (!whole) fail(node, path, fmt::format("{} ({})", described(node), allowed_values(row)));
    if (whole->get() < 0) {
      fail(node, path, fmt::format("{} is out of range ({})", whole->get(), allowed_values(row)));
    }
    return static_cast<std::uint64_t>(whole->get());
  }

  bool boolean(const FieldRow& row, const toml::node& node, const std::string& path) const {
    const auto* value = node.as_boolean();
    if (!value) fail(node, path, fmt::format("{} ({})", described(node), allowed_values(row)));
    return value->get();
  }

  int choice(const FieldRow& row, const toml::node& node, const std::string& path) const {
    const auto* text = node.as_string();
    if (!text) fail(node, path, fmt::format("{} ({})", described(node), allowed_values(row)));
    const std::vector<std::string>& choices = row.info.choices;
    const auto found = std::find(choices.begin(), choices.end(), text->get());
    if (found == choices.end()) {
      fail(node, path, fmt::format("'{}' is not known ({})", text->get(), allowed_values(row)));
    }
    return static_cast<int>(found - choices.begin());
  }

  Vec3 vector(const FieldRow& row, const toml::node& node, const std::string& path) const {
    const toml::array* items = node.as_array();
    if (!items) fail(node, path, fmt::format("{} ({})", described(node), allowed_values(row)));
    if (items->size() != 3) {
      fail(node, path, fmt::format("a list of {} ({})", items->size(), allowed_values(row)));
    }
    return {number(row, *items->get(0), path), number(row, *items->get(1), path),
            number(row, *items->get(2), path)};
  }

  Schedule schedule(const FieldRow& row, const toml::node& node, const std::string& path) const {
    const toml::array* items = node.as_array();
    if (!items) return Schedule(number(row, node, path));
    if (items->empty()) fail(node, path, fmt::format("an empty list ({})", allowed_values(row)));
    std::vector<std::pair<double, double>> points;
    for (const toml::node& item : *items) {
      const toml::array* point = item.as_array();
      if (!point || point->size() != 2) {
        fail(item, path,
             fmt::format("a schedule's point is [{}, value] ({})", row.info.over, allowed_values(row)));
      }
      const auto step = point->get(0)->value<double>();
      if (!step || !std::isfinite(*step)) {
        fail(item, path, fmt::format("a schedule's {} is a number ({})", row.info.over, allowed_values(row)));
      }
      if (!points.empty() && *step <= points.back().first) {
        fail(item, path,
             fmt::format("{} {} does not rise above {} ({})", row.info.over, *step, points.back().first,
                         allowed_values(row)));
      }
      points.emplace_back(*step, number(row, *point->get(1), path));
    }
    return Schedule(std::move(points));
  }

  std::string text(const FieldRow& row, const toml::node& node, const std::string& path) const {
    const auto* value = node.as_string();
    if (!value) fail(node, path, fmt::format("{} ({})", described(node), allowed_values(row)));
    return value->get();
  }

  /// "" is no file.
  std::filesystem::path file_path(const FieldRow& row, const toml::node& node,
                                  const std::string& path) const {
    const std::string name = text(row, node, path);
    if (name.empty()) return {};
    return (folder_ / name).lexically_normal();
  }

  Sketch sketch(const FieldRow& row, const toml::node& node, const std::string& path) const {
    const toml::array* items = node.as_array();
    if (!items) fail(node, path, fmt::format("{} ({})", described(node), allowed_values(row)));
    Sketch points;
    for (const toml::node& item : *items) {
      const std::string item_path = joined(path, std::to_string(points.size() + 1));
      const toml::array* point = item.as_array();
      if (!point || point->size() != 2) {
        fail(item, item_path, fmt::format("a point is [x, y] ({})", allowed_values(row)));
      }
      points.emplace_back(number(row, *point->get(0), item_path), number(row, *point->get(1), item_path));
    }
    return points;
  }

  std::string file_;
  bool has_lines_;
  std::filesystem::path folder_;
  Origins& origins_;
};

/// The value of `--set KEY=VALUE`: TOML, or a bare word or path taken as a string.
toml::table parsed_value(std::string_view value, const std::string& where, std::string_view key) {
  const auto is_word_character = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("-_./").find(c) != std::string_view::npos;
  };
  try {
    return toml::parse(fmt::format("value = {}", value));
  } catch (const toml::parse_error&) {
    // .3 is meant as a number, which TOML writes 0.3.
    const bool is_number = value.size() > 1 && value[0] == '.' && value[1] >= '0' && value[1] <= '9';
    if (!value.empty() && !is_number && std::all_of(value.begin(), value.end(), is_word_character)) {
      return toml::table{{"value", std::string(value)}};
    }
    throw ConfigError(where, std::string(key), fmt::format("'{}' is no TOML value", value));
  }
}

}  // namespace

struct TomlDocument::Parsed {
  toml::table values;
  std::string file;
  std::filesystem::path folder;
};

TomlDocument::TomlDocument(std::string_view text, std::string file, std::filesystem::path folder) {
  try {
    parsed_ = std::make_unique<Parsed>(Parsed{toml::parse(text), file, std::move(folder)});
  } catch (const toml::parse_error& error) {
    std::string description(error.description());
    // toml++ may say on several lines what we say on one.
    std::replace(description.begin(), description.end(), '\n', ' ');
    throw ConfigError(fmt::format("{}:{}", file, error.source().begin.line), "", "no TOML: " + description);
  }
}

TomlDocument::~TomlDocument() = default;

std::optional<std::string> TomlDocument::top_string(std::string_view key) const {
  const toml::node* node = parsed_->values.get(key);
  if (!node) return std::nullopt;
  if (const auto* text = node->as_string()) return text->get();
  throw ConfigError(where(key), std::string(key), fmt::format("{} (a string)", described(*node)));
}

std::string TomlDocument::where(std::string_view key) const {
  const toml::node* node = parsed_->values.get(key);
  return node ? fmt::format("{}:{}", parsed_->file, node->source().begin.line) : parsed_->file;
}

void TomlDocument::read_into(const Table& table, void* owner, const std::vector<std::string>& but_for,
                             Origins& origins) const {
  Reader(parsed_->file, true, parsed_->folder, origins)
      .read_table(table, owner, parsed_->values, "", but_for);
}

void assign(const Table& table, void* owner, std::string_view key, std::string_view value,
            const std::string& where, Origins& origins) {
  const toml::table parsed = parsed_value(value, where, key);
  Reader(where, false, {}, origins).assign(table, owner, key, *parsed.get("value"));
}

}  // namespace ramify
