#include <dlfcn.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "base/errors.h"
#include "render/context.h"
#include "support/exit_code.h"
#include "support/has.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace talus::render {
namespace {

struct Outcome {
  int exit_code = -1;
  std::string text;
};

/// Runs picture_hash in a separate process, because a process uses one kind of context.
Outcome picture_hash(const std::string& environment, const std::string& kind) {
  const std::string command = environment + " '" + test::build_folder() + "/picture_hash' " + kind;
  std::FILE* pipe = popen(command.c_str(), "r");
  Outcome outcome;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) outcome.text.push_back(static_cast<char>(c));
  const int status = pclose(pipe);
  if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
  return outcome;
}

/// Folder of libraries that cannot be loaded, searched before the system's.
class BrokenLibraries {
 public:
  explicit BrokenLibraries(const std::vector<std::string>& names) {
    for (const std::string& name : names)
      std::ofstream(folder_.path(name)) << "no library, but longer than a header " << std::string(100, '.');
  }
  std::string environment() const { return "LD_LIBRARY_PATH='" + folder_.path("") + "'"; }

 private:
  test::TemporaryFolder folder_;
};

/// Whether the system has OSMesa; Mesa 25.1 and later have not.
bool has_osmesa() {
  void* const library = dlopen("libOSMesa.so.8", RTLD_LAZY);
  if (library) dlclose(library);
  return library != nullptr;
}

/// The kinds that the system has.
std::vector<std::string> kinds() {
  return has_osmesa() ? std::vector<std::string>{"osmesa", "egl"} : std::vector<std::string>{"egl"};
}

TEST(Context, WithoutOSMesaTheSystemIsSaidToHaveNone) {
  if (has_osmesa()) GTEST_SKIP() << "this system has OSMesa";
  const Outcome osmesa = picture_hash("", "osmesa");
  EXPECT_EQ(osmesa.exit_code, static_cast<int>(ExitCode::unavailable));
  EXPECT_TRUE(test::has(osmesa.text, "Mesa 25.1 or later"));
}

TEST(Context, TheDefaultIsNamed) { EXPECT_EQ(default_context(), kinds()[0]); }

TEST(Context, DrawsTheSameBitsInEveryKind) {
  if (!has_osmesa()) GTEST_SKIP() << "this system has no OSMesa";
  const Outcome osmesa = picture_hash("", "osmesa"), egl = picture_hash("", "egl");
  ASSERT_EQ(osmesa.exit_code, 0) << osmesa.text;
  ASSERT_EQ(egl.exit_code, 0) << egl.text;
  EXPECT_EQ(osmesa.text, egl.text);
  EXPECT_EQ(osmesa.text.size(), 17u) << osmesa.text;
}

TEST(Context, DrawsTheSameBitsWithAnyNumberOfThreads) {
  const Outcome first = picture_hash("LP_NUM_THREADS=0", "auto");
  ASSERT_EQ(first.exit_code, 0) << first.text;
  for (const char* threads : {"LP_NUM_THREADS=1", "LP_NUM_THREADS=2", "LP_NUM_THREADS=4"})
    EXPECT_EQ(picture_hash(threads, "auto").text, first.text) << threads;
}

TEST(Context, WithoutOSMesaEglDraws) {
  const BrokenLibraries broken({"libOSMesa.so.8"});
  const Outcome whole = picture_hash("", "auto"), by_egl = picture_hash(broken.environment(), "auto");
  EXPECT_EQ(by_egl.exit_code, 0) << by_egl.text;
  EXPECT_EQ(by_egl.text, whole.text);
}

/// Expects no picture where these libraries are broken, and returns what is said.
std::string refusal_without(const std::vector<std::string>& libraries, const std::string& kind,
                            const std::string& environment = "") {
  const BrokenLibraries broken(libraries);
  const Outcome outcome = picture_hash(broken.environment() + environment, kind);
  EXPECT_EQ(outcome.exit_code, static_cast<int>(ExitCode::unavailable));
  return outcome.text;
}

TEST(Context, WhatIsMissingIsNamed) {
  EXPECT_TRUE(test::has(refusal_without({"libOSMesa.so.8"}, "osmesa"), "apt-get install libosmesa6"));
  EXPECT_TRUE(test::has_all(
      refusal_without({"libOSMesa.so.8", "libEGL.so.1"}, "auto"),
      {"libOSMesa.so.8", "apt-get install libosmesa6", "libEGL.so.1", "apt-get install libegl1"}));
  EXPECT_FALSE(test::has(refusal_without({"libOSMesa.so.8", "libEGL.so.1"}, "egl"), "OSMesa"));
  EXPECT_TRUE(test::has(refusal_without({"libEGL_mesa.so.0"}, "egl"), "libegl-mesa0"));
  EXPECT_TRUE(test::has_all(
      refusal_without({"libOSMesa.so.8"}, "osmesa", " GALLIUM_DRIVER=swr LIBGL_DRIVERS_PATH=/nowhere"),
      {"GALLIUM_DRIVER", "LIBGL_DRIVERS_PATH"}))
      << "variables that are not used";
}

/// Variables read by Mesa, its drivers and libEGL, with values that make a driver crash, draw nothing or
/// something else, or write to the terminal. If a variable has several values, each is tried.
const std::vector<std::vector<std::string>> driver_settings = {
    {"GALLIUM_DRIVER=swr", "GALLIUM_DRIVER=softpipe", "GALLIUM_DRIVER=d3d12", "GALLIUM_DRIVER=zink"},
    {"LIBGL_ALWAYS_SOFTWARE=0", "LIBGL_ALWAYS_SOFTWARE=no"},
    {"LIBGL_DRIVERS_PATH=/nowhere"},
    {"LIBGL_DEBUG=verbose"},
    {"MESA_LOADER_DRIVER_OVERRIDE=zink", "MESA_LOADER_DRIVER_OVERRIDE=iris"},
    {"MESA_GL_VERSION_OVERRIDE=3.0", "MESA_GL_VERSION_OVERRIDE=2.1"},
    {"MESA_GLSL_VERSION_OVERRIDE=110"},
    {"MESA_EXTENSION_OVERRIDE=-GL_ARB_framebuffer_object"},
    {"MESA_GLSL=dump", "MESA_GLSL=errors,useprog"},
    {"MESA_LOG_FILE=/nowhere/log"},
    {"__EGL_VENDOR_LIBRARY_FILENAMES=/nowhere", "__EGL_VENDOR_LIBRARY_FILENAMES=/etc/passwd"},
    {"__EGL_VENDOR_LIBRARY_DIRS=/nowhere"},
    {"__GLX_VENDOR_LIBRARY_NAME=nvidia"},
    {"EGL_PLATFORM=wayland", "EGL_PLATFORM=x11", "EGL_PLATFORM=drm"},
    {"EGL_LOG_LEVEL=debug"},
    {"DISPLAY=:99", "DISPLAY=nowhere:0"},
    {"WAYLAND_DISPLAY=wayland-99"},
    {"LP_NUM_THREADS=-1", "LP_NUM_THREADS=999999999999", "LP_NUM_THREADS=many"},
    {"LP_NATIVE_VECTOR_WIDTH=64", "LP_NATIVE_VECTOR_WIDTH=1", "LP_NATIVE_VECTOR_WIDTH=512"},
    {"LP_NO_RAST=1"},
    {"LP_PERF=no_tex", "LP_PERF=no_blend"},
    {"DRAW_USE_LLVM=0"},
    {"GALLIUM_NOSSE=1"},
    {"GALLIUM_OVERRIDE_CPU_CAPS=sse2", "GALLIUM_OVERRIDE_CPU_CAPS=nosse"},
    {"GALLIUM_NOOP=1"},
    {"GALLIUM_DDEBUG=always"},
    {"GALLIUM_TRACE=/dev/null"},
    {"GALLIUM_DUMP_CPU=1"},
    {"ST_DEBUG=wf", "ST_DEBUG=tgsi"},
    {"TGSI_PRINT_SANITY=1"},
    {"DRI_PRIME=1"},
    {"vblank_mode=0"},
    {"pp_celshade=1"},
    {"force_glsl_version=110"},
};

TEST(Context, NoVariableChangesWhatIsDrawn) {
  for (const std::string& name : kinds()) {
    const std::string kind = name + " 2>&1";
    const Outcome plain = picture_hash("", kind);
    ASSERT_EQ(plain.exit_code, 0) << plain.text;
    const auto is_as_plain = [&](const std::string& environment) {
      const Outcome outcome = picture_hash(environment, kind);
      return outcome.exit_code == 0 && outcome.text == plain.text;
    };
    for (std::size_t value = 0; value < 4; ++value) {
      std::string environment;  // all variables at once; one by one only to find the cause of a failure
      for (const auto& settings : driver_settings) environment += settings[value % settings.size()] + " ";
      if (is_as_plain(environment)) continue;
      ADD_FAILURE() << kind << ": the picture differs with " << environment;
      for (const auto& settings : driver_settings)
        if (const std::string& one = settings[value % settings.size()]; !is_as_plain("timeout 20 env " + one))
          ADD_FAILURE() << kind << ": the picture differs with " << one;
    }
  }
}

TEST(Context, OtherErrorsAreNotHidden) {
  const auto fails = [] {
    throw Error(ExitCode::internal, "defect");
    return std::unique_ptr<Context>();
  };
  int seconds = 0;
  const auto second = [&] {
    ++seconds;
    return std::unique_ptr<Context>();
  };
  EXPECT_TRUE(test::refuses([&] { first_context(fails, second); }, ExitCode::internal));
  EXPECT_EQ(seconds, 0);
}

TEST(Context, OfAGpuIsNoneThatDrawsInSoftware) {
  for (const char* name : {"llvmpipe (LLVM 15.0.6, 256 bits)", "softpipe"})
    EXPECT_TRUE(draws_in_software(name)) << name;
  for (const char* name :
       {"NVIDIA H200/PCIe/SSE2", "Mesa Intel(R) UHD Graphics 630 (CFL GT2)", "virgl (llvmpipe)", ""})
    EXPECT_FALSE(draws_in_software(name)) << name;
}

TEST(Context, KindsHaveNames) {
  EXPECT_EQ(context_kind("auto"), std::nullopt);
  for (const ContextKind kind : {ContextKind::osmesa, ContextKind::egl})
    EXPECT_EQ(context_kind(context_name(kind)), kind);
  for (const char* name : {"", "glx", "EGL"})
    EXPECT_TRUE(
        test::refuses([&] { context_kind(name); }, ExitCode::usage, {"expected auto, osmesa or egl"}));
}

}  // namespace
}  // namespace talus::render
