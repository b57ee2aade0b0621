#pragma once
/// What one member of an ensemble gave: every number that there is once for a run, in a small table beside
/// it.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/record.h"
#include "ensemble/plan.h"
#include "io/run_file.h"

namespace talus {

struct NamedNumber {
  std::string name;  ///< "theta_c", "theta_d/lc_jump[1]": element 1, of those with several
  std::string unit;  ///< of tables: deg, D, ...
  double value = 0.0;
};

struct MemberNumbers {
  std::string state_hash;
  std::string version;   ///< of the Talus that computed it, with its git hash
  double seconds = 0.0;  ///< of its steps
  std::vector<NamedNumber> numbers;
  // Whose they are; tables of earlier versions do not say it.
  std::optional<std::uint64_t> seed = {};
  MemberOrigin origin = {};
  std::vector<std::pair<std::string, std::string>> files = {};  ///< ".series.csv": hash of the file beside
};

/// All numbers of a complete run and its analysis, in the order of the table of quantities, then what the run
/// found by itself (theta_r).
MemberNumbers member_numbers(const RunFile& run, const Analysis& analysis);

/// Notes whose numbers they are, and the hashes of the files with these endings beside the run, of those that
/// are there.
void sign(MemberNumbers& numbers, const Member& member, const std::vector<std::string>& endings);

/// The numbers of a member that is done. Throws Error(bad_data) where they are those of another seed,
/// scenario or bed, and as parse_numbers does.
MemberNumbers read_numbers(const Member& member);

/// Throws Error(bad_data) where the file with this ending beside the run of a member is another one than when
/// its numbers were written.
void require_own_file(const Member& member, const MemberNumbers& numbers, const std::string& ending);

/// The names that members have numbers of, the first of each: "theta_d/dilation", not "theta_d/dilation[1]".
std::vector<std::string> numbers_of_run();

/// Whether it is one of these names, or a further one of it ("theta_d/dilation[1]").
bool is_number_of_run(const std::string& name);

/// CSV: name, unit, value in full digits.
std::string numbers_csv(const MemberNumbers& numbers);

/// Throws Error(bad_data), naming `path`, where the text is not what numbers_csv writes.
MemberNumbers parse_numbers(const std::string& text, const std::string& path);

/// NaN where there is no such number.
double number_called(const MemberNumbers& numbers, const std::string& name);

/// "theta_d/lc_jump[1]": element k of what has several; element 0 has the plain name.
std::string element_name(const std::string& name, std::size_t k);

/// A cell of a table beside a run; NaN where it is empty. Throws as refuse_table does.
double parse_cell(const std::string& text, const std::string& path);

/// Throws Error(bad_data): the table at `path` has been changed.
[[noreturn]] void refuse_table(const std::string& path);

}  // namespace talus
