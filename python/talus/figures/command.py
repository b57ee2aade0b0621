"""`talus figures`: draws figures of runs, with their data."""

import argparse
import gc
import logging
import multiprocessing
import os
import re
import shlex
import signal
import sys
import time
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from multiprocessing.connection import wait
from pathlib import Path
from typing import Any

from talus.errors import Error, MissingFile, WrongValue
from talus.figures.catalogue import CATALOGUE, Recipe, find
from talus.figures.data import Data, Wanted
from talus.figures.files import earlier_files, figure_files, remove_files, write_figure
from talus.figures.groups import Group, group_runs
from talus.figures.runs import AnalysedRun, read_runs
from talus.figures.style import styled
from talus.simulation import _extension

#: Values of --add.
ADDITIONS = {"paper": "the paper's values also for other beds than the paper's",
             "spread": "standard deviations and single runs also of more than two groups", "svg": "a picture as SVG"}


def parse(words: Sequence[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser("talus figures", description="Draws the paper's figures of runs, with their data.")
    parser.add_argument("runs", nargs="+", metavar="RUNS", help="run files, folders of ensembles, or an ensemble.h5")
    parser.add_argument("-o", "--output", required=True, metavar="FOLDER", help="folder of the figures, created if missing")
    parser.add_argument("--only", action="append", default=[], metavar="NAME,...", help="figures by name or number [all]")
    parser.add_argument("--at", action="append", default=[], metavar="DEG,...", help="frames instead of those of the paper")
    parser.add_argument("--size", default="", metavar="SIZE", help="8.6cm, 17.8x10cm, or pixels as in 1600 or 1920x1080")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="change a parameter of the analysis")
    parser.add_argument("--add", action="append", default=[], metavar="WHAT,...",
                        help="; ".join(f"{name}: {text}" for name, text in ADDITIONS.items()))
    parser.add_argument("--style", metavar="FILE", help="style sheet of matplotlib")
    parser.add_argument("--threads", type=int, default=min(2, os.cpu_count() or 1), help="number of processes that draw")
    parser.add_argument("--overwrite", action="store_true", help="replace existing files")
    parser.add_argument("-q", "--quiet", action="store_true", help="print errors and warnings only")
    parser.add_argument("--command", default="", help=argparse.SUPPRESS)
    found = parser.parse_intermixed_args(words)
    found.threads = max(found.threads, 1)
    for name in ("only", "at", "add"):
        setattr(found, name, list(dict.fromkeys(part for text in getattr(found, name) for part in text.split(","))))
    return found


def parse_size(text: str) -> tuple[float, float]:
    """Parses "8.6cm", "17.8x10cm", "1600" or "1920x1080" (pixels of a PNG), and returns cm; 0 stands for the default of each
    figure."""
    narrowest, lowest, largest = 8, 4, 60
    if not text:
        return 0, 0
    found = re.fullmatch(r"(\d+\.?\d*|\.\d+)(?:x(\d+\.?\d*|\.\d+))?(cm)?", text)
    width, height = (float(part or 0) * (1 if found[3] else 2.54 / Recipe.dpi) for part in found.groups()[:2]) if found else (0, 0)
    if not narrowest <= width <= largest or height and not lowest <= height <= largest or found and found[2] and not height:
        raise WrongValue(f"--size {text}: expected a width from {narrowest} to {largest} cm, such as 8.6cm or, in pixels at {Recipe.dpi} "
                         f"per inch, 1600, and perhaps a height from {lowest} cm, as in 17.8x10cm")
    return width, height


def check_style(style: str | None) -> None:
    """Reports the lines of a style sheet that matplotlib ignores. Raises MissingFile if it cannot be read, and Error if it is
    no text."""
    faults: list[str] = []
    handler, logger = logging.Handler(), logging.getLogger("matplotlib")
    handler.emit = lambda record: faults.append(record.getMessage().strip().partition("\n")[0])  # type: ignore[assignment]
    level, logger.propagate = logger.level, False
    logger.setLevel(logging.WARNING)
    logger.addHandler(handler)
    try:
        with styled(style):
            pass
    except OSError:
        raise MissingFile(f"--style {style}: no such style sheet; expected a file such as journal.mplstyle, or a name of matplotlib") from None
    except ValueError:
        raise Error(f"--style {style}: is not a style sheet of matplotlib, which is a text in UTF-8") from None
    finally:
        logger.removeHandler(handler)
        logger.setLevel(level)
        logger.propagate = True
    for fault in faults:
        report(f"note: --style {style}: matplotlib ignores a line: {fault}")


def usage_error(text: str) -> Error:
    error = WrongValue(text)
    error.exit_code = 64
    return error


def report(text: str) -> None:
    print(text, file=sys.stderr, flush=True)


class Count:
    """Shows a count on a line of standard error: at once on a terminal, every five seconds in a log."""

    def __init__(self, label: str, quiet: bool) -> None:
        self.label, self.quiet, self.terminal = label, quiet, sys.stderr.isatty()
        self.began = self.shown = time.monotonic()

    def __call__(self, done: int, count: int) -> None:
        now, last = time.monotonic(), 0 < done == count
        if self.quiet or now - self.shown < (0.1 if self.terminal else 5) and not (last and self.terminal):
            return
        self.shown = now
        text = f"{self.label} {done}/{count}, {now - self.began:.0f} s"
        if self.terminal:
            print(f"\r{text}\033[K", end="\n" if last else "", file=sys.stderr, flush=True)
        else:
            report(text)


def make_data(recipes: Sequence[Recipe], groups: Sequence[Group], wanted: Wanted) -> list[tuple[Recipe, Data]]:
    """Returns the data of the figures that can be made of the runs, and reports the requirements of the others."""
    made = []
    for recipe in recipes:
        data = recipe.data(groups, wanted)
        if data is not None:
            made.append((recipe, data))
            continue
        report(f"left out: {recipe.name} needs {recipe.needs}")
    if not made:
        raise Error("no figure can be made of these runs")
    return made


def check_targets(folder: Path, made: Sequence[tuple[Recipe, Data]], recipes: Sequence[Recipe], formats: Sequence[str], overwrite: bool,
                  inputs: Sequence[str]) -> None:
    """Raises Error if a file exists and is not to be replaced, or is read by this command."""
    names = [name for recipe, data in made for name in figure_files(recipe, data, formats)]
    if overwrite:
        names += [name for recipe in recipes for name in earlier_files(folder, recipe)]
    for name in names:
        _extension()._output_target(os.fsencode(folder / name), overwrite, [os.fsencode(path) for path in inputs])


@contextmanager
def signals_wait() -> Iterator[Callable[[], None]]:
    """Lets signals wait while processes start, because they would be lost in what Python does at a fork. A process that has
    started calls the function that it gives, which restores the handlers."""
    handlers = {number: handler for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
                if callable(handler := signal.getsignal(number))}
    arrived: list[int] = []
    wakeup = signal.set_wakeup_fd(-1)  # that of this process (start.py), which processes that are stopped must not use

    def restore() -> None:
        for number, handler in handlers.items():
            signal.signal(number, handler)
        if arrived:
            raise KeyboardInterrupt

    for number in handlers:
        signal.signal(number, lambda number, frame: arrived.append(number))
    try:
        yield restore
    finally:
        signal.set_wakeup_fd(wakeup)
        restore()


def in_processes(jobs: Sequence[Callable[[], None]], processes: int, progress: Callable[[int, int], None]) -> None:
    """Carries out jobs in forked processes, and raises the first error of one of them."""
    context = multiprocessing.get_context("fork")
    following = iter(range(len(jobs)))

    def work(pipe: Any) -> None:
        try:
            restore()
            for inherited in pipes:  # otherwise the end of the parent would go unnoticed
                inherited.close()
            gc.freeze()  # searching what the processes share, as often as by default, takes a tenth of the time
            gc.set_threshold(50_000)
            for k in iter(pipe.recv, None):
                jobs[k]()
                pipe.send(None)
        except (KeyboardInterrupt, EOFError):
            pass
        except BaseException as error:
            pipe.send(error)
        pipe.close()

    pipes: list[Any] = []
    workers = []
    try:
        with signals_wait() as restore:
            for _ in range(min(processes, len(jobs))):
                ours, theirs = context.Pipe()
                pipes.append(ours)
                workers.append(context.Process(target=work, args=(theirs,)))
                workers[-1].start()
                theirs.close()
                ours.send(next(following))
        done = 0
        progress(done, len(jobs))
        while pipes:
            for pipe in wait(pipes):
                try:
                    answer = pipe.recv()  # type: ignore[union-attr]
                except EOFError:
                    pipes.remove(pipe)
                    continue
                if answer is not None:
                    raise answer
                done += 1
                progress(done, len(jobs))
                with suppress(BrokenPipeError):  # of a process that has ended, which the next turn notices
                    pipe.send(next(following, None))  # type: ignore[union-attr]
        if done < len(jobs):
            raise Error("a process that draws figures has ended early; is there enough memory?")
    except BaseException:
        for worker in workers:
            worker.terminate()
        raise
    finally:
        for worker in workers:
            worker.join()


def draw_into(folder: Path, jobs: Sequence[Callable[[], None]], processes: int, progress: Callable[[int, int], None]) -> None:
    """Carries out jobs that draw figures into a folder, which is created if missing."""
    _extension()._prepare_folder(os.fsencode(folder))
    try:
        in_processes(jobs, processes, progress)
    except BaseException:
        _extension()._prepare_folder(os.fsencode(folder))  # removes what processes that were stopped have left
        raise


def main(words: Sequence[str]) -> None:
    """Carries out `talus figures`."""
    logging.getLogger("matplotlib").setLevel(logging.ERROR)  # such as that it has no folder for its settings
    warnings.filterwarnings("ignore", "Glyph .* missing from")  # of a script that the font of the figures lacks
    asked = parse(words)
    chosen = [find(word) for word in asked.only]
    recipes = [recipe for recipe in CATALOGUE if recipe in chosen or not chosen]
    width, height = parse_size(asked.size)
    if asked.at and not any(recipe.shows_frames for recipe in recipes):
        raise usage_error("--at: no requested figure shows single frames")
    for word in asked.add:
        if word not in ADDITIONS:
            raise usage_error(f"--add {word}: expected one of {', '.join(ADDITIONS)}")
    check_style(asked.style)
    if asked.output.endswith((".pdf", ".png", ".svg")):
        raise usage_error(f"{asked.output}: expected a folder, in which the figures have their names")
    formats = ("pdf", "png", "svg") if "svg" in asked.add else ("pdf", "png")
    progress = None if asked.quiet else Count("analysis", False)
    runs = read_runs(asked.runs, asked.set, threads=asked.threads, progress=progress, report=report)
    groups = group_runs(runs)
    made = make_data(recipes, groups, Wanted(asked.at, "paper" in asked.add, "spread" in asked.add))
    folder = Path(asked.output)
    check_targets(folder, made, recipes, formats, asked.overwrite, [run.path.partition("#")[0] for run in runs])
    command = asked.command or f"talus figures {shlex.join(words)}"

    def job(recipe: Recipe, data: Data) -> Callable[[], None]:
        def draw() -> None:
            try:
                write_figure(recipe, data, groups, folder, formats=formats, width=width, height=height, style=asked.style,
                             command=command)
            except (Error, OSError, MemoryError):
                raise
            except Exception as error:
                if asked.style is None:
                    raise
                raise Error(f"--style {asked.style}: {recipe.name} cannot be drawn with it: {error}") from None

        return draw

    longest_first = sorted(made, key=lambda each: -len(each[1].facts.get("panels", ())))
    draw_into(folder, [job(*each) for each in longest_first], asked.threads, Count("figures", asked.quiet))
    if asked.overwrite:
        remove_left_out(folder, [recipe for recipe in recipes if recipe not in [each for each, _ in made]])
    if asked.quiet:
        return
    for recipe, data in made:
        print(f"{recipe.name:<34} {data.title or recipe.title}")
    print(f"{len(made)} figure{'' if len(made) == 1 else 's'} in {asked.output}: {', '.join('.' + each for each in formats)}; data in .csv, "
          "provenance in .json")


def remove_left_out(folder: Path, recipes: Sequence[Recipe]) -> None:
    """Removes earlier figures that were asked for and cannot be made of these runs."""
    for recipe in recipes:
        earlier = earlier_files(folder, recipe)
        remove_files(folder, earlier)
        if earlier:
            report(f"removed: {recipe.name} of an earlier command")
