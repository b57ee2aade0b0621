#pragma once
/// Runs that are carried through, in memory and into files.

#include <gtest/gtest.h>

#include <functional>
#include <span>
#include <string>

#include "base/text.h"
#include "io/run_file.h"
#include "session/frame_state.h"
#include "session/run.h"
#include "session/run_header.h"

namespace talus::test {

constexpr std::int64_t to_the_end = 1'000'000;  ///< steps, more than any of these runs has

inline void run_session(session::Session& session) {
  while (session.phase() != session::Phase::done) session.advance();
}

inline session::Session finished(const scenario::Scenario& scenario) {
  session::Session session(scenario);
  run_session(session);
  return session;
}

/// Steps a run to the end of its deposition.
inline void begin_tilt(session::Session& session) {
  while (session.phase() == session::Phase::deposition) session.advance();
}

inline session::Session tilting(const scenario::Scenario& scenario) {
  session::Session session(scenario);
  begin_tilt(session);
  return session;
}

inline std::uint64_t hash_of(const session::Session& session) { return state_hash(session.world()); }

/// Returns all values of the schedule of a run that its checkpoint stores, to the last bit.
inline std::string stored_values(const session::Session& session) {
  const io::Checkpoint stored = session.checkpoint(0.0);
  const auto text_of = [](const auto& value) { return fmt::format("{}={}", value.first, value.second); };
  return joined(stored.integers, "\n", text_of) + joined(stored.reals, "\n", text_of) +
         joined(stored.results, "\n", text_of);
}

/// Carries a run with commands at given steps through into a packed file.
inline io::RunFile recorded(session::Session& session, const std::string& path,
                            std::span<const Command> commands = {}, const session::RunOrigin& origin = {}) {
  io::RunStore store = io::RunStore::create(path, session::run_header(session, origin), false);
  EXPECT_EQ(session::replay(session, &store, commands, to_the_end, {}), session::RunEnd::complete);
  return io::RunFile::open(path);
}

inline io::RunFile recorded(const scenario::Scenario& scenario, const std::string& path,
                            std::span<const Command> commands = {}) {
  session::Session session(scenario);
  return recorded(session, path, commands);
}

/// Begins a branch, with this scenario, and carries it through.
inline io::RunFile recorded_branch(const scenario::Scenario& scenario, const io::BranchOrigin& origin,
                                   const std::string& path, std::span<const Command> commands = {}) {
  session::Session session(scenario, origin.start);
  session.record_start();
  return recorded(session, path, commands, {"", "", "", 1, origin});
}

/// Writes what a session holds into a packed file, of which `change` may have changed something.
inline io::RunFile stored(const session::Session& session, const std::string& path,
                          const std::function<void(io::Segment&)>& change = {}) {
  io::Segment segment = session.segment();
  if (change) change(segment);
  io::RunStore store = io::RunStore::create(path, session::run_header(session, {}), false);
  store.commit(segment, session.checkpoint(0.0));
  store.pack();
  return io::RunFile::open(path);
}

}  // namespace talus::test
