/// Selection in the view of a hand-made run.

#include <gtest/gtest.h>

#include "unit/view/opened_view.h"
#include "view/scene.h"

namespace talus::view {
namespace {

class SelectionInRun : public example::ViewOfBed {
 protected:
  std::vector<Index> selected() { return model_->selected_grains(); }
  std::size_t lines() { return model_->first().map(2.0).lines.size(); }
};

TEST_F(SelectionInRun, stays_from_frame_to_frame) {
  model_->go_to(2);
  model_->select(std::vector<Index>{0, 10});
  EXPECT_FALSE(model_->state.selected) << "none of them is inspected";
  model_->go_to(3);
  model_->update(0.0);
  EXPECT_EQ(selected(), (std::vector<Index>{0, 10}));
  model_->select(std::vector<Index>{30});
  EXPECT_EQ(model_->state.selected, std::optional<Index>(30)) << "a single one is inspected";
  EXPECT_TRUE(model_->state.selecting.selection.grains.empty());
  model_->select(std::vector<Index>{9, 30});
  EXPECT_EQ(model_->state.selected, std::optional<Index>(30)) << "it is still inspected";
}

TEST_F(SelectionInRun, it_is_grains_or_a_contact) {
  model_->select(std::vector<Index>{1, 2, 3});
  const auto contact = find_contact(model_->bed(), 3.5, 2.0, 0.2);
  ASSERT_TRUE(contact);
  model_->select(*contact);
  EXPECT_TRUE(selected().empty());
  EXPECT_EQ(model_->state.selecting.selection.contact, contact);
  model_->select(std::vector<Index>{1, 2});
  EXPECT_FALSE(model_->state.selecting.selection.contact);
  model_->select(std::optional<Index>(7));
  EXPECT_EQ(selected(), (std::vector<Index>{7}));
}

TEST_F(SelectionInRun, it_is_drawn_by_lines_alone) {
  const std::size_t discs = model_->first().map(2.0).discs.size(), before = lines();
  model_->select(std::vector<Index>{11, 12, 13});
  EXPECT_EQ(lines(), before + 3 * 32) << "a ring for each";
  EXPECT_EQ(model_->first().map(2.0).discs.size(), discs);
  for (const render::Line& line : model_->first().map(2.0).lines)
    if (line.colour == selection_colour) {
      EXPECT_LE(line.half_width, 0.051f) << "thin";
    }
  model_->select(*find_contact(model_->bed(), 3.5, 2.0, 0.2));
  EXPECT_GT(lines(), before);
  model_->select(std::optional<Index>());
  EXPECT_EQ(lines(), before);
}

TEST_F(SelectionInRun, what_is_not_there_is_not_drawn) {
  const std::size_t before = lines();
  model_->select(std::vector<Index>{5000, 6000});
  EXPECT_EQ(lines(), before);
  EXPECT_TRUE(selected().empty());
  model_->select(ContactKey{3, 39, 0});
  EXPECT_EQ(lines(), before);
}

}  // namespace
}  // namespace talus::view
