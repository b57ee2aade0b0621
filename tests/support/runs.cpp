#include "support/runs.h"

#include <unistd.h>

#include <stdexcept>

#include "base/hash.h"
#include "support/places.h"
#include "support/process.h"

namespace talus::test {
namespace {

namespace fs = std::filesystem;

/// Returns the folder of the runs that this program makes; removes those of other builds of the program.
fs::path folder_of_runs() {
  Hasher program;
  program.add_array(text_of(talus_program()));
  const fs::path all = fs::path(build_folder()) / "kept_runs", mine = all / hash_text(program.value());
  fs::create_directories(mine);
  std::error_code ignored;  // another process may remove them too
  for (fs::directory_iterator entry(all, ignored), end; entry != end; entry.increment(ignored))
    if (std::error_code still_ignored; entry->path() != mine) fs::remove_all(entry->path(), still_ignored);
  return mine;
}

/// Makes the run under a name of this process first, because another process may make the same run at the
/// same time.
void make_run(const std::string& scenario, const std::vector<std::string>& arguments, const fs::path& path) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", scenario);
  std::vector<std::string> command = {"run", "bed.toml", "-q", "-o", "bed.h5"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  const Outcome outcome = run_talus(command, folder.path());
  if (outcome.exit_code != 0) throw std::runtime_error("no run: " + outcome.err);
  const fs::path part = path.string() + "." + std::to_string(getpid());
  fs::copy_file(folder.path("bed.h5"), part, fs::copy_options::overwrite_existing);
  fs::rename(part, path);
}

}  // namespace

fs::path kept_run(const std::string& scenario, const std::vector<std::string>& arguments) {
  static const fs::path folder = folder_of_runs();
  Hasher asked;
  asked.add_array(scenario);
  for (const std::string& argument : arguments) asked.add_array(argument);
  const fs::path path = folder / (hash_text(asked.value()) + ".h5");
  if (!fs::exists(path)) make_run(scenario, arguments, path);
  return path;
}

std::string take_run(const TemporaryFolder& folder, const std::string& name, const std::string& scenario,
                     const std::vector<std::string>& arguments) {
  fs::copy_file(kept_run(scenario, arguments), folder.path(name));
  return folder.path(name);
}

}  // namespace talus::test
