/// Packed file read by an independent reader: h5py, with the H5MD conventions.

#include <gtest/gtest.h>

#include <cstdlib>

#include "support/places.h"
#include "unit/io/example_run.h"

namespace talus::io {
namespace {

constexpr const char* interpreter = "/usr/bin/python3";

bool has_h5py() {
  return std::system((std::string(interpreter) + " -c 'import h5py' 2>/dev/null").c_str()) == 0;
}

TEST(H5py, reads_a_packed_file_and_finds_it_valid) {
  if (!has_h5py()) GTEST_SKIP() << "no h5py for " << interpreter << ": install python3-h5py";
  const example::TemporaryFolder folder;
  const std::string path = folder.path("run.h5");
  example::store_with_commits(path, 5).pack();

  // Contents of the example run, for comparison in the script.
  const Segment first = example::segment(1), last = example::segment(4);
  std::ostringstream expected;
  expected.precision(17);
  expected << "{\"frames\": 4, \"grains\": " << example::grain_count << ", \"x_00\": " << first.frames[0].x[0]
           << ", \"y_35\": " << last.frames[0].y[5] << ", \"contacts\": [" << first.frames[0].contacts.count()
           << ", " << example::segment(2).frames[0].contacts.count() << ", "
           << example::segment(2).frames[1].contacts.count() << ", " << last.frames[0].contacts.count()
           << "], \"fn_0\": " << first.frames[0].contacts.fn[0]
           << ", \"first_tilt_row\": " << at(example::segment(0).observables[0], Observable::tilt)
           << ", \"seed\": " << example::header().seed
           << ", \"vx_last\": " << example::checkpoint(4).world.grains.vx[2] << "}";
  example::write_text(folder.path("expected.json"), expected.str());
  const std::string command = std::string(interpreter) + " " + test::source_folder() +
                              "/tests/unit/io/check_with_h5py.py " + path + " " +
                              folder.path("expected.json");
  EXPECT_EQ(std::system(command.c_str()), 0) << "see the message above";
}

}  // namespace
}  // namespace talus::io
