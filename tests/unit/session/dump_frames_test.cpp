/// Beds from other programs: LAMMPS, LIGGGHTS, YADE, extended XYZ.

#include "session/dump_frames.h"

#include <gtest/gtest.h>

#include <fmt/core.h>

#include "base/errors.h"
#include "session/bed_table.h"

namespace talus::session {
namespace {

BedTable bed_of(const std::string& text, int frame = 0) { return parse_bed_table(text, "d", {}, frame); }

std::string message_about(const std::string& text, int frame = 0) {
  try {
    bed_of(text, frame);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    return error.what();
  }
  return "accepted";
}

/// Formats grains as "x y radius", one after the other.
std::string grains_of(const BedTable& table) {
  std::string text;
  for (const TableGrain& grain : table.grains)
    text += fmt::format("{} {} {}, ", grain.x, grain.y, grain.radius);
  return text;
}

std::string snapshot(const std::string& columns, const std::string& rows, int atoms = 2, int step = 1000,
                     const std::string& bounds = "pp ff pp\n-1 9\n0 5\n-0.5 0.5\n") {
  return fmt::format("ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS {}ITEM: ATOMS {}\n{}",
                     step, atoms, bounds, columns, rows);
}

const std::string two = "2 1 3 1 0 0.6 0.1\n1 1 -0.5 2.5 0 0.5 0.2\n";

TEST(LammpsDump, has_its_grains_in_the_order_of_their_ids_and_its_box_at_zero) {
  const BedTable bed = bed_of(snapshot("id type x y z radius vx ", two));
  EXPECT_EQ(grains_of(bed), "0.5 2.5 0.5, 4 1 0.6, ");
  EXPECT_EQ(bed.period, 10.0);
  EXPECT_EQ(bed.remark, "ignored: type, vx");
  std::string crlf;
  for (const char c : snapshot("id type x y z radius vx", two))
    crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(grains_of(bed_of("\xef\xbb\xbf" + crlf)), grains_of(bed));
}

TEST(LammpsDump, may_be_scaled_or_unwrapped_and_have_diameters) {
  EXPECT_EQ(grains_of(bed_of(snapshot("xs ys diameter", "0.25 0.5 1\n0.5 0.1 1.2\n"))),
            "2.5 2.5 0.5, 5 0.5 0.6, ");
  EXPECT_EQ(grains_of(bed_of(snapshot("xu yu diameter", "19 0.5 1\n-3 1 1\n"))), "20 0.5 0.5, -2 1 0.5, ");
  EXPECT_EQ(grains_of(bed_of(snapshot("xu x y radius", "19 3 0.5 0.5\n-3 2 1 0.5\n"))),
            "4 0.5 0.5, 3 1 0.5, ");
  const std::string no_box =
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS xs ys radius\n0.1 0.1 0.5\n";
  EXPECT_EQ(message_about(no_box), "d:6:1: error: xs needs the box (ITEM: BOX BOUNDS)");
}

TEST(LammpsDump, has_frames) {
  const std::string text = "ITEM: UNITS\nsi\nITEM: TIME\n0.1\n" + snapshot("x y radius", "1 1 0.5\n", 1, 0) +
                           snapshot("x y radius", "2 1 0.5\n", 1, 500) + "\n";
  EXPECT_EQ(grains_of(bed_of(text)), "2 1 0.5, ");
  EXPECT_EQ(grains_of(bed_of(text, 1)), "3 1 0.5, ");
  EXPECT_EQ(bed_of(text, -1).remark, "frame 1 of 2 (timestep 500)");
  EXPECT_EQ(message_about(text, 2),
            "d: there is no frame 2: expected deposition.frame below 2, the number of its frames, or -1 for "
            "the last");
}

TEST(LammpsDump, may_name_its_units) {
  const std::string si = "ITEM: UNITS\nsi\n" + snapshot("x y radius", "1 1 0.5\n", 1);
  EXPECT_EQ(grains_of(parse_bed_table(si, "d", {scenario::LengthUnit::mean_diameter, 0.01})), "2 1 0.5, ");
  EXPECT_EQ(grains_of(parse_bed_table(si, "d", {scenario::LengthUnit::centimetre, 0.01})),
            "0.02 0.01 0.005, ");
}

TEST(LammpsDump, of_a_bed_in_x_and_z_is_taken_so) {
  const BedTable bed = bed_of(snapshot("id x y z radius", "1 1 0.2 1.5 0.5\n2 3 0.2 0.5 0.5\n"));
  EXPECT_EQ(grains_of(bed), "2 1.5 0.5, 4 0.5 0.5, ");
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
  EXPECT_EQ(message_about(snapshot("x y radius", "1 1 -0.5\n2 1 0.5\n")),
            "d:10:5: error: radius = -0.5: expected a finite number > 0, in mean diameters D");
  EXPECT_EQ(message_about(snapshot("x y radius", "1 nan 0.5\n2 1 0.5\n")),
            "d:10:3: error: y = \"nan\": expected a finite number, in mean diameters D");
  EXPECT_EQ(message_about(snapshot("x y radius", "1 1e999 0.5\n2 1 0.5\n")),
            "d:10:3: error: y = \"1e999\": expected a finite number, in mean diameters D");
  EXPECT_EQ(message_about(snapshot("x y radius", "1 1 0.5\n2 1\n")),
            "d:11:1: error: the line has 2 values: expected 3, one for each column that line 9 names");
  EXPECT_EQ(message_about(snapshot("x y radius", "1 1 0.5\n\n")),
            "d:11:1: error: the line is empty: expected grain 2 of 2");
  EXPECT_NE(message_about(snapshot("id x y", "1 1 1\n2 2 2\n"))
                .find("d:9:13: error: the columns are named \"id\", \"x\", \"y\", no column for the size"),
            std::string::npos);
  EXPECT_EQ(message_about("ITEM: TIMESTEP\n1\nITEM: NUMBER OF ATOMS\n1e99\n"),
            "d:4:1: error: \"1e99\": expected the number of atoms");
  EXPECT_EQ(message_about("ITEM: TIMESTEP\n7\n"),
            "d: frame 0 of 1 (timestep 7) is cut off: expected a line such as ITEM: ATOMS id x y radius");
  EXPECT_EQ(message_about("ITEM: TIMESTEP\n1\nhello\n"),
            "d:3:1: error: \"hello\": expected a line that starts with ITEM:, as in a dump of LAMMPS");
  for (const char* bounds :
       {"xy xz yz pp pp pp\n0 9 1\n0 5 0\n0 1 0\n", "pp pp pp\n9 0\n0 5\n0 1\n", "pp pp pp\n0\n"})
    EXPECT_NE(message_about(snapshot("x y radius", "1 1 1\n", 1, 0, bounds)).find(":6:1: error: "),
              std::string::npos)
        << bounds;
}

TEST(ExtendedXyz, has_positions_and_radii) {
  const std::string text =
      "2\nLattice=\"10 0 0 0 5 0 0 0 1\" Origin=\"-1 0 0\" "
      "Properties=species:S:1:pos:R:3:velo:R:3:radius:R:1 "
      "pbc=\"T F F\"\nX 1 2 0 9 9 9 0.5\nX 4 1 0 9 9 9 0.6\n"
      "1\nProperties=species:S:1:pos:R:3:radii:R:1\nX 7 1 0 0.5\n";
  EXPECT_EQ(grains_of(bed_of(text)), "2 2 0.5, 5 1 0.6, ");
  EXPECT_EQ(bed_of(text).period, 10.0);
  EXPECT_EQ(bed_of(text).remark, "frame 0 of 2; ignored: species, velo.1, velo.2, velo.3");
  EXPECT_EQ(grains_of(bed_of(text, -1)), "7 1 0.5, ");
  EXPECT_EQ(bed_of(text, -1).period, std::nullopt);
  EXPECT_EQ(message_about("1\nLattice=\"1\" Properties=pos:R:3\n1 1 0\n").substr(0, 12), "d:2:1: error");
  EXPECT_EQ(message_about("1\nLattice=\"1\" time=3\nX 1 1 0\n"),
            "d:2:1: error: \"Lattice=\"1\" time=3\": expected Properties=, such as "
            "Properties=species:S:1:pos:R:3:radius:R:1 of extended XYZ");
  EXPECT_EQ(message_about("1\nProperties=pos:R:3:radius:R:1\n1 1 0 0.5\ntwo\n"),
            "d:4:1: error: \"two\": expected the number of atoms of the next frame, as in extended XYZ");
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

TEST(BedTable, is_scaled) {
  const auto scaled = parse_bed_table("1 2 0.5\n", "d", {scenario::LengthUnit::mean_diameter, 0.01, 2.0});
  EXPECT_EQ(grains_of(scaled), "0.02 0.04 0.01, ");
}

}  // namespace
}  // namespace talus::session
