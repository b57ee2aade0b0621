"""Interrupts of simulations in threads other than the main one, to which Python delivers no signals."""

import concurrent.futures
import signal
import sys
import threading


def are_raised() -> bool:
    """Whether Ctrl-C raises KeyboardInterrupt in the main thread, as by default, or ends its event loop. Any other handler
    decides by itself what an interrupt ends."""
    handler = signal.getsignal(signal.SIGINT)
    return handler is signal.default_int_handler or getattr(getattr(handler, "func", None), "__module__", "") == "asyncio.runners"


def end_the_main_thread() -> bool:
    """Whether the main thread, ended by KeyboardInterrupt or SystemExit, waits for other threads: at the end of the `with` of
    a pool, or, after KeyboardInterrupt, at the end of the program."""
    frame = sys._current_frames().get(threading.main_thread().ident or 0)
    while frame is not None:
        if frame.f_code is concurrent.futures.Executor.__exit__.__code__:
            raised = frame.f_locals.get("exc_type")
            if isinstance(raised, type) and issubclass(raised, (KeyboardInterrupt, SystemExit)):
                return True
        if frame.f_code is threading._shutdown.__code__ and getattr(sys, "last_type", None) is KeyboardInterrupt:  # type: ignore[attr-defined]
            return True
        frame = frame.f_back
    return False
