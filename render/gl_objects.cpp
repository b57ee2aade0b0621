#include "render/gl_objects.h"

#include <cstdint>
#include <fmt/core.h>

#include "base/errors.h"

namespace talus::render {
namespace {

constexpr GLsizei log_size = 2048;

GLuint compile(const Gl& gl, const std::string& name, GLenum stage, std::span<const unsigned char> source) {
  const GLuint shader = gl.CreateShader(stage);
  const auto* text = reinterpret_cast<const GLchar*>(source.data());
  const auto length = static_cast<GLint>(source.size());
  gl.ShaderSource(shader, 1, &text, &length);
  gl.CompileShader(shader);
  GLint compiled = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled) return shader;
  std::string log(log_size, '\0');
  gl.GetShaderInfoLog(shader, log_size, nullptr, log.data());
  gl.DeleteShader(shader);
  throw Error(ExitCode::unavailable, "shader {} does not compile: {}", name, log.c_str());
}

}  // namespace

GLuint make_program(const Gl& gl, const std::string& name, std::span<const unsigned char> vertex,
                    std::span<const unsigned char> fragment) {
  const GLuint program = gl.CreateProgram();
  for (GLuint shader : {compile(gl, name + ".vert", GL_VERTEX_SHADER, vertex),
                        compile(gl, name + ".frag", GL_FRAGMENT_SHADER, fragment)}) {
    gl.AttachShader(program, shader);
    gl.DeleteShader(shader);  // deleted with the program
  }
  gl.LinkProgram(program);
  GLint linked = 0;
  gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked) return program;
  std::string log(log_size, '\0');
  gl.GetProgramInfoLog(program, log_size, nullptr, log.data());
  gl.DeleteProgram(program);
  throw Error(ExitCode::unavailable, "shader program {} does not link: {}", name, log.c_str());
}

Batch make_batch(const Gl& gl, GLuint program, std::initializer_list<Attribute> attributes, GLuint divisor) {
  Batch batch;
  batch.program = program;
  gl.GenVertexArrays(1, &batch.vertex_array);
  gl.GenBuffers(1, &batch.buffer);
  gl.BindVertexArray(batch.vertex_array);
  gl.BindBuffer(GL_ARRAY_BUFFER, batch.buffer);
  const auto words = [](Attribute attribute) {  // number of four-byte words
    return attribute == Attribute::colour ? 1 : static_cast<int>(attribute);
  };
  int stride = 0;
  for (Attribute attribute : attributes) stride += 4 * words(attribute);
  GLuint index = 0;
  std::uintptr_t offset = 0;
  for (Attribute attribute : attributes) {
    gl.EnableVertexAttribArray(index);
    const auto* place = reinterpret_cast<const void*>(offset);
    if (attribute == Attribute::colour)
      gl.VertexAttribPointer(index, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, place);
    else
      gl.VertexAttribPointer(index, words(attribute), GL_FLOAT, GL_FALSE, stride, place);
    gl.VertexAttribDivisor(index, divisor);
    ++index;
    offset += static_cast<std::uintptr_t>(4 * words(attribute));
  }
  return batch;
}

void delete_batch(const Gl& gl, Batch& batch) {
  gl.DeleteProgram(batch.program);
  gl.DeleteVertexArrays(1, &batch.vertex_array);
  gl.DeleteBuffers(1, &batch.buffer);
  batch = {};
}

GLuint make_texture(const Gl& gl, int width, int height, int channels, const unsigned char* pixels,
                    GLint filter) {
  GLuint texture = 0;
  gl.GenTextures(1, &texture);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.TexImage2D(GL_TEXTURE_2D, 0, channels == 1 ? GL_R8 : GL_RGBA8, width, height, 0,
                channels == 1 ? GL_RED : GL_RGBA, GL_UNSIGNED_BYTE, pixels);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

}  // namespace talus::render
