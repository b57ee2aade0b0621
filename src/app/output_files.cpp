#include "app/output_files.h"

#include "app/terminal.h"
#include "base/locked_file.h"
#include "io/run_store.h"

namespace talus::app {

OutputRule output_of_run(const std::string& run, bool overwrite) {
  return {overwrite, {run, io::run_folder(run)}};
}

OutputRule output_of_scenario(const std::string& file, const scenario::Scenario& scenario) {
  const std::string& bed = scenario.deposition.file;
  return bed.empty() ? OutputRule{true, {file}} : OutputRule{true, {file, bed, io::run_folder(bed)}};
}

void note_missing_locks() {
  if (const std::string problem = fetch_lock_problem(); !problem.empty())
    print_error(
        "talus: note: the file system has no locks (%s): do not start a second command that writes the same "
        "output, because it would not be refused\n",
        problem.c_str());
}

}  // namespace talus::app
