#pragma once
/// Whether a team of threads is worth its waiting.

namespace talus::solver {

/// Where other processes want the processors too, the members of a team wait for each other more than they
/// help. This measures what work costs in the team and alone, and tells which is the faster at present; it
/// begins with the team. For results that do not depend on it.
class TeamChoice {
 public:
  /// How to do what comes next.
  bool in_team() const { return in_team_; }

  /// Tells how long something took, s of wall time, that was done as in_team() said, and how much work it
  /// was, in any unit of which a certain number takes a certain time.
  void add(double seconds, double work);

 private:
  void decide(double cost);
  void turn() { in_team_ = !in_team_; }

  bool in_team_ = true;
  bool on_trial_ = false;
  double seconds_ = 0.0, work_ = 0.0;  ///< of the window under way
  double usual_cost_ = 0.0;            ///< s for a unit of work, of late windows; none on trial
  double least_alone_ = 0.0;           ///< the least that work has cost alone; 0: never tried
  int settled_ = 0;                    ///< windows since the last trial
  int patience_ = 0;                   ///< windows from a trial to the next
};

}  // namespace talus::solver
