#pragma once
/// The themes of the window.

#include <span>
#include <string_view>

namespace talus::view {

enum class Theme {
  light,
  dark,   ///< for dark rooms: grays of maps are mirrored, so that what was black shines
  print,  ///< what a journal prints: white, black text, nothing filled with gray
};

/// All of them, in the order in which they are offered.
std::span<const Theme> themes();
/// "light", "dark", "print".
std::string_view theme_name(Theme theme);
/// The theme of that name. Throws Error(usage) with the names that there are.
Theme theme_of(std::string_view name);
/// The one after it, and the first after the last.
Theme next_theme(Theme theme);

}  // namespace talus::view
