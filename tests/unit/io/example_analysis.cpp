#include "unit/io/example_analysis.h"

#include "core/hash.h"

namespace talus::example {

std::string analysed_state() { return hash_text(state_hash(checkpoint(analysis_commits - 1).world)); }

Analysis analysis(std::uint64_t thresholds, int serial) {
  Analysis analysis = make_analysis({{'T', 3}, {'N', grain_count}, {'F', thresholds}, {'X', 5}, {'B', 4}});
  analysis.key = hash_text(static_cast<std::uint64_t>(serial));
  analysis.parameters = {{"threshold_factors", "1,2"},
                         {"gamma_c", "run"},
                         {"lc_cut", "depth"},
                         {"averaging", "0"},
                         {"bins", "4"}};
  int next = 1000 * serial;
  for (auto& [name, array] : analysis.data_sets)
    std::visit(
        [&](auto& numbers) {
          // The first element keeps what it was made with: NaN, of a number that may be none.
          for (std::size_t i = 1; i < numbers.size(); ++i)
            numbers[i] = static_cast<std::decay_t<decltype(numbers[i])>>(next++);
        },
        array);
  return analysis;
}

}  // namespace talus::example
