#include "app/options.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "support/exit_code.h"

namespace talus::app {
namespace {

TEST(WallTime, is_read_as_batch_systems_write_it) {
  EXPECT_EQ(parse_wall_time("--max-wall", "00:01"), 60.0);
  EXPECT_EQ(parse_wall_time("--max-wall", "1:30"), 5400.0);
  EXPECT_EQ(parse_wall_time("--max-wall", "23:59:59"), 86399.0);
  EXPECT_EQ(parse_wall_time("--max-wall", "100:00"), 360000.0);
}

TEST(WallTime, is_refused_where_it_is_not_clear) {
  for (const char* text : {"", "90", "1:", ":30", "1:60", "1:00:60", "00:00", "1:30 ", "-1:30",
                           "1:30:", "1:-3", "1:2:3:4", "1h", "123456:00", "1.5:00", "+1:30"}) {
    SCOPED_TRACE(text);
    EXPECT_TRUE(test::refuses([&] { parse_wall_time("--max-wall", text); }, ExitCode::usage, {"--max-wall"}));
  }
}

}  // namespace
}  // namespace talus::app
