#include "session/deposition.h"

#include <cmath>
#include <fmt/core.h>

#include "base/hash.h"
#include "core/trigonometry.h"

namespace talus::session {
namespace {

/// Coefficient of restitution above which a bed comes to rest late, and never at 1.
constexpr double elastic = 0.9;

dynamics::BedPlan bed_plan(const Scenario& scenario) {
  return {.mean_diameter = scenario.grains.mean_diameter,
          .size_ratio = scenario.grains.size_ratio,
          .density = scenario.grains.density,
          .length = scenario.bed.length * scenario.grains.mean_diameter,
          .grain_count = static_cast<Index>(std::lround(scenario.bed.length * scenario.bed.depth)),
          .periodic = scenario.bed.boundary == scenario::BedBoundary::periodic,
          .rough_floor = scenario.bed.floor == scenario::BedFloor::rough,
          .seed = scenario.seed};
}

World bed_without_grains(const dynamics::BedPlan& plan) {
  World world = dynamics::empty_bed(plan);
  dynamics::add_floor(plan, world);
  return world;
}

}  // namespace

World initial_bed(const Scenario& scenario, std::string* remark) {
  const dynamics::BedPlan plan = bed_plan(scenario);
  const Scenario::Deposition& deposition = scenario.deposition;
  if (deposition.method == scenario::DepositionMethod::collapse)
    return dynamics::make_loose_bed(plan, deposition.initial_solid_fraction);
  if (deposition.method == scenario::DepositionMethod::geometric)
    return dynamics::make_geometric_bed(
        plan, {.critical_angle = radians(deposition.critical_angle), .sites = deposition.sites});
  if (deposition.method == scenario::DepositionMethod::file)
    return bed_of_file({deposition.file, deposition.frame, deposition.file_unit, deposition.file_scale,
                        deposition.relax, scenario.bed.depth * plan.mean_diameter},
                       plan, remark);
  return bed_without_grains(plan);
}

std::string bed_hash(const Scenario& scenario) {
  const bool from_file = scenario.deposition.method == scenario::DepositionMethod::file;
  return from_file ? hash_text(state_hash(initial_bed(scenario))) : std::string();
}

Boundary boundary_of(const Scenario& scenario) { return bed_without_grains(bed_plan(scenario)).boundary; }

Index grain_count(const Scenario& scenario) {
  if (scenario.deposition.method == scenario::DepositionMethod::file)
    return initial_bed(scenario).grains.free_count;
  return bed_plan(scenario).grain_count;
}

std::vector<dynamics::Arrival> arrivals_of(const Scenario& scenario) {
  if (scenario.deposition.method != scenario::DepositionMethod::pour) return {};
  return dynamics::pour_arrivals(bed_plan(scenario));
}

dynamics::PourRule pour_rule(const Scenario& scenario) {
  const double diameter = scenario.grains.mean_diameter, gravity = World().gravity;
  return {.speed = scenario.deposition.arrival_speed * std::sqrt(gravity * diameter),
          .interval = std::sqrt(diameter / gravity) / (scenario.deposition.rate * scenario.bed.length),
          .density = scenario.grains.density};
}

std::string advice_for_rest(const Scenario& scenario, double velocity) {
  const Scenario::ContactLaw& law = scenario.contact;
  const double rest = scenario.deposition.rest_velocity, usual = Scenario::Deposition().rest_velocity;
  const auto keeps = [](const char* key, double value) {
    const bool whole = std::fabs(value) == 1.0;
    return fmt::format("with {} = {:g}, impacts dissipate {} energy{}: set it closer to 0{}", key, value,
                       whole ? "no" : "little",
                       whole ? ", so neither more time nor a lower tolerance helps" : "",
                       whole ? "" : ", or allow more time (deposition.max_time)");
  };
  if (law.restitution > elastic) return keeps("contact.restitution", law.restitution);
  if (std::fabs(law.tangential_restitution) > elastic)
    return keeps("contact.tangential_restitution", law.tangential_restitution);
  if (velocity < rest)
    return "it has only just fallen below that, or the solver misses its tolerance: allow more time "
           "(deposition.max_time), or raise solver.max_iterations";
  if (velocity < usual)
    return fmt::format("set deposition.rest_velocity higher: beds come to rest with the default of {:g}",
                       usual);
  return "allow more time (deposition.max_time), or set solver.moving_tolerance or solver.tolerance lower";
}

double end_of_arrivals(const Scenario& scenario) {
  if (scenario.deposition.method != scenario::DepositionMethod::pour) return 0.0;
  return pour_rule(scenario).interval * (bed_plan(scenario).grain_count - 1);
}

}  // namespace talus::session
