#include "render/context.h"

#include <fmt/core.h>
#include <string>

#include "core/errors.h"
#include "core/nearest_word.h"
#include "core/visible_text.h"

namespace talus {

std::string_view context_name(ContextKind kind) { return kind == ContextKind::osmesa ? "osmesa" : "egl"; }

std::optional<ContextKind> context_kind(std::string_view name) {
  if (name == "auto") return std::nullopt;
  for (const ContextKind kind : {ContextKind::osmesa, ContextKind::egl})
    if (name == context_name(kind)) return kind;
  throw Error(ExitCode::usage, fmt::format("--context {}: expected auto, osmesa or egl{}", visible_word(name),
                                           did_you_mean(name, {"auto", "osmesa", "egl"})));
}

bool draws_in_software(std::string_view renderer) {
  return renderer.starts_with("llvmpipe") || renderer.starts_with("softpipe");
}

std::unique_ptr<Context> make_context(std::optional<ContextKind> kind) {
  if (!kind) return first_context(make_osmesa_context, make_egl_context);
  return *kind == ContextKind::osmesa ? make_osmesa_context() : make_egl_context();
}

std::unique_ptr<Context> first_context(const ContextMaker& first, const ContextMaker& second) {
  std::string missing;
  try {
    return first();
  } catch (const Error& error) {
    if (error.code() != ExitCode::unavailable) throw;
    missing = error.what();
  }
  try {
    return second();
  } catch (const Error& error) {
    if (error.code() != ExitCode::unavailable) throw;
    throw Error(ExitCode::unavailable, missing.append("; ").append(error.what()));
  }
}

}  // namespace talus
