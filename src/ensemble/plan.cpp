#include "ensemble/plan.h"

#include <charconv>
#include <filesystem>
#include <fmt/core.h>
#include <limits>
#include <set>

#include "base/errors.h"
#include "base/visible_text.h"
#include "session/estimate.h"

namespace talus::ensemble {
namespace {

constexpr std::size_t max_seeds = 10000;
constexpr std::uint64_t largest_seed = std::numeric_limits<std::int64_t>::max();  // largest TOML integer

[[noreturn]] void refuse_seeds(const std::string& text) {
  throw Error(ExitCode::usage, fmt::format("--seeds {}: expected seeds such as 1-4, 7 or 1-3,8, at most {}, "
                                           "none above {}",
                                           visible_word(text), max_seeds, largest_seed));
}

std::uint64_t parse_seed(const std::string& part, const std::string& text) {
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), seed);
  if (error != std::errc() || end != part.data() + part.size() || seed > largest_seed) refuse_seeds(text);
  return seed;
}

}  // namespace

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
    end = text.find(separator, begin);
    parts.push_back(text.substr(begin, end == std::string::npos ? end : end - begin));
  }
  return parts;
}

std::vector<std::uint64_t> parse_seeds(const std::string& text) {
  std::set<std::uint64_t> seeds;
  for (const std::string& part : split(text, ',')) {
    const std::size_t dash = part.find('-');
    const std::uint64_t first = parse_seed(part.substr(0, dash), text);
    const std::uint64_t last = dash == std::string::npos ? first : parse_seed(part.substr(dash + 1), text);
    if (last < first || last - first >= max_seeds) refuse_seeds(text);
    for (std::uint64_t k = 0; k <= last - first; ++k) seeds.insert(first + k);
    if (seeds.size() > max_seeds) refuse_seeds(text);
  }
  return {seeds.begin(), seeds.end()};
}

EnsemblePlan plan_ensemble(std::vector<std::uint64_t> seeds, std::vector<Variant> variants,
                           const std::string& folder) {
  EnsemblePlan plan{std::move(seeds), std::move(variants), {}};
  for (const std::uint64_t seed : plan.seeds)
    for (std::size_t v = 0; v < plan.variants.size(); ++v) {
      const std::string& parent = plan.variants[v].name;
      const std::string name = fmt::format("{}seed-{}", parent.empty() ? "" : parent + "/", seed);
      const std::string path = (std::filesystem::path(folder) / (name + ".h5")).string();
      plan.members.push_back({v, seed, name, path, plan.variants[v].scenario, plan.variants[v].origin});
      plan.members.back().scenario.seed = seed;
    }
  return plan;
}

std::vector<double> estimated_seconds(const EnsemblePlan& plan) {
  std::vector<double> seconds;
  for (const Variant& variant : plan.variants) {
    seconds.push_back(0.0);
    try {
      seconds.back() = session::estimate(variant.scenario).seconds;
    } catch (const Error&) {
      continue;  // one bad variant, such as one whose bed file is missing, must not stop the others
    }
  }
  return seconds;
}

std::string path_with_extension(const std::string& path, const char* ending) {
  return std::filesystem::path(path).replace_extension(ending).string();
}

}  // namespace talus::ensemble
