#include "ensemble/member_numbers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <variant>

#include "analysis/quantities.h"
#include "core/errors.h"
#include "core/hash.h"
#include "core/paths.h"
#include "core/snapshot.h"
#include "core/text_stream.h"
#include "core/trigonometry.h"
#include "core/visible_text.h"
#include "ensemble/member_state.h"
#include "io/durable_file.h"
#include "scenario/text.h"
#include "session/run_header.h"

namespace talus {
namespace {

constexpr const char* header = "quantity,unit,value";

/// What a run finds by itself, without an analysis.
constexpr const char* angle_at_rest = "theta_r";
constexpr std::array<const char*, 2> counted_steps = {"unconverged_steps_deposition", "unconverged_steps"};

void add_numbers(std::vector<NamedNumber>& numbers, const Quantity& quantity, const Analysis& analysis,
                 double mean_diameter) {
  const Values values = values_of(quantity, analysis);
  const auto* doubles = std::get_if<std::vector<double>>(&values);
  if (doubles == nullptr) return;
  for (std::size_t k = 0; k < doubles->size(); ++k)
    numbers.push_back({element_name(quantity.name, k), scaled_unit(quantity.unit),
                       scaled(quantity.unit, (*doubles)[k], mean_diameter)});
}

std::string hash_of_file(const std::string& path) { return hash_text(hash_bytes(read_file(path))); }

/// "seed 3, scenario 8f62...": what a table says of its member.
std::string owner_text(const std::optional<std::uint64_t>& seed, const MemberOrigin& origin) {
  std::string text = seed ? fmt::format("seed {}", *seed) : std::string("a seed");
  if (!origin.scenario.empty()) text += ", scenario " + visible_word(origin.scenario);
  if (!origin.bed.empty()) text += ", bed " + visible_word(origin.bed);
  return text;
}

bool may_be_same(const std::string& left, const std::string& right) {
  return left.empty() || right.empty() || left == right;
}

double result(const Figures& figures, const std::string& name) {
  for (const auto& [key, value] : figures)
    if (key == name) return value;
  return not_known;
}

std::uint64_t parse_seed(const std::string& text, const std::string& path) {
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (error != std::errc() || end != text.data() + text.size()) refuse_table(path);
  return seed;
}

}  // namespace

void refuse_table(const std::string& path) {
  throw Error(ExitCode::bad_data, path +
                                      " is not what talus wrote; remove it and the member is analysed again, "
                                      "or computed again if its run "
                                      "was not kept");
}

double parse_cell(const std::string& text, const std::string& path) {
  if (text.empty()) return not_known;
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) refuse_table(path);
  return value;
}

std::string element_name(const std::string& name, std::size_t k) {
  return k == 0 ? name : fmt::format("{}[{}]", name, k);
}

MemberNumbers member_numbers(const RunFile& run, const Analysis& analysis) {
  const Checkpoint& end = run.checkpoint();
  MemberNumbers found{hash_text(state_hash(end.world)),
                      version_of(run.header().provenance),
                      result(end.timing, "deposition") + result(end.timing, "tilt"),
                      {}};
  for (const Quantity& quantity : quantities())
    if (is_number_of_run(quantity))
      add_numbers(found.numbers, quantity, analysis, run.header().statics.mean_diameter);
  found.numbers.push_back({angle_at_rest, "deg", degrees(result(end.results, angle_at_rest))});
  for (const char* name : counted_steps) found.numbers.push_back({name, "1", result(end.results, name)});
  return found;
}

void sign(MemberNumbers& numbers, const Member& member, const std::vector<std::string>& endings) {
  numbers.seed = member.seed;
  numbers.origin = member.origin;
  numbers.files.clear();
  for (const std::string& ending : endings)
    if (const std::string file = file_beside(member.path, ending.c_str()); is_there(file))
      numbers.files.emplace_back(ending, hash_of_file(file));
}

MemberNumbers read_numbers(const Member& member) {
  const std::string path = numbers_path(member.path);
  MemberNumbers found = parse_numbers(read_text(path), path);
  if (found.seed.value_or(member.seed) == member.seed &&
      may_be_same(found.origin.scenario, member.origin.scenario) &&
      may_be_same(found.origin.bed, member.origin.bed))
    return found;
  throw Error(
      ExitCode::bad_data,
      fmt::format("{} is the table of another member ({}), expected that of {}; remove it, and talus "
                  "ensemble analyses the member again, or computes it again if its run is not there",
                  path, owner_text(found.seed, found.origin), owner_text(member.seed, member.origin)));
}

void require_own_file(const Member& member, const MemberNumbers& numbers, const std::string& ending) {
  const std::optional<std::string> hash = find_value(numbers.files, ending);
  const std::string path = file_beside(member.path, ending.c_str());
  if (!hash || !is_there(path) || *hash == hash_of_file(path)) return;
  const std::string table = numbers_path(member.path);
  throw Error(
      ExitCode::bad_data,
      fmt::format("{} is not the file that {} was written with; remove both, and talus ensemble analyses "
                  "the member again, or computes it again if its run is not there",
                  path, table));
}

std::vector<std::string> numbers_of_run() {
  std::vector<std::string> names;
  for (const Quantity& quantity : quantities())
    if (is_number_of_run(quantity)) names.push_back(quantity.name);
  names.emplace_back(angle_at_rest);
  names.insert(names.end(), counted_steps.begin(), counted_steps.end());
  return names;
}

bool is_number_of_run(const std::string& name) {
  const std::vector<std::string> names = numbers_of_run();
  const std::size_t bracket = std::min(name.find('['), name.size());
  const std::string element = name.substr(bracket);  // "[1]"
  const std::size_t digits = element.find_first_not_of("0123456789", 1);
  const bool is_element =
      element.empty() || (digits != std::string::npos && digits > 1 && element.substr(digits) == "]");
  return is_element && std::ranges::find(names, name.substr(0, bracket)) != names.end();
}

std::string numbers_csv(const MemberNumbers& numbers) {
  std::string text = fmt::format("{}\nstate_hash,,{}\nversion,,{}\nseconds,s,{}\n", header,
                                 numbers.state_hash, numbers.version, short_text(numbers.seconds));
  if (numbers.seed) text += fmt::format("seed,,{}\n", *numbers.seed);
  if (!numbers.origin.scenario.empty()) text += fmt::format("scenario,,{}\n", numbers.origin.scenario);
  if (!numbers.origin.bed.empty()) text += fmt::format("bed,,{}\n", numbers.origin.bed);
  for (const auto& [ending, hash] : numbers.files) text += fmt::format("{},,{}\n", ending, hash);
  for (const NamedNumber& number : numbers.numbers)
    text += fmt::format("{},{},{}\n", number.name, number.unit,
                        std::isnan(number.value) ? "" : short_text(number.value));
  return text;
}

MemberNumbers parse_numbers(const std::string& text, const std::string& path) {
  std::istringstream lines = text_stream(text);
  std::string line;
  if (!std::getline(lines, line) || line != header) refuse_table(path);
  MemberNumbers found;
  while (std::getline(lines, line)) {
    const std::vector<std::string> cells = split(line, ',');
    if (cells.size() != 3) refuse_table(path);
    if (cells[0] == "state_hash")
      found.state_hash = cells[2];
    else if (cells[0] == "version")
      found.version = cells[2];
    else if (cells[0] == "seconds")
      found.seconds = parse_cell(cells[2], path);
    else if (cells[0] == "seed")
      found.seed = parse_seed(cells[2], path);
    else if (cells[0] == "scenario")
      found.origin.scenario = cells[2];
    else if (cells[0] == "bed")
      found.origin.bed = cells[2];
    else if (cells[0].starts_with('.'))
      found.files.emplace_back(cells[0], cells[2]);
    else
      found.numbers.push_back({cells[0], cells[1], parse_cell(cells[2], path)});
  }
  if (found.state_hash.empty() || found.numbers.empty()) refuse_table(path);
  return found;
}

double number_called(const MemberNumbers& numbers, const std::string& name) {
  const auto found = std::ranges::find(numbers.numbers, name, &NamedNumber::name);
  return found == numbers.numbers.end() ? not_known : found->value;
}

}  // namespace talus
