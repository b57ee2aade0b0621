/// View of a small live run.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "base/errors.h"
#include "core/trigonometry.h"
#include "io/run_file.h"
#include "support/temporary_folder.h"
#include "unit/view/opened_view.h"
#include "view/view_model.h"

namespace talus::view {
namespace {

using example::wait_for_condition, example::opened, example::plot;

/// Returns whether the run is done and its last frame is available.
bool has_ended(ViewModel& model) {
  const LiveStatus status = model.live()->status();
  return status.done && !status.running;
}

class ViewOfScenario : public testing::Test {
 protected:
  ViewOfScenario() {
    std::ofstream(folder_.path("a.toml")) << "[bed]\nlength = 10\ndepth = 3\n[deposition]\nrest_velocity = "
                                             "0.1\n[tilt]\nrate = 20\nstep = 0.02\nend_angle = 1.0\n"
                                             "[output]\nframe_every = 0.25\nobservable_every = 0.05\n";
    model_.emplace(opened(folder_.path("a.toml")));
  }
  test::TemporaryFolder folder_;
  std::optional<ViewModel> model_;
};

TEST_F(ViewOfScenario, follows_the_run) {
  EXPECT_TRUE(model_->is_live());
  EXPECT_EQ(model_->frame_count(), 0u);
  EXPECT_FALSE(model_->place_of(Landmark::first));
  EXPECT_EQ(model_->render_command(), "");
  model_->state.map.layers = pictures::map_layers("displacement+clusters");
  EXPECT_EQ(model_->first().map(2.0).discs.empty(), false);
  model_->live()->run_to(radians(0.5));
  ASSERT_TRUE(wait_for_condition(*model_, [this] { return model_->frame().tilt > radians(0.49); }));
  model_->live()->play();
  ASSERT_TRUE(wait_for_condition(*model_, [this] {
    model_->first().map(2.0);
    return has_ended(*model_) && model_->frame().tilt > radians(0.99);
  }));
  ASSERT_TRUE(
      wait_for_condition(*model_, [this] { return plot(*model_, "overloaded").series[0].x.size() >= 5; }));
  EXPECT_EQ(plot(*model_, "overloaded").series[0].x.size(), 5u) << "at 0, 0.25 ... 1 deg";
  EXPECT_NEAR(degrees(model_->frame().tilt), 1.0, 1e-9);
  EXPECT_GE(plot(*model_, "stress").series[0].x.size(), 17u);
  const std::vector<double>& tilts = plot(*model_, "stress").series[0].x;
  EXPECT_EQ(std::ranges::adjacent_find(tilts, std::greater_equal()), tilts.end()) << "each row once";
  EXPECT_FALSE(model_->theta_c_known());
  EXPECT_NE(model_->first().furnished_map().title.find("per degree"), std::string::npos);
}

TEST_F(ViewOfScenario, shows_all_of_a_bed_that_is_higher_than_its_scenario_says) {
  std::ofstream table(folder_.path("tower.csv"));
  for (int k = 0; k < 40; ++k) table << 1.0 + 2.0 * (k % 4) << ',' << 1.0 + k / 4 << ",0.5\n";
  table.close();
  std::ofstream(folder_.path("tower.toml"))
      << "[bed]\nlength = 10\ndepth = 3\n[deposition]\nmethod = 'file'\nfile = '" << folder_.path("tower.csv")
      << "'\n[tilt]\nend_angle = 1.0\n";
  ViewModel tower = opened(folder_.path("tower.toml"));
  ASSERT_EQ(tower.frame().grain_count(), 50);
  EXPECT_GE(tower.first().part(3.0).y_max, 10.5 * tower.mean_diameter());

  ViewModel falling = ViewModel::open(folder_.path("a.toml"), {"deposition.method=collapse"}, "", false, "");
  EXPECT_GT(std::ranges::max(falling.frame().y), falling.first().part(3.0).y_max)
      << "of a falling bed, only the part that it will fill is shown";
}

TEST_F(ViewOfScenario, looks_back_while_the_run_goes_on) {
  model_->go_to(0);
  EXPECT_FALSE(model_->shows_recorded_frame()) << "no frame is recorded yet";
  model_->live()->run_to(radians(0.6));
  ASSERT_TRUE(wait_for_condition(*model_, [this] { return model_->frame_count() == 3; }));
  model_->go_to(1);
  EXPECT_TRUE(model_->shows_recorded_frame());
  EXPECT_EQ(model_->frame_index(), 1u);
  EXPECT_NEAR(degrees(model_->frame().tilt), 0.25, 0.02);
  EXPECT_TRUE(model_->state.announcement.empty());
  const double shown = model_->frame().tilt;
  model_->live()->play();
  ASSERT_TRUE(
      wait_for_condition(*model_, [this] { return model_->frame_count() == 5 && has_ended(*model_); }));
  EXPECT_EQ(model_->frame().tilt, shown) << "the inspected grain stays";
  EXPECT_NE(model_->state.announcement.find("ended at 1.00°"), std::string::npos)
      << model_->state.announcement;
  EXPECT_EQ(model_->frame_tilts().size(), 5u);
  model_->follow();
  EXPECT_FALSE(model_->shows_recorded_frame());
  EXPECT_NEAR(degrees(model_->frame().tilt), 1.0, 1e-9);
  model_->go_to(Landmark::first);
  EXPECT_EQ(model_->frame_index(), 0u);
  model_->restart(5);
  EXPECT_FALSE(model_->shows_recorded_frame());
  EXPECT_EQ(model_->frame_count(), 0u);
  EXPECT_TRUE(model_->state.announcement.empty());
}

TEST_F(ViewOfScenario, tells_that_the_slope_has_failed) {
  ViewModel model = ViewModel::open(folder_.path("a.toml"),
                                    {"contact.friction=0.05", "tilt.end_angle=40", "tilt.step=0.05"}, "",
                                    false, "talus view");
  model.live()->play();
  ASSERT_TRUE(wait_for_condition(model, [&model] { return model.theta_c_known(); }));
  EXPECT_NE(model.state.announcement.find("The slope failed at "), std::string::npos);
  ASSERT_TRUE(wait_for_condition(model, [&model] {
    return std::ranges::find(model.events(), "theta_c", &TimelineEvent::name) != model.events().end();
  }));
  model.go_to(Landmark::theta_c);
  EXPECT_TRUE(model.shows_recorded_frame());
  EXPECT_LE(model.frame().tilt, model.theta_c());
}

TEST_F(ViewOfScenario, measures_displacements_from_the_frame_recorded_before) {
  model_->state.map.layers = {pictures::MapKind::displacement};
  model_->state.map.range_low = 1e-12;  // the bed is small and creeps
  model_->state.map.range_high = 1e-3;
  model_->live()->play();
  ASSERT_TRUE(wait_for_condition(*model_, [this] { return has_ended(*model_); }));
  model_->update(0.0);
  const std::vector<render::Disc> discs = model_->first().map(2.0).discs;
  EXPECT_FALSE(std::ranges::all_of(discs, [&discs](const render::Disc& disc) {
    return disc.hatched > 0.0f || disc.fill == discs[0].fill;
  })) << "the frame shown is the last recorded; it is not its own reference";
}

TEST_F(ViewOfScenario, begins_a_recorded_run_anew) {
  const std::string output = folder_.path("a.h5");
  ViewModel model = ViewModel::open(folder_.path("a.toml"), {"seed=3"}, output, false, "talus view");
  EXPECT_EQ(model.recording().seed, 3u);
  EXPECT_EQ(model.render_command(), "") << "no frame is recorded yet";
  model.live()->play();
  ASSERT_TRUE(wait_for_condition(model, [&model] { return has_ended(model); }));
  model.update(0.0);
  EXPECT_EQ(model.render_command(),
            "talus render " + output + " --map gamma --at 1 --set gamma_c=0.34202014");
  for (const char* next : {"a-2.h5", "a-3.h5"}) {
    model.restart(4);
    EXPECT_EQ(model.recording().seed, 4u);
    EXPECT_EQ(model.live()->status().step, 0);
    EXPECT_EQ(model.recording().output, folder_.path(next));
    model.live()->step(2);
    model.live()->halt();
    model.live()->save();
  }
  EXPECT_EQ(io::RunFile::open(output).header().seed, 3u) << "the previous run still exists";
}

TEST_F(ViewOfScenario, that_cannot_begin_anew_goes_on) {
  const std::string output = folder_.path("b/a.h5");
  std::filesystem::create_directory(folder_.path("b"));
  ViewModel model = ViewModel::open(folder_.path("a.toml"), {}, output, false, "talus view");
  model.live()->step(2);
  model.live()->halt();
  std::filesystem::remove_all(folder_.path("b"));
  std::ofstream(folder_.path("b")) << "no folder";
  EXPECT_THROW(model.restart(4), Error);
  ASSERT_NE(model.live(), nullptr);
  EXPECT_EQ(model.recording().output, output);
  EXPECT_EQ(model.first().map(2.0).discs.empty(), false);
}

TEST_F(ViewOfScenario, is_given_up_unsaved_only_when_asked_twice) {
  EXPECT_TRUE(model_->may_discard()) << "it has not begun";
  model_->live()->step(3);
  ASSERT_TRUE(wait_for_condition(*model_, [this] { return model_->live()->status().step == 3; }));
  EXPECT_FALSE(model_->may_discard());
  EXPECT_NE(model_->state.message.find("not saved"), std::string::npos);
  EXPECT_TRUE(model_->may_discard());
  EXPECT_FALSE(model_->may_discard()) << "asked again each time";
  model_->record(folder_.path("saved.h5"));
  EXPECT_TRUE(model_->may_discard());
  EXPECT_EQ(model_->recording().output, folder_.path("saved.h5"));
  EXPECT_THROW(model_->record(folder_.path("other.h5")), Error) << "it is already recorded";
  EXPECT_EQ(model_->recording().output, folder_.path("saved.h5"));
}

TEST_F(ViewOfScenario, offers_the_seed_of_its_run_for_the_next_one) {
  EXPECT_EQ(model_->state.seed, 1) << "the default";
  model_->restart(5);
  EXPECT_EQ(model_->state.seed, 5);
  std::ofstream(folder_.path("seeded.toml")) << "seed = 7\n[bed]\nlength = 10\ndepth = 3\n";
  EXPECT_EQ(ViewModel::open(folder_.path("seeded.toml"), {}, "", false, "").state.seed, 7);
  const ViewModel large =
      ViewModel::open(folder_.path("seeded.toml"), {"seed=9007199254740993"}, "", false, "");
  EXPECT_EQ(large.state.seed, 9007199254740993);
}

TEST_F(ViewOfScenario, begins_anew_with_another_seed) {
  const double before = model_->frame().x[0];
  model_->live()->step(3);
  model_->state.selected = 1;
  model_->restart(5);
  EXPECT_EQ(model_->recording().seed, 5u);
  EXPECT_EQ(model_->frame().step, 0);
  EXPECT_NE(model_->frame().x[0], before);
  EXPECT_FALSE(model_->state.selected.has_value());
  model_->restart(1);
  EXPECT_EQ(model_->frame().x[0], before);
}

}  // namespace
}  // namespace talus::view
