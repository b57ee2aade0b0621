/// `talus figures`: the files that it makes for a tiny bed, and the requests that it rejects.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "support/process.h"
#include "support/runs.h"

namespace talus::test {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void expect_parts(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

/// Folder with a run of 32 grains that remains stable up to 1.5 deg: 4 frames.
class Figures : public testing::Test {
 protected:
  Figures() {
    const char* const bed =
        "[bed]\nlength = 10\ndepth = 4\n[tilt]\nend_angle = 1.5\n[output]\nframe_every = 0.5\n";
    write_file(folder_, "bed.toml", bed);
    take_run(folder_, "bed.h5", bed);
  }

  Outcome figures(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"figures", "bed.h5", "-o", "out"});
    return run_talus(more, folder_.path());
  }
  fs::path out(const std::string& name) const { return folder_.path() / "out" / name; }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& entry : fs::directory_iterator(folder_.path() / "out"))
      all.push_back(entry.path().filename().string());
    std::ranges::sort(all);
    return all;
  }

  TemporaryFolder folder_;
};

TEST_F(Figures, of_one_tilt_alone_have_an_axis) {
  write_file(folder_, "flat.toml", "[bed]\nlength = 10\ndepth = 2\n[tilt]\nend_angle = 0.05\n");
  ASSERT_EQ(run_talus({"ensemble", "flat.toml", "--seeds", "1-2", "-o", "e"}, folder_.path()).exit_code, 0);
  const Outcome outcome = run_talus({"figures", "e/ensemble.h5", "--only", "4", "-o", "out"}, folder_.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST_F(Figures, are_files_of_each_kind) {
  const Outcome outcome =
      figures({"--only", "4,fig09-overloaded-fraction", "--set", "gamma_c=0.3", "--add", "svg,paper"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_parts(outcome.out, {"fig04-shear-stress ", "fig09-overloaded-fraction ", "2 figures in out"});
  EXPECT_EQ(names(), (std::vector<std::string>{
                         "fig04-shear-stress-pbc-l-10-d.csv", "fig04-shear-stress.json",
                         "fig04-shear-stress.pdf", "fig04-shear-stress.png", "fig04-shear-stress.svg",
                         "fig09-overloaded-fraction-paper.csv", "fig09-overloaded-fraction-pbc-l-10-d.csv",
                         "fig09-overloaded-fraction.json", "fig09-overloaded-fraction.pdf",
                         "fig09-overloaded-fraction.png", "fig09-overloaded-fraction.svg"}))
      << "no temporary files are left";
  EXPECT_TRUE(content(out("fig04-shear-stress.pdf")).starts_with("%PDF-"));
  EXPECT_TRUE(content(out("fig04-shear-stress.png")).starts_with("\x89PNG\r\n"));
  expect_parts(content(out("fig04-shear-stress.svg")), {"<svg", "</svg>"});
  EXPECT_TRUE(content(out("fig04-shear-stress-pbc-l-10-d.csv"))
                  .starts_with("theta,n,ratio,ratio_error,ratio_deviation\n0,1,"));
  expect_parts(
      content(out("fig04-shear-stress.json")),
      {"\"command\": \"talus figures bed.h5 -o out --only 4,fig09-overloaded-fraction --set gamma_c=0.3 "
       "--add svg,paper\"",
       "\"gamma_c\": \"0.3\"", "\"seed\": 1"});
}

TEST_F(Figures, of_an_ensemble_are_of_its_members_that_are_done) {
  ASSERT_EQ(run_talus({"ensemble", "bed.toml", "--seeds", "1-3", "-o", "e"}, folder_.path()).exit_code, 0);
  fs::remove(folder_.path() / "e/seed-3.h5");  // simulates a run in progress
  const Outcome two = run_talus({"figures", "e", "-o", "out", "--only", "4"}, folder_.path());
  ASSERT_EQ(two.exit_code, 0) << two.err;
  const std::string table = content(out("fig04-shear-stress-pbc-l-10-d.csv"));
  EXPECT_TRUE(table.starts_with("theta,n,ratio,ratio_error,ratio_deviation\n0,2,")) << table;
  EXPECT_EQ(table.find("NaN"), std::string::npos) << "two runs have an error and a spread\n" << table;
  for (const char* seed : {"1", "2"})
    fs::remove(folder_.path() / "e" / ("seed-" + std::string(seed) + ".h5"));
  const Outcome none = run_talus({"figures", "e", "-o", "none"}, folder_.path());
  EXPECT_EQ(none.exit_code, 66);
  expect_parts(none.err, {"e: no member of this ensemble is done yet"});
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
  ASSERT_EQ(run_talus({"ensemble", "bed.toml", "--seeds", "1-3", "-o", "e"}, folder_.path()).exit_code, 0);
  ASSERT_EQ(run_talus({"figures", "e", "-o", "of-runs", "--only", "4,14"}, folder_.path()).exit_code, 0);
  fs::create_directory(folder_.path("moved"));
  fs::rename(folder_.path("e/ensemble.h5"), folder_.path("moved/ensemble.h5"));
  ASSERT_EQ(
      run_talus({"ensemble", "bed.toml", "--seeds", "1-3", "--keep", "analysis", "-o", "e"}, folder_.path())
          .exit_code,
      0);  // and for members without frames
  for (const auto& [input, output] :
       {std::pair{"moved/ensemble.h5", "of-file"}, {"moved", "of-folder"}, {"e", "of-analyses"}}) {
    const Outcome alone =
        run_talus({"figures", input, "-o", output, "--only", "4,14,force-chains", "-q"}, folder_.path());
    ASSERT_EQ(alone.exit_code, 0) << alone.err;
    EXPECT_EQ(alone.err,
              "left out: force-chains needs a run that has failed; the input has only values of members, "
              "without frames of their runs\n");
    for (const char* table : {"fig04-shear-stress-pbc-l-10-d.csv", "fig14-volume-strain-pbc-l-10-d.csv",
                              "fig14-volume-strain-theta_d-pbc-l-10-d.csv"}) {
      const std::vector<double> runs = numbers_in(content(folder_.path() / "of-runs" / table)),
                                values = numbers_in(content(folder_.path() / output / table));
      ASSERT_EQ(runs.size(), values.size()) << table;
      ASSERT_GT(runs.size(), 3u);
      for (std::size_t k = 0; k < runs.size(); ++k)
        EXPECT_NEAR(runs[k], values[k], 1e-12) << table << " " << k;
    }
  }
  expect_parts(content(folder_.path() / "of-file/fig04-shear-stress.json"),
               {"\"path\": \"moved/ensemble.h5#seed-3\""});
  const Outcome twice = run_talus({"figures", "moved", "e", "-o", "out", "--only", "4"}, folder_.path());
  EXPECT_EQ(twice.exit_code, 65);
  expect_parts(twice.err, {"moved/ensemble.h5#seed-1 and e/seed-1.h5 are the same run"});
  const Outcome settings =
      run_talus({"figures", "moved", "-o", "out", "--set", "gamma_c=0.3"}, folder_.path());
  EXPECT_EQ(settings.exit_code, 64);
  expect_parts(settings.err, {"--set gamma_c=0.3: moved/ensemble.h5 holds values of an analysis"});
}

TEST_F(Figures, state_their_printed_size) {
  ASSERT_EQ(figures({"--only", "5", "--size", "17.8"}).exit_code, 0);
  const std::string picture = content(out("fig05-stress-ratio.png"));
  const std::size_t resolution = picture.find("pHYs");
  ASSERT_NE(resolution, std::string::npos);
  EXPECT_EQ(picture.substr(resolution + 4, 4), std::string("\0\0\x2e\x23", 4)) << "11811 px per m";
  EXPECT_EQ(picture.substr(16, 4), std::string("\0\0\x08\x36", 4)) << "17.8 cm at 300 dpi are 2102 px";
}

TEST_F(Figures, follow_a_style_sheet) {
  write_file(folder_, "small.mplstyle", "axes.labelsize: 4\n");
  ASSERT_EQ(figures({"--only", "5"}).exit_code, 0);
  const std::string before = content(out("fig05-stress-ratio.pdf"));
  ASSERT_EQ(figures({"--only", "5", "--style", "small.mplstyle", "--overwrite"}).exit_code, 0);
  EXPECT_NE(content(out("fig05-stress-ratio.pdf")), before);
  const Outcome missing = figures({"--only", "5", "--style", "none.mplstyle", "--overwrite"});
  EXPECT_EQ(missing.exit_code, 66);
  expect_parts(missing.err, {"--style none.mplstyle"});
}

TEST_F(Figures, have_the_size_and_the_frames_that_are_asked_for) {
  ASSERT_EQ(figures({"--only", "5", "--size", "12x6"}).exit_code, 0);
  EXPECT_EQ(content(out("fig05-stress-ratio.png")).substr(16, 8), std::string("\0\0\x05\x89\0\0\x02\xc4", 8))
      << "12 x 6 cm at 300 dpi are 1417 x 708 px";
  const Outcome none = figures({"--only", "5", "--at", "1"});
  EXPECT_EQ(none.exit_code, 64);
  expect_parts(none.err, {"--at: no requested figure shows single frames"});
  const Outcome far = figures({"--only", "8", "--set", "gamma_c=0.3", "--at", "80"});
  EXPECT_EQ(far.exit_code, 65);
  expect_parts(far.err, {"--at 80: no run of", "has such a frame"});
}

TEST_F(Figures, that_need_a_failure_are_left_out_of_a_bed_that_stands) {
  const Outcome outcome = figures();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_parts(outcome.err, {"left out: fig07-wall-ratio needs a bed between walls that has failed",
                             "left out: fig09-overloaded-fraction needs a periodic bed that has failed, or "
                             "has a threshold by --set gamma_c"});
  expect_parts(outcome.out, {"fig04-shear-stress", "fig05-stress-ratio", "fig14-volume-strain"});
  const Outcome none = figures({"--only", "9", "--overwrite"});
  EXPECT_EQ(none.exit_code, 65);
  expect_parts(none.err, {"no figure can be made of these runs"});
}

TEST_F(Figures, that_exist_are_replaced_only_on_request) {
  ASSERT_EQ(figures({"--only", "4"}).exit_code, 0);
  write_file(folder_, "out/fig04-shear-stress.json", "mine");
  const Outcome again = figures({"--only", "4"});
  EXPECT_EQ(again.exit_code, 73);
  expect_parts(again.err, {"exists; give --overwrite"});
  EXPECT_EQ(content(out("fig04-shear-stress.json")), "mine");
  EXPECT_EQ(figures({"--only", "4", "--overwrite"}).exit_code, 0);
  EXPECT_NE(content(out("fig04-shear-stress.json")), "mine");
}

TEST_F(Figures, that_replace_others_leave_no_table_of_them) {
  ASSERT_EQ(figures({"--only", "4"}).exit_code, 0);
  const auto files = [&] {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path("out")))
      names.insert(entry.path().filename().string());
    return names;
  };
  const std::set<std::string> made = files();
  // An earlier figure had another group, and one that cannot be made of this run was drawn as well.
  std::string provenance = content(out("fig04-shear-stress.json"));
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
  std::set<std::string> expected = made;
  expected.insert("fig04-shear-stress-mine.csv");
  EXPECT_EQ(files(), expected);
}

TEST_F(Figures, with_unknown_names_are_refused_with_the_nearest) {
  const Outcome outcome = figures({"--only", "fig09-overloaded-friction"});
  EXPECT_EQ(outcome.exit_code, 64);
  expect_parts(outcome.err, {"--only fig09-overloaded-friction: no such figure; did you mean "
                             "'fig09-overloaded-fraction'?"});
  EXPECT_EQ(figures({"--only", "3"}).exit_code, 64);
  EXPECT_FALSE(fs::exists(out("")));
}

TEST_F(Figures, of_a_wildcard_are_of_the_runs_in_it) {
  ASSERT_EQ(run_talus({"dump", "bed.h5", "--at", "1", "-o", "problem.h5"}, folder_.path()).exit_code, 0);
  const Outcome all = run_talus(
      {"figures", "bed.h5", "bed.toml", "problem.h5", "-o", "out", "--only", "4", "-q"}, folder_.path());
  ASSERT_EQ(all.exit_code, 0) << all.err;
  EXPECT_EQ(all.err, "left out: bed.toml is not a run\nleft out: problem.h5 is not a run\n");
  const Outcome none = run_talus({"figures", "bed.toml", "problem.h5", "-o", "none"}, folder_.path());
  EXPECT_EQ(none.exit_code, 65);
  expect_parts(none.err, {"none of these 2 files is a run"});
  const Outcome alone = run_talus({"figures", "problem.h5", "-o", "none"}, folder_.path());
  EXPECT_EQ(alone.exit_code, 65) << "an explicit request gives no warning";
  const Outcome missing = run_talus({"figures", "bed.h5", "missing.h5", "-o", "none"}, folder_.path());
  EXPECT_EQ(missing.exit_code, 66);
  const Outcome analysis = run_talus({"analyze", "problem.h5", "bed.h5", "-q"}, folder_.path());
  EXPECT_EQ(analysis.exit_code, 0) << analysis.err;
  EXPECT_EQ(analysis.err, "left out: problem.h5 is not a run\n");
}

TEST_F(Figures, of_one_run_twice_are_refused) {
  const Outcome outcome = run_talus({"figures", "bed.h5", "./bed.h5", "-o", "out"}, folder_.path());
  EXPECT_EQ(outcome.exit_code, 65);
  expect_parts(outcome.err, {"bed.h5 and ./bed.h5 are the same run"});
}

TEST_F(Figures, cannot_be_made_where_no_folder_can) {
  write_file(folder_, "out", "a file");
  const Outcome outcome = figures({"--only", "4"});
  EXPECT_EQ(outcome.exit_code, 73) << outcome.err;
  expect_parts(outcome.err, {"out"});
}

/// Sets a variable of the environment during its lifetime.
class Setting {
 public:
  Setting(const char* name, const std::string& value) : name_(name) { setenv(name, value.c_str(), 1); }
  ~Setting() { unsetenv(name_); }
  Setting(const Setting&) = delete;
  Setting& operator=(const Setting&) = delete;

 private:
  const char* name_;
};

TEST_F(Figures, need_matplotlib_before_anything_is_done) {
  fs::create_directory(folder_.path("modules"));
  write_file(folder_, "modules/matplotlib.py", "raise ImportError('no matplotlib', name='matplotlib')\n");
  const Setting path("PYTHONPATH", folder_.path("modules"));
  const auto written = fs::last_write_time(folder_.path("bed.h5"));
  const Outcome outcome = figures();
  EXPECT_EQ(outcome.exit_code, 69);
  expect_parts(outcome.err, {"needs the Python module matplotlib: apt-get install python3-matplotlib"});
  EXPECT_EQ(fs::last_write_time(folder_.path("bed.h5")), written) << "no analysis was stored";
  EXPECT_FALSE(fs::exists(out("")));
}

}  // namespace
}  // namespace talus::test
