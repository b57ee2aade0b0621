/// Results computed frame by frame in the background, with the hand-made bed, theta_c = 20 deg.

#include "view/frame_series.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "core/trigonometry.h"
#include "pictures/overload_rule.h"
#include "unit/view/example_bed.h"
#include "view/timeline.h"

namespace talus::view {
namespace {

const pictures::OverloadRule rule{
    .theta_c = radians(20.0), .threshold_factor = 1.0, .joined_by_neighbours = false, .l_min = 0.0};

std::shared_ptr<const Frame> read_bed(std::size_t k) {
  return std::make_shared<const Frame>(
      example::bed_frame(5.0 * static_cast<double>(k), example::overloaded_of_frames.at(k)));
}

/// Collects results until `frames` frames have been processed, and returns what is known of them.
pictures::SeenFrames wait_for(FrameSeries& series, std::size_t frames) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  pictures::PictureSeries pictures;
  while (pictures.seen_frames.instants.size() < frames && series.error().empty() &&
         std::chrono::steady_clock::now() < end) {
    series.collect_ready(pictures);
    std::this_thread::yield();
  }
  return pictures.seen_frames;
}

TEST(FrameSeries, has_the_values_of_each_frame) {
  FrameSeries series(example::bed_statics(), read_bed);
  series.set_counts(6, 6);
  pictures::PictureSeries pictures;
  EXPECT_FALSE(series.collect_ready(pictures)) << "nothing was begun";
  series.begin(rule, {});
  EXPECT_FALSE(series.has_all_values());
  wait_for(series, 6);
  ASSERT_EQ(series.values().size(), 6u);
  EXPECT_TRUE(series.has_all_values());
  for (std::size_t k = 0; k < 6; ++k) {
    const analysis::FrameRecord& values = series.values()[k];
    EXPECT_NEAR(values.tilt, radians(5.0 * static_cast<double>(k)), 1e-12);
    EXPECT_NEAR(values.thresholds[0].overloaded_fraction, example::overloaded_of_frames[k] / 40.0, 1e-12);
    EXPECT_EQ(values.thresholds[0].spans_depth, k >= 3 ? 1 : 0) << k;
  }
  EXPECT_TRUE(std::isnan(series.values()[0].thresholds[0].largest_share));
  EXPECT_TRUE(std::isnan(series.values()[0].thresholds[0].lc_max));
  EXPECT_EQ(series.values()[2].thresholds[0].largest_share, 1.0);
  // One overloaded grain with its three neighbours has Q/P = 1/7, below sin 20 deg; from the middle of a
  // column of four, the neighbourhood must reach the diagonal neighbours.
  EXPECT_NEAR(series.values()[1].thresholds[0].lc_max, 2.0, 1e-12);
  EXPECT_NEAR(series.values()[3].thresholds[0].lc_max, std::sqrt(8.0), 1e-12);
  EXPECT_NEAR(series.values()[3].thresholds[0].lc_mean, 1.0 + std::sqrt(2.0), 1e-12);
  EXPECT_EQ(series.extent().y_min, -1.0);
  EXPECT_EQ(series.extent().y_max, 4.0);
}

TEST(FrameSeries, has_values_of_the_tilt_and_colours_of_all_frames) {
  FrameSeries series(example::bed_statics(), read_bed);
  series.set_counts(6, 4);
  series.begin(rule, {});
  const pictures::SeenFrames seen_frames = wait_for(series, 6);
  EXPECT_EQ(series.values().size(), 4u);
  ASSERT_EQ(seen_frames.cluster_colours.size(), 6u);
  EXPECT_TRUE(seen_frames.cluster_colours[0].empty());
  ASSERT_EQ(seen_frames.cluster_colours[5].size(), 1u);
  EXPECT_EQ(seen_frames.cluster_colours[5][0].track, seen_frames.cluster_colours[1][0].track)
      << "the same cluster, grown";
}

TEST(FrameSeries, does_not_work_out_what_is_known) {
  FrameSeries series(example::bed_statics(), read_bed);
  series.set_counts(6, 6);
  series.begin(rule, std::vector(6, analysis::FrameRecord{.tilt = 1.0,
                                                          .thresholds = {{.overloaded_fraction = 0.125}}}));
  EXPECT_TRUE(series.has_all_values());
  EXPECT_EQ(wait_for(series, 6).cluster_colours.size(), 6u);
  ASSERT_EQ(series.values().size(), 6u);
  EXPECT_EQ(series.values()[5].thresholds[0].overloaded_fraction, 0.125);
}

TEST(FrameSeries, begins_anew_with_another_rule) {
  FrameSeries series(example::bed_statics(), read_bed);
  series.set_counts(6, 6);
  series.begin(rule, {});
  wait_for(series, 3);
  pictures::OverloadRule other = rule;
  other.threshold_factor = 4.0;  // above 1, so that nothing is overloaded
  series.begin(other, {});
  EXPECT_TRUE(series.values().empty());
  const pictures::SeenFrames seen_frames = wait_for(series, 6);
  ASSERT_EQ(series.values().size(), 6u);
  EXPECT_EQ(series.values()[5].thresholds[0].overloaded_fraction, 0.0);
  EXPECT_EQ(series.rule(), other);
  EXPECT_EQ(seen_frames.rule, other);
  ASSERT_EQ(seen_frames.cluster_colours.size(), 6u);
  EXPECT_TRUE(seen_frames.cluster_colours[5].empty());
}

TEST(FrameSeries, takes_grains_with_their_neighbours) {
  FrameSeries series(example::bed_statics(), read_bed);
  series.set_counts(6, 6);
  pictures::OverloadRule with_neighbours = rule;
  with_neighbours.l_min = 3.0;
  series.begin(with_neighbours, {});
  wait_for(series, 6);
  // In a neighbourhood of 6 or 9 grains, each with P = 2 or, if overloaded, 1, only the overloaded grains
  // contribute to Q. With four of them, the neighbourhoods of the lowest and the highest contain 2 of 6 (Q/P
  // = 2/10), below sin 20 deg; those between contain 3 of 9.
  ASSERT_EQ(series.values().size(), 6u);
  EXPECT_EQ(series.values()[3].thresholds[0].overloaded_fraction, 0.0);
  with_neighbours.threshold_factor = 0.18 / sine(radians(20.0));
  series.begin(with_neighbours, {});
  wait_for(series, 6);
  EXPECT_NEAR(series.values()[3].thresholds[0].overloaded_fraction, 12.0 / 40.0, 1e-12)
      << "the column and its neighbours";
  EXPECT_GE(series.values()[3].thresholds[0].lc_mean, 3.0);
}

TEST(FrameSeries, goes_on_with_frames_that_come_later) {
  FrameSeries series(example::bed_statics(), read_bed);
  series.begin(rule, {});
  series.set_counts(2, 2);
  wait_for(series, 2);
  EXPECT_EQ(series.values().size(), 2u);
  series.set_counts(4, 4);
  EXPECT_FALSE(series.has_all_values());
  wait_for(series, 4);
  EXPECT_EQ(series.values().size(), 4u);
}

TEST(FrameSeries, has_a_tracker_that_has_met_its_frames) {
  // The cluster of the first frame has disappeared in the second; the third frame has a different cluster.
  FrameSeries series(example::bed_statics(), [](std::size_t k) {
    return std::make_shared<const Frame>(example::bed_frame(static_cast<double>(k), k == 1 ? 0 : 2));
  });
  series.set_counts(3, 3);
  series.begin(rule, {});
  pictures::ClusterColours tracker = wait_for(series, 3).tracker;
  const RunStatics statics = example::bed_statics();
  const Frame frame = example::bed_frame(3.0, 2);
  const auto next = tracker.next(pictures::overloaded_clusters({frame, statics}, {.theta_c = rule.theta_c}));
  EXPECT_EQ(next.at(0).track, 1);
}

TEST(FrameSeries, leaves_out_what_was_begun_by_another_rule) {
  std::atomic<bool> reading = false, may_read = false;
  FrameSeries series(example::bed_statics(), [&](std::size_t) {
    reading = true;
    while (!may_read) std::this_thread::yield();
    return read_bed(5);
  });
  series.set_counts(2, 2);
  series.begin(rule, {});
  while (!reading) std::this_thread::yield();
  pictures::OverloadRule other = rule;
  other.threshold_factor = 4.0;
  series.begin(other, {});
  may_read = true;
  wait_for(series, 2);
  ASSERT_EQ(series.values().size(), 2u);
  EXPECT_EQ(series.values()[0].thresholds[0].overloaded_fraction, 0.0);
}

TEST(FrameSeries, says_why_a_frame_cannot_be_read) {
  FrameSeries series(example::bed_statics(), [](std::size_t k) {
    if (k == 2) throw std::runtime_error("frame 2 is damaged");
    return read_bed(k);
  });
  series.set_counts(6, 6);
  series.begin(rule, {});
  wait_for(series, 6);
  EXPECT_EQ(series.error(), "frame 2 is damaged");
  pictures::PictureSeries pictures;
  while (series.collect_ready(pictures)) {
  }
  EXPECT_EQ(series.values().size(), 2u);
}

TEST(FrameSeries, ends_while_it_works) {
  std::atomic<int> reads = 0;
  {
    FrameSeries series(example::bed_statics(), [&reads](std::size_t k) {
      ++reads;
      return read_bed(k % 6);
    });
    series.set_counts(1000000, 0);
    series.begin(rule, {});
    while (reads == 0) std::this_thread::yield();
  }
  const int after = reads;
  EXPECT_LT(after, 1000000);
}

/// Returns the frame of a landmark of the bed, for which some rows and values are known.
std::optional<std::size_t> frame_of(Landmark landmark, const std::vector<double>& tilts,
                                    std::span<const ObservableRow> rows,
                                    std::span<const analysis::FrameRecord> values, double theta_c) {
  TimelineSource source;
  source.tilts = tilts;
  source.times = std::vector<double>(tilts.size(), 0.0);
  source.rows = rows;
  source.values = values;
  source.theta_c = theta_c;
  source.cut = 4.0;
  const std::vector<TimelineEvent> events = timeline_events(source);
  const auto event = std::ranges::find(events, event_name(landmark), &TimelineEvent::name);
  return event == events.end() ? std::nullopt : std::optional(event->frame);
}

TEST(Landmarks, are_the_frames_where_values_change) {
  FrameSeries series(example::bed_statics(), read_bed);
  series.set_counts(6, 6);
  series.begin(rule, {});
  wait_for(series, 6);
  std::vector<double> tilts;
  for (const analysis::FrameRecord& frame : series.values()) tilts.push_back(frame.tilt);
  const auto frame = [&](Landmark landmark, std::size_t known, double theta_c) {
    return frame_of(landmark, tilts, {}, std::span(series.values()).first(known), theta_c);
  };
  EXPECT_EQ(frame(Landmark::percolation, 6, radians(20.0)), 3u);
  EXPECT_EQ(frame(Landmark::length_jump, 6, radians(20.0)), 3u);
  EXPECT_FALSE(frame(Landmark::length_jump, 6, radians(12.0)).has_value()) << "up to 12 deg nothing jumps";
  EXPECT_FALSE(frame(Landmark::length_jump, 5, radians(20.0)).has_value()) << "not all values are known";
  EXPECT_FALSE(frame(Landmark::percolation, 3, radians(20.0)).has_value());
}

TEST(Landmarks, dilation_begins_where_the_volume_is_smallest) {
  std::vector<ObservableRow> rows(201);  // every 0.1 deg
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double angle = 0.1 * static_cast<double>(k);
    at(rows[k], Observable::tilt) = radians(angle);
    at(rows[k], Observable::volume_strain) = 1e-5 * (angle - 12.0) * (angle - 12.0);
  }
  const std::vector<double> tilts = {radians(0.0), radians(5.0), radians(10.0), radians(13.0), radians(20.0)};
  EXPECT_EQ(frame_of(Landmark::theta_d, tilts, rows, {}, radians(20.0)), 3u);
  EXPECT_FALSE(frame_of(Landmark::theta_d, tilts, rows, {}, radians(11.0)).has_value())
      << "up to 11 deg it contracts";
  EXPECT_FALSE(frame_of(Landmark::theta_d, tilts, {}, {}, radians(20.0)).has_value());
}

}  // namespace
}  // namespace talus::view
