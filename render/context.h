#pragma once
/// Rendering contexts, one file per kind (context_<kind>.cpp). With the same version of Mesa all of them
/// produce bit-identical pictures.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace talus::render {

/// An OpenGL 3.3 core context, current on the thread that made it. A process uses only one kind of context.
class Context {
 public:
  using Function = void (*)();
  virtual ~Context() = default;
  /// Returns the OpenGL function of that name. A non-null pointer does not prove that the function exists;
  /// check the version.
  virtual Function function(const char* name) const = 0;
};

enum class ContextKind {
  osmesa,  ///< draws into memory, without display or driver
  egl,     ///< surfaceless: no display, Mesa's software driver; OSMesa ends with Mesa 25.0
};

/// Returns "osmesa" or "egl".
std::string_view context_name(ContextKind kind);
/// Returns the kind of that name, or nothing for "auto". Throws Error(usage) with the valid names.
std::optional<ContextKind> context_kind(std::string_view name);

/// Returns the names of the environment variables that configure drivers, such as "GALLIUM_DRIVER,
/// LIBGL_DEBUG".
std::string driver_variables();

/// Whether GL_RENDERER names one of Mesa's software renderers. A GPU rounds differently.
bool draws_in_software(std::string_view renderer);

/// Make a context with the drivers that the environment selects; prefer make_context. Throw
/// Error(unavailable) if the library is not installed or refuses.
std::unique_ptr<Context> make_osmesa_context();
std::unique_ptr<Context> make_egl_context();

/// Makes a context of that kind; without a kind, OSMesa, or EGL if OSMesa is unavailable. The first call
/// removes everything that configures drivers (GALLIUM_DRIVER, LIBGL_*, MESA_*, ...) from the environment, so
/// that pictures are bit-identical whatever it contains. Throws Error(unavailable) with the reason for each
/// kind that was tried.
std::unique_ptr<Context> make_context(std::optional<ContextKind> kind = {});

/// Returns the name of the kind that make_context without a kind makes on this system, or "none" and why.
std::string default_context();

using ContextMaker = std::function<std::unique_ptr<Context>()>;
/// Makes the first context, or the second if the first is unavailable, as make_context does without a kind.
std::unique_ptr<Context> first_context(const ContextMaker& first, const ContextMaker& second);

}  // namespace talus::render
