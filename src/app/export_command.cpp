/// `talus export`: writes runs in formats of other programs.

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <fmt/core.h>
#include <memory>
#include <sstream>

#include "analysis/record.h"
#include "app/commands.h"
#include "app/frame_options.h"
#include "app/map_options.h"
#include "app/options.h"
#include "app/program_end.h"
#include "app/progress.h"
#include "app/run_files.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "base/text.h"
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
  bool overwrite = false;
  bool quiet = false;
};

exports::ExportFormat format_of(const std::string& name) {
  if (const auto format = exports::export_format(name)) return *format;
  const auto same = [](unsigned char one, unsigned char other) {
    return std::tolower(one) == std::tolower(other);
  };
  std::string readable;  // by the program that was named
  for (const exports::FormatEntry& entry : exports::export_formats()) {
    std::string programs(entry.program);
    std::ranges::replace(programs, ',', ' ');
    std::istringstream words(programs);
    for (std::string program; words >> program;)
      if (std::ranges::equal(program, name, same))
        readable += fmt::format("{}'{}'", readable.empty() ? "; did you mean " : " or ", entry.name);
  }
  if (!readable.empty()) readable += "?";
  throw Error(ExitCode::usage, "--to {}: no such format; expected one of {}{}", visible_word(name),
              joined(exports::export_formats(), ", ", &exports::FormatEntry::name),
              readable.empty() ? did_you_mean(name, names_of(exports::export_formats())) : readable);
}

/// Reports that quantities of overloaded grains are left out if the threshold is unknown.
void report_omissions(const io::RunFile& run, const exports::ExportPlan& plan) {
  const double theta_c = find_value(run.checkpoint().results, "theta_c").value_or(not_known);
  if (!std::isnan(theta_c) || plan.parameters.gamma_c || plan.format == exports::ExportFormat::vti) return;
  print(
      "Overloaded grains, their lengths and clusters are left out: the slope has not failed in this run, so "
      "its angle of repose is unknown; set a threshold with --set gamma_c=0.3.\n");
}

/// The parameters of an analysis, and for vti the diameter of the coarse-graining function.
struct ExportParameters {
  analysis::AnalysisParameters analysis;
  double length = exports::ExportPlan().field_width;
};

ExportParameters read_parameters(exports::ExportFormat format, const std::vector<std::string>& settings) {
  const auto is_length = [](const std::string& setting) {
    return scenario::trimmed(std::string_view(setting).substr(0, setting.find('='))) == "length";
  };
  if (format != exports::ExportFormat::vti && std::ranges::any_of(settings, is_length))
    throw Error(ExitCode::usage,
                "--set length: applies only to --to vti, the format of coarse-grained fields");
  std::vector<scenario::Key<ExportParameters>> keys;
  for (const runs::AnalysisKey& key : runs::analysis_keys())
    keys.emplace_back(&ExportParameters::analysis, key);
  keys.emplace_back(length_key(), &ExportParameters::length);
  return scenario::parse_settings(keys, settings, "l_min=0");
}

exports::ExportPlan plan_export(const ExportArguments& arguments) {
  exports::ExportPlan plan;
  plan.format = format_of(arguments.format);
  plan.output = arguments.output;
  plan.run = arguments.run;
  plan.flow = arguments.frames.flow;
  const ExportParameters parameters = read_parameters(plan.format, arguments.settings);
  plan.parameters = parameters.analysis;
  plan.field_width = parameters.length;
  exports::check_output_name(plan.format, plan.output);
  if (!exports::entry_of(plan.format).has_frames && (!arguments.frames.at.empty() || arguments.frames.every))
    throw Error(ExitCode::usage, "--to {} writes all rows of the run; --at and --every have no effect on it",
                arguments.format);
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
    print("removed from {}: {} of frames of an earlier export\n", arguments.output,
          counted(stale.size(), "file"));
  if (format.has_frames) report_omissions(run, plan);
  print("{}: {} for {}\n", arguments.output, counted(count, format.has_frames ? "frame" : "row"),
        format.program);
}

}  // namespace

void add_export_command(CLI::App& app) {
  auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command = app.add_subcommand(
      "export", "Write frames of a run for other programs: ParaView, OVITO, tables, web browsers");
  add_run_argument(*command, arguments->run);
  // Unknown names are rejected by format_of, which suggests the nearest one; the parser only shows the names.
  add_option(
      *command, "--to", arguments->format,
      fmt::format("FORMAT:{{{}}}", joined(exports::export_formats(), ",", &exports::FormatEntry::name)),
      "Format. " + exports::list_of_formats())
      ->required();
  add_option(*command, "-o,--output", arguments->output, "PATH",
             "File or folder to write, depending on the format; missing folders are created")
      ->required();
  add_analysis_settings(*command, arguments->settings, "l_min=0, or for --to vti length=5");
  command->add_flag("--overwrite", arguments->overwrite, "Replace existing files");
  command->add_flag("-q,--quiet", arguments->quiet, "Print errors and warnings only");
  add_frame_options(*command, arguments->frames, "all during the tilt");
  command->footer(
      "docs/export.md lists the written data and their units. To write the contact\nproblem of a step, use "
      "`talus dump` (FCLIB).");
  command->callback([arguments] { export_run(*arguments); });
}

}  // namespace talus::app
