#include "app/help_text.h"

#include <gtest/gtest.h>

#include "app/options.h"
#include "support/has.h"
#include "support/process.h"

namespace talus::test {
namespace {

/// tool [go [--fast] [-n,--number N] [--often N] [--to] WHERE [near]] [hidden]
class HelpText : public testing::Test {
 protected:
  HelpText() {
    app_.require_subcommand(1);
    CLI::App* go = app_.add_subcommand("go", "Go there: 'at once'; back\\slash");
    go->add_flag("--fast", flag_, "In haste [not]");
    go->add_option("-n,--number", number_, ".5 times: as often")
        ->type_name("N")
        ->capture_default_str()
        ->check(CLI::Validator([](std::string&) { return std::string(); }, "(0 to 9)"));
    go->add_option("--often", number_, "How often [once]")->type_name("N")->check(app::in_range(1, 5));
    go->add_option("--to", text_, "Where to")
        ->required()
        ->check(CLI::Validator([](std::string&) { return std::string(); }, "{north,south}"));
    go->add_option("WHERE", text_, "The place")->required();
    go->add_subcommand("near", "Not far");
    app_.add_subcommand("hidden", "Nobody sees this")->group("");
  }

  CLI::App app_{"A tool.", "tool"};
  bool flag_ = false;
  int number_ = 3;
  std::string text_;
};

TEST_F(HelpText, shows_values_by_their_meaning_and_range) {
  EXPECT_TRUE(has_all(
      app::HelpText().make_help(app_.get_subcommand("go"), "tool go", {}),
      {"Usage: tool go [OPTIONS] WHERE [SUBCOMMAND]\n", "\n  --fast                In haste [not]\n",
       "\n  -n,--number N         .5 times: as often (0 to 9) [3]\n",
       "\n  --often N             How often (1 to 5) [once]\n", "\n  --to {north,south} (required)\n"}));
}

TEST_F(HelpText, makes_a_man_page_of_each_visible_command) {
  const TemporaryFolder folder;
  app::write_man_pages(app_, folder.path("man1"));
  EXPECT_FALSE(std::filesystem::exists(folder.path("man1/tool-hidden.1")));
  EXPECT_TRUE(has(text_of(folder.path("man1/tool.1")), ".TH \"tool\" 1 "));
  EXPECT_TRUE(has(text_of(folder.path("man1/tool-go-near.1")), "tool\\-go\\-near \\- Not far\n"));
  const std::string go = text_of(folder.path("man1/tool-go.1"));
  EXPECT_TRUE(has_all(go, {"tool\\-go \\- Go there\n", "\nGo there: 'at once'; back\\eslash\n",
                           "\n  \\-\\-to {north,south} (required)\n"}));
}

TEST_F(HelpText, offers_commands_options_and_values_to_shells) {
  const auto offers = [&](const std::vector<std::string>& words) { return app::completions(app_, words); };
  EXPECT_EQ(offers({""}), "go Go there\n");
  EXPECT_EQ(offers({"go", ""}), "near Not far\n");
  EXPECT_EQ(offers({"go", "--"}),
            "--help Print this help message and exit\n-h Print this help message and exit\n--fast In "
            "haste\n--number .5 times\n-n .5 times\n--often How often\n--to Where to\n");
  EXPECT_EQ(offers({"go", "--to", ""}), "north\nsouth\n");
  EXPECT_EQ(offers({"go", "--to", "n"}), "north\nsouth\n") << "the shell compares the beginnings";
  EXPECT_EQ(offers({"go", "--number", ""}), "") << "the shell offers files";
  EXPECT_EQ(offers({"go", "--fast", ""}), "near Not far\n");
}

}  // namespace
}  // namespace talus::test
