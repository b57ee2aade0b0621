#include "io/packed_file.h"

#include <filesystem>

#include "base/version.h"
#include "io/run_records.h"
#include "io/seal.h"

namespace talus::io {
namespace {

/// Thrown to leave write_frames.
struct Interruption {};

}  // namespace

void write_h5md(hdf5::Writer& writer, bool periodic) {
  writer.set_attribute("/h5md", "version", std::vector<std::int32_t>{1, 1});
  writer.set_attribute("/h5md/author", "name", "unspecified");
  writer.set_attribute("/h5md/creator", "name", "talus");
  writer.set_attribute("/h5md/creator", "version", version);
  const std::string box = "/particles/grains/box";
  writer.set_attribute(box, "dimension", std::vector<std::int32_t>{2});
  writer.set_attribute(box, "boundary", std::vector<std::string>{periodic ? "periodic" : "none", "none"});
}

void write_help(hdf5::Writer& writer) {
  for (const DataSetField& field : run_schema())
    if (!field.path.ends_with("/*")) writer.write_help(field.path, field.help);
}

bool is_run(const std::string& path) {
  const std::filesystem::path name(path);
  std::error_code unknown;
  if (name.extension() == ".h5" || name.extension() == ".run" || std::filesystem::is_directory(name, unknown))
    return true;
  return begins_as_run(path) || begins_with(path, hdf5_signature);
}

RunContent content_of(const RunFile& run, bool with_frames) {
  const bool whole = with_frames && run.has_frames();
  return {run.header(),
          run.checkpoint(),
          run.all_observables(),
          run.steps(),
          run.commands(),
          run.trials(),
          run.all_frame_tilts().size(),
          run.contact_count(),
          [&run, whole](std::size_t k) { return whole ? run.stored_frame(k) : run.instant(k); },
          whole};
}

bool lacks_state(const RunHeader& header, const Checkpoint& checkpoint) {
  return find_value(header.provenance, lost_fact) && checkpoint.world.grains.count() == 0;
}

std::vector<std::byte> packed_bytes(const RunContent& run, const std::function<bool()>& should_continue) try {
  const World& world = run.checkpoint.world;
  Sizes sizes = {{'T', run.frames},
                 {'N', run.header.statics.radius.size()},
                 {'M', run.contacts},
                 {'R', run.observables.size()},
                 {'S', run.steps.size()},
                 {'K', run.commands.size()},
                 {'Q', run.trials.size()},
                 {'G', world.grains.radius.size()},
                 {'C', world.contacts.a.size()},
                 {'P', world.boundary.planes.size()}};
  hdf5::Writer writer(with_branch(std::move(sizes), run.header), seal_size);
  write_header(writer, run.header);
  write_h5md(writer, run.header.statics.periodic);
  const auto frame_at = [&](std::size_t k) {
    if (should_continue && !should_continue()) throw Interruption{};
    return run.frame_at(k);
  };
  if (run.has_frames)
    write_frames(writer, frame_at);
  else
    write_instants(writer, frame_at);
  write_observables(writer, run.observables);
  write_steps(writer, run.steps);
  write_commands(writer, run.commands);
  write_trials(writer, run.trials);
  if (lacks_state(run.header, run.checkpoint))
    write_results(writer, run.checkpoint);
  else
    write_checkpoint(writer, run.checkpoint);
  writer.write_contents();
  write_help(writer);
  std::vector<std::byte> file = writer.image();
  seal(file);
  return file;
} catch (const Interruption&) {
  return {};
}

}  // namespace talus::io
