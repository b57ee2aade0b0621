#include "exports/export_files.h"

#include <algorithm>
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
#include "base/paths.h"
#include "exports/page/run_page.h"
#include "exports/writers.h"
#include "io/durable_file.h"
#include "runs/analysis_input.h"

namespace talus::exports {
namespace {

std::string path_in(const ExportPlan& plan, const std::string& name) {
  return (std::filesystem::path(plan.output) / name).string();
}

/// Returns the file name of a frame, such as "frames/grains_0012.vtp" for frame 12, so that names sort by
/// time.
std::string frame_name(const char* what, std::size_t number, std::string_view ending) {
  return fmt::format("{}_{:04}{}", what, number, ending);
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
      throw Error(ExitCode::stopped,
                  fmt::format("stopped after {} of {} frames; repeat the command with --overwrite", done,
                              plan.frames.size()));
    const std::size_t k = plan.frames[done];
    const Frame frame = run.frame(k), seen = runs::analysed_frame(run, plan.parameters, k, frame);
    const std::vector<analysis::FrameThreshold> thresholds = analysis::analyse_thresholds(
        {seen, statics}, plan.parameters, analysis, analysis::frame_volume({seen, statics}));
    write({{frame, statics}, k, seen.gamma, &first, factors, thresholds});
    if (watch.progress) watch.progress(done + 1, plan.frames.size());
  }
}

void write(OutputFile& file, std::string_view text) { file.write(std::as_bytes(std::span(text))); }

/// Writes the .pvd files last, because they refer to the other files.
void export_paraview(const io::RunFile& run, const ExportPlan& plan, const Watch& watch) {
  prepare_folder(path_in(plan, "frames"));
  std::vector<PvdEntry> grains, contacts;
  for_each_frame(run, plan, watch, [&](const analysis::GrainSource& frame) {
    grains.push_back({frame.frame.time, frame_name("frames/grains", frame.number, ".vtp")});
    contacts.push_back({frame.frame.time, frame_name("frames/contacts", frame.number, ".vtp")});
    io::write_text(path_in(plan, grains.back().file), grains_vtp(frame));
    io::write_text(path_in(plan, contacts.back().file), contacts_vtp(frame));
  });
  io::write_text(path_in(plan, "grains.pvd"), pvd_text(grains));
  io::write_text(path_in(plan, "contacts.pvd"), pvd_text(contacts));
}

void export_fields(const io::RunFile& run, const ExportPlan& plan, const Watch& watch) {
  const RunStatics& statics = run.header().statics;
  const double width = plan.field_width * statics.mean_diameter;
  check_field_width(statics, width);
  prepare_folder(path_in(plan, "frames"));
  std::vector<PvdEntry> fields;
  for_each_frame(run, plan, watch, [&](const analysis::GrainSource& frame) {
    fields.push_back({frame.frame.time, frame_name("frames/fields", frame.number, ".vti")});
    io::write_text(path_in(plan, fields.back().file), fields_vti(frame, width));
  });
  io::write_text(path_in(plan, "fields.pvd"), pvd_text(fields));
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
  if (entry.output == ExportOutput::file && !output.ends_with(entry.ending))
    throw Error(ExitCode::usage, fmt::format("{}: expected a name that ends in {}", output, entry.ending));
}

std::vector<std::string> files_of(const ExportPlan& plan) {
  std::vector<std::string> files;
  switch (plan.format) {
    case ExportFormat::paraview:
      files = {path_in(plan, "grains.pvd"), path_in(plan, "contacts.pvd")};
      for (const std::size_t number : plan.frames)
        for (const char* what : {"frames/grains", "frames/contacts"})
          files.push_back(path_in(plan, frame_name(what, number, ".vtp")));
      return files;
    case ExportFormat::vti:
      files = {path_in(plan, "fields.pvd")};
      for (const std::size_t number : plan.frames)
        files.push_back(path_in(plan, frame_name("frames/fields", number, ".vti")));
      return files;
    case ExportFormat::csv:
      return {path_in(plan, "frames.csv"), path_in(plan, "grains.csv"), path_in(plan, "contacts.csv")};
    case ExportFormat::xyz:
    case ExportFormat::lammps:
    case ExportFormat::observables:
    case ExportFormat::html:
      break;
  }
  return {plan.output};
}

namespace {

/// Names of the files of frames in a format, which are in the folder "frames".
struct FrameFiles {
  std::vector<const char*> kinds;
  std::string_view ending;
};

FrameFiles frame_files(ExportFormat format) {
  switch (format) {
    case ExportFormat::paraview:
      return {{"grains", "contacts"}, ".vtp"};
    case ExportFormat::vti:
      return {{"fields"}, ".vti"};
    case ExportFormat::csv:
    case ExportFormat::xyz:
    case ExportFormat::lammps:
    case ExportFormat::observables:
    case ExportFormat::html:
      break;
  }
  return {};
}

/// Whether a name is that of a frame in a format.
bool is_frame_name(const std::string& name, const FrameFiles& files) {
  return std::ranges::any_of(files.kinds, [&](const char* kind) {
    const std::size_t begin = std::string_view(kind).size() + 1;
    std::size_t number = 0;
    if (name.size() <= begin) return false;
    std::from_chars(name.data() + begin, name.data() + name.size(), number);
    return name == frame_name(kind, number, files.ending);
  });
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
  const FrameFiles files = frame_files(plan.format);
  const std::string folder = path_in(plan, "frames");
  const std::vector<std::string> written = files_of(plan);
  std::vector<std::string> stale;
  std::error_code unknown;
  if (files.kinds.empty()) return stale;
  for (const std::string& name : names_in(folder, unknown)) {
    const std::string path = (std::filesystem::path(folder) / name).string();
    const bool is_written = std::ranges::find(written, path) != written.end();
    if (!is_written && is_frame_name(name, files) && std::filesystem::is_regular_file(path, unknown) &&
        is_by_talus(path))
      stale.push_back(path);
  }
  return stale;
}

std::size_t export_files(const io::RunFile& run, const ExportPlan& plan, const Watch& watch) {
  switch (plan.format) {
    case ExportFormat::paraview:
      export_paraview(run, plan, watch);
      break;
    case ExportFormat::vti:
      export_fields(run, plan, watch);
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

}  // namespace talus::exports
