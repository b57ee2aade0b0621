/// Frames of a live run and of its file have the same values under the same names.

#include "library/measured_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "analysis/frame_quantities.h"
#include "analysis/quantities.h"
#include "io/packed_file.h"
#include "library/simulation.h"
#include "runs/run_view.h"
#include "support/exit_code.h"
#include "support/small_bed.h"
#include "support/temporary_folder.h"

namespace talus {
namespace {

bool same(double one, double other) { return one == other || (std::isnan(one) && std::isnan(other)); }

TEST(MeasuredFrame, of_a_file_has_the_numbers_of_its_analysis) {
  const test::TemporaryFolder folder;
  scenario::Scenario scenario = test::small_tilted_bed(10.0);
  Simulation sim(scenario);
  sim.record(folder.path("run.h5"));
  sim.finish();
  analysis::AnalysisParameters parameters;
  parameters.gamma_c = 0.3;
  const runs::RunView run = runs::analysed_run(folder.path("run.h5"), parameters, {});
  const std::size_t k = run.analysis.frames.size() / 2;
  MeasuredFrame frame = measured_frame(folder.path("run.h5"), k, {"gamma_c=0.3"});
  int compared = 0;
  for (const analysis::Quantity& quantity : analysis::quantities()) {
    if (!analysis::is_number_of_frame(quantity) || quantity.name.starts_with("deformation/"))
      continue;  // requires two frames
    for (std::size_t f = 0; f < (analysis::needs_threshold(quantity) ? 2u : 1u); ++f) {
      const std::string name = f == 0 ? quantity.name : quantity.name + "[1]";
      EXPECT_TRUE(same(frame.quantity(name), analysis::number_of(quantity, run.analysis.frames[k], f)))
          << name;
      ++compared;
    }
  }
  EXPECT_GT(compared, 30);
}

/// The grains at each threshold are counted from their gamma and Gamma_c = 0.1.
TEST(MeasuredFrame, has_its_quantities_at_every_threshold) {
  Simulation sim(test::small_tilted_bed(10.0));
  sim.set_analysis({"gamma_c=0.1", "threshold_factors=[1, 1.5, 4]"});
  sim.tilt_to(5.0);
  const std::vector<double> gamma = sim.grain_values("gamma_neighbourhood");
  const auto names = sim.measured().grain_quantities();
  for (const auto& [ending, factor] : {std::pair{"", 1.0},
                                       {"[0]", 1.0},
                                       {"_1", 1.0},
                                       {"[1]", 1.5},
                                       {"_1_5", 1.5},
                                       {"[2]", 4.0},
                                       {"_4", 4.0}}) {
    const std::string name = std::string("overloaded") + ending;
    const std::vector<double> overloaded = sim.grain_values(name);
    for (Index i = 0; i < sim.world().grains.free_count; ++i)
      EXPECT_EQ(overloaded[i] == 1.0, gamma[i] >= factor * 0.1) << name << " of grain " << i;
    EXPECT_EQ(std::ranges::count(names, name), name.ends_with(']') ? 0 : 1) << name;
  }
  for (const std::string& name : names) EXPECT_NO_THROW(sim.grain_values(name)) << name;
  for (const std::string& name : sim.measured().contact_quantities())
    EXPECT_NO_THROW(sim.contact_values(name));
  for (const std::string& name : sim.measured().quantities()) EXPECT_NO_THROW(sim.quantity(name)) << name;
  for (const char* name : {"overloaded_2", "overloaded[3]", "radius[0]x", "radius_1"})
    EXPECT_EQ(test::exit_code_of([&] { sim.grain_values(name); }), ExitCode::usage) << name;
  EXPECT_TRUE(sim.measured().grain_quantity("overloaded_4").flag);
}

/// The ranges are those of talus render; without them a map with l_min = inf is never finished.
TEST(MeasuredFrame, draws_within_the_ranges_of_the_options) {
  Simulation sim(test::small_tilted_bed(10.0));
  sim.step(3);
  using pictures::MapOptions;
  constexpr double infinite = std::numeric_limits<double>::infinity(),
                   nan = std::numeric_limits<double>::quiet_NaN();
  const auto code = [&sim](const char* map, auto member, auto value) {
    MapOptions options;
    options.*member = value;
    return test::exit_code_of([&] { sim.draw(map, options); });
  };
  for (const double wrong : {infinite, -infinite, nan, -1.0, 1e300}) {
    for (const auto member :
         {&MapOptions::l_min, &MapOptions::threshold, &MapOptions::theta_c, &MapOptions::printed})
      EXPECT_EQ(code("gamma", member, wrong), ExitCode::usage) << wrong;
    EXPECT_EQ(code("coarse", &MapOptions::length, wrong), ExitCode::usage) << wrong;
    EXPECT_EQ(code("displacement", &MapOptions::since, wrong), ExitCode::usage) << wrong;
  }
  for (const int wrong : {-3, 0, 199, 16385})
    EXPECT_EQ(code("gamma", &MapOptions::width, wrong), ExitCode::usage) << wrong;
  using Numbers = std::vector<double>;
  EXPECT_EQ(code("gamma", &MapOptions::range, Numbers{0.5}), ExitCode::usage);
  EXPECT_EQ(code("gamma", &MapOptions::crop, Numbers{0.0, 1.0}), ExitCode::usage);
  EXPECT_EQ(code("gamma", &MapOptions::crop, Numbers{0.0, 0.0, 1.0, 1.0}), ExitCode::usage)
      << "no effect here";
  const BedFrame bed = sim.measured().bed();
  analysis::AnalysisParameters impossible;
  impossible.l_min = infinite;
  EXPECT_EQ(test::exit_code_of([&] { MeasuredFrame(bed.frame, bed.statics, impossible); }),
            ExitCode::bad_data);
}

}  // namespace
}  // namespace talus
