/// Extension module talus._core: thin bindings of Simulation for Python. The public interface is
/// python/talus/simulation.py.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <optional>
#include <set>
#include <thread>
#include <utility>

#include "analysis/frame_quantities.h"
#include "base/errors.h"
#include "dynamics/failure.h"
#include "figures.h"
#include "forces.h"
#include "interpreter.h"
#include "io/child_process.h"
#include "library/talus.h"
#include "pictures.h"
#include "render/frame_view.h"
#include "scenario/scenario.h"
#include "stress/free_surface.h"

namespace py = pybind11;

namespace talus {
namespace {

/// A simulation and its current user. While a thread steps it, no other thread may use it, and callbacks of
/// the step may only read it.
class Driven {
 public:
  explicit Driven(Simulation simulation) : simulation_(std::move(simulation)) { all.insert(this); }
  ~Driven() { all.erase(this); }
  Driven(const Driven&) = delete;
  Driven& operator=(const Driven&) = delete;

  /// Commits the recorded data of all simulations that no thread is using. The interpreter does not destroy
  /// simulations held by a daemon thread.
  static void commit_all() {
    for (Driven* const driven : all) {
      if (driven->busy_) continue;
      try {
        driven->simulation_.commit();
      } catch (const std::exception&) {  // earlier commits are intact
      }
    }
  }

  Simulation& seen() {
    if (busy_.load(std::memory_order_acquire) && owner_ != std::this_thread::get_id()) refuse();
    return simulation_;
  }
  const Simulation& seen() const { return const_cast<Driven*>(this)->seen(); }

  /// Runs `work` on the simulation exclusively, without holding the interpreter. `tick` is called about
  /// twenty times a second during steps; its exceptions, and those of signals, are propagated.
  template <typename Work>
  auto use(const py::object& tick, Work&& work) {
    wait_if_the_interpreter_ends();
    if (busy_.exchange(true, std::memory_order_acq_rel)) refuse();
    owner_ = std::this_thread::get_id();
    const struct Release {
      Driven& driven;
      ~Release() {
        driven.simulation_.interrupt_if({});
        driven.busy_.store(false, std::memory_order_release);
      }
    } release{*this};
    simulation_.interrupt_if([&tick] {
      if (interpreter_ends) return true;
      const py::gil_scoped_acquire hold;
      raise_if_interrupted();
      if (!tick.is_none()) tick();
      return false;
    });
    return without_interpreter([&] { return work(simulation_); });
  }
  template <typename Work>
  auto use(Work&& work) {
    return use(py::none(), std::forward<Work>(work));
  }

  /// Runs `work`, which steps the simulation, as `use` does. An exception of a signal, even before the first
  /// step, or of `tick` leaves the recorded data committed.
  template <typename Work>
  auto step(const py::object& tick, Work&& work) {
    try {
      const AttentiveCall call;
      return use(tick, std::forward<Work>(work));
    } catch (py::error_already_set&) {
      try {
        use([](Simulation& simulation) { simulation.commit(); });
      } catch (const std::exception&) {  // earlier commits are intact
      }
      throw;
    }
  }

 private:
  [[noreturn]] void refuse() const {
    throw Error(ExitCode::usage,
                owner_ == std::this_thread::get_id()
                    ? "the simulation is being stepped, and cannot be stepped or changed meanwhile"
                    : "another thread is using the simulation: wait for it, or give each thread its own "
                      "simulation with copy()");
  }

  inline static std::set<Driven*> all;  ///< changed only while holding the interpreter
  Simulation simulation_;
  std::atomic<bool> busy_ = false;
  std::atomic<std::thread::id> owner_;
};

using Holder = std::shared_ptr<Driven>;

void forbid_writing(py::array& array) {
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
}

/// Returns a read-only view of memory of a simulation, which `self` keeps alive.
template <typename Number>
py::array view(const std::vector<Number>& values, const py::object& self) {
  py::array_t<Number> array(std::vector<py::ssize_t>{std::ssize(values)}, {sizeof(Number)}, values.data(),
                            self);
  forbid_writing(array);
  return array;
}

/// Returns a view of two arrays as the columns of one; the stride is their distance in memory.
py::array view(const std::vector<double>& first, const std::vector<double>& second, const py::object& self) {
  const py::ssize_t apart =
      reinterpret_cast<const char*>(second.data()) - reinterpret_cast<const char*>(first.data());
  py::array_t<double> array({std::ssize(first), py::ssize_t{2}},
                            {static_cast<py::ssize_t>(sizeof(double)), apart}, first.data(), self);
  forbid_writing(array);
  return array;
}

template <typename Number>
py::array columns(const std::vector<Number>& first, const std::vector<Number>& second) {
  py::array_t<Number> array({std::ssize(first), py::ssize_t{2}});
  auto to = array.template mutable_unchecked<2>();
  for (py::ssize_t k = 0; k < std::ssize(first); ++k) {
    to(k, 0) = first[static_cast<std::size_t>(k)];
    to(k, 1) = second[static_cast<std::size_t>(k)];
  }
  return array;
}

/// Values of a quantity, row by row.
struct Values {
  analysis::FrameQuantity quantity;
  std::vector<double> numbers{};
};

Values grain_values(MeasuredFrame& frame, const std::string& name) {
  return {frame.grain_quantity(name), frame.grain_values(name)};
}

Values contact_values(MeasuredFrame& frame, const std::string& name) {
  return {frame.contact_quantity(name), frame.contact_values(name)};
}

template <typename Number>
py::array array_of(const std::vector<double>& numbers, const std::vector<py::ssize_t>& shape) {
  py::array_t<Number> array(shape);
  std::transform(numbers.begin(), numbers.end(), array.mutable_data(),
                 [](double number) { return static_cast<Number>(number); });
  return array;
}

/// Returns rows of one number, of two numbers, or of a tensor; ids and counts as integers.
py::array rows(const Values& values) {
  const std::size_t width = analysis::components(values.quantity);
  std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(values.numbers.size() / width)};
  if (width == 2) shape.push_back(2);
  if (width == 4) shape.insert(shape.end(), {2, 2});
  if (values.quantity.flag) return array_of<bool>(values.numbers, shape);
  if (values.quantity.number == analysis::FieldNumber::integer)
    return array_of<std::int64_t>(values.numbers, shape);
  return array_of<double>(values.numbers, shape);
}

const char* name_of(session::Phase phase) {
  switch (phase) {
    case session::Phase::deposition:
      return "deposition";
    case session::Phase::tilt:
      return "tilt";
    case session::Phase::flow:
      return "flow";
    case session::Phase::done:
      break;
  }
  return "done";
}

/// Translates errors of Talus to talus.Error, and to the built-in exception that Python expects for its exit
/// code.
void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const Error& error) {
    const char* const text = error.what();  // may quote a file name with arbitrary bytes
    const py::object raised =
        py::module_::import("talus.errors")
            .attr("error_of_code")(
                static_cast<int>(error.code()),
                py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(
                    text, static_cast<py::ssize_t>(std::strlen(text)), "backslashreplace")));
    PyErr_SetObject(py::type::of(raised).ptr(), raised.ptr());
  }
}

/// Waits for steps in other threads, because they end in the interpreter, and commits recorded data.
void end_steps() {
  interpreter_ends = true;
  {
    const py::gil_scoped_release let_go;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (steps_under_way > 0 && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  Driven::commit_all();
}

void bind_stepping(py::class_<Driven, Holder>& type) {
  const auto steps = [&type](const char* name, auto method) {
    using Goal = decltype(method);
    if constexpr (std::is_same_v<Goal, bool (Simulation::*)()>)
      type.def(name, [method](Driven& driven, const py::object& tick) {
        return driven.step(tick, [&](Simulation& simulation) { return (simulation.*method)(); });
      });
    else if constexpr (std::is_same_v<Goal, bool (Simulation::*)(double)>)
      type.def(name, [method](Driven& driven, double goal, const py::object& tick) {
        return driven.step(tick, [&](Simulation& simulation) { return (simulation.*method)(goal); });
      });
    else
      type.def(name, [method](Driven& driven, std::int64_t goal, const py::object& tick) {
        return driven.step(tick, [&](Simulation& simulation) { return (simulation.*method)(goal); });
      });
  };
  steps("_deposit", &Simulation::deposit);
  steps("_finish", &Simulation::finish);
  steps("_tilt_to", &Simulation::tilt_to);
  steps("_tilt_by", &Simulation::tilt_by);
  steps("_step", &Simulation::step);
  type.def("_steps_in", [](Driven& driven, double seconds) {
    return driven.use([&](Simulation& simulation) { return simulation.steps_in(seconds); });
  });
}

void bind_commands(py::class_<Driven, Holder>& type) {
  type.def("_push", [](Driven& driven, const std::vector<Index>& grains,
                       const std::vector<std::array<double, 2>>& velocities) {
    std::vector<Vec2> by;
    for (const auto& [x, y] : velocities) by.push_back({x, y});
    driven.use([&](Simulation& simulation) { simulation.push(grains, by); });
  });
  type.def("_drop", [](Driven& driven, Index grains, double x, double height) {
    driven.use([&](Simulation& simulation) { simulation.drop(grains, x, height); });
  });
  type.def("_drag", [](Driven& driven, Index grain, double x, double y) {
    driven.use([&](Simulation& simulation) { simulation.drag(grain, {x, y}); });
  });
  type.def("_release",
           [](Driven& driven) { driven.use([](Simulation& simulation) { simulation.release(); }); });
  type.def("_set_friction", [](Driven& driven, double friction) {
    driven.use([&](Simulation& simulation) { simulation.set_friction(friction); });
  });
  type.def("_set_tilt_rate", [](Driven& driven, double rate) {
    driven.use([&](Simulation& simulation) { simulation.set_tilt_rate(rate); });
  });
  type.def("_use_threads", [](Driven& driven, int threads) {
    driven.use([&](Simulation& simulation) { simulation.use_threads(threads); });
  });
}

void bind_state(py::class_<Driven, Holder>& type) {
  type.def_property_readonly("tilt", [](const Driven& driven) { return driven.seen().tilt(); });
  type.def_property_readonly("_tilt_rate", [](const Driven& driven) { return driven.seen().tilt_rate(); });
  type.def_property_readonly("_friction", [](const Driven& driven) { return driven.seen().friction(); });
  type.def_property_readonly(
      "_time_step", [](const Driven& driven) { return scenario::time_step(driven.seen().scenario()); });
  type.def_property_readonly("time", [](const Driven& driven) { return driven.seen().world().time; });
  type.def_property_readonly("step_count", [](const Driven& driven) { return driven.seen().world().step; });
  type.def_property_readonly("phase", [](const Driven& driven) { return name_of(driven.seen().phase()); });
  type.def_property_readonly("done", [](const Driven& driven) { return driven.seen().done(); });
  type.def_property_readonly("residual", [](const Driven& driven) { return driven.seen().residual(); });
  type.def_property_readonly("converged", [](const Driven& driven) { return driven.seen().converged(); });
  type.def_property_readonly("state_hash", [](const Driven& driven) { return driven.seen().state_hash(); });
  type.def_property_readonly("theta_c", [](const Driven& driven) { return driven.seen().theta_c(); });
  type.def_property_readonly("recorded", [](const Driven& driven) { return driven.seen().recorded(); });
  type.def_property_readonly("length", [](const Driven& driven) { return driven.seen().statics().length; });
  type.def_property_readonly("periodic",
                             [](const Driven& driven) { return driven.seen().statics().periodic; });
  type.def_property_readonly("gravity", [](const Driven& driven) { return driven.seen().statics().gravity; });
  type.def_property_readonly("D", [](const Driven& driven) { return driven.seen().statics().mean_diameter; });
  type.def_property_readonly(
      "scenario", [](const Driven& driven) { return scenario::resolved_toml(driven.seen().scenario()); });
}

void bind_arrays(py::class_<Driven, Holder>& type) {
  const auto grains = [&type](const char* name, auto member) {
    type.def_property_readonly(name, [member](const py::object& self) {
      return view(self.cast<Driven&>().seen().world().grains.*member, self);
    });
  };
  const auto pairs = [&type](const char* name, std::vector<double> Grains::*first,
                             std::vector<double> Grains::*second) {
    type.def_property_readonly(name, [first, second](const py::object& self) {
      const Grains& of = self.cast<Driven&>().seen().world().grains;
      return view(of.*first, of.*second, self);
    });
  };
  pairs("_position", &Grains::x, &Grains::y);
  pairs("_velocity", &Grains::vx, &Grains::vy);
  grains("_angle", &Grains::angle);
  grains("_angular_velocity", &Grains::omega);
  grains("_radius", &Grains::radius);
  grains("_mass", &Grains::mass);
  grains("_image", &Grains::image);
  type.def_property_readonly("_free_count",
                             [](const Driven& driven) { return driven.seen().world().grains.free_count; });
  const auto contacts = [&type](const char* name, auto first, auto second) {
    type.def_property_readonly(name, [first, second](const Driven& driven) {
      const Contacts& of = driven.seen().world().contacts;
      return columns(of.*first, of.*second);
    });
  };
  contacts("_pair", &Contacts::a, &Contacts::b);
  contacts("_normal", &Contacts::nx, &Contacts::ny);
  type.def_property_readonly("_force", [](const Driven& driven) {
    const World& world = driven.seen().world();
    const double threshold = force_threshold(world.grains.mass, world.grains.free_count, world.gravity);
    std::vector<double> fn = world.contacts.fn, ft = world.contacts.ft;
    for (std::size_t c = 0; c < fn.size(); ++c)
      if (fn[c] < threshold) fn[c] = ft[c] = 0.0;
    return columns(fn, ft);
  });
  type.def_property_readonly(
      "_gap", [](const Driven& driven) { return py::array(py::cast(driven.seen().world().contacts.gap)); });
  type.def_property_readonly("_shift", [](const Driven& driven) {
    const std::vector<std::int8_t>& shift = driven.seen().world().contacts.shift;
    return py::array_t<std::int8_t>(std::ssize(shift), shift.data());
  });
}

/// Binds the measurements of a simulation or a frame; `apply(self, work)` calls `work(MeasuredFrame&)`.
template <typename Type, typename Apply>
void bind_measurements(Type& type, const Apply& apply) {
  using Self = typename Type::type;
  type.def("_quantity", [apply](Self& self, const std::string& name) {
    return apply(self, [&](MeasuredFrame& frame) { return frame.quantity(name); });
  });
  type.def("_grain_values", [apply](Self& self, const std::string& name) {
    return rows(apply(self, [&](MeasuredFrame& frame) { return grain_values(frame, name); }));
  });
  type.def("_contact_values", [apply](Self& self, const std::string& name) {
    return rows(apply(self, [&](MeasuredFrame& frame) { return contact_values(frame, name); }));
  });
  const auto names = [&](const char* called, std::vector<std::string> (MeasuredFrame::*method)() const) {
    type.def_property_readonly(called, [apply, method](Self& self) {
      return apply(self, [&](MeasuredFrame& frame) { return (frame.*method)(); });
    });
  };
  names("_quantities", &MeasuredFrame::quantities);
  names("_grain_quantities", &MeasuredFrame::grain_quantities);
  names("_contact_quantities", &MeasuredFrame::contact_quantities);
}

/// Binds the map of a frame, drawn or for a panel or a movie; `use` calls a function with the frame.
template <typename Type, typename Use>
void bind_maps(Type& type, const Use& use) {
  using Owner = typename Type::type;
  type.def("_draw",
           [use](Owner& owner, const pictures::MapChoice& what, const pictures::MapOptions& options) {
             return pixels(while_drawing([&] {
               return use(owner, [&](const MeasuredFrame& frame) { return frame.draw(what, options); });
             }));
           });
  type.def("_map", [use](Owner& owner, const pictures::MapChoice& what, const pictures::MapOptions& options) {
    return use(owner, [&](const MeasuredFrame& frame) { return frame.map(what, options); });
  });
}

void bind_measures(py::class_<Driven, Holder>& type) {
  bind_measurements(type, [](Driven& driven, const auto& work) {
    return driven.use([&](Simulation& simulation) { return work(simulation.measured()); });
  });
  type.def("_set_analysis", [](Driven& driven, const std::vector<std::string>& settings) {
    driven.use([&](Simulation& simulation) { simulation.set_analysis(settings); });
  });
  bind_maps(type, [](Driven& driven, const auto& work) {
    return driven.use([&](Simulation& simulation) { return work(simulation.measured()); });
  });
}

/// Binds what a script needs at each step to judge rest and failure as a run does.
void bind_motion(py::module_& module, py::class_<Driven, Holder>& type) {
  type.def("_surface_height", [](const Driven& driven, double centre, double width) {
    const World& world = driven.seen().world();
    return stress::mean_height(world.grains, world.boundary, centre, 0.5 * width);
  });
  type.def_property_readonly("_surface_velocity", [](const Driven& driven) {
    const World& world = driven.seen().world();
    const double height = stress::bed_volume(world.grains, world.boundary) / world.boundary.length;
    const double depth = dynamics::surface_layer_depth * driven.seen().statics().mean_diameter;
    return dynamics::surface_velocity(world.grains, height - depth);
  });
  type.def_property_readonly("_rms_velocity",
                             [](const Driven& driven) { return rms_velocity(driven.seen().world().grains); });
  type.def_property_readonly(
      "_kinetic_energy", [](const Driven& driven) { return kinetic_energy(driven.seen().world().grains); });
  type.def_property_readonly("_flow_rule", [](const Driven& driven) {
    const World& world = driven.seen().world();
    const dynamics::FlowRule rule =
        dynamics::flow_rule(driven.seen().statics().mean_diameter, world.gravity, world.boundary);
    return std::pair(rule.velocity, rule.distance);
  });
  module.attr("rest_steps") = dynamics::rest_steps;
}

/// Binds frames of files, which have the same measures as simulations.
void bind_frames(py::module_& module) {
  py::class_<MeasuredFrame> type(module, "MeasuredFrame");
  type.def(py::init([](const std::string& path, std::size_t k, const std::vector<std::string>& settings) {
    require_files();
    return without_interpreter([&] { return measured_frame(path, k, settings); });
  }));
  bind_measurements(type, [](MeasuredFrame& frame, const auto& work) { return work(frame); });
  bind_maps(type, [](MeasuredFrame& frame, const auto& work) { return work(frame); });
}

/// Returns the scenario of a file or of `tables`, as TOML. Commands in `tables` replace those of the file;
/// `text` becomes that of the scenario as it was given.
scenario::Scenario scenario_of(const std::string& path, const std::vector<std::string>& settings,
                               const std::string& tables, std::string& text) {
  if (path.empty()) return scenario::parse_scenario(tables, "scenario", settings);
  scenario::Scenario scenario = scenario::read_scenario(path, settings, &text);
  if (tables.empty()) return scenario;
  scenario.commands.clear();
  text = scenario::resolved_toml(scenario) + "\n" + tables;
  return scenario::parse_scenario(text, "scenario");
}

}  // namespace
}  // namespace talus

PYBIND11_MODULE(_core, module) {
  using namespace talus;
  survive_forks();
  py::register_exception_translator(translate);
  py::class_<Driven, Holder> type(module, "Simulation");
  type.def(py::init(
      [](const std::string& path, const std::vector<std::string>& settings, const std::string& tables) {
        std::string text;
        const scenario::Scenario scenario = scenario_of(path, settings, tables, text);
        if (scenario.deposition.method == scenario::DepositionMethod::file) require_files();
        return std::make_shared<Driven>(without_interpreter([&] { return Simulation(scenario, text); }));
      }));
  type.def("_copy", [](Driven& driven) {
    return std::make_shared<Driven>(
        driven.use([](Simulation& simulation) { return Simulation(simulation); }));
  });
  type.def_static("_resume", [](const std::string& path) {
    require_files();
    return std::make_shared<Driven>(without_interpreter([&] { return Simulation::resume(path); }));
  });
  bind_stepping(type);
  bind_commands(type);
  bind_state(type);
  bind_arrays(type);
  bind_measures(type);
  bind_motion(module, type);
  type.def("_save", [](Driven& driven, const std::string& path, bool overwrite) {
    require_files();
    driven.use([&](Simulation& simulation) { simulation.save(path, overwrite); });
  });
  type.def("_record", [](Driven& driven, const std::string& path, bool overwrite) {
    require_files();
    driven.use([&](Simulation& simulation) { simulation.record(path, overwrite); });
  });
  type.def("commit", [](Driven& driven) { driven.use([](Simulation& simulation) { simulation.commit(); }); });
  bind_pictures(module);
  bind_frames(module);
  bind_figures(module);
  bind_forces(module);
  module.def("_end_steps", &end_steps);
  module.def("_require_files", &require_files);
  module.def("_departures", &departures);
  module.def("_may_use_hdf5", &io::may_use_hdf5);
  module.attr("version") = version_text();
}
