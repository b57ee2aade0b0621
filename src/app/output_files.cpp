#include "app/output_files.h"

#include "io/run_store.h"

namespace talus {

OutputRule output_of_run(const std::string& run, bool overwrite) {
  return {overwrite, {run, run_folder(run)}};
}

OutputRule output_of_scenario(const std::string& file, const Scenario& scenario) {
  const std::string& bed = scenario.deposition.file;
  return bed.empty() ? OutputRule{true, {file}} : OutputRule{true, {file, bed, run_folder(bed)}};
}

}  // namespace talus
