#pragma once
/// The gnuplot scripts of assets/figures, embedded in the program.

#include <string_view>
#include <vector>

namespace talus::figures {

/// Returns assets/figures/NAME.gp. Throws Error(internal) if it does not exist.
std::string_view figure_script(std::string_view name);

/// Returns the names of all scripts, sorted.
std::vector<std::string_view> figure_scripts();

}  // namespace talus::figures
