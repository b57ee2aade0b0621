#include "ensemble/paper_beds.h"

#include <fmt/core.h>
#include <span>
#include <utility>

#include "scenario/text.h"

namespace talus::embedded {
// assets/scenarios/paper-*.toml
extern const std::span<const unsigned char> scenario_paper_pbc, scenario_paper_wbc_100,
    scenario_paper_wbc_150, scenario_paper_wbc_200, scenario_paper_wbc_250, scenario_paper_wbc_300;
}  // namespace talus::embedded

namespace talus::ensemble {
namespace {

constexpr double quick_scale = 0.5;  // factor of lengths and depths

std::string setting(const char* key, double value) {
  return fmt::format("{}={}", key, scenario::short_text(value));
}

Variant make_bed(std::string name, const std::string& file, std::span<const unsigned char> bytes, bool quick,
                 std::vector<std::string> settings = {}) {
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (quick) {
    const scenario::Scenario full = scenario::parse_scenario(text, file);
    settings.push_back(setting("bed.length", quick_scale * full.bed.length));
    settings.push_back(setting("bed.depth", quick_scale * full.bed.depth));
  }
  return {std::move(name), file, scenario::parse_scenario(text, file, settings)};
}

}  // namespace

std::vector<Variant> paper_beds(bool quick) {
  const auto periodic = [quick](const char* name, std::vector<std::string> settings) {
    return make_bed(name, "paper-pbc.toml", embedded::scenario_paper_pbc, quick, std::move(settings));
  };
  std::vector<Variant> beds = {periodic("pbc", {}),
                               periodic("pbc-geometric", {"deposition.method=geometric"}),
                               periodic("pbc-collapse", {"deposition.method=collapse"})};
  const std::pair<int, const std::span<const unsigned char>&> walls[] = {
      {100, embedded::scenario_paper_wbc_100},
      {150, embedded::scenario_paper_wbc_150},
      {200, embedded::scenario_paper_wbc_200},
      {250, embedded::scenario_paper_wbc_250},
      {300, embedded::scenario_paper_wbc_300}};
  for (const auto& [length, bytes] : walls)
    beds.push_back(make_bed("wbc-" + scenario::short_text((quick ? quick_scale : 1.0) * length),
                            fmt::format("paper-wbc-{}.toml", length), bytes, quick));
  return beds;
}

}  // namespace talus::ensemble
