/// Claims: one process owns a member, and the claim of a dead process is taken over.

#include "ensemble/claim.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <limits>
#include <thread>

#include "support/temporary_folder.h"

namespace talus::ensemble {
namespace {

const ClaimTimes quick{0.06};  // a heartbeat every 5 ms; dead after 60 ms

/// Writes a claim of a worker on another machine, with `beats` heartbeats.
void write_foreign_claim(const std::string& path, int beats) {
  std::ofstream(path) << "process 1 on host far, boot another\n" << std::string(beats, '.');
}

TEST(Claim, is_given_to_one) {
  const test::TemporaryFolder folder;
  const std::string run = folder.path("seed-1.h5");
  const std::optional<Claim> first = Claim::take(run, {}, quick);
  ASSERT_TRUE(first);
  EXPECT_FALSE(Claim::take(run, {}, quick));
  EXPECT_TRUE(std::filesystem::exists(folder.path("seed-1.claim-0")));
}

TEST(Claim, ends_with_the_object) {
  const test::TemporaryFolder folder;
  const std::string run = folder.path("seed-1.h5");
  { const std::optional<Claim> claim = Claim::take(run, {}, quick); }
  EXPECT_FALSE(std::filesystem::exists(claim_path(run, 0)));
  EXPECT_TRUE(Claim::take(run, {}, quick));
}

TEST(Claim, tells_who_has_it_and_counts_heartbeats) {
  const test::TemporaryFolder folder;
  const std::string run = folder.path("seed-1.h5");
  std::optional<Claim> claim = Claim::take(run, {}, quick);
  ASSERT_TRUE(claim);
  for (int k = 0; k < 2; ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(6));
    EXPECT_TRUE(claim->record_heartbeat());
  }
  const std::optional<ClaimHolder> holder = read_claim(run, 0);
  ASSERT_TRUE(holder);
  EXPECT_TRUE(holder->worker.starts_with("process " + std::to_string(getpid()) + " on host "))
      << holder->worker;
  EXPECT_EQ(holder->beats, 2u);
}

TEST(Claim, beats_only_as_often_as_it_is_told) {
  const test::TemporaryFolder folder;
  const std::string run = folder.path("seed-1.h5");
  std::optional<Claim> claim = Claim::take(run, {}, {7200.0});
  EXPECT_TRUE(claim->record_heartbeat());
  EXPECT_EQ(read_claim(run, 0)->beats, 0u);
}

TEST(Claim, is_alive_as_long_as_its_process_on_this_machine) {
  const test::TemporaryFolder folder;
  const std::string run = folder.path("seed-1.h5");
  ClaimWatch watch{quick, {}};
  {
    const std::optional<Claim> claim = Claim::take(run, {}, quick);
    std::this_thread::sleep_for(
        std::chrono::milliseconds(80));  // longer than the lifetime of a foreign claim
    EXPECT_EQ(claim_state(run, 0, watch), ClaimState::alive);
    std::filesystem::copy_file(claim_path(run, 0), folder.path("left"));
  }
  std::filesystem::rename(folder.path("left"), claim_path(run, 0));  // state after a kill: without a lock
  EXPECT_EQ(claim_state(run, 0, watch), ClaimState::dead);
}

TEST(Claim, of_another_machine_is_dead_once_it_has_not_grown_for_long_enough) {
  const test::TemporaryFolder folder;
  const std::string run = folder.path("seed-1.h5");
  ClaimWatch watch{quick, {}};
  write_foreign_claim(claim_path(run, 0), 3);
  EXPECT_EQ(claim_state(run, 0, watch), ClaimState::unknown);
  write_foreign_claim(claim_path(run, 0), 4);
  EXPECT_EQ(claim_state(run, 0, watch), ClaimState::alive);
  std::this_thread::sleep_for(std::chrono::milliseconds(80));
  EXPECT_EQ(claim_state(run, 0, watch), ClaimState::dead);
}

TEST(Claim, of_another_holder_counts_from_its_own_first_heartbeat) {
  const test::TemporaryFolder folder;
  const std::string run = folder.path("seed-1.h5");
  ClaimWatch watch{quick, {}};
  write_foreign_claim(claim_path(run, 0), 30);
  EXPECT_EQ(claim_state(run, 0, watch), ClaimState::unknown);
  std::this_thread::sleep_for(std::chrono::milliseconds(80));
  // Meanwhile its worker has released it, and another has taken it.
  std::ofstream(claim_path(run, 0)) << "process 2 on host farther, boot third\n.";
  EXPECT_EQ(claim_state(run, 0, watch), ClaimState::unknown);
}

TEST(Claim, of_the_next_number_replaces_a_dead_one_which_then_knows) {
  const test::TemporaryFolder folder;
  const std::string run = folder.path("seed-1.h5");
  std::optional<Claim> old = Claim::take(run, {}, quick);
  ASSERT_TRUE(old->record_heartbeat());
  std::optional<Claim> next = Claim::take(run, 0, quick);
  ASSERT_TRUE(next);
  EXPECT_FALSE(old->record_heartbeat());
  EXPECT_TRUE(next->record_heartbeat());
  EXPECT_FALSE(Claim::take(run, 0, quick)) << "another process that found the same dead claim";
  EXPECT_FALSE(std::filesystem::exists(claim_path(run, 0)));
}

TEST(Claim, is_not_taken_over_from_one_that_has_ended_meanwhile) {
  const test::TemporaryFolder folder;
  const std::string run = folder.path("seed-1.h5");
  EXPECT_FALSE(Claim::take(run, 0, quick)) << "claim 0 was released, and claim 1 would not exclude a new 0";
  EXPECT_FALSE(std::filesystem::exists(claim_path(run, 1)));
}

TEST(Claim, that_was_removed_is_lost) {
  const test::TemporaryFolder folder;
  const std::string run = folder.path("seed-1.h5");
  std::optional<Claim> claim = Claim::take(run, {}, quick);
  std::filesystem::remove(claim_path(run, 0));
  EXPECT_FALSE(claim->record_heartbeat());
}

TEST(Claim, is_lost_to_one_of_a_higher_number) {
  const test::TemporaryFolder folder;
  const std::string run = folder.path("seed-1.h5");
  std::optional<Claim> claim = Claim::take(run, {}, quick);
  write_foreign_claim(claim_path(run, 1), 0);  // its worker has not yet removed the previous one
  EXPECT_FALSE(claim->record_heartbeat());
}

TEST(Claim, lives_as_long_as_a_process_that_its_worker_has_started) {
  const test::TemporaryFolder folder;
  const std::string run = folder.path("seed-1.h5");
  const std::optional<Claim> claim = Claim::take(run, {}, quick);
  const int file = open(claim_path(run, 0).c_str(), O_RDONLY | O_CLOEXEC);
  // The claim is held by the descriptor, which children inherit.
  int inherited = 0;
  for (int k = 3; k < 64; ++k) {
    struct stat here {
    }, there{};
    if (k != file && fstat(k, &here) == 0 && fstat(file, &there) == 0 && here.st_ino == there.st_ino)
      inherited += (fcntl(k, F_GETFD) & FD_CLOEXEC) == 0 ? 1 : 0;
  }
  EXPECT_EQ(inherited, 1);
  close(file);
}

TEST(Claim, of_the_last_number_is_replaced_by_one_that_is_free) {
  const test::TemporaryFolder folder;
  const std::string run = folder.path("seed-1.h5");
  const int last = std::numeric_limits<int>::max();
  for (const int number : {0, last}) write_foreign_claim(claim_path(run, number), 0);
  std::optional<Claim> claim = Claim::take(run, last, quick);
  ASSERT_TRUE(claim);
  EXPECT_EQ(claim->number(), 1);
  EXPECT_TRUE(claim->record_heartbeat());
  EXPECT_FALSE(std::filesystem::exists(claim_path(run, last)));
  EXPECT_EQ(claims_of(run).size(), 2u);
}

TEST(ClaimName, is_that_of_its_run_with_a_number) {
  const std::optional<ClaimName> name = parse_claim_name("seed-7.claim-12");
  ASSERT_TRUE(name);
  EXPECT_EQ(name->run, "seed-7");
  EXPECT_EQ(name->number, 12);
  for (const char* other : {"seed-7.h5", "seed-7.claim-", "seed-7.claim-x", "seed-7.claim-1x",
                            "seed-7.claim--1", "seed-7.claim-01", "seed-7.claim-2147483648"})
    EXPECT_FALSE(parse_claim_name(other)) << other;
}

}  // namespace
}  // namespace talus::ensemble
