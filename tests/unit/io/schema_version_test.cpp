/// Run files of another schema version are rejected.

#include <gtest/gtest.h>
#include <hdf5.h>

#include "base/errors.h"
#include "io/run_file.h"
#include "io/run_schema.h"
#include "unit/io/damaged_run.h"
#include "unit/io/example_run.h"

namespace talus::io {
namespace {

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
    try {
      RunFile::open(path_);
      FAIL() << "version " << version << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_data);
      EXPECT_EQ(error.what(), path_ + ": data set /parameters/schema_version is " + std::to_string(version) +
                                  ", expected " + std::to_string(run_schema_version) +
                                  ": another version of Talus made the run (/provenance names it); open it "
                                  "with that one, or compute it again");
    }
  }
}

TEST_F(SchemaVersion, runs_without_commands_have_no_group_of_them) {
  const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  EXPECT_EQ(H5Lexists(file, "/commands", H5P_DEFAULT), 0);
  H5Fclose(file);
}

}  // namespace
}  // namespace talus::io
