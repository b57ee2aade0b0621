/// Export of runs for other programs: options, messages, exit codes, replaced files, interruptions.
/// tests/python tests the exported data.

#include <gtest/gtest.h>

#include <csignal>
#include <set>
#include <tuple>

#include "support/commands.h"
#include "support/runs.h"

namespace talus::test {
namespace {

/// Bed of 40 grains that remains stable, with frames 0 to 3 at 0, 0.5, 1 and 1.5 deg.
class Export : public CommandTest {
 protected:
  void SetUp() override { take_run(folder_, "bed.h5", stable_bed); }
  Outcome exported(const Words& more) { return talus(Words{"export", "bed.h5"} + more); }
  std::set<std::string> files(const char* name) { return names_in(folder_.path() / name); }
};

TEST_F(Export, writes_the_frames_that_are_asked_for) {
  const std::vector<std::pair<Words, std::set<std::string>>> cases = {
      {{}, {"0000", "0001", "0002", "0003"}},
      {{"--at", "frame0-frame1,frame3"}, {"0000", "0001", "0003"}},
      {{"--at", "frame2,frame2,frame1-frame2"}, {"0001", "0002"}},
      {{"--at", "1.5,0"}, {"0000", "0003"}},
      {{"--every", "1"}, {"0000", "0002", "0003"}},
  };
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const std::string folder = "out" + std::to_string(k);
    ASSERT_TRUE(ends(exported(Words{"--to", "paraview", "-o", folder} + cases[k].first), 0,
                     {folder + ": " + std::to_string(cases[k].second.size()) + " frames for ParaView",
                      "Overloaded grains, their lengths and clusters are left out"}));
    std::set<std::string> expected;
    for (const std::string& number : cases[k].second) {
      expected.insert("grains_" + number + ".vtp");
      expected.insert("contacts_" + number + ".vtp");
    }
    EXPECT_EQ(files((folder + "/frames").c_str()), expected) << folder;
  }
}

TEST_F(Export, refuses_what_makes_no_sense) {
  const std::vector<std::tuple<Words, int, std::string>> cases = {
      {{"--to", "stl", "-o", "x"}, 64, "expected one of paraview, vti, xyz, "},
      {{"--to", "lammps", "-o", "x.xyz"}, 64, "ends in .dump"},
      {{"--to", "html", "-o", "x"}, 64, "x: expected a name that ends in .html"},
      {{"--to", "csv", "-o", "x.csv"}, 64, "x.csv: expected the name of a folder"},
      {{"--to", "observables", "-o", "x.csv", "--at", "1"}, 64, "have no effect on it"},
      {{"--to", "observables", "-o", "x.csv", "--flow"}, 65, "after failure"},
      {{"--to", "paraview"}, 64, "--output"},
      {{"--to", "paraview", "-o", "x", "--at", "frame2-frame1"}, 64, "frame0-frame10"},
      {{"--to", "paraview", "-o", "x", "--at", "frame2-frame4"},
       65,
       "the run has 4 frames, frame0 to frame3"},
      {{"--to", "paraview", "-o", "x", "--at", "30"}, 65, "no frame there"},
      {{"--to", "paraview", "-o", "x", "--at", "repose"}, 65, "has not failed"},
      {{"--to", "paraview", "-o", "x", "--flow"}, 65, "after failure"},
      {{"--to", "paraview", "-o", "x", "--at", "1", "--every", "1"}, 64, "--every"},
      {{"--to", "paraview", "-o", "x", "--every", "0"}, 64, "--every"},
      {{"--to", "paraview", "-o", "x", "--set", "lmin=0"}, 65, "l_min"},
      {{"--to", "paraview", "-o", "x", "--set", "length=4"}, 64, "--to vti"},
      {{"--to", "vti", "-o", "x", "--set", "length=0"}, 65, "'length' = 0"},
      {{"--to", "vti", "-o", "x", "--set", "length=900"}, 64, "length of the bed"},
      {{"--to", "paraview", "-o", ""}, 64, "empty"},
  };
  for (const auto& [words, code, part] : cases) EXPECT_TRUE(ends(exported(words), code, {part}));
  for (const char* name : {"x", "x.xyz", "x.csv"}) EXPECT_FALSE(folder_.has_file(name)) << name;
}

TEST_F(Export, replaces_files_only_when_told_and_never_the_run) {
  const Words words = {"--to", "paraview", "--at", "frame1", "-o", "out", "--quiet"};
  const Outcome first = exported(words);
  EXPECT_EQ(first.exit_code, 0);
  EXPECT_EQ(first.out + first.err, "");
  EXPECT_TRUE(ends(exported(words), 73, {"out/grains.pvd exists; give --overwrite"}));
  EXPECT_EQ(exported(words + Words{"--overwrite"}).exit_code, 0);
  EXPECT_EQ(exported({"--to", "paraview", "-o", "bed.h5"}).exit_code, 73) << "a file is not a folder";
  for (const Words& one : {Words{"one.xyz", "--to", "xyz", "--at", "frame2"},
                           {"one.dump", "--to", "lammps", "--at", "frame2"},
                           {"one.csv", "--to", "observables"},
                           {"one.html", "--to", "html", "--at", "frame2"}}) {
    const Words written = Words{"-o"} + one;
    EXPECT_EQ(exported(written).exit_code, 0) << one[0];
    const std::string made = folder_.text(one[0]);
    EXPECT_GT(made.size(), 1000U) << one[0];
    EXPECT_EQ(exported(written).exit_code, 73) << one[0];
    EXPECT_EQ(exported(written + Words{"--overwrite"}).exit_code, 0) << one[0];
    EXPECT_EQ(folder_.text(one[0]), made) << one[0] << ": identical each time";
  }
}

TEST_F(Export, that_replaces_a_folder_leaves_nothing_of_the_earlier_one_in_it) {
  for (const auto& [format, kept] :
       {std::pair{"paraview", std::set<std::string>{"contacts_0001.vtp", "grains_0001.vtp"}},
        std::pair{"vti", std::set<std::string>{"fields_0001.vti"}}}) {
    const std::string folder = std::string("out-") + format, frames = folder + "/frames";
    ASSERT_EQ(exported({"--to", format, "--at", "frame0-frame2", "-o", folder}).exit_code, 0);
    ASSERT_EQ(files(frames.c_str()).size(), 3 * kept.size());
    // Not written by Talus, or not under such a name.
    std::set<std::string> expected = kept;
    for (const char* foreign :
         {"grains_0000.xml", "grains_7.vtp", "contacts_.vtp", "fields_.vti", "notes.txt"}) {
      write_file(folder_, frames + "/" + foreign, "mine");
      expected.insert(foreign);
    }
    ASSERT_EQ(exported({"--to", format, "--at", "frame1", "-o", folder}).exit_code, 73) << format;
    EXPECT_EQ(files(frames.c_str()).size(), 3 * kept.size() + 5) << "nothing is removed without --overwrite";
    EXPECT_TRUE(ends(exported({"--to", format, "--at", "frame1", "-o", folder, "--overwrite"}), 0));
    EXPECT_EQ(files(frames.c_str()), expected) << format;
  }
}

TEST_F(Export, leaves_whole_files_where_it_is_stopped) {
  // A small tilt between frames gives many frames.
  take_run(folder_, "long.h5",
           "seed = 3\n[bed]\nlength = 10\ndepth = 4\n[tilt]\nstep = 0.01\nend_angle = 2\n[output]\n"
           "frame_every = 0.01\n");
  const pid_t process = folder_.start({"export", "long.h5", "--to", "paraview", "-o", "out"});
  wait_until([&] { return has_ended(process) || files("out/frames").size() >= 6; });
  kill(process, SIGINT);
  ASSERT_EQ(wait_for(process), 75) << folder_.errors();
  EXPECT_FALSE(folder_.has_file("out/grains.pvd")) << "it would name missing files";
  for (const std::string& name : files("out/frames"))
    EXPECT_TRUE(name.ends_with(".talus.part") ||
                text_of(folder_.path() / "out/frames" / name).ends_with("</VTKFile>\n"))
        << name;
  ASSERT_EQ(talus({"export", "long.h5", "--to", "paraview", "--at", "frame0", "-o", "out", "--overwrite"})
                .exit_code,
            0);
  for (const std::string& name : files("out/frames")) EXPECT_FALSE(name.ends_with(".talus.part")) << name;
}

TEST(ExportExamples, of_the_documents_are_carried_out) {
  const CommandFolder folder;
  take_run(folder, "RUN.h5",
           "seed = 1\n[bed]\nlength = 12\ndepth = 5\n[tilt]\nstep = 0.01\n[output]\nframe_every = 1\n");
  std::filesystem::create_directory(folder.path("runs"));
  std::filesystem::copy(folder.path("RUN.h5"), folder.path("runs/paper.h5"));
  EXPECT_GE(talus_commands("README.md", {"export"}).size(), 1U);
  EXPECT_GE(talus_commands("docs/export.md", {"export"}).size(), 6U);
  for (const char* page : {"README.md", "docs/export.md"})
    for (const Words& command : talus_commands(page, {"export"}))
      EXPECT_TRUE(ends(folder.talus(command), 0, {" for "})) << page;
}

}  // namespace
}  // namespace talus::test
