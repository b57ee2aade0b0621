#pragma once
/// Commands in a folder of their own.

#include "support/has.h"
#include "support/process.h"

namespace talus::test {

/// Returns whether a command ends with this exit code and says all of these parts: in its results if it
/// succeeds, else in its messages.
inline testing::AssertionResult ends(const Outcome& outcome, int code, const Words& parts = {}) {
  if (outcome.exit_code != code)
    return testing::AssertionFailure() << "exit code " << outcome.exit_code << ", expected " << code << ":\n"
                                       << outcome.out << outcome.err;
  return has_all(code == 0 ? outcome.out : outcome.err, parts);
}

/// Bed of 32 grains that is deposited and tilted in a fraction of a second: 4 frames, and no failure.
inline const char* const stable_bed =
    "[bed]\nlength = 10\ndepth = 4\n[tilt]\nend_angle = 1.5\n[output]\nframe_every = 0.5\n";

/// Folder in which commands run.
class CommandFolder : public TemporaryFolder {
 public:
  CommandFolder() = default;
  /// Writes a scenario as bed.toml.
  explicit CommandFolder(const std::string& scenario) { write_file(*this, "bed.toml", scenario); }

  Outcome talus(const Words& arguments, const Words& environment = {}) const {
    return run_talus(arguments, path(), environment);
  }
  /// Starts a command without output; its messages are those of errors().
  pid_t start(const Words& arguments) const { return start_talus(arguments, path()); }
  std::string errors() const { return errors_in(path()); }

  /// Returns a value of `talus info --json`.
  std::string info(const std::string& run, const std::string& key) const {
    return json_value(talus({"info", run, "--json"}).out, key);
  }
  /// Returns the hash of the last state of a run.
  std::string hash(const std::string& run) const { return info(run, "state_hash"); }
  std::string text(const std::string& name) const { return text_of(path(name)); }
  bool has_file(const std::string& name) const { return std::filesystem::exists(path(name)); }
};

/// Tests in a folder of commands.
class CommandTest : public testing::Test {
 protected:
  CommandTest() = default;
  explicit CommandTest(const std::string& scenario) : folder_(scenario) {}

  Outcome talus(const Words& arguments, const Words& environment = {}) const {
    return folder_.talus(arguments, environment);
  }
  std::string info(const std::string& run, const std::string& key) const { return folder_.info(run, key); }

  CommandFolder folder_;
};

class StableBedTest : public CommandTest {
 protected:
  StableBedTest() : CommandTest(stable_bed) {}
};

}  // namespace talus::test
