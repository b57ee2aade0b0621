#pragma once
/// Data that a run records: frames for maps and analysis, and the constants of the run that they belong to.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/observables.h"
#include "core/types.h"
#include "core/world.h"

namespace talus {

/// The contacts that carry force (force_threshold), in the order of their keys, as in Contacts.
struct FrameContacts {
  std::vector<Index> a, b;
  std::vector<std::int8_t> shift;
  std::vector<double> nx, ny;  ///< normal, unit
  std::vector<double> px, py;  ///< contact point, m
  std::vector<double> fn, ft;  ///< force on b, N (per metre of thickness)
  std::vector<ContactStatus> status;
  std::vector<double> moment{};  ///< N m on b (per metre of thickness); empty if no contact resists rolling

  Index count() const { return a.size(); }
};

/// Coefficients of friction in force in a step.
struct Friction {
  double grains = 0.0;  ///< mu between grains, and with the floor
  double walls = 0.0;   ///< mu with the side walls

  bool operator==(const Friction&) const = default;
};

/// Values of a script for the grains of a frame, floor included, or for its contacts.
struct OwnQuantity {
  enum class Kind {
    number,   ///< drawn on a scale; NaN: no value
    flag,     ///< 0 or 1, drawn in two tones
    cluster,  ///< label, which has the same colour in all pictures; below 0: in no cluster
  };
  std::vector<double> values;
  Kind kind = Kind::number;
  std::string label = "values", unit{};  ///< rich texts, such as "v_y" and "m/s"
  std::string name{};                    ///< name under which it is stored with a run
  bool of_grains = true;                 ///< otherwise of contacts

  bool operator==(const OwnQuantity&) const = default;
};

/// The bed at one instant. Arrays run over all grains, floor included, in the order of their ids.
struct Frame {
  std::int64_t step = 0;
  double time = 0.0;                  ///< s
  double tilt = 0.0;                  ///< rad
  std::vector<double> x, y, angle;    ///< m, m, rad
  std::vector<double> vx, vy, omega;  ///< m/s, m/s, rad/s
  std::vector<Index> image;
  std::vector<Tensor2>
      internal_moment;        ///< J (per metre of thickness); compression positive; Eq. (4) of the paper
  std::vector<double> gamma;  ///< stress ratio q/p of each grain; NaN for a grain that carries no load
  FrameContacts contacts;
  Friction friction;               ///< friction in the step that led to this state, and thus to its forces
  std::vector<OwnQuantity> own{};  ///< those stored with the run

  Index grain_count() const { return x.size(); }
};

/// Constants of a run.
struct RunStatics {
  Index free_count = 0;
  std::vector<double> radius;  ///< m, all grains
  std::vector<double> mass;    ///< kg (per metre of thickness)
  bool periodic = false;
  double length = 0.0;         ///< m: period or distance between walls
  double depth = 0.0;          ///< m: nominal depth of the bed
  double mean_diameter = 0.0;  ///< m
  double gravity = 0.0;        ///< m/s^2
};

/// Whether contact c of a frame is with a side wall, a plane with a normal along the bed.
bool is_with_wall(const Frame& frame, Index c);
/// Returns mu of contact c of a frame.
double friction_of_contact(const Frame& frame, Index c);

/// Returns the smallest normal force that a contact is considered to carry, N (per metre of thickness): 1e-9
/// of the mean weight of the free grains, and infinity without any. The force of a contact that opens decays
/// over many steps, because the solver is under-relaxed, and is below this bound long before it is 0. The
/// forces that hold a bed are larger.
double force_threshold(std::span<const double> mass, Index free_count, double gravity);
double force_threshold(const RunStatics& statics);

/// Removes the contacts of a frame with a normal force below `threshold`, and clears the grains that have no
/// contact then. Only files of earlier revisions have such contacts.
void remove_open_contacts(Frame& frame, double threshold);

/// Sets gamma of the grains without contacts to NaN, and their internal moments to 0 unless the trace is
/// negative, from rotation: anything else is a remainder of contacts that carry no force.
void clear_unloaded_grains(Frame& frame);

/// Returns the constants of a frame with `count` grains, floor included, of a bed that is being poured: the
/// free grains with the highest ids have not arrived yet.
RunStatics arrived_statics(const RunStatics& all, Index count);

/// Named facts about a run, in the order in which they are written: provenance, timing, results.
using Facts = std::vector<std::pair<std::string, std::string>>;
using Figures = std::vector<std::pair<std::string, double>>;

/// Returns the value of this name, or no value.
template <typename Value>
std::optional<Value> find_value(const std::vector<std::pair<std::string, Value>>& named,
                                std::string_view name) {
  for (const auto& [key, value] : named)
    if (key == name) return value;
  return std::nullopt;
}

// A frame of a bed together with the constants of its run.

/// References to a frame and to the constants of its run; owns neither.
struct BedFrame {
  const Frame& frame;
  const RunStatics& statics;
};

/// Returns the displacement of grain i since an earlier frame, m, continued across a periodic edge.
inline Vec2 displacement(const BedFrame& bed, const Frame& before, Index i) {
  const double periods = bed.statics.periodic ? bed.frame.image[i] - before.image[i] : 0;
  return {bed.frame.x[i] - before.x[i] + periods * bed.statics.length, bed.frame.y[i] - before.y[i]};
}

}  // namespace talus
