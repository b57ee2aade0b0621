#include "io/packed_file.h"

#include <fcntl.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fmt/core.h>
#include <span>
#include <string_view>

#include "core/descriptor.h"
#include "core/errors.h"
#include "core/hash.h"
#include "core/version.h"
#include "io/mistaken_path.h"
#include "io/run_records.h"
#include "io/signature.h"

namespace talus {
namespace {

constexpr std::string_view seal_begin = "talus run file 1\n";
constexpr std::size_t read_size = std::size_t{1} << 20;

std::vector<std::byte> seal_of(std::uint64_t size, std::uint64_t hash) {
  const std::string text =
      fmt::format("{}size {}\nxxh3 of all after byte 512 {}\n", seal_begin, size, hash_text(hash));
  std::vector<std::byte> block(seal_size);
  std::memcpy(block.data(), text.data(), text.size());
  return block;
}

/// Thrown to leave write_frames.
struct Interrupted {};

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

void seal(std::vector<std::byte>& file) {
  const auto hash = hash_bytes(std::span(file).subspan(seal_size));
  std::ranges::copy(seal_of(file.size(), hash), file.begin());
}

bool is_run(const std::string& path) {
  const std::filesystem::path name(path);
  std::error_code unknown;
  if (name.extension() == ".h5" || name.extension() == ".run" || std::filesystem::is_directory(name, unknown))
    return true;
  return begins_as_run(path) || begins_with(path, hdf5_signature);
}

bool begins_with(const std::string& path, std::string_view bytes) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown)) return false;  // a pipe gives its bytes once
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  if (file.get() < 0 && errno == EACCES) return false;  // who needs it will say so
  if (file.get() < 0) throw system_error(ExitCode::missing_input, "open", path, errno);
  std::string begin(bytes.size(), '\0');
  begin.resize(read_at_most(file, std::as_writable_bytes(std::span(begin)), path));
  return begin == bytes;
}

bool begins_as_run(const std::string& path) { return begins_with(path, seal_begin); }

std::uint64_t sealed_size(std::span<const std::byte> file) {
  const std::string begin(reinterpret_cast<const char*>(file.data()), std::min(file.size(), seal_size));
  const std::string words = fmt::format("{}size ", seal_begin);
  return begin.starts_with(words) ? std::strtoull(begin.c_str() + words.size(), nullptr, 10) : 0;
}

std::uint64_t seal_hash(std::span<const std::byte> file) {
  return hash_bytes(file.first(std::min(file.size(), seal_size)));
}

std::uint64_t seal_hash_of(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  if (file.get() < 0) throw system_error(ExitCode::missing_input, "open", path, errno);
  std::vector<std::byte> block(seal_size);
  block.resize(read_at_most(file, block, path));
  return seal_hash(block);
}

void verify_seal(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) throw system_error(ExitCode::missing_input, "open", path, errno);
  std::vector<std::byte> block(seal_size);
  const std::size_t block_size = read_at_most(file, block, path);
  if (std::memcmp(block.data(), seal_begin.data(), seal_begin.size()) != 0) refuse_no_run(path);
  Hasher hasher;
  std::uint64_t size = block_size;
  std::vector<std::byte> buffer(read_size);
  while (const std::size_t count = read_at_most(file, buffer, path)) {
    hasher.add_bytes(buffer.data(), count);
    size += count;
  }
  if (block != seal_of(size, hasher.value()))
    throw Error(
        ExitCode::bad_data,
        fmt::format("{}: is damaged: its {} bytes have the hash {}, but its first lines say otherwise; "
                    "restore it from a copy, or save what is undamaged with: talus repair {} -o NEW.h5",
                    path, size, hash_text(hasher.value()), path));
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
          [&run, whole](std::size_t k) { return whole ? run.frame(k) : run.instant(k); },
          whole};
}

bool lacks_state(const RunHeader& header, const Checkpoint& checkpoint) {
  return find_value(header.provenance, lost_fact) && checkpoint.world.grains.count() == 0;
}

std::vector<std::byte> packed_bytes(const RunContent& run, const std::function<bool()>& goes_on) try {
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
    if (goes_on && !goes_on()) throw Interrupted{};
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
} catch (const Interrupted&) {
  return {};
}

}  // namespace talus
