#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "analysis/quantities.h"
#include "figures/group_table.h"
#include "figures/recipes.h"
#include "figures/run_means.h"

namespace talus::figures {
namespace {

constexpr double same_angle = 1e-4;  // deg, far below the spacing of frames
constexpr double row_height = 4.2 / 17.8;
constexpr std::size_t panels_in_row = 3;

/// Returns the quantities shown, as columns in the unit of curves.
std::vector<FrameColumn> shown_columns() {
  std::vector<FrameColumn> columns;
  for (const analysis::Quantity& quantity : analysis::quantities()) {
    if (!analysis::is_number_of_frame(quantity) || quantity.display.title.empty()) continue;
    columns.push_back({quantity.name, quantity.display.percent ? "%" : analysis::scaled_unit(quantity.unit),
                       quantity.definition,
                       [quantity](const runs::RunView& run, std::size_t frame) {
                         return analysis::shown(quantity,
                                                analysis::number_of(quantity, run.analysis.frames.at(frame)),
                                                run.statics.mean_diameter);
                       },
                       analysis::has_side(quantity)});
  }
  return columns;
}

std::string title_of(const std::string& name) {
  return analysis::shown_title(*std::ranges::find(analysis::quantities(), name, &analysis::Quantity::name));
}

/// Whether a quantity is a share. Its axis ends at 1, or 100 %, although a band may extend beyond.
bool is_share(const std::string& name) {
  const analysis::Quantity& quantity =
      *std::ranges::find(analysis::quantities(), name, &analysis::Quantity::name);
  return quantity.unit == "1" && quantity.definition.find("share of") != std::string::npos;
}

const std::vector<double>* find_values(const std::vector<Column>& columns, const std::string& name) {
  const auto found = std::ranges::find(columns, name, &Column::name);
  return found == columns.end() ? nullptr : &found->values;
}

/// Sets a panel for each quantity that has a value in a table.
void set_panels(Figure& figure) {
  std::size_t panels = 0;
  for (const FrameColumn& column : shown_columns()) {
    const bool is_known = std::ranges::any_of(figure.tables, [&](const Table& table) {
      const std::vector<double>* const values = find_values(table.columns, column.name);
      return values != nullptr &&
             std::ranges::any_of(*values, [](double value) { return !std::isnan(value); });
    });
    if (!is_known) continue;
    const std::string k = std::to_string(++panels);
    set_variable(figure, "quantity_" + k, gnuplot_string(column.name));
    set_variable(figure, "title_" + k, gnuplot_string(title_of(column.name)));
    if (is_share(column.name)) set_variable(figure, "top_" + k, column.unit == "%" ? 100.0 : 1.0);
  }
  const std::size_t rows = (panels + panels_in_row - 1) / panels_in_row;
  set_variable(figure, "panels", static_cast<double>(panels));
  set_variable(figure, "rows", static_cast<double>(rows));
  figure.wide = true;
  figure.height_over_width = row_height * static_cast<double>(rows);
}

/// Returns the runs of a group that can be drawn over an abscissa.
RunChoice runs_over(const RunGroup& group, Abscissa abscissa) {
  return abscissa == Abscissa::tilt ? all_runs(group) : failed_runs(group);
}

const char* angle_text(Abscissa abscissa) {
  return abscissa == Abscissa::tilt ? "the tilt theta" : "theta_c - theta, the angle left to failure";
}

/// Adds a panel for each of `columns`, with all groups that have runs over this abscissa.
bool add_panels(Figure& figure, std::span<const RunGroup> groups, const std::vector<FrameColumn>& columns,
                Abscissa abscissa) {
  for (const RunGroup& group : groups)
    if (const RunChoice runs = runs_over(group, abscissa); !runs.empty())
      add_group_curves(figure, group, runs, columns, abscissa);
  if (figure.groups == 0) return false;
  set_panels(figure);
  return true;
}

std::optional<Figure> quantities_over(Figure figure, std::span<const RunGroup> groups, Abscissa abscissa) {
  if (!add_panels(figure, groups, shown_columns(), abscissa)) return std::nullopt;
  figure.caption = fmt::format(
      "Quantities of the packing, of its overloaded grains and of their clusters over {}; at the first "
      "threshold if they depend on one. {}",
      angle_text(abscissa), means_caption);
  return figure;
}

/// Returns pairs of rows of two tables at the same angle.
std::vector<std::pair<std::size_t, std::size_t>> common_rows(const std::vector<double>& first,
                                                             const std::vector<double>& second) {
  std::vector<std::pair<std::size_t, std::size_t>> rows;
  for (std::size_t a = 0, b = 0; a < first.size() && b < second.size();) {
    if (std::abs(first[a] - second[b]) < same_angle) rows.emplace_back(a, b);
    if (first[a] < second[b] + same_angle)
      ++a;
    else
      ++b;
  }
  return rows;
}

/// Returns the angle, then the difference of each quantity and its error.
std::vector<Column> difference_columns(const std::vector<Column>& first, const std::vector<Column>& second) {
  const auto rows = common_rows(first[0].values, second[0].values);
  std::vector<Column> columns = {{first[0].name, first[0].unit, first[0].meaning, {}}};
  for (const auto& [a, b] : rows) columns[0].values.push_back(first[0].values[a]);
  for (const FrameColumn& column : shown_columns()) {
    Column difference{column.name, column.unit, "mean of the second group minus that of the first", {}};
    Column error{
        column.name + "_error", column.unit, "root of the sum of the squares of both standard errors", {}};
    for (const auto& [a, b] : rows) {
      const auto value = [&](const std::vector<Column>& table, const std::string& name, std::size_t row) {
        return (*find_values(table, name))[row];
      };
      difference.values.push_back(value(second, column.name, b) - value(first, column.name, a));
      error.values.push_back(std::hypot(value(second, error.name, b), value(first, error.name, a)));
    }
    columns.push_back(std::move(difference));
    columns.push_back(std::move(error));
  }
  return columns;
}

std::optional<Figure> differences_over(Figure figure, std::span<const RunGroup> groups, Abscissa abscissa) {
  if (groups.size() != 2) return std::nullopt;
  const std::vector<FrameColumn> columns = shown_columns();
  std::vector<std::vector<Column>> means;
  for (const RunGroup& group : groups) {
    const RunChoice runs = runs_over(group, abscissa);
    if (runs.empty()) return std::nullopt;
    means.push_back(means_over_runs(runs, columns, abscissa));
    for (const runs::RunView* run : runs) figure.runs.push_back(run->path);
  }
  figure.tables.push_back({"", difference_columns(means[0], means[1])});
  if (figure.tables[0].columns[0].values.empty()) return std::nullopt;
  const std::string label = fmt::format("{} − {}", groups[1].label, groups[0].label);
  set_variable(figure, "label", gnuplot_quoted(label));
  set_variable(figure, "theta_max", figure.tables[0].columns[0].values.back());
  set_panels(figure);
  figure.caption = fmt::format(
      "Difference of the means of two groups of runs over {}, {} minus {}, at the angles that both have, as "
      "long as at least half of the runs of each have not failed; at the first threshold if they depend on "
      "one. The dark band is the standard error of the difference, the root of the sum of the squares of "
      "both standard errors, the light one twice that; there are no bands if a group has a single run.",
      angle_text(abscissa), groups[1].label, groups[0].label);
  return figure;
}

/// Returns an empty figure with a name and a title.
Figure titled(const char* name, const char* title) {
  Figure figure;
  figure.name = name;
  figure.title = title;
  return figure;
}

}  // namespace

std::optional<Figure> quantities_over_tilt(std::span<const RunGroup> groups) {
  return quantities_over(titled("over-tilt", "Quantities of the analysis over tilt"), groups, Abscissa::tilt);
}

std::optional<Figure> quantities_before_failure(std::span<const RunGroup> groups) {
  return quantities_over(
      titled("before-failure", "Quantities of the analysis over the angle left to failure"), groups,
      Abscissa::angle_left);
}

std::optional<Figure> precursors_figure(std::span<const RunGroup> groups) {
  const analysis::QuantityMember shown_here[] = {
      &analysis::FrameRecord::critical_share,  &analysis::FrameRecord::critical_share_of_bound,
      &analysis::FrameRecord::critical_mean,   &analysis::FrameRecord::texture_contacts,
      &analysis::FrameRecord::rigid_redundant, &analysis::FrameRecord::rigid_largest_share};
  std::vector<FrameColumn> columns = shown_columns();
  std::erase_if(columns, [&](const FrameColumn& column) {
    return std::ranges::none_of(shown_here, [&](const analysis::QuantityMember& member) {
      return analysis::quantity_of(member).name == column.name;
    });
  });
  Figure figure = titled("precursors", "What precedes failure in the contacts");
  if (!add_panels(figure, groups, columns, Abscissa::angle_left)) return std::nullopt;
  figure.caption = fmt::format(
      "Share of the contacts whose friction is fully mobilised (critical contacts), this share over the "
      "largest that equilibrium allows, and the mean number of contacts in their clusters; anisotropy of the "
      "contacts; redundant constraints and largest cluster of the network as a frictional rigid structure: "
      "over {}. {}",
      angle_text(Abscissa::angle_left), means_caption);
  return figure;
}

std::optional<Figure> differences_over_tilt(std::span<const RunGroup> groups) {
  return differences_over(titled("difference-over-tilt", "Difference of two groups of runs over tilt"),
                          groups, Abscissa::tilt);
}

std::optional<Figure> differences_before_failure(std::span<const RunGroup> groups) {
  return differences_over(
      titled("difference-before-failure", "Difference of two groups of runs over the angle left to failure"),
      groups, Abscissa::angle_left);
}

}  // namespace talus::figures
