/// Analysis stored with a run: it is read back exactly, and the run stays unchanged.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include "base/errors.h"
#include "base/hash.h"
#include "io/durable_file.h"
#include "io/hdf5_file.h"
#include "io/packed_file.h"
#include "io/run_file.h"
#include "support/blank_analysis.h"
#include "support/exit_code.h"
#include "support/places.h"
#include "unit/io/example_analysis.h"

namespace talus::io {
namespace {

template <typename T>
bool same_bits(const std::vector<T>& one, const std::vector<T>& other) {
  if (one.size() != other.size()) return false;
  return one.empty() || std::memcmp(one.data(), other.data(), one.size() * sizeof(T)) == 0;
}

void expect_same(const analysis::Analysis& read, const analysis::Analysis& written) {
  EXPECT_EQ(read.key, written.key);
  EXPECT_EQ(read.parameters, written.parameters);
  EXPECT_EQ(sizes_of(read), sizes_of(written));
  for (const analysis::Quantity& quantity : analysis::quantities()) {
    const analysis::Values other = analysis::values_of(quantity, read);
    const auto is_same = [&other]<typename T>(const std::vector<T>& expected) {
      return same_bits(std::get<std::vector<T>>(other), expected);
    };
    EXPECT_TRUE(std::visit(is_same, analysis::values_of(quantity, written))) << quantity.name;
  }
}

class AnalysisFile : public testing::Test {
 protected:
  AnalysisFile() : path_(folder_.path("run.h5")) {
    example::store_with_commits(path_, example::analysis_commits).pack();
    original_ = test::text_of(path_);
  }

  example::TemporaryFolder folder_;
  std::string path_;
  std::string original_;
  std::string state_ = example::analysed_state();
};

TEST_F(AnalysisFile, gives_back_what_was_stored) {
  EXPECT_FALSE(read_analysis(path_).has_value());
  store_analysis(path_, example::analysis(2, 1), state_);
  expect_same(read_analysis(path_).value(), example::analysis(2, 1));
}

TEST_F(AnalysisFile, leaves_out_what_needs_a_threshold_or_an_event_where_there_is_none) {
  store_analysis(path_, example::analysis(2, 1), state_);
  EXPECT_EQ(read_analysis(path_).value().events.size(), 4u);
  store_analysis(path_, example::analysis(0, 1), state_);
  const analysis::Analysis read = read_analysis(path_).value();
  expect_same(read, example::analysis(0, 1));
  EXPECT_TRUE(read.thresholds.empty() && read.events.empty());
  EXPECT_FALSE(is_present(analysis::quantity_of(&analysis::FrameThreshold::overloaded_fraction), read));
  EXPECT_FALSE(is_present(analysis::quantity_of(&analysis::EventRecord::energy), read));
  EXPECT_TRUE(is_present(analysis::quantity_of(&analysis::FrameRecord::stress), read));
  EXPECT_TRUE(is_present(analysis::quantity_of(&analysis::Analysis::event_count), read));
}

TEST_F(AnalysisFile, keeps_the_run_to_the_last_bit) {
  store_analysis(path_, example::analysis(2, 1), state_);
  const RunFile run = RunFile::open(path_);
  const std::vector<std::byte> bare = packed_bytes(content_of(run));
  ASSERT_EQ(bare.size(), original_.size());
  EXPECT_EQ(std::memcmp(bare.data(), original_.data(), bare.size()), 0);
}

TEST_F(AnalysisFile, replaces_an_analysis_without_a_trace) {
  store_analysis(path_, example::analysis(2, 1), state_);
  const std::string once = test::text_of(path_);
  store_analysis(path_, example::analysis(0, 5), state_);
  store_analysis(path_, example::analysis(2, 1), state_);
  EXPECT_TRUE(test::text_of(path_) == once);
}

/// Returns the bytes of a run file whose /analysis contains nothing but another version.
std::vector<std::byte> with_another_version(const std::string& path) {
  hdf5::Writer writer({}, seal_size, read_file(path), path);
  writer.write_scalar("/analysis/version", analysis_version - 1);
  return sealed(writer.image());
}

TEST_F(AnalysisFile, of_another_version_is_none) {
  write_durably(path_, with_another_version(path_));
  EXPECT_FALSE(read_analysis(path_).has_value());
  store_analysis(path_, example::analysis(2, 1), state_);
  expect_same(read_analysis(path_).value(), example::analysis(2, 1));
}

TEST_F(AnalysisFile, of_another_run_is_left_alone) {
  EXPECT_TRUE(test::refuses([&] { store_analysis(path_, example::analysis(2, 1), hash_text(1)); },
                            ExitCode::cannot_create, {path_}));
  EXPECT_TRUE(test::text_of(path_) == original_);
}

TEST_F(AnalysisFile, of_another_number_of_frames_is_refused) {
  analysis::Analysis shorter = test::blank_analysis(
      {.frames = 2, .thresholds = 1, .grains = example::grain_count, .sections = 5, .bins = 4});
  shorter.parameters = {{"bins", "4"}};
  store_analysis(path_, shorter, state_);
  EXPECT_TRUE(test::refuses([&] { read_analysis(path_); }, ExitCode::bad_data,
                            {"rows for 2 frames, the tilt has 3"}));
}

TEST_F(AnalysisFile, that_is_damaged_is_refused) {
  store_analysis(path_, example::analysis(2, 1), state_);
  const std::string good = test::text_of(path_);
  for (std::size_t k = 0; k < 40; ++k) {
    std::string flipped = good;
    flipped[k * (good.size() - 1) / 39] ^= static_cast<char>(1 << (k % 8));
    example::write_text(path_, flipped);
    EXPECT_THROW(RunFile::open(path_), Error) << k;
    EXPECT_THROW(read_analysis(path_), Error) << k;
    EXPECT_THROW(store_analysis(path_, example::analysis(2, 1), state_), Error) << k;
  }
}

TEST_F(AnalysisFile, tells_other_readers_what_it_holds) {
  const std::string python = "/usr/bin/python3 ";
  if (std::system((python + "-c 'import h5py' 2>/dev/null").c_str()) != 0) GTEST_SKIP() << "no python3-h5py";
  store_analysis(path_, example::analysis(2, 1), state_);
  const std::string script = test::source_folder() + "/tests/unit/io/check_analysis_with_h5py.py ";
  EXPECT_EQ(std::system((python + script + path_).c_str()), 0) << "see the message above";
}

TEST(Quantities, have_their_values_in_the_order_of_their_shape) {
  const analysis::Analysis analysis = example::analysis(2, 1);
  const std::size_t grains = example::grain_count;
  const auto lengths = std::get<std::vector<float>>(
      analysis::values_of(analysis::quantity_of(&analysis::FrameThreshold::lc), analysis));
  EXPECT_EQ(lengths.size(), 3 * 2 * grains);
  EXPECT_EQ(lengths[3 * grains + 1], analysis.frames[1].thresholds[1].lc[1]);
  const analysis::Quantity& mean = analysis::quantity_of(&analysis::FrameThreshold::lc_mean);
  EXPECT_EQ(analysis::number_of(mean, analysis, 3), analysis.frames[1].thresholds[1].lc_mean);
  EXPECT_EQ(analysis::number_of(mean, analysis.frames[1], 1), analysis.frames[1].thresholds[1].lc_mean);
}

/// Returns the table with an additional row: a file knows a quantity only by its row.
std::vector<analysis::Quantity> with_made_up_quantity() {
  std::vector<analysis::Quantity> table = analysis::quantities();
  table.push_back(
      {&analysis::FrameRecord::volume, "packing/made_up", "T", "m", "made up for this test", "bins"});
  return table;
}

TEST_F(AnalysisFile, has_each_quantity_of_its_table) {
  const std::vector<analysis::Quantity> table = with_made_up_quantity();
  const analysis::Analysis written = example::analysis(2, 1);
  store_analysis(path_, written, state_, table);
  hdf5::Reader reader = hdf5::Reader::from_file(path_);
  const auto stored = reader.read<double>(data_set_of(table.back()), hdf5::any_number);
  EXPECT_TRUE(same_bits(stored, std::get<std::vector<double>>(analysis::values_of(table.back(), written))));
  analysis::Analysis read = read_analysis(path_, std::span(&table.back(), 1)).value();
  EXPECT_EQ(read.frames[1].volume, written.frames[1].volume);
  EXPECT_TRUE(std::isnan(read.frames[1].stress_ratio)) << "not in that table";
}

TEST(AnalysisSchema, is_documented_as_it_is) {
  std::string expected, found;
  for (const DataSetField& field : analysis_schema()) expected += example::row_text(field);
  std::istringstream page(test::text_of(test::source_folder() + "/docs/analysis.md"));
  for (std::string line; std::getline(page, line);)
    if (line.starts_with("| `/analysis/")) found += line + "\n";
  EXPECT_EQ(found, expected) << "the table of docs/analysis.md must be:\n" << expected;
}

TEST(AnalysisSchema, every_path_stands_once) {
  std::map<std::string, int> times;
  for (const DataSetField& field : analysis_schema()) EXPECT_EQ(++times[field.path], 1) << field.path;
}

}  // namespace
}  // namespace talus::io
