/// Access to run stores, and rejected requests.

#include "io/run_store.h"

#include <gtest/gtest.h>
#include <hdf5.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "io/durable_file.h"
#include "io/run_file.h"
#include "io/run_folder.h"
#include "support/exit_code.h"
#include "support/process.h"
#include "unit/io/example_run.h"

namespace talus::io {
namespace {

namespace fs = std::filesystem;

class RunStoreTest : public test::FolderTest {
 protected:
  const std::string path = folder.path("run.h5");
};

TEST_F(RunStoreTest, a_second_writer_is_refused_and_told_whose_the_run_is) {
  const RunStore store = example::store_with_commits(path, 1);
  RunHeader header;
  Checkpoint checkpoint;
  const std::string owner = "process " + std::to_string(getpid()) + " on host ";
  EXPECT_TRUE(test::refuses([&] { RunStore::create(path, example::header(), true); }, ExitCode::cannot_create,
                            {owner}));
  EXPECT_TRUE(
      test::refuses([&] { RunStore::resume(path, header, checkpoint); }, ExitCode::cannot_create, {owner}));
  EXPECT_EQ(RunFile::open(path).frame_count(), 0u);  // nothing was changed
}

TEST_F(RunStoreTest, a_run_is_told_from_a_scenario_by_what_it_holds) {
  const auto with = [this](const std::string& name, const std::string& bytes) {
    std::ofstream(folder.path(name), std::ios::binary) << bytes;
    return is_run(folder.path(name));
  };
  EXPECT_TRUE(with("packed", "talus run file 1\nsize 0"));
  EXPECT_TRUE(with("other", "\x89HDF\r\n\x1a\n"));
  EXPECT_TRUE(with("named.h5", ""));
  EXPECT_FALSE(with("bed.toml", "seed = 1\n"));
  EXPECT_FALSE(with("empty", ""));
  EXPECT_TRUE(is_run(folder.path("not_there.h5"))) << "its ending marks it as a run";
  EXPECT_FALSE(is_run(folder.path("not_there.toml")));
  EXPECT_TRUE(is_run(folder.path("")));
}

TEST_F(RunStoreTest, a_run_is_refused_where_one_exists) {
  { const RunStore store = example::store_with_commits(path, 2); }
  const auto create = [&] { RunStore::create(path, example::header(), false); };
  EXPECT_EQ(run_presence(path), RunPresence::folder);
  EXPECT_EQ(test::exit_code_of(create), ExitCode::cannot_create);

  RunHeader header;
  Checkpoint checkpoint;
  RunStore::resume(path, header, checkpoint).pack();
  EXPECT_EQ(run_presence(path), RunPresence::packed);
  const std::string before = test::text_of(path);
  EXPECT_EQ(test::exit_code_of(create), ExitCode::cannot_create);
  EXPECT_TRUE(test::text_of(path) == before);
  EXPECT_FALSE(fs::exists(run_folder(path)));
}

TEST_F(RunStoreTest, overwrite_replaces_a_run_but_never_a_folder_or_a_foreign_file_in_it) {
  example::store_with_commits(path, 2).pack();
  const std::string before = test::text_of(path);
  fs::create_directory(run_folder(path));
  example::write_text(run_folder(path) + "/notes.txt", "mine");
  {
    RunStore store = RunStore::create(path, example::header(), true);
    EXPECT_EQ(run_presence(path), RunPresence::packed) << "the old run, until the new one has begun";
    store.commit(example::segment(1), example::checkpoint(1));
    EXPECT_EQ(run_presence(path), RunPresence::folder);
    EXPECT_TRUE(test::text_of(path) == before) << "it stays until the new one is complete";
    store.pack();
  }
  EXPECT_EQ(RunFile::open(path).frame_count(), 1u);
  EXPECT_EQ(test::names_in(run_folder(path)), std::set<std::string>{"notes.txt"});

  fs::create_directory(folder.path("folder.h5"));
  EXPECT_EQ(test::exit_code_of([&] { RunStore::create(folder.path("folder.h5"), example::header(), true); }),
            ExitCode::cannot_create);
}

TEST_F(RunStoreTest, a_run_that_has_not_ended_stays_until_the_one_that_replaces_it_begins) {
  { const RunStore old = example::store_with_commits(path, 2); }
  const std::size_t frames = RunFile::open(path).frame_count();
  RunStore store = RunStore::create(path, example::header(), true);
  EXPECT_EQ(RunFile::open(path).frame_count(), frames);
  store.commit(example::segment(1), example::checkpoint(1));
  EXPECT_EQ(RunFile::open(path).frame_count(), 1u);
  EXPECT_EQ(test::names_in(run_folder(path)).size(), 5u) << "header, lock, manifest, segment, checkpoint";
}

// Reader and writer have the same bounds.
TEST_F(RunStoreTest, writes_nothing_that_cannot_be_read) {
  const auto refuses_header = [&](const auto& spoil) {
    RunHeader header = example::header();
    spoil(header);
    const test::Refusal refusal = test::refusal_of([&] { RunStore::create(path, header, false); });
    EXPECT_EQ(refusal.code, ExitCode::bad_data);
    EXPECT_FALSE(fs::exists(run_folder(path)));
    return refusal.message;
  };
  EXPECT_EQ(refuses_header([](RunHeader& header) { header.statics.radius[2] = 9e-6; }),
            "the run cannot be stored: its data set /particles/grains/radius holds 9e-06 at index 2, "
            "expected 1e-05 "
            "to 10; what was committed before is kept");
  refuses_header([](RunHeader& header) { header.statics.radius[0] = 11.0; });
  refuses_header([](RunHeader& header) { header.statics.mass[1] = -1.0; });
  refuses_header([](RunHeader& header) { header.statics.depth = 1e-4; });
  refuses_header([](RunHeader& header) { header.statics.length = 2e4; });
  refuses_header([](RunHeader& header) { header.statics.free_count = 0; });
  refuses_header([](RunHeader& header) { header.statics.gravity = std::nan(""); });

  RunStore store = example::store_with_commits(path, 2);
  const std::size_t frames = RunFile::open(path).frame_count();
  const auto refuses = [&](const auto& spoil) {
    Segment segment = example::segment(2);
    Checkpoint checkpoint = example::checkpoint(2);
    ASSERT_FALSE(segment.frames.empty());
    spoil(segment, checkpoint);
    EXPECT_EQ(test::exit_code_of([&] { store.commit(segment, checkpoint); }), ExitCode::bad_data);
    EXPECT_EQ(RunFile::open(path).frame_count(), frames) << "the earlier commit stays";
  };
  using S = Segment&;
  using C = Checkpoint&;
  // 1e4 (2/3 m + 0.4 m) is the farthest place.
  refuses([](S segment, C) { segment.frames[0].y[1] = 10667.0; });
  refuses([](S segment, C) { segment.frames[0].vx[0] = 1e39; });  // infinite in single precision
  refuses([](S segment, C) { segment.frames[0].internal_moment[0].xy = std::nan(""); });
  refuses([](S segment, C) { segment.frames[0].contacts.b.at(0) = 8; });
  refuses([](S segment, C) { segment.frames[0].contacts.shift.at(0) = 101; });
  refuses([](S segment, C) { at(segment.observables[0], Observable::tilt) = std::nan(""); });
  refuses([](S segment, C) { segment.commands.at(0).x = std::nan(""); });
  refuses([](S, C checkpoint) { checkpoint.world.tilt = 1.7; });
  refuses([](S, C checkpoint) { checkpoint.world.grains.x[0] = 1e9; });
  refuses([](S, C checkpoint) { checkpoint.world.grains.inverse_mass[0] = HUGE_VAL; });
  refuses([](S, C checkpoint) { checkpoint.world.contacts.b[0] = 100; });
  refuses([](S, C checkpoint) { checkpoint.world.step = -1; });
  store.commit(example::segment(2), example::checkpoint(2));
  EXPECT_GT(RunFile::open(path).frame_count(), frames);
}

TEST_F(RunStoreTest, is_packed_over_nothing_that_has_appeared_under_its_name) {
  const std::string other = folder.path("other.h5");
  example::store_with_commits(other, 3).pack();
  for (const bool is_run : {false, true}) {
    RunStore store = example::store_with_commits(path, 2);
    is_run ? static_cast<void>(fs::copy_file(other, path)) : example::write_text(path, "precious");
    const std::string before = test::text_of(path);
    EXPECT_TRUE(
        test::refuses([&] { store.pack(); }, ExitCode::cannot_create, {"the run is in " + run_folder(path)}));
    EXPECT_TRUE(test::text_of(path) == before);
    EXPECT_EQ(run_presence(path), RunPresence::folder);
    EXPECT_FALSE(RunFile::open(path).complete());
    discard_folder(path);
    EXPECT_EQ(run_presence(path), RunPresence::folder) << "nothing else removes it";
    fs::remove(path);
    store.pack();
    EXPECT_TRUE(RunFile::open(path).complete());
    EXPECT_FALSE(fs::exists(run_folder(path)));
    fs::remove(path);
  }
}

TEST_F(RunStoreTest, of_an_interrupted_run_is_not_discarded_for_another_run_of_its_name) {
  const std::string other = folder.path("other.h5");
  example::store_with_commits(other, 3).pack();
  { const RunStore store = example::store_with_commits(path, 2); }
  fs::copy_file(other, path);
  EXPECT_EQ(run_presence(path), RunPresence::packed);
  discard_folder(path);
  EXPECT_TRUE(fs::exists(run_folder(path) + "/manifest"));
  fs::remove(path);
  EXPECT_EQ(run_presence(path), RunPresence::folder);
}

TEST_F(RunStoreTest, what_was_never_committed_does_not_exist) {
  { const RunStore begun = RunStore::create(path, example::header(), false); }
  EXPECT_EQ(run_presence(path), RunPresence::none);
  EXPECT_EQ(test::exit_code_of([&] { RunFile::open(path); }), ExitCode::missing_input);
  RunHeader header;
  Checkpoint checkpoint;
  EXPECT_EQ(test::exit_code_of([&] { RunStore::resume(path, header, checkpoint); }), ExitCode::missing_input);
  example::store_with_commits(path, 1);  // create takes over the folder
  EXPECT_EQ(run_presence(path), RunPresence::folder);
}

TEST_F(RunStoreTest, resume_clears_leftovers_away_and_keeps_what_is_committed) {
  { const RunStore store = example::store_with_commits(path, 2); }
  const std::set<std::string> before = test::names_in(run_folder(path));
  for (const char* name : {"segment_000003.h5", "checkpoint_000003-abcdefgh.h5", "manifest.talus.part",
                           "segment_000004-abcdefgh.h5.talus.part", "manifest-abcdefgh.talus.part"})
    example::write_text(run_folder(path) + "/" + name, "half");
  RunHeader header;
  Checkpoint checkpoint;
  const RunStore resumed = RunStore::resume(path, header, checkpoint);
  EXPECT_EQ(test::names_in(run_folder(path)), before);
  std::vector<std::string> kinds;
  for (const std::string& name : before) kinds.push_back(name.substr(0, name.find('-')));
  EXPECT_EQ(kinds, (std::vector<std::string>{"checkpoint_000002", "header_000001", "lock", "manifest",
                                             "segment_000001", "segment_000002"}));
}

/// Returns the number of filters (shuffle, deflate) on the angles of the grains in a file.
int filters_of_angles(const std::string& path) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t set = H5Dopen2(file, "/particles/grains/angle/value", H5P_DEFAULT);
  const hid_t creation = H5Dget_create_plist(set);
  const int filters = H5Pget_nfilters(creation);
  H5Pclose(creation);
  H5Dclose(set);
  H5Fclose(file);
  return filters;
}

TEST_F(RunStoreTest, compresses_the_packed_run_and_not_its_segments) {
  RunStore store = example::store_with_commits(path, 2);
  EXPECT_EQ(filters_of_angles(test::path_beginning(run_folder(path), "segment_000002")), 0);
  store.pack();
  EXPECT_EQ(filters_of_angles(path), 2);
}

TEST_F(RunStoreTest, a_missing_parent_folder_is_created) {
  RunStore store = RunStore::create(folder.path("no/run.h5"), example::header(), false);
  store.commit(example::segment(1), example::checkpoint(1));
  EXPECT_EQ(RunFile::open(folder.path("no/run.h5")).frame_count(), 1u);
}

TEST_F(RunStoreTest, a_name_of_another_kind_of_file_is_refused) {
  EXPECT_TRUE(test::refuses([&] { RunStore::create(folder.path("no/run.txt"), example::header(), false); },
                            ExitCode::usage, {"such as " + folder.path("no/run.h5")}));
  EXPECT_FALSE(std::filesystem::exists(folder.path("no")));
}

TEST_F(RunStoreTest, a_frame_of_another_size_is_refused_as_a_defect) {
  RunStore store = RunStore::create(folder.path("run.h5"), example::header(), false);
  Segment segment = example::segment(1);
  segment.frames[0].gamma.pop_back();
  EXPECT_EQ(test::exit_code_of([&] { store.commit(segment, example::checkpoint(1)); }), ExitCode::internal);
  store.commit(example::segment(1), example::checkpoint(1));  // the failed commit left no obstacle
  EXPECT_EQ(RunFile::open(folder.path("run.h5")).frame_count(), 1u);
}

TEST_F(RunStoreTest, a_state_lacks_grains_that_have_not_arrived_but_no_others) {
  RunStore store = RunStore::create(path, example::header(), false);
  Checkpoint poured;
  add_disk(poured.world.grains, {0.0, 0.0}, 0.5, 1.0, false);
  for (Index floor = 0; floor < example::grain_count - example::free_grain_count; ++floor)
    add_disk(poured.world.grains, {0.0, 0.0}, 0.5, 1.0, true);
  poured.world.boundary.length = 1.0;
  store.commit({}, poured);
  EXPECT_EQ(RunFile::open(path).checkpoint().world.grains.free_count, 1);
  add_disk(poured.world.grains, {0.0, 0.0}, 0.5, 1.0, true);
  store.commit({}, poured);
  EXPECT_EQ(test::exit_code_of([&] { RunFile::open(path); }), ExitCode::bad_data)
      << "no floor grain is missing";
}

TEST_F(RunStoreTest, nothing_is_written_into_a_folder_that_took_the_place_of_its_own) {
  RunStore store = example::store_with_commits(path, 2);
  fs::rename(run_folder(path), folder.path("moved.run"));
  const auto commit = [&] { store.commit(example::segment(2), example::checkpoint(2)); };
  EXPECT_EQ(test::exit_code_of(commit), ExitCode::cannot_create);
  const RunStore other = example::store_with_commits(path, 1);
  const std::set<std::string> before = test::names_in(run_folder(path));
  EXPECT_EQ(test::exit_code_of(commit), ExitCode::cannot_create);
  EXPECT_TRUE(test::refuses([&] { store.pack(); }, ExitCode::cannot_create, {"removed or replaced"}));
  EXPECT_EQ(test::names_in(run_folder(path)), before);
  EXPECT_FALSE(fs::exists(path));
}

TEST_F(RunStoreTest, the_folder_of_a_packed_run_can_be_discarded_and_no_other) {
  { const RunStore store = example::store_with_commits(path, 2); }
  discard_folder(path);
  EXPECT_EQ(run_presence(path), RunPresence::folder);
  fs::copy(run_folder(path), folder.path("copy"));
  RunHeader header;
  Checkpoint checkpoint;
  RunStore::resume(path, header, checkpoint).pack();
  fs::rename(folder.path("copy"), run_folder(path));
  discard_folder(path);
  EXPECT_TRUE(fs::exists(run_folder(path))) << "it may be of another run";
  Manifest manifest = read_manifest(run_folder(path));
  manifest.packed_seal = seal_hash_of(path);
  example::write_text(run_folder(path) + "/manifest", manifest_text(manifest));
  discard_folder(path);
  EXPECT_FALSE(fs::exists(run_folder(path)));
  EXPECT_EQ(run_presence(path), RunPresence::packed);
}

}  // namespace
}  // namespace talus::io
