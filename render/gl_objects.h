#pragma once
/// The OpenGL objects that the renderer consists of.

#include <initializer_list>
#include <span>
#include <string>

#include "render/gl_loader.h"

namespace talus::render {

/// Compiles and links a program. Throws Error(unavailable) with the compiler's log.
GLuint make_program(const Gl& gl, const std::string& name, std::span<const unsigned char> vertex,
                    std::span<const unsigned char> fragment);

/// A program with one stream of vertices or, with divisor 1, of instances. The stream consists of floats.
struct Batch {
  GLuint program = 0;
  GLuint vertex_array = 0;
  GLuint buffer = 0;
};

/// An attribute of the stream: a number of floats, or a colour of four bytes that the shader reads as 0
/// ... 1.
enum class Attribute { floats1 = 1, floats2 = 2, floats3 = 3, floats4 = 4, colour };

/// Makes a batch; the attributes are numbered 0, 1, ... in the order of the stream.
Batch make_batch(const Gl& gl, GLuint program, std::initializer_list<Attribute> attributes, GLuint divisor);
void delete_batch(const Gl& gl, Batch& batch);

/// Selects the batch for drawing and uploads its stream.
template <typename Vertex>
void fill_batch(const Gl& gl, const Batch& batch, std::span<const Vertex> vertices) {
  gl.UseProgram(batch.program);
  gl.BindVertexArray(batch.vertex_array);
  gl.BindBuffer(GL_ARRAY_BUFFER, batch.buffer);
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size_bytes()), vertices.data(),
                GL_STREAM_DRAW);
}

/// Makes a texture with one or four channels of 8 bits, bound to GL_TEXTURE_2D; `pixels` may be null.
GLuint make_texture(const Gl& gl, int width, int height, int channels, const unsigned char* pixels,
                    GLint filter);

}  // namespace talus::render
