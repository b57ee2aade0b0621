/// Frame prepared while another is drawn, with the hand-made bed.

#include "view/frame_ahead.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <stdexcept>

#include "pictures/overload_rule.h"
#include "unit/view/example_bed.h"

namespace talus::view {
namespace {

std::shared_ptr<const Frame> read_bed(std::size_t k) {
  return std::make_shared<const Frame>(
      example::bed_frame(5.0 * static_cast<double>(k), example::overloaded_of_frames.at(k)));
}

/// Returns gamma of the free grains; floor grains have none.
std::vector<double> free_gamma(const Frame& frame) {
  return {frame.gamma.begin(), frame.gamma.begin() + example::bed_statics().free_count};
}

TEST(FrameAhead, makes_a_frame_as_the_view_would) {
  FrameAhead ahead(example::bed_statics(), read_bed);
  ahead.begin(2, 3.0);
  const auto made = ahead.take(2, 3.0);
  ASSERT_TRUE(made);
  const Frame stored = *read_bed(2);
  EXPECT_EQ(free_gamma(*made->stored), free_gamma(stored));
  EXPECT_EQ(free_gamma(*made->mapped),
            free_gamma(pictures::mapped_frame(stored, example::bed_statics(), 3.0)));
  EXPECT_NE(free_gamma(*made->mapped), free_gamma(stored))
      << "a neighbourhood of 3 D has more than one grain";
  EXPECT_FALSE(ahead.take(2, 3.0)) << "it has been returned already";
}

TEST(FrameAhead, has_nothing_else_than_what_was_begun) {
  FrameAhead ahead(example::bed_statics(), read_bed);
  EXPECT_FALSE(ahead.take(0, 1.0));
  ahead.begin(2, 1.0);
  EXPECT_FALSE(ahead.take(3, 1.0));
  EXPECT_FALSE(ahead.take(2, 2.0)) << "with other neighbourhoods";
  const auto made = ahead.take(2, 1.0);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->stored->tilt, read_bed(2)->tilt);
}

TEST(FrameAhead, makes_one_at_a_time) {
  std::promise<void> may_read;
  const std::shared_future<void> read_on(may_read.get_future());
  std::atomic<int> reads = 0;
  FrameAhead ahead(example::bed_statics(), [&](std::size_t k) {
    ++reads;
    read_on.wait();
    return read_bed(k);
  });
  ahead.begin(1, 1.0);
  ahead.begin(4, 1.0);
  ahead.begin(1, 1.0);
  EXPECT_FALSE(ahead.take(4, 1.0)) << "the first one is still being read";
  may_read.set_value();
  EXPECT_TRUE(ahead.take(1, 1.0));
  EXPECT_EQ(reads, 1);
  ahead.begin(4, 1.0);
  EXPECT_TRUE(ahead.take(4, 1.0));
}

TEST(FrameAhead, does_not_read_what_is_known) {
  FrameAhead ahead(example::bed_statics(),
                   [](std::size_t) -> std::shared_ptr<const Frame> { throw std::runtime_error("read"); });
  const auto known = read_bed(3);
  ahead.begin(3, 1.0, known);
  const auto made = ahead.take(3, 1.0);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->stored, known);
}

TEST(FrameAhead, has_none_that_cannot_be_read_or_is_of_another_bed) {
  FrameAhead ahead(example::bed_statics(), [](std::size_t k) {
    if (k == 0) throw std::runtime_error("damaged");
    Frame other = example::bed_frame(0.0, 0);
    other.x.pop_back();
    return std::make_shared<const Frame>(std::move(other));
  });
  for (const std::size_t k : {0u, 1u}) {
    ahead.begin(k, 1.0);
    EXPECT_FALSE(ahead.take(k, 1.0)) << k;
  }
}

}  // namespace
}  // namespace talus::view
