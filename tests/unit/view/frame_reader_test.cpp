/// Frames, values and the history of a contact that are read in the background, with the hand-made bed,
/// theta_c = 20 deg.

#include "view/frame_reader.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <thread>

#include "core/trigonometry.h"
#include "pictures/cluster_colours.h"
#include "unit/view/example_bed.h"
#include "unit/view/opened_view.h"
#include "view/selection.h"

namespace talus::view {
namespace {

const pictures::OverloadRule rule{
    .theta_c = radians(20.0), .threshold_factor = 1.0, .joined_by_neighbours = false, .l_min = 0.0};

std::shared_ptr<const Frame> read_bed(std::size_t k) {
  return std::make_shared<const Frame>(
      example::bed_frame(5.0 * static_cast<double>(k), example::overloaded_of_frames.at(k)));
}

/// Frames that a function reads.
class FramesOfFunction final : public FrameSource {
 public:
  using Read = std::function<std::shared_ptr<const Frame>(std::size_t)>;
  explicit FramesOfFunction(Read read) : read_(std::move(read)) {}
  std::shared_ptr<const Frame> read(std::size_t k) override { return read_(k); }

 private:
  Read read_;
};

/// Reader of such frames of the hand-made bed.
struct ReaderOfBed : FrameReader {
  explicit ReaderOfBed(FramesOfFunction::Read read = read_bed)
      : FrameReader(example::bed_statics(), std::make_shared<FramesOfFunction>(std::move(read))) {}
  ReaderOfBed(std::size_t frames, std::size_t of_tilt) : ReaderOfBed() { set_counts(frames, of_tilt); }
};

/// Collects results until `frames` frames have been processed, and returns what is known of them.
pictures::SeenFrames wait_for(FrameReader& reader, std::size_t frames) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  pictures::PictureSeries pictures;
  while (pictures.seen_frames.instants.size() < frames && reader.error().empty() &&
         std::chrono::steady_clock::now() < end) {
    reader.collect_values(pictures);
    std::this_thread::yield();
  }
  return pictures.seen_frames;
}

TEST(FrameReader, has_the_values_of_each_frame) {
  ReaderOfBed reader(6, 6);
  pictures::PictureSeries pictures;
  EXPECT_FALSE(reader.collect_values(pictures)) << "nothing was begun";
  reader.evaluate(rule, {});
  wait_for(reader, 6);
  ASSERT_EQ(reader.values().size(), 6u);
  for (std::size_t k = 0; k < 6; ++k) {
    const analysis::FrameRecord& values = reader.values()[k];
    EXPECT_NEAR(values.tilt, radians(5.0 * static_cast<double>(k)), 1e-12);
    EXPECT_NEAR(values.thresholds[0].overloaded_fraction, example::overloaded_of_frames[k] / 40.0, 1e-12);
    EXPECT_EQ(values.thresholds[0].spans_depth, k >= 3 ? 1 : 0) << k;
  }
  EXPECT_TRUE(std::isnan(reader.values()[0].thresholds[0].largest_share));
  EXPECT_TRUE(std::isnan(reader.values()[0].thresholds[0].lc_max));
  EXPECT_EQ(reader.values()[2].thresholds[0].largest_share, 1.0);
  // One overloaded grain with its three neighbours has Q/P = 1/7, below sin 20 deg; from the middle of a
  // column of four, the neighbourhood must reach the diagonal neighbours.
  EXPECT_NEAR(reader.values()[1].thresholds[0].lc_max, 2.0, 1e-12);
  EXPECT_NEAR(reader.values()[3].thresholds[0].lc_max, std::sqrt(8.0), 1e-12);
  EXPECT_NEAR(reader.values()[3].thresholds[0].lc_mean, 1.0 + std::sqrt(2.0), 1e-12);
  EXPECT_EQ(reader.extent().y_min, -1.0);
  EXPECT_EQ(reader.extent().y_max, 4.0);
}

TEST(FrameReader, has_values_of_the_tilt_and_colours_of_all_frames) {
  ReaderOfBed reader(6, 4);
  reader.evaluate(rule, {});
  const pictures::SeenFrames seen_frames = wait_for(reader, 6);
  EXPECT_EQ(reader.values().size(), 4u);
  ASSERT_EQ(seen_frames.cluster_colours.size(), 6u);
  EXPECT_TRUE(seen_frames.cluster_colours[0].empty());
  ASSERT_EQ(seen_frames.cluster_colours[5].size(), 1u);
  EXPECT_EQ(seen_frames.cluster_colours[5][0].track, seen_frames.cluster_colours[1][0].track)
      << "the same cluster, grown";
}

TEST(FrameReader, does_not_work_out_what_is_known) {
  ReaderOfBed reader(6, 6);
  reader.evaluate(rule, std::vector(6, analysis::FrameRecord{
                                           .tilt = 1.0, .thresholds = {{.overloaded_fraction = 0.125}}}));
  EXPECT_EQ(wait_for(reader, 6).cluster_colours.size(), 6u);
  ASSERT_EQ(reader.values().size(), 6u);
  EXPECT_EQ(reader.values()[5].thresholds[0].overloaded_fraction, 0.125);
}

TEST(FrameReader, begins_anew_with_another_rule) {
  ReaderOfBed reader(6, 6);
  reader.evaluate(rule, {});
  wait_for(reader, 3);
  pictures::OverloadRule other = rule;
  other.threshold_factor = 4.0;  // above 1, so that nothing is overloaded
  reader.evaluate(other, {});
  EXPECT_TRUE(reader.values().empty());
  const pictures::SeenFrames seen_frames = wait_for(reader, 6);
  ASSERT_EQ(reader.values().size(), 6u);
  EXPECT_EQ(reader.values()[5].thresholds[0].overloaded_fraction, 0.0);
  EXPECT_EQ(reader.rule(), other);
  EXPECT_EQ(seen_frames.rule, other);
  ASSERT_EQ(seen_frames.cluster_colours.size(), 6u);
  EXPECT_TRUE(seen_frames.cluster_colours[5].empty());
}

TEST(FrameReader, takes_grains_with_their_neighbours) {
  ReaderOfBed reader(6, 6);
  pictures::OverloadRule with_neighbours = rule;
  with_neighbours.l_min = 3.0;
  reader.evaluate(with_neighbours, {});
  wait_for(reader, 6);
  // In a neighbourhood of 6 or 9 grains, each with P = 2 or, if overloaded, 1, only the overloaded grains
  // contribute to Q. With four of them, the neighbourhoods of the lowest and the highest contain 2 of 6 (Q/P
  // = 2/10), below sin 20 deg; those between contain 3 of 9.
  ASSERT_EQ(reader.values().size(), 6u);
  EXPECT_EQ(reader.values()[3].thresholds[0].overloaded_fraction, 0.0);
  with_neighbours.threshold_factor = 0.18 / sine(radians(20.0));
  reader.evaluate(with_neighbours, {});
  wait_for(reader, 6);
  EXPECT_NEAR(reader.values()[3].thresholds[0].overloaded_fraction, 12.0 / 40.0, 1e-12)
      << "the column and its neighbours";
  EXPECT_GE(reader.values()[3].thresholds[0].lc_mean, 3.0);
}

TEST(FrameReader, goes_on_with_frames_that_come_later) {
  ReaderOfBed reader;
  reader.evaluate(rule, {});
  reader.set_counts(2, 2);
  wait_for(reader, 2);
  EXPECT_EQ(reader.values().size(), 2u);
  reader.set_counts(4, 4);
  wait_for(reader, 4);
  EXPECT_EQ(reader.values().size(), 4u);
}

TEST(FrameReader, has_a_tracker_that_has_met_its_frames) {
  // The cluster of the first frame has disappeared in the second; the third frame has a different cluster.
  ReaderOfBed reader([](std::size_t k) {
    return std::make_shared<const Frame>(example::bed_frame(static_cast<double>(k), k == 1 ? 0 : 2));
  });
  reader.set_counts(3, 3);
  reader.evaluate(rule, {});
  pictures::ClusterColours tracker = wait_for(reader, 3).tracker;
  const RunStatics statics = example::bed_statics();
  const Frame frame = example::bed_frame(3.0, 2);
  const auto next = tracker.next(pictures::overloaded_clusters({frame, statics}, {.theta_c = rule.theta_c}));
  EXPECT_EQ(next.at(0).track, 1);
}

TEST(FrameReader, leaves_out_what_was_begun_by_another_rule) {
  std::atomic<bool> reading = false, may_read = false;
  ReaderOfBed reader([&](std::size_t) {
    reading = true;
    while (!may_read) std::this_thread::yield();
    return read_bed(5);
  });
  reader.set_counts(2, 2);
  reader.evaluate(rule, {});
  while (!reading) std::this_thread::yield();
  pictures::OverloadRule other = rule;
  other.threshold_factor = 4.0;
  reader.evaluate(other, {});
  may_read = true;
  wait_for(reader, 2);
  ASSERT_EQ(reader.values().size(), 2u);
  EXPECT_EQ(reader.values()[0].thresholds[0].overloaded_fraction, 0.0);
}

TEST(FrameReader, says_why_a_frame_cannot_be_read) {
  ReaderOfBed reader([](std::size_t k) {
    if (k == 2) throw std::runtime_error("frame 2 is damaged");
    return read_bed(k);
  });
  reader.set_counts(6, 6);
  reader.evaluate(rule, {});
  wait_for(reader, 6);
  EXPECT_EQ(reader.error(), "frame 2 is damaged");
  pictures::PictureSeries pictures;
  while (reader.collect_values(pictures)) {
  }
  EXPECT_EQ(reader.values().size(), 2u);
}

TEST(FrameReader, ends_while_it_works) {
  std::atomic<int> reads = 0;
  {
    ReaderOfBed reader([&reads](std::size_t k) {
      ++reads;
      return read_bed(k % 6);
    });
    reader.set_counts(1000000, 0);
    reader.evaluate(rule, {});
    while (reads == 0) std::this_thread::yield();
  }
  const int after = reads;
  EXPECT_LT(after, 1000000);
}

/// Returns gamma of the free grains; floor grains have none.
std::vector<double> free_gamma(const Frame& frame) {
  return {frame.gamma.begin(), frame.gamma.begin() + example::bed_statics().free_count};
}

/// Source whose reading lasts until it may end.
struct SlowSource {
  std::atomic<int> reads = 0;
  std::atomic<bool> may_end = false;
  std::shared_ptr<const Frame> operator()(std::size_t k) {
    ++reads;
    while (!may_end) std::this_thread::yield();
    return read_bed(k);
  }
  /// Waits until that many readings have begun.
  void wait_for(int count) const {
    while (reads < count) std::this_thread::yield();
  }
};

TEST(NextFrame, is_made_as_the_view_would) {
  SlowSource source;
  ReaderOfBed reader(std::ref(source));
  EXPECT_FALSE(reader.take(0, 1.0)) << "nothing was requested";
  reader.prepare(2, 3.0);
  source.wait_for(1);
  EXPECT_FALSE(reader.take(3, 3.0));
  EXPECT_FALSE(reader.take(2, 1.0)) << "with other neighbourhoods";
  source.may_end = true;
  const auto made = reader.take(2, 3.0);
  ASSERT_TRUE(made);
  const Frame stored = *read_bed(2);
  EXPECT_EQ(free_gamma(*made), free_gamma(pictures::mapped_frame(stored, example::bed_statics(), 3.0)));
  EXPECT_NE(free_gamma(*made), free_gamma(stored)) << "a neighbourhood of 3 D has more than one grain";
  EXPECT_FALSE(reader.take(2, 3.0)) << "it has been returned already";
}

TEST(NextFrame, is_the_newest_that_was_requested) {
  SlowSource source;
  ReaderOfBed reader(std::ref(source));
  reader.prepare(1, 1.0);
  source.wait_for(1);
  for (const std::size_t k : {4u, 5u, 1u, 5u}) reader.prepare(k, 1.0);
  EXPECT_FALSE(reader.take(4, 1.0)) << "another one was requested since";
  source.may_end = true;
  source.wait_for(2);
  const auto made = reader.take(5, 1.0);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->tilt, read_bed(5)->tilt);
  EXPECT_FALSE(reader.take(1, 1.0)) << "it is not kept";
  EXPECT_EQ(source.reads, 2);
}

TEST(NextFrame, is_returned_while_the_one_after_it_is_read) {
  std::atomic<bool> first_may_end = false, second_may_end = false;
  std::atomic<int> reads = 0;
  ReaderOfBed reader([&](std::size_t k) {
    ++reads;
    while (k == 1 ? !first_may_end : !second_may_end) std::this_thread::yield();
    return read_bed(k);
  });
  reader.prepare(1, 1.0);
  while (reads < 1) std::this_thread::yield();
  reader.prepare(2, 1.0);
  std::thread release([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    first_may_end = true;
  });
  EXPECT_TRUE(reader.take(1, 1.0));
  release.join();
  second_may_end = true;
}

TEST(NextFrame, is_not_waited_for_before_its_reading_begins) {
  SlowSource source;
  ReaderOfBed reader(std::ref(source));
  reader.set_counts(6, 6);
  reader.evaluate(rule, {});
  source.wait_for(1);
  reader.prepare(4, 1.0);
  EXPECT_FALSE(reader.take(4, 1.0)) << "the first values are still being read";
  source.may_end = true;
  EXPECT_EQ(wait_for(reader, 6).instants.size(), 6u);
  EXPECT_EQ(source.reads, 6) << "and it is not read for nothing";
}

TEST(NextFrame, that_cannot_be_read_or_is_of_another_bed_does_not_exist) {
  std::atomic<int> reads = 0;
  ReaderOfBed reader([&reads](std::size_t k) {
    ++reads;
    if (k == 0) throw std::runtime_error("damaged");
    Frame other = example::bed_frame(0.0, 0);
    other.x.pop_back();
    return std::make_shared<const Frame>(std::move(other));
  });
  for (const int k : {0, 1}) {
    reader.prepare(static_cast<std::size_t>(k), 1.0);
    while (reads <= k) std::this_thread::yield();
    EXPECT_FALSE(reader.take(static_cast<std::size_t>(k), 1.0)) << k;
  }
}

/// Returns frame k, in which the contact of grains 3 and 13 carries k N/m, except in the third frame.
std::shared_ptr<const Frame> read_frame(std::size_t k) {
  auto frame = std::make_shared<Frame>(example::bed_frame(static_cast<double>(k), 1));
  FrameContacts& c = frame->contacts;
  for (std::size_t at = 0; at < c.a.size(); ++at)
    if (c.a[at] == 3 && c.b[at] == 13) {
      c.fn[at] = static_cast<double>(k);
      c.ft[at] = -0.25 * static_cast<double>(k);
      if (k == 2) c.b[at] = 12;
    }
  return frame;
}

bool wait_for_history(FrameReader& reader, std::size_t count) {
  for (int k = 0; k < 2000 && reader.history().size() < count; ++k) {
    reader.collect_history();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return reader.history().size() == count;
}

TEST(History, is_of_the_contact_that_is_followed) {
  ReaderOfBed reader(read_frame);
  reader.set_counts(3, 3);
  reader.follow(ContactKey{4, 14, 0});
  ASSERT_TRUE(wait_for_history(reader, 3));
  reader.set_counts(5, 5);
  reader.follow(ContactKey{4, 14, 0});
  ASSERT_TRUE(wait_for_history(reader, 5)) << "only later frames are read";
  EXPECT_DOUBLE_EQ(degrees(reader.history()[4].tilt), 4.0);
  reader.follow(ContactKey{3, 13, 0});
  EXPECT_TRUE(reader.history().empty()) << "another contact starts from the beginning";
  ASSERT_TRUE(wait_for_history(reader, 5));
  EXPECT_EQ(reader.history()[3].fn, 3.0);
  EXPECT_EQ(reader.history()[3].ft, -0.75);
  EXPECT_EQ(reader.history()[2].fn, 0.0);
  reader.follow(std::nullopt);
  EXPECT_FALSE(reader.collect_history());
  EXPECT_TRUE(reader.history().empty());
}

TEST(History, ends_at_a_frame_that_cannot_be_read) {
  ReaderOfBed reader([](std::size_t k) {
    if (k == 2) throw std::runtime_error("damaged");
    return read_frame(k);
  });
  reader.set_counts(5, 5);
  reader.follow(ContactKey{3, 13, 0});
  ASSERT_TRUE(wait_for_history(reader, 2));
  reader.follow(ContactKey{4, 14, 0});
  EXPECT_TRUE(wait_for_history(reader, 2)) << "another contact is read";
}

TEST(Contact, is_told_by_force_and_friction) {
  const RunStatics statics = example::bed_statics();
  const auto frame = read_frame(4);
  const ContactInspection inspection = inspect_contact({*frame, statics}, {3, 13, 0});
  EXPECT_TRUE(inspection.carries);
  EXPECT_EQ(inspection.fn, 4.0);
  EXPECT_EQ(inspection.ft, -1.0);
  EXPECT_DOUBLE_EQ(inspection.mobilisation, 0.5);
  EXPECT_EQ(inspection.a_name, "grain 3");
  EXPECT_EQ(inspection.b_name, "grain 13");
  const ContactInspection open = inspect_contact({*frame, statics}, {3, 43, 1});
  EXPECT_FALSE(open.carries);
  EXPECT_EQ(open.b_name, "floor grain 43");
  EXPECT_TRUE(std::isnan(open.mobilisation));
  Frame smooth = *frame;
  smooth.friction = {};
  EXPECT_TRUE(std::isnan(inspect_contact({smooth, statics}, {3, 13, 0}).mobilisation));
}

TEST(Contact, with_a_wall_has_the_friction_of_the_wall) {
  const RunStatics statics = example::bed_statics();
  Frame frame = *read_frame(4);
  frame.friction.walls = 1.0;
  const auto c = static_cast<std::size_t>(contact_of_key(frame.contacts, {3, 13, 0}).value());
  const Index wall = frame.grain_count();
  frame.contacts.b[c] = wall;
  frame.contacts.nx[c] = -1.0;
  const ContactInspection inspection = inspect_contact({frame, statics}, {3, wall, 0});
  EXPECT_EQ(inspection.b_name, "left wall");
  EXPECT_EQ(inspection.friction, 1.0);
  EXPECT_DOUBLE_EQ(inspection.mobilisation, 0.25);
  EXPECT_EQ(instant_of(frame, {3, wall, 0}).friction, 1.0);
}

TEST(Contact, its_curves_are_along_the_run) {
  std::vector<HistoryInstant> instants;
  for (std::size_t k = 0; k < 4; ++k) instants.push_back(instant_of(*read_frame(k), {3, 13, 0}));
  instants[3].friction = 0.25;
  const std::vector<Plot> plots = contact_plots(instants, 2.0, {PlotAxis::tilt, not_known});
  ASSERT_EQ(plots.size(), 2u);
  EXPECT_NEAR(plots[0].series[0].x[3], 3.0, 1e-12) << "deg";
  EXPECT_EQ(plots[0].series[0].y[3], 1.5) << "in units of the weight";
  EXPECT_EQ(plots[0].series[1].y[1], -0.125);
  EXPECT_EQ(plots[1].series[0].y[1], 0.5);
  EXPECT_EQ(plots[1].series[0].y[3], 1.0) << "with the friction at that time";
  EXPECT_TRUE(std::isnan(plots[1].series[0].y[2])) << "open";
}

using HistoryInView = example::ViewOfBed;

TEST_F(HistoryInView, the_contact_has_its_curves) {
  EXPECT_FALSE(model_->contact_inspection());
  EXPECT_TRUE(model_->contact_history().empty());
  model_->select(ContactKey{3, 13, 0});
  EXPECT_TRUE(example::wait_for_condition(*model_, [this] {
    const auto plots = model_->contact_history();
    return !plots.empty() && plots[0].series[0].x.size() == model_->frame_count();
  }));
  EXPECT_DOUBLE_EQ(model_->contact_inspection()->fn, 1.0);
  EXPECT_NEAR(model_->contact_history()[0].series[0].y[0], 1.0 / 20.0, 1e-6) << "of mass 2 kg/m and 10 m/s^2";
  model_->hold();
  EXPECT_TRUE(model_->contact_history().empty()) << "nothing is read after that";
}

TEST_F(HistoryInView, the_camera_follows_a_grain) {
  model_->select(std::optional<Index>(39));
  model_->state.camera.zoom = 2.0;
  model_->state.selecting.follow = true;
  (void)model_->first().map(2.5);
  model_->go_to(2);
  model_->update(0.0);
  const auto [x0, x1, y0, y1] = model_->first().part(2.5);
  EXPECT_GT(y1, model_->frame().y[39] - 1e-9) << "grain 39 lies a metre higher in the third frame";
  EXPECT_LE(x0, model_->frame().x[39]);
  const double centre = model_->state.camera.centre_y;
  model_->select(std::optional<Index>(0));
  model_->update(0.0);
  EXPECT_LT(model_->state.camera.centre_y, centre);
}

}  // namespace
}  // namespace talus::view
