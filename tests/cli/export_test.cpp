/// Export of runs for other programs: options, messages, exit codes, replaced files, interruptions.
/// tests/python tests the exported data.

#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <tuple>

#include "pictures.h"
#include "support/places.h"
#include "support/process.h"
#include "support/runs.h"

namespace talus::test {
namespace {

using Words = std::vector<std::string>;

/// Bed of 40 grains that remains stable, with frames 0 to 3 at 0, 0.5, 1 and 1.5 deg.
class Export : public testing::Test {
 protected:
  void SetUp() override {
    take_run(folder_, "bed.h5",
             "seed = 3\n[bed]\nlength = 10\ndepth = 4\n[tilt]\nstep = 0.01\nend_angle = 1.5\n[output]\n"
             "frame_every = 0.5\n");
  }
  Outcome talus(const Words& arguments) { return run_talus(arguments, folder_.path()); }
  Outcome exported(const Words& more) {
    Words words = {"export", "bed.h5"};
    words.insert(words.end(), more.begin(), more.end());
    return talus(words);
  }
  std::set<std::string> files(const char* name) { return names_in(folder_.path() / name); }

  TemporaryFolder folder_;
};

TEST_F(Export, writes_the_frames_that_are_asked_for) {
  const std::vector<std::pair<Words, std::set<std::string>>> cases = {
      {{}, {"0000", "0001", "0002", "0003"}},      {{"--frames", "0-1,3"}, {"0000", "0001", "0003"}},
      {{"--frames", "2,2,1-2"}, {"0001", "0002"}}, {{"--at", "1.5,0"}, {"0000", "0003"}},
      {{"--every", "1"}, {"0000", "0002"}},
  };
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const std::string folder = "out" + std::to_string(k);
    Words words = {"--to", "paraview", "-o", folder};
    words.insert(words.end(), cases[k].first.begin(), cases[k].first.end());
    const Outcome outcome = exported(words);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    std::set<std::string> expected;
    for (const std::string& number : cases[k].second) {
      expected.insert("grains_" + number + ".vtp");
      expected.insert("contacts_" + number + ".vtp");
    }
    EXPECT_EQ(files((folder + "/frames").c_str()), expected) << folder;
    EXPECT_NE(
        outcome.out.find(folder + ": " + std::to_string(cases[k].second.size()) + " frames for ParaView"),
        std::string::npos)
        << outcome.out;
    EXPECT_NE(outcome.out.find("Overloaded grains, their lengths and clusters are left out"),
              std::string::npos);
  }
}

TEST_F(Export, refuses_what_makes_no_sense) {
  const std::vector<std::tuple<Words, int, std::string>> cases = {
      {{"--to", "paravew", "-o", "x"}, 64, "did you mean 'paraview'?"},
      {{"--to", "stl", "-o", "x"}, 64, "expected one of paraview, vti, xyz, "},
      {{"--to", "xyz", "-o", "x"}, 64, "x: expected a name that ends in .xyz"},
      {{"--to", "lammps", "-o", "x.xyz"}, 64, "ends in .dump"},
      {{"--to", "html", "-o", "x"}, 64, "x: expected a name that ends in .html"},
      {{"--to", "observables", "-o", "x.csv", "--at", "1"}, 64, "have no effect on it"},
      {{"--to", "observables", "-o", "x.csv", "--flow"}, 65, "after failure"},
      {{"--to", "paraview"}, 64, "--output"},
      {{"-o", "x"}, 64, "--to"},
      {{"--to", "paraview", "-o", "x", "--frames", "1-"}, 64, "--frames 0-10,20"},
      {{"--to", "paraview", "-o", "x", "--frames", "2-1"}, 64, "--frames 0-10,20"},
      {{"--to", "paraview", "-o", "x", "--frames", "-1"}, 64, "--frames 0-10,20"},
      {{"--to", "paraview", "-o", "x", "--frames", "1.5"}, 64, "--frames 0-10,20"},
      {{"--to", "paraview", "-o", "x", "--frames", "99999999999999999999"}, 64, "--frames 0-10,20"},
      {{"--to", "paraview", "-o", "x", "--frames", "2-4"}, 65, "the run has 4 frames, 0 to 3"},
      {{"--to", "paraview", "-o", "x", "--at", "30"}, 65, "no frame there"},
      {{"--to", "paraview", "-o", "x", "--at", "repose"}, 65, "has not failed"},
      {{"--to", "paraview", "-o", "x", "--flow"}, 65, "after failure"},
      {{"--to", "paraview", "-o", "x", "--at", "1", "--frames", "1"}, 64, "--frames"},
      {{"--to", "paraview", "-o", "x", "--every", "0"}, 64, "--every"},
      {{"--to", "paraview", "-o", "x", "--set", "lmin=0"}, 65, "l_min"},
      {{"--to", "paraview", "-o", "x", "--length", "4"}, 64, "--to vti"},
      {{"--to", "vti", "-o", "x", "--length", "0"}, 64, "--length"},
      {{"--to", "vti", "-o", "x", "--length", "900"}, 64, "length of the bed"},
      {{"--to", "paraview", "-o", ""}, 64, "empty"},
  };
  for (const auto& [words, code, part] : cases) {
    const Outcome outcome = exported(words);
    EXPECT_EQ(outcome.exit_code, code) << part << ": " << outcome.err;
    EXPECT_NE((outcome.err + outcome.out).find(part), std::string::npos) << part << ": " << outcome.err;
  }
  for (const char* name : {"x", "x.xyz", "x.csv"})
    EXPECT_FALSE(std::filesystem::exists(folder_.path(name))) << name;
  EXPECT_EQ(talus({"export", "none.h5", "--to", "paraview", "-o", "x"}).exit_code, 66);
  write_file(folder_, "text.h5", "no HDF5");
  EXPECT_EQ(talus({"export", "text.h5", "--to", "paraview", "-o", "x"}).exit_code, 65);
}

TEST_F(Export, replaces_files_only_when_told_and_never_the_run) {
  const Words words = {"--to", "paraview", "--frames", "1", "-o", "out", "--quiet"};
  const Outcome first = exported(words);
  EXPECT_EQ(first.exit_code, 0);
  EXPECT_EQ(first.out + first.err, "");
  const Outcome again = exported(words);
  EXPECT_EQ(again.exit_code, 73);
  EXPECT_NE(again.err.find("out/grains.pvd exists; give --overwrite"), std::string::npos) << again.err;
  Words over = words;
  over.emplace_back("--overwrite");
  EXPECT_EQ(exported(over).exit_code, 0);
  EXPECT_EQ(exported({"--to", "paraview", "-o", "bed.h5"}).exit_code, 73) << "a file is not a folder";
  for (const char* format : {"xyz", "lammps", "observables", "html"}) {
    const std::string ending = format == std::string("lammps")        ? ".dump"
                               : format == std::string("observables") ? ".csv"
                                                                      : "." + std::string(format);
    Words one = {"--to", format, "-o", "one" + ending};
    if (format != std::string("observables")) one.insert(one.end(), {"--frames", "2"});
    EXPECT_EQ(exported(one).exit_code, 0) << format;
    const std::string made = text_of(folder_.path() / ("one" + ending));
    EXPECT_GT(made.size(), 1000U) << format;
    EXPECT_EQ(exported(one).exit_code, 73) << format;
    one.emplace_back("--overwrite");
    EXPECT_EQ(exported(one).exit_code, 0) << format;
    EXPECT_EQ(text_of(folder_.path() / ("one" + ending)), made) << format << ": identical each time";
  }
}

TEST_F(Export, that_replaces_a_folder_leaves_nothing_of_the_earlier_one_in_it) {
  for (const auto& [format, kept] :
       {std::pair{"paraview", std::set<std::string>{"contacts_0001.vtp", "grains_0001.vtp"}},
        std::pair{"vti", std::set<std::string>{"fields_0001.vti"}}}) {
    const std::string folder = std::string("out-") + format, frames = folder + "/frames";
    ASSERT_EQ(exported({"--to", format, "--frames", "0-2", "-o", folder}).exit_code, 0);
    ASSERT_EQ(files(frames.c_str()).size(), 3 * kept.size());
    // Not written by Talus, or not under such a name.
    std::set<std::string> expected = kept;
    for (const char* foreign :
         {"grains_0000.xml", "grains_7.vtp", "contacts_.vtp", "fields_.vti", "notes.txt"}) {
      write_file(folder_, frames + "/" + foreign, "mine");
      expected.insert(foreign);
    }
    ASSERT_EQ(exported({"--to", format, "--frames", "1", "-o", folder}).exit_code, 73) << format;
    EXPECT_EQ(files(frames.c_str()).size(), 3 * kept.size() + 5) << "nothing is removed without --overwrite";
    const Outcome over = exported({"--to", format, "--frames", "1", "-o", folder, "--overwrite"});
    EXPECT_EQ(over.exit_code, 0) << over.err;
    EXPECT_EQ(files(frames.c_str()), expected) << format;
  }
}

TEST_F(Export, leaves_whole_files_where_it_is_stopped) {
  // A small tilt between frames gives many frames.
  take_run(folder_, "long.h5",
           "seed = 3\n[bed]\nlength = 10\ndepth = 4\n[tilt]\nstep = 0.01\nend_angle = 2\n[output]\n"
           "frame_every = 0.01\n");
  const pid_t process = start_talus({"export", "long.h5", "--to", "paraview", "-o", "out"}, folder_.path());
  while (!has_ended(process) && files("out/frames").size() < 6) usleep(1000);
  kill(process, SIGINT);
  ASSERT_EQ(wait_for(process), 75) << errors_in(folder_.path());
  EXPECT_FALSE(std::filesystem::exists(folder_.path("out/grains.pvd"))) << "it would name missing files";
  for (const std::string& name : files("out/frames"))
    EXPECT_TRUE(name.ends_with(".talus.part") ||
                text_of(folder_.path() / "out/frames" / name).ends_with("</VTKFile>\n"))
        << name;
  ASSERT_EQ(
      talus({"export", "long.h5", "--to", "paraview", "--frames", "0", "-o", "out", "--overwrite"}).exit_code,
      0);
  for (const std::string& name : files("out/frames")) EXPECT_FALSE(name.ends_with(".talus.part")) << name;
}

/// Returns the export commands of a page, split into words.
std::vector<Words> export_commands(const std::string& page) {
  std::ifstream file(source_folder() + "/" + page);
  std::vector<Words> found;
  for (std::string line; std::getline(file, line);) {
    std::istringstream text(line.substr(0, line.find('#')));
    std::string program;
    text >> program;
    const Words words{std::istream_iterator<std::string>(text), {}};
    if (program.ends_with("/talus") && !words.empty() && words[0] == "export") found.push_back(words);
  }
  return found;
}

TEST(ExportExamples, of_the_documents_are_carried_out) {
  const TemporaryFolder folder;
  take_run(folder, "RUN.h5",
           "seed = 1\n[bed]\nlength = 12\ndepth = 5\n[tilt]\nstep = 0.01\n[output]\nframe_every = 1\n");
  std::filesystem::create_directory(folder.path("runs"));
  std::filesystem::copy(folder.path("RUN.h5"), folder.path("runs/paper.h5"));
  EXPECT_GE(export_commands("README.md").size(), 1U);
  EXPECT_GE(export_commands("docs/export.md").size(), 6U);
  for (const char* page : {"README.md", "docs/export.md"})
    for (const Words& command : export_commands(page)) {
      const Outcome outcome = run_talus(command, folder.path());
      EXPECT_EQ(outcome.exit_code, 0) << page << ": " << outcome.err;
      EXPECT_NE(outcome.out.find(" for "), std::string::npos) << outcome.out;
    }
}

}  // namespace
}  // namespace talus::test
