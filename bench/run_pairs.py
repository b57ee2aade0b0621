#!/usr/bin/env python3
"""Compares the cost of steps with another revision: both programs take the same steps
of the tilt at 10 deg alternately, twenty at a time, so that other load affects both. This resolves 2 %,
whereas whole runs do not resolve 10 %. Builds both, the other revision in a separate work tree, and prints a
Markdown table.

usage: run_pairs.py REVISION [--grains N] [--threads N...] [--steps N] [--pairs N]
"""
import argparse
import os
import statistics
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PROGRAM = "build/bench/steps_bench"
BEDS = "build/bench/bench/beds"


def call(*command, folder=ROOT):
    """Runs a command and returns its output; if it fails, ends this program with that output."""
    done = subprocess.run(command, cwd=folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        sys.exit(f"run_pairs.py: error: {' '.join(command)} failed in {folder}:\n{done.stdout}")
    return done.stdout


def built(folder):
    """Builds the program of a tree and returns its path."""
    call("cmake", "--preset", "bench", folder=folder)
    call("cmake", "--build", "--preset", "bench", "--target", "steps_bench", folder=folder)
    return os.path.join(folder, PROGRAM)


def tree_of(commit):
    """Returns a work tree of a commit, whose programs use the beds of this one."""
    if not call("git", "ls-tree", "--name-only", commit, "bench/steps_bench.cpp"):
        sys.exit(f"run_pairs.py: error: {commit} has no bench/steps_bench.cpp; compare with a later revision")
    folder = os.path.join(ROOT, "build/pairs", commit)
    if not os.path.isdir(folder):
        call("git", "worktree", "prune")
        call("git", "worktree", "add", "--detach", folder, commit)
    beds = os.path.join(folder, BEDS)
    if not os.path.islink(beds):
        os.makedirs(os.path.dirname(beds), exist_ok=True)
        os.symlink(os.path.join(ROOT, BEDS), beds)
    return folder


class Steps:
    """A running program that takes steps of its bed on request."""

    def __init__(self, program, grains):
        self.process = subprocess.Popen([program, str(grains)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.take(1, 0)  # waits until its bed is ready, which the first program may have to compute

    def take(self, threads, steps):
        """Returns seconds, iterations, and the state hash after the given number of further steps."""
        print(threads, steps, file=self.process.stdin, flush=True)
        answer = self.process.stdout.readline().split()
        if not answer:
            sys.exit(f"run_pairs.py: error: {self.process.args[0]} ended with code {self.process.wait()}")
        return float(answer[0]), int(answer[1]), answer[2]


def compare(programs, arguments, threads):
    """Returns a row of the table: medians of both, and of the ratios of pairs, with their quartiles."""
    both = [Steps(program, arguments.grains) for program in programs]
    seconds, iterations, same = ([], []), [0, 0], True
    for program in both:
        program.take(threads, arguments.steps)  # caches, threads, lists
    for pair in range(arguments.pairs):
        hashes = set()
        for k in (0, 1) if pair % 2 == 0 else (1, 0):
            taken, count, state = both[k].take(threads, arguments.steps)
            seconds[k].append(taken)
            iterations[k] += count
            hashes.add(state)
        same = same and len(hashes) == 1
    for program in both:
        program.process.communicate()
    low, middle, high = statistics.quantiles([new / old for old, new in zip(*seconds)], n=4)
    ms = [1e3 * statistics.median(of) / arguments.steps for of in seconds]
    taken = [count / (arguments.pairs * arguments.steps) for count in iterations]
    return (f"| {threads} | {ms[0]:.2f} ms | {ms[1]:.2f} ms | {middle:.3f} | {low:.2f} to {high:.2f} | "
            f"{taken[0]:.1f} and {taken[1]:.1f} | {'the same' if same else 'different'} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("revision", help="revision of git for comparison with this tree")
    parser.add_argument("--grains", type=int, default=8000, help="size of the bed")
    parser.add_argument("--threads", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--steps", type=int, default=20, help="number of steps per turn of a program")
    parser.add_argument("--pairs", type=int, default=60, help="number of pairs, of which the median is printed, at least 2")
    arguments = parser.parse_args()
    if arguments.pairs < 2 or arguments.steps < 1:
        parser.error("expected at least 2 pairs of at least 1 step")
    commit = call("git", "rev-parse", "--verify", "--short", arguments.revision + "^{commit}").strip()
    programs = [built(tree_of(commit)), built(ROOT)]
    print(f"| threads | a step of {commit} | a step of this tree | ratio of a pair | its quartiles | iterations per step | bits |")
    print("|--:|--:|--:|--:|--:|--:|---|")
    for threads in arguments.threads:
        print(compare(programs, arguments, threads), flush=True)


if __name__ == "__main__":
    main()
