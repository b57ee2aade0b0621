/// Data written are read back identically, from the folder and from the packed file.

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "base/hash.h"
#include "io/run_file.h"
#include "unit/io/example_run.h"

namespace talus::io {
namespace {

constexpr int commits = 5;  // frames: 0 + 1 + 2 + 0 + 1

/// Expects bit-identical values after rounding to single precision; NaN equals NaN.
void expect_rounded(const std::vector<double>& read, const std::vector<double>& written, const char* name) {
  ASSERT_EQ(read.size(), written.size()) << name;
  for (std::size_t i = 0; i < read.size(); ++i) {
    const double expected = static_cast<float>(written[i]);
    EXPECT_TRUE(read[i] == expected || (std::isnan(read[i]) && std::isnan(expected)))
        << name << " " << i << ": " << read[i] << ", expected " << expected;
  }
}

void expect_same_frame(const Frame& read, const Frame& written) {
  EXPECT_EQ(read.step, written.step);
  EXPECT_EQ(read.time, written.time);
  EXPECT_EQ(read.tilt, written.tilt);
  EXPECT_EQ(read.image, written.image);
  for (const auto& [name, field] : {std::pair("x", &Frame::x),
                                    {"y", &Frame::y},
                                    {"angle", &Frame::angle},
                                    {"vx", &Frame::vx},
                                    {"vy", &Frame::vy},
                                    {"omega", &Frame::omega},
                                    {"gamma", &Frame::gamma}})
    expect_rounded(read.*field, written.*field, name);
  ASSERT_EQ(read.internal_moment.size(), written.internal_moment.size());
  for (std::size_t i = 0; i < read.internal_moment.size(); ++i) {
    const Tensor2 &r = read.internal_moment[i], &w = written.internal_moment[i];
    expect_rounded({r.xx, r.xy, r.yx, r.yy}, {w.xx, w.xy, w.yx, w.yy}, "internal_moment");
  }
}

void expect_same_contacts(const FrameContacts& read, const FrameContacts& written) {
  EXPECT_EQ(read.a, written.a);
  EXPECT_EQ(read.b, written.b);
  EXPECT_EQ(read.shift, written.shift);
  EXPECT_EQ(read.status, written.status);
  for (const auto& [name, field] : {std::pair("nx", &FrameContacts::nx),
                                    {"ny", &FrameContacts::ny},
                                    {"px", &FrameContacts::px},
                                    {"py", &FrameContacts::py},
                                    {"fn", &FrameContacts::fn},
                                    {"ft", &FrameContacts::ft}})
    expect_rounded(read.*field, written.*field, name);
}

/// Checks a frame of which only the positions were read.
void expect_positions(const Frame& read, const Frame& whole) {
  EXPECT_EQ(read.step, whole.step);
  EXPECT_EQ(read.time, whole.time);
  EXPECT_EQ(read.tilt, whole.tilt);
  EXPECT_EQ(read.x, whole.x);
  EXPECT_EQ(read.y, whole.y);
  EXPECT_EQ(read.image, whole.image);
  EXPECT_TRUE(read.gamma.empty() && read.contacts.a.empty()) << "more was read than requested";
}

/// Returns the bits of everything that a frame holds in single precision, including those of NaN.
std::vector<std::uint64_t> bits_of(const Frame& frame) {
  std::vector<std::uint64_t> bits;
  const FrameContacts& c = frame.contacts;
  for (const std::vector<double>* values :
       {&frame.x, &frame.y, &frame.angle, &frame.vx, &frame.vy, &frame.omega, &frame.gamma, &c.nx, &c.ny,
        &c.px, &c.py, &c.fn, &c.ft})
    for (double value : *values) bits.push_back(std::bit_cast<std::uint64_t>(value));
  for (const Tensor2& m : frame.internal_moment)
    for (double value : {m.xx, m.xy, m.yx, m.yy}) bits.push_back(std::bit_cast<std::uint64_t>(value));
  return bits;
}

void expect_as_stored(const Frame& rounded, const Frame& read) {
  EXPECT_EQ(bits_of(rounded), bits_of(read));
  EXPECT_EQ(rounded.time, read.time);
  EXPECT_EQ(rounded.tilt, read.tilt);
  EXPECT_EQ(rounded.image, read.image);
  EXPECT_EQ(rounded.contacts.a, read.contacts.a);
}

void expect_same_header(const RunHeader& read, const RunHeader& written) {
  EXPECT_EQ(read.scenario_given, written.scenario_given);
  EXPECT_EQ(read.scenario_resolved, written.scenario_resolved);
  EXPECT_EQ(read.seed, written.seed);
  EXPECT_EQ(read.provenance, written.provenance);  // in the order of writing
  EXPECT_EQ(read.statics.free_count, written.statics.free_count);
  EXPECT_EQ(read.statics.radius, written.statics.radius);
  EXPECT_EQ(read.statics.mass, written.statics.mass);
  EXPECT_EQ(read.statics.periodic, written.statics.periodic);
  EXPECT_EQ(read.statics.length, written.statics.length);
  EXPECT_EQ(read.statics.depth, written.statics.depth);
  EXPECT_EQ(read.statics.mean_diameter, written.statics.mean_diameter);
  EXPECT_EQ(read.statics.gravity, written.statics.gravity);
  EXPECT_EQ(read.friction, written.friction);
  EXPECT_EQ(read.deposition_friction, written.deposition_friction);
}

template <typename Named>
void expect_same_bits(const Named& read, const Named& written) {
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].first, written[i].first);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(read[i].second), std::bit_cast<std::uint64_t>(written[i].second))
        << read[i].first;
  }
}

void expect_same_checkpoint(const Checkpoint& read, const Checkpoint& written) {
  EXPECT_EQ(hash_text(state_hash(read.world)), hash_text(state_hash(written.world)));
  EXPECT_EQ(read.world.contacts.nx, written.world.contacts.nx);  // not part of the hash
  EXPECT_EQ(read.world.contacts.ny, written.world.contacts.ny);
  EXPECT_EQ(read.world.contacts.gap, written.world.contacts.gap);
  ASSERT_EQ(read.world.boundary.planes.size(), written.world.boundary.planes.size());
  for (std::size_t k = 0; k < read.world.boundary.planes.size(); ++k)
    EXPECT_EQ(read.world.boundary.planes[k].wall, written.world.boundary.planes[k].wall);
  expect_same_bits(read.integers, written.integers);
  expect_same_bits(read.reals, written.reals);
  expect_same_bits(read.results, written.results);
  expect_same_bits(read.timing, written.timing);
}

void expect_example_run(const RunFile& run) {
  expect_same_header(run.header(), example::header());
  expect_same_checkpoint(run.checkpoint(), example::checkpoint(commits - 1));
  std::size_t frames = 0;
  std::vector<ObservableRow> observables;
  std::vector<StepRow> steps;
  std::vector<Command> commands;
  for (int k = 0; k < commits; ++k) {
    const Segment written = example::segment(k);
    for (const Frame& frame : written.frames) {
      ASSERT_LT(frames, run.frame_count());
      EXPECT_EQ(run.frame_tilts()[frames], frame.tilt);
      const Frame read = run.frame(frames++);
      expect_same_frame(read, frame);
      expect_same_contacts(read.contacts, frame.contacts);
      expect_positions(run.positions(frames - 1), read);
      expect_as_stored(as_stored(frame), read);
    }
    observables.insert(observables.end(), written.observables.begin(), written.observables.end());
    steps.insert(steps.end(), written.steps.begin(), written.steps.end());
    commands.insert(commands.end(), written.commands.begin(), written.commands.end());
  }
  EXPECT_EQ(run.frame_count(), frames);
  EXPECT_EQ(run.all_observables(), observables);
  EXPECT_EQ(run.steps(), steps);
  EXPECT_EQ(run.commands(), commands);
}

class RoundTrip : public test::FolderTest {
 protected:
  /// Opens the run, of which `store` has been packed.
  RunFile packed(RunStore store) const {
    store.pack();
    return RunFile::open(path);
  }

  const std::string path = folder.path("run.h5");
};

TEST_F(RoundTrip, of_a_folder_under_both_its_names) {
  const RunStore store = example::store_with_commits(path, commits);
  for (const char* name : {"run.h5", "run.h5.run"}) {
    const RunFile run = RunFile::open(folder.path(name));
    EXPECT_FALSE(run.complete());
    expect_example_run(run);
  }
}

TEST_F(RoundTrip, of_a_packed_file) {
  const RunFile run = packed(example::store_with_commits(path, commits));
  EXPECT_TRUE(run.complete());
  expect_example_run(run);
  EXPECT_FALSE(std::filesystem::exists(folder.path("run.h5.run")));
}

TEST_F(RoundTrip, of_a_frame_with_contacts_that_carry_no_force_leaves_them_out) {
  const RunHeader header = example::header();
  double weight = 0.0;  // mean of the free grains
  for (Index i = 0; i < header.statics.free_count; ++i)
    weight += header.statics.mass[i] * header.statics.gravity / header.statics.free_count;
  Segment segment = example::segment(1);
  ASSERT_EQ(segment.frames.front().contacts.count(), 3) << "of the grains 0 and 3, 1 and 4, 2 and 5";
  segment.frames.front().contacts.fn = {1.01e-9 * weight, 0.99e-9 * weight, 0.0};
  RunStore store = RunStore::create(path, header, false);
  store.commit(segment, example::checkpoint(0));
  const RunFile run = packed(std::move(store));
  const Frame frame = run.frame(0), stored = run.stored_frame(0);
  EXPECT_EQ(frame.contacts.a, std::vector<Index>{0});
  EXPECT_EQ(frame.contacts.b, std::vector<Index>{3});
  expect_rounded(frame.contacts.px, {segment.frames.front().contacts.px[0]}, "px");
  for (const std::size_t i : {0u, 3u}) EXPECT_EQ(frame.gamma[i], stored.gamma[i]);
  for (const std::size_t i : {1u, 2u, 4u, 5u}) EXPECT_TRUE(std::isnan(frame.gamma[i])) << i;
  expect_same_contacts(stored.contacts, segment.frames.front().contacts);
  EXPECT_TRUE(run.is_as_written(stored, 0));
}

/// Returns frames and rows of observables, one of each at each of these tilts, in the steps from `step` on.
Segment segment_at(std::int64_t step, const std::vector<double>& tilts) {
  Segment segment;
  Frame frame = example::segment(1).frames.front();
  for (const double tilt : tilts) {
    frame.tilt = tilt;
    frame.step = step++;
    segment.frames.push_back(frame);
    segment.observables.emplace_back();
    at(segment.observables.back(), Observable::step) = static_cast<double>(frame.step);
    at(segment.observables.back(), Observable::tilt) = tilt;
  }
  return segment;
}

/// Returns the last state after these steps, the last of which belong to a flow after failure.
Checkpoint checkpoint_in_flow(int k, std::int64_t step, std::int64_t flow_steps) {
  Checkpoint checkpoint = example::checkpoint(k);
  checkpoint.world.step = step;
  checkpoint.integers.emplace_back("flow_steps", flow_steps);
  return checkpoint;
}

TEST_F(RoundTrip, of_a_flow_after_failure_which_is_told_apart) {
  for (const double after : {0.3, 0.2, 0.4}) {  // held at the tilt of the failure, lowered, or beyond it
    RunStore store = RunStore::create(path, example::header(), true);
    store.commit(segment_at(1, {0.1, 0.2}), checkpoint_in_flow(0, 2, 0));
    EXPECT_EQ(RunFile::open(path).frame_count(), 2u);
    store.commit(segment_at(3, {0.3, after}), checkpoint_in_flow(1, 4, 1));
    EXPECT_EQ(RunFile::open(path).frame_count(), 3u);
    store.commit(segment_at(5, {after}), checkpoint_in_flow(2, 5, 2));
    const RunFile run = packed(std::move(store));
    EXPECT_EQ(run.frame_tilts(), (std::vector{0.1, 0.2, 0.3}));
    EXPECT_EQ(run.frame_count(), 3u);
    EXPECT_EQ(run.observables().size(), 3u);
    EXPECT_EQ(run.all_frame_tilts(), (std::vector{0.1, 0.2, 0.3, after, after}));
    EXPECT_EQ(run.all_observables().size(), 5u);
    EXPECT_EQ(run.frame(4).tilt, after);
  }
}

/// Without a flow after failure, a tilt that is held or falls is a tilt.
TEST_F(RoundTrip, of_a_tilt_that_is_held_and_falls) {
  RunStore store = RunStore::create(path, example::header(), false);
  store.commit(segment_at(1, {0.1, 0.3, 0.3}), example::checkpoint(0));
  store.commit(segment_at(4, {0.2, -0.1}), example::checkpoint(1));
  for (const bool packed : {false, true}) {
    if (packed) store.pack();
    const RunFile run = RunFile::open(path);
    EXPECT_EQ(run.frame_tilts(), (std::vector{0.1, 0.3, 0.3, 0.2, -0.1}));
    EXPECT_EQ(run.observables().size(), 5u);
    EXPECT_TRUE(run.goes_by_time());
    EXPECT_FALSE(run.has_program());
  }
}

TEST_F(RoundTrip, of_a_run_without_frames) {
  RunStore store = RunStore::create(path, example::header(), false);
  store.commit({}, example::checkpoint(0));
  const RunFile run = packed(std::move(store));
  EXPECT_EQ(run.frame_count(), 0u);
  EXPECT_TRUE(run.steps().empty());
  expect_same_checkpoint(run.checkpoint(), example::checkpoint(0));
}

TEST_F(RoundTrip, equal_runs_give_equal_bytes_however_they_were_committed) {
  example::store_with_commits(folder.path("one.h5"), commits).pack();

  RunStore together = RunStore::create(folder.path("other.h5"), example::header(), false);
  Segment all;
  for (int k = 0; k < commits; ++k) {
    const Segment part = example::segment(k);
    all.frames.insert(all.frames.end(), part.frames.begin(), part.frames.end());
    all.observables.insert(all.observables.end(), part.observables.begin(), part.observables.end());
    all.steps.insert(all.steps.end(), part.steps.begin(), part.steps.end());
    all.commands.insert(all.commands.end(), part.commands.begin(), part.commands.end());
  }
  together.commit(all, example::checkpoint(commits - 1));
  together.pack();
  EXPECT_TRUE(test::text_of(folder.path("one.h5")) == test::text_of(folder.path("other.h5")));
}

TEST_F(RoundTrip, a_resumed_run_continues_with_the_same_bits) {
  example::store_with_commits(folder.path("one.h5"), commits).pack();

  { const RunStore interrupted = example::store_with_commits(folder.path("other.h5"), 3); }
  RunHeader header;
  Checkpoint checkpoint;
  RunStore resumed = RunStore::resume(folder.path("other.h5"), header, checkpoint);
  expect_same_header(header, example::header());
  expect_same_checkpoint(checkpoint, example::checkpoint(2));
  for (int k = 3; k < commits; ++k) resumed.commit(example::segment(k), example::checkpoint(k));
  resumed.pack();
  EXPECT_TRUE(test::text_of(folder.path("one.h5")) == test::text_of(folder.path("other.h5")));
}

}  // namespace
}  // namespace talus::io
