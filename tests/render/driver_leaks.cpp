/// Suppresses leaks of the software drivers, which keep their allocations until the process ends.

extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libOSMesa\nleak:libglapi\nleak:libLLVM\n";
}
