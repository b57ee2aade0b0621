#pragma once
/// Rendering contexts, one file per kind (context_<kind>.cpp). The renderer draws the same bits in all of
/// them.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace talus::render {

/// An OpenGL 3.3 core context, current on the thread that made it. A process uses one kind of context only.
class Context {
 public:
  using Function = void (*)();
  virtual ~Context() = default;
  /// The OpenGL function of that name. A pointer does not prove that the function exists: check versions.
  virtual Function function(const char* name) const = 0;
};

enum class ContextKind {
  osmesa,  ///< in memory: neither display nor driver
  egl,     ///< without a surface: no display, Mesa's driver in software; OSMesa ends with Mesa 25.0
};

/// "osmesa", "egl".
std::string_view context_name(ContextKind kind);
/// The kind of that name; none for "auto". Throws Error(usage) with the names that exist.
std::optional<ContextKind> context_kind(std::string_view name);

/// The names of the variables of the environment that configure drivers, "GALLIUM_DRIVER, LIBGL_DEBUG".
std::string driver_variables();

/// Whether that is the name of a renderer of Mesa in software (GL_RENDERER). A GPU rounds in other ways.
bool draws_in_software(std::string_view renderer);

/// Each throws Error(unavailable) if its library is not installed, or refuses. They draw as the environment
/// says: call make_context.
std::unique_ptr<Context> make_osmesa_context();
std::unique_ptr<Context> make_egl_context();

/// A context of that kind; without a kind OSMesa, or EGL if OSMesa is unavailable. The first call removes
/// from the environment all that configures drivers (GALLIUM_DRIVER, LIBGL_*, MESA_*, ...), so that pictures
/// have the same bits whatever it says. Throws Error(unavailable) with what is missing for each kind that was
/// tried.
std::unique_ptr<Context> make_context(std::optional<ContextKind> kind);

using ContextMaker = std::function<std::unique_ptr<Context>()>;
/// What make_context does when no kind is given.
std::unique_ptr<Context> first_context(const ContextMaker& first, const ContextMaker& second);

}  // namespace talus::render
