/// Run whose contacts resist rolling: its files, its memory, its check, and requests that reject it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "base/errors.h"
#include "problems/step_problem.h"
#include "session/run.h"
#include "session/run_check.h"
#include "session/run_header.h"
#include "support/small_bed.h"
#include "support/temporary_folder.h"

namespace talus::session {
namespace {

scenario::Scenario rolling_bed(double rolling_friction = 0.2) {
  scenario::Scenario scenario = test::small_tilted_bed(1.0);
  scenario.contact.rolling_friction = rolling_friction;
  return scenario;
}

io::RunHeader header_of(const Session& session) { return run_header(session, {"", {}, "", 1}); }

/// Carries a run through to a packed file.
std::uint64_t carried_through(const scenario::Scenario& scenario, const std::string& path) {
  Session session(scenario);
  io::RunStore store = io::RunStore::create(path, header_of(session), false);
  EXPECT_EQ(run_to_end(session, store, {}), RunEnd::complete);
  return state_hash(session.world());
}

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(RollingRun, stores_its_moments) {
  const test::TemporaryFolder folder;
  const std::uint64_t end = carried_through(rolling_bed(), folder.path("run.h5"));
  const io::RunFile run = io::RunFile::open(folder.path("run.h5"));
  EXPECT_EQ(state_hash(run.checkpoint().world), end);
  EXPECT_EQ(run.checkpoint().world.contacts.moment.size(), run.checkpoint().world.contacts.a.size());
  ASSERT_GE(run.all_frame_tilts().size(), 3u);
  double largest = 0.0;
  for (std::size_t k = 0; k < run.all_frame_tilts().size(); ++k) {
    const Frame frame = run.frame(k);
    EXPECT_TRUE(run.is_as_written(frame, k)) << k;
    ASSERT_EQ(frame.contacts.moment.size(), frame.contacts.a.size()) << k;
    for (const double moment : frame.contacts.moment) largest = std::max(largest, std::fabs(moment));
  }
  EXPECT_GT(largest, 0.0);
  const RunCheck check = check_run(run, {});
  EXPECT_TRUE(check.faults.empty()) << check.faults.front();
}

TEST(RollingRun, that_rolls_freely_stores_none) {
  const test::TemporaryFolder folder;
  carried_through(rolling_bed(0.0), folder.path("run.h5"));
  const io::RunFile run = io::RunFile::open(folder.path("run.h5"));
  EXPECT_TRUE(run.checkpoint().world.contacts.moment.empty());
  EXPECT_TRUE(run.frame(0).contacts.moment.empty());
  EXPECT_EQ(text_of(folder.path("run.h5")).find("/checkpoint/contact_moment"), std::string::npos);
  carried_through(rolling_bed(), folder.path("rolling.h5"));
  EXPECT_NE(text_of(folder.path("rolling.h5")).find("/checkpoint/contact_moment"), std::string::npos);
}

// Commits after each frame and continues from the files.
TEST(RollingRun, resumed_from_its_files_gives_the_same_bits) {
  const test::TemporaryFolder folder;
  const scenario::Scenario scenario = rolling_bed();
  const std::uint64_t end = carried_through(scenario, folder.path("whole.h5"));
  const std::string path = folder.path("run.h5");
  Session begun(scenario);
  const io::RunHeader header = header_of(begun);
  {
    io::RunStore store = io::RunStore::create(path, header, false);
    for (int k = 0; k < 5; ++k) begun.advance();
    store.commit(begun.segment(), begun.checkpoint(0.0));
  }
  for (int more = 0; more < 4; ++more) {
    io::Checkpoint checkpoint;
    io::RunHeader stored = header;
    io::RunStore store = io::RunStore::resume(path, stored, checkpoint);
    Session session(scenario, std::move(checkpoint));
    for (int k = 0; k < 40 && session.phase() != Phase::done; ++k) session.advance();
    store.commit(session.segment(), session.checkpoint(0.0));
  }
  io::Checkpoint checkpoint;
  io::RunHeader stored = header;
  io::RunStore store = io::RunStore::resume(path, stored, checkpoint);
  Session session(scenario, std::move(checkpoint));
  EXPECT_EQ(run_to_end(session, store, {}), RunEnd::complete);
  EXPECT_EQ(state_hash(session.world()), end);
  const io::RunFile whole = io::RunFile::open(folder.path("whole.h5")), resumed = io::RunFile::open(path);
  ASSERT_EQ(whole.all_frame_tilts(), resumed.all_frame_tilts());
  for (std::size_t k = 0; k < whole.all_frame_tilts().size(); ++k)
    EXPECT_EQ(whole.frame(k).contacts.moment, resumed.frame(k).contacts.moment) << k;
}

TEST(RollingRun, with_a_moment_that_cannot_be_is_found) {
  const test::TemporaryFolder folder;
  Session session(rolling_bed());
  while (session.phase() != Phase::done) session.advance();
  io::Segment segment = session.segment();
  const auto& moments = segment.frames[1].contacts.moment;
  ASSERT_FALSE(moments.empty());
  segment.frames[1].contacts.moment[0] = 1.0 + std::fabs(moments[0]) * 100.0;
  io::RunStore store = io::RunStore::create(folder.path("run.h5"), header_of(session), false);
  store.commit(segment, session.checkpoint(0.0));
  store.pack();
  std::string faults;
  for (const std::string& fault : check_run(io::RunFile::open(folder.path("run.h5")), {}).faults)
    faults += fault + "\n";
  EXPECT_NE(faults.find("mu_r (r_a + r_b) f_n, rolling friction allows 1"), std::string::npos) << faults;
}

TEST(RollingRun, has_no_problem_of_a_step_and_no_admissible_forces) {
  const test::TemporaryFolder folder;
  carried_through(rolling_bed(), folder.path("run.h5"));
  const io::RunFile run = io::RunFile::open(folder.path("run.h5"));
  const auto refusal = [](const auto& ask) -> std::string {
    try {
      ask();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_data);
      return error.what();
    }
    return "";
  };
  for (const std::string& message : {refusal([&] { problems::problem_after_frame(run, 1); }),
                                     refusal([&] { problems::frozen_frame(run, 1); })})
    EXPECT_NE(message.find("contact.rolling_friction = 0.2"), std::string::npos) << message;
}

}  // namespace
}  // namespace talus::session
