#include "figures.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <thread>
#include <tuple>

#include "analysis/contacts/contact_network.h"
#include "analysis/events/events.h"
#include "analysis/failure/transition.h"
#include "analysis/overload/coarse_graining.h"
#include "analysis/quantities.h"
#include "analysis/topology/topology.h"
#include "base/errors.h"
#include "base/hash.h"
#include "base/output_file.h"
#include "base/version.h"
#include "core/trigonometry.h"
#include "ensemble/averages.h"
#include "ensemble/ensemble_manifest.h"
#include "ensemble/member_results.h"
#include "io/durable_file.h"
#include "pictures/frame_choice.h"
#include "pictures/maps.h"
#include "pictures/panel.h"
#include "pictures/picture_series.h"
#include "render/document.h"
#include "render/png.h"
#include "render/renderer.h"
#include "runs/analysis_parameters.h"
#include "runs/analysis_run.h"
#include "runs/event_catalogue.h"
#include "runs/run_view.h"
#include "scenario/scripted_command.h"
#include "session/command.h"
#include "session/run_header.h"
#include "stress/free_surface.h"
#include "stress/stress.h"

namespace py = pybind11;

namespace talus {
namespace {

/// A run with its analysis. Moments, forces and stresses are in SI units.
struct AnalysedRun {
  runs::RunView view;

  const io::RunFile& file() const {
    if (!view.file) throw Error(ExitCode::bad_data, view.path + ": holds values of members alone");
    return *view.file;
  }
  const RunStatics& statics() const { return file().header().statics; }
  double diameter() const { return view.statics.mean_diameter; }
  analysis::AnalysisParameters parameters() const { return runs::from_facts(view.analysis.parameters); }
};

py::array_t<double> array_of(const std::vector<double>& values) {
  return py::array_t<double>(std::ssize(values), values.data());
}

/// Returns both columns of a table.
py::tuple two_arrays(const std::vector<double>& first, const std::vector<double>& second) {
  return py::make_tuple(array_of(first), array_of(second));
}

const analysis::Quantity& quantity_called(const std::string& name) {
  const auto found = std::ranges::find(analysis::quantities(), name, &analysis::Quantity::name);
  if (found == analysis::quantities().end())
    throw Error(ExitCode::usage, name + ": no such quantity of the analysis");
  return *found;
}

/// Returns all values of a quantity in the units of tables.
py::array_t<double> values_of(const AnalysedRun& run, const std::string& name) {
  const analysis::Quantity& quantity = quantity_called(name);
  std::vector<double> numbers =
      std::visit([](const auto& values) { return std::vector<double>(values.begin(), values.end()); },
                 analysis::values_of(quantity, run.view.analysis));
  for (double& number : numbers) number = analysis::scaled(quantity.unit, number, run.diameter());
  return array_of(numbers);
}

std::vector<double> tilts_of(const AnalysedRun& run) {
  std::vector<double> tilts;
  for (const analysis::FrameRecord& frame : run.view.analysis.frames) tilts.push_back(frame.tilt);
  return tilts;
}

std::vector<double> in_degrees(std::vector<double> angles) {
  for (double& angle : angles) angle = degrees(angle);
  return angles;
}

std::vector<std::string> departures_of(const AnalysedRun& run) {
  if (!run.view.file) return {};  // members of an ensemble are runs of their scenario alone
  std::vector<std::string> found = session::departures(*run.view.file, run.view.scenario);
  const std::string by = find_value(run.file().header().provenance, "version").value_or("unknown");
  if (by != version) found.push_back("computed by version " + by);
  return found;
}

/// Returns kind, grain, x and y of the commands that differ from those of the scenario: departures_of rounds
/// them.
std::vector<std::tuple<int, Index, double, double>> own_commands(const AnalysedRun& run) {
  std::vector<std::tuple<int, Index, double, double>> scripted, own;
  const auto key = [](const Command& each) {
    return std::tuple{static_cast<int>(each.kind), each.grain, each.x, each.y};
  };
  for (const scenario::ScriptedCommand& each : run.view.scenario.commands)
    scripted.push_back(key(scenario::command_of(each)));
  if (run.view.file)
    for (const Command& each : run.view.file->commands())
      if (std::ranges::find(scripted, key(each)) == scripted.end()) own.push_back(key(each));
  return own;
}

std::unique_ptr<AnalysedRun> analysed_run(const std::string& path, const std::vector<std::string>& settings,
                                          int threads, const py::object& progress) {
  runs::AnalysisOptions options;
  options.threads = threads;
  // The other threads of the analysis do not hold the interpreter, so only this one reports.
  const std::thread::id caller = std::this_thread::get_id();
  std::size_t reported = 0, all = 0;
  const auto report = [&](std::size_t done) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    progress(done, all);
    reported = done;
  };
  if (!progress.is_none())
    options.progress = [&](std::size_t done, std::size_t count) {
      all = count;
      if (std::this_thread::get_id() == caller) report(done);
    };
  runs::RunView view = runs::analysed_run(path, runs::parse_analysis_settings(settings), options);
  if (reported < all) report(all);
  return std::make_unique<AnalysedRun>(AnalysedRun{std::move(view)});
}

/// Returns the members of an ensemble.h5.
std::vector<std::unique_ptr<AnalysedRun>> stored_runs(const std::string& path) {
  std::vector<std::unique_ptr<AnalysedRun>> members;
  for (runs::RunView& view : ensemble::read_averages(path))
    members.push_back(std::make_unique<AnalysedRun>(AnalysedRun{std::move(view)}));
  return members;
}

/// Returns the analysed runs of the finished members of an ensemble.
std::vector<std::unique_ptr<AnalysedRun>> member_runs(const std::string& folder,
                                                      const std::vector<std::string>& settings, int threads,
                                                      const py::object& progress) {
  const ensemble::EnsemblePlan plan = ensemble::plan_of(ensemble::read_ensemble(folder), folder);
  std::vector<std::unique_ptr<AnalysedRun>> runs;
  for (const std::size_t m : ensemble::done_members(plan)) {
    runs.push_back(analysed_run(plan.members[m].path, settings, threads, progress));
    ensemble::require_own_run(plan.members[m], runs.back()->file());
  }
  return runs;
}

Frame analysed_frame(const AnalysedRun& run, std::size_t k) {
  return runs::analysed_frame(run.file(), run.parameters(), k);
}

/// Returns gamma_l over l (D) of a grain, up to the diameter `largest` (D).
py::tuple neighbourhood(const AnalysedRun& run, std::size_t k, Index grain, double largest) {
  const Frame frame = analysed_frame(run, k);
  analysis::NeighbourhoodCurve curve =
      analysis::neighbourhood_curve({frame, run.statics()}, grain, largest * run.diameter());
  for (double& l : curve.l) l /= run.diameter();
  return two_arrays(curve.l, curve.gamma);
}

/// Returns p_o of a frame at each diameter (D), from 0 for the single grain, at the threshold Gamma_c.
py::array_t<double> overloaded_over_scale(const AnalysedRun& run, std::size_t k, std::vector<double> scales) {
  analysis::AnalysisParameters parameters = run.parameters();
  parameters.l_min = 0.0;
  for (double& l : scales) l *= run.diameter();
  return array_of(analysis::overloaded_over_scale(
      {runs::analysed_frame(run.file(), parameters, k), run.statics()}, run.view.analysis.gamma_c, scales));
}

/// Returns births and deaths of the components of the force network of a frame.
py::tuple force_components(const AnalysedRun& run, std::size_t k) {
  std::vector<double> birth, death;
  for (const analysis::Lifetime& lifetime :
       analysis::force_persistence({run.file().frame(k), run.statics()},
                                   run.view.analysis.frames.at(k).mean_normal_force)
           .components) {
    birth.push_back(lifetime.birth);
    death.push_back(lifetime.death);
  }
  return two_arrays(birth, death);
}

/// Returns x and y (D) of the free surface of a frame, every 0.25 D.
py::tuple surface_of(const AnalysedRun& run, std::size_t k) {
  const RunStatics& statics = run.statics();
  const Frame frame = run.file().frame(k);
  Grains grains;
  grains.free_count = statics.free_count;
  grains.x = frame.x;
  grains.y = frame.y;
  grains.radius = statics.radius;
  Boundary boundary;
  boundary.periodic = statics.periodic;
  boundary.length = statics.length;
  const std::vector<stress::SurfaceArc> surface = stress::free_surface(grains, boundary);
  const double samples = std::ceil(4.0 * statics.length / run.diameter());
  std::vector<double> x, y;
  for (double sample = 0.5; sample < samples; ++sample) {
    x.push_back(sample * statics.length / samples);
    y.push_back(stress::height_of(surface, x.back()) / run.diameter());
    x.back() /= run.diameter();
  }
  return two_arrays(x, y);
}

/// Returns a map whose Gamma_c is that of the analysis, which may differ from sin(theta_c), times `factor`.
pictures::MapSettings map_of(const AnalysedRun& run, const std::string& kind, double factor) {
  const double theta_c = run.view.analysis.theta_c, gamma_c = run.view.analysis.gamma_c;
  pictures::MapSettings settings;
  settings.layers = {kind == "gamma" ? pictures::MapKind::gamma : pictures::MapKind::overloaded};
  settings.theta_c = theta_c;
  settings.threshold_factor = factor * (gamma_c / sine(theta_c));
  if (std::abs(gamma_c / sine(theta_c) - 1.0) > 1e-9) settings.range_high = 2.0 * gamma_c;
  return settings;
}

/// Returns the panel of maps (kind and threshold over Gamma_c) of these frames, a row for each frame, on a
/// page of this width, and at most this height, cm.
render::Sheet panel_of(const AnalysedRun& run, const std::vector<std::size_t>& frames,
                       const std::vector<std::pair<std::string, double>>& maps, double width, double height) {
  constexpr double dots_per_cm = 400.0 / 2.54;
  pictures::PictureSeries series;
  series.run = run.file().header();
  for (const auto& [kind, factor] : maps) series.plan.maps.push_back(map_of(run, kind, factor));
  series.extent = pictures::bed_extent(series.run.statics);
  std::vector<Frame> read;
  for (const std::size_t k : frames) {
    read.push_back(analysed_frame(run, k));
    pictures::extend(series.extent, {read.back(), series.run.statics});
  }
  std::vector<std::vector<render::FrameView>> views(read.size());
  for (std::size_t row = 0; row < read.size(); ++row)
    for (std::size_t map = 0; map < maps.size(); ++map) {
      views[row].push_back(pictures::picture(series, row, read[row], nullptr, map));
      pictures::print_letters(views[row].back(), width, 8.0);
    }
  const auto pixels = [](double cm) { return static_cast<int>(std::lround(cm * dots_per_cm)); };
  return pictures::panel_sheet(views, "", pixels(width), pixels(height), render::embedded_font());
}

/// Writes a panel to files, each a PNG, PDF or SVG by its ending. `source`: what it shows, for its
/// properties.
void write_panel(const AnalysedRun& run, const std::vector<std::size_t>& frames,
                 const std::vector<std::pair<std::string, double>>& maps, double width, double height,
                 const std::vector<std::string>& paths, const std::string& source) {
  const render::Sheet sheet = panel_of(run, frames, maps, width, height);
  for (const std::string& path : paths)
    if (render::is_document(path)) {
      render::write_document(path, sheet, 0.01 * width, {{"Software", version_text()}, {"Source", source}});
    } else {
      render::Renderer renderer(render::make_context(std::nullopt));
      render::write_png(path, renderer.draw(sheet), {{"Software", version_text()}}, 0.01 * width);
    }
}

void bind_values(py::class_<AnalysedRun>& type) {
  // These may name files with bytes that are not UTF-8.
  type.def_property_readonly("path", [](const AnalysedRun& run) { return py::bytes(run.view.path); });
  type.def_property_readonly("kept", [](const AnalysedRun& run) { return py::bytes(run.view.kept); });
  type.def_property_readonly("is_kept", [](const AnalysedRun& run) { return run.view.is_kept; });
  type.def_property_readonly("has_file", [](const AnalysedRun& run) { return run.view.file.has_value(); });
  type.def_property_readonly(
      "has_frames", [](const AnalysedRun& run) { return run.view.file && run.view.file->has_frames(); });
  type.def_property_readonly("has_distributions",
                             [](const AnalysedRun& run) { return !run.view.analysis.gamma_edge.empty(); });
  type.def_property_readonly("thresholds",
                             [](const AnalysedRun& run) { return run.view.analysis.thresholds.size(); });
  type.def_property_readonly("scenario_text", [](const AnalysedRun& run) { return run.view.scenario_text; });
  type.def_property_readonly("scenario_hash", [](const AnalysedRun& run) {
    return hash_text(hash_bytes(std::as_bytes(std::span(run.view.scenario_text))));
  });
  type.def_property_readonly("seed", [](const AnalysedRun& run) { return run.view.scenario.seed; });
  type.def_property_readonly("state_hash", [](const AnalysedRun& run) { return run.view.state_hash; });
  type.def_property_readonly("theta_r", [](const AnalysedRun& run) { return degrees(run.view.theta_r); });
  type.def_property_readonly("analysis_key", [](const AnalysedRun& run) { return run.view.analysis.key; });
  type.def_property_readonly("parameters", [](const AnalysedRun& run) {
    py::dict parameters;
    for (const auto& [name, value] : run.view.analysis.parameters) parameters[py::str(name)] = value;
    return parameters;
  });
  // SI units: D, gravity, and the mass of all free grains and of one in the mean.
  type.def_property_readonly("diameter", &AnalysedRun::diameter);
  type.def_property_readonly("gravity", [](const AnalysedRun& run) { return run.statics().gravity; });
  type.def_property_readonly("mass", [](const AnalysedRun& run) {
    const RunStatics& statics = run.statics();
    return std::accumulate(statics.mass.begin(), statics.mass.begin() + statics.free_count, 0.0);
  });
  type.def_property_readonly("mean_mass",
                             [](const AnalysedRun& run) { return runs::mean_grain_mass(run.statics()); });
  type.def_property_readonly("departures", departures_of);
  type.def_property_readonly("own_commands", own_commands);
  // Those of the scenario: "friction 0.1 at 5 deg".
  type.def_property_readonly("commands", [](const AnalysedRun& run) {
    std::vector<std::string> texts;
    for (const scenario::ScriptedCommand& command : run.view.scenario.commands)
      texts.push_back(session::command_text(scenario::command_of(command)) + " " +
                      scenario::moment_text(command));
    return texts;
  });
  type.def_property_readonly("tilts",
                             [](const AnalysedRun& run) { return array_of(in_degrees(tilts_of(run))); });
  type.def("values", values_of);
}

void bind_choices(py::class_<AnalysedRun>& type) {
  // The frames of the last rise: the first, the magnitudes of their tilts, and whether the bed slopes
  // backwards.
  type.def_property_readonly("rise", [](const AnalysedRun& run) {
    const analysis::FramesOfRise rise = analysis::last_rise(run.view.analysis.frames);
    return py::make_tuple(rise.first, array_of(in_degrees(rise.tilts)), rise.mirrored_slope);
  });
  type.def_property_readonly("repose_frame", [](const AnalysedRun& run) {
    return pictures::frame_at_repose(tilts_of(run), run.view.analysis.theta_c);
  });
  type.def("frames_at", [](const AnalysedRun& run, const std::vector<std::string>& at) {
    return pictures::frames_at(tilts_of(run), at, run.view.analysis.theta_c);
  });
}

void bind_measures(py::class_<AnalysedRun>& type) {
  type.def("neighbourhood", neighbourhood);
  type.def("overloaded_over_scale", overloaded_over_scale);
  type.def("force_components", force_components);
  type.def("surface", surface_of);
  type.def("gamma",
           [](const AnalysedRun& run, std::size_t k) { return array_of(analysed_frame(run, k).gamma); });
  // The share of the grains that carry something with gamma at or above a value.
  type.def("share_from", [](const AnalysedRun& run, std::size_t k, double gamma) {
    const Frame frame = analysed_frame(run, k);
    return stress::count_overloaded({frame, run.statics()}, gamma).fraction();
  });
  type.def("length_cut",
           [](const AnalysedRun& run) { return analysis::length_cut(run.statics(), 0.0) / run.diameter(); });
  type.def("write_panel", write_panel);
}

}  // namespace

void bind_figures(py::module_& module) {
  py::class_<AnalysedRun> type(module, "AnalysedRun");
  bind_values(type);
  bind_choices(type);
  bind_measures(type);
  module.def("_analysed_run", analysed_run);
  module.def("_stored_runs", stored_runs);
  module.def("_member_runs", member_runs);
  module.def("_holds_averages", io::begins_as_averages);
  module.def("_begins_as_run", io::begins_as_run);
  module.def("_parse_settings",
             [](const std::vector<std::string>& settings) { runs::parse_analysis_settings(settings); });
  module.def("_prepare_folder", prepare_folder);
  module.def("_publish_file", publish_file);
  module.def("_output_target",
             [](const std::string& path, bool overwrite, const std::vector<std::string>& inputs) {
               output_target(path, {overwrite, inputs});
             });
  module.def("_plus_minus", [](double mean, double width) { return ensemble::plus_minus(mean, width); });
  // Exponent, its error, the minimum of the law, and the number of values from there on.
  module.def("_power_law", [](const std::vector<double>& values) {
    const analysis::PowerLaw law = analysis::power_law(values);
    return py::make_tuple(law.exponent, law.error, law.minimum, law.count);
  });
  // Mean, its error, and the number of values at or above the minimum.
  module.def("_exponential_law", [](const std::vector<double>& values, double minimum) {
    const analysis::ExponentialLaw law = analysis::exponential_law(values, minimum);
    return py::make_tuple(law.mean, law.error, law.count);
  });
  // Name, shape, unit of tables, definition, symbol, title, whether in percent in curves, and whether the
  // sign changes if the bed slopes backwards.
  module.def("_quantities", [] {
    py::list rows;
    for (const analysis::Quantity& row : analysis::quantities())
      rows.append(py::make_tuple(row.name, row.shape, analysis::scaled_unit(row.unit), row.definition,
                                 row.display.symbol, row.display.title, row.display.percent,
                                 analysis::has_side(row)));
    return rows;
  });
  module.attr("_white_below") = pictures::white_below;
  module.attr("_coherent_mobilisation") = analysis::coherent_mobilisation;
  module.attr("_default_l_min") = analysis::default_l_min;
  module.attr("version_text") = version_text();
}

}  // namespace talus
