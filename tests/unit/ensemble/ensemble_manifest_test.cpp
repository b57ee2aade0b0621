/// Manifests: created, read back, extended, and rejected if they contradict the request.

#include "ensemble/ensemble_manifest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <fmt/core.h>
#include <fstream>
#include <set>
#include <span>

#include "base/hash.h"
#include "ensemble/member_state.h"
#include "io/durable_file.h"
#include "scenario/text.h"
#include "support/exit_code.h"
#include "support/has.h"
#include "support/process.h"
#include "support/temporary_folder.h"

namespace talus::ensemble {
namespace {

using Seeds = std::vector<std::uint64_t>;

class EnsembleManifestTest : public testing::Test {
 protected:
  EnsembleManifestTest() { std::ofstream(scenario) << "[bed]\nlength = 20\ndepth = 5\n"; }

  EnsembleManifest wanted(const Seeds& seeds, const std::vector<std::string>& axes = {},
                          const std::vector<std::string>& settings = {}) {
    return {"", seeds, "", plan_variants(scenario, settings, axes)};
  }
  static std::string hash_of(const std::string& text) {
    return hash_text(hash_bytes(std::as_bytes(std::span(text))));
  }
  /// Replaces the manifest by this text, which lacks its end, with a matching hash.
  void replace_manifest(const std::string& begin) const {
    const std::string text = begin + ",\n \"hash\": ";
    std::ofstream(manifest_path(ensemble)) << text << "\"" << hash_of(text) << "\"\n}\n";
  }
  /// Returns the text of the manifest without its end.
  std::string begin_of_manifest() const {
    const std::string text = test::text_of(manifest_path(ensemble));
    return text.substr(0, text.rfind(",\n \"hash\": "));
  }
  /// Replaces a part of the manifest, with a matching hash.
  void change_manifest(const std::string& part, const std::string& other) const {
    std::string text = begin_of_manifest();
    ASSERT_TRUE(test::has(text, part)) << part;
    replace_manifest(text.replace(text.find(part), part.size(), other));
  }
  std::string message_of_reading() const {
    const test::Refusal refusal = test::refusal_of([&] { read_ensemble(ensemble); });
    return refusal.code == ExitCode::bad_data
               ? refusal.message
               : std::string(refusal.message.empty() ? "" : "another exit code");
  }

  test::TemporaryFolder folder_;
  std::string scenario = folder_.path("bed.toml");
  std::string ensemble = folder_.path("e");
};

TEST_F(EnsembleManifestTest, is_read_back) {
  EXPECT_FALSE(is_ensemble(ensemble));
  EXPECT_EQ(test::exit_code_of([&] { read_ensemble(ensemble); }), ExitCode::missing_input);
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
  EXPECT_TRUE(test::has(test::text_of(manifest_path(ensemble)), "\"seeds\": \"2-4,9\""));
}

TEST_F(EnsembleManifestTest, remembers_which_runs_stay_until_it_is_told_otherwise) {
  EnsembleManifest asked = wanted({1, 2});
  extend_ensemble(ensemble, asked);
  EXPECT_EQ(read_ensemble(ensemble).keep, "");
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
  EXPECT_TRUE(test::refuses([&] { extend_ensemble(ensemble, wanted({1}, {}, {"contact.friction=0.4"})); },
                            ExitCode::bad_data, {"contact.friction is 0.5 there, 0.4 here"}));
  EXPECT_EQ(test::exit_code_of([&] { extend_ensemble(ensemble, wanted({1}, {"tilt.rate=2"})); }),
            ExitCode::bad_data)
      << "variants none of which exists";
}

TEST_F(EnsembleManifestTest, has_one_task_for_its_members) {
  EnsembleManifest asked = wanted({1});
  asked.task = ReadingsTask{};
  extend_ensemble(ensemble, asked);
  EXPECT_EQ(read_ensemble(ensemble).task, MemberTask(ReadingsTask{}));
  EXPECT_TRUE(test::refuses([&] { extend_ensemble(ensemble, wanted({1})); }, ExitCode::bad_data,
                            {"have the task 'readings', expected no task"}));
  EXPECT_EQ(parse_task("", "e"), MemberTask(PlainTask{}));
  for (const char* text : {"dance", "readings ", "trials", "trials --from 12", "trials --from 12 --every x"})
    EXPECT_EQ(test::exit_code_of([&] { parse_task(text, "e"); }), ExitCode::bad_data) << text;
}

TEST_F(EnsembleManifestTest, keeps_the_plan_of_trials_to_the_last_bit) {
  EnsembleManifest asked = wanted({1});
  const TrialsTask plan = {1.0 / 3.0, 0.1, {10.5, 2.0}};
  asked.task = plan;
  extend_ensemble(ensemble, asked);
  EXPECT_EQ(read_ensemble(ensemble).task, MemberTask(plan));
  asked.task = TrialsTask{1.0 / 3.0, 0.1, {10.5, 2.5}};
  EXPECT_EQ(test::exit_code_of([&] { extend_ensemble(ensemble, asked); }), ExitCode::bad_data);
}

TEST(TrialsTask, is_read_back_from_its_text_alone) {
  const TrialsTask trials = {12.5, 0.25, {10.0, 1.5}};
  const std::string text = "--from 12.5 --every 0.25 --patch 10x1.5";
  EXPECT_EQ(plan_text(trials), text);
  EXPECT_EQ(parse_task("trials " + text, "e"), MemberTask(trials));
  for (const std::string& other : {text + " --all", std::string("--from 12.5 --each 0.25 --patch 10x1.5"),
                                   std::string("--from 12.50 --every 0.25 --patch 10x1.5")})
    EXPECT_EQ(test::exit_code_of([&] { parse_task("trials " + other, "e"); }), ExitCode::bad_data) << other;
}

TEST(Patch, is_read_as_width_by_depth) {
  EXPECT_EQ(parse_patch("10x2"), (SurfacePatch{10.0, 2.0}));
  EXPECT_EQ(parse_patch("2.5x0.5"), (SurfacePatch{2.5, 0.5}));
  EXPECT_EQ(patch_text({2.5, 0.5}), "2.5x0.5");
  for (const char* bad : {"", "10", "10x", "x2", "10x2x3", "0x2", "10x-1", "nanx2", "1e9x1", "10 x 2"})
    EXPECT_FALSE(parse_patch(bad).has_value()) << bad;
}

TEST_F(EnsembleManifestTest, that_was_changed_is_refused) {
  extend_ensemble(ensemble, wanted({1}));
  const std::string path = manifest_path(ensemble), whole = test::text_of(path);
  for (std::size_t k = 0; k < whole.size(); k += 7) {
    std::string damaged = whole;
    damaged[k] = static_cast<char>(damaged[k] ^ 1);
    std::ofstream(path) << damaged;
    EXPECT_EQ(test::exit_code_of([&] { read_ensemble(ensemble); }), ExitCode::bad_data) << k;
  }
  std::ofstream(path) << whole;
  EXPECT_EQ(read_ensemble(ensemble).seeds, Seeds{1});
}

TEST_F(EnsembleManifestTest, names_no_place_outside_of_its_folder) {
  extend_ensemble(ensemble, wanted({1}));
  const std::string whole = begin_of_manifest();
  const std::string first = whole.substr(whole.find("  {\n"), whole.rfind("\n ]") - whole.find("  {\n"));
  const auto with_second = [&](const std::string& name) {
    std::string second = first;
    second.replace(second.find("\"\""), 2, "\"" + name + "\"");
    replace_manifest(std::string(whole).replace(whole.find(first), first.size(), first + ",\n" + second));
  };
  for (const std::string& name :
       {std::string(".."), std::string("../victim"), std::string("a/../../victim"), folder_.path("outside"),
        std::string("."), std::string("a//b"), std::string("a/b"), std::string("a/"), std::string("a\\tb"),
        std::string("a\\u0000"), std::string("a\\u001b[2J"), std::string(256, 'a')}) {
    with_second(name);
    const std::string message = message_of_reading();
    EXPECT_TRUE(message.starts_with(manifest_path(ensemble) + ": error at /variants/1/name: "))
        << name << message;
    EXPECT_TRUE(test::has(message, "expected a variant whose name is a folder in this one"));
  }
  for (const char* twice : {"", "scenario"}) {
    with_second(twice);
    EXPECT_TRUE(test::has(message_of_reading(), "/variants/1/name: expected unique names")) << twice;
  }
  with_second("a\xff");
  EXPECT_TRUE(test::has(message_of_reading(), ": expected JSON")) << "no UTF-8";
}

TEST_F(EnsembleManifestTest, that_is_broken_is_named_with_the_place) {
  extend_ensemble(ensemble, wanted({1}));
  const std::string whole = begin_of_manifest();
  const auto expect_refused = [&](const std::string& part, const std::string& other,
                                  const std::string& place) {
    replace_manifest(whole);
    change_manifest(part, other);
    const std::string message = message_of_reading();
    EXPECT_TRUE(message.starts_with(manifest_path(ensemble) + ": error at " + place + ": "))
        << other << message;
  };
  for (const char* seeds : {"5-1", "1-1000000000000", "1-9000,10000-19000", "9223372036854775808", "x", ""})
    expect_refused("\"seeds\": \"1\"", fmt::format("\"seeds\": \"{}\"", seeds), "/seeds");
  for (const char* seeds : {"1", "-0", "null", "[]", "{}", "123456789012345678901234567890"})
    expect_refused("\"seeds\": \"1\"", fmt::format("\"seeds\": {}", seeds), "/seeds");
  for (const char* until : {"theta_c", "theta_c:-1"})
    expect_refused("\"until\": \"\"", fmt::format("\"until\": \"{}\"", until), "/until");
  for (const char* keep : {"some", "99999999999999999999999"})
    expect_refused("\"keep\": \"\"", fmt::format("\"keep\": \"{}\"", keep), "/keep");
  for (const char* task :
       {"dance", "trials --from 12 --every 0 --patch 10x2", "trials --from nan --every 1 --patch 10x2"})
    expect_refused("\"task\": \"\"", fmt::format("\"task\": \"{}\"", task), "/task");
  expect_refused("talus ensemble 2", "talus ensemble 3", "/format");
  expect_refused("\"bed\": ", "\"bird\": ", "/variants/0/bed");
  expect_refused("[\n", "[[[[[\n", "/");
  expect_refused("\"seeds\": \"1\"", "\"seeds\": 1e400", "/");
  expect_refused("[\n", "]\n", fmt::format("byte {}", whole.find("[\n") + 1));
  expect_refused(" \"keep\": \"\"", " \"keep\": \"all\",\n \"keep\": \"\"", "line 7");
  expect_refused(" \"keep\": \"\"", " \"frob\": 1,\n \"keep\": \"\"", "line 7");
  expect_refused(" \"keep\": \"\"", "\"keep\": \"\"", "line 7");
  replace_manifest(whole);
  EXPECT_EQ(message_of_reading(), "");
}

TEST_F(EnsembleManifestTest, that_is_as_deep_as_it_is_long_is_refused) {
  extend_ensemble(ensemble, wanted({1}));
  for (const char* brackets : {"[", "{\"a\":"}) {
    std::string deep;
    while (deep.size() < 1000000) deep += brackets;
    replace_manifest(deep);
    EXPECT_TRUE(test::has(message_of_reading(), "expected at most three levels"));
  }
}

TEST_F(EnsembleManifestTest, of_an_earlier_revision_is_refused) {
  extend_ensemble(ensemble, wanted({1}));
  std::ofstream(manifest_path(ensemble)) << "talus ensemble 1\nversion 0.1.0\nseeds 1\n";
  EXPECT_TRUE(test::has(message_of_reading(),
                        "ensemble.manifest was written by an earlier revision of Talus; start another"));
}

TEST_F(EnsembleManifestTest, has_short_names_that_differ_whatever_the_values_are) {
  std::vector<std::string> files = {
      "a.csv",    "A.csv",        "x/a.csv", "../a.csv", "../../../../../../../../../a.csv",
      "a\nb.csv", "a\x1b[2J.csv", "..",      ".",        "\xc3\xa4.csv"};
  for (const char c : {'1', '2'}) files.push_back(std::string(240, 'l') + c);
  std::set<std::string> names;
  for (const std::string& file : files) {
    const auto variants =
        plan_variants(scenario, {"deposition.method=file"}, {"deposition.file=" + scenario::toml_text(file)});
    const std::string& name = variants.front().name;
    EXPECT_TRUE(name.starts_with("deposition.file=")) << name;
    EXPECT_LT(name.size(), 100u);
    EXPECT_TRUE(std::ranges::all_of(name, [](char c) { return c > ' ' && c <= '~' && c != '/'; })) << name;
    EXPECT_EQ(variants.front().full_name.find_first_of("\n\x1b"), std::string::npos);
    std::string folded = name;
    for (char& c : folded) c = static_cast<char>(std::tolower(c));
    EXPECT_TRUE(names.insert(folded).second) << name;
    extend_ensemble(folder_.path(name), {"", {1}, "", variants});
    const Variant found = read_ensemble(folder_.path(name)).variants.front();
    EXPECT_EQ(found.full_name, variants.front().full_name);
    EXPECT_EQ(found.scenario, variants.front().scenario);
  }
  const auto sweep = plan_variants(scenario, {},
                                   {"contact.friction:contact.wall_friction:contact.rolling_friction:contact."
                                    "restitution:deposition.friction:"
                                    "solver.tolerance:solver.allowed_overlap=0.5:0.5:0.01:0.1:0.5:3e-7:1e-4,"
                                    "0.5:0.5:0.01:0.1:0.5:3e-7:2e-4"});
  EXPECT_LT(sweep[0].name.size(), 100u);
  EXPECT_NE(sweep[0].name, sweep[1].name);
  EXPECT_TRUE(sweep[1].full_name.ends_with("solver.allowed_overlap=0.0002")) << sweep[1].full_name;
  EXPECT_EQ(test::exit_code_of(
                [&] { plan_variants(scenario, {"deposition.method=file"}, {"deposition.file=a\xff.csv"}); }),
            ExitCode::bad_data)
      << "no scenario file can contain it";
  EXPECT_EQ(test::exit_code_of([&] {
              plan_variants(scenario, {"deposition.method=file"},
                            {"deposition.file=" + std::string(4095, 'a')});
            }),
            ExitCode::usage)
      << "nor this one, as an absolute path";
  EXPECT_EQ(
      test::exit_code_of([&] { plan_variants(scenario, {}, std::vector<std::string>(14, "seed=1,2")); }),
      ExitCode::usage)
      << "16384 variants";
}

TEST_F(EnsembleManifestTest, loses_a_variant_that_only_fails_to_a_command_without_it) {
  extend_ensemble(ensemble, wanted({1, 2}, {"contact.friction=0.3,0.4,0.5"}));
  const auto names = [&] {
    std::string all;
    for (const Variant& variant : read_ensemble(ensemble).variants) all += variant.name.substr(17) + " ";
    return all;
  };
  const EnsemblePlan plan = plan_of(read_ensemble(ensemble), ensemble);
  record_failure(plan.members[1].path, {65, "bad"});  // member with 0.4
  record_failure(plan.members[2].path, {65, "bad"});  // member with 0.5
  io::write_text(plan.members[5].path, "done");
  extend_ensemble(ensemble, wanted({1}, {"contact.friction=0.3,0.4"}));
  EXPECT_EQ(names(), "0.3 0.4 0.5 ") << "0.4 is requested, and a member with 0.5 is done";
  extend_ensemble(ensemble, wanted({1}, {"contact.friction=0.3,0.7"}));
  EXPECT_EQ(names(), "0.3 0.5 0.7 ");
  EXPECT_FALSE(std::filesystem::exists(failure_path(plan.members[1].path)));
  EXPECT_FALSE(std::filesystem::exists(ensemble + "/scenarios/contact.friction=0.4.toml"));
  EXPECT_EQ(test::exit_code_of([&] { extend_ensemble(ensemble, wanted({1}, {"contact.friction=0.9"})); }),
            ExitCode::bad_data)
      << "waiting variants are no contradiction";
}

TEST_F(EnsembleManifestTest, of_which_all_fails_begins_anew_with_the_corrected_command) {
  extend_ensemble(ensemble, wanted({1, 2}));
  for (const Member& member : plan_of(read_ensemble(ensemble), ensemble).members)
    record_failure(member.path, {71, "too large"});
  extend_ensemble(ensemble, wanted({1}, {}, {"contact.friction=0.4"}));
  const EnsembleManifest found = read_ensemble(ensemble);
  EXPECT_EQ(found.seeds, Seeds{1});
  EXPECT_EQ(found.variants.front().scenario.contact.friction, 0.4);
  EXPECT_EQ(count_of(scan_members(plan_of(found, ensemble)), MemberStage::waiting), 1u);
}

TEST_F(EnsembleManifestTest, withdraws_no_variant_that_was_stopped_or_has_begun) {
  extend_ensemble(ensemble, wanted({1, 2}, {"contact.friction=0.3,0.4"}));
  const std::vector<Member> members = plan_of(read_ensemble(ensemble), ensemble).members;
  const auto extend = [&] { extend_ensemble(ensemble, wanted({1, 2}, {"contact.friction=0.4"})); };
  record_failure(members[0].path, {137, "killed"});
  extend();
  EXPECT_EQ(read_ensemble(ensemble).variants.size(), 2u) << "a signal does not depend on the value";
  record_failure(members[0].path, {65, "a mistake"});
  std::filesystem::create_directories(members[2].path + ".run");
  std::ofstream(members[2].path + ".run/manifest") << "talus run folder 1\n";
  extend();
  EXPECT_EQ(read_ensemble(ensemble).variants.size(), 2u) << "another seed has a run";
  record_failure(members[2].path, {65, "a mistake"});
  extend();
  EXPECT_EQ(read_ensemble(ensemble).variants.size(), 1u) << "both have failed on their own";
  EXPECT_TRUE(std::filesystem::exists(members[2].path + ".withdrawn/manifest")) << "no data are lost";
  EXPECT_FALSE(std::filesystem::exists(members[2].path + ".run")) << "the name is free";
}

TEST_F(EnsembleManifestTest, knows_the_beds_that_it_began_with) {
  const std::string file = folder_.path("a.csv");
  std::ofstream(file) << "x,y,radius\n10,0.5,0.5\n";
  const auto begin = [&] {
    EnsembleManifest asked = wanted({1}, {}, {"deposition.method=file", "deposition.file=" + file});
    hash_beds(asked.variants, ensemble);
    extend_ensemble(ensemble, asked);
  };
  begin();
  EXPECT_EQ(read_ensemble(ensemble).variants.front().origin.bed.size(), 16u);
  std::ofstream(file) << "# the same grains\nx,y,radius\n10.0,0.5,0.5\n";
  begin();
  std::ofstream(file) << "x,y,radius\n10,0.6,0.5\n";
  EXPECT_TRUE(
      test::refuses(begin, ExitCode::bad_data, {file + " (deposition.file) no longer holds the bed"}));
  std::filesystem::remove(file);
  begin();  // its members report it
  EnsembleManifest other =
      wanted({1}, {}, {"deposition.method=file", "deposition.file=" + folder_.path("none.csv")});
  EXPECT_EQ(test::exit_code_of([&] { hash_beds(other.variants, folder_.path("new")); }),
            ExitCode::missing_input);
}

TEST_F(EnsembleManifestTest, keeps_the_scenarios_that_it_began_with_as_they_were_written) {
  extend_ensemble(ensemble, wanted({1}));
  // State written by another version: the same values in different words.
  const std::string scenario_file = ensemble + "/scenarios/scenario.toml",
                    text = test::text_of(scenario_file) + "# x\n";
  std::ofstream(scenario_file) << text;
  EXPECT_EQ(test::exit_code_of([&] { read_ensemble(ensemble); }), ExitCode::bad_data);
  EXPECT_EQ(test::exit_code_of([&] { extend_ensemble(ensemble, wanted({2})); }), ExitCode::bad_data);
  EXPECT_EQ(test::text_of(scenario_file), text);
}

TEST_F(EnsembleManifestTest, of_too_many_seeds_is_refused_and_stays_as_it_is) {
  Seeds many(10000);
  for (std::size_t k = 0; k < many.size(); ++k) many[k] = k + 1;
  extend_ensemble(ensemble, wanted(many));
  EXPECT_EQ(test::exit_code_of([&] { extend_ensemble(ensemble, wanted({10001})); }), ExitCode::usage);
  EXPECT_EQ(read_ensemble(ensemble).seeds.size(), 10000u);
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
}  // namespace talus::ensemble
