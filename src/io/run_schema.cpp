#include "io/run_schema.h"

#include "base/errors.h"
#include "base/text.h"
#include "core/observables.h"

namespace talus::io {

namespace {

using enum ElementType;

std::vector<DataSetField> header_fields() {
  return {
      {"/contents", text, "", "1", "paths of the data sets of this table that the file holds, one a line"},
      {"/parameters/schema_version", int32, "", "1", "version of this table of data sets"},
      {"/parameters/scenario_given", text, "", "1", "the scenario as the user wrote it, TOML"},
      {"/parameters/scenario_resolved", text, "", "1", "the scenario with every key, TOML"},
      {"/parameters/periodic", int8, "", "1", "1 if the bed is periodic along x, 0 if it ends at side walls"},
      {"/parameters/mean_diameter", float64, "", "m", "mean diameter of the free grains, D"},
      {"/parameters/gravity", float64, "", "m/s^2", "magnitude of gravity, g"},
      {"/parameters/friction", float64, "", "1", "coefficient of friction between grains, mu"},
      {"/provenance/seed", uint64, "", "1", "seed of the random deposition"},
      {"/provenance/*", text, "", "1",
       "a fact about how the run was made: version, compiler, host, command, ...; `bed_hash` if "
       "`deposition.file` holds its bed"},
      {"/particles/grains/box/edges", float64, "2", "m",
       "length of the bed (its period, or the distance between its walls) and its nominal depth"},
      {"/particles/grains/id", int32, "N", "1",
       "stable id of a grain, its index in every array; free grains come first"},
      {"/particles/grains/species", int8, "N", "1", "0 free grain, 1 grain glued to the floor"},
      {"/particles/grains/radius", float64, "N", "m", "radius"},
      {"/particles/grains/mass", float64, "N", "kg/m", "mass, per metre of thickness"},
  };
}

std::vector<DataSetField> frame_fields() {
  return {
      {"/frames/hash", uint64, "T", "1",
       "XXH3 of the data of a frame in the data sets below, its contacts included"},
      {"/frames/step", int64, "T", "1",
       "steps taken since the beginning of the run; also linked as `step` next to each `value` of "
       "/particles/grains"},
      {"/frames/time", float64, "T", "s",
       "simulated time; also linked as `time` next to each `value` of /particles/grains"},
      {"/frames/tilt", float64, "T", "rad",
       "angle of the bed to the horizontal, theta; the last checkpoint/integers/flow_steps steps, if any, "
       "are the flow that follows failure"},
      {"/particles/grains/position/value", float32, "T N 2", "m",
       "centre (x, y) in the frame of the bed: x along it, downslope when the tilt is positive, in [0, L) of "
       "a periodic bed; y away from the floor"},
      {"/particles/grains/image/value", int32, "T N 2", "1",
       "how often a grain left through the right periodic edge minus the left, and 0: the unwrapped centre "
       "is position + image * edges"},
      {"/particles/grains/angle/value", float32, "T N", "rad",
       "angle turned since the beginning, counter-clockwise positive"},
      {"/particles/grains/velocity/value", float32, "T N 2", "m/s", "velocity (vx, vy)"},
      {"/particles/grains/angular_velocity/value", float32, "T N", "rad/s",
       "rotation velocity, counter-clockwise positive"},
      {"/particles/grains/internal_moment/value", float32, "T N 2 2", "J/m",
       "internal moment tensor M_ij of a grain, per metre of thickness (paper, Eq. 4); compression positive; "
       "the stress is M divided by an area"},
      {"/particles/grains/gamma/value", float32, "T N", "1",
       "stress ratio q/p of a grain; NaN where it carries nothing"},
      {"/contacts/offset", int64, "T+1", "1",
       "contacts of frame k are the rows offset[k] ... offset[k+1] - 1 of the arrays below"},
      {"/contacts/pair", int32, "M 2", "1",
       "ids (a, b) of the bodies, a < b; b = N + k is plane k of the boundary"},
      {"/contacts/shift", int8, "M", "1", "periodic image: b touches a from x_b + shift * L"},
      {"/contacts/normal", float32, "M 2", "1", "unit normal n, from a to b"},
      {"/contacts/point", float32, "M 2", "m", "contact point"},
      {"/contacts/force", float32, "M 2", "N/m",
       "force (f_n, f_t) on b along n and t = (-n_y, n_x), per metre of thickness; f_n > 0 is compression"},
      {"/contacts/status", int8, "M", "1", "0 open, 1 sticking, 2 sliding (friction fully mobilised)"},
      {"/contacts/moment", float32, "M", "N",
       "moment on b, counter-clockwise positive, per metre of thickness; its opposite acts on a; present "
       "only if contacts resist rolling (contact.rolling_friction > 0)"},
  };
}

std::vector<DataSetField> command_fields() {
  return {
      {"/commands/step", int64, "K", "1",
       "steps taken when a command was given: it acts from the next step on"},
      {"/commands/kind", int8, "K", "1", "0 push, 1 drop, 2 friction, 3 tilt rate, 4 drag, 5 release"},
      {"/commands/grain", int32, "K", "1",
       "push, drag: id of the free grain; drop: how many grains of the free surface, those farthest from x; "
       "else of no meaning"},
      {"/commands/x", float64, "K", "by kind",
       "push: velocity added along the bed, m/s; drop: where along the bed, m; friction: the coefficient "
       "between grains, and between grains and floor, from then on; tilt rate: deg/s, below 0: downwards, "
       "from then on; drag: where along the bed the spring is held from then on, m"},
      {"/commands/y", float64, "K", "by kind",
       "push: velocity added away from the floor, m/s; drop: height above the free surface, m; drag: where "
       "above the floor the spring is held, m; else of no meaning"},
  };
}

/// The results, the last state, and what is stored after them.
std::vector<DataSetField> last_fields() {
  return {
      {"/results/theta_c", float64, "", "rad",
       "angle of repose: the magnitude of the tilt at which the slope failed; NaN if it has not"},
      {"/results/theta_r", float64, "", "rad",
       "angle at rest: slope of the free surface against the horizontal after the flow that follows failure "
       "has come to rest; NaN if it has not; absent with tilt.after_failure = \"stop\""},
      {"/results/*", float64, "", "SI", "a figure of the run, in the SI unit of its kind"},
      {"/provenance/timing/*", float64, "", "s", "wall time spent in a stage"},
      {"/checkpoint/state_hash", text, "", "1",
       "XXH3 of everything that determines the future of the state, 16 hexadecimal digits"},
      {"/checkpoint/step", int64, "", "1", "steps taken since the beginning of the run"},
      {"/checkpoint/time", float64, "", "s", "simulated time"},
      {"/checkpoint/tilt", float64, "", "rad", "angle of the bed to the horizontal"},
      {"/checkpoint/gravity", float64, "", "m/s^2", "magnitude of gravity"},
      {"/checkpoint/free_count", int32, "", "1",
       "number of free grains in the bed; while it is poured, of those that have arrived"},
      {"/checkpoint/x", float64, "G", "m", "centre, along the bed"},
      {"/checkpoint/y", float64, "G", "m", "centre, away from the floor"},
      {"/checkpoint/vx", float64, "G", "m/s", "velocity along the bed"},
      {"/checkpoint/vy", float64, "G", "m/s", "velocity away from the floor"},
      {"/checkpoint/omega", float64, "G", "rad/s", "rotation velocity"},
      {"/checkpoint/radius", float64, "G", "m", "radius"},
      {"/checkpoint/inverse_mass", float64, "G", "m/kg",
       "inverse of the mass; 0 for a grain that does not move"},
      {"/checkpoint/inverse_inertia", float64, "G", "1/(kg m)",
       "inverse of the inertia; 0 for a grain that does not rotate"},
      {"/checkpoint/mass", float64, "G", "kg/m", "mass, per metre of thickness"},
      {"/checkpoint/inertia", float64, "G", "kg m",
       "moment of inertia about the centre, per metre of thickness"},
      {"/checkpoint/angle", float64, "G", "rad", "angle turned since the beginning"},
      {"/checkpoint/image", int32, "G", "1",
       "how often a grain left through the right periodic edge minus the left"},
      {"/checkpoint/periodic", int8, "", "1", "1 if the bed is periodic along x"},
      {"/checkpoint/length", float64, "", "m", "period, or distance between the side walls"},
      {"/checkpoint/plane_normal", float64, "P 2", "1", "unit normal of a plane, into the free space"},
      {"/checkpoint/plane_offset", float64, "P", "m", "a plane is { r : n.r = offset }"},
      {"/checkpoint/plane_wall", int8, "P", "1", "1 side wall, 0 smooth floor"},
      {"/checkpoint/contact_pair", int32, "C 2", "1",
       "ids (a, b) of the contacts and near contacts of the last step, ascending"},
      {"/checkpoint/contact_shift", int8, "C", "1", "periodic image of b"},
      {"/checkpoint/contact_normal", float64, "C 2", "1", "unit normal, from a to b"},
      {"/checkpoint/contact_gap", float64, "C", "m", "gap; negative where bodies overlap"},
      {"/checkpoint/contact_force", float64, "C 2", "N/m",
       "force (f_n, f_t) on b, per metre of thickness: the contact memory"},
      {"/checkpoint/contact_moment", float64, "C", "N",
       "moment on b, per metre of thickness: the memory of contacts that resist rolling, present only if "
       "they do"},
      {"/checkpoint/integers/*", int64, "", "1", "a value of the schedule of the run"},
      {"/checkpoint/reals/*", float64, "", "SI",
       "a value of the schedule of the run, in the SI unit of its kind"},
      // Values of further analyses, in addition to the one in /analysis.
      {"/readings/key/*", text, "", "1",
       "key of an analysis with the parameters of the name, of which only these values are kept"},
      {"/readings/value/*", float64, "F W", "by quantity",
       "what it gives at each threshold for the values of the paper's chain, in the order of "
       "docs/reproduce.md and in deg and D; NaN if there is none"},
      {"/readings/at_most/*", int8, "F W", "1", "1 if the value is only an upper bound"},
      {"/own/grains/*", float64, "T N", "by quantity",
       "values of a script for grains; attributes `unit`, `label` and `kind`: number (NaN: none), flag (0 or "
       "1), "
       "cluster (a label, below 0: none)"},
      {"/own/contacts/*", float64, "M", "by quantity",
       "values of a script for contacts, in the rows of /contacts"},
  };
}

/// Returns the fields of /branch: its first state has the data sets of the last state.
std::vector<DataSetField> branch_fields() {
  std::vector<DataSetField> fields = {
      {"/branch/run", text, "", "1", "the run that this one is a branch of, as the user named it"},
      {"/branch/run_hash", text, "", "1", "state hash of the end of that run, as it then was"},
      {"/branch/frame", int64, "", "1", "frame of that run with which this one begins, from 0"},
  };
  const std::string group = "/checkpoint/";
  for (DataSetField field : last_fields()) {
    if (!field.path.starts_with(group)) continue;
    field.path.replace(0, group.size(), "/branch/");
    if (field.shape.starts_with('C')) field.shape[0] = 'B';
    fields.push_back(field);
  }
  return fields;
}

template <typename Fields>
void append_series(std::vector<DataSetField>& schema, const std::string& group, const char* shape,
                   const Fields& fields) {
  for (const SeriesField& field : fields)
    schema.push_back(
        {group + std::string(field.name), float64, shape, std::string(field.unit), std::string(field.help)});
}

std::vector<DataSetField> make_schema() {
  std::vector<DataSetField> schema = header_fields();
  for (const DataSetField& field : frame_fields()) schema.push_back(field);
  append_series(schema, "/observables/", "R", observable_fields);
  append_series(schema, "/steps/", "S", step_fields);
  for (const DataSetField& field : command_fields()) schema.push_back(field);
  append_series(schema, "/trials/", "Q", trial_fields);
  for (const DataSetField& field : branch_fields()) schema.push_back(field);
  for (const DataSetField& field : last_fields()) schema.push_back(field);
  return schema;
}

}  // namespace

std::string_view type_name(ElementType type) {
  constexpr std::string_view names[] = {"float32", "float64", "int8", "int32", "int64", "uint64", "text"};
  return names[static_cast<std::size_t>(type)];
}

const std::vector<DataSetField>& run_schema() {
  static const std::vector<DataSetField> schema = make_schema();
  return schema;
}

bool is_by_frame(const DataSetField& field) {
  const bool has_rows = field.shape.starts_with('T') || field.shape.starts_with('M');
  return has_rows && !field.path.starts_with("/analysis/") && !field.path.starts_with("/own/");
}

DataSetField field_of(const std::string& path) {
  const std::string family = path.substr(0, path.rfind('/')) + "/*";
  const DataSetField* found = nullptr;
  const auto visit = [&](const DataSetField& field) {
    if (field.path == path || (field.path == family && found == nullptr)) found = &field;
  };
  for (const DataSetField& field : run_schema()) visit(field);
  static const std::vector<DataSetField> of_analyses = analysis_schema();
  for (const DataSetField& field : of_analyses) visit(field);
  if (found == nullptr) throw Error(ExitCode::internal, "the schema of run files has no data set " + path);
  DataSetField field = *found;
  field.path = path;
  return field;
}

std::vector<Extent> extents(const DataSetField& field) {
  std::vector<Extent> shape;
  std::istringstream words = text_stream(field.shape);
  for (std::string word; words >> word;) {
    Extent extent;
    if (word[0] >= 'A' && word[0] <= 'Z') {
      extent.symbol = word[0];
      word.erase(0, 1);
    }
    if (!word.empty()) extent.plus = std::stoull(word);
    shape.push_back(extent);
  }
  return shape;
}

std::vector<std::uint64_t> dimensions(const DataSetField& field, const Sizes& sizes) {
  std::vector<std::uint64_t> dims;
  for (const Extent& extent : extents(field))
    dims.push_back((extent.symbol != '\0' ? sizes.at(extent.symbol) : 0) + extent.plus);
  return dims;
}

DataSetField data_set_of(const analysis::Quantity& quantity) {
  const ElementType type = std::visit([]<typename T>(const std::vector<T>&) { return element_type<T>(); },
                                      analysis::values_of(quantity, analysis::Analysis()));
  return {"/analysis/" + quantity.name, type, quantity.shape, quantity.unit, quantity.definition};
}

std::vector<DataSetField> analysis_schema(std::span<const analysis::Quantity> table) {
  std::vector<DataSetField> schema = {
      {"/analysis/version", int32, "", "1", "version of this table and of what it means"},
      {"/analysis/key", text, "", "1",
       "XXH3 of the state hash of the run, of all parameters and of the version, 16 hexadecimal digits: an "
       "analysis with another key is computed again"},
      {"/analysis/parameters/*", text, "", "1", "a parameter as it was given, or its default"}};
  for (const analysis::Quantity& quantity : table) schema.push_back(data_set_of(quantity));
  return schema;
}

Sizes sizes_of(const analysis::Analysis& analysis) {
  Sizes sizes = {{'T', analysis.frames.size()},
                 {'F', analysis.thresholds.size()},
                 {'X', analysis.section_edge.size() - 1},
                 {'Y', analysis.layer_edge.size() - 1},
                 {'B', analysis.gamma_edge.size() - 1}};
  if (!analysis.events.empty()) sizes['E'] = analysis.events.size();
  if (!analysis.thresholds.empty()) sizes['N'] = analysis.frames.front().thresholds.front().lc.size();
  return sizes;
}

bool is_present(const analysis::Quantity& quantity, const analysis::Analysis& analysis) {
  if (analysis::needs_threshold(quantity)) return !analysis.thresholds.empty();
  return !analysis::is_of_events(quantity) || !analysis.events.empty();
}

}  // namespace talus::io
