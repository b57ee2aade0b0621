/// tilt.program: meaning of its phrases, the tilt of each step, and rejected programmes.

#include "scenario/tilt_program.h"

#include <gtest/gtest.h>

#include "core/trigonometry.h"
#include "scenario/keys.h"
#include "scenario/text.h"
#include "support/exit_code.h"

namespace talus::scenario {
namespace {

using Verb = ProgramPhrase::Verb;

Scenario scenario_of(std::vector<std::string> program) {
  Scenario scenario;
  scenario.tilt.program = std::move(program);
  return scenario;
}

TiltProgram program_of(std::vector<std::string> program) {
  return TiltProgram(scenario_of(std::move(program)));
}

std::string message_of(const std::string& text, const std::vector<std::string>& settings = {}) {
  return test::message_of([&] { parse_scenario(text, "s.toml", settings); });
}

TEST(ProgramPhrase, is_read_with_its_numbers_and_units) {
  const auto phrase = [](Verb verb, double value, std::optional<double> rate = {}) {
    return std::optional(ProgramPhrase{verb, value, rate});
  };
  EXPECT_EQ(program_phrase("to 12"), phrase(Verb::to, 12.0));
  EXPECT_EQ(program_phrase("  to\t-12.5 deg at 0.5 deg/s "), phrase(Verb::to, -12.5, 0.5));
  EXPECT_EQ(program_phrase("to repose at 2"), phrase(Verb::to_repose, 0.0, 2.0));
  EXPECT_EQ(program_phrase("by +1"), phrase(Verb::by, 1.0));
  EXPECT_EQ(program_phrase("by -1 deg at 100"), phrase(Verb::by, -1.0, 100.0));
  EXPECT_EQ(program_phrase("hold 5"), phrase(Verb::hold, 5.0));
  EXPECT_EQ(program_phrase("hold 3600 s"), phrase(Verb::hold, 3600.0));
  EXPECT_EQ(program_phrase("10 times"), phrase(Verb::times, 10.0));
  EXPECT_EQ(program_phrase("1 time"), phrase(Verb::times, 1.0));
  EXPECT_EQ(program_phrase("once"), phrase(Verb::times, 1.0));
}

TEST(ProgramPhrase, with_another_word_or_a_number_out_of_range_is_none) {
  const std::pair<std::string, std::vector<std::string>> wrong[] = {
      {"",
       {"", " ", "to", "hold", "times", "0 times", "1.5 times", "10001 times", "10 times at 1", "once more",
        "raise 12", "TO 12", "12"}},
      {"to ",
       {"61", "-61", "nan", "inf", "1e400", "12 at", "12 at 0", "12 at 101", "12 at 1 s", "12 12",
        "repose 3"}},
      {"by ", {"0", "61"}},
      {"hold ", {"0", "-1", "3601", "5 deg", "5 at 1"}}};
  for (const auto& [verb, rests] : wrong)
    for (const std::string& rest : rests)
      EXPECT_EQ(program_phrase(verb + rest), std::nullopt) << verb << rest;
}

TEST(TiltProgram, goes_to_its_angles_exactly_and_by_whole_steps_between_them) {
  const TiltProgram program = program_of({"to 0.0105", "hold 0.003", "to 0.005 at 2", "by 0.001"});
  const double step = radians(0.001);
  // 0.0105 deg correspond to ten or eleven steps of 0.001 deg: half a step is rounded away from zero.
  ASSERT_EQ(program.segments().size(), 4u);
  const std::int64_t up = program.segments()[0].steps;
  EXPECT_TRUE(up == 10 || up == 11);
  EXPECT_EQ(program.tilt(0), 0.0);
  for (std::int64_t k = 0; k < up; ++k) EXPECT_EQ(program.tilt(k), static_cast<double>(k) * step) << k;
  for (std::int64_t k = up; k <= up + 3; ++k) EXPECT_EQ(program.tilt(k), radians(0.0105)) << "held, " << k;
  EXPECT_EQ(program.segments()[1].steps, 3);
  EXPECT_EQ(program.segments()[2].steps, 3) << "2 deg/s is 0.002 deg per step";
  EXPECT_EQ(program.tilt(up + 4), radians(0.0105) - radians(0.002));
  EXPECT_EQ(program.tilt(up + 6), radians(0.005));
  EXPECT_EQ(program.tilt(up + 7), radians(0.005 + 0.001));
  EXPECT_EQ(program.steps(), up + 7);
  EXPECT_EQ(program.tilt(program.steps() + 5), radians(0.005 + 0.001)) << "beyond its end the tilt stays";
  for (std::int64_t k = 1; k <= program.steps(); ++k)
    EXPECT_EQ(program.turns_at(k), k == up || k == up + 3 || k == up + 6 || k == up + 7) << k;
}

TEST(TiltProgram, that_only_goes_to_repose_is_the_tilt_without_one) {
  const TiltProgram program = program_of({"to repose"});
  EXPECT_TRUE(program.ends_at_repose());
  for (std::int64_t k : {0, 1, 2, 17, 1000, 19999, 59999})
    EXPECT_EQ(program.tilt(k), static_cast<double>(k) * radians(0.001)) << k;
  const TiltProgram named = program_of({"to 12", "to repose"});
  for (std::int64_t k : {1, 11999}) EXPECT_EQ(named.tilt(k), static_cast<double>(k) * radians(0.001)) << k;
}

TEST(TiltProgram, repeats_what_stands_between_two_counts) {
  const TiltProgram program =
      program_of({"to 5", "once", "to 12", "to -12", "3 times", "by 1", "hold 1", "2 times", "to repose"});
  std::vector<double> ends;
  for (const TiltSegment& segment : program.segments()) ends.push_back(segment.to);
  EXPECT_EQ(ends, (std::vector<double>{5, 12, -12, 12, -12, 12, -12, -11, -11, -10, -10, 60}));
  EXPECT_TRUE(program.ends_at_repose());
  std::int64_t begin = 0;
  for (const TiltSegment& segment : program.segments()) {
    EXPECT_EQ(segment.begin, begin);
    begin = segment.end();
  }
  EXPECT_EQ(program.segments()[2].steps, 24000);
  EXPECT_EQ(program.segments()[2].step, -0.001);
}

TEST(TiltProgram, a_part_without_a_way_takes_no_step) {
  const TiltProgram program = program_of({"to 0", "to 1", "2 times"});
  EXPECT_EQ(program.segments().size(), 3u) << "the first \"to 0\" is the initial tilt";
}

TEST(TiltProgram, is_none_by_default) {
  EXPECT_TRUE(TiltProgram(Scenario{}).empty());
  EXPECT_EQ(TiltProgram(Scenario{}).steps(), 0);
  EXPECT_EQ(parse_scenario("tilt.program = 'none'", "s.toml"), Scenario{});
}

TEST(TiltProgram, is_given_in_a_file_or_on_the_command_line) {
  const Scenario wanted = scenario_of({"to 12", "to 0 at 0.5", "10 times"});
  EXPECT_EQ(parse_scenario("[tilt]\nprogram = ['to 12', 'to 0 at 0.5', # down\n '10 times',\n]\n", "s.toml"),
            wanted);
  for (const char* setting :
       {"tilt.program=[\"to 12\", \"to 0 at 0.5\", \"10 times\"]",
        "tilt.program=to 12, to 0 at 0.5, 10 times", "tilt.program = to 12,to 0 at 0.5,10 times"})
    EXPECT_EQ(parse_scenario("", "s.toml", {setting}), wanted) << setting;
  EXPECT_EQ(parse_scenario("tilt.program = ['to 3']", "s.toml", {"tilt.program=none"}), Scenario{});
  EXPECT_EQ(plain_text(find_key("tilt.program")->get(wanted)), "to 12, to 0 at 0.5, 10 times");
  EXPECT_EQ(parse_scenario(resolved_toml(wanted), "resolved"), wanted);
}

TEST(TiltProgram, with_a_bad_phrase_is_refused_at_that_phrase) {
  const std::string forms = "expected " + program_phrase_forms();
  EXPECT_EQ(message_of("[tilt]\nprogram = [\"to 12\", \"too 5\",\n  \"hold 4000\", 7]\n"),
            "s.toml:2:21: error: key 'tilt.program' = \"too 5\": " + forms + "\n" +
                "s.toml:3:3: error: key 'tilt.program' = \"hold 4000\": " + forms + "\n" +
                "s.toml:3:16: error: key 'tilt.program' = 7: " + forms + ", found an integer");
  EXPECT_EQ(message_of("", {"tilt.program=to 12, 5"}),
            "--set tilt.program=to 12, 5: error: key 'tilt.program' = \"5\": " + forms);
}

TEST(TiltProgram, with_another_word_for_failure_is_told_that_it_ends_to_repose) {
  for (const char* text : {"to failure", "to the end", "to-repose", "To Repose", "repose", "to repose 3"})
    EXPECT_EQ(meant_phrase(text), "; did you mean 'to repose'?") << text;
  EXPECT_EQ(meant_phrase("Once"), "; did you mean 'once'?");
  for (const char* text : {"to", "to 61", "to -61", "to +61", "to 12deg", "by 0", "hold 3601", "0 times", ""})
    EXPECT_EQ(meant_phrase(text), "") << text;
  EXPECT_EQ(message_of("tilt.program = [\"to failure\"]"),
            "s.toml:1:17: error: key 'tilt.program' = \"to failure\": expected " + program_phrase_forms() +
                "; did you mean 'to repose'?");
}

TEST(TiltProgram, of_another_kind_is_refused) {
  const std::string expected =
      "expected a list of 1 ... 1000 phrases, each " + program_phrase_forms() + "; or \"none\"";
  EXPECT_EQ(message_of("tilt.program = 12"),
            "s.toml:1:16: error: key 'tilt.program' = 12: " + expected + ", found an integer");
  EXPECT_EQ(message_of("tilt.program = []"), "s.toml:1:16: error: key 'tilt.program': " + expected);
  EXPECT_EQ(message_of("tilt.program = 'non'"),
            "s.toml:1:16: error: key 'tilt.program' = \"non\": " + expected + "; did you mean 'none'?");
  EXPECT_NE(message_of("tilt.programm = ['to 3']").find("did you mean 'tilt.program'?"), std::string::npos);
}

TEST(TiltProgram, that_cannot_be_carried_out_is_refused_as_a_whole) {
  const auto fault = [](std::vector<std::string> program) { return program_fault(scenario_of(program)); };
  const std::string head = "a programme that can be carried out; this one ";
  EXPECT_EQ(fault({"to 12"}), "");
  EXPECT_EQ(fault({"10 times"}), head + "has nothing to repeat before \"10 times\"");
  EXPECT_EQ(fault({"to 3", "once", "2 times"}), head + "has nothing to repeat before \"2 times\"");
  EXPECT_EQ(fault({"to repose", "to 3"}),
            head + "continues after \"to repose\", which must be the last phrase");
  EXPECT_EQ(fault({"by 7", "9 times"}), head + "tilts to 63 deg, beyond 60 deg");
  EXPECT_EQ(fault({"by -7", "9 times"}), head + "tilts to -63 deg, beyond 60 deg");
  EXPECT_EQ(fault({"to 0"}), head + "neither tilts nor holds the bed for a step");
  std::vector<std::string> many;
  for (int k = 0; k < 11; ++k) many.insert(many.end(), {"to 1", "to 0", "10000 times"});
  EXPECT_EQ(fault(many), head + "has more than 100000 parts, repetitions included");
  EXPECT_EQ(fault({"by 6", "10 times"}), "") << "60 deg, except for rounding";
}

TEST(TiltProgram, and_an_end_angle_are_one_too_many) {
  EXPECT_EQ(message_of("[tilt]\nend_angle = 5\nprogram = ['to 3']"),
            "s.toml:3:11: error: key 'tilt.program' = [\"to 3\"]: expected no tilt.end_angle, because "
            "the programme determines the end of the run; it is 5 deg");
  EXPECT_EQ(message_of("[tilt]\nend_angle = 'repose'\nprogram = ['to 3']"), "");
}

}  // namespace
}  // namespace talus::scenario
