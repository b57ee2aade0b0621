#pragma once
/// The one line of progress on stderr: rewritten in place on a terminal, written now and then in a log.

#include <chrono>
#include <optional>
#include <string>

namespace talus {

class StatusLine {
 public:
  /// A quiet line shows nothing. In a log at least `seconds_in_log` pass between two lines.
  StatusLine(bool quiet, double seconds_in_log);
  /// Finishes the line, so that an error message begins on a line of its own.
  ~StatusLine();
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  bool on_terminal() const { return terminal_; }
  /// Columns of the terminal that a line can fill without wrapping; none in a log.
  std::optional<int> width() const;
  /// Whether enough time has passed since the line was last shown, or made.
  bool is_due() const;
  /// Shows `text`, which must fit the width: a line that wraps scrolls when it is rewritten.
  void show(const std::string& text);
  /// Leaves the line as it is and goes to the next.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  bool quiet_;
  bool terminal_;
  bool open_ = false;  ///< a line of the terminal waits for its end
  Clock::duration interval_;
  Clock::time_point shown_ = Clock::now();
};

}  // namespace talus
