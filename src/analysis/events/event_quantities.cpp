#include "analysis/events/event_quantities.h"

namespace talus::analysis {
namespace {

const std::string bursts = "event_velocity event_quiet";
const std::string movements = bursts + " event_displacement";
const std::string sizes = bursts + " event_size_min";

/// Returns the quantities of each event.
std::vector<Quantity> rows_of_events() {
  return {
      {&EventRecord::begin, "events/begin", "E", "rad",
       "tilt at which an event begins: the first step whose rms velocity is at or above events/threshold",
       bursts},
      {&EventRecord::end, "events/end", "E", "rad",
       "tilt after its last such step, after which the bed is quiet for events/quiet_time", bursts},
      {&EventRecord::time, "events/time", "E", "s", "simulated time at which it begins", bursts},
      {&EventRecord::duration, "events/duration", "E", "s",
       "from its first to its last such step, both included", bursts},
      {&EventRecord::waiting, "events/waiting", "E", "rad",
       "angle by which the bed is turned after the end of the event before; NaN for the first", bursts},
      {&EventRecord::kind, "events/kind", "E", "1",
       "0 a rearrangement, 1 the flow that failed the slope and what comes after it, 2 one that is not over "
       "where the tilt ends; distributions are of those with 0",
       bursts},
      {&EventRecord::peak_velocity, "events/peak_velocity", "E", "m/s",
       "largest rms velocity of the free grains, from /steps", bursts},
      {&EventRecord::path, "events/path", "E", "m",
       "integral of the rms velocity over the event: the way that the free grains go in it, as a root mean "
       "square in each step",
       bursts},
      {&EventRecord::energy, "events/energy", "E", "J/m",
       "energy released: work of gravity on the displacements of the grains, M g (sin(theta) dx - cos(theta) "
       "dy), which contacts dissipate; that of the displacement of the centre of mass between two frames, at "
       "the mean of their tilts, of which an event has the share of the path that is gone in it",
       bursts},
      {&EventRecord::volume_strain, "events/volume_strain", "E", "1",
       "change of the volume strain from the row of observables before the event to that after it; negative "
       "= "
       "contraction",
       bursts},
      {&EventRecord::centre_of_mass_strain, "events/centre_of_mass_strain", "E", "1",
       "change of the centre-of-mass strain between the same rows, quieter; above 0 the bed dilates", bursts},
      {&EventRecord::coordination_number, "events/coordination_number", "E", "1",
       "change of z between the same rows", bursts},
      {&EventRecord::grains, "events/grains", "E", "1",
       "grains moved: free grains displaced by event_displacement or more from the frame before the event to "
       "the one after it; 0 where there is none after it",
       movements},
      {&EventRecord::depth, "events/depth", "E", "m",
       "depth below the mean free surface, V / L, above which lie 95 % of their displacement", movements},
      {&EventRecord::centre, "events/centre", "E 2", "m",
       "centre (x, y) of the event: mean place of these grains in the frame before, weighted by their "
       "displacement",
       movements},
      {&EventRecord::frame_tilt, "events/frame_tilt", "E 2", "rad",
       "tilts of these two frames: the resolution of grains moved, depth, centre and energy", bursts},
      {&EventRecord::sharing, "events/sharing", "E", "1",
       "events that have a part between these two frames, this one included: with more than one, grains "
       "moved, "
       "depth and centre are of all of them",
       bursts},
  };
}

/// Returns the quantities of all events together.
std::vector<Quantity> rows_of_event_laws() {
  const std::string power_law =
      "power law of maximum likelihood (Clauset, Shalizi and Newman 2009); NaN with fewer than 10";
  return {
      {&Analysis::event_threshold, "events/threshold", "", "m/s",
       "rms velocity of the free grains from which on the bed rearranges", "event_velocity"},
      {&Analysis::event_noise, "events/noise", "", "m/s",
       "median of the rms velocity over the steps of the tilt that belong to no event", bursts},
      {&Analysis::event_quiet_time, "events/quiet_time", "", "s",
       "time below the threshold after which an event is over", "event_quiet"},
      {&Analysis::event_count, "events/count", "", "1", "rearrangements: events of kind 0", bursts},
      {&Analysis::event_energy, "events/total_energy", "", "J/m", "energy that they released together",
       bursts},
      {&Analysis::event_dilating_share, "events/dilating_share", "", "1",
       "share of them that dilate the bed: whose centre_of_mass_strain is above 0; NaN without any", bursts},
      {&Analysis::event_dilating_share_error, "events/dilating_share_error", "", "1",
       "its standard error, sqrt(p (1 - p) / n)", bursts},
      {&Analysis::event_size_exponent, "events/size_exponent", "", "1",
       "exponent alpha of their sizes, density ~ energy^-alpha from size_minimum on: 1 + n / sum of "
       "ln(energy / size_minimum); " +
           power_law,
       sizes},
      {&Analysis::event_size_exponent_error, "events/size_exponent_error", "", "1",
       "its standard error, (alpha - 1) / sqrt(n)", sizes},
      {&Analysis::event_size_minimum, "events/size_minimum", "", "J/m",
       "energy from which on the law is fitted: that with the smallest size_distance, or event_size_min",
       sizes},
      {&Analysis::event_size_distance, "events/size_distance", "", "1",
       "largest distance between their cumulative distribution and that of the law (Kolmogorov-Smirnov)",
       sizes},
      {&Analysis::event_size_count, "events/size_count", "", "1", "n, rearrangements from there on", sizes},
      {&Analysis::event_waiting_exponent, "events/waiting_exponent", "", "1",
       "exponent of the waiting angles in the same way; " + power_law, bursts},
      {&Analysis::event_waiting_exponent_error, "events/waiting_exponent_error", "", "1",
       "its standard error", bursts},
      {&Analysis::event_waiting_minimum, "events/waiting_minimum", "", "rad",
       "waiting angle from which on the law is fitted", bursts},
      {&Analysis::event_waiting_distance, "events/waiting_distance", "", "1",
       "distance of both cumulative distributions", bursts},
      {&Analysis::event_waiting_count, "events/waiting_count", "", "1", "n, waiting angles from there on",
       bursts},
      {&Analysis::event_waiting_mean, "events/waiting_mean", "", "rad",
       "mean of all waiting angles less the smallest of them: the angle of an exponential law, by maximum "
       "likelihood; NaN with fewer than 10",
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
