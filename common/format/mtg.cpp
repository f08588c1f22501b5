#include "common/format/mtg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <map>
#include <optional>
#include <ostream>
#include <vector>

#include "common/base/errors.h"
#include "common/format/text_table.h"

namespace ramify {
namespace {

constexpr std::array<std::string_view, 5> kFeatures = {"Length", "TopDiameter", "XX", "YY", "ZZ"};
constexpr std::size_t kChunk = 1 << 16;

// --- Writing
// ------------------------------------------------------------------------------------------------

constexpr const char* kSections =
    "CODE:\tFORM-A\n\nCLASSES:\nSYMBOL\tSCALE\tDECOMPOSITION\tINDEXATION\tDEFINITION\n$"
    "\t0\tFREE\tFREE\tIMPLICIT\n"
    "P\t1\tCONNECTED\tFREE\tIMPLICIT\nA\t2\t<-LINEAR\tFREE\tEXPLICIT\nI\t3\tNONE\tFREE\tEXPLICIT\n\n"
    "DESCRIPTION:\nLEFT\tRIGHT\tRELTYPE\tMAX\nA\tA\t+\t?\nI\tI\t<\t1\nI\tI\t+\t?\n\nFEATURES:\nNAME\tTYPE\n";

/// The shortest digits that read back to the same value, without exponent.
std::string plain_number(double value) {
  std::array<char, 400> digits{};  // the smallest double has 325 after its point
  const auto [end, error] =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed);
  return {digits.data(), end};
}

/// The children of all nodes: what goes on, and the laterals as linked lists in the nodes' order.
struct Children {
  std::vector<std::uint32_t> continuation;
  std::vector<std::uint32_t> first_lateral;
  std::vector<std::uint32_t> next_lateral;
};

Children children_of(const Skeleton& s) {
  const std::vector<std::uint32_t> none(s.node_count(), kNoParent);
  Children children{none, none, none};
  for (std::size_t node = s.node_count(); node-- > s.root_count();) {
    const std::uint32_t parent = s.parent[node];
    const auto child = static_cast<std::uint32_t>(node);
    if (s.axis[node] == s.axis[parent]) {
      children.continuation[parent] = child;
    } else {
      children.next_lateral[node] = children.first_lateral[parent];
      children.first_lateral[parent] = child;
    }
  }
  return children;
}

/// How often one turns aside from the root to each node: the column it stands in.
std::vector<std::uint32_t> columns_of(const Skeleton& s) {
  std::vector<std::uint32_t> column(s.node_count(), 0);
  for (std::size_t node = s.root_count(); node < s.node_count(); ++node) {
    const std::uint32_t parent = s.parent[node];
    column[node] = column[parent] + (s.axis[node] == s.axis[parent] ? 0 : 1);
  }
  return column;
}

/// Writes nodes one by one, each in its column.
class MtgWriter {
 public:
  MtgWriter(const Skeleton& skeleton, std::ostream& out)
      : s_(skeleton), out_(out), column_(columns_of(skeleton)), rank_(skeleton.node_count(), 1) {
    column_count_ = 1 + *std::max_element(column_.begin(), column_.end());
  }

  void write() {
    text_ = kSections;
    for (const std::string_view feature : kFeatures) text_ += fmt::format("{}\tREAL\n", feature);
    text_ += "\nMTG:\nENTITY-CODE" + std::string(column_count_, '\t') +
             fmt::format("{}\n", fmt::join(kFeatures, "\t"));
    const Children children = children_of(s_);
    for (std::uint32_t root = 0; root < s_.root_count(); ++root) {
      std::vector<std::uint32_t> waiting = {root};
      while (!waiting.empty()) {
        const std::uint32_t node = waiting.back();
        waiting.pop_back();
        write_node(node);
        // The last one put is the next one taken: laterals in their order, then what goes on.
        const std::size_t first = waiting.size();
        for (std::uint32_t child = children.first_lateral[node]; child != kNoParent;
             child = children.next_lateral[child]) {
          waiting.push_back(child);
        }
        if (children.continuation[node] != kNoParent) waiting.push_back(children.continuation[node]);
        std::reverse(waiting.begin() + static_cast<std::ptrdiff_t>(first), waiting.end());
      }
    }
    flush();
  }

 private:
  void write_node(std::uint32_t node) {
    text_.append(column_[node], '\t');
    if (s_.is_root(node)) {
      text_ += fmt::format("/P{}/A{}/I1", node + 1, s_.axis[node] + std::uint64_t{1});
    } else if (s_.axis[node] == s_.axis[s_.parent[node]]) {
      rank_[node] = rank_[s_.parent[node]] + 1;
      text_ += fmt::format("^<I{}", rank_[node]);
    } else {
      text_ += fmt::format("+A{}/I1", s_.axis[node] + std::uint64_t{1});
    }
    text_.append(column_count_ - column_[node], '\t');
    const Vec3 top = z_up(s_.position[node]);
    text_ += plain_number(s_.is_root(node) ? 0.0 : s_.length(node));
    for (const double value : {s_.diameter[node], top.x, top.y, top.z}) text_ += '\t' + plain_number(value);
    text_ += '\n';
    if (text_.size() > kChunk) flush();
  }

  void flush() {
    out_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
    text_.clear();
  }

  const Skeleton& s_;
  std::ostream& out_;
  std::vector<std::uint32_t> column_;
  std::vector<std::uint32_t> rank_;  // along its axis, from 1
  std::size_t column_count_ = 1;
  std::string text_;
};

// --- Reading
// ------------------------------------------------------------------------------------------------

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (!(line = trimmed(line)).empty()) {
    const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
    words.push_back(line.substr(0, end));
    line = line.substr(end);
  }
  return words;
}

/// An entity as a code names it, and how it is tied to the one before.
struct Entity {
  char relation = '/';  // / < +
  std::string_view symbol;
};

/// The last entity of a column. While only coarser ones stand there, what the first fine one will be tied to.
struct Place {
  std::uint32_t node = kNoParent;
  char relation = '/';
};

class MtgReader {
 public:
  MtgReader(std::string_view text, const std::string& name, UpAxis up)
      : text_(without_mark(text)), name_(name), up_(up) {}

  Skeleton read() {
    read_sections();
    read_header();
    while (!text_.empty()) {
      const std::string_view line = next();
      if (!is_empty(line)) read_row(line);
    }
    if (s_.position.empty()) throw InputError(fmt::format("{}: no entities", name_));
    return with_roots_first();
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(fmt::format("{}:{}: {}", name_, line_, problem));
  }

  std::string_view next() {
    ++line_;
    return next_line(text_);
  }

  static bool is_empty(std::string_view line) {
    line = trimmed(line);
    return line.empty() || line.front() == '#';
  }

  /// Up to "MTG:"; of the sections before it only the classes' scales count.
  void read_sections() {
    bool is_in_classes = false;
    while (!text_.empty()) {
      const std::string_view line = next();
      if (is_empty(line)) continue;
      const std::vector<std::string_view> words = words_of(line.substr(0, 1000));
      if (words.front() == "MTG:") return;
      if (words.front().back() == ':') {
        is_in_classes = words.front() == "CLASSES:";
      } else if (is_in_classes && words.front() != "SYMBOL") {
        const std::optional<std::int64_t> scale = words.size() > 1 ? whole_number(words[1]) : std::nullopt;
        if (!scale || *scale < 0) fail("a class without a scale (SYMBOL, SCALE, ...)");
        scale_[std::string(words.front())] = *scale;
        finest_ = std::max(finest_, *scale);
      }
    }
    fail("no section 'MTG:' (CODE:, CLASSES:, DESCRIPTION:, FEATURES:, MTG:)");
  }

  void read_header() {
    std::string_view line;
    while (!text_.empty() && is_empty(line)) line = next();
    if (scale_.empty()) fail("no classes (section 'CLASSES:')");
    split(line, std::numeric_limits<std::size_t>::max());
    if (cells_.front() != "ENTITY-CODE" && cells_.front() != "TOPO") fail("no header 'ENTITY-CODE'");
    width_ = cells_.size();
    column_count_ = 1;
    while (column_count_ < width_ && cells_[column_count_].empty()) ++column_count_;
    for (std::size_t i = 0; i < kFeatures.size(); ++i) {
      const auto found =
          std::find(cells_.begin() + static_cast<std::ptrdiff_t>(column_count_), cells_.end(), kFeatures[i]);
      if (found != cells_.end()) {
        feature_[i] = static_cast<std::size_t>(found - cells_.begin());
      } else if (i > 0) {
        fail(fmt::format("no feature '{}' (XX, YY, ZZ and TopDiameter make a skeleton)", kFeatures[i]));
      }
    }
  }

  /// Cells between tabs, at most `most`; quotes and blanks around them go.
  void split(std::string_view line, std::size_t most) {
    cells_.clear();
    while (true) {
      const std::size_t end = line.find('\t');
      cells_.push_back(trimmed(line.substr(0, end)));
      if (end == std::string_view::npos) return;
      if (cells_.size() == most) fail(fmt::format("more cells than the header has ({})", most));
      line = line.substr(end + 1);
    }
  }

  double feature(std::size_t index) const {
    const std::string_view cell =
        feature_[index] && *feature_[index] < cells_.size() ? cells_[*feature_[index]] : "";
    const std::optional<double> value = finite_number(cell);
    if (!value) fail(fmt::format("{}: '{}' is no finite number", kFeatures[index], shown(cell)));
    return *value;
  }

  /// Cuts the next entity off a code.
  Entity next_entity(std::string_view& code) const {
    Entity entity{code.front(), {}};
    if (entity.relation != '/' && entity.relation != '<' && entity.relation != '+') {
      fail(fmt::format("entity '{}': no relation before it (/ < +)", shown(code)));
    }
    code.remove_prefix(1);
    std::size_t end = 0;
    while (end < code.size() && ((code[end] >= 'A' && code[end] <= 'Z') ||
                                 (code[end] >= 'a' && code[end] <= 'z') || code[end] == '_')) {
      ++end;
    }
    entity.symbol = code.substr(0, end);
    if (entity.symbol.empty()) fail(fmt::format("entity '{}': no class", shown(code)));
    while (end < code.size() && code[end] >= '0' && code[end] <= '9') ++end;
    code.remove_prefix(end);
    return entity;
  }

  void read_row(std::string_view line) {
    split(line, width_);
    std::size_t column = 0;
    while (column < std::min(column_count_, cells_.size()) && cells_[column].empty()) ++column;
    if (column >= std::min(column_count_, cells_.size())) fail("no entity");
    std::string_view code = cells_[column];
    Place place;
    if (code.front() == '^') {
      if (column >= places_.size()) fail(fmt::format("'{}': no entity before it in its column", shown(code)));
      place = places_[column];
      code.remove_prefix(1);
    } else if (column > 0) {
      if (column > places_.size()) fail(fmt::format("'{}': no entity in the column before it", shown(code)));
      place.node = places_[column - 1].node;
    }
    if (code.empty()) fail("'^' without an entity");
    while (!code.empty()) {
      const Entity entity = next_entity(code);
      const auto scale = scale_.find(std::string(entity.symbol));
      if (scale == scale_.end()) fail(fmt::format("'{}' is no class of CLASSES", shown(entity.symbol)));
      if (entity.relation != '/') place.relation = entity.relation;
      if (scale->second != finest_) continue;
      if (!code.empty())
        fail(fmt::format("'{}' in one row: each entity needs a row for its features", shown(cells_[column])));
      add_node(place);
      place = {static_cast<std::uint32_t>(s_.position.size() - 1), '/'};
    }
    places_.resize(column + 1);
    places_[column] = place;
  }

  void add_node(const Place& place) {
    const bool is_tied = place.relation != '/';
    if (is_tied && place.node == kNoParent) fail("nothing before it to follow or branch from");
    const Vec3 top(feature(2), feature(3), feature(4));
    const double diameter = feature(1);
    if (!(diameter > 0)) fail(fmt::format("TopDiameter: {} (must be greater than 0)", diameter));
    if (!is_tied) {
      const double length = feature(0);
      if (length == 0) return append(top, kNoParent, diameter, next_axis_++, 0);
      const Vec3 up = up_ == UpAxis::z ? Vec3(0, 0, 1) : Vec3(0, 1, 0);
      append(top - length * up, kNoParent, diameter, next_axis_++, 0);
      is_continued_.back() = true;
      return append(top, static_cast<std::uint32_t>(s_.position.size() - 1), diameter, next_axis_ - 1, 0);
    }
    const std::uint32_t parent = place.node;
    if (place.relation == '<') {
      if (is_continued_[parent]) fail("a second successor of one entity (others branch off with '+')");
      is_continued_[parent] = true;
      return append(top, parent, diameter, s_.axis[parent], s_.order[parent]);
    }
    if (s_.order[parent] == std::numeric_limits<std::uint16_t>::max()) fail("too deep a branch order");
    append(top, parent, diameter, next_axis_++, static_cast<std::uint16_t>(s_.order[parent] + 1));
  }

  void append(const Vec3& position, std::uint32_t parent, double diameter, std::uint32_t axis,
              std::uint16_t order) {
    s_.position.push_back(position);
    s_.parent.push_back(parent);
    s_.diameter.push_back(diameter);
    s_.axis.push_back(axis);
    s_.order.push_back(order);
    s_.kind.push_back(Kind::stem);
    is_continued_.push_back(false);
  }

  Skeleton with_roots_first() const {
    std::vector<std::uint32_t> nodes;
    std::vector<std::uint32_t> moved(s_.node_count());
    for (const bool wants_roots : {true, false}) {
      for (std::uint32_t node = 0; node < s_.node_count(); ++node) {
        if (s_.is_root(node) != wants_roots) continue;
        moved[node] = static_cast<std::uint32_t>(nodes.size());
        nodes.push_back(node);
      }
    }
    Skeleton result = gathered(s_, nodes);
    for (const std::uint32_t node : nodes) {
      result.parent.push_back(s_.is_root(node) ? kNoParent : moved[s_.parent[node]]);
    }
    return result;
  }

  std::string_view text_;
  const std::string& name_;
  UpAxis up_;
  std::size_t line_ = 0;
  std::map<std::string, std::int64_t> scale_;  // of each class
  std::int64_t finest_ = 0;
  std::size_t width_ = 0;         // cells of the header
  std::size_t column_count_ = 0;  // of these the entities' columns
  std::array<std::optional<std::size_t>, kFeatures.size()> feature_{};
  std::vector<std::string_view> cells_;
  std::vector<Place> places_;  // of each column up to the last entity's
  std::vector<bool> is_continued_;
  std::uint32_t next_axis_ = 0;
  Skeleton s_;  // roots where they stand
};

}  // namespace

void write_mtg(const Skeleton& skeleton, std::ostream& out) {
  MtgWriter(skeleton, out).write();
}

Skeleton read_mtg(std::string_view text, const std::string& name, UpAxis up) {
  return MtgReader(text, name, up).read();
}

}  // namespace ramify
