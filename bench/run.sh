#!/usr/bin/env bash
# Builds the benchmarks and writes every result to bench/results/: bench/run.sh [PART...]
# Parts: solver, scale, siconos, siconos_si, siconos_dense, runs, dem, crowded, frames, ensemble, store, render, python, view, analysis; all if none is named.
set -euo pipefail

cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/.."
readonly build=build/bench results=bench/results
readonly scale_sizes=(4000 8000 20000 40000 100000 400000)
readonly dense_solvers=(nsgs cpg lemke enumeration)
readonly dense_seconds=300 # time limit of a dense solver
export OPENBLAS_NUM_THREADS=1 # Siconos is measured on one core
revision=$(git -c safe.directory="$PWD" describe --always --dirty) # before results change the tree
readonly revision

build() {
  cmake --preset bench >/dev/null
  cmake --build --preset bench
}

# Prints the sizes of the caches that one core can use.
caches() {
  local index=/sys/devices/system/cpu/cpu0/cache
  printf 'L2 %s, L3 %s' "$(size_of "$index/index2/size")" "$(size_of "$index/index3/size")"
}
size_of() { [[ -r $1 ]] && numfmt --from=iec --to=iec-i --suffix=B <"$1" || echo unknown; }

# heading TITLE COMMAND: prints the subject, the command, the build, the machine and the date.
heading() {
  local compiler
  compiler=$(sed -n 's/^CMAKE_CXX_COMPILER:.*=//p' "$build/CMakeCache.txt")
  cat <<TEXT
# $1

- command: \`$2\`
- Talus: $revision, $("$compiler" --version | head -1), $(sed -n 's/^CMAKE_CXX_FLAGS_RELEASE:[A-Z]*=//p' "$build/CMakeCache.txt")
- processor: $(nproc) cores of $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1), caches: $(caches)
- load of the machine at the start: $(cut -d ' ' -f 1 /proc/loadavg); date: $(date -u +%F)

TEXT
}

# keep NAME: replaces the previous result by the complete new one.
keep() { mv -- "$results/$1.part" "$results/$1"; }

solver() {
  local command="$build/solver_bench --benchmark_repetitions=5 --benchmark_report_aggregates_only=true"
  {
    heading "The solvers and the stages of a step, paper's bed" "$command"
    echo '```'
    $command 2>/dev/null
    echo '```'
  } >"$results/solver.md.part"
  keep solver.md
}

scale() {
  {
    heading "Cost and memory against size" "bench/run_scale.py $build/scale_bench ${scale_sizes[*]}"
    /usr/bin/python3 bench/run_scale.py "$build/scale_bench" "${scale_sizes[@]}"
  } >"$results/scale.md.part"
  keep scale.md
}

siconos_version() {
  echo "Siconos: $(dpkg-query -W -f '${Package} ${Version}' libsiconos-numerics-dev)"
  echo
}

# siconos_table NAME TITLE ARGUMENTS...
siconos_table() {
  local name=$1 title=$2
  shift 2
  {
    heading "$title" "$build/siconos_bench $*"
    siconos_version
    "$build/siconos_bench" "$@"
  } >"$results/$name.md.part"
  keep "$name.md"
}

siconos() { siconos_table siconos "Talus and Siconos to the same error, D = m = g = 1, dt = 5e-3" --seconds 120; }

siconos_si() {
  siconos_table siconos_si "Talus and Siconos to the same error, SI units, h = 1 ms" --si --grains 8000 --seconds 120
}

siconos_dense() {
  local solver status
  {
    heading "Siconos's other 2D solvers, and its Gauss-Seidel on a dense matrix: 500 grains, cold, to 1e-4" \
      "$build/siconos_dense_bench SOLVER"
    siconos_version
    echo "| solver | grains | contacts | info (0: reports convergence) | seconds | iterations | Siconos's error |"
    echo "|---|--:|--:|--:|--:|--:|--:|"
    for solver in "${dense_solvers[@]}"; do
      status=0
      timeout "$dense_seconds" "$build/siconos_dense_bench" "$solver" 2>/dev/null || status=$?
      case $status in
        0) ;;
        124) echo "| $solver | 500 | | no answer | > $dense_seconds | | |" ;;
        *) echo "| $solver | 500 | | ended with code $status | | | |" ;;
      esac
    done
  } >"$results/siconos_dense.md.part"
  keep siconos_dense.md
}

runs() {
  {
    heading "Whole runs" "bench/run_whole.py $build/talus"
    /usr/bin/python3 bench/run_whole.py "$build/talus"
  } >"$results/runs.md.part"
  keep runs.md
}

dem() {
  local version
  version=$(dpkg-query -W -f '${Version}' lammps 2>/dev/null || echo "not found")
  {
    heading "The tilt by springs and dashpots" "bench/dem_bench.py $build/talus"
    echo "LAMMPS: Debian $version"
    echo
    /usr/bin/python3 bench/dem_bench.py "$build/talus"
  } >"$results/dem.md.part"
  keep dem.md
}

crowded() {
  {
    heading "A run with other processes" "bench/run_crowded.py $build/talus"
    /usr/bin/python3 bench/run_crowded.py "$build/talus"
  } >"$results/crowded.md.part"
  keep crowded.md
}

frames() {
  {
    heading "Maps drawn during a run" "bench/run_frames.py $build/talus"
    /usr/bin/python3 bench/run_frames.py "$build/talus"
  } >"$results/frames.md.part"
  keep frames.md
}

ensemble() {
  {
    heading "Ensembles of many members" "bench/ensemble_bench.py $build/talus"
    /usr/bin/python3 bench/ensemble_bench.py "$build/talus"
  } >"$results/ensemble.md.part"
  keep ensemble.md
}

render() {
  local mesa
  mesa=$(dpkg-query -W -f '${Version}' libosmesa6 2>/dev/null || echo unknown)
  {
    heading "Pictures of discs" "LP_NUM_THREADS=2 bench/render_peers.py $build"
    echo "Mesa: $mesa, cairo: $(pkg-config --modversion cairo)"
    echo
    LP_NUM_THREADS=2 /usr/bin/python3 bench/render_peers.py "$build"
  } >"$results/render.md.part"
  keep render.md
}

store() {
  local command="$build/store_bench"
  {
    heading "Commits of the paper's bed, and its run file" "$command"
    echo '```'
    $command 2>/dev/null
    echo '```'
  } >"$results/store.md.part"
  keep store.md
}

python() {
  {
    heading "Runs driven from Python" "bench/python_bench.py $build/talus"
    PYTHONPATH=$build/python /usr/bin/python3 bench/python_bench.py "$build/talus"
  } >"$results/python.md.part"
  keep python.md
}

view() {
  local run=$build/view.h5
  "$build/talus" run assets/scenarios/paper-pbc.toml -o "$run" --overwrite --quiet
  {
    heading "Pictures of the window per second, without a display" "$build/view_bench assets/scenarios/paper-pbc.toml, and $run"
    "$build/view_bench" assets/scenarios/paper-pbc.toml
    echo
    "$build/view_bench" "$run"
  } >"$results/view.md.part"
  rm -f -- "$run"
  keep view.md
}

analysis() {
  local run=$build/analysis.h5
  "$build/talus" run assets/scenarios/paper-pbc.toml -o "$run" --overwrite --quiet
  {
    heading "Cost of the parts of an analysis for a frame of the paper's bed" "$build/analysis_bench $run"
    "$build/analysis_bench" "$run"
  } >"$results/analysis.md.part"
  rm -f -- "$run"
  keep analysis.md
}

parts=("$@")
((${#parts[@]} > 0)) || parts=(solver scale siconos siconos_si siconos_dense runs dem crowded frames ensemble store render python view analysis)
build
mkdir -p "$results"
for part in "${parts[@]}"; do
  case $part in
    solver | scale | siconos | siconos_si | siconos_dense | runs | dem | crowded | frames | ensemble | store | render | python | view | analysis) "$part" ;;
    *) printf 'bench/run.sh: error: unknown part "%s"; the parts are listed at the top of this file\n' "$part" >&2 && exit 64 ;;
  esac
  printf '%s: done after %d s\n' "$part" "$SECONDS"
done
