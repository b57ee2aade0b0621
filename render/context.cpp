#include "render/context.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <fmt/core.h>
#include <string>
#include <vector>

#include "base/errors.h"
#include "base/text.h"

namespace talus::render {
namespace {

/// The file that makes libEGL use Mesa's driver; without it, libEGL prefers the driver of a GPU.
constexpr const char* mesa_of_egl = "/usr/share/glvnd/egl_vendor.d/50_mesa.json";

/// Prefixes of the environment variables that configure Mesa, its drivers and libEGL.
constexpr std::array<std::string_view, 20> driver_families = {
    "D3D12_", "DRAW_", "DRI_", "DRIRC_", "EGL_",      "GALLIUM_", "GALLIVM_", "GBM_",  "GLSL_",  "LIBGL_",
    "LP_",    "MESA_", "NIR_", "PP_",    "SOFTPIPE_", "ST_",      "TGSI_",    "ZINK_", "__EGL_", "__GL"};

/// Whether a variable is an option of Mesa's driver configuration. Mesa also reads each option, such as
/// force_glsl_version, from a variable in lower case.
bool names_driver_option(std::string_view name) {
  const auto may_be_in_one = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  // The shell sets "_" itself for every command.
  return name.find('_', 1) != std::string_view::npos && name.front() != '_' && !name.ends_with("_proxy") &&
         std::all_of(name.begin(), name.end(), may_be_in_one);
}

/// Whether a variable can change a picture, or prevent drawing. The number of threads cannot.
bool configures_driver(std::string_view name) {
  if (name == "LP_NUM_THREADS") return false;
  const auto begins_name = [name](std::string_view family) { return name.starts_with(family); };
  return std::any_of(driver_families.begin(), driver_families.end(), begins_name) ||
         names_driver_option(name);
}

}  // namespace

std::string driver_variables() {
  std::string found;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text = *variable, name = text.substr(0, text.find('='));
    if (configures_driver(name)) found.append(found.empty() ? "" : ", ").append(name);
  }
  return found;
}

namespace {

/// Replaces the environment by one that makes Mesa draw in software, and returns the names of the variables
/// that were removed. Drivers crash on values that they do not know, and other values change the pictures.
/// The former environment is left intact because another thread may be reading it. The new one is never
/// freed.
std::string configure_drivers() {
  // The few small shaders compile quickly; a cache would only leave files in the user's home.
  static auto* const settings =
      new std::vector<std::string>{"MESA_SHADER_CACHE_DISABLE=true", "LIBGL_ALWAYS_SOFTWARE=true"};
  const bool finds_mesa = access(mesa_of_egl, R_OK) == 0;
  if (finds_mesa) settings->push_back(fmt::format("__EGL_VENDOR_LIBRARY_FILENAMES={}", mesa_of_egl));
  static auto* const variables = new std::vector<char*>();
  std::string removed;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text = *variable, name = text.substr(0, text.find('='));
    // If Mesa is not in its usual place, these variables may give its location.
    const bool says_where = name.starts_with("__EGL_") && !finds_mesa;
    if (configures_driver(name) && !says_where)
      removed.append(removed.empty() ? "" : ", ").append(name);
    else
      variables->push_back(*variable);
  }
  for (std::string& setting : *settings) variables->push_back(setting.data());
  variables->push_back(nullptr);
  environ = variables->data();
  return removed;
}

}  // namespace

std::string_view context_name(ContextKind kind) { return kind == ContextKind::osmesa ? "osmesa" : "egl"; }

std::optional<ContextKind> context_kind(std::string_view name) {
  if (name == "auto") return std::nullopt;
  for (const ContextKind kind : {ContextKind::osmesa, ContextKind::egl})
    if (name == context_name(kind)) return kind;
  throw Error(ExitCode::usage, "--context {}: expected auto, osmesa or egl{}", visible_word(name),
              did_you_mean(name, {"auto", "osmesa", "egl"}));
}

bool draws_in_software(std::string_view renderer) {
  return renderer.starts_with("llvmpipe") || renderer.starts_with("softpipe");
}

std::unique_ptr<Context> make_context(std::optional<ContextKind> kind) {
  static const std::string removed = configure_drivers();
  try {
    if (!kind) return first_context(make_osmesa_context, make_egl_context);
    return *kind == ContextKind::osmesa ? make_osmesa_context() : make_egl_context();
  } catch (const Error& error) {
    if (error.code() != ExitCode::unavailable || removed.empty()) throw;
    throw Error(error.code(), "{} (Talus draws in software and ignores {} in the environment)", error.what(),
                removed);
  }
}

std::string default_context() {
  std::string reasons;
  for (const ContextKind kind : {ContextKind::osmesa, ContextKind::egl}) try {
      make_context(kind);
      return std::string(context_name(kind));
    } catch (const Error& error) {
      if (error.code() != ExitCode::unavailable) throw;
      reasons.append(reasons.empty() ? "none: " : "; ").append(error.what());
    }
  return reasons;
}

std::unique_ptr<Context> first_context(const ContextMaker& first, const ContextMaker& second) {
  std::string missing;
  for (const ContextMaker* make : {&first, &second}) try {
      return (*make)();
    } catch (const Error& error) {
      if (error.code() != ExitCode::unavailable) throw;
      missing.append(missing.empty() ? "" : "; ").append(error.what());
    }
  throw Error(ExitCode::unavailable, missing);
}

}  // namespace talus::render
