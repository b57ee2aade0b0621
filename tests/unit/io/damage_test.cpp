/// Damaged and foreign files, other versions, and other readers. Work that ends its process does not end the
/// parent.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <unistd.h>

#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "base/errors.h"
#include "base/output_file.h"
#include "base/version.h"
#include "io/child_process.h"
#include "io/hdf5_file.h"
#include "io/packed_file.h"
#include "io/run_file.h"
#include "io/run_folder.h"
#include "io/run_schema.h"
#include "support/exit_code.h"
#include "support/places.h"
#include "unit/io/damaged_run.h"
#include "unit/io/example_run.h"

namespace talus::io {
namespace {

namespace fs = std::filesystem;

/// Expects opening `path` to fail with bad_data and a message that names `file`.
void expect_refused(const std::string& path, const std::string& file, const std::string& how) {
  EXPECT_TRUE(test::refuses([&] { RunFile::open(path); }, ExitCode::bad_data, {file})) << how << ": ";
}

class Damage : public test::FolderTest {
 protected:
  const std::string path = folder.path("run.h5");
};

TEST_F(Damage, a_byte_after_the_end_is_found) {
  example::store_with_commits(path, 3).pack();
  example::write_text(path, test::text_of(path) + "x");
  expect_refused(path, path, "an added byte");
}

TEST_F(Damage, a_manifest_names_files_of_its_folder_only) {
  Manifest manifest;
  manifest.header.name = "header.h5";
  manifest.checkpoint.name = "checkpoint_000002.h5";
  EXPECT_NO_THROW(parse_manifest(manifest_text(manifest), "manifest"));
  for (const char* name : {"../header.h5", "/etc/passwd", "checkpoint_99999999999999999999.h5", "lock"}) {
    manifest.checkpoint.name = name;
    EXPECT_TRUE(test::refuses([&] { parse_manifest(manifest_text(manifest), "manifest"); },
                              ExitCode::bad_data, {name}));
  }
}

TEST_F(Damage, a_file_the_manifest_names_is_missing) {
  { const RunStore store = example::store_with_commits(path, 2); }
  const std::string segment = test::path_beginning(run_folder(path), "segment_000001");
  ASSERT_TRUE(fs::remove(segment));
  expect_refused(path, fs::path(segment).filename().string(), "removal");
}

TEST_F(Damage, a_foreign_file_is_not_taken_for_a_run) {
  example::write_text(folder.path("run.h5"), "\x89HDF\r\n\x1a\n and so on");
  expect_refused(folder.path("run.h5"), "run.h5: is not a Talus run file", "a foreign file");
}

/// A file with a correct hash but foreign data sets.
TEST_F(Damage, shapes_and_types_are_checked_against_the_schema) {
  hdf5::Writer writer({{'N', 3}, {'G', 3}});
  writer.write("/particles/grains/radius", std::vector<double>{1, 2, 3});
  writer.write("/checkpoint/x", std::vector<double>{1, 2, 3});
  writer.write("/checkpoint/length", std::vector<double>{1});
  const std::vector<std::byte> image = writer.image();

  hdf5::Reader other_size = hdf5::Reader::from_memory(image, "made.h5", {{'G', 4}});
  EXPECT_EQ(test::refusal_of([&] { other_size.read<double>("/checkpoint/x"); }),
            (test::Refusal{ExitCode::bad_data,
                           "made.h5: data set /checkpoint/x has shape [3], expected [G] with G = 4"}));
  hdf5::Reader reader = hdf5::Reader::from_memory(image, "made.h5", {});
  EXPECT_EQ(reader.read<double>("/checkpoint/x"), (std::vector<double>{1, 2, 3}));
  EXPECT_THROW(reader.read<double>("/checkpoint/y"), Error);  // missing
  EXPECT_THROW(reader.read<double>("/particles/grains/radius", {}, hdf5::Rows{2, 2}),
               Error);                                                  // too many rows
  EXPECT_THROW(reader.read_text("/parameters/scenario_given"), Error);  // missing
}

class SchemaVersion : public testing::Test {
 protected:
  /// Writes a run without commands.
  SchemaVersion() {
    RunStore store = RunStore::create(path_, example::header(), false);
    store.commit(example::segment(1), example::checkpoint(1));
    store.pack();
  }

  example::TemporaryFolder folder_;
  std::string path_ = folder_.path("run.h5");
};

TEST_F(SchemaVersion, other_than_the_present_one_is_refused_with_both_named) {
  EXPECT_NO_THROW(RunFile::open(path_));
  for (const std::int32_t version : {0, run_schema_version - 1, run_schema_version + 1}) {
    example::set_version(path_, version);
    EXPECT_EQ(test::refusal_of([&] { RunFile::open(path_); }),
              (test::Refusal{ExitCode::bad_data,
                             path_ + ": data set /parameters/schema_version is " + std::to_string(version) +
                                 ", expected " + std::to_string(run_schema_version) +
                                 ": another version of Talus made the run (/provenance names it); open it "
                                 "with that one, or compute it again"}));
  }
}

TEST_F(SchemaVersion, runs_without_commands_have_no_group_of_them) {
  const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  EXPECT_EQ(H5Lexists(file, "/commands", H5P_DEFAULT), 0);
  H5Fclose(file);
}

constexpr const char* interpreter = "/usr/bin/python3";

bool has_h5py() {
  return std::system((std::string(interpreter) + " -c 'import h5py' 2>/dev/null").c_str()) == 0;
}

TEST(H5py, reads_a_packed_file_and_finds_it_valid) {
  if (!has_h5py()) GTEST_SKIP() << "no h5py for " << interpreter << ": install python3-h5py";
  const example::TemporaryFolder folder;
  const std::string path = folder.path("run.h5");
  example::store_with_commits(path, 5).pack();

  const std::string command =
      std::string(interpreter) + " " + test::source_folder() + "/tests/unit/io/check_with_h5py.py " + path;
  EXPECT_EQ(std::system(command.c_str()), 0) << "see the message above";
}

/// A lock on a run is held by every process that has its file open.
TEST(ChildProcess, holds_no_file_of_its_parent) {
  const Descriptor file(::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 100));
  ASSERT_GE(file.get(), 100);
  const Parcels open = in_child_process("work", 0, [&] {
    return Parcels{{"open", {::fcntl(file.get(), F_GETFD) < 0 ? std::byte{0} : std::byte{1}}}};
  });
  EXPECT_EQ(open.at("open"), std::vector{std::byte{0}});
}

/// Returns how a child that does this ends.
std::string end_of(const std::function<std::vector<std::byte>()>& work) {
  try {
    Parcels found = in_child_process("p.h5", 0, [&] { return Parcels{{"bytes", work()}}; });
    return "returned " + std::to_string(found["bytes"].size());
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    return error.what();
  }
}

TEST(ChildProcess, gives_back_bytes_errors_and_its_death) {
  EXPECT_EQ(end_of([] { return std::vector<std::byte>(3 << 20); }), "returned " + std::to_string(3 << 20));
  EXPECT_EQ(end_of([] { return std::vector<std::byte>(); }), "returned 0");
  EXPECT_EQ(end_of([]() -> std::vector<std::byte> { throw Error(ExitCode::bad_data, "said so"); }),
            "said so");
  const std::string died = "p.h5: cannot be read: HDF5 fails on it";
  EXPECT_EQ(end_of([]() -> std::vector<std::byte> { std::abort(); }).find(died), 0u);
  EXPECT_EQ(end_of([]() -> std::vector<std::byte> { std::exit(0); }).find(died), 0u);
  EXPECT_EQ(end_of([]() -> std::vector<std::byte> { throw 1; }).find(died), 0u);
}

TEST(ChildProcess, has_only_so_much_memory) {
  if (sanitizes_addresses) GTEST_SKIP() << "memory is not limited";
  std::size_t most = std::size_t{4} << 30;
  EXPECT_NE(end_of([&] { return std::vector<std::byte>(most); }).find("more memory"), std::string::npos);
}

TEST(Parcels, cut_short_on_their_way_are_refused) {
  const std::vector<double> reals = {1.0, 2.0};
  const Parcels parcels = {{"/g", {}}, {"/g/x", bytes_of(reals)}, {"/g/k", bytes_of(std::vector<int>{3})}};
  const std::vector<std::byte> bytes = encode(parcels);
  EXPECT_EQ(decode(bytes, "p.h5"), parcels);
  EXPECT_EQ(values_of<std::vector<double>>(parcels.at("/g/x")), reals);
  int whole = 0;
  for (std::size_t size = 0; size <= bytes.size(); ++size) {
    const ExitCode code = test::exit_code_of([&] { decode(std::span(bytes).first(size), "p.h5"); });
    EXPECT_TRUE(code == ExitCode::done || code == ExitCode::bad_data);
    whole += code == ExitCode::done ? 1 : 0;
  }
  EXPECT_EQ(whole, 4) << "only at the ends of parcels";
}

}  // namespace
}  // namespace talus::io
