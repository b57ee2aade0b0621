#include "app/status_line.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include "app/terminal.h"

namespace talus {
namespace {

constexpr double seconds_on_terminal = 0.1;
constexpr int usual_columns = 80;  ///< where the terminal does not say

}  // namespace

StatusLine::StatusLine(bool quiet, double seconds_in_log)
    : quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) != 0),
      interval_(std::chrono::duration_cast<Clock::duration>(
          std::chrono::duration<double>(terminal_ ? seconds_on_terminal : seconds_in_log))) {}

StatusLine::~StatusLine() { finish(); }

std::optional<int> StatusLine::width() const {
  if (!terminal_) return std::nullopt;
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return (known ? size.ws_col : usual_columns) - 1;  // some terminals wrap when the last column is filled
}

bool StatusLine::is_due() const { return !quiet_ && Clock::now() - shown_ >= interval_; }

void StatusLine::show(const std::string& text) {
  if (quiet_) return;
  shown_ = Clock::now();
  print_status(text, terminal_);
  open_ = terminal_;
}

void StatusLine::finish() {
  if (open_) print_error("\n");
  open_ = false;
}

}  // namespace talus
