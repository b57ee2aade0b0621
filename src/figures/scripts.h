#pragma once
/// The gnuplot scripts of assets/figures, which are part of the binary.

#include <string_view>
#include <vector>

namespace talus::figures {

/// assets/figures/NAME.gp. Throws Error(internal) where there is none.
std::string_view figure_script(std::string_view name);

/// The names of all of them, sorted.
std::vector<std::string_view> figure_scripts();

}  // namespace talus::figures
