/// Bookmarks of a run, and their file.

#include "view/bookmarks.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/errors.h"
#include "core/trigonometry.h"
#include "support/temporary_folder.h"
#include "unit/view/example_bed.h"
#include "unit/view/opened_view.h"

namespace talus::view {
namespace {

std::vector<std::string> notes_of(const std::vector<Bookmark>& bookmarks) {
  std::vector<std::string> notes;
  for (const Bookmark& bookmark : bookmarks) notes.push_back(bookmark.note);
  return notes;
}

class Bookmarks : public testing::Test {
 protected:
  void write(const std::string& text) { std::ofstream(path_) << text; }
  std::string message() {
    try {
      read_bookmarks(path_);
    } catch (const LocatedError& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_data);
      return error.what();
    }
    return "nothing is thrown";
  }

  test::TemporaryFolder folder_;
  std::string path_ = folder_.path("run.h5.bookmarks.csv");
};

TEST_F(Bookmarks, lie_beside_their_run) {
  EXPECT_EQ(bookmarks_path("runs/slope.h5"), "runs/slope.h5.bookmarks.csv");
  EXPECT_EQ(bookmarks_path("runs/slope.h5.run"), "runs/slope.h5.bookmarks.csv") << "while it is a folder";
  EXPECT_EQ(bookmarks_path("runs/slope.h5.run/"), "runs/slope.h5.bookmarks.csv");
  EXPECT_TRUE(read_bookmarks(path_).empty()) << "there is no file";
}

TEST_F(Bookmarks, are_read_as_they_were_written) {
  std::vector<Bookmark> bookmarks;
  set_bookmark(bookmarks, {0.1 + 0.2, radians(12.3), "a \"first\" slide, at last\nθ_d"});
  set_bookmark(bookmarks, {0.1, radians(-4.0), ""});
  write_bookmarks(path_, bookmarks);
  const std::vector<Bookmark> read = read_bookmarks(path_);
  EXPECT_EQ(notes_of(read), (std::vector<std::string>{"", "a \"first\" slide, at last θ_d"}));
  EXPECT_EQ(read[1].time, 0.1 + 0.2) << "bit for bit";
  EXPECT_NEAR(read[0].tilt, radians(-4.0), 1e-15);
}

TEST_F(Bookmarks, are_one_for_each_frame) {
  std::vector<Bookmark> bookmarks;
  for (const char* note : {"first", "second"}) set_bookmark(bookmarks, {1.0, 0.0, note});
  EXPECT_EQ(notes_of(bookmarks), std::vector<std::string>{"second"});
}

TEST_F(Bookmarks, say_which_line_is_none) {
  write("time (s),tilt (deg),note\n1,2,\"good\"\n\n3,4,no quotes\n");
  EXPECT_EQ(message(), path_ +
                           ":4:1: error: expected a time in s, a tilt in deg and a note in quotes, with "
                           "commas between, found 3,4,no quotes");
  for (const char* bad : {"1,2", "nan,2,\"a\"", "x,2,\"a\"", "1,2,\"a", "1,2,\"a\"b\"", "1;2;\"a\""}) {
    write(bad);
    EXPECT_NE(message().find(":1:1: error:"), std::string::npos) << bad;
  }
  write("1,2,\"of another program\"\r\n");
  EXPECT_EQ(notes_of(read_bookmarks(path_)), std::vector<std::string>{"of another program"});
}

class BookmarksOfRun : public Bookmarks {
 protected:
  BookmarksOfRun() { example::write_bed_run(run_, 20.0); }
  std::string run_ = folder_.path("run.h5");
};

TEST_F(BookmarksOfRun, stay_beside_it) {
  {
    ViewModel model = example::opened(run_);
    EXPECT_EQ(model.bookmark(), nullptr);
    model.go_to(5);
    model.set_bookmark("after failure");
    model.go_to(3);
    model.set_bookmark("here");
    ASSERT_NE(model.bookmark(), nullptr);
    EXPECT_EQ(model.bookmark()->note, "here");
    EXPECT_EQ(model.state.message, "");
  }
  ViewModel model = example::opened(run_);
  ASSERT_TRUE(example::wait_for_condition(model, [&] { return !model.events().empty(); }));
  std::vector<std::size_t> frames;
  for (const TimelineEvent& event : model.events())
    if (event.kind == TimelineEvent::Kind::bookmark) frames.push_back(event.frame);
  EXPECT_EQ(frames, (std::vector<std::size_t>{3, 5}));
  model.go_to(3);
  ASSERT_NE(model.bookmark(), nullptr);
  EXPECT_NEAR(model.bookmark()->tilt, model.frame().tilt, 1e-12);
  model.set_bookmark(std::nullopt);
  EXPECT_EQ(model.bookmark(), nullptr);
  EXPECT_EQ(notes_of(read_bookmarks(path_)), std::vector<std::string>{"after failure"});
}

TEST_F(BookmarksOfRun, are_not_replaced_where_they_cannot_be_read) {
  write("something else\n");
  ViewModel model = ViewModel::open(run_, {}, "", false, "talus view");
  model.update(0.0);
  EXPECT_NE(model.state.message.find("run.h5.bookmarks.csv:1:1"), std::string::npos) << "reported at once";
  model.state.message.clear();
  model.set_bookmark("mine");
  EXPECT_NE(model.state.message.find("run.h5.bookmarks.csv:1:1"), std::string::npos);
  EXPECT_EQ(model.bookmark(), nullptr);
  EXPECT_NE(message(), "nothing is thrown") << "the file is unchanged";
}

TEST_F(BookmarksOfRun, that_cannot_be_written_are_not_there) {
  std::filesystem::create_directory(path_ + ".talus.part");
  ViewModel model = example::opened(run_);
  model.set_bookmark("mine");
  EXPECT_NE(model.state.message, "");
  EXPECT_EQ(model.bookmark(), nullptr);
}

}  // namespace
}  // namespace talus::view
