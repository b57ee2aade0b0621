#include <dlfcn.h>

#include <array>
#include <cerrno>
#include <fmt/core.h>
#include <new>
#include <string>

#include "base/errors.h"
#include "render/context.h"

namespace talus::render {
namespace {

constexpr const char* osmesa_library = "libOSMesa.so.8";

// GL/osmesa.h has left Mesa with version 25.1, so the names that are used here are declared here.
constexpr int colour_format = 0x22, rgba_format = 0x1908, depth_bits = 0x30, stencil_bits = 0x31,
              accum_bits = 0x32;
constexpr int profile = 0x33, core_profile = 0x34, major_version = 0x36, minor_version = 0x37;
constexpr unsigned unsigned_byte = 0x1401;
using OSMesaContext = struct OSMesaContextRecord*;

/// The entry points of libOSMesa, opened at run time.
struct OSMesa {
  OSMesaContext (*create)(const int* attributes, OSMesaContext shared) = nullptr;
  unsigned char (*make_current)(OSMesaContext context, void* buffer, unsigned type, int width,
                                int height) = nullptr;
  Context::Function (*get_proc)(const char* name) = nullptr;
  void (*destroy)(OSMesaContext context) = nullptr;
};

template <typename Pointer>
void find_osmesa(void* library, const char* name, Pointer& pointer) {
  pointer = reinterpret_cast<Pointer>(dlsym(library, name));
  if (!pointer) throw Error(ExitCode::unavailable, "{} lacks {}; reinstall libosmesa6", osmesa_library, name);
}

OSMesa entry_points(void* library) {
  OSMesa mesa;
  find_osmesa(library, "OSMesaCreateContextAttribs", mesa.create);
  find_osmesa(library, "OSMesaMakeCurrent", mesa.make_current);
  find_osmesa(library, "OSMesaGetProcAddress", mesa.get_proc);
  find_osmesa(library, "OSMesaDestroyContext", mesa.destroy);
  return mesa;
}

OSMesa open_osmesa() {
  errno = 0;
  void* library =
      dlopen(osmesa_library, RTLD_NOW | RTLD_LOCAL);  // never closed, because Mesa keeps thread-local state
  if (library) return entry_points(library);
  const std::string reason = dlerror();
  const auto says = [&reason](const char* words) { return reason.find(words) != std::string::npos; };
  if (errno == ENOMEM || says("annot allocate") || says("failed to map")) throw std::bad_alloc();
  throw Error(ExitCode::unavailable,
              "no OSMesa context: cannot load {} ({}); apt-get install libosmesa6, which systems with Mesa "
              "25.1 or later do not have: there EGL draws",
              osmesa_library, reason);
}

class OSMesaContextOwner final : public Context {
 public:
  OSMesaContextOwner() : mesa_(open_osmesa()) {
    // Maps are flat and need no depth, stencil or accumulation buffer.
    constexpr std::array<int, 15> attributes = {
        colour_format, rgba_format,  depth_bits,    0, stencil_bits,  0, accum_bits, 0,
        profile,       core_profile, major_version, 3, minor_version, 3, 0};
    context_ = mesa_.create(attributes.data(), nullptr);
    // The renderer draws into its own framebuffer, but a context becomes current only with a buffer.
    if (!context_ || !mesa_.make_current(context_, dummy_.data(), unsigned_byte, 1, 1)) {
      if (context_) mesa_.destroy(context_);
      throw Error(
          ExitCode::unavailable,
          "no OSMesa context: OSMesa refuses OpenGL 3.3 core; Talus needs libosmesa6 from Mesa 20 to 25.0");
    }
  }
  ~OSMesaContextOwner() override { mesa_.destroy(context_); }
  OSMesaContextOwner(const OSMesaContextOwner&) = delete;
  OSMesaContextOwner& operator=(const OSMesaContextOwner&) = delete;

  Function function(const char* name) const override { return mesa_.get_proc(name); }

 private:
  OSMesa mesa_;
  OSMesaContext context_ = nullptr;
  std::array<unsigned char, 4> dummy_{};
};

}  // namespace

std::unique_ptr<Context> make_osmesa_context() { return std::make_unique<OSMesaContextOwner>(); }

}  // namespace talus::render
