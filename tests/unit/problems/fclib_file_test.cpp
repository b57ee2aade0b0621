/// Problem files: reading returns what was written, invalid parts are named, and the page documents the data
/// sets.

#include "problems/fclib_file.h"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "base/errors.h"
#include "problems/fclib_schema.h"
#include "support/places.h"
#include "unit/io/example_run.h"

namespace talus::problems {
namespace {

/// Returns two contacts, with W not symmetric, a guess, and without data sets specific to Talus.
FclibProblem example() {
  FclibProblem problem;
  problem.title = "two contacts";
  problem.row = {0, 0, 2, 3};
  problem.column = {0, 3, 2, 3};
  problem.value = {2.0, 6.0, 3.0, 9.0};
  problem.q = {-1.0, 0.5, -0.25, 0.0};
  problem.mu = {0.5, 0.3};
  problem.guess_r = {0.5, -0.125, 0.0625, 0.0};
  return problem;
}

FclibProblem with_bodies() {
  FclibProblem problem = example();
  for (const io::DataSetField& field : fclib_schema())
    if (field.path.starts_with("/talus/")) {
      const std::size_t size = field.shape == "B" ? 3 : field.shape == "C" ? 2 : 1;
      if (field.type == io::ElementType::int32)
        problem.integers[field.path].assign(size, field.path.ends_with("/b") ? 2 : 0);
      else
        problem.reals[field.path].assign(size, 0.1 + static_cast<double>(problem.reals.size()));
    }
  return problem;
}

const std::vector<double> guess_u = {0.0, 1.0, 2.0, 3.0};

/// Expects reading the problem to fail with bad_data and exactly this message after the name of the file.
void expect_refused(const FclibProblem& problem, const std::string& message) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path("bad.h5");
  write_fclib(path, problem, guess_u);
  try {
    read_fclib(path);
    ADD_FAILURE() << "not detected: " << message;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    EXPECT_EQ(error.what(), path + ": data set " + message);
  }
}

TEST(FclibFile, is_read_back_as_written) {
  const test::TemporaryFolder folder;
  const FclibProblem problem = with_bodies();
  write_fclib(folder.path("p.h5"), problem, guess_u);
  const FclibProblem read = read_fclib(folder.path("p.h5"));
  EXPECT_EQ(read.row, problem.row);
  EXPECT_EQ(read.column, problem.column);
  EXPECT_EQ(read.value, problem.value);
  EXPECT_EQ(read.q, problem.q);
  EXPECT_EQ(read.mu, problem.mu);
  EXPECT_EQ(read.guess_r, problem.guess_r);
  EXPECT_EQ(read.reals, problem.reals);
  EXPECT_EQ(read.integers, problem.integers);
  EXPECT_FALSE(std::filesystem::exists(folder.path("p.h5.tmp")));
}

TEST(FclibFile, equal_problems_have_equal_bytes) {
  const test::TemporaryFolder folder;
  write_fclib(folder.path("one.h5"), with_bodies(), guess_u);
  write_fclib(folder.path("two.h5"), with_bodies(), guess_u);
  EXPECT_EQ(example::file_text(folder.path("one.h5")), example::file_text(folder.path("two.h5")));
}

TEST(FclibFile, a_solution_changes_nothing_else) {
  const test::TemporaryFolder folder;
  write_fclib(folder.path("p.h5"), with_bodies(), guess_u);
  write_fclib_solution(folder.path("p.h5"), folder.path("s.h5"), {1, 2, 3, 4}, {5, 6, 7, 8});
  write_fclib_solution(folder.path("s.h5"), folder.path("s.h5"), {4, 3, 2, 1},
                       {8, 7, 6, 5});  // replaces the file
  const FclibProblem read = read_fclib(folder.path("s.h5"));
  EXPECT_EQ(read.value, example().value);
  EXPECT_EQ(read.guess_r, example().guess_r);
  EXPECT_EQ(read.reals, with_bodies().reals);
}

TEST(FclibFile, of_no_contacts_is_a_problem_too) {
  const test::TemporaryFolder folder;
  write_fclib(folder.path("p.h5"), {}, {});
  EXPECT_TRUE(read_fclib(folder.path("p.h5")).mu.empty());
}

TEST(FclibFile, values_that_cannot_be_are_refused) {
  FclibProblem problem = example();
  problem.mu[1] = -0.25;
  expect_refused(problem, "/fclib_local/vectors/mu holds the negative value -0.25 at index 1");
  problem = example();
  problem.q[2] = std::numeric_limits<double>::quiet_NaN();
  expect_refused(problem, "/fclib_local/vectors/q holds a value that is not finite, at index 2");
  problem = example();
  problem.value[3] = std::numeric_limits<double>::infinity();
  expect_refused(problem, "/fclib_local/W/x holds a value that is not finite, at index 3");
  problem = example();
  problem.value[2] = -3.0;
  expect_refused(problem, "/fclib_local/W/x has the negative value -3 on the diagonal of W, in row 2");
  problem = example();
  problem.column[1] = 4;
  expect_refused(problem, "/fclib_local/W/i holds 4 at index 1, expected 0 to 3");
  problem = with_bodies();
  problem.integers["/talus/contacts/b"][0] = 3;
  expect_refused(problem, "/talus/contacts/b holds 3 at index 0, expected 0 to 2");
}

TEST(FclibFile, sizes_that_do_not_fit_are_refused) {
  FclibProblem problem = example();
  problem.mu.pop_back();
  expect_refused(problem,
                 "/fclib_local/vectors/q has 4 values, expected 2, two for each contact of "
                 "/fclib_local/vectors/mu");
  problem = example();
  problem.column.pop_back();
  expect_refused(problem,
                 "/fclib_local/W/i has 3 values, expected 4, one for each value of /fclib_local/W/x");
  problem = example();
  problem.row.pop_back();
  expect_refused(problem, "/fclib_local/W/p goes from 0 to 3, expected 0 to 4, the entries of W");
  problem = example();
  problem.guess_r.pop_back();
  expect_refused(problem,
                 "/guesses/1/r has 3 values, expected 4, two for each contact of /fclib_local/vectors/mu");
  problem = with_bodies();
  problem.reals["/talus/bodies/lever"].pop_back();
  expect_refused(problem,
                 "/talus/bodies/lever has 2 values, expected 3, one for each body of /talus/bodies/vx");
  problem = with_bodies();
  problem.reals.erase("/talus/contacts/nx");
  expect_refused(problem, "/talus/contacts/nx is missing");
}

TEST(FclibFile, what_is_no_hdf5_is_refused) {
  const test::TemporaryFolder folder;
  for (const char* text : {"", "no HDF5", "\x89HDF\r\n\x1a\n and so on"}) {
    example::write_text(folder.path("p.h5"), text);
    EXPECT_THROW(read_fclib(folder.path("p.h5")), Error) << text;
  }
  try {
    read_fclib(folder.path("none.h5"));
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::missing_input);
  }
}

TEST(FclibFile, is_documented_as_it_is) {
  std::ostringstream expected;
  for (const io::DataSetField& field : fclib_schema())
    expected << "| `" << field.path << "` | " << io::type_name(field.type) << " | "
             << (field.shape.empty() ? "-" : field.shape) << " | " << field.unit << " | " << field.help
             << " |\n";
  std::string found;
  std::istringstream page(example::file_text(test::source_folder() + "/docs/problem_files.md"));
  for (std::string line; std::getline(page, line);)
    if (line.starts_with("| `/")) found += line + "\n";
  EXPECT_EQ(found, expected.str()) << "the table of docs/problem_files.md must be:\n" << expected.str();
}

}  // namespace
}  // namespace talus::problems
