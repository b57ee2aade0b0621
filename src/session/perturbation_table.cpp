#include "session/perturbation_table.h"

#include <array>
#include <charconv>
#include <fmt/core.h>

#include "core/errors.h"
#include "core/text_stream.h"
#include "core/visible_text.h"
#include "scenario/text.h"

namespace talus {
namespace {

constexpr std::string_view head =
    "tilt_deg,velocity_over_sqrt_gD,energy_over_mgD,end,time_over_sqrt_D_over_g,moved,displacement_over_D";
constexpr std::size_t column_count = 7;

std::string plan_line(const PerturbationTable& table) {
  return fmt::format("# talus perturb {}{}", plan_text(table.plan),
                     table.complete ? ": complete" : ": under way");
}

bool read_number(std::string_view text, auto& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

bool read_end(std::string_view text, TrialEnd& end) {
  for (const TrialEnd known : {TrialEnd::rest, TrialEnd::avalanche, TrialEnd::undecided})
    if (text == name_of(known)) {
      end = known;
      return true;
    }
  return false;
}

bool read_row(const std::string& line, double& tilt, Trial& trial) {
  std::array<std::string, column_count> cells;
  std::istringstream text = text_stream(line);
  for (std::string& cell : cells)
    if (!std::getline(text, cell, ',')) return false;
  return read_number(cells[0], tilt) && read_number(cells[1], trial.strength) &&
         read_number(cells[2], trial.energy) && read_end(cells[3], trial.end) &&
         read_number(cells[4], trial.time) && read_number(cells[5], trial.moved) &&
         read_number(cells[6], trial.displacement) && text.peek() == EOF;
}

std::string row_text(double tilt, const Trial& trial) {
  return fmt::format("{},{},{},{},{},{},{}\n", short_text(tilt), short_text(trial.strength),
                     short_text(trial.energy), name_of(trial.end), short_text(trial.time), trial.moved,
                     short_text(trial.displacement));
}

}  // namespace

std::string patch_text(const SurfacePatch& patch) {
  return fmt::format("{}x{}", short_text(patch.width), short_text(patch.depth));
}

std::optional<SurfacePatch> parse_patch(const std::string& text) {
  const std::size_t cross = text.find('x');
  SurfacePatch patch;
  if (cross == std::string::npos || !read_number(std::string_view(text).substr(0, cross), patch.width) ||
      !read_number(std::string_view(text).substr(cross + 1), patch.depth))
    return std::nullopt;
  const bool usable = patch.width > 0.0 && patch.width < 1e6 && patch.depth > 0.0 && patch.depth < 1e6;
  return usable ? std::optional(patch) : std::nullopt;
}

std::string plan_text(const PerturbationPlan& plan) {
  return fmt::format("--from {} --every {} --patch {}", short_text(plan.first), short_text(plan.every),
                     patch_text(plan.patch));
}

std::optional<PerturbationPlan> parse_plan(const std::string& text) {
  std::istringstream words = text_stream(text);
  std::string option, first, every, patch;
  words >> option >> first >> option >> every >> option >> patch;
  PerturbationPlan plan;
  const std::optional<SurfacePatch> found = parse_patch(patch);
  if (!found || !read_number(first, plan.first) || !read_number(every, plan.every)) return std::nullopt;
  plan.patch = *found;
  const bool in_range = plan.first >= 0.0 && plan.first <= PerturbationPlan::highest &&
                        plan.every >= PerturbationPlan::least_every &&
                        plan.every <= PerturbationPlan::highest;
  if (!in_range || plan_text(plan) != text) return std::nullopt;
  return plan;
}

std::string perturbation_csv(const PerturbationTable& table) {
  std::string text = fmt::format("{}\n{}\n", plan_line(table), head);
  for (const PerturbedState& state : table.states)
    for (const Trial& trial : state.trials) text += row_text(state.tilt, trial);
  return text;
}

PerturbationTable parse_perturbation_csv(const std::string& text, const std::string& name,
                                         const PerturbationPlan& plan) {
  PerturbationTable table{plan, false, {}};
  const std::string under_way = plan_line(table);
  table.complete = true;
  std::istringstream lines = text_stream(text);
  std::string line;
  std::getline(lines, line);
  if (line != plan_line(table) && line != under_way)
    throw Error(
        ExitCode::bad_data,
        fmt::format(
            "{} begins with '{}', expected '{}': it was made with other settings; give another folder", name,
            visible_word(line, 120), under_way));
  table.complete = line != under_way;
  std::getline(lines, line);
  bool whole = line == head;
  double tilt = 0.0;
  Trial trial;
  while (whole && std::getline(lines, line)) {
    whole = read_row(line, tilt, trial);
    if (table.states.empty() || table.states.back().tilt != tilt) table.states.push_back({tilt, {}});
    table.states.back().trials.push_back(trial);
  }
  if (!whole)
    throw Error(ExitCode::bad_data,
                fmt::format("{}: unexpected line '{}'; remove the file, and its rows are computed again",
                            name, visible_word(line, 120)));
  return table;
}

}  // namespace talus
