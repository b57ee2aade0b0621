# Finds the requirements of the build. All are Debian packages, which ./bootstrap installs.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)  # 3.3 or later; a version here would refuse 5
find_package(HDF5 REQUIRED COMPONENTS C)
find_package(PNG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
pkg_check_modules(TOMLPP REQUIRED IMPORTED_TARGET tomlplusplus)
pkg_check_modules(XXHASH REQUIRED IMPORTED_TARGET libxxhash)
pkg_check_modules(FMT REQUIRED IMPORTED_TARGET fmt>=9)
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo-pdf cairo-ft)
pkg_check_modules(EGL REQUIRED IMPORTED_TARGET egl)

# Python, for the extension of the package and for the commands that the package carries out.
set(Python_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "The Python that the extension is for")
find_package(Python 3.11 COMPONENTS Interpreter OPTIONAL_COMPONENTS Development.Module QUIET)
set(TALUS_PYTHON_FOLDER "" CACHE STRING "Where cmake --install puts the Python package; empty: where Debian's Python looks")
