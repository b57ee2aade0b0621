/// History of a contact, read frame by frame.

#include "view/history.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <stdexcept>

#include "core/trigonometry.h"
#include "support/temporary_folder.h"
#include "unit/view/example_bed.h"
#include "unit/view/opened_view.h"
#include "view/inspection.h"

namespace talus::view {
namespace {

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

bool wait_for(HistorySeries& series, std::size_t count) {
  for (int k = 0; k < 2000 && series.instants().size() < count; ++k) {
    series.collect_ready();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return series.instants().size() == count;
}

TEST(History, is_of_what_is_asked_for) {
  HistorySeries series(read_frame);
  series.set_contact({4, 14, 0}, 3);
  ASSERT_TRUE(wait_for(series, 3));
  series.set_contact({4, 14, 0}, 5);
  ASSERT_TRUE(wait_for(series, 5)) << "only later frames are read";
  EXPECT_DOUBLE_EQ(degrees(series.instants()[4].tilt), 4.0);
  series.set_contact({3, 13, 0}, 5);
  EXPECT_TRUE(series.instants().empty()) << "another contact starts from the beginning";
  ASSERT_TRUE(wait_for(series, 5));
  EXPECT_EQ(series.instants()[3].fn, 3.0);
  EXPECT_EQ(series.instants()[3].ft, -0.75);
  EXPECT_EQ(series.instants()[3].status, ContactStatus::sticking);
  EXPECT_EQ(series.instants()[2].fn, 0.0);
  EXPECT_EQ(series.instants()[2].status, ContactStatus::open);
}

TEST(History, ends_at_a_frame_that_cannot_be_read) {
  HistorySeries series([](std::size_t k) {
    if (k == 2) throw std::runtime_error("damaged");
    return read_frame(k);
  });
  series.set_contact({3, 13, 0}, 5);
  ASSERT_TRUE(wait_for(series, 2));
  series.set_contact({4, 14, 0}, 2);
  EXPECT_TRUE(wait_for(series, 2)) << "another contact is read";
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

class HistoryInView : public testing::Test {
 protected:
  HistoryInView() {
    example::write_bed_run(folder_.path("run.h5"), 20.0);
    model_.emplace(example::opened(folder_.path("run.h5")));
  }
  test::TemporaryFolder folder_;
  std::optional<ViewModel> model_;
};

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
