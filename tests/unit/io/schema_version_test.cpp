/// Run files of other versions: those of before there were commands still open, others are refused.

#include <gtest/gtest.h>
#include <hdf5.h>

#include "core/errors.h"
#include "io/run_file.h"
#include "io/run_schema.h"
#include "unit/io/damaged_run.h"
#include "unit/io/example_run.h"

namespace talus {
namespace {

class SchemaVersion : public testing::Test {
 protected:
  /// A run without commands, which has no /commands: as version 1 has it.
  SchemaVersion() {
    RunStore store = RunStore::create(path_, example::header(), false);
    store.commit(example::segment(1), example::checkpoint(1));
    store.pack();
  }

  example::TemporaryFolder folder_;
  std::string path_ = folder_.path("run.h5");
};

TEST_F(SchemaVersion, of_before_there_were_commands_still_opens) {
  example::set_version(path_, 1);
  const RunFile run = RunFile::open(path_);
  EXPECT_TRUE(run.commands().empty());
  EXPECT_EQ(run.steps().size(), 5u);
  EXPECT_EQ(run.frame_count(), 1u);
}

TEST_F(SchemaVersion, that_is_not_known_is_refused) {
  EXPECT_NO_THROW(RunFile::open(path_));
  for (const std::int32_t version : {0, run_schema_version + 1}) {
    example::set_version(path_, version);
    try {
      RunFile::open(path_);
      FAIL() << "version " << version << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_data);
      EXPECT_NE(std::string(error.what()).find("reads versions 1 to 3"), std::string::npos) << error.what();
    }
  }
}

TEST_F(SchemaVersion, runs_without_commands_have_no_group_of_them) {
  const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  EXPECT_EQ(H5Lexists(file, "/commands", H5P_DEFAULT), 0);
  H5Fclose(file);
}

}  // namespace
}  // namespace talus
