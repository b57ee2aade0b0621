#include "export/export_files.h"

#include <filesystem>
#include <fmt/core.h>
#include <functional>

#include "core/errors.h"
#include "core/output_file.h"
#include "export/exported_frame.h"
#include "export/vtp.h"
#include "io/durable_file.h"

namespace talus {
namespace {

std::string path_in(const ExportPlan& plan, const std::string& name) {
  return (std::filesystem::path(plan.output) / name).string();
}

/// "frames/grains_0012.vtp" of frame 12: names sort by time.
std::string frame_name(const char* what, std::size_t number, std::string_view ending) {
  return fmt::format("{}_{:04}{}", what, number, ending);
}

/// Calls `write` with each frame of the plan.
void for_each_frame(const RunFile& run, const ExportPlan& plan, const Watch& watch,
                    const std::function<void(const ExportedFrame&)>& write) {
  const ExportedRun common = exported_run(run, plan.parameters);
  for (std::size_t done = 0; done < plan.frames.size(); ++done) {
    if (watch.stopped && watch.stopped())
      throw Error(ExitCode::stopped,
                  fmt::format("stopped after {} of {} frames; repeat the command with --overwrite", done,
                              plan.frames.size()));
    write(exported_frame(run, common, plan.frames[done]));
    if (watch.progress) watch.progress(done + 1, plan.frames.size());
  }
}

/// The .pvd are written last: they name files that are there.
void export_paraview(const RunFile& run, const ExportPlan& plan, const Watch& watch) {
  prepare_folder(path_in(plan, "frames"));
  std::vector<PvdEntry> grains, contacts;
  for_each_frame(run, plan, watch, [&](const ExportedFrame& frame) {
    grains.push_back({frame.frame.time, frame_name("frames/grains", frame.number, ".vtp")});
    contacts.push_back({frame.frame.time, frame_name("frames/contacts", frame.number, ".vtp")});
    write_text(path_in(plan, grains.back().file), grains_vtp(frame));
    write_text(path_in(plan, contacts.back().file), contacts_vtp(frame));
  });
  write_text(path_in(plan, "grains.pvd"), pvd_text(grains));
  write_text(path_in(plan, "contacts.pvd"), pvd_text(contacts));
}

}  // namespace

std::vector<std::string> files_of(const ExportPlan& plan) {
  std::vector<std::string> files = {path_in(plan, "grains.pvd"), path_in(plan, "contacts.pvd")};
  for (const std::size_t number : plan.frames)
    for (const char* what : {"frames/grains", "frames/contacts"})
      files.push_back(path_in(plan, frame_name(what, number, ".vtp")));
  return files;
}

void export_files(const RunFile& run, const ExportPlan& plan, const Watch& watch) {
  switch (plan.format) {
    case ExportFormat::paraview:
      return export_paraview(run, plan, watch);
  }
}

}  // namespace talus
