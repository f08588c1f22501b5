#include "common/mesh/obj.h"

#include <fmt/format.h>

#include <ostream>

namespace ramify {
namespace {

// Large enough that the stream is not the bottleneck, small enough to stay in the cache.
constexpr std::size_t kChunk = 1 << 16;

/// Formats into a buffer that goes to the stream in chunks.
class Text {
 public:
  explicit Text(std::ostream& out) : out_(out) {}
  ~Text() { flush(); }
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(buffer_), format, std::forward<Args>(args)...);
    if (buffer_.size() > kChunk) flush();
  }

 private:
  void flush() {
    out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    buffer_.clear();
  }
  std::ostream& out_;
  fmt::memory_buffer buffer_;
};

void add_config_comment(const std::string& config, Text& text) {
  std::size_t begin = 0;
  while (begin < config.size()) {
    const std::size_t end = std::min(config.find('\n', begin), config.size());
    text.add("#   {}\n", config.substr(begin, end - begin));
    begin = end + 1;
  }
}

}  // namespace

void write_obj(const Mesh& mesh, const Provenance& provenance, const std::string& material_library,
               std::ostream& out) {
  Text text(out);
  text.add("# ramify {}: engine {}, seed {}, steps {}; metres, +Y up. The config:\n", provenance.version,
           provenance.engine, provenance.seed, provenance.steps);
  add_config_comment(provenance.config, text);
  text.add("mtllib {}\no tree\n", material_library);
  for (const Vec3f& p : mesh.positions) text.add("v {} {} {}\n", p.x, p.y, p.z);
  for (const Vec2f& t : mesh.uvs) text.add("vt {} {}\n", t.x, t.y);
  for (const Vec3f& n : mesh.normals) text.add("vn {} {} {}\n", n.x, n.y, n.z);
  for (const MaterialRange& range : mesh.ranges) {
    text.add("usemtl {}\n", mesh.material(range).name);
    for (std::size_t i = range.first_triangle; i < range.first_triangle + range.triangle_count; ++i) {
      const auto [a, b, c] = mesh.triangles[i];  // OBJ counts from 1
      text.add("f {0}/{0}/{0} {1}/{1}/{1} {2}/{2}/{2}\n", a + 1, b + 1, c + 1);
    }
  }
}

void write_mtl(const Mesh& mesh, std::ostream& out) {
  Text text(out);
  for (const Material& material : mesh.materials) {
    text.add("newmtl {}\nKd 0.45 0.38 0.32\nKs 0 0 0\nillum 1\n", material.name);
  }
}

}  // namespace ramify
