/// What a run computes has the same bits on every processor: + - * / and square roots, and what rounds
/// exactly. The C library's sines, powers and the like are not of that kind (docs/architecture.md,
/// Determinism).

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "unit/house/source_tree.h"

namespace talus::house {
namespace {

/// The rooms of which nothing but a run is made, and the files of others through which its state or what it
/// records goes.
const std::vector<std::string> of_a_run = {
    "src/base/",
    "src/core/",
    "src/contact/",
    "src/solver/",
    "src/dynamics/",
    "src/stress/bed",
    "src/stress/free_surface",
    "src/stress/internal_moment",
    "src/session/command",
    "src/session/deposition",
    "src/session/drop",
    "src/session/drag",
    "src/session/frame_state",
    "src/session/guards",
    "src/session/measure",
    "src/session/perturbation.",
    "src/session/schedule",
    "src/session/session",
};

/// Of <cmath>: what may differ from one processor, C library or compiler to another.
const std::vector<std::string_view> inexact = {
    "sin",   "cos",   "tan",   "asin", "acos", "atan",  "atan2", "sinh",   "cosh",   "tanh",
    "asinh", "acosh", "atanh", "exp",  "exp2", "expm1", "log",   "log2",   "log10",  "log1p",
    "pow",   "cbrt",  "hypot", "fma",  "lerp", "erf",   "erfc",  "tgamma", "lgamma", "sincos",
};

/// The line without its comment and without what it quotes.
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
          ADD_FAILURE() << place(file, i) << "\n  other processors give other bits";
    }
  }
  EXPECT_TRUE(unseen.empty()) << unseen.front() << ": no such file";
}

}  // namespace
}  // namespace talus::house
