/// The command line: parses, runs one subcommand, and turns errors into messages and exit codes.

#include <cstdio>
#include <new>

#include "app/commands.h"
#include "core/errors.h"
#include "core/version.h"

namespace {

int report(talus::ExitCode code, const char* message) {
  std::fprintf(stderr, "talus: error: %s\n", message);
  return static_cast<int>(code);
}

}  // namespace

int main(int argc, char** argv) {
  using talus::ExitCode;
  CLI::App app{"Talus: granular slopes by Contact Dynamics, from a scenario file to maps of failure.",
               "talus"};
  app.set_version_flag("--version", talus::version_text());
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 64 usage, 65 bad scenario, run or problem, 66 missing input,\n"
      "69 no context, display or tool, 70 internal, 71 out of memory, 73 cannot create output, 74 I/O "
      "error,\n"
      "75 stopped and resumable.");
  try {
    talus::add_run_command(app);
    talus::add_check_command(app);
    talus::add_info_command(app);
    talus::add_analyze_command(app);
    talus::add_render_command(app);
    talus::add_animate_command(app);
    talus::add_panel_command(app);
    talus::add_dump_command(app);
    talus::add_solve_command(app);
    talus::add_study_command(app);
    talus::add_perturb_command(app);
    talus::add_figures_command(app);
    talus::add_reproduce_command(app);
    talus::add_view_command(app);
    talus::add_replay_command(app);
    app.parse(argc, argv);
    return static_cast<int>(ExitCode::done);
  } catch (const CLI::Success& success) {  // --help, --version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    app.exit(error);
    return static_cast<int>(ExitCode::usage);
  } catch (const talus::LocatedError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code());
  } catch (const talus::Error& error) {
    return report(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return report(ExitCode::out_of_memory, "out of memory: use a smaller bed (bed.length, bed.depth)");
  } catch (const std::exception& error) {
    return report(ExitCode::internal, error.what());
  }
}
