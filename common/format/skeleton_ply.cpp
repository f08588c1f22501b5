#include "common/format/skeleton_ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <ostream>
#include <vector>

#include "common/base/errors.h"
#include "common/format/text_table.h"
#include "common/skeleton/passes.h"

namespace ramify {
namespace {

static_assert(std::endian::native == std::endian::little, "binary PLY is written and read as memory has it");

constexpr std::size_t kChunk = 1 << 16;
// More elements or properties than any skeleton has: each is looked for among the others.
constexpr std::size_t kMostProperties = 1000;

constexpr std::string_view kChannelPrefix = "channel.";

// --- Writing
// ------------------------------------------------------------------------------------------------

/// A property's name has no blanks: all but letters, digits, '_', '-' and '.' as %XX.
std::string escaped(std::string_view name) {
  std::string result;
  for (const char c : name) {
    const bool is_plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                          c == '_' || c == '-' || c == '.';
    result += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return result;
}

/// One column of the vertices: how the header declares it and how a node's value gets into a row.
struct VertexColumn {
  std::string declaration;
  std::function<void(std::size_t node, std::string& row)> put;
};

template <class T>
void put_bytes(const T& value, std::string& row) {
  row.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

template <class T>
void add_column(std::vector<VertexColumn>& columns, std::string declaration, const std::vector<T>& values) {
  if (values.empty()) return;
  columns.push_back({std::move(declaration),
                     [&values](std::size_t node, std::string& row) { put_bytes(values[node], row); }});
}

std::vector<VertexColumn> columns_of(const Skeleton& s) {
  static_assert(sizeof(Vec3) == 24 && sizeof(Kind) == 1);
  std::vector<VertexColumn> columns;
  add_column(columns, "double x\nproperty double y\nproperty double z", s.position);
  add_column(columns, "double diameter", s.diameter);
  add_column(columns, "uint axis", s.axis);
  add_column(columns, "ushort order", s.order);
  add_column(columns, "uchar kind", s.kind);
  add_column(columns, "uint birth_step", s.birth_step);
  add_column(columns, "uint shed_step", s.shed_step);
  add_column(columns, "ushort level", s.level);
  add_column(columns, "float light", s.light);
  add_column(columns, "float vigour", s.vigour);
  for (const auto& [name, values] : s.channels) {
    add_column(columns, fmt::format("double {}{}", kChannelPrefix, escaped(name)), values);
  }
  return columns;
}

std::string provenance_comments(const Provenance& provenance) {
  std::string text = fmt::format(
      "comment ramify version {}\ncomment ramify engine {}\ncomment ramify seed {}\ncomment ramify steps "
      "{}\n",
      provenance.version, provenance.engine, provenance.seed, provenance.steps);
  std::string_view config = provenance.config;
  while (!config.empty()) text += fmt::format("comment ramify config {}\n", next_line(config));
  return text;
}

/// Sends `count` rows off in chunks; put_row(i, row) appends one.
template <class PutRow>
void write_rows(std::size_t first, std::size_t count, std::ostream& out, PutRow put_row) {
  std::string rows;
  for (std::size_t i = first; i < count; ++i) {
    put_row(i, rows);
    if (rows.size() < kChunk && i + 1 < count) continue;
    out.write(rows.data(), static_cast<std::streamsize>(rows.size()));
    rows.clear();
  }
}

// --- The header
// ------------------------------------------------------------------------------------------------

enum class Number { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct NumberName {
  std::string_view name;
  std::string_view other_name;
  Number number;
  std::size_t size;
};

constexpr std::array kNumbers = {
    NumberName{"char", "int8", Number::int8, 1},        NumberName{"uchar", "uint8", Number::uint8, 1},
    NumberName{"short", "int16", Number::int16, 2},     NumberName{"ushort", "uint16", Number::uint16, 2},
    NumberName{"int", "int32", Number::int32, 4},       NumberName{"uint", "uint32", Number::uint32, 4},
    NumberName{"float", "float32", Number::float32, 4}, NumberName{"double", "float64", Number::float64, 8},
};

struct Property {
  std::string name;
  Number number = Number::float64;
  std::size_t offset = 0;  // in its element's row
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
  std::size_t row_size = 0;
  std::size_t begin = 0;  // in the file

  const Property* find(std::string_view wanted) const {
    const auto found = std::find_if(properties.begin(), properties.end(),
                                    [&](const Property& p) { return p.name == wanted; });
    return found == properties.end() ? nullptr : &*found;
  }
};

struct Header {
  std::vector<Element> elements;
  std::vector<std::string_view> comments;
  std::size_t size = 0;
};

/// Cuts the next word off `line`.
std::string_view next_word(std::string_view& line) {
  const std::size_t end = std::min(line.find(' '), line.size());
  const std::string_view word = line.substr(0, end);
  line.remove_prefix(std::min(end + 1, line.size()));
  return word;
}

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const std::string& name) : bytes_(bytes), rest_(bytes), name_(name) {}

  Header read() {
    if (next() != "ply") fail("no PLY file (it begins with 'ply')");
    if (next() != "format binary_little_endian 1.0") fail("not 'format binary_little_endian 1.0'");
    while (true) {
      if (rest_.empty()) fail("the header has no end ('end_header')");
      std::string_view line = next();
      if (line == "end_header") break;
      read_line(line);
    }
    header_.size = bytes_.size() - rest_.size();
    return std::move(header_);
  }

 private:
  std::string_view next() {
    ++line_;
    return next_line(rest_);
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(fmt::format("{}:{}: {}", name_, line_, problem));
  }

  void read_line(std::string_view line) {
    if (declarations_ > kMostProperties) {
      fail(fmt::format("more than {} elements and properties", kMostProperties));
    }
    const std::string_view word = next_word(line);
    if (word == "comment") {
      header_.comments.push_back(line);
    } else if (word == "element") {
      ++declarations_;
      Element element;
      element.name = next_word(line);
      const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), element.count);
      if (error != std::errc{} || end != line.data() + line.size()) {
        fail(fmt::format("element {}: '{}' is no count", shown(element.name), shown(line)));
      }
      header_.elements.push_back(std::move(element));
    } else if (word == "property") {
      read_property(line);
    } else {
      fail(fmt::format("'{}' (comment | element | property | end_header)", shown(word)));
    }
  }

  void read_property(std::string_view line) {
    ++declarations_;
    if (header_.elements.empty()) fail("a property before the first element");
    Element& element = header_.elements.back();
    const std::string_view type = next_word(line);
    const auto number = std::find_if(kNumbers.begin(), kNumbers.end(), [&](const NumberName& n) {
      return n.name == type || n.other_name == type;
    });
    if (number == kNumbers.end()) {
      fail(fmt::format("property '{}' of type '{}': a skeleton has only numbers", shown(line), shown(type)));
    }
    element.properties.push_back({std::string(line), number->number, element.row_size});
    element.row_size += number->size;
  }

  std::string_view bytes_;
  std::string_view rest_;
  const std::string& name_;
  std::size_t line_ = 0;
  std::size_t declarations_ = 0;
  Header header_;
};

/// "ramify KEY VALUE" among the comments; nullptr if there is none.
std::optional<std::string_view> comment(const Header& header, std::string_view key) {
  const std::string prefix = fmt::format("ramify {} ", key);
  for (const std::string_view text : header.comments) {
    if (text.starts_with(prefix)) return text.substr(prefix.size());
  }
  return std::nullopt;
}

std::optional<Provenance> provenance_in(const Header& header) {
  const auto version = comment(header, "version");
  const auto engine = comment(header, "engine");
  const auto seed = comment(header, "seed");
  const auto steps = comment(header, "steps");
  if (!version || !engine || !seed || !steps) return std::nullopt;
  Provenance provenance{std::string(*version), std::string(*engine), 0, 0, {}};
  std::from_chars(seed->data(), seed->data() + seed->size(), provenance.seed);
  std::from_chars(steps->data(), steps->data() + steps->size(), provenance.steps);
  constexpr std::string_view kConfig = "ramify config ";
  for (const std::string_view text : header.comments) {
    if (text.starts_with(kConfig)) provenance.config += fmt::format("{}\n", text.substr(kConfig.size()));
  }
  return provenance;
}

// --- The rows
// ------------------------------------------------------------------------------------------------

template <class T>
double loaded(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<double>(value);
}

double value_at(const char* bytes, Number number) {
  switch (number) {
    case Number::int8:
      return loaded<std::int8_t>(bytes);
    case Number::uint8:
      return loaded<std::uint8_t>(bytes);
    case Number::int16:
      return loaded<std::int16_t>(bytes);
    case Number::uint16:
      return loaded<std::uint16_t>(bytes);
    case Number::int32:
      return loaded<std::int32_t>(bytes);
    case Number::uint32:
      return loaded<std::uint32_t>(bytes);
    case Number::float32:
      return loaded<float>(bytes);
    case Number::float64:
      return loaded<double>(bytes);
  }
  return 0.0;
}

/// The rows of a header's elements, every count checked against the file's size before it is believed.
class RowReader {
 public:
  RowReader(std::string_view bytes, Header& header, const std::string& name)
      : bytes_(bytes), header_(header), name_(name) {
    std::size_t begin = header.size;
    for (Element& element : header.elements) {
      element.begin = begin;
      const std::size_t room = bytes.size() - begin;
      if (element.count > 0 && (element.row_size == 0 || element.count > room / element.row_size)) {
        fail(fmt::format("{} rows of element '{}' do not fit in the file ({} bytes)", element.count,
                         shown(element.name), bytes.size()));
      }
      begin += element.count * element.row_size;
    }
    if (begin != bytes.size()) fail(fmt::format("{} bytes after the last row", bytes.size() - begin));
  }

  const Element& element(std::string_view wanted) const {
    for (const Element& element : header_.elements) {
      if (element.name == wanted) return element;
    }
    fail(fmt::format("no element '{}' (a skeleton has vertex and edge)", wanted));
  }

  /// One property of all rows of an element, as T. Throws InputError for a value that is no T.
  template <class T>
  std::vector<T> column(const Element& element, const std::string& property) const {
    const Property* found = element.find(property);
    if (!found) fail(fmt::format("element {}: no property '{}'", element.name, property));
    std::vector<T> values;
    values.reserve(element.count);
    for (std::size_t row = 0; row < element.count; ++row) {
      const double value =
          value_at(bytes_.data() + element.begin + row * element.row_size + found->offset, found->number);
      values.push_back(converted<T>(value, element, property, row));
    }
    return values;
  }

  template <class T>
  std::vector<T> optional_column(const Element& element, const std::string& property) const {
    return element.find(property) ? column<T>(element, property) : std::vector<T>{};
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(fmt::format("{}: {}", name_, problem));
  }

 private:
  template <class T>
  T converted(double value, const Element& element, const std::string& property, std::size_t row) const {
    if constexpr (std::is_floating_point_v<T>) {
      return static_cast<T>(value);
    } else {
      const bool fits = value >= 0 && value <= static_cast<double>(std::numeric_limits<T>::max()) &&
                        value == std::trunc(value);
      if (!fits)
        fail(fmt::format("{} {}: {} {} is no whole number in range", element.name, row, property, value));
      return static_cast<T>(value);
    }
  }

  std::string_view bytes_;
  const Header& header_;
  const std::string& name_;
};

std::string unescaped(std::string_view name, const RowReader& rows) {
  std::string result;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] != '%') {
      result += name[i];
      continue;
    }
    unsigned char code = 0;
    const char* first = name.data() + i + 1;
    const char* last = name.data() + std::min(i + 3, name.size());
    const auto [end, error] = std::from_chars(first, last, code, 16);
    if (error != std::errc{} || end != first + 2)
      rows.fail(fmt::format("property '{}': a '%' without two digits", shown(name)));
    result += static_cast<char>(code);
    i += 2;
  }
  return result;
}

std::vector<Kind> kinds_of(const RowReader& rows, const Element& vertices) {
  const auto numbers = rows.optional_column<std::uint8_t>(vertices, "kind");
  std::vector<Kind> kinds(vertices.count, Kind::stem);
  for (std::size_t node = 0; node < numbers.size(); ++node) {
    if (numbers[node] > 1) rows.fail(fmt::format("vertex {}: kind {} (0 stem, 1 root)", node, numbers[node]));
    kinds[node] = numbers[node] == 1 ? Kind::root : Kind::stem;
  }
  return kinds;
}

std::vector<std::uint32_t> parents_of(const RowReader& rows, const Element& vertices) {
  const Element& edges = rows.element("edge");
  const auto from = rows.column<std::uint32_t>(edges, "vertex1");
  const auto to = rows.column<std::uint32_t>(edges, "vertex2");
  std::vector<std::uint32_t> parents(vertices.count, kNoParent);
  for (std::size_t edge = 0; edge < from.size(); ++edge) {
    if (from[edge] >= vertices.count || to[edge] >= vertices.count) {
      rows.fail(fmt::format("edge {}: from vertex {} to {} (0 to {})", edge, from[edge], to[edge],
                            static_cast<std::int64_t>(vertices.count) - 1));
    }
    if (parents[to[edge]] != kNoParent) {
      rows.fail(fmt::format("edge {}: vertex {} has two parents, {} and {}", edge, to[edge],
                            parents[to[edge]], from[edge]));
    }
    parents[to[edge]] = from[edge];
  }
  return parents;
}

std::optional<PipeModel> pipe_model_in(const Header& header, const RowReader& rows) {
  std::optional<std::string_view> text = comment(header, "pipe_model");
  if (!text) return std::nullopt;
  const std::optional<double> exponent = finite_number(next_word(*text));
  const std::optional<double> tip = finite_number(*text);
  if (!exponent || !tip || !(*exponent > 0) || !(*tip > 0)) {
    rows.fail("comment ramify pipe_model: not an exponent and a tip's diameter, both greater than 0");
  }
  return PipeModel{*exponent, *tip};
}

}  // namespace

void write_skeleton_ply(const Skeleton& skeleton, const std::optional<Provenance>& provenance,
                        std::ostream& out) {
  const std::vector<VertexColumn> columns = columns_of(skeleton);
  out << "ply\nformat binary_little_endian 1.0\ncomment a tree's skeleton, metres, +Y up\n";
  if (provenance) out << provenance_comments(*provenance);
  if (skeleton.pipe_model) {
    out << fmt::format("comment ramify pipe_model {} {}\n", skeleton.pipe_model->exponent,
                       skeleton.pipe_model->tip_diameter);
  }
  out << fmt::format("element vertex {}\n", skeleton.node_count());
  for (const VertexColumn& column : columns) out << "property " << column.declaration << '\n';
  out << fmt::format("element edge {}\nproperty uint vertex1\nproperty uint vertex2\nend_header\n",
                     skeleton.internode_count());
  write_rows(0, skeleton.node_count(), out, [&](std::size_t node, std::string& row) {
    for (const VertexColumn& column : columns) column.put(node, row);
  });
  write_rows(skeleton.root_count(), skeleton.node_count(), out, [&](std::size_t node, std::string& row) {
    put_bytes(skeleton.parent[node], row);
    put_bytes(static_cast<std::uint32_t>(node), row);
  });
}

SkeletonPly read_skeleton_ply(std::string_view bytes, const std::string& name) {
  Header header = HeaderReader(bytes, name).read();
  const RowReader rows(bytes, header, name);
  const Element& vertices = rows.element("vertex");
  SkeletonPly result{{}, provenance_in(header)};
  Skeleton& s = result.skeleton;
  s.parent = parents_of(rows, vertices);
  const auto x = rows.column<double>(vertices, "x");
  const auto y = rows.column<double>(vertices, "y");
  const auto z = rows.column<double>(vertices, "z");
  for (std::size_t node = 0; node < x.size(); ++node) s.position.emplace_back(x[node], y[node], z[node]);
  s.diameter = rows.column<double>(vertices, "diameter");
  s.kind = kinds_of(rows, vertices);
  s.axis = rows.optional_column<std::uint32_t>(vertices, "axis");
  s.order = rows.optional_column<std::uint16_t>(vertices, "order");
  s.birth_step = rows.optional_column<std::uint32_t>(vertices, "birth_step");
  s.shed_step = rows.optional_column<std::uint32_t>(vertices, "shed_step");
  s.level = rows.optional_column<std::uint16_t>(vertices, "level");
  s.light = rows.optional_column<float>(vertices, "light");
  s.vigour = rows.optional_column<float>(vertices, "vigour");
  for (const Property& property : vertices.properties) {
    if (!property.name.starts_with(kChannelPrefix)) continue;
    const std::string channel =
        unescaped(std::string_view(property.name).substr(kChannelPrefix.size()), rows);
    s.channels[channel] = rows.column<double>(vertices, property.name);
  }
  s.pipe_model = pipe_model_in(header, rows);
  if (s.axis.empty() || s.order.empty()) assign_axes(s);
  const std::vector<std::string> problems = violations(s, 1);
  if (!problems.empty()) rows.fail(problems.front());
  return result;
}

std::optional<Provenance> ply_provenance(std::string_view bytes) {
  try {
    return provenance_in(HeaderReader(bytes, "").read());
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace ramify
