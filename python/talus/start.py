"""Carries out a command of the program: python3 -P start.py NAME ARGUMENTS... calls main(ARGUMENTS) of the module talus.NAME.
Errors have the form and the exit codes of the program (docs/errors.md)."""

import importlib
import os
import signal
import sys
import threading
import time
from typing import Any

UNAVAILABLE, INTERNAL, OUT_OF_MEMORY, CANNOT_CREATE, IO_ERROR, STOPPED = 69, 70, 71, 73, 74, 75

SENTENCE = "Stopped; unfinished results are not kept."


def fail(code: int, text: str) -> int:
    print(f"talus: error: {text}", file=sys.stderr)
    return code


def write_utf8() -> None:
    """Makes standard output and error UTF-8, as those of the program, whatever the locale and PYTHONIOENCODING. Names that
    are not UTF-8 keep their bytes."""
    for stream in filter(None, (sys.stdout, sys.stderr)):  # None: closed
        stream.reconfigure(encoding="utf-8", errors="surrogateescape")  # type: ignore[union-attr]


def stop_on_signals() -> None:
    """Makes SIGTERM and SIGHUP, unless it is ignored (nohup), raise KeyboardInterrupt as SIGINT does; the program has let
    them wait until here. A closed pipe ends the process, as it ends the program."""
    stops = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
    for number in stops:
        if number != signal.SIGHUP or signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, signal.default_int_handler)
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    signals, notify = os.pipe()
    os.set_blocking(notify, False)
    signal.set_wakeup_fd(notify)
    threading.Thread(target=end_soon, args=(signals,), daemon=True).start()
    signal.pthread_sigmask(signal.SIG_UNBLOCK, stops)


def end_soon(signals: int) -> None:
    """Waits for a signal, and ends the process a third of a second later, even if Python waits for other code."""
    os.read(signals, 1)
    time.sleep(0.3)
    os.write(2, SENTENCE.encode() + b"\n")
    os._exit(STOPPED)


def run(name: str, arguments: list[str]) -> int:
    """Runs a module and returns the exit code."""
    try:
        write_utf8()
        stop_on_signals()
        code: Any = importlib.import_module(f"talus.{name}").main(arguments)
        if sys.stdout is not None:
            sys.stdout.flush()
        return int(code or 0)
    except KeyboardInterrupt:
        print(SENTENCE, file=sys.stderr)
        return STOPPED
    except Exception as error:
        if hasattr(error, "exit_code"):  # talus.Error; also one about a missing package or file
            return fail(error.exit_code, str(error))
        if isinstance(error, ImportError):
            package = (error.name or "").partition(".")[0]
            advice = f"the Python module {package}: apt-get install python3-{package}" if package else f"more of Python: {error}"
            return fail(UNAVAILABLE, f"this command needs {advice}")
        if isinstance(error, OSError) and error.strerror:
            where = "standard output" if error.filename is None else os.fsdecode(error.filename)
            if error.filename is None:
                os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # the interpreter writes the rest at its end
            denied = isinstance(error, (PermissionError, FileExistsError, IsADirectoryError, NotADirectoryError))
            return fail(CANNOT_CREATE if denied else IO_ERROR, f"{where}: cannot read or write: {error.strerror}")
        if isinstance(error, MemoryError):
            return fail(OUT_OF_MEMORY, "out of memory")
        raise


if __name__ == "__main__":  # not in the processes of a pool, which start with this file as well
    sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    code = run(sys.argv[1], sys.argv[2:])
    if code == STOPPED:
        os._exit(code)  # at once, and without the sentence of end_soon
    sys.exit(code)
