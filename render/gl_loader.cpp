#include "render/gl_loader.h"

#include <fmt/core.h>
#include <string>

#include "base/errors.h"

namespace talus::render {
namespace {

template <typename Pointer>
void load(const Context& context, const char* name, Pointer& pointer) {
  pointer = reinterpret_cast<Pointer>(context.function(name));
  if (!pointer) throw Error(ExitCode::unavailable, std::string("the rendering context lacks ") + name);
}

}  // namespace

Gl load_gl(const Context& context) {
  Gl gl;
#define TALUS_GL_LOAD(type, name) load(context, "gl" #name, gl.name);
  TALUS_GL_FUNCTIONS(TALUS_GL_LOAD)
#undef TALUS_GL_LOAD
  GLint major = 0, minor = 0;
  gl.GetIntegerv(GL_MAJOR_VERSION, &major);
  gl.GetIntegerv(GL_MINOR_VERSION, &minor);
  if (10 * major + minor < 33)
    throw Error(ExitCode::unavailable, "the rendering context offers OpenGL {}.{}; Talus needs 3.3", major,
                minor);
  return gl;
}

}  // namespace talus::render
