/// The unmodified ./bootstrap demo, with this build of the program and a bed that fails within a second.

#include <gtest/gtest.h>

#include <cstdlib>

#include "pictures.h"
#include "support/commands.h"
#include "support/places.h"

namespace talus::test {
namespace {

namespace fs = std::filesystem;

/// Few frames, because the demo draws all of them.
const char* const failing_bed =
    "[bed]\nlength = 20\ndepth = 6\n[deposition]\nrest_velocity = 0.05\n[tilt]\nrate = 20\nstep = 0.02\n"
    "[output]\nframe_every = 5\nobservable_every = 0.2\n";

/// Checkout that contains only what the demo needs. Fake commands, ahead of the system's, report that
/// everything is installed; they neither install nor build anything.
class BootstrapDemo : public CommandTest {
 protected:
  void SetUp() override {
    fs::copy_file(source_folder() + "/bootstrap", folder_.path() / "bootstrap");
    fs::create_directories(folder_.path() / "build/release");
    fs::create_symlink(talus_program(), folder_.path() / "build/release/talus");
    fs::create_directories(folder_.path() / "assets/scenarios");
    fs::create_directory(folder_.path() / "bin");
    make_command("dpkg-query", "shift 3\nprintf '%s installed\\n' \"$@\"");
    make_command("cmake", "exit 0");
    make_command("apt-get", "exit 1");
    make_command("sudo", "exit 1");
  }

  void make_command(const std::string& name, const std::string& text) {
    const fs::path path = folder_.path() / write_file(folder_, "bin/" + name, "#!/bin/bash\n" + text + "\n");
    fs::permissions(path, fs::perms::owner_all);
  }

  int demo(int seed) {
    write_file(folder_, "assets/scenarios/demo.toml", "seed = " + std::to_string(seed) + "\n" + failing_bed);
    const std::string command =
        "cd '" + folder_.path().string() + "' && PATH=\"$PWD/bin:$PATH\" bash ./bootstrap demo > said 2>&1";
    return std::system(command.c_str());
  }

  std::string said() const { return folder_.text("said"); }
};

TEST_F(BootstrapDemo, works_as_often_as_it_is_typed) {
  ASSERT_EQ(demo(1), 0) << said();
  const fs::path maps = folder_.path() / "runs/demo-maps";
  const std::set<std::string> names = names_in(maps);
  ASSERT_GT(names.size(), 10u);
  const fs::path first = maps / *names.begin();
  const std::string pixels = pixels_of(first);
  ASSERT_EQ(demo(2), 0) << said();
  EXPECT_FALSE(pixels_of(first) == pixels) << *names.begin() << " is left over from the first run";
  EXPECT_TRUE(has(said(), "From deposition to avalanche"));
}

}  // namespace
}  // namespace talus::test
