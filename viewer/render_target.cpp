#include "viewer/render_target.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "viewer/shaders.h"

namespace ramify {
namespace {

/// Makes `texture` the only attachment of `framebuffer`.
void attach(const GlFramebuffer& framebuffer, const GlTexture& texture, GLint format, int width, int height) {
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glTexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.id(), 0);
  require_complete_framebuffer();
}

}  // namespace

RenderTarget::RenderTarget(int width, int height, Sampling sampling)
    : sampling_(sampling), finish_("finish", shaders::screen_vertex(), shaders::finish_fragment()) {
  const int fine_width = width * sampling.fineness;
  const int fine_height = height * sampling.fineness;
  GLint most_samples = 0;
  glGetIntegerv(GL_MAX_SAMPLES, &most_samples);
  const GLsizei samples = sampling.samples > 1 ? std::min(sampling.samples, most_samples) : 0;

  glBindRenderbuffer(GL_RENDERBUFFER, samples_.id());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_RGBA16F, fine_width, fine_height);
  glBindRenderbuffer(GL_RENDERBUFFER, depth_.id());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT32F, fine_width, fine_height);
  glBindFramebuffer(GL_FRAMEBUFFER, sampled_.id());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, samples_.id());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
  require_complete_framebuffer();

  attach(resolving_, resolved_, GL_RGBA16F, fine_width, fine_height);
  attach(finishing_, finished_, GL_RGBA8, width, height);
}

void RenderTarget::begin() {
  glBindFramebuffer(GL_FRAMEBUFFER, sampled_.id());
}

void RenderTarget::finish(int width, int height) {
  const int fine_width = width * sampling_.fineness;
  const int fine_height = height * sampling_.fineness;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, sampled_.id());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolving_.id());
  glBlitFramebuffer(0, 0, fine_width, fine_height, 0, 0, fine_width, fine_height, GL_COLOR_BUFFER_BIT,
                    GL_NEAREST);

  glBindFramebuffer(GL_FRAMEBUFFER, finishing_.id());
  glViewport(0, 0, width, height);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  finish_.use();
  finish_.set("picture", 0);
  finish_.set("fineness", sampling_.fineness);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, resolved_.id());
  glBindVertexArray(no_vertices_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void RenderTarget::read_finished(int width, int height, unsigned char* rgba) const {
  glBindFramebuffer(GL_FRAMEBUFFER, finishing_.id());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
}

}  // namespace ramify
