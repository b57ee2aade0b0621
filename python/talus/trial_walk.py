"""Test of files in a child process: HDF5 crashes or hangs on some malformed files whose hash is right, which would end the
reading program, so a child process walks through each file first."""

import contextlib
import os
import signal
import sys
import time
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import NoReturn

import h5py
from h5py._objects import phil

from talus.checked_file import Identity, open_unlocked
from talus.errors import Error

#: Time limit; a walk takes a few milliseconds.
MAX_SECONDS = 60.0
#: Exit codes of the child: the file is sound, h5py rejects it, the system lacks a resource, or another thread was using HDF5.
WALKED, MALFORMED, NOT_KNOWN, BUSY = 0, 1, 2, 3
_walked: set[Identity] = set()


def walk(path: Path) -> None:
    """Opens everything in the file, and looks up where values are stored. Raises the exceptions of h5py if a group
    cannot be read; faults of single data sets are reported when they are read."""
    file, _ = open_unlocked(path)

    def look(name: bytes) -> None:
        with contextlib.suppress(Exception):
            found = h5py.h5o.open(file.id, name)
            for k in range(h5py.h5a.get_num_attrs(found)):
                h5py.h5a.open(found, index=k).get_type()
            if isinstance(found, h5py.h5d.DatasetID):
                found.get_type(), found.get_space()
                if found.get_create_plist().get_layout() == h5py.h5d.CHUNKED:
                    found.get_num_chunks()

    h5py.h5o.visit(file.id, look)


def _in_child(path: Path) -> NoReturn:
    """Walks through the file and ends the process, possibly by a crash, without the cleanup of Python, which belongs to
    the parent."""
    with contextlib.suppress(BaseException):
        for crash in (signal.SIGSEGV, signal.SIGBUS, signal.SIGFPE, signal.SIGILL, signal.SIGABRT, signal.SIGALRM):
            signal.signal(crash, signal.SIG_DFL)
        with contextlib.suppress(ImportError, OSError, ValueError):
            import resource

            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        signal.pthread_sigmask(signal.SIG_SETMASK, ())
        os.dup2(os.open(os.devnull, os.O_WRONLY), 2)  # silences messages of the C library on a crash
        signal.setitimer(signal.ITIMER_REAL, MAX_SECONDS)
        try:
            walk(path)
            os._exit(WALKED)
        except MemoryError:
            os._exit(NOT_KNOWN)
        except OSError as error:  # errors of HDF5 about a file have no errno
            os._exit(NOT_KNOWN if error.errno else MALFORMED)
    os._exit(MALFORMED)


def end_children(children: list[int]) -> None:
    for child in children:
        with contextlib.suppress(OSError):
            os.kill(child, signal.SIGKILL)
            os.waitpid(child, 0)


def fork_within_hdf5(run_child: Callable[[], NoReturn]) -> int:
    """Forks a child that calls a function, in a function that HDF5 itself calls: while this thread holds its lock, which no
    other thread can have taken. Returns the id of the child. Raises OSError."""
    children: list[int] = []
    failures: list[OSError] = []

    def fork(_: bytes) -> bool:
        try:
            child = os.fork()
        except OSError as error:
            failures.append(error)
            return True
        if child == 0:
            run_child()
        children.append(child)
        return True

    access = h5py.h5p.create(h5py.h5p.FILE_ACCESS)
    access.set_fapl_core(backing_store=False)
    file = h5py.h5f.create(b"talus", fapl=access)  # in memory
    h5py.h5g.create(file, b"group")
    try:
        h5py.h5g.iterate(h5py.h5g.open(file, b"/"), fork)
    except BaseException:  # Ctrl-C
        end_children(children)
        raise
    if failures:
        raise failures[0]
    return children[0]


def fork_without_hdf5(run_child: Callable[[], NoReturn]) -> int:
    """The same for HDF5 2, whose lock belongs to a thread of the kernel, so that a child could never take one that its parent
    holds. The child ends with BUSY if a thread of the extension has it; those of h5py wait, because this thread holds phil."""
    child = os.fork()
    if child == 0:
        extension = sys.modules.get("talus._core")
        if extension is not None and not extension._may_use_hdf5():
            os._exit(BUSY)
        run_child()
    return child


def _fork_for_hdf5(run_child: Callable[[], NoReturn]) -> int:
    with phil, warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # the child calls only HDF5, which no other thread is using
        return (fork_without_hdf5 if h5py.version.hdf5_version_tuple >= (2, 0, 0) else fork_within_hdf5)(run_child)


def require_walkable(path: Path, identity: Identity) -> None:
    """Raises Error if HDF5 crashes or hangs on the file. Each file is tested once while its identity stays the same;
    not on systems without fork."""
    if identity in _walked or not hasattr(os, "fork"):
        return
    try:
        child = _fork_for_hdf5(lambda: _in_child(path))
    except OSError:  # too many processes, or too little memory
        return
    try:
        _, status = os.waitpid(child, 0)
    except ChildProcessError:  # the program reaps its children itself, so the status is unknown
        return
    except BaseException:  # Ctrl-C
        end_children([child])
        raise
    if os.WIFEXITED(status) and os.WEXITSTATUS(status) == BUSY:
        time.sleep(0.001)
        return require_walkable(path, identity)
    if os.WIFEXITED(status) and os.WEXITSTATUS(status) == NOT_KNOWN:
        return  # opening the file will report the missing resource
    if status != 0:
        what = "crashes or hangs on this file" if os.WIFSIGNALED(status) else "cannot read this file"
        raise Error(f"{path}: HDF5 {what}: it is malformed, although its hash is right; restore it from a copy")
    _walked.add(identity)
