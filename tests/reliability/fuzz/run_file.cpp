/// A run file with damage to a few data sets, sealed again and then used in every way: read, continued,
/// analysed. The input is a list of damages (hostile_file.h), so that the container stays valid for HDF5.

#include "io/run_file.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "base/errors.h"
#include "reliability/hostile_file.h"
#include "reliability/hostile_run.h"
#include "support/temporary_folder.h"

namespace {

using namespace talus;
using namespace talus::hostile;

constexpr std::size_t record_size = 12;
constexpr std::size_t max_harms = 4;

struct GoodRun {
  GoodRun() {
    make_run(folder.path("good.h5"));
    bytes = read_bytes(folder.path("good.h5"));
    paths = data_sets(bytes);
    std::erase_if(paths, [](const std::string& path) { return path.starts_with("/help/"); });
  }
  test::TemporaryFolder folder;
  Bytes bytes;
  std::vector<std::string> paths;
};

/// Decodes data set, kind of damage, index, and one or eight bytes of value.
Spoil spoil_of(const std::uint8_t* record, const std::vector<std::string>& paths) {
  Spoil spoil;
  spoil.path = paths[record[0] % paths.size()];
  spoil.harm = static_cast<Harm>(record[1] % harm_count);
  spoil.index = record[2] * 256U + record[3];
  std::memcpy(&spoil.bits, record + 4, sizeof spoil.bits);
  if (record[11] < 64) spoil.bits %= 40;
  return spoil;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const GoodRun good;
  std::vector<Spoil> spoils;
  for (std::size_t k = 0; k < std::min(size / record_size, max_harms); ++k)
    spoils.push_back(spoil_of(data + k * record_size, good.paths));
  const std::string path = good.folder.path("bad.h5");
  const Bytes bad = spoilt(good.bytes, spoils);
  write_bytes(path, bad);
  try {
    use_run(io::RunFile::from_bytes(bad, path), path);  // without a child process for each input
  } catch (const Error& error) {
    if (error.code() != ExitCode::bad_data) std::abort();
  }
  return 0;
}
