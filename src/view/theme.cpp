#include "view/theme.h"

#include <algorithm>
#include <array>
#include <fmt/core.h>

#include "base/errors.h"
#include "base/visible_text.h"

namespace talus::view {
namespace {

constexpr std::array all_themes = {Theme::light, Theme::dark, Theme::print};

}  // namespace

std::span<const Theme> themes() { return all_themes; }

std::string_view theme_name(Theme theme) {
  switch (theme) {
    case Theme::light:
      return "light";
    case Theme::dark:
      return "dark";
    case Theme::print:
      return "print";
  }
  throw Error(ExitCode::internal, "unknown theme");
}

Theme theme_of(std::string_view name) {
  const auto found = std::ranges::find(all_themes, name, theme_name);
  if (found != all_themes.end()) return *found;
  throw Error(ExitCode::usage,
              fmt::format("theme {}: expected light, dark or print", visible_word(std::string(name))));
}

Theme next_theme(Theme theme) {
  const auto at = std::ranges::find(all_themes, theme) - all_themes.begin();
  return all_themes[static_cast<std::size_t>(at + 1) % all_themes.size()];
}

}  // namespace talus::view
