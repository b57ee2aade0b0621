#include "app/map_options.h"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <limits>

#include "core/errors.h"
#include "core/trigonometry.h"
#include "render/layout.h"

namespace talus {
namespace {

double theta_c_of(const MapOptions& options, const RunFile& file) {
  if (options.theta_c >= 0.0) return radians(options.theta_c);
  for (const auto& [name, value] : file.checkpoint().results)
    if (name == "theta_c") return value;
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

void add_map_options(CLI::App& command, MapOptions& options) {
  command
      .add_option("RUN", options.run,
                  "Run to draw: RUN.h5, or the folder RUN.h5.run of one that is under way")
      ->required();
  command
      .add_option("--width", options.width, "Width of the picture in pixels; the height follows from the bed")
      ->capture_default_str()
      ->check(CLI::Range(smallest_width, largest_side));
  command.add_option("--theta-c", options.theta_c, "Angle of repose in degrees, instead of that of the run")
      ->check(CLI::Range(2.0, 89.0));
  command.add_flag("--overwrite", options.overwrite, "Replace files that exist");
}

MappedRun open_mapped_run(const MapOptions& options) {
  MappedRun run{RunFile::open(options.run), {}, 0.0};
  if (run.file.frame_count() == 0)
    throw Error(ExitCode::bad_data,
                options.run + " has no frames yet: nothing is drawn before the tilt begins");
  run.theta_c = theta_c_of(options, run.file);
  for (std::size_t k = 0; k < run.file.frame_count(); ++k)
    extend(run.extent, run.file.frame(k), run.file.header().statics);
  return run;
}

FrameView map_of_frame(const MappedRun& run, std::size_t k, MapKind kind) {
  if (!(run.theta_c > 0.0))
    throw Error(ExitCode::bad_data,
                "the map " + std::string(map_name(kind)) +
                    " needs the angle of repose, and the slope has not failed in this run; give it "
                    "with --theta-c DEG");
  return make_map(run.file.frame(k), run.file.header().statics, kind, run.theta_c, run.extent);
}

void refuse_existing(const std::string& path, bool overwrite) {
  if (!overwrite && std::filesystem::exists(path))
    throw Error(ExitCode::cannot_create, path + " exists; give --overwrite to replace it, or another -o");
}

void show_frame_progress(const char* label, std::size_t k, std::size_t count) {
  if (isatty(STDERR_FILENO) == 0) return;
  std::fprintf(stderr, "\r%s %zu/%zu%s", label, k, count, k == count ? "\n" : "");
}

}  // namespace talus
