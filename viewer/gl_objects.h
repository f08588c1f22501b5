// OpenGL objects that delete themselves. Each needs a current context when it is made, used and destroyed.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "common/base/geometry.h"

namespace ramify {

/// The name of an OpenGL object of one kind, with its owner's lifetime.
template <class Kind>
class GlObject {
 public:
  GlObject() : id_(Kind::create()) {}
  ~GlObject() {
    if (id_ != 0) Kind::destroy(id_);
  }
  GlObject(GlObject&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }

  unsigned id() const { return id_; }

 private:
  unsigned id_ = 0;
};

// clang-format off
struct BufferKind { static unsigned create(); static void destroy(unsigned id); };
struct VertexArrayKind { static unsigned create(); static void destroy(unsigned id); };
struct TextureKind { static unsigned create(); static void destroy(unsigned id); };
struct RenderbufferKind { static unsigned create(); static void destroy(unsigned id); };
struct FramebufferKind { static unsigned create(); static void destroy(unsigned id); };
// clang-format on

using GlBuffer = GlObject<BufferKind>;
using GlVertexArray = GlObject<VertexArrayKind>;
using GlTexture = GlObject<TextureKind>;
using GlRenderbuffer = GlObject<RenderbufferKind>;
using GlFramebuffer = GlObject<FramebufferKind>;

/// A vertex and a fragment shader, linked. Uniforms that the compiler dropped may be set all the same.
class GlProgram {
 public:
  /// Sources without their #version line. Throws GraphicsError with the compiler's log and the program's
  /// name.
  GlProgram(std::string_view name, std::string_view vertex_source, std::string_view fragment_source);
  ~GlProgram();
  GlProgram(const GlProgram&) = delete;
  GlProgram& operator=(const GlProgram&) = delete;

  /// Makes it the program that draws and whose uniforms set() sets.
  void use() const;

  void set(const char* uniform, int value) const;
  void set(const char* uniform, float value) const;
  void set(const char* uniform, const Vec2f& value) const;
  void set(const char* uniform, const Vec3f& value) const;
  void set(const char* uniform, const glm::vec4& value) const;
  void set(const char* uniform, const glm::mat4& value) const;

 private:
  unsigned id_ = 0;
};

/// Fills `buffer` with the values, for vertices.
void upload_bytes(const GlBuffer& buffer, const void* data, std::size_t byte_count);

template <class T>
void upload(const GlBuffer& buffer, std::span<const T> values) {
  upload_bytes(buffer, values.data(), values.size_bytes());
}

/// Throws GraphicsError if the framebuffer that is bound for drawing cannot be drawn into.
void require_complete_framebuffer();

/// Throws GraphicsError naming the OpenGL error if one is pending; `doing` says at what ("drawing the
/// picture").
void require_no_gl_error(std::string_view doing);

}  // namespace ramify
