#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <array>
#include <fmt/core.h>
#include <string>

#include "base/errors.h"
#include "render/context.h"

namespace talus::render {
namespace {

constexpr const char* egl_library = "libEGL.so.1";
constexpr const char* packages = "apt-get install libegl1 libegl-mesa0 libgl1-mesa-dri";
constexpr unsigned renderer_name = 0x1F01;  // GL_RENDERER

/// The entry points of libEGL, opened at run time.
struct Egl {
  decltype(&eglGetPlatformDisplay) get_display = nullptr;
  decltype(&eglInitialize) initialize = nullptr;
  decltype(&eglBindAPI) bind_api = nullptr;
  decltype(&eglCreateContext) create = nullptr;
  decltype(&eglMakeCurrent) make_current = nullptr;
  decltype(&eglGetProcAddress) get_proc = nullptr;
  decltype(&eglDestroyContext) destroy = nullptr;
};

[[noreturn]] void refuse(const std::string& what) {
  throw Error(ExitCode::unavailable, "no EGL context: " + what);
}

template <typename Pointer>
void find_egl(void* library, const char* name, Pointer& pointer) {
  pointer = reinterpret_cast<Pointer>(dlsym(library, name));
  if (!pointer) refuse(fmt::format("{} lacks {}; reinstall libegl1", egl_library, name));
}

Egl open_egl() {
  void* library =
      dlopen(egl_library, RTLD_NOW | RTLD_LOCAL);  // never closed, because Mesa keeps thread-local state
  if (!library) refuse(fmt::format("cannot load {} ({}); {}", egl_library, dlerror(), packages));
  Egl egl;
  find_egl(library, "eglGetPlatformDisplay", egl.get_display);
  find_egl(library, "eglInitialize", egl.initialize);
  find_egl(library, "eglBindAPI", egl.bind_api);
  find_egl(library, "eglCreateContext", egl.create);
  find_egl(library, "eglMakeCurrent", egl.make_current);
  find_egl(library, "eglGetProcAddress", egl.get_proc);
  find_egl(library, "eglDestroyContext", egl.destroy);
  return egl;
}

/// An EGL context. Its display is shared by the process and not terminated, because other contexts may use
/// it.
class EglContextOwner final : public Context {
 public:
  EglContextOwner() : egl_(open_egl()) {
    display_ = egl_.get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display_ == EGL_NO_DISPLAY || !egl_.initialize(display_, nullptr, nullptr))
      refuse(std::string("EGL offers no surfaceless display; ") + packages);
    constexpr std::array<EGLint, 7> attributes = {EGL_CONTEXT_MAJOR_VERSION,
                                                  3,
                                                  EGL_CONTEXT_MINOR_VERSION,
                                                  3,
                                                  EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                  EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                  EGL_NONE};
    // Neither configuration nor surface is needed: the renderer draws into its own framebuffer.
    if (egl_.bind_api(EGL_OPENGL_API))
      context_ = egl_.create(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    if (context_ == EGL_NO_CONTEXT)
      refuse("EGL refuses OpenGL 3.3 core; Talus needs libgl1-mesa-dri from Mesa 20 or later");
    if (!egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
      egl_.destroy(display_, context_);
      refuse("EGL cannot make a context current without a surface; Talus needs Mesa 20 or later");
    }
    if (const std::string name = renderer(); !draws_in_software(name)) {
      release();
      refuse(fmt::format("EGL draws with {} instead of in software, which gives different pixels; {}", name,
                         packages));
    }
  }
  ~EglContextOwner() override { release(); }
  EglContextOwner(const EglContextOwner&) = delete;
  EglContextOwner& operator=(const EglContextOwner&) = delete;

  Function function(const char* name) const override { return egl_.get_proc(name); }

 private:
  std::string renderer() const {
    using GetString = const unsigned char* (*)(unsigned);
    const auto get_string = reinterpret_cast<GetString>(egl_.get_proc("glGetString"));
    const unsigned char* name = get_string ? get_string(renderer_name) : nullptr;
    return name ? reinterpret_cast<const char*>(name) : "an unknown driver";
  }
  void release() {
    egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    egl_.destroy(display_, context_);
  }

  Egl egl_;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<Context> make_egl_context() { return std::make_unique<EglContextOwner>(); }

}  // namespace talus::render
