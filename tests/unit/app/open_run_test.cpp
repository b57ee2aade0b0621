/// Messages on runs that cannot be opened. Plots of the window as JSON. Ends of the program outside main:
/// lack of memory is reported, and a crash stays a crash.

#include "app/open_run.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "app/plot_export.h"
#include "app/program_end.h"
#include "base/errors.h"
#include "base/version.h"
#include "support/exit_code.h"
#include "support/resource_limit.h"
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
  EXPECT_EQ(test::refusal_of([&] { resume_run(request_); }),
            (test::Refusal{
                ExitCode::bad_data,
                request_.output +
                    ": data set /checkpoint/integers/phase is missing; without it the run cannot continue"}));
}

view::Plot strain_plot() {
  view::Plot plot = view::plot_of_quantity(analysis::quantity_of(&analysis::FrameRecord::volume_strain));
  plot.series[0].x = {0.0, 1.0};
  plot.series[0].y = {0.0, -0.5};
  plot.series.push_back({"law", {0.0, 1.0}, {0.0, 1.0}, true});
  plot.series.push_back({"empty", {}, {}});
  return plot;
}

TEST(PlotExport, has_the_curves_with_their_units) {
  const Json json = plot_json(strain_plot(), {}, {.shown = {}, .theta_c = 19.0}, "runs/a.h5");
  EXPECT_EQ(json["name"], "packing/volume_strain");
  ASSERT_EQ(json["series"].size(), 2u) << "those with places on the axis";
  EXPECT_EQ(json["series"][0]["unit"], "%");
  EXPECT_EQ(json["series"][0]["y"], (std::vector{0.0, -0.5}));
  EXPECT_EQ(json["series"][1]["column"], "law");
  EXPECT_EQ(json["series"][1]["law"], true);
  EXPECT_EQ(json["theta_c"], 19.0);
  EXPECT_EQ(json["run"], "runs/a.h5");
  EXPECT_TRUE(json["range"].is_null());
}

TEST(PlotExport, is_as_the_plot_is_looked_at) {
  view::Plot plot = strain_plot();
  EXPECT_EQ(plot_json(plot, {}, {}, "")["logarithmic"], false);
  plot.falling_x = true;
  const Json json = plot_json(plot, {.zoomed = {{0.25, 0.5}}, .chosen = {}, .log_y = true}, {}, "");
  EXPECT_EQ(json["range"], (std::vector{0.25, 0.5}));
  EXPECT_EQ(json["logarithmic"], true);
  EXPECT_EQ(json["falling"], true);
}

constexpr bool sanitizers_report_crashes = sanitizes_addresses || test::sanitizes_threads;
const auto out_of_memory = testing::ExitedWithCode(71);

/// Returns the exit code of an exception caught by main.
template <typename Exception>
int code_of(const Exception& exception) {
  try {
    throw exception;
  } catch (...) {
    return report_exception();
  }
}

TEST(ProgramEnd, of_an_exception_is_its_exit_code) {
  EXPECT_EQ(code_of(Error(ExitCode::missing_input, "no such file")), 66);
  EXPECT_EQ(code_of(std::bad_alloc()), 71);
  EXPECT_EQ(code_of(std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again))), 71);
  EXPECT_EQ(
      code_of(std::filesystem::filesystem_error("", std::make_error_code(std::errc::not_enough_memory))), 71);
  EXPECT_EQ(code_of(std::runtime_error("a defect")), 70);
}

TEST(ProgramEnd, on_request_is_a_plain_sentence) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(code_of(Error(ExitCode::stopped, "stopped at 12.250 deg; talus run --resume a.h5 continues")),
            75);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "Stopped at 12.250 deg; talus run --resume a.h5 continues.\n");
}

TEST(ProgramEnd, of_another_thread_is_that_of_its_exception) {
  const auto in_thread = [] { std::thread([] { throw Error(ExitCode::io_error, "no space"); }).join(); };
  EXPECT_EXIT(in_thread(), testing::ExitedWithCode(74), "talus: error: no space");
}

TEST(ProgramEnd, of_a_crash_is_the_crash) {
  if (sanitizers_report_crashes) GTEST_SKIP() << "crashes belong to the sanitizer";
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT})
    EXPECT_EXIT(std::raise(signal), testing::KilledBySignal(signal), "") << signal;
}

TEST(ProgramEnd, by_exit_or_terminate_after_a_failed_allocation_is_that_of_missing_memory) {
  const auto leave = [] {
    errno = ENOMEM;
    std::exit(-1);  // HDF5 does this
  };
  const auto terminate = [](int error) {
    errno = error;
    std::terminate();
  };
  EXPECT_EXIT(leave(), out_of_memory, "talus: error: out of memory");
  EXPECT_EXIT(terminate(ENOMEM), out_of_memory, "talus: error: out of memory");
  if (!sanitizers_report_crashes) {
    EXPECT_EXIT(terminate(0), testing::KilledBySignal(SIGABRT), "");
  }
}

}  // namespace
}  // namespace talus::app
