#include "unit/io/example_analysis.h"

#include "base/hash.h"
#include "support/blank_analysis.h"

namespace talus::example {

std::string analysed_state() { return hash_text(state_hash(checkpoint(analysis_commits - 1).world)); }

analysis::Analysis analysis(std::uint64_t thresholds, int serial) {
  analysis::Analysis analysis = test::blank_analysis({.frames = 3,
                                                      .thresholds = thresholds,
                                                      .grains = grain_count,
                                                      .sections = 5,
                                                      .bins = 4,
                                                      .events = 2 * thresholds});
  analysis.key = hash_text(static_cast<std::uint64_t>(serial));
  analysis.parameters = {{"threshold_factors", "1,2"},
                         {"gamma_c", "run"},
                         {"lc_cut", "depth"},
                         {"averaging", "0"},
                         {"bins", "4"}};
  int next = 1000 * serial;
  for (const analysis::Quantity& quantity : analysis::quantities()) {
    if (!io::is_present(quantity, analysis)) continue;
    analysis::Values values = analysis::values_of(quantity, analysis);
    std::visit(
        [&]<typename T>(std::vector<T>& numbers) {
          // The first element keeps its initial value, which is NaN for optional numbers.
          for (std::size_t i = 1; i < numbers.size(); ++i) numbers[i] = static_cast<T>(next++);
        },
        values);
    analysis::set_values(quantity, values, analysis);
  }
  return analysis;
}

}  // namespace talus::example
