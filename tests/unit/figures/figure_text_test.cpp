#include "app/figure_text.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/hash.h"
#include "unit/figures/example_figure_run.h"

namespace talus::figures {
namespace {

Figure example_figure() {
  Figure figure;
  figure.name = "fig04-shear-stress";
  figure.title = "A title";
  figure.caption = "A \"caption\"";
  figure.height_over_width = 0.5;
  figure.tables = {
      {"", {{"theta", "deg", "tilt", {0.0, 0.1 + 0.2}}, {"p_o", "1", "share", {std::nan(""), -1.0}}}},
      {"paper", {{"theta", "deg", "tilt", {}}}}};
  figure.variables = {{"gamma_c", "0.25"}, {"label_1", "'PBC'"}};
  return figure;
}

TEST(CsvText, HasNamesThenAllDigits) {
  EXPECT_EQ(app::csv_text(example_figure().tables[0]), "theta,p_o\n0,NaN\n0.30000000000000004,-1\n");
  EXPECT_EQ(app::csv_text(example_figure().tables[1]), "theta\n");
}

TEST(CsvText, HasAnEmptyLineBetweenBlocks) {
  const Table table = {"", {{"seed", "1", "", {1, 1, 2, 3}}, {"x", "1", "", {5, 6, 7, 8}}}, true};
  EXPECT_EQ(app::csv_text(table), "seed,x\n1,5\n1,6\n\n2,7\n\n3,8\n");
}

TEST(GnuplotText, HasVariablesThenStyleThenScript) {
  const std::string text = app::gnuplot_text(example_figure(), {8.6, 5.0});
  const auto at = [&text](const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
    return text.find(part);
  };
  EXPECT_LT(at("figure = \"fig04-shear-stress\"\nwidth = 8.6  # cm\nheight = 4.3\nasked_height = 5  # cm"),
            at("gamma_c = 0.25\n"));
  EXPECT_LT(at("label_1 = 'PBC'\n"), at("set terminal pdfcairo"));
  EXPECT_LT(at("set terminal pdfcairo"), at("x_title = \"tan"));
  EXPECT_TRUE(text.ends_with("\nunset output\npass = pass + 1\nif (pass <= 3) load figure . \".gp\"\n"));
}

TEST(FigureWidth, IsThatOfOneOrTwoColumnsUnlessItIsAskedFor) {
  Figure figure = example_figure();
  EXPECT_EQ(app::figure_width(figure, {}), 8.6);
  EXPECT_EQ(app::figure_width(figure, {12.0, 0.0}), 12.0);
  figure.wide = true;
  EXPECT_EQ(app::figure_width(figure, {}), 17.8);
  EXPECT_EQ(app::figure_width(figure, {0.0, 9.0}), 17.8);
}

TEST(ProvenanceJson, NamesRunsAndColumns) {
  const test::TemporaryFolder folder;
  const std::string used = folder.path("used.h5"), unused = folder.path("unused.h5");
  for (const std::string& path : {used, unused}) example::store_with_commits(path, 1);
  std::vector<RunGroup> groups(1);
  groups[0].label = "PBC, L = 200 D";
  groups[0].runs.push_back(example::figure_run(used, 7));
  groups[0].runs.push_back(example::figure_run(unused, 8));
  groups[0].runs[0].analysis.parameters = {{"lc_cut", "30"}};
  Figure figure = example_figure();
  figure.runs = {used};
  const std::string text = app::provenance_json(figure, groups, "talus figures a.h5");
  for (const std::string& part :
       {std::string("\"caption\": \"A \\\"caption\\\"\""), std::string("\"command\": \"talus figures a.h5\""),
        "\"path\": \"" + used + "\"", std::string("\"seed\": 7"), std::string("\"lc_cut\": \"30\""),
        std::string("\"group\": \"PBC, L = 200 D\""), std::string("\"file\": \"fig04-shear-stress.csv\""),
        std::string("\"file\": \"fig04-shear-stress-paper.csv\""), std::string("\"name\": \"p_o\""),
        std::string("\"meaning\": \"share\""),
        "\"state_hash\": \"" + hash_text(state_hash(groups[0].runs[0].file->checkpoint().world)) + "\""})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  EXPECT_EQ(text.find(unused), std::string::npos) << "the figure does not use it";
}

}  // namespace
}  // namespace talus::figures
