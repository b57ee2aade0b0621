#include "exports/export_files.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <functional>
#include <span>
#include <string_view>

#include "analysis/frame_analysis.h"
#include "analysis/frame_quantities.h"
#include "analysis/packing/packing.h"
#include "base/errors.h"
#include "base/output_file.h"
#include "base/text.h"
#include "exports/writers.h"
#include "io/durable_file.h"
#include "runs/analysis_run.h"

namespace talus::exports {
namespace {

std::string path_in(const ExportPlan& plan, const std::string& name) {
  return (std::filesystem::path(plan.output) / name).string();
}

/// VTK files of the frames, such as frames/grains_0012.vtp, and grains.pvd, which lists them over time.
struct VtkSeries {
  std::string_view name, ending;
  std::string (*text)(const analysis::GrainSource& frame, const ExportPlan& plan);
};

/// Returns the series of a format; none for a format that is not VTK.
std::span<const VtkSeries> series_of(ExportFormat format) {
  static constexpr VtkSeries bodies[] = {
      {"grains", ".vtp",
       [](const analysis::GrainSource& frame, const ExportPlan&) { return grains_vtp(frame); }},
      {"contacts", ".vtp",
       [](const analysis::GrainSource& frame, const ExportPlan&) { return contacts_vtp(frame); }}};
  static constexpr VtkSeries fields[] = {
      {"fields", ".vti", [](const analysis::GrainSource& frame, const ExportPlan& plan) {
         return fields_vti(frame, plan.field_width * frame.statics.mean_diameter);
       }}};
  if (format == ExportFormat::paraview) return bodies;
  return format == ExportFormat::vti ? fields : std::span<const VtkSeries>();
}

std::string pvd_name(const VtkSeries& series) { return fmt::format("{}.pvd", series.name); }

/// Returns the file name of a frame, such as "grains_0012.vtp" for frame 12, so that names sort by time.
std::string frame_name(const VtkSeries& series, std::size_t number) {
  return fmt::format("{}_{:04}{}", series.name, number, series.ending);
}

/// Calls `write` with each frame of the plan.
void for_each_frame(const io::RunFile& run, const ExportPlan& plan, const Watch& watch,
                    const std::function<void(const analysis::GrainSource&)>& write) {
  if (run.frame_count() == 0)
    throw Error(ExitCode::bad_data, "the run has no frames yet: the first one is the bed at rest");
  const RunStatics& statics = run.header().statics;
  const double theta_c = find_value(run.checkpoint().results, "theta_c").value_or(not_known);
  const analysis::Analysis analysis = analysis::begin_analysis(statics, plan.parameters, theta_c);
  std::vector<double> factors;
  for (const analysis::RunThreshold& threshold : analysis.thresholds) factors.push_back(threshold.factor);
  const Frame first = run.frame(0);
  for (std::size_t done = 0; done < plan.frames.size(); ++done) {
    if (watch.stopped && watch.stopped())
      throw Error(ExitCode::stopped, "stopped after {} of {} frames; repeat the command with --overwrite",
                  done, plan.frames.size());
    const std::size_t k = plan.frames[done];
    const Frame frame = run.frame(k), seen = runs::analysed_frame(run, plan.parameters, k, frame);
    const std::vector<analysis::FrameThreshold> thresholds = analysis::analyse_thresholds(
        {seen, statics}, plan.parameters, analysis, analysis::frame_volume({seen, statics}));
    write({{frame, statics}, nullptr, true, k, seen.gamma, &first, factors, thresholds});
    if (watch.progress) watch.progress(done + 1, plan.frames.size());
  }
}

void write(OutputFile& file, std::string_view text) { file.write(std::as_bytes(std::span(text))); }

/// Writes the .pvd files last, because they refer to the other files.
void export_vtk(const io::RunFile& run, const ExportPlan& plan, const Watch& watch) {
  const std::span<const VtkSeries> series = series_of(plan.format);
  std::vector<std::vector<PvdEntry>> entries(series.size());
  if (plan.format == ExportFormat::vti)
    check_field_width(run.header().statics, plan.field_width * run.header().statics.mean_diameter);
  prepare_folder(path_in(plan, "frames"));
  for_each_frame(run, plan, watch, [&](const analysis::GrainSource& frame) {
    for (std::size_t s = 0; s < series.size(); ++s) {
      entries[s].push_back({frame.frame.time, "frames/" + frame_name(series[s], frame.number)});
      io::write_text(path_in(plan, entries[s].back().file), series[s].text(frame, plan));
    }
  });
  for (std::size_t s = 0; s < series.size(); ++s)
    io::write_text(path_in(plan, pvd_name(series[s])), pvd_text(entries[s]));
}

/// Writes all frames consecutively to one file, after a header.
void export_series(const io::RunFile& run, const ExportPlan& plan, const Watch& watch, std::string_view head,
                   std::string (*text_of)(const analysis::GrainSource&)) {
  prepare_folder_of(plan.output);
  OutputFile file(plan.output);
  write(file, head);
  for_each_frame(run, plan, watch, [&](const analysis::GrainSource& frame) { write(file, text_of(frame)); });
  file.commit();
}

/// A table in a file, whose header comes from the first frame.
class CsvFile {
 public:
  explicit CsvFile(const std::string& path) : file_(path) {}
  void add(const CsvRows& csv) {
    if (!begun_) write(file_, csv.head);
    begun_ = true;
    write(file_, csv.rows);
  }
  void commit() { file_.commit(); }

 private:
  OutputFile file_;
  bool begun_ = false;
};

void export_tables(const io::RunFile& run, const ExportPlan& plan, const Watch& watch) {
  prepare_folder(plan.output);
  CsvFile frames(path_in(plan, "frames.csv")), grains(path_in(plan, "grains.csv")),
      contacts(path_in(plan, "contacts.csv"));
  for_each_frame(run, plan, watch, [&](const analysis::GrainSource& frame) {
    frames.add(frame_csv(frame));
    grains.add(grains_csv(frame));
    contacts.add(contacts_csv(frame));
  });
  for (CsvFile* file : {&frames, &grains, &contacts}) file->commit();
}

void export_page(const io::RunFile& run, const ExportPlan& plan, const Watch& watch) {
  prepare_folder_of(plan.output);
  io::write_text(plan.output, run_page(run, plan.run, plan.analysis, plan.frames, watch));
}

std::size_t export_observables(const io::RunFile& run, const ExportPlan& plan) {
  const std::vector<ObservableRow> rows = plan.flow ? run.all_observables() : run.observables();
  prepare_folder_of(plan.output);
  io::write_text(plan.output, observables_csv(rows));
  return rows.size();
}

}  // namespace

void check_output_name(ExportFormat format, const std::string& output) {
  const FormatEntry& entry = entry_of(format);
  const bool is_file = entry.output == ExportOutput::file;
  if (output.ends_with(entry.ending) != is_file)
    throw Error(ExitCode::usage, "{}: expected {} in {}", output,
                is_file ? "a name that ends" : "the name of a folder, which does not end", entry.ending);
}

std::vector<std::string> files_of(const ExportPlan& plan) {
  if (plan.format == ExportFormat::csv)
    return {path_in(plan, "frames.csv"), path_in(plan, "grains.csv"), path_in(plan, "contacts.csv")};
  const std::span<const VtkSeries> series = series_of(plan.format);
  if (series.empty()) return {plan.output};
  std::vector<std::string> files;
  for (const VtkSeries& each : series) files.push_back(path_in(plan, pvd_name(each)));
  for (const std::size_t number : plan.frames)
    for (const VtkSeries& each : series) files.push_back(path_in(plan, "frames/" + frame_name(each, number)));
  return files;
}

namespace {

/// Whether a name is that of a frame of a series.
bool is_frame_name(const std::string& name, const VtkSeries& series) {
  const std::size_t begin = series.name.size() + 1;
  std::size_t number = 0;
  if (name.size() <= begin) return false;
  std::from_chars(name.data() + begin, name.data() + name.size(), number);
  return name == frame_name(series, number);
}

/// Whether a file begins as those that Talus writes in XML.
bool is_by_talus(const std::string& path) {
  constexpr std::size_t most = 256;
  std::string text(most, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(text.data(), most);
  return text.find("<!-- talus ") != std::string::npos;
}

}  // namespace

std::vector<std::string> stale_files(const ExportPlan& plan) {
  const std::span<const VtkSeries> series = series_of(plan.format);
  const std::string folder = path_in(plan, "frames");
  const std::vector<std::string> written = files_of(plan);
  std::vector<std::string> stale;
  std::error_code unknown;
  if (series.empty()) return stale;
  for (const std::string& name : names_in(folder, unknown)) {
    const std::string path = (std::filesystem::path(folder) / name).string();
    const bool is_frame =
        std::ranges::any_of(series, [&](const VtkSeries& each) { return is_frame_name(name, each); });
    if (is_frame && std::ranges::find(written, path) == written.end() &&
        std::filesystem::is_regular_file(path, unknown) && is_by_talus(path))
      stale.push_back(path);
  }
  return stale;
}

std::size_t export_files(const io::RunFile& run, const ExportPlan& plan, const Watch& watch) {
  switch (plan.format) {
    case ExportFormat::paraview:
    case ExportFormat::vti:
      export_vtk(run, plan, watch);
      break;
    case ExportFormat::xyz:
      export_series(run, plan, watch, "", xyz_text);
      break;
    case ExportFormat::lammps:
      export_series(run, plan, watch, lammps_dump_head, lammps_dump_text);
      break;
    case ExportFormat::csv:
      export_tables(run, plan, watch);
      break;
    case ExportFormat::observables:
      return export_observables(run, plan);
    case ExportFormat::html:
      export_page(run, plan, watch);
      break;
  }
  return plan.frames.size();
}

namespace {

constexpr auto entries = std::to_array<FormatEntry>({
    {ExportFormat::paraview, "paraview", "ParaView and VTK", ExportOutput::folder, ".pvd",
     "grains.pvd and contacts.pvd over time, with grains as points and contacts as lines"},
    {ExportFormat::vti, "vti", "ParaView and VTK", ExportOutput::folder, ".pvd",
     "fields.pvd over time, with density, momentum, stress and strain rate of the bed as a continuum on a "
     "grid"},
    {ExportFormat::xyz, "xyz", "OVITO and ASE", ExportOutput::file, ".xyz",
     "grains of all frames as extended XYZ, lengths in D"},
    {ExportFormat::lammps, "lammps", "OVITO", ExportOutput::file, ".dump",
     "grains of all frames as the text of a LAMMPS dump"},
    {ExportFormat::csv, "csv", "pandas, R and spreadsheets", ExportOutput::folder, ".csv",
     "frames.csv, grains.csv and contacts.csv, one row for each"},
    {ExportFormat::observables, "observables", "pandas, R and spreadsheets", ExportOutput::file, ".csv",
     "observables of the tilt as CSV, one row for each time at which they were recorded", false},
    {ExportFormat::html, "html", "web browsers", ExportOutput::file, ".html",
     "one page with maps, time line and curves, readable without Talus or a network", true, true},
});

}  // namespace

std::span<const FormatEntry> export_formats() { return entries; }

const FormatEntry& entry_of(ExportFormat format) {
  return *std::ranges::find(entries, format, &FormatEntry::format);
}

std::optional<ExportFormat> export_format(std::string_view name) {
  const auto entry = std::ranges::find(entries, name, &FormatEntry::name);
  return entry == entries.end() ? std::nullopt : std::optional(entry->format);
}

std::string list_of_formats() {
  return joined(entries, "; ", [](const FormatEntry& entry) {
    return fmt::format("{}: {}, for {}", entry.name, entry.help, entry.program);
  });
}

}  // namespace talus::exports
