#include "common/format/embedded_config.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "common/base/errors.h"
#include "common/format/skeleton_ply.h"

namespace ramify {
namespace {

namespace fs = std::filesystem;

// No header of ours comes near; what is no PLY need not be searched to its end.
constexpr std::size_t kLongestHeader = 1 << 24;

/// Walks JSON and keeps the string at asset.extras.ramify.config.
class ConfigFinder : public nlohmann::json_sax<nlohmann::json> {
 public:
  std::optional<std::string> config;
  std::string problem;

  bool null() override { return pass(); }
  bool boolean(bool) override { return pass(); }
  bool number_integer(number_integer_t) override { return pass(); }
  bool number_unsigned(number_unsigned_t) override { return pass(); }
  bool number_float(number_float_t, const string_t&) override { return pass(); }
  bool binary(binary_t&) override { return pass(); }
  bool string(string_t& text) override {
    if (is_next_ && matched_ + 1 == kPath.size()) config = text;
    return pass();
  }
  bool start_object(std::size_t) override {
    if (is_next_) ++matched_;
    is_next_ = false;
    ++depth_;
    return true;
  }
  bool key(string_t& name) override {
    is_next_ = depth_ == matched_ + 1 && matched_ < kPath.size() && name == kPath[matched_];
    return true;
  }
  bool end_object() override { return leave(); }
  bool start_array(std::size_t) override {
    is_next_ = false;
    ++depth_;
    return true;
  }
  bool end_array() override { return leave(); }
  bool parse_error(std::size_t position, const std::string&, const nlohmann::json::exception&) override {
    problem = fmt::format("no JSON at byte {}", position);
    return false;
  }

 private:
  static constexpr std::array<std::string_view, 4> kPath = {"asset", "extras", "ramify", "config"};

  bool pass() {
    is_next_ = false;
    return true;
  }
  bool leave() {
    --depth_;
    matched_ = std::min(matched_, depth_ > 0 ? depth_ - 1 : 0);
    is_next_ = false;
    return true;
  }

  std::size_t depth_ = 0;    // objects and lists around
  std::size_t matched_ = 0;  // names of kPath that the outermost of them have
  bool is_next_ = false;     // the value to come has the next name
};

template <class Input>
std::optional<std::string> config_in_json(Input&& input, const std::string& name) {
  ConfigFinder finder;
  if (!nlohmann::json::sax_parse(std::forward<Input>(input), &finder)) {
    throw InputError(fmt::format("{}: no glTF: {}", name, finder.problem));
  }
  return finder.config;
}

/// The JSON part of a binary glTF: a header of 12 bytes, then chunks of a length, a type and their bytes.
std::string json_part(std::ifstream& file, std::uintmax_t size, const std::string& name) {
  std::array<char, 20> head{};
  std::uint32_t length = 0;
  const bool is_read = static_cast<bool>(file.read(head.data(), head.size()));
  std::memcpy(&length, head.data() + 12, sizeof(length));
  if (!is_read || std::memcmp(head.data() + 16, "JSON", 4) != 0 || length > size - head.size()) {
    throw InputError(fmt::format("{}: no glTF: its first part is no JSON within the file", name));
  }
  std::string text(length, '\0');
  if (!file.read(text.data(), static_cast<std::streamsize>(length))) {
    throw InputError(fmt::format("{}: cannot read", name));
  }
  return text;
}

std::optional<std::string> config_in_ply(std::ifstream& file, std::uintmax_t size) {
  std::string header(std::min<std::uintmax_t>(size, kLongestHeader), '\0');
  file.read(header.data(), static_cast<std::streamsize>(header.size()));
  const std::optional<Provenance> provenance = ply_provenance(header);
  if (!provenance || provenance->config.empty()) return std::nullopt;
  return provenance->config;
}

bool is_skeleton_ply(const fs::path& path) {
  return path.filename().string().ends_with(".skel.ply");
}

}  // namespace

bool may_embed_config(const fs::path& path) {
  const fs::path ending = path.extension();
  return ending == ".glb" || ending == ".gltf" || is_skeleton_ply(path);
}

std::string embedded_config(const fs::path& path) {
  const std::string name = path.string();
  std::error_code error;
  if (fs::is_directory(path, error)) throw InputError(fmt::format("{}: is a folder, not a file", name));
  std::ifstream file(path, std::ios::binary);
  const std::uintmax_t size = fs::file_size(path, error);
  if (!file || error) throw InputError(fmt::format("{}: cannot read", name));

  std::optional<std::string> config;
  if (is_skeleton_ply(path)) {
    config = config_in_ply(file, size);
  } else {
    std::array<char, 4> magic{};
    file.read(magic.data(), magic.size());
    const bool is_binary = file && std::string_view(magic.data(), magic.size()) == "glTF";
    file.clear();
    file.seekg(0);
    config = is_binary ? config_in_json(json_part(file, size, name), name) : config_in_json(file, name);
  }
  if (!config) {
    throw InputError(
        fmt::format("{}: no config of ramify inside (files that `ramify generate` wrote have one)", name));
  }
  return *config;
}

}  // namespace ramify
