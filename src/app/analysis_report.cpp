#include "app/analysis_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>

#include "core/trigonometry.h"
#include "session/analysis_parameters.h"

namespace talus {
namespace {

constexpr std::size_t table_rows = 11;

template <typename... Values>
std::string formatted(const char* format, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

/// A number in a column, "-" where there is none.
std::string cell(const char* format, int width, double value) {
  return formatted("%*s", width, std::isnan(value) ? "-" : formatted(format, value).c_str());
}

std::string degree_text(double angle) { return formatted("%.2f", degrees(angle)); }

/// Frames evenly over the run, the first and the last among them.
std::vector<std::size_t> shown_frames(std::size_t count) {
  std::vector<std::size_t> frames;
  const std::size_t rows = std::min(count, table_rows);
  for (std::size_t r = 0; r < rows; ++r)
    frames.push_back(rows > 1 ? (r * (count - 1) + (rows - 1) / 2) / (rows - 1) : 0);
  return frames;
}

std::string heading(const AnalysedRun& run) {
  const Analysis& analysis = run.analysis;
  const double theta_c = values<double>(analysis, "theta_c")[0];
  const double gamma_c = values<double>(analysis, "gamma_c")[0];
  std::string text = run.path + "  (" + run.state + ")\n" + std::to_string(run.tilts.size()) + " frames, " +
                     degree_text(run.tilts.front()) + " to " + degree_text(run.tilts.back()) + " deg; ";
  text += std::isnan(theta_c) ? "the slope has not failed" : "theta_c = " + degree_text(theta_c) + " deg";
  if (std::isnan(gamma_c))
    return text + ": overloaded grains need a threshold, give one with --set gamma_c=0.3\n";
  const double diameter = run.statics.mean_diameter;
  const double l_min = from_facts(analysis.parameters).l_min;
  text += formatted("; Gamma_c = %.4f; l_c cut at %.4g D\n", gamma_c,
                    values<double>(analysis, "lc/cut")[0] / diameter);
  return text + (l_min > 0.0 ? formatted("gamma of grains with their neighbours, within %.4g D of each\n",
                                         0.5 * l_min)
                             : std::string("gamma of single grains\n"));
}

std::string span_text(const Analysis& analysis, std::size_t k, std::size_t f) {
  const bool depth = row<Index>(analysis, "clusters/spans_depth", k)[f] != 0;
  const bool length = row<Index>(analysis, "clusters/spans_length", k)[f] != 0;
  return std::string(depth ? "H" : "") + (length ? "L" : depth ? "" : "-");
}

std::string threshold_cells(const AnalysedRun& run, std::size_t k, std::size_t f) {
  const auto value = [&](const char* name) { return row<double>(run.analysis, name, k)[f]; };
  const double diameter = run.statics.mean_diameter;
  return " |" + cell("%.3f", 7, value("overloaded/fraction")) + cell("%.2f", 7, value("lc/mean") / diameter) +
         cell("%.1f", 7, value("lc/max") / diameter) + cell("%.3f", 9, value("clusters/largest_share")) +
         formatted("%7s", span_text(run.analysis, k, f).c_str());
}

std::string series_table(const AnalysedRun& run) {
  const Analysis& analysis = run.analysis;
  const std::size_t factors = analysis.sizes.at('F');
  std::string above(39, ' '), below = " theta   Gamma   sT/sN      z  dV/V (%)";
  for (std::size_t f = 0; f < factors; ++f) {
    const std::string limit =
        formatted("gamma >= %.4g Gamma_c = %.4f", values<double>(analysis, "threshold_factor")[f],
                  values<double>(analysis, "threshold")[f]);
    above += " | " + (f + 1 < factors ? formatted("%-36s", limit.c_str()) : limit);
    below += " |    p_o   mean    max  largest  spans";
  }
  std::string text = (factors > 0 ? above + "\n" : "") + below + "\n";
  for (const std::size_t k : shown_frames(run.tilts.size())) {
    const auto value = [&](const char* name) { return row<double>(analysis, name, k)[0]; };
    text += formatted("%6.2f", degrees(run.tilts[k])) + cell("%.4f", 8, value("packing/stress_ratio")) +
            cell("%.4f", 8, value("packing/sigma_t_over_n")) +
            cell("%.3f", 7, value("contacts/coordination_number")) +
            cell("%+.4f", 10, 100.0 * value("packing/volume_strain"));
    for (std::size_t f = 0; f < factors; ++f) text += threshold_cells(run, k, f);
    text += "\n";
  }
  return text;
}

/// "8.25 +- 0.25 deg"; "<= 0.00 deg" where no frame is before it.
std::string onset_text(double angle, double error) {
  if (std::isnan(angle)) return "none";
  if (std::isnan(error)) return "<= " + degree_text(angle) + " deg";
  return degree_text(angle) + " +- " + degree_text(error) + " deg";
}

std::string line(const std::string& name, const std::initializer_list<std::string> texts) {
  std::string text = formatted("  %-34s", name.c_str());
  for (const std::string& each : texts) text += formatted("%-24s", each.c_str());
  return text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
}

std::string dilation_text(const Analysis& analysis, std::size_t s) {
  const double angle = values<double>(analysis, "theta_d/dilation")[s];
  if (std::isnan(angle)) return "none";
  return degree_text(angle) + " deg, " + degree_text(values<double>(analysis, "theta_d/dilation_low")[s]) +
         " to " + degree_text(values<double>(analysis, "theta_d/dilation_high")[s]);
}

std::string first_slide_text(const Analysis& analysis) {
  const double angle = values<double>(analysis, "first_slide")[0];
  return std::isnan(angle) ? "none" : degree_text(angle) + " deg";
}

std::string transition_table(const AnalysedRun& run) {
  const Analysis& analysis = run.analysis;
  std::string text = line("first slide of the surface layer", {first_slide_text(analysis)}) + "theta_d by\n";
  for (std::size_t f = 0; f < analysis.sizes.at('F'); ++f) {
    const auto value = [&](const char* name) { return values<double>(analysis, name)[f]; };
    const std::string at = formatted(", %.4g Gamma_c", value("threshold_factor"));
    const double size = value("theta_d/lc_jump_size") / run.statics.mean_diameter;
    text +=
        line("jump of l_c max" + at, {onset_text(value("theta_d/lc_jump"), value("theta_d/lc_jump_error")),
                                      std::isnan(size) ? "" : formatted("by %.1f D", size)});
    text += line("percolation" + at,
                 {onset_text(value("theta_d/percolation"), value("theta_d/percolation_error"))});
  }
  return text + line("dilation, volume", {dilation_text(analysis, 0)}) +
         line("dilation, centre of mass", {dilation_text(analysis, 1)});
}

}  // namespace

std::string analysis_text(const AnalysedRun& run) {
  return heading(run) + "\n" + series_table(run) +
         (run.analysis.sizes.at('F') > 0
              ? "l_c in D; largest: share of the overloaded grains in the largest cluster; spans: H floor to "
                "surface, L along the bed\n"
              : "") +
         "\n" + transition_table(run);
}

}  // namespace talus
