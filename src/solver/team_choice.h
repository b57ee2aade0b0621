#pragma once
/// The choice between a team of threads and a single thread.

namespace talus::solver {

/// Decides whether a team or a single thread is faster at present, from the measured cost of work in both. If
/// other processes need the processors, the members of a team wait for each other more than they help. Starts
/// with the team. Results must not depend on the choice.
class TeamChoice {
 public:
  /// Whether the next work should be done by the team.
  bool in_team() const { return in_team_; }

  /// Records the wall time, s, of work that was done as in_team() said, and its amount in any unit
  /// proportional to time.
  void add(double seconds, double work);

 private:
  void decide(double cost);
  void turn() { in_team_ = !in_team_; }

  bool in_team_ = true;
  bool on_trial_ = false;
  double seconds_ = 0.0, work_ = 0.0;  ///< time and work of the present window
  double usual_cost_ = 0.0;            ///< s per unit of work in recent windows, trials excluded
  double min_alone_ = 0.0;             ///< smallest cost of a single thread; 0: never tried
  int windows_since_trial_ = 0;        ///< windows since the last trial
  int trial_interval_ = 0;             ///< windows between two trials
};

}  // namespace talus::solver
