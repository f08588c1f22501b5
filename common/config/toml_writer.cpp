#include "common/config/toml_writer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace ramify {
namespace {

bool is_table(const FieldRow& row) {
  return row.kind == FieldKind::group || row.kind == FieldKind::list || row.kind == FieldKind::map;
}

/// A TOML string with all that would end or break it escaped.
std::string toml_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || code == 0x7f) {
      result += fmt::format("\\u{:04x}", code);
      continue;
    }
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

/// A TOML key: bare where it can be, quoted where it must.
std::string key_text(const std::string& key) {
  const bool is_bare = !key.empty() && key.find_first_not_of(
                                           "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                           "0123456789_-") == std::string::npos;
  return is_bare ? key : toml_string(key);
}

std::string sketch_text(const Sketch& sketch) {
  std::vector<std::string> points;
  for (const Vec2& point : sketch) points.push_back(fmt::format("[{}, {}]", point.x, point.y));
  return fmt::format("[{}]", fmt::join(points, ", "));
}

std::string schedule_text(const Schedule& schedule) {
  if (schedule.is_constant()) return fmt::format("{}", schedule.points().front().second);
  std::vector<std::string> points;
  for (const auto& [step, value] : schedule.points()) points.push_back(fmt::format("[{}, {}]", step, value));
  return fmt::format("[{}]", fmt::join(points, ", "));
}

class Writer {
 public:
  explicit Writer(TomlStyle style) : style_(style) {}

  void write_table(const Table& table, void* owner, const std::string& prefix) {
    for (const FieldRow& row : table) {
      if (!is_table(row)) write_scalar(row, row.member(owner));
      if (row.kind == FieldKind::list && row.size(row.member(owner)) == 0) {
        text_ += fmt::format("{} = []\n", row.key);
      }
    }
    for (const FieldRow& row : table) {
      if (is_table(row)) write_nested(row, row.member(owner), prefix + key_text(row.key));
    }
  }

  std::string take() { return std::move(text_); }

 private:
  void write_scalar(const FieldRow& row, const void* member) {
    if (style_.with_comments) {
      const FieldInfo& info = row.info;
      text_ += fmt::format("# {}{}; {}{}\n", info.help, info.unit.empty() ? "" : ", in " + info.unit,
                           allowed_values(row), info.source.empty() ? "" : " [" + info.source + "]");
    }
    text_ += fmt::format("{} = {}\n", row.key, toml_value(row, member));
  }

  void write_nested(const FieldRow& row, void* member, const std::string& path) {
    if (row.kind == FieldKind::group) {
      write_header("[", path, "]", row);
      write_table(row.child(), member, path + ".");
    } else if (row.kind == FieldKind::list) {
      for (std::size_t i = 0; i < row.size(member); ++i) {
        write_header("[[", path, "]]", row);
        write_table(row.child(), row.item(member, i), path + ".");
      }
    } else {
      for (const std::string& name : row.names(member)) {
        write_header("[", path + "." + key_text(name), "]", row);
        write_table(row.child(), row.named(member, name), path + "." + key_text(name) + ".");
      }
    }
  }

  void write_header(const char* open, const std::string& path, const char* close, const FieldRow& row) {
    text_ += '\n';
    if (style_.with_comments && !row.info.help.empty()) text_ += fmt::format("# {}\n", row.info.help);
    text_ += fmt::format("{}{}{}\n", open, path, close);
  }

  TomlStyle style_;
  std::string text_;
};

}  // namespace

std::string toml_value(const FieldRow& row, const void* member) {
  switch (row.kind) {
    case FieldKind::number:
      return fmt::format("{}", *static_cast<const double*>(member));
    case FieldKind::integer:
      return fmt::format("{}", *static_cast<const int*>(member));
    case FieldKind::seed:
      return fmt::format("{}", *static_cast<const std::uint64_t*>(member));
    case FieldKind::boolean:
      return *static_cast<const bool*>(member) ? "true" : "false";
    case FieldKind::choice:
      return fmt::format("\"{}\"", row.info.choices.at(static_cast<std::size_t>(row.choice(member))));
    case FieldKind::vector: {
      const Vec3& v = *static_cast<const Vec3*>(member);
      return fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
    }
    case FieldKind::schedule:
      return schedule_text(*static_cast<const Schedule*>(member));
    case FieldKind::sketch:
      return sketch_text(*static_cast<const Sketch*>(member));
    case FieldKind::text:
      return toml_string(*static_cast<const std::string*>(member));
    case FieldKind::path:
      return toml_string(static_cast<const std::filesystem::path*>(member)->string());
    case FieldKind::group:
    case FieldKind::list:
    case FieldKind::map:
      break;
  }
  return {};
}

std::string to_toml(const Table& table, const void* owner, const TomlStyle& style) {
  Writer writer(style);
  // Rows hand out addresses of members; nothing is written through them here.
  writer.write_table(table, const_cast<void*>(owner), "");
  return writer.take();
}

}  // namespace ramify
