/// `talus export`: writes runs in formats of other programs.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/core.h>
#include <memory>
#include <optional>

#include "analysis/record.h"
#include "app/choices.h"
#include "app/commands.h"
#include "app/frame_options.h"
#include "app/output_files.h"
#include "app/progress.h"
#include "app/stop_signals.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "base/nearest_word.h"
#include "base/text.h"
#include "base/visible_text.h"
#include "exports/export_files.h"
#include "io/durable_file.h"
#include "runs/analysis_parameters.h"
#include "runs/run_view.h"

namespace talus::app {
namespace {

struct ExportArguments {
  std::string run;
  std::string format;
  std::string output;
  FrameOptions frames;
  std::vector<std::string> settings;
  std::optional<double> length;
  bool overwrite = false;
  bool quiet = false;
};

exports::ExportFormat format_of(const std::string& name) {
  if (const auto format = exports::export_format(name)) return *format;
  throw Error(ExitCode::usage,
              fmt::format("--to {}: no such format; expected one of {}{}", visible_word(name),
                          joined(exports::export_formats(), ", ", &exports::FormatEntry::name),
                          did_you_mean(name, names_of(exports::export_formats()))));
}

/// Reports that quantities of overloaded grains are left out if the threshold is unknown.
void report_omissions(const io::RunFile& run, const exports::ExportPlan& plan) {
  const double theta_c = find_value(run.checkpoint().results, "theta_c").value_or(not_known);
  if (!std::isnan(theta_c) || plan.parameters.gamma_c || plan.format == exports::ExportFormat::vti) return;
  print(
      "Overloaded grains, their lengths and clusters are left out: the slope has not failed in this run, so "
      "its angle of repose is unknown; set a threshold with --set gamma_c=0.3.\n");
}

bool requests_frames(const FrameOptions& frames) {
  return !frames.numbers.empty() || !frames.at.empty() || frames.every;
}

exports::ExportPlan plan_export(const ExportArguments& arguments) {
  exports::ExportPlan plan;
  plan.format = format_of(arguments.format);
  plan.output = arguments.output;
  plan.run = arguments.run;
  plan.flow = arguments.frames.flow;
  plan.parameters = runs::parse_analysis_settings(arguments.settings);
  exports::check_output_name(plan.format, plan.output);
  if (arguments.length && plan.format != exports::ExportFormat::vti)
    throw Error(ExitCode::usage, "--length: applies only to --to vti, the format of coarse-grained fields");
  plan.field_width = arguments.length.value_or(plan.field_width);
  if (!exports::entry_of(plan.format).has_frames && requests_frames(arguments.frames))
    throw Error(
        ExitCode::usage,
        fmt::format("--to {} writes all rows of the run; --frames, --at and --every have no effect on it",
                    arguments.format));
  return plan;
}

void export_run(const ExportArguments& arguments) {
  exports::ExportPlan plan = plan_export(arguments);
  const exports::FormatEntry& format = exports::entry_of(plan.format);
  const io::RunFile run = io::RunFile::open(arguments.run);
  if (format.has_frames)
    plan.frames = chosen_frames(run, arguments.run, arguments.frames);
  else
    require_flow(run, arguments.run, arguments.frames);
  const std::vector<std::string> stale =
      arguments.overwrite ? exports::stale_files(plan) : std::vector<std::string>();
  for (const std::vector<std::string>& files : {exports::files_of(plan), stale})
    for (const std::string& file : files)
      output_target(file, output_of_run(arguments.run, arguments.overwrite));
  if (format.needs_analysis)
    plan.analysis = runs::analysed_run(arguments.run, plan.parameters,
                                       {.progress = count_shown("analysis", arguments.quiet)})
                        .analysis;
  const std::size_t count =
      exports::export_files(run, plan, {count_shown("exporting", arguments.quiet), asked_to_stop});
  for (const std::string& file : stale) io::remove_file(file);
  if (arguments.quiet) return;
  if (!stale.empty())
    print("%zu files of frames of an earlier export were removed from %s\n", stale.size(),
          arguments.output.c_str());
  if (format.has_frames) report_omissions(run, plan);
  print("%s: %zu %s%s for %s\n", arguments.output.c_str(), count, format.has_frames ? "frame" : "row",
        count == 1 ? "" : "s", std::string(format.program).c_str());
}

}  // namespace

void add_export_command(CLI::App& app) {
  auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command = app.add_subcommand(
      "export", "Write frames of a run for other programs: ParaView, OVITO, tables, web browsers");
  command
      ->add_option("RUN", arguments->run,
                   "Run to export: RUN.h5, or the folder RUN.h5.run of a run under way")
      ->required();
  // Unknown names are rejected by format_of, which suggests the nearest one; the parser only shows the names.
  command->add_option("--to", arguments->format, "Format. " + exports::list_of_formats())
      ->required()
      ->type_name(
          fmt::format("FORMAT:{{{}}}", joined(exports::export_formats(), ",", &exports::FormatEntry::name)));
  command
      ->add_option("-o,--output", arguments->output,
                   "File or folder to write, depending on the format; missing folders are created")
      ->required();
  command
      ->add_option("--set", arguments->settings,
                   "Change a parameter of the analysis of overloaded grains, e.g. --set l_min=0 (see "
                   "docs/analysis.md)")
      ->allow_extra_args(false);
  command
      ->add_option("--length", arguments->length,
                   "For --to vti: diameter of the coarse-graining function in mean diameters; the grid "
                   "spacing is a tenth of it [10]")
      ->check(in_range(1.0, 1000.0));
  command->add_flag("--overwrite", arguments->overwrite, "Replace existing files");
  command->add_flag("-q,--quiet", arguments->quiet, "Print errors and warnings only");
  add_frame_options(*command, arguments->frames, "all during the tilt");
  command->footer(
      "docs/export.md lists the written data and their units. To write the contact\nproblem of a step, use "
      "`talus dump` (FCLIB).");
  command->callback([arguments] { export_run(*arguments); });
}

}  // namespace talus::app
