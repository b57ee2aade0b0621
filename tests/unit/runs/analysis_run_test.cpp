/// Analysis of a complete run of four grains in a hand-made column. Parameters of an analysis: accepted and
/// rejected values, and their table in the documentation.

#include "runs/analysis_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "analysis/deformation/deformation.h"
#include "analysis/quantities.h"
#include "base/errors.h"
#include "core/trigonometry.h"
#include "runs/analysis_parameters.h"
#include "scenario/text.h"
#include "support/key_rows.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace talus::runs {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double diameter = 0.25;  // m, exact in binary
constexpr Index free_grains = 4;

/// Returns the column on its floor grain. Each grain carries 1 J across the bed; the grain `soft` (-1: none)
/// also carries half as much along the bed, so that its gamma is 1/3, while that of the others is 1.
Frame column(double tilt, Index soft) {
  Frame frame;
  frame.tilt = radians(tilt);
  frame.time = tilt;
  for (Index i = 0; i <= free_grains; ++i) {
    const bool floor = i == free_grains;
    frame.x.push_back(0.5);
    frame.y.push_back(floor ? -0.5 * diameter : (i + 0.5) * diameter);
    frame.internal_moment.push_back({i == soft ? 0.5 : 0.0, 0.0, 0.0, floor ? 0.0 : 1.0});
    frame.gamma.push_back(floor ? none : i == soft ? 1.0 / 3.0 : 1.0);
  }
  frame.angle = frame.vx = frame.vy = frame.omega = std::vector(frame.x.size(), 0.0);
  frame.image.assign(frame.x.size(), 0);
  FrameContacts& c = frame.contacts;
  for (Index i = 0; i < free_grains;
       ++i) {  // contacts with the floor, then of each grain with the one above it
    c.a.push_back(i == 0 ? 0 : i - 1);
    c.b.push_back(i == 0 ? free_grains : i);
    c.shift.push_back(0);
    c.nx.push_back(0.0);
    c.ny.push_back(i == 0 ? -1.0 : 1.0);
    c.px.push_back(0.5);
    c.py.push_back(i * diameter);
    c.fn.push_back(free_grains - i);
    c.ft.push_back(0.0);
    c.status.push_back(ContactStatus::sticking);
  }
  return frame;
}

/// Returns the tilt at a time (s), deg: 1 deg/s with a hold of 1 s at `held`.
double tilt_at(double time, double held) { return time <= held ? time : std::max(held, time - 1.0); }

/// Writes a frame per second, one for each entry of `soft`, and a row of observables every 0.5 s.
void write_run(const std::string& path, const std::vector<Index>& soft, double theta_c, bool complete = true,
               double held = 90.0) {
  io::RunHeader header;
  header.statics.free_count = free_grains;
  header.statics.radius.assign(free_grains + 1, 0.5 * diameter);
  header.statics.mass.assign(free_grains + 1, 1.0);
  header.statics.periodic = true;
  header.statics.length = 8.0 * diameter;
  header.statics.depth = 4.0 * diameter;
  header.statics.mean_diameter = diameter;
  header.statics.gravity = 9.81;
  header.friction = header.deposition_friction = {0.5, 0.5};
  io::Segment segment;
  for (std::size_t k = 0; k < soft.size(); ++k)
    segment.frames.push_back(column(static_cast<double>(k), soft[k]));
  for (Frame& frame : segment.frames) frame.tilt = radians(tilt_at(frame.time, held));
  for (int i = 0; i <= 20; ++i) {
    ObservableRow row{};
    at(row, Observable::tilt) = radians(tilt_at(0.5 * i, held));
    at(row, Observable::time) = 0.5 * i;
    at(row, Observable::volume_strain) = std::fabs(i - 8.0);
    at(row, Observable::solid_fraction) = 0.1 * i;
    segment.observables.push_back(row);
  }
  io::Checkpoint checkpoint;
  checkpoint.world.tilt = radians(static_cast<double>(soft.size()));
  checkpoint.world.boundary = {true, header.statics.length, {}};
  for (Index i = 0; i <= free_grains; ++i)
    add_disk(checkpoint.world.grains, {0.5, i * diameter}, 0.5 * diameter, 1.0, i == free_grains);
  checkpoint.results = {{"theta_c", radians(theta_c)}};
  io::RunStore store = io::RunStore::create(path, header, true);
  store.commit(segment, checkpoint);
  if (complete) store.pack();
}

class AnalysisRun : public testing::Test {
 protected:
  /// Analyses the gamma of single grains, unless the settings specify another l_min.
  analysis::Analysis analyse(const std::vector<Index>& soft, double theta_c,
                             std::vector<std::string> settings = {}, int threads = 1) const {
    write_run(path_, soft, theta_c);
    if (std::ranges::none_of(settings, [](const auto& setting) { return setting.starts_with("l_min="); }))
      settings.emplace_back("l_min=0");
    return analyse_run(io::RunFile::open(path_), parse_analysis_settings(settings), threads, {});
  }

  test::TemporaryFolder folder_;
  std::string path_ = folder_.path("run.h5");
};

double number(const analysis::Analysis& analysis, const analysis::QuantityMember& member, std::size_t k,
              std::size_t f = 0) {
  return analysis::number_of(analysis::quantity_of(member), analysis.frames.at(k), f);
}

TEST_F(AnalysisRun, counts_overloaded_grains_at_each_threshold) {
  const analysis::Analysis a = analyse({-1, 1}, 30.0, {"threshold_factors=0.5,1"});
  EXPECT_NEAR(a.gamma_c, 0.5, 1e-12);
  EXPECT_EQ(number(a, &analysis::FrameThreshold::overloaded_fraction, 0, 0), 1.0);
  EXPECT_EQ(number(a, &analysis::FrameThreshold::overloaded_fraction, 1, 0), 1.0) << "1/3 >= 0.25";
  EXPECT_EQ(number(a, &analysis::FrameThreshold::overloaded_fraction, 1, 1), 0.75) << "1/3 < 0.5";
}

TEST_F(AnalysisRun, averages_moments_over_the_frames_around) {
  // Grain 1 has M_xx = 0.5 only in the frame at 1 deg: 1/4 averaged over two frames, 1/6 over three.
  const analysis::Analysis a = analyse({-1, 1, -1, -1}, 30.0, {"threshold_factors=1,1.3", "averaging=2"});
  EXPECT_EQ(number(a, &analysis::FrameThreshold::overloaded_fraction, 0, 0), 1.0) << "0.6 >= 0.5";
  EXPECT_EQ(number(a, &analysis::FrameThreshold::overloaded_fraction, 0, 1), 0.75) << "0.6 < 0.65";
  EXPECT_EQ(number(a, &analysis::FrameThreshold::overloaded_fraction, 1, 1), 1.0) << "5/7 >= 0.65";
  EXPECT_EQ(number(a, &analysis::FrameThreshold::overloaded_fraction, 3, 0), 1.0);
  EXPECT_NEAR(number(a, &analysis::FrameRecord::gamma_mean, 1), (3.0 + 5.0 / 7.0) / 4.0, 1e-12);
  EXPECT_NEAR(number(a, &analysis::FrameRecord::gamma_mean, 3), 1.0, 1e-12)
      << "1 deg is farther than half the window";
  EXPECT_EQ(number(analyse({-1, 1, -1}, 30.0, {"averaging=1.9"}),
                   &analysis::FrameThreshold::overloaded_fraction, 1),
            0.75)
      << "a window that contains no other frame";
}

TEST_F(AnalysisRun, leaves_grains_with_few_contacts_out) {
  // The highest grain has one contact, the others have two.
  const analysis::Analysis a = analyse({-1, 1}, 30.0, {"min_contacts=2"});
  EXPECT_EQ(number(a, &analysis::FrameThreshold::overloaded_fraction, 0), 1.0);
  EXPECT_EQ(number(a, &analysis::FrameThreshold::overloaded_fraction_of_all, 0), 0.75);
  EXPECT_EQ(number(a, &analysis::FrameThreshold::overloaded_fraction, 1), 2.0 / 3.0);
  EXPECT_EQ(number(a, &analysis::FrameThreshold::largest_cluster, 0), 3);
  EXPECT_EQ(number(a, &analysis::FrameThreshold::spans_depth, 0), 0) << "the highest grain forms the surface";
  EXPECT_EQ(number(a, &analysis::FrameRecord::stress_ratio, 0), 1.0) << "its moment counts";
  EXPECT_EQ(number(analyse({-1, 1}, 30.0, {"min_contacts=3"}),
                   &analysis::FrameThreshold::overloaded_fraction_of_all, 0),
            0.0);
}

TEST_F(AnalysisRun, finds_clusters_and_labels_grains) {
  const analysis::Analysis a = analyse({-1, 1}, 30.0);
  EXPECT_EQ(number(a, &analysis::FrameThreshold::spans_depth, 0), 1);
  EXPECT_EQ(number(a, &analysis::FrameThreshold::spans_depth, 1), 0);
  EXPECT_EQ(number(a, &analysis::FrameThreshold::spans_length, 0), 0);
  EXPECT_EQ(number(a, &analysis::FrameThreshold::largest_cluster, 0), 4);
  EXPECT_EQ(number(a, &analysis::FrameThreshold::cluster_count, 1), 2);
  EXPECT_DOUBLE_EQ(number(a, &analysis::FrameThreshold::mean_cluster, 1), 1.5);
  EXPECT_DOUBLE_EQ(number(a, &analysis::FrameThreshold::second_moment, 1), 5.0 / 3.0);
  EXPECT_EQ(a.frames[1].thresholds[0].cluster, (std::vector<Index>{1, -1, 0, 0, -1}));
}

TEST_F(AnalysisRun, coarse_grains_up_to_the_cut) {
  // Around grain 0: its own moment is (0, 1), gamma 1; with grain 1 (0.5, 2), 3/5; with grain 2 (0.5, 3),
  // 5/7.
  const analysis::Analysis a = analyse({-1, 1}, 30.0, {"threshold_factors=0.5,1.3", "lc_cut=3"});
  EXPECT_DOUBLE_EQ(a.lc_cut, 3 * diameter);
  EXPECT_DOUBLE_EQ(number(a, &analysis::FrameThreshold::lc_mean, 0, 1), 3 * diameter)
      << "gamma is 1 everywhere";
  EXPECT_DOUBLE_EQ(number(a, &analysis::FrameThreshold::lc_share_cut, 0, 1), 1.0);
  const std::vector<float>& lengths = a.frames[1].thresholds[0].lc;
  EXPECT_FLOAT_EQ(lengths[0], 3 * diameter) << "0.6 > 0.25";
  EXPECT_FLOAT_EQ(lengths[1], 3 * diameter) << "1/3 > 0.25: overloaded at the first threshold";
  const std::vector<float>& second = a.frames[1].thresholds[1].lc;
  EXPECT_FLOAT_EQ(second[0], 2 * diameter) << "0.6 <= 0.65";
  EXPECT_TRUE(std::isnan(second[1])) << "not overloaded";
  EXPECT_TRUE(std::isnan(second[4])) << "floor";
}

TEST_F(AnalysisRun, ends_the_search_where_it_is_told_to) {
  // Among the grains above 1.3 Gamma_c = 0.65, grain 0 has gamma 1, 3/5, 5/7 with its neighbours.
  const analysis::Analysis a =
      analyse({-1, 1}, 30.0, {"threshold_factors=0.5,1.3", "lc_factor=1.1", "lc_cut=3"});
  EXPECT_NEAR(a.thresholds[1].end_ratio, 0.55, 1e-12);
  const std::vector<float>& second = a.frames[1].thresholds[1].lc;
  EXPECT_FLOAT_EQ(second[0], 3 * diameter) << "0.6 > 0.55";
  EXPECT_TRUE(std::isnan(second[1])) << "1/3 < 0.65: not overloaded";
  const std::vector<float>& first = a.frames[1].thresholds[0].lc;
  EXPECT_FLOAT_EQ(first[1], 0.0) << "1/3 >= 0.25, and below 0.55 by itself";
}

TEST_F(AnalysisRun, takes_each_grain_with_its_first_neighbours) {
  // The moments of grains 0 to 3, each summed with those above and below it, give gamma 3/5, 5/7, 5/7, 1.
  const analysis::Analysis a =
      analyse({-1, 1}, 30.0, {"l_min=3", "threshold_factors=1.3", "lc_factor=1.45", "lc_cut=3.5"});
  EXPECT_EQ(number(a, &analysis::FrameThreshold::overloaded_fraction, 1), 0.75);
  EXPECT_DOUBLE_EQ(number(a, &analysis::FrameRecord::gamma_mean, 1), (0.6 + 10.0 / 7.0 + 1.0) / 4.0);
  EXPECT_EQ(number(a, &analysis::FrameThreshold::largest_cluster, 1), 3);
  const std::vector<float>& length = a.frames[1].thresholds[0].lc;
  EXPECT_TRUE(std::isnan(length[0])) << "0.6 < 0.65: not overloaded";
  EXPECT_FLOAT_EQ(length[1], 3 * diameter) << "5/7 <= 0.725 at the beginning of the search";
  EXPECT_FLOAT_EQ(length[3], 3.5 * diameter) << "1 > 0.725 up to the cut-off";
}

TEST_F(AnalysisRun, takes_first_neighbours_unless_it_is_told_otherwise) {
  write_run(path_, {-1, 1}, 30.0);
  const io::RunFile run = io::RunFile::open(path_);
  EXPECT_DOUBLE_EQ(number(analyse_run(run, {}, 1, {}), &analysis::FrameRecord::gamma_mean, 1),
                   (0.6 + 10.0 / 7.0 + 1.0) / 4.0);
}

TEST_F(AnalysisRun, search_does_not_end_before_it_begins) {
  const analysis::Analysis a = analyse({-1, 1}, 30.0, {"l_min=3", "lc_cut=2"});
  EXPECT_DOUBLE_EQ(a.lc_cut, 3 * diameter);
}

TEST(AnalysisOfAStoredRun, deformation_is_that_since_the_frame_before) {
  const io::RunFile run = io::RunFile::open(test::source_folder() + "/tests/runs/schema_4.h5");
  for (const int threads : {1, 3}) {
    const analysis::Analysis a = analyse_run(run, {}, threads, {});
    EXPECT_TRUE(std::isnan(a.frames[0].nonaffine)) << "there is no frame before it";
    for (std::size_t k = 1; k < a.frames.size(); ++k) {
      const Frame before = run.frame(k - 1), now = run.frame(k);
      analysis::FrameRecord expected;
      analysis::measure_deformation(before, {now, run.header().statics}, expected);
      EXPECT_GT(a.frames[k].nonaffine, 0.0);
      EXPECT_EQ(a.frames[k].nonaffine, expected.nonaffine) << k;
      EXPECT_EQ(a.frames[k].local_shear_share, expected.local_shear_share) << k;
    }
  }
}

TEST_F(AnalysisRun, takes_from_the_observables_what_they_have) {
  const analysis::Analysis a = analyse({-1, 1, -1}, 30.0);
  EXPECT_EQ(number(a, &analysis::FrameRecord::volume_strain, 2), 4.0) << "from the row at 2 deg";
  EXPECT_DOUBLE_EQ(number(a, &analysis::FrameRecord::solid_fraction, 1), 0.2);
  EXPECT_NEAR(a.dilation[0], radians(4.0), 1e-12);
  EXPECT_TRUE(std::isnan(a.dilation[1])) << "that strain is constant";
}

TEST_F(AnalysisRun, finds_the_percolation_angle_and_its_error) {
  const analysis::Analysis a = analyse({1, 1, -1, -1, -1}, 30.0);
  EXPECT_NEAR(a.thresholds[0].percolation, radians(2.0), 1e-12);
  EXPECT_NEAR(a.thresholds[0].percolation_error, radians(1.0), 1e-12);
}

TEST_F(AnalysisRun, finds_the_jump_of_the_largest_length) {
  // With a soft grain 1 the moments around grain 3 give gamma 5/7 once the second neighbour is included.
  const analysis::Analysis a = analyse({1, 1, -1, -1}, 30.0, {"threshold_factors=1.6", "lc_cut=6"});
  EXPECT_DOUBLE_EQ(number(a, &analysis::FrameThreshold::lc_max, 1), 4 * diameter);
  EXPECT_NEAR(a.thresholds[0].lc_jump, radians(2.0), 1e-12);
  EXPECT_NEAR(a.thresholds[0].lc_jump_error, radians(1.0), 1e-12);
  EXPECT_DOUBLE_EQ(a.thresholds[0].lc_jump_size, 2 * diameter);
}

TEST_F(AnalysisRun, leaves_out_thresholds_where_the_slope_stands) {
  const analysis::Analysis a = analyse({-1, 1}, none);
  EXPECT_TRUE(a.thresholds.empty());
  EXPECT_TRUE(a.frames[0].thresholds.empty());
  EXPECT_EQ(number(a, &analysis::FrameRecord::coordination_number, 0), 7.0 / 4.0);
  EXPECT_TRUE(std::isnan(a.gamma_c));
  EXPECT_EQ(
      number(analyse({-1, 1}, none, {"gamma_c=0.5"}), &analysis::FrameThreshold::overloaded_fraction, 1),
      0.75);
}

TEST_F(AnalysisRun, is_the_same_on_any_number_of_threads) {
  std::vector<Index> soft;
  for (Index k = 0; k < 12; ++k) soft.push_back(k % 5 - 1);
  const std::vector<std::string> long_work = {"bins=1000",
                                              "sections=1000"};  // long enough for threads to overlap
  const analysis::Analysis one = analyse(soft, 30.0, long_work), three = analyse(soft, 30.0, long_work, 3);
  for (const analysis::Quantity& quantity : analysis::quantities()) {
    const analysis::Values other = analysis::values_of(quantity, three);
    std::visit(
        [&]<typename T>(const std::vector<T>& numbers) {
          const auto& others = std::get<std::vector<T>>(other);
          EXPECT_TRUE(std::ranges::equal(std::as_bytes(std::span(numbers)), std::as_bytes(std::span(others))))
              << quantity.name;
        },
        analysis::values_of(quantity, one));
  }
}

TEST_F(AnalysisRun, tells_its_progress) {
  write_run(path_, {-1, 1, 2}, 30.0);
  std::vector<std::size_t> done;
  analyse_run(io::RunFile::open(path_), {}, 2, [&](std::size_t frames) { done.push_back(frames); });
  EXPECT_EQ(done, (std::vector<std::size_t>{1, 2, 3}));
}

TEST_F(AnalysisRun, key_depends_on_run_and_parameters) {
  write_run(path_, {-1}, 30.0);
  const io::RunFile run = io::RunFile::open(path_);
  const std::string key = analysis_key(run, {});
  EXPECT_EQ(analysis_key(run, {}), key);
  for (const char* setting : {"threshold_factors=1", "gamma_c=0.5", "lc_factor=2", "lc_cut=3", "l_min=0",
                              "joining=neighbours", "averaging=2", "min_contacts=2", "sections=3", "bins=7"})
    EXPECT_NE(analysis_key(run, parse_analysis_settings({setting})), key) << setting;
  write_run(folder_.path("other.h5"), {-1, -1}, 30.0);
  EXPECT_NE(analysis_key(io::RunFile::open(folder_.path("other.h5")), {}), key);
}

TEST_F(AnalysisRun, of_a_folder_is_that_of_its_file) {
  const analysis::Analysis packed = analyse({-1, 1}, 30.0);
  write_run(folder_.path("part.h5"), {-1, 1}, 30.0, false);
  const io::RunFile run = io::RunFile::open(folder_.path("part.h5"));
  EXPECT_FALSE(run.complete());
  const analysis::Quantity& lc_max = analysis::quantity_of(&analysis::FrameThreshold::lc_max);
  EXPECT_EQ(analysis::values_of(lc_max, analyse_run(run, parse_analysis_settings({"l_min=0"}), 1, {})),
            analysis::values_of(lc_max, packed));
}

TEST_F(AnalysisRun, without_frames_is_refused) {
  write_run(path_, {}, none);
  EXPECT_THROW(analyse_run(io::RunFile::open(path_), {}, 1, {}), Error);
}

TEST_F(AnalysisRun, takes_of_a_hold_the_strains_of_each_frame) {
  write_run(path_, {-1, 1, 1, 1, 1}, 30.0, true, 2.0);
  const analysis::Analysis a =
      analyse_run(io::RunFile::open(path_), parse_analysis_settings({"l_min=0"}), 1, {});
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_EQ(number(a, &analysis::FrameRecord::volume_strain, k),
              std::fabs(2.0 * static_cast<double>(k) - 8.0))
        << k;
}

std::string refusal(const std::vector<std::string>& settings) {
  try {
    parse_analysis_settings(settings);
  } catch (const LocatedError& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    return error.what();
  }
  return "accepted";
}

TEST(AnalysisParameters, are_taken_from_settings) {
  const analysis::AnalysisParameters p = parse_analysis_settings(
      {"threshold_factors=0.5,1,3", "gamma_c=0.3", "l_min=0", "lc_factor=2", "lc_cut=30",
       "joining=neighbours", "averaging=0.5", "min_contacts=3", "sections=7", "bins=10",
       "event_velocity=0.02", "event_quiet=2", "event_displacement=0.05", "event_size_min=0.1"});
  EXPECT_EQ(p.threshold_factors, (std::vector{0.5, 1.0, 3.0}));
  EXPECT_EQ(p.gamma_c, 0.3);
  EXPECT_EQ(p.l_min, 0.0);
  EXPECT_EQ(p.lc_factor, 2.0);
  EXPECT_EQ(p.lc_cut, 30.0);
  EXPECT_EQ(p.joining, analysis::Joining::neighbours);
  EXPECT_EQ(p.averaging, 0.5);
  EXPECT_EQ(p.min_contacts, 3);
  EXPECT_EQ(p.sections, 7);
  EXPECT_EQ(p.bins, 10);
  EXPECT_EQ(p.event_velocity, 0.02);
  EXPECT_EQ(p.event_quiet, 2.0);
  EXPECT_EQ(p.event_displacement, 0.05);
  EXPECT_EQ(p.event_size_min, 0.1);
  EXPECT_EQ(as_facts(p), (Facts{{"threshold_factors", "0.5,1,3"},
                                {"gamma_c", "0.3"},
                                {"l_min", "0"},
                                {"lc_factor", "2"},
                                {"lc_cut", "30"},
                                {"joining", "neighbours"},
                                {"averaging", "0.5"},
                                {"min_contacts", "3"},
                                {"sections", "7"},
                                {"bins", "10"},
                                {"event_velocity", "0.02"},
                                {"event_quiet", "2"},
                                {"event_displacement", "0.05"},
                                {"event_size_min", "0.1"}}));
}

TEST(AnalysisParameters, admit_their_defaults_as_text) {
  EXPECT_EQ(as_facts(from_facts(as_facts(analysis::AnalysisParameters{}))),
            as_facts(analysis::AnalysisParameters{}));
  EXPECT_FALSE(parse_analysis_settings({"gamma_c=run"}).gamma_c.has_value());
  EXPECT_FALSE(parse_analysis_settings({"event_velocity=solver"}).event_velocity.has_value());
  EXPECT_FALSE(parse_analysis_settings({"event_size_min=fit"}).event_size_min.has_value());
  EXPECT_EQ(parse_analysis_settings({"threshold_factors=[1, 2.5]"}).threshold_factors,
            (std::vector{1.0, 2.5}));
}

TEST(AnalysisParameters, out_of_range_are_refused) {
  const std::pair<std::string, std::vector<std::string>> wrong[] = {
      {"threshold_factors", {"", "2,1", "1,1", "1,,2", "1,2,3,4,5", "0"}},
      {"gamma_c", {"0", "1.5", "nan", "sin"}},
      {"l_min", {"-1", "101", ""}},
      {"lc_cut", {"-3", "30m", "inf"}},
      {"joining", {"contact"}},
      {"averaging", {"-1", "11"}},
      {"min_contacts", {"0"}},
      {"sections", {"0", "2.5"}},
      {"bins", {"1001", ""}},
      {"event_velocity", {"0", "tolerance"}},
      {"event_quiet", {"-1"}},
      {"event_displacement", {"-0.1"}},
      {"event_size_min", {"0"}}};
  for (const auto& [key, values] : wrong)
    for (const std::string& value : values) {
      const std::string setting = key + "=" + value, message = refusal({setting});
      EXPECT_NE(message.find("--set " + setting + ": error: key '"), std::string::npos) << message;
    }
}

TEST(AnalysisParameters, are_refused_all_at_once_and_say_what_was_expected) {
  EXPECT_EQ(
      refusal({"lc_cut=-3", "colour=red", "bins", "gamma_c=0.3", "gamma_c=run"}),
      "--set lc_cut=-3: error: key 'lc_cut' = -3: expected a number in (0, 10000] or \"depth\", in D\n"
      "--set colour=red: error: unknown key 'colour'; expected threshold_factors, gamma_c, l_min, "
      "lc_factor, lc_cut, joining, averaging, min_contacts, sections, bins, event_velocity, event_quiet, "
      "event_displacement, event_size_min\n"
      "--set bins: error: key 'bins' has no value: expected key=value, such as --set lc_cut=30\n"
      "--set gamma_c=run: error: key 'gamma_c' is set twice on the command line; expected it once");
  EXPECT_EQ(refusal({"threshold_factors=2,1"}),
            "--set threshold_factors=2,1: error: key 'threshold_factors': expected 1 ... 4 ascending numbers "
            "in (0, 10], with commas between, in Gamma_c");
  EXPECT_EQ(refusal({"sections=2.5"}),
            "--set sections=2.5: error: key 'sections' = 2.5: expected an integer in 1 ... 1000, found a "
            "float");
}

TEST(AnalysisParameters, that_are_mistyped_are_recognised) {
  EXPECT_NE(refusal({"gama_c=0.3"}).find("; did you mean 'gamma_c'?"), std::string::npos);
}

TEST(AnalysisParameters, are_documented_as_they_are) {
  std::string expected;
  for (const AnalysisKey& key : analysis_keys())
    expected += row_text(key, scenario::plain_text(key.get(analysis::AnalysisParameters{})));
  EXPECT_EQ(rows_of("docs/analysis.md"), expected) << "the table of docs/analysis.md must be:\n" << expected;
}

}  // namespace
}  // namespace talus::runs
