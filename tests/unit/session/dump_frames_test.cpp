/// Beds from other programs: LAMMPS, LIGGGHTS, YADE, extended XYZ.

#include <gtest/gtest.h>

#include <fmt/core.h>

#include "base/errors.h"
#include "session/bed_table.h"
#include "support/exit_code.h"
#include "support/has.h"

namespace talus::session {
namespace {

BedTable bed_of(const std::string& text, int frame = 0) { return parse_bed_table(text, "d", {}, frame); }

std::string message_about(const std::string& text, int frame = 0) {
  return test::message_of([&] { bed_of(text, frame); });
}

/// Formats grains as "x y radius", one after the other.
std::string grains_of(const BedTable& table) {
  std::string text;
  for (const TableGrain& grain : table.grains)
    text += fmt::format("{} {} {}, ", grain.x, grain.y, grain.radius);
  return text;
}

/// Returns the flags and the bounds of the box along x; "none" without a box.
std::string box_of(const BedTable& table) {
  if (!table.box) return "none";
  const std::optional<bool> periodic = table.box->is_periodic;
  return fmt::format("{} {} {}",
                     !periodic   ? "unknown"
                     : *periodic ? "periodic"
                                 : "fixed",
                     table.box->low, table.box->high);
}

std::string snapshot(const std::string& columns, const std::string& rows, int atoms = 2, int step = 1000,
                     const std::string& bounds = "pp ff pp\n-1 9\n0 5\n-0.5 0.5\n") {
  return fmt::format("ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS {}ITEM: ATOMS {}\n{}",
                     step, atoms, bounds, columns, rows);
}

const std::string two = "2 1 3 1 0 0.6 0.1\n1 1 -0.5 2.5 0 0.5 0.2\n";

TEST(LammpsDump, has_its_grains_in_the_order_of_their_ids_and_its_box) {
  const BedTable bed = bed_of(snapshot("id type x y z radius vx ", two));
  EXPECT_EQ(grains_of(bed), "-0.5 2.5 0.5, 3 1 0.6, ");
  EXPECT_EQ(box_of(bed), "periodic -1 9");
  EXPECT_EQ(bed.remark, "ignored: type, vx");
  std::string crlf;
  for (const char c : snapshot("id type x y z radius vx", two))
    crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(grains_of(bed_of("\xef\xbb\xbf" + crlf)), grains_of(bed));
}

TEST(LammpsDump, may_be_scaled_or_unwrapped_and_have_diameters) {
  EXPECT_EQ(grains_of(bed_of(snapshot("xs ys diameter", "0.25 0.5 1\n0.5 0.1 1.2\n"))),
            "1.5 2.5 0.5, 4 0.5 0.6, ");
  EXPECT_EQ(grains_of(bed_of(snapshot("xu yu diameter", "19 0.5 1\n-3 1 1\n"))), "19 0.5 0.5, -3 1 0.5, ");
  EXPECT_EQ(grains_of(bed_of(snapshot("xu x y radius", "19 3 0.5 0.5\n-3 2 1 0.5\n"))),
            "3 0.5 0.5, 2 1 0.5, ");
  const std::string no_box =
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS xs ys radius\n0.1 0.1 0.5\n";
  EXPECT_EQ(message_about(no_box), "d:6:1: error: xs needs the box (ITEM: BOX BOUNDS)");
}

TEST(LammpsDump, has_frames) {
  const std::string text = "ITEM: UNITS\nsi\nITEM: TIME\n0.1\n" + snapshot("x y radius", "1 1 0.5\n", 1, 0) +
                           snapshot("x y radius", "2 1 0.5\n", 1, 500) + "\n";
  EXPECT_EQ(grains_of(bed_of(text)), "1 1 0.5, ");
  EXPECT_EQ(grains_of(bed_of(text, 1)), "2 1 0.5, ");
  EXPECT_EQ(bed_of(text, -1).remark, "frame 1 of 2 (timestep 500)");
  EXPECT_EQ(message_about(text, 2),
            "d: there is no frame 2: expected deposition.frame below 2, the number of its frames, or -1 for "
            "the last");
}

TEST(LammpsDump, may_name_its_units) {
  const std::string si = "ITEM: UNITS\nsi\n" + snapshot("x y radius", "1 1 0.5\n", 1);
  EXPECT_EQ(grains_of(parse_bed_table(si, "d", {scenario::LengthUnit::mean_diameter, 0.01})), "1 1 0.5, ");
  EXPECT_EQ(grains_of(parse_bed_table(si, "d", {scenario::LengthUnit::centimetre, 0.01})),
            "0.01 0.01 0.005, ");
  const auto in_units = [](const std::string& units) {
    return "ITEM: UNITS\n" + units + "\n" + snapshot("x y radius", "1 1 0.5\n", 1);
  };
  std::string after_head = si.substr(si.find('\n') + 4);
  after_head.insert(after_head.find("1000\n") + 5, "ITEM: UNITS\ncgs\nITEM: TIME\n0.1\n");
  for (const std::string& text : {after_head, after_head + snapshot("x y radius", "1 1 0.5\n", 1, 2000)}) {
    const BedTable bed = parse_bed_table(text, "d", {scenario::LengthUnit::mean_diameter, 0.01}, -1);
    EXPECT_EQ(grains_of(bed), "0.01 0.01 0.005, ") << text;
  }
  EXPECT_FALSE(test::has(bed_of(after_head).remark, "frame")) << "one frame";
  EXPECT_EQ(grains_of(bed_of(in_units("lj"))), "1 1 0.5, ");
  EXPECT_EQ(bed_of(in_units("lj")).remark, "its units lj taken as mean diameters D");
  EXPECT_EQ(
      message_about(in_units("real")),
      "d: ITEM: UNITS names real (lengths in angstrom, file_scale = 1e-4 in um): expected si, cgs, micro or "
      "lj (D); set deposition.file_unit and deposition.file_scale for others");
  for (const char* units : {"metal", "electron", "nano", "furlong", "REAL"})
    EXPECT_TRUE(test::has(message_about(in_units(units)), units));
  const LengthRule angstrom = {scenario::LengthUnit::micrometre, 1e-10, 1e-4};
  EXPECT_NEAR(parse_bed_table(in_units("real"), "d", angstrom).grains[0].x, 1e-10, 1e-20)
      << "as the scenario says";
}

TEST(LammpsDump, has_the_flags_of_its_box_along_x) {
  const auto box = [](const std::string& flags) {
    return box_of(bed_of(snapshot("x y radius", "1 1 0.5\n", 1, 0, flags + "\n0 10\n0 5\n-1 1\n")));
  };
  EXPECT_EQ(box("pp ff pp"), "periodic 0 10");
  EXPECT_EQ(box("ff pp pp"), "fixed 0 10");
  EXPECT_EQ(box("ff pp"), "fixed 0 10") << "two flags";
  EXPECT_EQ(box("pp ff"), "periodic 0 10");
  EXPECT_EQ(box("ss pp pp"), "fixed 0 10");
  EXPECT_EQ(box("fs ff pp"), "fixed 0 10");
  EXPECT_EQ(box(""), "unknown 0 10");
  EXPECT_EQ(box("xy xz yz pp pp pp"), "periodic 0 10");
  EXPECT_EQ(box("xy xz yz ff pp pp"), "fixed 0 10");
}

/// Text of two frames of one and two grains, at t = 0 and t = 100.
std::string two_frames() {
  return snapshot("id x y radius", "1 1 1 0.5\n", 1, 0) +
         snapshot("id x y radius", "1 2 1 0.5\n2 4 1 0.6\n", 2, 100);
}

// A job that was killed while it wrote.
TEST(LammpsDump, that_is_cut_off_anywhere_in_its_last_frame_loses_only_that) {
  const std::string whole = two_frames(), first = snapshot("id x y radius", "1 1 1 0.5\n", 1, 0);
  for (std::size_t size = first.size() + 1; size + 1 < whole.size(); ++size) {
    const std::string cut = whole.substr(0, size);
    ASSERT_EQ(grains_of(bed_of(cut)), "1 1 0.5, ") << cut.substr(first.size());
    const std::string last = message_about(cut, -1);
    if (size < whole.size() - 4) {  // the last number has all of its digits but one
      ASSERT_TRUE(test::has(last, "cut off")) << cut.substr(first.size());
    }
  }
  EXPECT_EQ(
      message_about(first + "ITEM: TIMESTEP\n100\nITEM: NUMBER OF ATOMS\n", -1),
      "d: frame 1 of 2 (timestep 100) is cut off: expected a line such as ITEM: ATOMS id x y radius, or the "
      "second line of extended XYZ; an earlier deposition.frame may be whole");
  EXPECT_EQ(grains_of(bed_of(first + "ITEM: TIME\n0.3\n")), "1 1 0.5, ");
  EXPECT_TRUE(test::has(message_about(first + "ITEM: TIME\n0.3\n", -1), "is cut off"));
}

TEST(LammpsDump, whose_other_frames_are_damaged_is_read) {
  const std::string good = snapshot("id x y radius", "1 7 1 0.5\n", 1, 5);
  const std::vector<std::pair<std::string, std::string>> damaged = {
      {"ITEM: TIMESTEP\n1\nITEM: NUMBER OF ATOMS\nmany\nITEM: BOX BOUNDS pp ff pp\n0 9\n0 5\n0 1\n"
       "ITEM: ATOMS x y radius\n1 1 0.5\n",
       ":4:1: error: \"many\": expected the number of atoms"},
      {snapshot("x y radius", "1 1 0.5\n", 1, 1, "pp ff pp\n0 nan\n0 5\n0 1\n"), ":6:1: error: \"0 nan\""},
      {snapshot("x y radius", "1 1 0.5\n", 1, 1, "xy xz yz pp ff pp\n0 9 2\n0 5 0\n0 1 0\n"),
       ":6:1: error: "},
      {snapshot("x y radius", "1 1 0.5\n", 2, 1), ":10:1: error: the frame ends after 1 of its 2 grains"},
      {snapshot("x y radius", "1 1 0.5\n2 1 0.5\n", 1, 1), ":11:1: error: \"2 1 0.5\""},
      {snapshot("x y radius", "1 1 -1\n", 1, 1), ":10:5: error: radius = -1"},
      {snapshot("x y", "1 1\n", 1, 1), "no column for the size"},
      {"ITEM: TIMESTEP\n1\nhello\n", ":3:1: error: \"hello\": expected a line that starts with ITEM:"},
      {"ITEM: TIMESTEP\n1\n", " (timestep 1) is cut off"}};
  for (const auto& [bad, fault] : damaged) {
    EXPECT_EQ(grains_of(bed_of(bad + good, 1)), "7 1 0.5, ") << bad;
    EXPECT_EQ(grains_of(bed_of(good + bad)), "7 1 0.5, ") << bad;
    EXPECT_EQ(grains_of(bed_of(bad + good + bad, 1)), "7 1 0.5, ") << bad;
    EXPECT_TRUE(test::has(message_about(bad + good), fault));
  }
  // The first frame was cut off, and a new job continued the same line.
  const std::string glued = snapshot("id x y radius", "1 7 1 0.5\n2 9 1", 2, 5) + two_frames();
  EXPECT_TRUE(test::has(message_about(glued), "error: "));
  EXPECT_EQ(grains_of(bed_of(glued, -1)), "2 1 0.5, 4 1 0.6, ");
}

TEST(LammpsDump, may_have_comments) {
  const std::string text = "# made by a script\n" +
                           snapshot("id x y radius", "1 1 1 0.5\n# restarted\n\t#\n2 4 1 0.6\n") + "# end\n" +
                           snapshot("id x y radius", "1 2 1 0.5\n#\n", 1) + "# no more\n";
  EXPECT_EQ(grains_of(bed_of(text.substr(text.find('\n') + 1))), "1 1 0.5, 4 1 0.6, ");
  EXPECT_EQ(grains_of(bed_of(text)), "1 1 0.5, 4 1 0.6, ");
  EXPECT_EQ(grains_of(bed_of(text, 1)), "2 1 0.5, ");
  EXPECT_EQ(bed_of(text, -1).remark, "frame 1 of 2 (timestep 1000)");
  EXPECT_EQ(message_about(snapshot("id x y radius", "1 1 1 0.5\n#\n2 4 1 -1\n")),
            "d:12:7: error: radius = -1: expected a finite number > 0, in mean diameters D");
}

TEST(LammpsDump, of_a_bed_in_x_and_z_is_taken_so) {
  const BedTable bed = bed_of(snapshot("id x y z radius", "1 1 0.2 1.5 0.5\n2 3 0.2 0.5 0.5\n"));
  EXPECT_EQ(grains_of(bed), "1 1.5 0.5, 3 0.5 0.5, ");
  EXPECT_EQ(bed.remark, "x and z are the plane, because y is the same for all");
  EXPECT_EQ(message_about(snapshot("id x y z radius", "1 1 0.2 1.5 0.5\n2 3 0.3 0.5 0.5\n")),
            "d:11:1: error: this grain differs from others in both y and z: expected a bed of disks, with "
            "the same z (or the same y) for all; a section of a pile of spheres is not one");
}

TEST(LammpsDump, that_is_wrong_is_refused_at_its_line) {
  EXPECT_EQ(message_about(snapshot("id x y radius", "1 1 1 0.5\n", 2)),
            "d:10:1: error: the frame ends after 1 of its 2 grains: the file is cut off; expected the rest, "
            "or an earlier deposition.frame");
  EXPECT_EQ(message_about(snapshot("id x y radius", "1 1 1 0.5\n1 3 1 0.5\n")),
            "d:11:1: error: grain 1 is also in line 10: expected each id once");
  EXPECT_EQ(message_about(snapshot("x y radius", "1 nan 0.5\n2 1 0.5\n")),
            "d:10:3: error: y = \"nan\": expected a finite number, in mean diameters D");
  EXPECT_EQ(message_about(snapshot("x y radius", "1 1 0.5\n2 1\n")),
            "d:11:1: error: the line has 2 values: expected 3, one for each column that line 9 names");
  EXPECT_EQ(message_about(snapshot("x y radius", "1 1 0.5\n\n")),
            "d:11:1: error: the line is empty: expected grain 2 of 2");
  EXPECT_TRUE(test::has(message_about(snapshot("id x y", "1 1 1\n2 2 2\n")),
                        "d:9:13: error: the columns are named \"id\", \"x\", \"y\", no column for the size"));
  EXPECT_EQ(message_about("ITEM: TIMESTEP\n1\nITEM: NUMBER OF ATOMS\n1e99\n"),
            "d:4:1: error: \"1e99\": expected the number of atoms");
  EXPECT_EQ(message_about("ITEM: TIMESTEP\n1\nhello\n"),
            "d:3:1: error: \"hello\": expected a line that starts with ITEM:, as in a dump of LAMMPS");
  for (const char* bounds :
       {"xy xz yz pp pp pp\n0 9 1\n0 5 0\n0 1 0\n", "pp pp pp\n9 0\n0 5\n0 1\n", "pp pp pp\n0\n"})
    EXPECT_TRUE(test::has(message_about(snapshot("x y radius", "1 1 1\n", 1, 0, bounds)), ":6:1: error: "))
        << bounds;
}

TEST(ExtendedXyz, has_positions_and_radii) {
  const std::string text =
      "2\nLattice=\"10 0 0 0 5 0 0 0 1\" Origin=\"-1 0 0\" "
      "Properties=species:S:1:pos:R:3:velo:R:3:radius:R:1 "
      "pbc=\"T F F\"\nX 1 2 0 9 9 9 0.5\nX 4 1 0 9 9 9 0.6\n"
      "1\nProperties=species:S:1:pos:R:3:radii:R:1\nX 7 1 0 0.5\n";
  EXPECT_EQ(grains_of(bed_of(text)), "1 2 0.5, 4 1 0.6, ");
  EXPECT_EQ(box_of(bed_of(text)), "periodic -1 9");
  EXPECT_EQ(bed_of(text).remark, "frame 0 of 2; ignored: species, velo.1, velo.2, velo.3");
  EXPECT_EQ(grains_of(bed_of(text, -1)), "7 1 0.5, ");
  EXPECT_EQ(box_of(bed_of(text, -1)), "none");
  EXPECT_EQ(message_about("1\nLattice=\"1\" Properties=pos:R:3\n1 1 0\n").substr(0, 12), "d:2:1: error");
  EXPECT_EQ(message_about("1\nLattice=\"1\" time=3\nX 1 1 0\n"),
            "d:2:1: error: \"Lattice=\"1\" time=3\": expected Properties=, such as "
            "Properties=species:S:1:pos:R:3:radius:R:1 of extended XYZ");
  EXPECT_EQ(message_about("1\nProperties=pos:R:3:radius:R:1\n1 1 0 0.5\ntwo\n"),
            "d:4:1: error: \"two\": expected the number of atoms of the next frame, as in extended XYZ");
}

std::string xyz(const std::string& entries, double x, int atoms = 1) {
  return fmt::format("{}\n{} Properties=pos:R:3:radius:R:1\n{} 1 0 0.5\n", atoms, entries, x);
}

TEST(ExtendedXyz, has_a_box_that_can_be_used_or_is_refused) {
  EXPECT_EQ(box_of(bed_of(xyz("Lattice=\"10 0 0 0 5 0 0 0 1\"", 1))), "unknown 0 10");
  EXPECT_EQ(box_of(bed_of(xyz("Lattice=\"10 0 0 0 5 0 0 0 1\" pbc=\"F T F\"", 1))), "fixed 0 10");
  EXPECT_EQ(box_of(bed_of(xyz("Lattice=\"10 0 0 0 5 0 0 0 1\" pbc=\"1 0 0\" Original=2", 1))),
            "periodic 0 10");
  for (const char* bad :
       {"Lattice=\"nan 0 0 0 5 0 0 0 1\"", "Lattice=\"10 0 0 0 5 0 0\"", "Lattice=\"\"",
        "Lattice=\"0 0 0 0 5 0 0 0 1\"", "Lattice=\"-9 0 0 0 5 0 0 0 1\"", "Lattice=\"10 0 2 0 5 0 0 0 1\"",
        "Lattice=\"10 0 0 0 5 0 0 0 1\" Origin=\"inf 0 0\"", "Lattice=\"10 0 0 0 5 0 0 0 1\" pbc=\"maybe\""})
    EXPECT_TRUE(test::has(message_about(xyz(bad, 1)), "d:2:1: error: ")) << bad;
}

TEST(ExtendedXyz, whose_other_frames_are_damaged_is_read) {
  const std::string good = xyz("", 7);
  const std::vector<std::pair<std::string, std::string>> damaged = {
      {xyz("Lattice=\"nan\"", 1), ":2:1: error: "},
      {"1\nno properties\n1 1 0 0.5\n", ":2:1: error: \"no properties\": expected Properties="},
      {xyz("", 1, 3), "the frame ends after 1 of its 3 grains"},
      {xyz("", 1) + "2 1 0 0.5\n", ":4:1: error: \"2 1 0 0.5\": expected the number of atoms"},
      {xyz("", 1) + "# 3\n2 1 0 0.5\n", ":5:1: error: \"2 1 0 0.5\": expected the number of atoms"},
      {"1\nProperties=pos:R:3:radius:R:1\n1 1 0 -2\n", ":3:7: error: radius = -2"}};
  for (const auto& [bad, fault] : damaged) {
    EXPECT_EQ(grains_of(bed_of(good + bad)), "7 1 0.5, ") << bad;
    EXPECT_EQ(grains_of(bed_of(good + bad + good, 2)), "7 1 0.5, ") << bad;
    const std::string message = message_about(good + bad + good, 1);
    const std::size_t colon = fault.find(':') == 0 ? 0 : std::string::npos;
    const std::string place = colon == 0 ? fmt::format("d:{}", std::stoi(fault.substr(1)) + 3) : "";
    EXPECT_NE(message.find(place + (colon == 0 ? fault.substr(fault.find(':', 1)) : fault)),
              std::string::npos)
        << message;
  }
  EXPECT_EQ(grains_of(bed_of(good + "3x\nProperties=pos:R:3:radius:R:1\n1 1 0 0.5\n" + good, 2)),
            "7 1 0.5, ");
  for (const char* cut :
       {"1", "12\n", "1\nProperties=pos:R:3:rad", "1\nProperties=pos:R:3:radius:R:1\n",
        "2\nProperties=pos:R:3:radius:R:1\n1 1 0 0.5\n", "1\nProperties=pos:R:3:radius:R:1\n1 1"}) {
    EXPECT_EQ(grains_of(bed_of(good + cut)), "7 1 0.5, ") << cut;
    EXPECT_TRUE(test::has(message_about(good + cut, -1), "cut off"));
  }
}

TEST(YadeText, has_the_columns_of_its_format) {
  EXPECT_EQ(grains_of(bed_of("#format x_y_z_r\n1\t2\t0\t0.5\n4\t1\t0\t0.6\n")), "1 2 0.5, 4 1 0.6, ");
  const BedTable bed = bed_of("#format x_y_z_r_matId\n# made today\n1\t0\t2\t0.5\t0\n4\t0\t1\t0.6\t0\n");
  EXPECT_EQ(grains_of(bed), "1 2 0.5, 4 1 0.6, ");
  EXPECT_EQ(bed.remark, "x and z are the plane, because y is the same for all; ignored: matId");
  EXPECT_EQ(grains_of(bed_of("#format x_y_z_r_attrs\n# x y z r speed\n1 2 0 0.5 7\n")), "1 2 0.5, ");
}

/// For any truncation or change, the reader returns grains or a message.
TEST(Dumps, that_are_damaged_end_in_a_message_or_in_grains) {
  const std::string texts[] = {
      "ITEM: UNITS\nsi\n" + snapshot("id xs y zu radius", "1 0.1 1 1 0.5\n2 0.3 2 1 0.5\n") +
          snapshot("id x y radius", "2 1 1 0.5\n1 3 1 0.5\n"),
      "1\nLattice=\"10 0 0 0 5 0 0 0 1\" pbc=\"T\" Properties=s:S:1:pos:R:3:radius:R:1\nX 1 2 0 0.5\n",
      "#format x_y_z_r_matId\n1\t0\t2\t0.5\t0\n4\t0\t1\t0.6\t0\n", "frame,x,y,r\n0,1,2,0.5\n1,1,2,0.5\n"};
  const std::string bytes = std::string("\0\n\r\t \"#9-:e,;=\xff", 16) + "[";
  std::size_t read = 0, refused = 0;
  const auto parse_without_crash = [&](const std::string& text) {
    for (const int frame : {0, 1, -1}) try {
        for (const TableGrain& grain : bed_of(text, frame).grains) EXPECT_GT(grain.radius, 0.0);
        ++read;
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_data);
        ++refused;
      }
  };
  for (const std::string& text : texts)
    for (std::size_t k = 0; k < text.size(); ++k) {
      parse_without_crash(text.substr(0, k));
      parse_without_crash(text.substr(k));
      for (const char byte : bytes) {
        std::string changed = text;
        changed[k] = byte;
        parse_without_crash(changed);
      }
    }
  EXPECT_GT(read, 1000u);
  EXPECT_GT(refused, 1000u);
}

TEST(TableOfFrames, is_divided_by_its_column_frame) {
  const std::string text = "frame,id,x (m),y (m),radius (m)\n3,0,1,2,0.5\n4,0,1,1,0.5\n4,1,3,1,0.5\n";
  EXPECT_EQ(grains_of(bed_of(text)), "1 2 0.5, ");
  EXPECT_EQ(grains_of(bed_of(text, -1)), "1 1 0.5, 3 1 0.5, ");
  EXPECT_EQ(bed_of(text, 1).remark, "frame 1 of 2");
}

// As pandas writes it after a sort by grain.
TEST(TableOfFrames, may_be_sorted_by_grain) {
  const std::string text =
      "frame,id,x,y,radius\n10,0,1,2,0.5\n20,0,1,1,0.5\n30,0,1,0.5,0.5\n20,1,3,1,0.5\n30,1,3,0.6,0.5\n";
  EXPECT_EQ(grains_of(bed_of(text)), "1 2 0.5, ");
  EXPECT_EQ(grains_of(bed_of(text, 1)), "1 1 0.5, 3 1 0.5, ");
  EXPECT_EQ(grains_of(bed_of(text, -1)), "1 0.5 0.5, 3 0.6 0.5, ");
  EXPECT_EQ(bed_of(text, 2).remark, "frame 2 of 3");
  EXPECT_TRUE(test::has(message_about(text, 3), "there is no frame 3: expected deposition.frame below 3"));
}

TEST(TableOfFrames, whose_other_frames_are_damaged_is_read) {
  const std::string head = "frame,x,y,radius\n", good = "1,7,1,0.5\n";
  const std::pair<const char*, const char*> damaged[] = {
      {"0,1,1,-1\n", ":2:7: error: radius"},
      {"0,1\n", ":2:1: error: the line has 2 values"},
      {"0,1,x,0.5\n", ":2:5: error: y = \"x\""},
      {"0,2,1,0.5\n?,3,1,0.5\n", ":3:1: error: frame = \"?\""}};
  for (const auto& [bad, fault] : damaged) {
    EXPECT_EQ(grains_of(bed_of(head + bad + good, 1)), "7 1 0.5, ") << bad;
    EXPECT_EQ(bed_of(head + bad + good, -1).remark, "frame 1 of 2") << bad;
    EXPECT_TRUE(test::has(message_about(head + bad + good), fault));
  }
  EXPECT_EQ(grains_of(bed_of(head + good + "2,4,1,0.\n2,5,")), "7 1 0.5, ") << "cut off";
}

TEST(BedTable, is_scaled) {
  const auto scaled = parse_bed_table("1 2 0.5\n", "d", {scenario::LengthUnit::mean_diameter, 0.01, 2.0});
  EXPECT_EQ(grains_of(scaled), "0.02 0.04 0.01, ");
}

}  // namespace
}  // namespace talus::session
