#pragma once
/// Rendering contexts: one file per kind (context_<kind>.cpp), and the renderer draws alike in all of them.

#include <memory>

namespace talus {

/// An OpenGL 3.3 core context, current on the thread that made it. A process uses one kind of context only.
class Context {
 public:
  using Function = void (*)();
  virtual ~Context() = default;
  /// The OpenGL function of that name. A pointer is no proof that the function exists: test versions.
  virtual Function function(const char* name) const = 0;
};

/// A context in memory that needs neither display nor driver. Throws Error(unavailable) where libOSMesa is
/// not installed or refuses.
std::unique_ptr<Context> make_osmesa_context();

}  // namespace talus
