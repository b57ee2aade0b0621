#include "app/command_tree.h"

#include <gtest/gtest.h>

#include "app/completions.h"
#include "app/man_pages.h"

namespace talus::test {
namespace {

/// tool [go [--fast] [-n,--number INT] [--to] WHERE [near]] [hidden]
class CommandTree : public testing::Test {
 protected:
  CommandTree() {
    app_.require_subcommand(1);
    CLI::App* go = app_.add_subcommand("go", "Go there: 'at once'; back\\slash");
    go->add_flag("--fast", flag_, "In haste [not]");
    go->add_option("-n,--number", number_, ".5 times: as often")->capture_default_str();
    go->add_option("--to", text_, "Where to")->required()->check(CLI::IsMember({"north", "south"}));
    go->add_option("WHERE", text_, "The place")->required();
    go->add_option_group("how")->add_option("--by", text_, "By what:who]");
    go->add_subcommand("near", "Not far");
    app_.add_subcommand("hidden", "Nobody sees this")->group("");
    tree_ = app::command_tree(app_, "tool");
  }

  CLI::App app_{"A tool.", "tool"};
  bool flag_ = false;
  int number_ = 3;
  std::string text_;
  app::CommandPage tree_;
};

TEST_F(CommandTree, has_what_the_parser_has_without_what_is_hidden) {
  ASSERT_EQ(tree_.commands.size(), 1U);
  const app::CommandPage& go = tree_.commands.front();
  EXPECT_EQ(go.name, "tool go");
  ASSERT_EQ(go.commands.size(), 1U);
  EXPECT_EQ(go.commands.front().name, "tool go near");
  ASSERT_EQ(go.options.size(), 6U);
  EXPECT_EQ(go.options[0].names, (std::vector<std::string>{"-h", "--help"}));
  EXPECT_EQ(go.options[1].value, "");
  EXPECT_EQ(go.options[2].names, (std::vector<std::string>{"-n", "--number"}));
  EXPECT_EQ(go.options[2].value, "INT");
  EXPECT_EQ(go.options[2].default_text, "3");
  EXPECT_EQ(go.options[3].choices, (std::vector<std::string>{"north", "south"}));
  EXPECT_TRUE(go.options[3].required);
  EXPECT_EQ(go.options[4].argument, "WHERE");
  EXPECT_TRUE(go.options[4].names.empty());
  EXPECT_EQ(go.options[5].names, std::vector<std::string>{"--by"}) << "option of a group";
}

TEST_F(CommandTree, makes_a_man_page_of_each_command) {
  const auto pages = app::man_pages(tree_);
  ASSERT_EQ(pages.size(), 3U);
  EXPECT_EQ(pages[0].first, "tool.1");
  EXPECT_EQ(pages[2].first, "tool-go-near.1");
  const std::string& go = pages[1].second;
  EXPECT_EQ(pages[1].first, "tool-go.1");
  EXPECT_NE(go.find("\n\\fBtool go\\fR [OPTIONS] COMMAND WHERE\n"), std::string::npos) << go;
  EXPECT_NE(go.find("\nGo there: 'at once'; back\\eslash\n"), std::string::npos) << go;
  EXPECT_NE(go.find("\\fB\\-n\\fR, \\fB\\-\\-number\\fR INT\n\\&.5 times: as often [3]\n"), std::string::npos)
      << go;
  EXPECT_NE(go.find("\\fB\\-\\-to\\fR north|south\nWhere to (required)\n"), std::string::npos) << go;
}

TEST_F(CommandTree, is_quoted_in_completions_as_shells_want_it) {
  EXPECT_NE(app::bash_completion(tree_).find("\"go --to\") values='north south' ;;"), std::string::npos);
  EXPECT_NE(app::bash_completion(tree_).find(
                "\"go\") commands='near' options='-h --help --fast -n --number --to --by' ;;"),
            std::string::npos)
      << app::bash_completion(tree_);
  EXPECT_NE(app::zsh_completion(tree_).find("'--to[Where to]:TEXT:(north south)'"), std::string::npos);
  EXPECT_NE(app::zsh_completion(tree_).find("'--by[By what\\:who\\]]:TEXT:_files'"), std::string::npos)
      << app::zsh_completion(tree_);
  EXPECT_NE(app::fish_completion(tree_).find("-l to -x -a 'north south' -d 'Where to'"), std::string::npos);
  EXPECT_EQ(app::first_clause("Go there: 'at once'"), "Go there");
  EXPECT_EQ(app::first_clause("In haste [not]"), "In haste");
  for (const std::string& script :
       {app::bash_completion(tree_), app::zsh_completion(tree_), app::fish_completion(tree_)})
    EXPECT_EQ(script.find("hidden"), std::string::npos);
}

}  // namespace
}  // namespace talus::test
