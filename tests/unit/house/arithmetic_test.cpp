/// A run is bit-identical on every processor: it uses only + - * /, square roots and functions that round
/// exactly. Sines, powers and similar functions of the C library differ (docs/architecture.md, Determinism).

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "unit/house/source_tree.h"

namespace talus::house {
namespace {

/// Folders that only serve runs, and files in other folders that handle a run's state or its records.
const std::vector<std::string> of_a_run = {
    "src/base/",
    "src/core/",
    "src/contact/",
    "src/solver/",
    "src/dynamics/",
    "src/stress/bed",
    "src/stress/free_surface",
    "src/session/command",
    "src/session/deposition",
    "src/session/frame_state",
    "src/session/measure",
    "src/session/schedule",
    "src/session/session",
};

/// Functions of <cmath> whose results may depend on the processor, the C library or the compiler.
const std::vector<std::string_view> inexact = {
    "sin",   "cos",   "tan",   "asin", "acos", "atan",  "atan2", "sinh",   "cosh",   "tanh",
    "asinh", "acosh", "atanh", "exp",  "exp2", "expm1", "log",   "log2",   "log10",  "log1p",
    "pow",   "cbrt",  "hypot", "fma",  "lerp", "erf",   "erfc",  "tgamma", "lgamma", "sincos",
};

/// Returns the line without comments and quoted text.
std::string code_of(std::string_view line) {
  line = line.substr(0, line.find("//"));
  std::string code;
  bool quoted = false;
  for (char c : line) {
    if (c == '"') quoted = !quoted;
    if (!quoted) code += c;
  }
  return code;
}

TEST(Arithmetic, of_a_run_is_that_of_every_processor) {
  std::vector<std::string> unseen = of_a_run;
  for (const TextFile& file : read_texts({"src"})) {
    const auto part =
        std::ranges::find_if(of_a_run, [&](const std::string& p) { return file.path.starts_with(p); });
    if (part == of_a_run.end() || !is_source(file)) continue;
    std::erase(unseen, *part);
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      const std::string code = code_of(file.lines[i]);
      for (std::string_view function : inexact)
        if (has_word(code, function))
          ADD_FAILURE() << place(file, i) << "\n  other processors give different bits";
    }
  }
  EXPECT_TRUE(unseen.empty()) << unseen.front() << ": no such file";
}

}  // namespace
}  // namespace talus::house
