#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "core/errors.h"
#include "render/context.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace talus {
namespace {

struct Outcome {
  int exit_code = -1;
  std::string text;
};

/// What picture_hash says in a process of its own: a process uses one kind of context.
Outcome picture_hash(const std::string& environment, const std::string& kind) {
  const std::string command = environment + " '" + test::build_folder() + "/picture_hash' " + kind;
  std::FILE* pipe = popen(command.c_str(), "r");
  Outcome outcome;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) outcome.text.push_back(static_cast<char>(c));
  const int status = pclose(pipe);
  if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
  return outcome;
}

/// A folder of libraries that cannot be loaded, searched before the system's.
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

TEST(Context, DrawsTheSameBitsInEveryKind) {
  const Outcome osmesa = picture_hash("", "osmesa"), egl = picture_hash("", "egl");
  ASSERT_EQ(osmesa.exit_code, 0) << osmesa.text;
  ASSERT_EQ(egl.exit_code, 0) << egl.text;
  EXPECT_EQ(osmesa.text, egl.text);
  EXPECT_EQ(osmesa.text.size(), 17u) << osmesa.text;
}

TEST(Context, DrawsTheSameBitsWithAnyNumberOfThreads) {
  const Outcome first = picture_hash("LP_NUM_THREADS=0", "osmesa");
  ASSERT_EQ(first.exit_code, 0) << first.text;
  for (const char* threads : {"LP_NUM_THREADS=1", "LP_NUM_THREADS=2", "LP_NUM_THREADS=4"})
    EXPECT_EQ(picture_hash(threads, "osmesa").text, first.text) << threads;
}

TEST(Context, WithoutOSMesaEglDraws) {
  const BrokenLibraries broken({"libOSMesa.so.8"});
  const Outcome whole = picture_hash("", "auto"), by_egl = picture_hash(broken.environment(), "auto");
  EXPECT_EQ(by_egl.exit_code, 0) << by_egl.text;
  EXPECT_EQ(by_egl.text, whole.text);
  const Outcome osmesa = picture_hash(broken.environment(), "osmesa");
  EXPECT_EQ(osmesa.exit_code, static_cast<int>(ExitCode::unavailable)) << "it was asked for by name";
  EXPECT_NE(osmesa.text.find("apt-get install libosmesa6"), std::string::npos) << osmesa.text;
}

TEST(Context, WithNeitherBothAreNamed) {
  const BrokenLibraries broken({"libOSMesa.so.8", "libEGL.so.1"});
  const Outcome outcome = picture_hash(broken.environment(), "auto");
  EXPECT_EQ(outcome.exit_code, static_cast<int>(ExitCode::unavailable));
  for (const char* word :
       {"libOSMesa.so.8", "apt-get install libosmesa6", "libEGL.so.1", "apt-get install libegl1"})
    EXPECT_NE(outcome.text.find(word), std::string::npos) << outcome.text;
  const Outcome egl = picture_hash(broken.environment(), "egl");
  EXPECT_EQ(egl.exit_code, static_cast<int>(ExitCode::unavailable));
  EXPECT_EQ(egl.text.find("OSMesa"), std::string::npos) << egl.text;
}

TEST(Context, WithoutADriverEglSaysWhatToInstall) {
  // As on a machine with libegl1 alone: it finds no vendor's implementation.
  const Outcome outcome = picture_hash("__EGL_VENDOR_LIBRARY_DIRS=/nowhere", "egl");
  EXPECT_EQ(outcome.exit_code, static_cast<int>(ExitCode::unavailable));
  EXPECT_NE(outcome.text.find("libegl-mesa0"), std::string::npos) << outcome.text;
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
  try {
    first_context(fails, second);
    ADD_FAILURE() << "hidden";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::internal);
  }
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
  for (const char* name : {"", "glx", "EGL"}) try {
      context_kind(name);
      ADD_FAILURE() << name << " accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      EXPECT_NE(std::string(error.what()).find("expected auto, osmesa or egl"), std::string::npos)
          << error.what();
    }
}

}  // namespace
}  // namespace talus
