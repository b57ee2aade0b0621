"""HDF5 crashes, or hangs, on some files that were malformed and have the right hash nevertheless, and would end the
program that reads one. So a child process walks through such a file first."""

import contextlib
import os
import signal
import warnings
from pathlib import Path

import h5py
from h5py._objects import phil

from talus.checked_file import Identity, open_unlocked
from talus.errors import Error

#: A walk takes some milliseconds.
MAX_SECONDS = 60.0
#: How the child ends: the file is sound, h5py refuses it, or the system lacks something.
WALKED, MALFORMED, NOT_KNOWN = 0, 1, 2
_walked: set[Identity] = set()


def walk(path: Path) -> None:
    """Opens all that is in the file, and looks up where values lie. Throws whatever h5py does where a group cannot be
    read; what is wrong with one data set is told where it is read."""
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


def _in_child(path: Path) -> None:
    """Ends the process, by a crash if there is one: what Python does then is for the reader's own."""
    with contextlib.suppress(BaseException):
        for crash in (signal.SIGSEGV, signal.SIGBUS, signal.SIGFPE, signal.SIGILL, signal.SIGABRT, signal.SIGALRM):
            signal.signal(crash, signal.SIG_DFL)
        with contextlib.suppress(ImportError, OSError, ValueError):
            import resource

            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        signal.pthread_sigmask(signal.SIG_SETMASK, ())
        os.dup2(os.open(os.devnull, os.O_WRONLY), 2)  # the C library has a word for its end
        signal.setitimer(signal.ITIMER_REAL, MAX_SECONDS)
        try:
            walk(path)
            os._exit(WALKED)
        except MemoryError:
            os._exit(NOT_KNOWN)
        except OSError as error:  # what HDF5 says of a file has no number
            os._exit(NOT_KNOWN if error.errno else MALFORMED)
    os._exit(MALFORMED)


def require_walkable(path: Path, identity: Identity) -> None:
    """Throws Error if HDF5 crashes or hangs on the file. Each file is walked through once, while it stays as it is; not
    where the system has no fork."""
    if identity in _walked or not hasattr(os, "fork"):
        return
    with phil, warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # threads: the child calls nothing but HDF5, whose lock is ours
        try:
            child = os.fork()
        except OSError:  # too many processes, or too little memory
            return
        if child == 0:
            _in_child(path)
    try:
        _, status = os.waitpid(child, 0)
    except ChildProcessError:  # the program has all its children reaped by itself: nothing is known
        return
    except BaseException:  # Ctrl-C
        with contextlib.suppress(OSError):
            os.kill(child, signal.SIGKILL)
            os.waitpid(child, 0)
        raise
    if os.WIFEXITED(status) and os.WEXITSTATUS(status) == NOT_KNOWN:
        return  # whoever opens the file says what is missing
    if status != 0:
        what = "crashes on it, or hangs" if os.WIFSIGNALED(status) else "cannot walk through it"
        raise Error(f"{path}: HDF5 {what}: the file is malformed, although its hash is right; restore it from a copy")
    _walked.add(identity)
