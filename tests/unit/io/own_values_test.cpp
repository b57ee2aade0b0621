/// Values of scripts stored with a run: they are read back exactly, and the run stays unchanged.

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "io/durable_file.h"
#include "io/hdf5_file.h"
#include "io/packed_file.h"
#include "io/run_file.h"
#include "support/exit_code.h"
#include "support/has.h"
#include "unit/io/damaged_run.h"
#include "unit/io/example_analysis.h"

namespace talus::io {
namespace {

using Kind = OwnQuantity::Kind;

/// Run of 3 frames whose contacts all carry force.
class OwnValues : public testing::Test {
 protected:
  OwnValues() {
    example::store_with_commits(path_, example::analysis_commits).pack();
    const RunFile run = RunFile::open(path_);
    for (std::size_t k = 0; k < 3 * example::grain_count; ++k) slip_.values.push_back(0.25 * double(k));
    slip_.values[1] = not_known;
    for (std::size_t c = 0; c < run.contact_count(); ++c) marked_.values.push_back(double(c % 2));
  }
  void store(const OwnQuantity& own) { store_own(path_, own, state_); }
  /// Replaces the file by one in which `change` has changed something, sealed.
  template <typename Change>
  void rewrite(const Sizes& sizes, const Change& change) {
    hdf5::Writer writer(sizes, seal_size, read_file(path_), path_);
    change(writer);
    write_durably(path_, sealed(writer.image()));
  }

  example::TemporaryFolder folder_;
  std::string path_ = folder_.path("run.h5"), state_ = example::analysed_state();
  OwnQuantity slip_{{}, Kind::number, "v_s", "m/s", "slip", true},
      marked_{{}, Kind::flag, "marked", "", "marked-2", false};
};

TEST_F(OwnValues, are_read_back_frame_by_frame) {
  store(slip_);
  store(marked_);
  const RunFile run = RunFile::open(path_);
  ASSERT_EQ(run.own().size(), 2U);
  EXPECT_EQ(read_own(run)[1], marked_);
  std::size_t contacts = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Frame frame = run.frame(k);
    ASSERT_EQ(frame.own.size(), 2U);
    EXPECT_EQ(frame.own[0].label, "v_s");
    EXPECT_EQ(frame.own[0].unit, "m/s");
    ASSERT_EQ(frame.own[0].values.size(), std::size_t(example::grain_count));
    EXPECT_EQ(frame.own[0].values[2], slip_.values[k * example::grain_count + 2]);
    EXPECT_EQ(std::isnan(frame.own[0].values[1]), k == 0);
    ASSERT_EQ(frame.own[1].values.size(), frame.contacts.fn.size());
    for (const double value : frame.own[1].values) EXPECT_EQ(value, marked_.values[contacts++]);
    EXPECT_TRUE(run.stored_frame(k).own.empty());
  }
  EXPECT_TRUE(run.changed_data_sets().empty());
}

TEST_F(OwnValues, stay_with_analysis_and_run_in_the_same_bytes) {
  const std::string bare = test::text_of(path_);
  store(slip_);
  store_analysis(path_, example::analysis(2, 1), state_);
  store(marked_);
  const std::string all = test::text_of(path_);
  EXPECT_EQ(read_analysis(path_).value().key, example::analysis(2, 1).key);
  OwnQuantity other = slip_;
  other.values[0] = 7.0;
  store(other);
  EXPECT_EQ(RunFile::open(path_).frame(0).own[0].values[0], 7.0);
  store_analysis(path_, example::analysis(0, 3), state_);
  store_analysis(path_, example::analysis(2, 1), state_);
  store(slip_);
  EXPECT_TRUE(test::text_of(path_) == all);
  const std::vector<std::byte> run = packed_bytes(content_of(RunFile::open(path_)));
  EXPECT_TRUE(std::string(reinterpret_cast<const char*>(run.data()), run.size()) == bare);
}

TEST_F(OwnValues, that_no_script_could_have_stored_are_refused) {
  const auto refuses = [this](const char* part) {
    return test::refuses([this] { RunFile::open(path_); }, ExitCode::bad_data, {path_, "/own/", part});
  };
  const std::string good = test::text_of(path_);
  const Sizes sizes = {{'T', 3}, {'N', example::grain_count}},
              wrong = {{'T', 2}, {'N', example::grain_count}};
  const auto put = [&](hdf5::Writer& writer, const std::string& name, const char* kind, std::size_t rows) {
    writer.write("/own/grains/" + name, std::vector<double>(rows * example::grain_count, 0.5));
    writer.set_attribute("/own/grains/" + name, "label", std::string("a"));
    if (kind != nullptr) writer.set_attribute("/own/grains/" + name, "kind", std::string(kind));
  };
  rewrite(wrong, [&](hdf5::Writer& writer) { put(writer, "a", "number", 2); });
  EXPECT_TRUE(refuses("has shape [2 6], expected [T N]"));
  example::write_text(path_, good);
  rewrite(sizes, [&](hdf5::Writer& writer) { put(writer, "a", "word", 3); });
  EXPECT_TRUE(refuses("has a kind that Talus does not write"));
  example::write_text(path_, good);
  rewrite(sizes, [&](hdf5::Writer& writer) { put(writer, "a", nullptr, 3); });
  EXPECT_TRUE(refuses("has no text attribute kind"));
  for (const std::string& name : std::vector<std::string>{"A", "a b", "2a", std::string(41, 'a')}) {
    example::write_text(path_, good);
    rewrite(sizes, [&](hdf5::Writer& writer) { put(writer, name, "number", 3); });
    EXPECT_TRUE(refuses("has a name that a quantity cannot have")) << name;
  }
  example::write_text(path_, good);
  OwnQuantity unit = slip_;
  unit.unit = "a,b";
  EXPECT_TRUE(test::refuses([&] { store(unit); }, ExitCode::bad_data, {"/own/grains/slip", "unit"}));
  OwnQuantity label = slip_;
  label.kind = Kind::cluster;
  EXPECT_TRUE(test::refuses([&] { store(label); }, ExitCode::bad_data, {"index 1"}));
  EXPECT_TRUE(test::text_of(path_) == good);
}

TEST_F(OwnValues, that_are_damaged_are_found_and_left_out_by_repair) {
  store(slip_);
  store(marked_);
  example::spoil_data_set(path_, "/own/contacts/marked-2");
  example::seal_again(path_);
  const std::vector<std::string> changed = RunFile::open(path_).changed_data_sets();
  EXPECT_EQ(changed, std::vector<std::string>{"/own/contacts/marked-2"});
  const std::string out = folder_.path("out.h5");
  const RepairReport report = repair_run({path_, out, false});
  EXPECT_TRUE(test::has(report.lost.at(0), "/own/contacts/marked-2: is not as it was written"));
  EXPECT_TRUE(test::has(report.kept.back(), "/own/grains/slip"));
  const RunFile run = RunFile::open(out);
  ASSERT_EQ(run.own().size(), 1U);
  EXPECT_EQ(run.frame(2).own[0].values[5], slip_.values.back());
  example::spoil_data_set(path_, "/particles/grains/velocity/value", 1);
  EXPECT_TRUE(test::has(repair_run({path_, folder_.path("b.h5"), false}).lost.at(1), "/own/grains/slip"))
      << "a frame is lost, to which some of them belong";
  EXPECT_TRUE(RunFile::open(folder_.path("b.h5")).own().empty());
}

TEST_F(OwnValues, are_not_kept_without_frames) {
  store(slip_);
  store_analysis(path_, example::analysis(2, 1), state_, analysis::quantities(), false);
  EXPECT_TRUE(RunFile::open(path_).own().empty());
  EXPECT_TRUE(read_analysis(path_).has_value());
}

}  // namespace
}  // namespace talus::io
