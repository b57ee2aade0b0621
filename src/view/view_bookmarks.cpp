/// The bookmarks of the run that is shown.

#include <algorithm>
#include <utility>

#include "core/errors.h"
#include "view/view_data.h"

namespace talus {

std::string ViewModel::Data::bookmarks_file() const {
  const std::string& run = replay ? pictures.path : output;
  return run.empty() ? "" : bookmarks_path(run);
}

void ViewModel::Data::open_bookmarks() {
  try {
    bookmarks = read_bookmarks(bookmarks_file());
  } catch (const Error& failure) {
    bookmarks_unread = error = failure.what();
  }
}

std::optional<std::size_t> ViewModel::Data::marked_frame() const {
  const std::size_t count = replay ? frame_count() : recorded->all().size();
  if (count == 0) return std::nullopt;
  return std::min(shown_index(), count - 1);
}

std::string ViewModel::Data::keep_bookmarks(std::vector<Bookmark> next) {
  const std::string file = bookmarks_file();
  if (file.empty()) return "Save the run first: bookmarks are kept in a file beside it.";
  if (!bookmarks_unread.empty()) return bookmarks_unread;
  try {
    write_bookmarks(file, next);
  } catch (const Error& failure) {
    return failure.what();
  }
  bookmarks = std::move(next);
  find_events();
  return {};
}

const Bookmark* ViewModel::bookmark() const {
  const auto frame = data_->marked_frame();
  if (!frame) return nullptr;
  const double time = data_->all_frame_times()[*frame];
  const auto found = std::ranges::find(data_->bookmarks, time, &Bookmark::time);
  return found == data_->bookmarks.end() ? nullptr : &*found;
}

void ViewModel::set_bookmark(const std::string& note) {
  const auto frame = data_->marked_frame();
  if (!frame) return;
  std::vector<Bookmark> next = data_->bookmarks;
  talus::set_bookmark(next, {data_->all_frame_times()[*frame], frame_tilts()[*frame], note});
  if (const std::string reason = data_->keep_bookmarks(std::move(next)); !reason.empty())
    state.message = reason;
}

void ViewModel::remove_bookmark() {
  const Bookmark* const marked = bookmark();
  if (!marked) return;
  std::vector<Bookmark> next = data_->bookmarks;
  std::erase_if(next, [time = marked->time](const Bookmark& other) { return other.time == time; });
  if (const std::string reason = data_->keep_bookmarks(std::move(next)); !reason.empty())
    state.message = reason;
}

}  // namespace talus
