/// A grain quantity added only to the table of quantities becomes a map, a column of an export, and a value
/// in the window.

#include <gtest/gtest.h>

#include <vector>

#include "exports/writers.h"
#include "pictures/map_kind.h"
#include "support/temporary_folder.h"
#include "unit/view/example_bed.h"
#include "unit/view/opened_view.h"

namespace talus {
namespace {

class MadeUpQuantity : public testing::Test {
 protected:
  MadeUpQuantity() {
    example::write_bed_run(folder_.path("run.h5"), 20.0);
    model_.emplace(example::opened(folder_.path("run.h5")));
    model_->state.map.layers = pictures::map_layers("made_up");
  }
  std::vector<double> diameters() const {
    std::vector<double> all;
    for (Index i = 0; i < model_->statics().free_count; ++i)
      all.push_back(2.0 * model_->statics().radius[static_cast<std::size_t>(i)] / model_->mean_diameter());
    return all;
  }

  test::TemporaryFolder folder_;
  std::optional<view::ViewModel> model_;
};

TEST_F(MadeUpQuantity, is_a_map) {
  model_->first().map(2.0);
  const render::FrameView& map = model_->first().annotated_map();
  EXPECT_EQ(map.title, "Made up");
  ASSERT_EQ(map.legends.size(), 1u);
  ASSERT_EQ(map.legends[0].bars.size(), 1u);
  const render::Bar& bar = map.legends[0].bars[0];
  EXPECT_EQ(bar.title, "m (D)");
  EXPECT_EQ(bar.symbol, "m");
  EXPECT_EQ(bar.unit, "D");
  EXPECT_EQ(bar.high, 2.0);
  EXPECT_NE(pictures::list_of_maps().find("dyed, made_up"), std::string::npos) << pictures::list_of_maps();
  EXPECT_EQ(pictures::map_help(pictures::map_layers("made_up")[0]), "twice the radius of each grain");
  EXPECT_NO_THROW(pictures::map_layers("made_up+forces"));
}

TEST_F(MadeUpQuantity, is_the_value_of_a_grain_on_it) {
  model_->first().map(2.0);
  EXPECT_EQ(model_->first().bar()->values, diameters());
}

TEST_F(MadeUpQuantity, is_a_column_of_exports) {
  const Frame frame = example::bed_frame(10.0, 2);
  const RunStatics statics = example::bed_statics();
  const exports::CsvRows csv = exports::grains_csv({{frame, statics}, nullptr, true, 0, frame.gamma});
  EXPECT_NE(csv.head.find(",made_up (m),"), std::string::npos) << csv.head;
}

}  // namespace
}  // namespace talus
