/// `talus figures`: the files that it makes for a tiny bed, and the requests that it rejects.

#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "support/commands.h"
#include "support/runs.h"

namespace talus::test {
namespace {

namespace fs = std::filesystem;

class Figures : public CommandTest {
 protected:
  Figures() : CommandTest(stable_bed) { take_run(folder_, "bed.h5", stable_bed); }

  Outcome figures(Words more = {}) const {
    return folder_.talus(Words{"figures", "bed.h5", "-o", "out"} + more);
  }
  std::string out(const std::string& name) const { return folder_.text("out/" + name); }
};

TEST_F(Figures, of_one_tilt_alone_have_an_axis) {
  write_file(folder_, "flat.toml", "[bed]\nlength = 10\ndepth = 2\n[tilt]\nend_angle = 0.05\n");
  ASSERT_EQ(folder_.talus({"ensemble", "flat.toml", "--seeds", "1-2", "-o", "e"}).exit_code, 0);
  EXPECT_TRUE(ends(folder_.talus({"figures", "e/ensemble.h5", "--only", "4", "-o", "out"}), 0));
}

TEST_F(Figures, are_files_of_each_kind) {
  ASSERT_TRUE(
      ends(figures({"--only", "4,fig09-overloaded-fraction", "--set", "gamma_c=0.3", "--add", "svg,paper"}),
           0, {"fig04-shear-stress ", "fig09-overloaded-fraction ", "2 figures in out"}));
  EXPECT_EQ(
      names_in(folder_.path("out")),
      (std::set<std::string>{
          "fig04-shear-stress-pbc-l-10-d.csv", "fig04-shear-stress.json", "fig04-shear-stress.pdf",
          "fig04-shear-stress.png", "fig04-shear-stress.svg", "fig09-overloaded-fraction-paper.csv",
          "fig09-overloaded-fraction-pbc-l-10-d.csv", "fig09-overloaded-fraction.json",
          "fig09-overloaded-fraction.pdf", "fig09-overloaded-fraction.png", "fig09-overloaded-fraction.svg"}))
      << "no temporary files are left";
  EXPECT_TRUE(out("fig04-shear-stress.pdf").starts_with("%PDF-"));
  EXPECT_TRUE(out("fig04-shear-stress.png").starts_with("\x89PNG\r\n"));
  EXPECT_TRUE(has_all(out("fig04-shear-stress.svg"), {"<svg", "</svg>"}));
  EXPECT_TRUE(out("fig04-shear-stress-pbc-l-10-d.csv")
                  .starts_with("theta,n,ratio,ratio_error,ratio_deviation\n0,1,"));
  EXPECT_TRUE(has_all(
      out("fig04-shear-stress.json"),
      {"\"command\": \"talus figures bed.h5 -o out --only 4,fig09-overloaded-fraction --set gamma_c=0.3 "
       "--add svg,paper\"",
       "\"gamma_c\": \"0.3\"", "\"seed\": 1"}));
}

TEST_F(Figures, of_an_ensemble_are_of_its_members_that_are_done) {
  ASSERT_EQ(folder_.talus({"ensemble", "bed.toml", "--seeds", "1-3", "-o", "e"}).exit_code, 0);
  fs::remove(folder_.path() / "e/seed-3.h5");  // simulates a run in progress
  ASSERT_TRUE(ends(talus({"figures", "e", "-o", "out", "--only", "4"}), 0));
  const std::string table = out("fig04-shear-stress-pbc-l-10-d.csv");
  EXPECT_TRUE(table.starts_with("theta,n,ratio,ratio_error,ratio_deviation\n0,2,")) << table;
  EXPECT_FALSE(has(table, "NaN")) << "two runs have an error and a spread";
  for (const char* seed : {"1", "2"})
    fs::remove(folder_.path() / "e" / ("seed-" + std::string(seed) + ".h5"));
  EXPECT_TRUE(
      ends(folder_.talus({"figures", "e", "-o", "none"}), 66, {"e: no member of this ensemble is done yet"}));
}

/// Returns the numbers of a table, which follow its heading line.
std::vector<double> numbers_in(const std::string& table) {
  std::vector<double> numbers;
  std::istringstream cells(table.substr(table.find('\n')));
  for (std::string line; std::getline(cells, line);) {
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');)
      numbers.push_back(cell == "NaN" ? 0.125 : std::stod(cell));
  }
  return numbers;
}

TEST_F(Figures, of_ensemble_h5_alone_are_those_of_its_runs) {
  ASSERT_EQ(folder_.talus({"ensemble", "bed.toml", "--seeds", "1-3", "-o", "e"}).exit_code, 0);
  ASSERT_EQ(folder_.talus({"figures", "e", "-o", "of-runs", "--only", "4,14"}).exit_code, 0);
  fs::create_directory(folder_.path("moved"));
  fs::rename(folder_.path("e/ensemble.h5"), folder_.path("moved/ensemble.h5"));
  ASSERT_EQ(
      folder_.talus({"ensemble", "bed.toml", "--seeds", "1-3", "--keep", "analysis", "-o", "e"}).exit_code,
      0);  // and for members without frames
  for (const auto& [input, output] :
       {std::pair{"moved/ensemble.h5", "of-file"}, {"moved", "of-folder"}, {"e", "of-analyses"}}) {
    const Outcome alone =
        folder_.talus({"figures", input, "-o", output, "--only", "4,14,force-chains", "-q"});
    ASSERT_EQ(alone.exit_code, 0) << alone.err;
    EXPECT_EQ(alone.err, "left out: force-chains needs the frames of a run that has failed\n");
    for (const char* table : {"fig04-shear-stress-pbc-l-10-d.csv", "fig14-volume-strain-pbc-l-10-d.csv",
                              "fig14-volume-strain-theta_d-pbc-l-10-d.csv"}) {
      const std::vector<double> runs = numbers_in(folder_.text(std::string("of-runs/") + table)),
                                values = numbers_in(folder_.text(std::string(output) + "/" + table));
      ASSERT_EQ(runs.size(), values.size()) << table;
      ASSERT_GT(runs.size(), 3u);
      for (std::size_t k = 0; k < runs.size(); ++k)
        EXPECT_NEAR(runs[k], values[k], 1e-12) << table << " " << k;
    }
  }
  EXPECT_TRUE(has(folder_.text("of-file/fig04-shear-stress.json"), "\"path\": \"moved/ensemble.h5#seed-3\""));
  EXPECT_TRUE(ends(folder_.talus({"figures", "moved", "e", "-o", "out", "--only", "4"}), 65,
                   {"moved/ensemble.h5#seed-1 and e/seed-1.h5 are the same run"}));
  EXPECT_TRUE(ends(folder_.talus({"figures", "moved", "-o", "out", "--set", "gamma_c=0.3"}), 64,
                   {"--set gamma_c=0.3: moved/ensemble.h5 holds values of an analysis"}));
}

TEST_F(Figures, state_their_printed_size) {
  ASSERT_EQ(figures({"--only", "5", "--size", "17.8cm"}).exit_code, 0);
  const std::string picture = out("fig05-stress-ratio.png");
  const std::size_t resolution = picture.find("pHYs");
  ASSERT_NE(resolution, std::string::npos);
  EXPECT_EQ(picture.substr(resolution + 4, 4), std::string("\0\0\x2e\x23", 4)) << "11811 px per m";
  EXPECT_EQ(picture.substr(16, 4), std::string("\0\0\x08\x36", 4)) << "17.8 cm at 300 dpi are 2102 px";
  ASSERT_EQ(figures({"--only", "5", "--size", "12x6cm", "--overwrite"}).exit_code, 0);
  EXPECT_EQ(out("fig05-stress-ratio.png").substr(16, 8), std::string("\0\0\x05\x89\0\0\x02\xc4", 8))
      << "12 x 6 cm at 300 dpi are 1417 x 708 px";
}

TEST_F(Figures, follow_a_style_sheet) {
  write_file(folder_, "small.mplstyle", "axes.labelsize: 4\n");
  ASSERT_EQ(figures({"--only", "5"}).exit_code, 0);
  const std::string before = out("fig05-stress-ratio.pdf");
  ASSERT_EQ(figures({"--only", "5", "--style", "small.mplstyle", "--overwrite"}).exit_code, 0);
  EXPECT_NE(out("fig05-stress-ratio.pdf"), before);
  EXPECT_TRUE(ends(figures({"--only", "5", "--style", "none.mplstyle", "--overwrite"}), 66,
                   {"--style none.mplstyle"}));
}

TEST_F(Figures, that_need_a_failure_are_left_out_of_a_bed_that_stands) {
  const Outcome outcome = figures();
  ASSERT_TRUE(ends(outcome, 0, {"fig04-shear-stress", "fig05-stress-ratio", "fig14-volume-strain"}));
  EXPECT_TRUE(
      has_all(outcome.err, {"left out: fig07-wall-ratio needs a bed between walls that has failed",
                            "left out: fig09-overloaded-fraction needs a periodic bed that has failed, or "
                            "has a threshold by --set gamma_c"}));
  EXPECT_TRUE(ends(figures({"--only", "9", "--overwrite"}), 65, {"no figure can be made of these runs"}));
}

TEST_F(Figures, that_replace_others_leave_no_table_of_them) {
  ASSERT_EQ(figures({"--only", "4"}).exit_code, 0);
  std::set<std::string> expected = names_in(folder_.path("out"));
  // An earlier figure had another group, and one that cannot be made of this run was drawn as well.
  std::string provenance = out("fig04-shear-stress.json");
  const std::size_t tables = provenance.find("\"file\": \"");
  ASSERT_NE(tables, std::string::npos) << provenance;
  provenance.insert(provenance.find('{', provenance.find("\"tables\"")),
                    "{\"file\": \"fig04-shear-stress-old.csv\", \"columns\": []}, "
                    "{\"file\": \"../bed.toml\", \"columns\": []}, ");
  write_file(folder_, "out/fig04-shear-stress.json", provenance);
  write_file(folder_, "out/fig09-overloaded-fraction.json",
             "{\"figure\": \"fig09-overloaded-fraction\", \"tables\": [{\"file\": "
             "\"fig09-overloaded-fraction-a.csv\"}]}");
  for (const char* name : {"fig04-shear-stress-old.csv", "fig04-shear-stress-mine.csv",
                           "fig09-overloaded-fraction-a.csv", "fig09-overloaded-fraction.pdf"})
    write_file(folder_, std::string("out/") + name, "1");
  ASSERT_EQ(figures({"--only", "4,9", "--overwrite"}).exit_code, 0);
  expected.insert("fig04-shear-stress-mine.csv");
  EXPECT_EQ(names_in(folder_.path("out")), expected);
}

TEST_F(Figures, of_a_wildcard_are_of_the_runs_in_it) {
  ASSERT_EQ(folder_.talus({"dump", "bed.h5", "--at", "1", "-o", "problem.h5"}).exit_code, 0);
  const Outcome all =
      folder_.talus({"figures", "bed.h5", "bed.toml", "problem.h5", "-o", "out", "--only", "4", "-q"});
  ASSERT_EQ(all.exit_code, 0) << all.err;
  EXPECT_EQ(all.err, "left out: bed.toml is not a run\nleft out: problem.h5 is not a run\n");
  EXPECT_TRUE(ends(talus({"figures", "bed.toml", "problem.h5", "-o", "none"}), 65,
                   {"none of these 2 files is a run"}));
  EXPECT_TRUE(ends(folder_.talus({"figures", "problem.h5", "-o", "none"}), 65))
      << "an explicit request gives no warning";
  EXPECT_TRUE(ends(folder_.talus({"figures", "bed.h5", "missing.h5", "-o", "none"}), 66));
  const Outcome analysis = folder_.talus({"analyze", "problem.h5", "bed.h5", "-q"});
  EXPECT_EQ(analysis.exit_code, 0) << analysis.err;
  EXPECT_EQ(analysis.err, "left out: problem.h5 is not a run\n");
}

TEST_F(Figures, cannot_be_made_where_no_folder_can) {
  write_file(folder_, "out", "a file");
  EXPECT_TRUE(ends(figures({"--only", "4"}), 73, {"out"}));
}

TEST_F(Figures, and_other_commands_say_which_module_is_missing_before_anything_is_done) {
  const auto written = fs::last_write_time(folder_.path("bed.h5"));
  const std::pair<const char*, Words> cases[] = {
      {"matplotlib", {"figures", "bed.h5", "-o", "out"}},
      {"matplotlib", {"reproduce", "--quick", "-o", "out"}},
      {"numpy", {"perturb", "bed.toml", "--seeds", "1", "-o", "out"}},
  };
  for (const auto& [module, words] : cases) {
    const std::string name = module, place = "without-" + name;
    fs::create_directories(folder_.path(place));
    write_file(folder_, place + "/" + name + ".py", "raise ImportError('none', name='" + name + "')\n");
    EXPECT_TRUE(ends(talus(words, {"PYTHONPATH=" + folder_.path(place)}), 69,
                     {"needs the Python module " + name + ": apt-get install python3-" + name}));
    EXPECT_FALSE(folder_.has_file("out")) << words[0];
  }
  EXPECT_EQ(fs::last_write_time(folder_.path("bed.h5")), written) << "no analysis was stored";
}

}  // namespace
}  // namespace talus::test
