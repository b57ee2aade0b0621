/// Effects of other desktop programs on the window of `talus view`.

#include "gui/window_fixture.h"
#include "gui/x11_client.h"

namespace talus::test {
namespace {

TEST_F(Window, opens_a_file_that_is_dropped_on_it) {
  for (const char* name : {"first.h5", "second.h5"}) take_run(folder_, name, small_bed);
  start({"first.h5"});
  ASSERT_TRUE(drop_file(desktop_->window(), folder_.path("second.h5")));
  EXPECT_TRUE(desktop_->wait_for_title("second.h5")) << desktop_->title();
  write_file(folder_, "bad.h5", "not a run");
  ASSERT_TRUE(drop_file(desktop_->window(), folder_.path("bad.h5")));
  move_to("map");
  desktop_->key("End");
  EXPECT_TRUE(desktop_->wait_for_title("second.h5, 1.00°"))
      << "a file that cannot be opened leaves the view unchanged";
  ASSERT_TRUE(drop_file(desktop_->window(), folder_.path("bed.toml")));
  EXPECT_TRUE(desktop_->wait_for_title("bed.toml")) << desktop_->title();
  desktop_->key("q");
  EXPECT_EQ(end(), 0);
}

TEST_F(Window, is_closed_by_its_button_but_not_with_a_run_that_is_not_saved) {
  start({"bed.toml"});
  click("step 10");
  move_to("map");
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  ask_to_close(desktop_->window());
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_TRUE(desktop_->wait_for_title("bed.toml")) << "it asks first";
  ask_to_close(desktop_->window());
  EXPECT_EQ(end(), 0);
}

}  // namespace
}  // namespace talus::test
