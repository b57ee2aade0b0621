/// Catalogue of a made-up run: its bursts, their values from rows and frames, and reports on missing data.

#include "runs/event_catalogue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "analysis/packing/packing.h"
#include "core/trigonometry.h"
#include "runs/analysis_parameters.h"
#include "runs/analysis_run.h"
#include "support/temporary_folder.h"

namespace talus::runs {
namespace {

constexpr double h = 1e-3, g = 9.81;
constexpr double diameter = g * 1e-4;  // m, so that sqrt(D/g) is ten steps
constexpr std::int64_t begin = 10;     // steps before the tilt
constexpr std::int64_t steps = 300;    // steps of the tilt, 0.001 deg each; a frame every 100, a row every 10
constexpr double slow = 1e-6, fast = 0.05;  // m/s

double tilt_after(std::int64_t step) { return radians(10.0 + 1e-3 * static_cast<double>(step - begin)); }

/// Returns the velocity in a step of the tilt, counted from 1. There are three bursts: 34-40 with 46-50,
/// 151-157, and one from 281 on.
double velocity_in(std::int64_t step) {
  const std::int64_t k = step - begin;
  const bool is_fast = (k >= 34 && k <= 40) || (k >= 46 && k <= 50) || (k >= 151 && k <= 157) || k >= 281;
  return is_fast ? (k == 155 ? 2.0 * fast : fast) : slow;
}

/// Returns two grains of equal mass above a floor grain; the first has moved by `moved` D downslope, and the
/// other has sunk by `sunk` D.
Frame bed_after(std::int64_t step, double moved, double sunk) {
  Frame frame;
  frame.step = step;
  frame.time = static_cast<double>(step) * h;
  frame.tilt = tilt_after(step);
  frame.x = {(1.0 + moved) * diameter, 4.0 * diameter, 2.0 * diameter};
  frame.y = {1.5 * diameter, (0.5 - sunk) * diameter, -0.5 * diameter};
  frame.angle = frame.vx = frame.vy = frame.omega = std::vector(3, 0.0);
  frame.image.assign(3, 0);
  frame.internal_moment.assign(3, {});
  frame.gamma.assign(3, not_known);
  return frame;
}

class EventCatalogue : public testing::Test {
 protected:
  analysis::Analysis analyse(double theta_c, std::vector<std::string> settings = {},
                             const std::function<void(io::Segment&)>& change = {}) {
    settings.insert(settings.begin(), "l_min=0");
    io::RunHeader header;
    header.statics = {2,
                      std::vector(3, 0.5 * diameter),
                      std::vector(3, 0.4),
                      true,
                      8.0 * diameter,
                      2.0 * diameter,
                      diameter,
                      g};
    io::Segment segment;
    segment.frames = {bed_after(begin, 0.0, 0.0), bed_after(begin + 100, 0.5, 0.0),
                      bed_after(begin + 200, 0.5, 0.25), bed_after(begin + 300, 2.0, 0.25)};
    for (std::int64_t step = 1; step <= begin + steps; ++step) {
      StepRow& row = segment.steps.emplace_back();
      at(row, StepField::step) = static_cast<double>(step);
      at(row, StepField::phase) = step > begin ? 1.0 : 0.0;
      at(row, StepField::rms_velocity) = step > begin ? velocity_in(step) : 1.0;
    }
    for (std::int64_t step = begin; step <= begin + steps; step += 10) {
      ObservableRow& row = segment.observables.emplace_back();
      at(row, Observable::step) = static_cast<double>(step);
      at(row, Observable::time) = static_cast<double>(step) * h;
      at(row, Observable::tilt) = tilt_after(step);
      at(row, Observable::volume_strain) = step < begin + 55 ? 0.0 : 0.25;
      at(row, Observable::centre_of_mass_strain) = step < begin + 155 ? 0.0 : -0.125;
      at(row, Observable::coordination_number) = step < begin + 35 ? 3.5 : 3.25;
    }
    if (change) change(segment);
    io::Checkpoint checkpoint;
    checkpoint.world.boundary = {true, header.statics.length, {}};
    for (int i = 0; i < 3; ++i)
      add_disk(checkpoint.world.grains, {i * diameter, 0.5 * diameter}, 0.5 * diameter, 1.0, i == 2);
    checkpoint.results = {{"theta_c", radians(theta_c)}};
    io::RunStore store = io::RunStore::create(path_, header, true);
    store.commit(segment, checkpoint);
    store.pack();
    return analyse_run(io::RunFile::open(path_), parse_analysis_settings(settings), 1, {});
  }

  test::TemporaryFolder folder_;
  std::string path_ = folder_.path("run.h5");
};

TEST_F(EventCatalogue, has_the_bursts_of_the_series) {
  const analysis::Analysis a = analyse(10.285);
  ASSERT_EQ(a.events.size(), 3u);
  EXPECT_NEAR(a.event_threshold, 9e-3 * g * h, 1e-12)
      << "ten times 3000 times the tolerance of 3e-7, times g h";
  EXPECT_EQ(a.event_noise, slow);
  EXPECT_NEAR(a.event_quiet_time, 10.0 * h, 1e-12);
  const double begins[] = {10.033, 10.150, 10.280}, ends[] = {10.050, 10.157, 10.300};
  const double durations[] = {0.017, 0.007, 0.020};
  for (std::size_t e = 0; e < 3; ++e) {
    EXPECT_NEAR(degrees(a.events[e].begin), begins[e], 1e-9) << e;
    EXPECT_NEAR(degrees(a.events[e].end), ends[e], 1e-9) << e;
    EXPECT_NEAR(a.events[e].time, (degrees(a.events[e].begin) - 10.0) + begin * h, 1e-9) << e;
    EXPECT_NEAR(a.events[e].duration, durations[e], 1e-12) << e;
  }
  EXPECT_TRUE(std::isnan(a.events[0].waiting));
  EXPECT_NEAR(degrees(a.events[1].waiting), 0.1, 1e-9);
  EXPECT_EQ(a.events[1].peak_velocity, 2.0 * fast);
  EXPECT_NEAR(a.events[1].path, 8.0 * fast * h, 1e-12);
  EXPECT_EQ(a.events[0].kind, 0);
  EXPECT_EQ(a.events[1].kind, 0);
  EXPECT_EQ(a.events[2].kind, 1) << "theta_c lies within it";
  EXPECT_EQ(a.event_count, 2.0);
}

TEST_F(EventCatalogue, has_what_the_rows_say_before_and_after) {
  const analysis::Analysis a = analyse(10.285);
  EXPECT_EQ(a.events[0].volume_strain, 0.0) << "it changes after the row at the end of the event";
  EXPECT_EQ(a.events[0].coordination_number, -0.25);
  EXPECT_EQ(a.events[1].volume_strain, 0.0);
  EXPECT_EQ(a.events[1].centre_of_mass_strain, -0.125);
  EXPECT_EQ(a.event_dilating_share, 0.0);
}

TEST_F(EventCatalogue, has_what_moved_between_the_frames) {
  const analysis::Analysis a = analyse(10.285);
  EXPECT_EQ(a.events[0].grains, 1);
  EXPECT_NEAR(a.events[0].centre[0], 1.0 * diameter, 1e-9);
  EXPECT_NEAR(a.events[0].centre[1], 1.5 * diameter, 1e-9);
  EXPECT_NEAR(a.events[1].centre[0], 4.0 * diameter, 1e-9);
  EXPECT_NEAR(a.events[0].depth, a.frames[0].volume / (8.0 * diameter) - 1.5 * diameter, 1e-9);
  EXPECT_NEAR(degrees(a.events[1].frame_tilt[0]), 10.1, 1e-9);
  EXPECT_NEAR(degrees(a.events[1].frame_tilt[1]), 10.2, 1e-9);
  EXPECT_EQ(a.events[1].sharing, 1);
  EXPECT_EQ(analyse(10.285, {"event_displacement=0.6"}).events[0].grains, 0);
}

TEST_F(EventCatalogue, shares_the_work_of_gravity_by_the_path) {
  const analysis::Analysis a = analyse(10.285);
  const double weight = 0.4 * g;
  // 12 of 100 steps are fast; 7 in the second interval, in which the other grain sinks.
  const double of_first = 12.0 * fast / (12.0 * fast + 88.0 * slow);
  EXPECT_NEAR(a.events[0].path, (12.0 * fast + 5.0 * slow) * h, 1e-12);
  EXPECT_NEAR(a.events[0].energy, weight * 0.5 * diameter * sine(radians(10.05)), 1e-3 * a.events[0].energy);
  EXPECT_LT(a.events[0].energy, weight * 0.5 * diameter * sine(radians(10.05)));
  EXPECT_GT(a.events[0].energy, of_first * weight * 0.5 * diameter * sine(radians(10.05)) * (1.0 - 1e-5));
  EXPECT_NEAR(a.events[1].energy, weight * 0.25 * diameter * cosine(radians(10.15)),
              1e-3 * a.events[1].energy);
  EXPECT_NEAR(a.event_energy, a.events[0].energy + a.events[1].energy, 1e-15);
  // Split by a shorter quiet time, the two parts share the frames, and the energy in the ratio 7 to 5.
  const analysis::Analysis b = analyse(10.285, {"event_quiet=0.3"});
  ASSERT_EQ(b.events.size(), 4u);
  EXPECT_EQ(b.events[0].sharing, 2);
  EXPECT_EQ(b.events[0].centre, b.events[1].centre);
  EXPECT_NEAR(b.events[0].energy / b.events[1].energy, 7.0 / 5.0, 1e-6);
}

TEST_F(EventCatalogue, goes_by_the_threshold_that_is_given) {
  EXPECT_EQ(analyse(10.285, {"event_velocity=100"}).events.size(), 0u) << "none is faster than 0.98 m/s";
  const analysis::Analysis a = analyse(10.285, {"event_velocity=6"});
  ASSERT_EQ(a.events.size(), 1u) << "one step of 0.1 m/s";
  EXPECT_NEAR(a.event_threshold, 6.0 * g * h, 1e-12);
  EXPECT_NEAR(a.events[0].duration, h, 1e-12);
}

TEST_F(EventCatalogue, of_a_slope_that_has_not_failed_ends_with_one_that_is_not_over) {
  const analysis::Analysis a = analyse(not_known);
  EXPECT_EQ(a.events[2].kind, 2);
  EXPECT_EQ(a.event_count, 2.0) << "its size is unknown";
}

TEST_F(EventCatalogue, is_empty_where_steps_or_rows_are_missing) {
  for (const auto& change :
       {std::function<void(io::Segment&)>([](io::Segment& s) { s.steps.clear(); }),
        std::function<void(io::Segment&)>([](io::Segment& s) { s.observables.clear(); }),
        std::function<void(io::Segment&)>([](io::Segment& s) { s.steps.erase(s.steps.begin() + 50); })}) {
    const analysis::Analysis a = analyse(10.285, {}, change);
    EXPECT_TRUE(a.events.empty());
    EXPECT_TRUE(std::isnan(a.event_count));
    EXPECT_TRUE(std::isnan(a.event_threshold));
  }
}

/// Returns `count` rearrangements with energies 2^k J/m, of which every third dilates.
analysis::Analysis made_up_events(int count) {
  analysis::Analysis a;
  for (int k = 0; k < count; ++k)
    a.events.push_back({.waiting = k == 0 ? not_known : 0.1 * k,
                        .energy = std::pow(2.0, k),
                        .centre_of_mass_strain = k % 3 == 0 ? 1.0 : -1.0});
  a.events.push_back({.waiting = 77.0, .kind = 1, .energy = 1e9, .centre_of_mass_strain = 1.0});
  return a;
}

TEST(EventLaws, leave_the_failure_out) {
  analysis::Analysis a = made_up_events(12);
  find_event_laws(1.0, a);
  EXPECT_EQ(a.event_count, 12.0);
  EXPECT_EQ(a.event_energy, 4095.0);
  EXPECT_NEAR(a.event_dilating_share, 4.0 / 12.0, 1e-12);
  EXPECT_NEAR(a.event_dilating_share_error, std::sqrt(2.0 / 9.0 / 12.0), 1e-12);
  EXPECT_NEAR(a.event_size_exponent, 1.0 + 12.0 / (66.0 * std::log(2.0)), 1e-12);
  EXPECT_EQ(a.event_size_count, 12.0);
  EXPECT_NEAR(a.event_waiting_mean, 0.5, 1e-12) << "of 0.1 to 1.1, minus the shortest";
  EXPECT_NEAR(a.event_waiting_mean_error, 0.5 / std::sqrt(11.0), 1e-12);
}

TEST(EventLaws, of_too_few_events_are_not_known) {
  analysis::Analysis a = made_up_events(9);
  find_event_laws(not_known, a);
  EXPECT_TRUE(std::isnan(a.event_size_exponent));
  EXPECT_EQ(a.event_size_count, 9.0);
  EXPECT_TRUE(std::isnan(a.event_waiting_mean));
  analysis::Analysis none;
  find_event_laws(not_known, none);
  EXPECT_EQ(none.event_count, 0.0);
  EXPECT_TRUE(std::isnan(none.event_dilating_share));
}

TEST_F(EventCatalogue, first_moves_are_in_the_order_of_the_frames) {
  analyse(10.285);
  const io::RunFile run = io::RunFile::open(path_);
  const std::vector<FirstMove> moves = first_moves(run, 0.2 * diameter);
  ASSERT_EQ(moves.size(), 2u);
  EXPECT_EQ(moves[0].grain, 0);
  EXPECT_EQ(moves[0].frame, 1u);
  EXPECT_NEAR(moves[0].displacement, 0.5 * diameter, 1e-9) << "not 2 D, where it ends";
  EXPECT_NEAR(degrees(moves[0].tilt), 10.1, 1e-6);
  EXPECT_NEAR(moves[0].time, 0.11, 1e-9);
  EXPECT_NEAR(moves[0].x, 1.5 * diameter, 1e-9);
  EXPECT_EQ(moves[1].grain, 1);
  EXPECT_EQ(moves[1].frame, 2u);
  EXPECT_NEAR(moves[1].displacement, 0.25 * diameter, 1e-9) << "downwards";
  const RunStatics& statics = run.header().statics;
  EXPECT_NEAR(moves[1].depth + moves[1].y, analysis::frame_volume({run.frame(2), statics}) / statics.length,
              1e-12);
  EXPECT_TRUE(first_moves(run, 2.5 * diameter).empty());
}

/// Moves a grain to `place`, D, along a bed with a period of 8 D.
void put(Frame& frame, std::size_t grain, double place) {
  frame.image[grain] = static_cast<Index>(std::floor(place / 8.0));
  frame.x[grain] = (place - 8.0 * frame.image[grain]) * diameter;
}

TEST_F(EventCatalogue, has_the_work_of_gravity_on_grains_that_go_round_the_bed_several_times) {
  const analysis::Analysis a = analyse(10.285, {}, [](io::Segment& segment) {
    for (std::size_t k = 1; k < segment.frames.size(); ++k) put(segment.frames[k], 0, 1.0 + 21.0);
  });
  EXPECT_EQ(a.events[0].grains, 1);
  const double fall = 21.0 * diameter * sine(radians(10.05));
  EXPECT_NEAR(a.events[0].energy, 0.4 * g * fall, 1e-3 * a.events[0].energy);
}

TEST_F(EventCatalogue, first_moves_go_round_a_periodic_bed_and_the_farthest_comes_first) {
  analyse(10.285, {}, [](io::Segment& segment) {
    for (std::size_t k = 0; k < segment.frames.size(); ++k) {
      put(segment.frames[k], 0, 1.0 + 2.0 * static_cast<double>(k));
      put(segment.frames[k], 1, 4.0 + 3.0 * static_cast<double>(k));
    }
  });
  const std::vector<FirstMove> moves = first_moves(io::RunFile::open(path_), 5.5 * diameter);
  ASSERT_EQ(moves.size(), 2u);
  EXPECT_EQ(moves[0].grain, 1) << "6 D in two frames";
  EXPECT_EQ(moves[0].frame, 2u);
  EXPECT_EQ(moves[1].frame, 3u);
  const std::vector<FirstMove> near = first_moves(io::RunFile::open(path_), diameter);
  ASSERT_EQ(near.size(), 2u);
  EXPECT_EQ(near[0].grain, 1) << "farther than others in the same frame";
}

TEST_F(EventCatalogue, first_moves_of_more_than_a_period_between_two_frames_are_found) {
  analyse(10.285, {}, [](io::Segment& segment) { put(segment.frames[3], 0, 1.0 + 204.0); });
  const std::vector<FirstMove> moves = first_moves(io::RunFile::open(path_), 200.0 * diameter);
  ASSERT_EQ(moves.size(), 1u);
  EXPECT_EQ(moves[0].grain, 0);
  EXPECT_NEAR(moves[0].displacement, 204.0 * diameter, 1e-6 * diameter);
}

}  // namespace
}  // namespace talus::runs
