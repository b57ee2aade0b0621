/// Plans of ensembles, of studies and of the reproduction, and when they end.

#include "ensemble/plan.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <set>

#include "base/errors.h"
#include "ensemble/member_results.h"
#include "support/exit_code.h"
#include "support/temporary_folder.h"

namespace talus::ensemble {
namespace {

using Seeds = std::vector<std::uint64_t>;

TEST(Seeds, are_ranges_and_numbers) {
  EXPECT_EQ(parse_seeds("1-4"), (Seeds{1, 2, 3, 4}));
  EXPECT_EQ(parse_seeds("7"), Seeds{7});
  EXPECT_EQ(parse_seeds("8,1-3,2-4"), (Seeds{1, 2, 3, 4, 8}));
  EXPECT_EQ(parse_seeds("9223372036854775807"), Seeds{9223372036854775807u});
}

TEST(Seeds, of_another_form_are_refused) {
  for (const char* text :
       {"", "a", "1-", "-1", "3-1", "1,,2", "1 2", "1.5", "1-20000", "99999999999999999999",
        "9223372036854775808", "9223372036854775807-9223372036854775808", "1-9000,20000-29000"})
    EXPECT_EQ(test::exit_code_of([&] { parse_seeds(text); }), ExitCode::usage) << text;
}

TEST(EnsemblePlan, has_every_variant_with_every_seed) {
  const EnsemblePlan plan = plan_ensemble({3, 7}, {{"a", "x.toml", {}}, {"", "y.toml", {}}}, "folder");
  ASSERT_EQ(plan.members.size(), 4u);
  const std::vector<std::string> names = {"a/seed-3", "seed-3", "a/seed-7", "seed-7"};
  for (std::size_t m = 0; m < 4; ++m) {
    EXPECT_EQ(plan.members[m].name, names[m]);
    EXPECT_EQ(plan.members[m].path, "folder/" + names[m] + ".h5");
    EXPECT_EQ(plan.members[m].variant, m % 2);
    EXPECT_EQ(plan.members[m].scenario.seed, m < 2 ? 3u : 7u);
  }
}

using Settings = std::vector<std::string>;

class StudyPlanTest : public testing::Test {
 protected:
  StudyPlanTest() {
    std::ofstream(scenario_) << "seed = 9\n[solver]\ntolerance = 1e-6\n[tilt]\nend_angle = 5\n";
  }
  std::vector<Variant> plan(const Settings& settings, const Settings& axes) const {
    return plan_one_at_a_time(scenario_, settings, axes);
  }

 private:
  test::TemporaryFolder folder_;

 protected:
  std::string scenario_ = folder_.path("bed.toml");
};

TEST(StudyAxis, has_one_variation_for_each_value) {
  EXPECT_EQ(parse_axis("tilt.step=0.002,5e-4"),
            (std::vector<Settings>{{"tilt.step=0.002"}, {"tilt.step=5e-4"}}));
  EXPECT_EQ(
      parse_axis("tilt.rate:tilt.step=2:0.002,0.5:0.0005"),
      (std::vector<Settings>{{"tilt.rate=2", "tilt.step=0.002"}, {"tilt.rate=0.5", "tilt.step=0.0005"}}));
}

TEST(StudyAxis, takes_a_value_of_toml_for_one_value) {
  EXPECT_EQ(parse_axis(R"(a.b=["to 0.1", "to 0"],none)"),
            (std::vector<Settings>{{R"(a.b=["to 0.1", "to 0"])"}, {"a.b=none"}}));
  EXPECT_EQ(parse_axis(R"(a.b="b, c.csv",a.csv)"),
            (std::vector<Settings>{{R"(a.b="b, c.csv")"}, {"a.b=a.csv"}}));
  EXPECT_EQ(
      parse_axis(R"(a.b='x,y:"z',"\",",[["]",1],2],{ k = [1,2], l = "}" })"),
      (std::vector<Settings>{
          {R"(a.b='x,y:"z')"}, {R"(a.b="\",")"}, {R"(a.b=[["]",1],2])"}, {R"(a.b={ k = [1,2], l = "}" })"}}));
  EXPECT_EQ(parse_axis(R"(a.b="""one ",", two""",'''x','y''')"),
            (std::vector<Settings>{{R"(a.b="""one ",", two""")"}, {R"(a.b='''x','y''')"}}));
  EXPECT_EQ(parse_axis("a.b=1979-05-27T07:32:00Z,07:32:00,c:d"),
            (std::vector<Settings>{{"a.b=1979-05-27T07:32:00Z"}, {"a.b=07:32:00"}, {"a.b=c:d"}}));
  EXPECT_EQ(parse_axis(R"(a:b="x:y,z":[1,2], 1979-05-27 07:32:00.5-07:00 : 2 )"),
            (std::vector<Settings>{{R"(a="x:y,z")", "b=[1,2]"}, {"a=1979-05-27 07:32:00.5-07:00", "b=2"}}));
  EXPECT_EQ(parse_axis("a.b=it's.csv,x[1.csv"), (std::vector<Settings>{{"a.b=it's.csv"}, {"a.b=x[1.csv"}}))
      << "quotes and brackets within a word";
  EXPECT_EQ(parse_axis(" a.b = 1 , 2"), (std::vector<Settings>{{"a.b=1"}, {"a.b=2"}}));
  EXPECT_EQ(parse_axis("a.b=0.2:0.45:0.1"), (std::vector<Settings>{{"a.b=0.2"}, {"a.b=0.3"}, {"a.b=0.4"}}));
  EXPECT_EQ(parse_axis("a.b=0.1:0.3:0.1").size(), 3U);
  EXPECT_EQ(parse_axis("a.b=1:3:2"), (std::vector<Settings>{{"a.b=1"}, {"a.b=3"}}));
  EXPECT_EQ(parse_axis("a.b=-0.3:0.3:0.1").at(3), Settings{"a.b=0"});
}

TEST(StudyAxis, of_another_form_is_refused) {
  for (const char* text : {"", "tilt.step", "tilt.step=", "=1", "a.b=1,,2", "a.b:c.d=1", "a.b:c.d=1:2:3",
                           "a.b:=1:2", "a.b=\"1,2", "a.b=[1,2", "a.b=1,'x", "a.b={[}", "a.b=1,"})
    EXPECT_EQ(test::exit_code_of([&] { parse_axis(text); }), ExitCode::usage) << text;
}

TEST_F(StudyPlanTest, changes_one_factor_at_a_time) {
  const std::vector<Variant> study = plan({}, {"tilt.step=0.002", "solver.tolerance=3e-7,1e-8"});
  ASSERT_EQ(study.size(), 4u) << "baseline + 1 + 2, not a product";
  EXPECT_EQ(study[0].name, "baseline");
  EXPECT_EQ(study[1].name, "tilt.step=0.002");
  EXPECT_EQ(study[3].name, "solver.tolerance=1e-08");
  EXPECT_EQ(study[0].scenario.tilt.step, 0.001);
  EXPECT_EQ(study[0].scenario.solver.tolerance, 1e-6) << "that of the scenario";
  EXPECT_EQ(study[1].scenario.tilt.step, 0.002);
  EXPECT_EQ(study[1].scenario.solver.tolerance, 1e-6);
  EXPECT_EQ(study[3].scenario.solver.tolerance, 1e-8);
}

TEST_F(StudyPlanTest, changes_joined_keys_together) {
  const std::vector<Variant> study = plan({}, {"tilt.rate:tilt.step=2:2e-3"});
  ASSERT_EQ(study.size(), 2u);
  EXPECT_EQ(study[1].name, "tilt.rate=2,tilt.step=0.002");
  EXPECT_EQ(scenario::time_step(study[1].scenario), scenario::time_step(study[0].scenario));
}

TEST_F(StudyPlanTest, runs_nothing_twice) {
  const std::vector<Variant> study = plan({}, {"solver.tolerance=0.000001,1e-7", "solver.tolerance=1.0e-7"});
  ASSERT_EQ(study.size(), 2u);
  EXPECT_EQ(study[1].name, "solver.tolerance=1e-07");
}

TEST_F(StudyPlanTest, a_setting_holds_in_all_runs_but_where_its_key_varies) {
  const std::vector<Variant> study = plan({"contact.friction=0.3", "tilt.step=0.004"}, {"tilt.step=0.002"});
  EXPECT_EQ(study[0].scenario.tilt.step, 0.004);
  EXPECT_EQ(study[1].scenario.tilt.step, 0.002);
  EXPECT_EQ(study[1].scenario.contact.friction, 0.3);
}

TEST_F(StudyPlanTest, words_are_values_too) {
  const std::vector<Variant> study = plan({}, {"tilt.end_angle=repose"});
  EXPECT_EQ(study[1].name, "tilt.end_angle=repose");
  EXPECT_FALSE(study[1].scenario.tilt.end_angle.has_value());
  EXPECT_EQ(plan({" tilt.step = 0.004"}, {"tilt.step = 0.002"})[1].name, "tilt.step=0.002");
}

TEST_F(StudyPlanTest, what_no_scenario_takes_is_refused) {
  for (const char* axis : {"tilt.stp=1", "tilt.step=-1", "tilt.step=word", "seed=5"})
    EXPECT_EQ(test::exit_code_of([&] { plan({}, {axis}); }), ExitCode::bad_data) << axis;
  EXPECT_EQ(test::exit_code_of([&] { plan({"contact.friction=-1"}, {}); }), ExitCode::bad_data);
}

constexpr double none = std::numeric_limits<double>::quiet_NaN();

MemberNumbers member_with(double theta_c) {
  return {"abc", "0.1.0 (def)", 1.5, {{"theta_c", theta_c}, {"theta_d/lc_jump[1]", none}}};
}

TEST(Precision, is_a_quantity_and_an_error) {
  const Precision precision = parse_precision("theta_d/lc_jump:0.25");
  EXPECT_EQ(precision.quantity, "theta_d/lc_jump");
  EXPECT_EQ(precision.error, 0.25);
  EXPECT_EQ(parse_precision("theta_d/lc_jump[1]:0.25").quantity, "theta_d/lc_jump[1]");
  EXPECT_EQ(parse_precision("lc/max@theta_d[1]:0.5").quantity, "lc/max@theta_d[1]");
  for (const char* text : {"", "theta_c", "theta_c:", ":0.2", "theta_c:-1", "theta_c:0", "theta_c:x",
                           "theta_c:0.2x", "theta_c[\nkeep analysis\n:1", "theta_c[:1", "theta_c[]:1",
                           "theta_c[x]:1", "theta_c[1]]:1", "lc/max:1", "lc/max@theta_x:1"})
    EXPECT_EQ(test::exit_code_of([&] { parse_precision(text); }), ExitCode::usage) << text;
}

TEST(Precision, is_reached_where_the_mean_of_every_variant_is_known_so_well) {
  const EnsemblePlan plan = plan_ensemble({1, 2, 3, 4, 5}, {{"a", "", {}}, {"b", "", {}}}, "none");
  std::vector<MemberNumbers> numbers;
  for (const double theta_c : {19.0, 20.0, 21.0, 20.0, 20.0})  // deviation 0.71, error 0.32
    numbers.insert(numbers.end(), {member_with(theta_c), member_with(theta_c)});
  EXPECT_TRUE(is_reached({"theta_c", 0.32}, plan, numbers));
  EXPECT_FALSE(is_reached({"theta_c", 0.31}, plan, numbers));
  numbers.back() = {};  // one member of variant b is not done, and four values are too few
  EXPECT_FALSE(is_reached({"theta_c", 10.0}, plan, numbers));
  EXPECT_FALSE(is_reached({"theta_d/lc_jump[1]", 10.0}, plan, numbers)) << "no member has a value";
}

TEST(Precision, of_what_no_run_has_is_refused_and_says_what_there_is) {
  EXPECT_TRUE(test::refuses([] { parse_precision("theta_x:1"); }, ExitCode::usage,
                            {"theta_x", "theta_c", "theta_d/dilation", "theta_r"}));
  EXPECT_EQ(parse_precision("theta_d/dilation[1]:1").quantity, "theta_d/dilation[1]");
}

TEST(PaperBeds, are_periodic_in_three_preparations_and_between_walls) {
  const std::vector<Variant> beds = paper_beds(false);
  ASSERT_EQ(beds.size(), 8u);
  std::set<std::string> names;
  for (const Variant& bed : beds) EXPECT_TRUE(names.insert(bed.name).second) << bed.name;
  const scenario::DepositionMethod methods[] = {scenario::DepositionMethod::pour,
                                                scenario::DepositionMethod::geometric,
                                                scenario::DepositionMethod::collapse};
  for (std::size_t b = 0; b < 3; ++b) {
    EXPECT_EQ(beds[b].scenario.bed.boundary, scenario::BedBoundary::periodic);
    EXPECT_EQ(beds[b].scenario.deposition.method, methods[b]);
    EXPECT_EQ(beds[b].scenario.bed.length, 200.0);
  }
  for (std::size_t b = 3; b < 8; ++b) {
    EXPECT_EQ(beds[b].scenario.bed.boundary, scenario::BedBoundary::walls);
    EXPECT_EQ(beds[b].scenario.bed.length, 100.0 + 50.0 * static_cast<double>(b - 3));
    EXPECT_EQ(beds[b].scenario.bed.depth, 40.0);
  }
}

TEST(PaperBeds, keep_depth_over_length_for_a_quick_look) {
  const std::vector<Variant> full = paper_beds(false), quick = paper_beds(true);
  for (std::size_t b = 0; b < full.size(); ++b) {
    EXPECT_DOUBLE_EQ(quick[b].scenario.bed.depth / quick[b].scenario.bed.length,
                     full[b].scenario.bed.depth / full[b].scenario.bed.length);
    EXPECT_EQ(quick[b].scenario.bed.depth, 20.0);
  }
  EXPECT_EQ(quick[3].name, "wbc-50");
}

}  // namespace
}  // namespace talus::ensemble
