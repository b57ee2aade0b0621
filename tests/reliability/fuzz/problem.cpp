/// Any bytes that a child process may send for a problem file that HDF5 misread: decoded, checked, solved.

#include <cstdint>
#include <cstdlib>
#include <span>

#include "base/errors.h"
#include "io/child_process.h"
#include "problems/fclib_file.h"
#include "reliability/hostile_run.h"

using namespace talus;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const io::Parcels file = io::decode(std::as_bytes(std::span(data, size)), "p.h5");
    hostile::use_problem(problems::stored_problem("p.h5", problems::checked_problem("p.h5", file)));
  } catch (const Error& error) {
    if (error.code() != ExitCode::bad_data) std::abort();
  }
  return 0;
}
