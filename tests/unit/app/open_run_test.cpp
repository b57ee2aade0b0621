/// Messages on runs that cannot be opened.

#include "app/open_run.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/errors.h"
#include "support/temporary_folder.h"

namespace talus::app {
namespace {

class OpenRunTest : public testing::Test {
 protected:
  OpenRunTest() {
    std::ofstream(request_.scenario) << "seed = 5\n[bed]\nlength = 10\ndepth = 2\n";
    OpenRun run = start_run(request_);
    io::Checkpoint checkpoint = run.session.checkpoint(0.0);
    std::erase_if(checkpoint.integers, [](const auto& named) { return named.first == "phase"; });
    run.store.commit({}, checkpoint);
  }

  test::TemporaryFolder folder_;
  RunRequest request_{folder_.path("bed.toml"), folder_.path("bed.h5"), {}, 1, false, "talus run"};
};

TEST_F(OpenRunTest, names_the_run_and_the_value_that_its_checkpoint_lacks) {
  try {
    resume_run(request_);
    ADD_FAILURE() << "opened";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    EXPECT_EQ(error.what(),
              request_.output +
                  ": data set /checkpoint/integers/phase is missing; without it the run cannot continue");
  }
}

}  // namespace
}  // namespace talus::app
