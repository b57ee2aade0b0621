/// Seeds, and every variant with each of them.

#include "ensemble/plan.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "support/exit_code.h"

namespace talus::ensemble {
namespace {

using Seeds = std::vector<std::uint64_t>;

TEST(Seeds, are_ranges_and_numbers) {
  EXPECT_EQ(parse_seeds("1-4"), (Seeds{1, 2, 3, 4}));
  EXPECT_EQ(parse_seeds("7"), Seeds{7});
  EXPECT_EQ(parse_seeds("8,1-3,2-4"), (Seeds{1, 2, 3, 4, 8}));
  EXPECT_EQ(parse_seeds("9223372036854775807"), Seeds{9223372036854775807u});
}

TEST(Seeds, of_another_form_are_refused) {
  for (const char* text :
       {"", "a", "1-", "-1", "3-1", "1,,2", "1 2", "1.5", "1-20000", "99999999999999999999",
        "9223372036854775808", "9223372036854775807-9223372036854775808", "1-9000,20000-29000"})
    EXPECT_EQ(test::exit_code_of([&] { parse_seeds(text); }), ExitCode::usage) << text;
}

TEST(EnsemblePlan, has_every_variant_with_every_seed) {
  const EnsemblePlan plan = plan_ensemble({3, 7}, {{"a", "x.toml", {}}, {"", "y.toml", {}}}, "folder");
  ASSERT_EQ(plan.members.size(), 4u);
  const std::vector<std::string> names = {"a/seed-3", "seed-3", "a/seed-7", "seed-7"};
  for (std::size_t m = 0; m < 4; ++m) {
    EXPECT_EQ(plan.members[m].name, names[m]);
    EXPECT_EQ(plan.members[m].path, "folder/" + names[m] + ".h5");
    EXPECT_EQ(plan.members[m].variant, m % 2);
    EXPECT_EQ(plan.members[m].scenario.seed, m < 2 ? 3u : 7u);
  }
}

}  // namespace
}  // namespace talus::ensemble
