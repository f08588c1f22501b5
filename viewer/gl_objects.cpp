#include "viewer/gl_objects.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>
#include <glm/gtc/type_ptr.hpp>

#include "common/base/errors.h"

namespace ramify {
namespace {

constexpr std::string_view kVersion = "#version 330 core\n";

/// First line of an information log: errors are told in one line.
std::string first_line(std::string log) {
  log.resize(std::min(log.find_first_of(std::string_view("\n\0", 2)), log.size()));
  return log;
}

unsigned compiled_shader(GLenum stage, std::string_view name, std::string_view source) {
  const unsigned shader = glCreateShader(stage);
  const std::array<const char*, 2> texts = {kVersion.data(), source.data()};
  const std::array<GLint, 2> lengths = {static_cast<GLint>(kVersion.size()),
                                        static_cast<GLint>(source.size())};
  glShaderSource(shader, 2, texts.data(), lengths.data());
  glCompileShader(shader);
  GLint is_compiled = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &is_compiled);
  if (is_compiled) return shader;

  std::string log(1024, '\0');
  glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
  glDeleteShader(shader);
  throw GraphicsError(fmt::format("{} shader '{}' does not compile: {}",
                                  stage == GL_VERTEX_SHADER ? "vertex" : "fragment", name, first_line(log)));
}

const char* error_name(GLenum error) {
  switch (error) {
    case GL_OUT_OF_MEMORY:
      return "out of memory";
    case GL_INVALID_ENUM:
      return "invalid enum";
    case GL_INVALID_VALUE:
      return "invalid value";
    case GL_INVALID_OPERATION:
      return "invalid operation";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "invalid framebuffer operation";
    default:
      return "unknown error";
  }
}

}  // namespace

unsigned BufferKind::create() {
  unsigned id = 0;
  glGenBuffers(1, &id);
  return id;
}
void BufferKind::destroy(unsigned id) {
  glDeleteBuffers(1, &id);
}

unsigned VertexArrayKind::create() {
  unsigned id = 0;
  glGenVertexArrays(1, &id);
  return id;
}
void VertexArrayKind::destroy(unsigned id) {
  glDeleteVertexArrays(1, &id);
}

unsigned TextureKind::create() {
  unsigned id = 0;
  glGenTextures(1, &id);
  return id;
}
void TextureKind::destroy(unsigned id) {
  glDeleteTextures(1, &id);
}

unsigned RenderbufferKind::create() {
  unsigned id = 0;
  glGenRenderbuffers(1, &id);
  return id;
}
void RenderbufferKind::destroy(unsigned id) {
  glDeleteRenderbuffers(1, &id);
}

unsigned FramebufferKind::create() {
  unsigned id = 0;
  glGenFramebuffers(1, &id);
  return id;
}
void FramebufferKind::destroy(unsigned id) {
  glDeleteFramebuffers(1, &id);
}

GlProgram::GlProgram(std::string_view name, std::string_view vertex_source,
                     std::string_view fragment_source) {
  const unsigned vertex = compiled_shader(GL_VERTEX_SHADER, name, vertex_source);
  const unsigned fragment = compiled_shader(GL_FRAGMENT_SHADER, name, fragment_source);
  id_ = glCreateProgram();
  glAttachShader(id_, vertex);
  glAttachShader(id_, fragment);
  glLinkProgram(id_);
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  GLint is_linked = GL_FALSE;
  glGetProgramiv(id_, GL_LINK_STATUS, &is_linked);
  if (is_linked) return;

  std::string log(1024, '\0');
  glGetProgramInfoLog(id_, static_cast<GLsizei>(log.size()), nullptr, log.data());
  glDeleteProgram(id_);
  throw GraphicsError(fmt::format("shaders '{}' do not link: {}", name, first_line(log)));
}

GlProgram::~GlProgram() {
  glDeleteProgram(id_);
}

void GlProgram::use() const {
  glUseProgram(id_);
}

void GlProgram::set(const char* uniform, int value) const {
  glUniform1i(glGetUniformLocation(id_, uniform), value);
}
void GlProgram::set(const char* uniform, float value) const {
  glUniform1f(glGetUniformLocation(id_, uniform), value);
}
void GlProgram::set(const char* uniform, const Vec2f& value) const {
  glUniform2fv(glGetUniformLocation(id_, uniform), 1, glm::value_ptr(value));
}
void GlProgram::set(const char* uniform, const Vec3f& value) const {
  glUniform3fv(glGetUniformLocation(id_, uniform), 1, glm::value_ptr(value));
}
void GlProgram::set(const char* uniform, const glm::vec4& value) const {
  glUniform4fv(glGetUniformLocation(id_, uniform), 1, glm::value_ptr(value));
}
void GlProgram::set(const char* uniform, const glm::mat4& value) const {
  glUniformMatrix4fv(glGetUniformLocation(id_, uniform), 1, GL_FALSE, glm::value_ptr(value));
}

void upload_bytes(const GlBuffer& buffer, const void* data, std::size_t byte_count) {
  glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(byte_count), data, GL_STATIC_DRAW);
}

void require_complete_framebuffer() {
  if (glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw GraphicsError("this OpenGL driver cannot draw into half-float or depth textures");
  }
}

void require_no_gl_error(std::string_view doing) {
  const GLenum error = glGetError();
  if (error != GL_NO_ERROR) throw GraphicsError(fmt::format("OpenGL: {} while {}", error_name(error), doing));
}

}  // namespace ramify
