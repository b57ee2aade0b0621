/// Figures and scripts correspond one to one, and their names agree everywhere.

#include "figures/catalogue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "base/errors.h"
#include "figures/scripts.h"
#include "support/places.h"

namespace talus::figures {
namespace {

/// Scripts without a figure in the catalogue: common parts, and plots of the window.
const std::set<std::string_view> others = {"style", "text", "axes", "key", "maps", "plot"};

/// Figures that are panels of maps, drawn by the renderer.
const std::set<std::string_view> panels = {"fig10-stress-ratio-maps", "fig13-overloaded-maps"};

TEST(Catalogue, EachFigureHasItsScriptOrIsAPanelOfMaps) {
  for (const FigureRecipe& recipe : figure_catalogue()) {
    if (panels.contains(recipe.name))
      EXPECT_THROW(figure_script(recipe.name), Error);
    else
      EXPECT_NO_THROW(figure_script(recipe.name)) << recipe.name;
    EXPECT_FALSE(recipe.title.empty() || recipe.needs.empty()) << recipe.name;
  }
}

TEST(Catalogue, EachScriptHasItsFigure) {
  for (const std::string_view script : figure_scripts())
    EXPECT_TRUE(others.contains(script) || std::ranges::find(figure_catalogue(), script,
                                                             &FigureRecipe::name) != figure_catalogue().end())
        << script;
}

TEST(Catalogue, NamesAreUniqueAndThePapersFiguresComeFirst) {
  std::set<std::string_view> names;
  bool of_the_paper = true;
  for (const FigureRecipe& recipe : figure_catalogue()) {
    EXPECT_TRUE(names.insert(recipe.name).second) << recipe.name;
    const bool numbered = recipe.name.starts_with("fig");
    EXPECT_TRUE(of_the_paper || !numbered) << recipe.name;
    of_the_paper = numbered;
  }
}

TEST(Catalogue, NoFigureIsMadeOfNoRuns) {
  for (const FigureRecipe& recipe : figure_catalogue()) EXPECT_FALSE(recipe.make({})) << recipe.name;
}

TEST(Catalogue, IsThatOfItsPage) {
  std::ifstream file(test::source_folder() + "/docs/figures.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  for (const FigureRecipe& recipe : figure_catalogue()) {
    const std::size_t row = page.find("| `" + std::string(recipe.name) + "` |");
    ASSERT_NE(row, std::string::npos) << recipe.name;
    const bool is_marked = page.substr(row, page.find('\n', row) - row).ends_with(" * |");
    EXPECT_EQ(is_marked, recipe.material == Material::values) << recipe.name;
  }
}

}  // namespace
}  // namespace talus::figures
