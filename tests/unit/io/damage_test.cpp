/// Damage is detected before data are interpreted, and the damaged file is named.

#include <gtest/gtest.h>

#include "base/errors.h"
#include "io/hdf5_reader.h"
#include "io/hdf5_writer.h"
#include "io/manifest.h"
#include "io/packed_file.h"
#include "io/run_file.h"
#include "unit/io/example_run.h"

namespace talus::io {
namespace {

namespace fs = std::filesystem;

/// Expects opening `path` to fail with bad_data and a message that names `file`.
void expect_refused(const std::string& path, const std::string& file, const std::string& how) {
  try {
    RunFile::open(path);
    ADD_FAILURE() << how << " of " << file << " was not detected";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data) << how << ": " << error.what();
    EXPECT_NE(std::string(error.what()).find(file), std::string::npos) << how << ": " << error.what();
  }
}

/// Flips a bit at sampled positions, truncates the file at some, and appends a byte.
void damage_everywhere(const std::string& path, const std::string& file, std::size_t samples) {
  const std::string good = example::file_text(file);
  for (std::size_t k = 0; k < samples; ++k) {
    const std::size_t position = k * (good.size() - 1) / (samples - 1);
    std::string flipped = good;
    flipped[position] = static_cast<char>(flipped[position] ^ (1 << (k % 8)));
    example::write_text(file, flipped);
    expect_refused(path, file, "a flip at " + std::to_string(position));
  }
  for (std::size_t size :
       {std::size_t{0}, std::size_t{1}, std::size_t{512}, good.size() / 2, good.size() - 1})
    if (size < good.size()) {
      example::write_text(file, good.substr(0, size));
      expect_refused(path, file, "a cut at " + std::to_string(size));
    }
  example::write_text(file, good + "x");
  expect_refused(path, file, "an added byte");
  example::write_text(file, good);
  EXPECT_NO_THROW(RunFile::open(path));
}

TEST(Damage, of_a_packed_file_is_found) {
  const example::TemporaryFolder folder;
  const std::string path = folder.path("run.h5");
  example::store_with_commits(path, 3).pack();
  damage_everywhere(path, path, 100);
}

TEST(Damage, of_any_file_of_a_folder_is_found) {
  const example::TemporaryFolder folder;
  const std::string path = folder.path("run.h5");
  { const RunStore store = example::store_with_commits(path, 3); }
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(run_folder(path)))
    if (entry.path().filename() != "lock") files.push_back(entry.path().string());
  EXPECT_EQ(files.size(), 6u);
  for (const std::string& file : files) damage_everywhere(path, file, 6);
}

TEST(Damage, a_manifest_names_files_of_its_folder_only) {
  Manifest manifest;
  manifest.header.name = "header.h5";
  manifest.checkpoint.name = "checkpoint_000002.h5";
  EXPECT_NO_THROW(parse_manifest(manifest_text(manifest), "manifest"));
  for (const char* name : {"../header.h5", "/etc/passwd", "checkpoint_99999999999999999999.h5", "lock"}) {
    manifest.checkpoint.name = name;
    try {
      parse_manifest(manifest_text(manifest), "manifest");
      ADD_FAILURE() << name << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_data);
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
}

TEST(Damage, a_file_the_manifest_names_is_missing) {
  const example::TemporaryFolder folder;
  const std::string path = folder.path("run.h5");
  { const RunStore store = example::store_with_commits(path, 2); }
  const std::string segment = test::path_beginning(run_folder(path), "segment_000001");
  ASSERT_TRUE(fs::remove(segment));
  expect_refused(path, fs::path(segment).filename().string(), "removal");
}

TEST(Damage, a_foreign_file_is_not_taken_for_a_run) {
  const example::TemporaryFolder folder;
  example::write_text(folder.path("run.h5"), "\x89HDF\r\n\x1a\n and so on");
  expect_refused(folder.path("run.h5"), "run.h5: is not a Talus run file", "a foreign file");
}

/// A file with a correct hash but foreign data sets.
TEST(Damage, shapes_and_types_are_checked_against_the_schema) {
  hdf5::Writer writer({{'N', 3}, {'G', 3}});
  writer.write("/particles/grains/radius", std::vector<double>{1, 2, 3});
  writer.write("/checkpoint/x", std::vector<double>{1, 2, 3});
  writer.write("/checkpoint/length", std::vector<double>{1});
  const std::vector<std::byte> image = writer.image();

  hdf5::Reader other_size = hdf5::Reader::from_memory(image, "made.h5", {{'G', 4}});
  try {
    other_size.read<double>("/checkpoint/x");
    ADD_FAILURE() << "a wrong size was not detected";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    EXPECT_STREQ(error.what(), "made.h5: data set /checkpoint/x has shape [3], expected [G] with G = 4");
  }
  hdf5::Reader reader = hdf5::Reader::from_memory(image, "made.h5", {});
  EXPECT_EQ(reader.read<double>("/checkpoint/x"), (std::vector<double>{1, 2, 3}));
  EXPECT_THROW(reader.read<double>("/checkpoint/y"), Error);  // missing
  EXPECT_THROW(reader.read<double>("/particles/grains/radius", {}, hdf5::Rows{2, 2}),
               Error);                                                  // too many rows
  EXPECT_THROW(reader.read_text("/parameters/scenario_given"), Error);  // missing
}

}  // namespace
}  // namespace talus::io
