/// Variants of a study: their names and their changes.

#include <gtest/gtest.h>

#include <fstream>

#include "base/errors.h"
#include "ensemble/axes.h"
#include "ensemble/ensemble_manifest.h"
#include "support/exit_code.h"
#include "support/temporary_folder.h"

namespace talus::ensemble {
namespace {

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
}

TEST_F(StudyPlanTest, takes_a_key_with_blanks_around_it_for_the_same) {
  EXPECT_EQ(plan({" tilt.step = 0.004"}, {"tilt.step = 0.002"})[1].name, "tilt.step=0.002");
}

TEST_F(StudyPlanTest, what_no_scenario_takes_is_refused) {
  for (const char* axis : {"tilt.stp=1", "tilt.step=-1", "tilt.step=word", "seed=5"})
    EXPECT_EQ(test::exit_code_of([&] { plan({}, {axis}); }), ExitCode::bad_data) << axis;
  EXPECT_EQ(test::exit_code_of([&] { plan({"contact.friction=-1"}, {}); }), ExitCode::bad_data);
}

}  // namespace
}  // namespace talus::ensemble
