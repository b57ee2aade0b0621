#pragma once
/// Themes of the window.

#include <span>
#include <string_view>

namespace talus::view {

enum class Theme {
  light,
  dark,   ///< for dark rooms: the grays of maps are mirrored, so that black becomes bright
  print,  ///< journal style: white background, black text, nothing filled with gray
};

/// Returns all themes in the order in which they are offered.
std::span<const Theme> themes();
/// Returns "light", "dark" or "print".
std::string_view theme_name(Theme theme);
/// Returns the theme of that name. Throws Error(usage) with the valid names.
Theme theme_of(std::string_view name);
/// Returns the next theme; the first follows the last.
Theme next_theme(Theme theme);

}  // namespace talus::view
