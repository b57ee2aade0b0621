/// Every file of tests/scenarios/bad is rejected with the message stored next to it.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/errors.h"
#include "scenario/scenario.h"
#include "support/places.h"

namespace talus::scenario {
namespace {

namespace fs = std::filesystem;

const fs::path folder = fs::path(test::source_folder()) / "tests/scenarios/bad";

std::string file_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file.good()) << path << " cannot be read";
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> bad_scenarios() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

class BadScenario : public testing::TestWithParam<std::string> {};

TEST_P(BadScenario, is_refused_with_its_message) {
  const std::string name = GetParam() + ".toml";
  try {
    parse_scenario(file_text(folder / name), name);
    ADD_FAILURE() << name << " was accepted";
  } catch (const LocatedError& error) {
    EXPECT_EQ(std::string(error.what()) + "\n", file_text(folder / (GetParam() + ".expected")));
    EXPECT_EQ(error.code(), ExitCode::bad_data);
  }
}

INSTANTIATE_TEST_SUITE_P(All, BadScenario, testing::ValuesIn(bad_scenarios()),
                         [](const auto& test) { return test.param; });

TEST(BadScenarios, are_many) { EXPECT_GE(bad_scenarios().size(), 300u); }

}  // namespace
}  // namespace talus::scenario
