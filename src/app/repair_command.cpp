/// `talus repair`: writes a new run with the intact pieces of a damaged one.

#include <cstdio>
#include <memory>

#include "app/commands.h"
#include "app/terminal.h"
#include "io/run_repair.h"

namespace talus::app {
namespace {

struct RepairArguments {
  std::string run;
  std::string output;
  bool overwrite = false;
};

void print_lines(const char* name, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) print("  %-5s %s\n", name, line.c_str());
}

void repair(const RepairArguments& arguments) {
  const io::RepairReport report = io::repair_run({arguments.run, arguments.output, arguments.overwrite});
  if (report.was_whole) {
    print("%s is intact: nothing to repair, and nothing was written\n", arguments.run.c_str());
    return;
  }
  print("%s: intact pieces of %s\n", arguments.output.c_str(), arguments.run.c_str());
  print_lines("kept", report.kept);
  print_lines("lost", report.lost);
  if (report.of_folder)
    print("it cannot be continued; talus info prints its scenario, to compute it again\n");
}

}  // namespace

void add_repair_command(CLI::App& app) {
  auto arguments = std::make_shared<RepairArguments>();
  CLI::App* command = app.add_subcommand(
      "repair", "Save the intact pieces of a damaged run as a new run; the damaged run is not changed");
  command->add_option("RUN", arguments->run, "Run file, or the name of an incomplete run")->required();
  command->add_option("-o,--output", arguments->output, "New run (HDF5); a missing folder is created")
      ->required();
  command->add_flag("--overwrite", arguments->overwrite, "Replace an existing run of this name");
  command->callback([arguments] { repair(*arguments); });
}

}  // namespace talus::app
