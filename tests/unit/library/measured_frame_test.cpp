/// Frames of a live run and of its file have the same values under the same names.

#include "library/measured_frame.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/frame_quantities.h"
#include "analysis/quantities.h"
#include "core/trigonometry.h"
#include "io/analysis_file.h"
#include "io/run_file.h"
#include "library/simulation.h"
#include "runs/run_view.h"
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

TEST(MeasuredFrame, of_a_live_run_has_the_quantities_of_its_grains) {
  Simulation sim(test::small_tilted_bed(10.0));
  sim.step(3);
  for (const bool tilted : {false, true}) {
    if (tilted) sim.tilt_to(5.0);
    const auto count = static_cast<std::size_t>(sim.world().grains.count());
    for (const analysis::FrameQuantity& quantity : analysis::grain_quantities()) {
      if (quantity.name.empty()) continue;
      EXPECT_EQ(sim.grain_values(quantity.name).size(), analysis::components(quantity) * count)
          << quantity.name;
    }
    for (const analysis::FrameQuantity& quantity : analysis::contact_quantities())
      EXPECT_EQ(sim.contact_values(quantity.name).size(),
                analysis::components(quantity) * static_cast<std::size_t>(sim.frame().contacts.count()))
          << quantity.name;
  }
}

TEST(MeasuredFrame, is_judged_by_the_parameters_that_were_set) {
  Simulation sim(test::small_tilted_bed(10.0));
  sim.tilt_to(5.0);
  const double assumed = sim.quantity("overloaded/fraction");
  sim.set_analysis({"gamma_c=0.01"});
  EXPECT_GT(sim.quantity("overloaded/fraction"), assumed);
  EXPECT_EQ(sim.quantity("tilt"), sim.world().tilt);
}

}  // namespace
}  // namespace talus
