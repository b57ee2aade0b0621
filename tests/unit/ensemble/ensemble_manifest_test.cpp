/// Manifests: begun, read back, extended, and refused where they say something else.

#include "ensemble/ensemble_manifest.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "support/exit_code.h"
#include "support/temporary_folder.h"

namespace talus {
namespace {

using Seeds = std::vector<std::uint64_t>;

class EnsembleManifestTest : public testing::Test {
 protected:
  EnsembleManifestTest() { std::ofstream(scenario) << "[bed]\nlength = 20\ndepth = 5\n"; }

  EnsembleManifest wanted(const Seeds& seeds, const std::vector<std::string>& axes = {},
                          const std::vector<std::string>& settings = {}) {
    return {"", seeds, "", plan_variants(scenario, settings, axes)};
  }
  static std::string text_of(const std::string& path) {
    std::stringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
  }

  test::TemporaryFolder folder_;
  std::string scenario = folder_.path("bed.toml");
  std::string ensemble = folder_.path("e");
};

TEST_F(EnsembleManifestTest, is_read_back) {
  EXPECT_FALSE(is_ensemble(ensemble));
  EnsembleManifest asked = wanted({2, 3, 4, 9}, {"contact.friction=0.3,0.5"});
  asked.until = "theta_c:0.2";
  extend_ensemble(ensemble, asked);
  const EnsembleManifest found = read_ensemble(ensemble);
  EXPECT_EQ(found.seeds, (Seeds{2, 3, 4, 9}));
  EXPECT_EQ(found.until, "theta_c:0.2");
  ASSERT_EQ(found.variants.size(), 2u);
  EXPECT_EQ(found.variants[1].name, "contact.friction=0.5");
  EXPECT_EQ(found.variants[0].scenario, asked.variants[0].scenario);
  EXPECT_EQ(found.variants[0].scenario.contact.friction, 0.3);
  EXPECT_NE(text_of(manifest_path(ensemble)).find("seeds 2-4,9\n"), std::string::npos);
}

TEST_F(EnsembleManifestTest, remembers_which_runs_stay_until_it_is_told_otherwise) {
  EnsembleManifest asked = wanted({1, 2});
  extend_ensemble(ensemble, asked);
  EXPECT_EQ(read_ensemble(ensemble).keep, "");
  EXPECT_EQ(text_of(manifest_path(ensemble)).find("keep"), std::string::npos)
      << "as before there was a choice";
  for (const auto& [given, expected] :
       {std::pair{"analysis", "analysis"}, {"", "analysis"}, {"3", "3"}, {"all", "all"}}) {
    asked.keep = given;
    EXPECT_EQ(extend_ensemble(ensemble, asked).keep, expected);
    EXPECT_EQ(read_ensemble(ensemble).keep, expected);
  }
}

TEST_F(EnsembleManifestTest, takes_more_seeds_and_values) {
  extend_ensemble(ensemble, wanted({1, 2}, {"contact.friction=0.3"}));
  extend_ensemble(ensemble, wanted({2, 5}, {"contact.friction=0.3,0.7"}));
  const EnsembleManifest found = read_ensemble(ensemble);
  EXPECT_EQ(found.seeds, (Seeds{1, 2, 5}));
  ASSERT_EQ(found.variants.size(), 2u);
  EXPECT_EQ(plan_of(found, ensemble).members.size(), 6u);
}

TEST_F(EnsembleManifestTest, is_not_written_again_where_nothing_is_new) {
  extend_ensemble(ensemble, wanted({1, 2}));
  const auto written = std::filesystem::last_write_time(manifest_path(ensemble));
  extend_ensemble(ensemble, wanted({2}));
  EXPECT_EQ(std::filesystem::last_write_time(manifest_path(ensemble)), written);
}

TEST_F(EnsembleManifestTest, of_another_scenario_is_refused_and_says_why) {
  extend_ensemble(ensemble, wanted({1}));
  try {
    extend_ensemble(ensemble, wanted({1}, {}, {"contact.friction=0.4"}));
    FAIL() << "nothing was refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    EXPECT_NE(std::string(error.what()).find("contact.friction is 0.5 there, 0.4 here"), std::string::npos)
        << error.what();
  }
  EXPECT_EQ(test::exit_code_of([&] { extend_ensemble(ensemble, wanted({1}, {"tilt.rate=2"})); }),
            ExitCode::bad_data)
      << "variants of which none is there";
}

TEST_F(EnsembleManifestTest, has_one_task_for_its_members) {
  EnsembleManifest asked = wanted({1});
  asked.task = ReadingsTask{};
  extend_ensemble(ensemble, asked);
  EXPECT_EQ(read_ensemble(ensemble).task, MemberTask(ReadingsTask{}));
  try {
    extend_ensemble(ensemble, wanted({1}));
    FAIL() << "nothing was refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    EXPECT_NE(std::string(error.what()).find("have the task 'readings', expected no task"), std::string::npos)
        << error.what();
  }
  EXPECT_EQ(parse_task("", "e"), MemberTask(PlainTask{}));
  for (const char* text : {"dance", "readings ", "trials", "trials --from 12", "trials --from 12 --every x"})
    EXPECT_EQ(test::exit_code_of([&] { parse_task(text, "e"); }), ExitCode::bad_data) << text;
}

TEST_F(EnsembleManifestTest, keeps_the_plan_of_trials_to_the_last_bit) {
  EnsembleManifest asked = wanted({1});
  const PerturbationPlan plan = {1.0 / 3.0, 0.1, {10.5, 2.0}};
  asked.task = plan;
  extend_ensemble(ensemble, asked);
  EXPECT_EQ(read_ensemble(ensemble).task, MemberTask(plan));
  asked.task = PerturbationPlan{1.0 / 3.0, 0.1, {10.5, 2.5}};
  EXPECT_EQ(test::exit_code_of([&] { extend_ensemble(ensemble, asked); }), ExitCode::bad_data);
}

TEST_F(EnsembleManifestTest, that_was_changed_is_refused) {
  extend_ensemble(ensemble, wanted({1}));
  const std::string path = manifest_path(ensemble), whole = text_of(path);
  for (std::size_t k = 0; k < whole.size(); k += 7) {
    std::string damaged = whole;
    damaged[k] = static_cast<char>(damaged[k] ^ 1);
    std::ofstream(path) << damaged;
    EXPECT_EQ(test::exit_code_of([&] { read_ensemble(ensemble); }), ExitCode::bad_data) << k;
  }
  std::ofstream(path) << whole;
  EXPECT_EQ(read_ensemble(ensemble).seeds, Seeds{1});
}

TEST_F(EnsembleManifestTest, whose_scenario_was_changed_is_refused) {
  extend_ensemble(ensemble, wanted({1}));
  std::ofstream(ensemble + "/scenarios/scenario.toml", std::ios::app) << "# a word\n";
  EXPECT_EQ(test::exit_code_of([&] { read_ensemble(ensemble); }), ExitCode::bad_data);
}

TEST_F(EnsembleManifestTest, keeps_the_scenarios_that_it_began_with_as_they_were_written) {
  extend_ensemble(ensemble, wanted({1}));
  // As an earlier version wrote it: the same values, other words.
  const std::string scenario_file = ensemble + "/scenarios/scenario.toml",
                    text = text_of(scenario_file) + "# x\n";
  std::ofstream(scenario_file) << text;
  EXPECT_EQ(test::exit_code_of([&] { extend_ensemble(ensemble, wanted({2})); }), ExitCode::bad_data);
  EXPECT_EQ(text_of(scenario_file), text);
}

TEST_F(EnsembleManifestTest, of_too_many_seeds_is_refused_and_stays_as_it_is) {
  Seeds many(10000);
  for (std::size_t k = 0; k < many.size(); ++k) many[k] = k + 1;
  extend_ensemble(ensemble, wanted(many));
  EXPECT_EQ(test::exit_code_of([&] { extend_ensemble(ensemble, wanted({10001})); }), ExitCode::usage);
  EXPECT_EQ(read_ensemble(ensemble).seeds.size(), 10000u);
}

TEST_F(EnsembleManifestTest, that_is_missing_is_missing_input) {
  EXPECT_EQ(test::exit_code_of([&] { read_ensemble(ensemble); }), ExitCode::missing_input);
}

TEST_F(EnsembleManifestTest, names_the_file_of_a_bed_from_anywhere) {
  const std::vector<Variant> variants =
      plan_variants(scenario, {"deposition.method=file", "deposition.file=bed.csv"}, {});
  EXPECT_EQ(variants.front().scenario.deposition.file,
            (std::filesystem::current_path() / "bed.csv").string());
}

TEST_F(EnsembleManifestTest, has_each_combination_of_what_varies_once) {
  const std::vector<Variant> variants = plan_variants(
      scenario, {}, {"contact.friction=0.3,0.30,0.5", "tilt.rate:tilt.step=2:0.002,0.5:0.0005"});
  ASSERT_EQ(variants.size(), 4u);
  EXPECT_EQ(variants[1].name, "contact.friction=0.3,tilt.rate=0.5,tilt.step=0.0005");
  EXPECT_EQ(variants[3].scenario.contact.friction, 0.5);
  EXPECT_EQ(plan_variants(scenario, {}, {}).front().name, "");
}

}  // namespace
}  // namespace talus
