/// The software drivers keep what they allocate until the process ends; that is no leak of ours.

extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libOSMesa\nleak:libglapi\nleak:libLLVM\n";
}
