/// Rows of the table of quantities that describe rearrangements.

#include "analysis/quantities.h"

namespace talus::analysis {
namespace {

const std::string bursts = "event_velocity event_quiet";
const std::string movements = bursts + " event_displacement";
const std::string sizes = bursts + " event_size_min";

/// Returns the quantities of each event.
std::vector<Quantity> rows_of_events() {
  return {
      {&EventRecord::begin, "events/begin", "E", "rad",
       "tilt at which an event begins, the first step whose rms velocity reaches events/threshold", bursts},
      {&EventRecord::end, "events/end", "E", "rad",
       "tilt after its last such step; the bed is then quiet for events/quiet_time", bursts},
      {&EventRecord::time, "events/time", "E", "s", "simulated time at which it begins", bursts},
      {&EventRecord::duration, "events/duration", "E", "s",
       "time from its first to its last such step, both included", bursts},
      {&EventRecord::waiting, "events/waiting", "E", "rad",
       "increase of the tilt from the end of the preceding event; NaN for the first", bursts},
      {&EventRecord::kind, "events/kind", "E", "1",
       "0: a rearrangement; 1: the flow at failure and later events; 2: not over at the end of the tilt; "
       "distributions include kind 0 only",
       bursts},
      {&EventRecord::peak_velocity, "events/peak_velocity", "E", "m/s",
       "largest rms velocity of the free grains, from /steps", bursts},
      {&EventRecord::path, "events/path", "E", "m",
       "integral of the rms velocity over the event: path of the free grains", bursts},
      {&EventRecord::energy, "events/energy", "E", "J/m",
       "energy dissipated: work of gravity M g (sin(theta) dx - cos(theta) dy) on the centre of mass between "
       "two frames, at the mean of their tilts, times the share of the path between them that belongs to the "
       "event",
       bursts},
      {&EventRecord::volume_strain, "events/volume_strain", "E", "1",
       "change of the volume strain between the rows of observables before and after the event; negative = "
       "contraction",
       bursts},
      {&EventRecord::centre_of_mass_strain, "events/centre_of_mass_strain", "E", "1",
       "change of the centre-of-mass strain between these rows; positive = dilation", bursts},
      {&EventRecord::coordination_number, "events/coordination_number", "E", "1",
       "change of z between these rows", bursts},
      {&EventRecord::grains, "events/grains", "E", "1",
       "free grains displaced by at least event_displacement between the frames before and after the event; "
       "0 without a later frame",
       movements},
      {&EventRecord::depth, "events/depth", "E", "m",
       "depth below the mean free surface, V / L, above which 95 % of their displacement lies", movements},
      {&EventRecord::centre, "events/centre", "E 2", "m",
       "centre (x, y): mean position of these grains before the event, weighted by displacement", movements},
      {&EventRecord::frame_tilt, "events/frame_tilt", "E 2", "rad",
       "tilts of these two frames: the resolution of grains, depth, centre and energy", bursts},
      {&EventRecord::sharing, "events/sharing", "E", "1",
       "events that overlap the interval between these frames, this one included; grains, depth and centre "
       "refer to all of them",
       bursts},
  };
}

/// Returns the quantities of all events together.
std::vector<Quantity> rows_of_event_laws() {
  const std::string power_law =
      "maximum-likelihood power law (Clauset, Shalizi and Newman 2009); NaN with fewer than 10";
  return {
      {&Analysis::event_threshold, "events/threshold", "", "m/s",
       "rms velocity of the free grains from which the bed counts as rearranging", "event_velocity"},
      {&Analysis::event_noise, "events/noise", "", "m/s",
       "median rms velocity over the steps of the tilt outside events", bursts},
      {&Analysis::event_quiet_time, "events/quiet_time", "", "s",
       "time below the threshold after which an event is over", "event_quiet"},
      {&Analysis::event_count, "events/count", "", "1", "rearrangements: events of kind 0", bursts},
      {&Analysis::event_energy, "events/total_energy", "", "J/m",
       "total energy released by the rearrangements", bursts},
      {&Analysis::event_dilating_share, "events/dilating_share", "", "1",
       "share of the rearrangements with centre_of_mass_strain above 0; NaN without any", bursts},
      {&Analysis::event_dilating_share_error, "events/dilating_share_error", "", "1",
       "its standard error, sqrt(p (1 - p) / n)", bursts},
      {&Analysis::event_size_exponent, "events/size_exponent", "", "1",
       "exponent alpha of their sizes, density ~ energy^-alpha from size_minimum upwards: 1 + n / sum of "
       "ln(energy / size_minimum); " +
           power_law,
       sizes},
      {&Analysis::event_size_exponent_error, "events/size_exponent_error", "", "1",
       "its standard error, (alpha - 1) / sqrt(n)", sizes},
      {&Analysis::event_size_minimum, "events/size_minimum", "", "J/m",
       "lower end of the fitted energies: the one with the smallest size_distance, or event_size_min", sizes},
      {&Analysis::event_size_distance, "events/size_distance", "", "1",
       "largest distance between their cumulative distribution and that of the law (Kolmogorov-Smirnov)",
       sizes},
      {&Analysis::event_size_count, "events/size_count", "", "1",
       "n, rearrangements at or above size_minimum", sizes},
      {&Analysis::event_waiting_exponent, "events/waiting_exponent", "", "1",
       "exponent of the waiting angles in the same way; " + power_law, bursts},
      {&Analysis::event_waiting_exponent_error, "events/waiting_exponent_error", "", "1",
       "its standard error", bursts},
      {&Analysis::event_waiting_minimum, "events/waiting_minimum", "", "rad",
       "lower end of the fitted range of waiting angles", bursts},
      {&Analysis::event_waiting_distance, "events/waiting_distance", "", "1",
       "distance between the two cumulative distributions", bursts},
      {&Analysis::event_waiting_count, "events/waiting_count", "", "1",
       "n, waiting angles at or above waiting_minimum", bursts},
      {&Analysis::event_waiting_mean, "events/waiting_mean", "", "rad",
       "scale of an exponential law of the waiting angles, by maximum likelihood: their mean minus the "
       "smallest; NaN with fewer than 10",
       bursts},
      {&Analysis::event_waiting_mean_error, "events/waiting_mean_error", "", "rad",
       "its standard error, mean / sqrt(n), if the law holds", bursts},
  };
}

}  // namespace

std::vector<Quantity> event_quantities() {
  std::vector<Quantity> rows = rows_of_event_laws();
  for (Quantity& row : rows_of_events()) rows.push_back(std::move(row));
  return rows;
}

}  // namespace talus::analysis
