"""A simulation and its process: forks, signals, the end of the interpreter, full disks. Each test is a
script that must end by itself with code 0."""

import os
import re
import signal
import subprocess
import sys
import textwrap
import time

import pytest
import talus
from conftest import run_talus
from test_simulation import BED

pytest.importorskip("talus._core", reason="the extension is not built: pybind11-dev, python3-dev")

BEGIN = f"""
import faulthandler, multiprocessing, os, signal, sys, threading, time
import talus
faulthandler.enable()
bed = lambda **settings: talus.Simulation({BED!r}, **settings)
large = lambda **settings: bed(**{{"bed.length": 60, "bed.depth": 30, "tilt.rate": 1, "tilt.step": 0.005}}, **settings)

def refused(do):
    try:
        do()
    except talus.Error as error:
        return str(error)
    sys.exit("it was not refused")

def commit_in_a_thread(sim, ends=threading.Event()):
    def commits():
        while not ends.is_set():
            sim.step(1)
            sim.commit()
    thread = threading.Thread(target=commits, daemon=True)
    thread.start()
    return thread

def in_child(do):
    sys.stdout.flush()
    child = os.fork()
    if child == 0:
        do()
        sys.exit()
    deadline = time.monotonic() + 100
    while os.waitpid(child, os.WNOHANG) == (0, 0):
        if time.monotonic() > deadline:
            os.kill(child, signal.SIGABRT)  # faulthandler says where
            sys.exit("a child hangs")
        time.sleep(0.01)
"""


def script(text, *words, folder=None, **options):
    """Returns the output of a script."""
    running = subprocess.Popen([sys.executable, "-c", BEGIN + textwrap.dedent(text), *map(str, words)], cwd=folder, text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options)
    try:
        out, errors = running.communicate(timeout=300)
    except subprocess.TimeoutExpired:
        running.send_signal(signal.SIGABRT)  # faulthandler says where it hangs
        out, errors = running.communicate()
    assert running.returncode == 0, errors
    return out


def test_a_child_of_fork_looks_draws_and_copies_and_leaves_the_recording_alone(tmp_path):
    out = script("""
        sim = large(threads=2)
        sim.record("run.h5")
        sim.step(30)
        sim.draw("gamma", width=300)
        before = sim.state_hash
        def look(_):
            return sim.state_hash
        def child():
            for do in (sim.step, sim.run, sim.commit, lambda: sim.push(1, (0, 0)), lambda: setattr(sim, "friction", 0.1),
                       lambda: sim.record("other.h5")):
                assert "use copy() to create one" in refused(do)
            assert sim.state_hash == before and sim.tilt == 0 and len(sim.grains.position) == len(sim.grains)
            assert sim["kinetic_energy"] > 0 and sim.draw("gamma", width=300).shape[1] == 300
            copied = sim.copy()
            copied.step(5)
            print(copied.state_hash)
        in_child(child)
        in_child(lambda: None)
        with multiprocessing.get_context("fork").Pool(2) as pool:
            assert pool.map(look, range(4)) == [before] * 4
            sim.step(5)
            print(sim.state_hash)
            del sim
            talus.resume("run.h5").step(3)
        """, folder=tmp_path)
    first, second = out.split()
    assert first == second
    assert sorted(os.listdir(tmp_path)) == ["run.h5.run"]
    run_talus("info", tmp_path / "run.h5")


def test_a_child_of_fork_while_another_thread_steps():
    script("""
        sim = large()
        thread = threading.Thread(target=lambda: sim.step(10**6), daemon=True)
        thread.start()
        time.sleep(0.2)
        def child():
            assert "another thread" in refused(sim.step)
            assert "another thread" in refused(lambda: sim.tilt)
            own = bed()
            own.step(3)
            own.draw("gamma", width=300)
        in_child(child)
        """)


def test_a_child_of_fork_while_another_thread_records_writes_or_says_that_it_cannot_and_reads_nothing(tmp_path):
    script("""
        done = bed()
        done.record("done.h5")
        done.run()
        run = talus.open("done.h5")
        sim = large()
        sim.record("run.h5")
        commit_in_a_thread(sim)
        time.sleep(0.3)
        def child():
            try:
                bed().save(f"{os.getpid()}.h5")
            except talus.Error as error:
                assert "spawn" in str(error), error
            for do in (lambda: talus.open("done.h5"), lambda: run.frames[0].position, lambda: talus.resume("done.h5"),
                       lambda: bed(**{"deposition.method": "file", "deposition.file": "done.h5"})):
                try:
                    do()
                except talus.Error as error:
                    assert "spawn" in str(error) and error.exit_code == 69, error
                else:
                    os._exit(1)
            os._exit(0)  # as children of multiprocessing end: h5py, too, would wait for the lock of HDF5
        for _ in range(5):
            in_child(child)
        """, folder=tmp_path)


def test_a_file_is_walked_through_while_another_thread_records(tmp_path):
    script("""
        import shutil
        done = bed()
        done.record("done.h5")
        done.run()
        sim = bed(**{"bed.length": 30, "tilt.rate": 1, "tilt.step": 0.005})
        sim.record("run.h5")
        ends = threading.Event()
        thread = commit_in_a_thread(sim, ends)
        for k in range(30):
            shutil.copy("done.h5", f"{k}.h5")
            before = time.monotonic()
            talus.open(f"{k}.h5")
            assert time.monotonic() - before < 30, "the child of the walk hangs"
        ends.set()
        thread.join()
        """, folder=tmp_path)


#: Programs that a Ctrl-C ends, with what they print then.
INTERRUPTED = {
    "a pool": ("""
        with ThreadPoolExecutor(2) as pool:
            list(pool.map(lambda sim: sim.run(1e6), sims))
        """, ""),
    "more tasks than threads": ("""
        with ThreadPoolExecutor(2) as pool:
            for task in [pool.submit(sim.run, 1e6) for sim in sims + [sim.copy() for sim in sims]]:
                task.result()
        """, ""),
    "threads": ("""
        threads = [threading.Thread(target=sim.run, args=(1e6,)) for sim in sims]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        """, ""),
    "short calls": ("""
        def work():
            while True:
                sims[0].step(1)
                sims[0]["kinetic_energy"]
        thread = threading.Thread(target=work)
        thread.start()
        thread.join()
        """, ""),
    "between two calls": ("""
        interrupted = threading.Event()
        def work():
            interrupted.wait(0.5)
            sims[0].step(1)
            interrupted.wait()
            sims[0].step(1)
            print("not reached")
        thread = threading.Thread(target=work)
        thread.start()
        try:
            thread.join()
        finally:
            interrupted.set()
        """, ""),
    "asyncio": ("""
        import asyncio
        async def work():
            await asyncio.to_thread(sims[0].run, 1e6)
        asyncio.run(work())
        """, ""),
    "a later call": ("""
        pool = ThreadPoolExecutor(1)
        task = pool.submit(sims[0].run, 1e6)
        try:
            task.result()
        except KeyboardInterrupt:
            assert isinstance(task.exception(), KeyboardInterrupt)
        before = sims[0].step_count
        pool.submit(sims[0].step, 5).result()
        sims[0].step(5)
        pool.shutdown()
        sims[0].commit()
        print(sims[0].step_count - before)
        """, "10"),
    "a handler of the user": ("""
        ends = threading.Event()
        signal.signal(signal.SIGINT, lambda *_: ends.set())
        thread = threading.Thread(target=lambda: sims[0].run(until=ends.is_set, every=0.01))
        thread.start()
        thread.join()
        sims[0].commit()
        print(ends.is_set())
        """, "True"),
}


@pytest.mark.parametrize("way", INTERRUPTED)
def test_ctrl_c_ends_simulations_in_all_threads(tmp_path, way):
    text, expected = INTERRUPTED[way]
    begin = BEGIN + textwrap.dedent("""
        from concurrent.futures import ThreadPoolExecutor
        sims = [bed(**{"seed": seed, "bed.length": 40, "bed.depth": 20, "tilt.rate": 1, "tilt.step": 0.005}) for seed in (1, 2)]
        for k, sim in enumerate(sims):
            sim.record(f"{k}.h5")
            sim.step(1)
            sim.commit()
        print("go", flush=True)
        """)
    end = textwrap.dedent("""
        except KeyboardInterrupt:
            pass
        while len(sys._current_frames()) > 1:  # Python 3.11 takes a thread for ended if a signal interrupts its join
            time.sleep(0.01)
        print([talus.open(f"{k}.h5")["checkpoint/step"] == sim.step_count for k, sim in enumerate(sims)], flush=True)
        """)
    program = begin + "try:\n" + textwrap.indent(textwrap.dedent(text), "    ") + end
    process = subprocess.Popen([sys.executable, "-c", program], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        assert process.stdout.readline() == "go\n"
        time.sleep(0.7)
        process.send_signal(signal.SIGINT)
        out, error = process.communicate(timeout=60)
    finally:
        process.kill()
    lines = out.splitlines()
    assert process.returncode == 0, error
    assert lines == ([expected] if expected else []) + ["[True, True]"], out + error


def test_a_child_of_fork_while_another_thread_draws():
    script("""
        sim = bed()
        def draws():
            while True:
                sim.draw("gamma", width=300)
        threading.Thread(target=draws, daemon=True).start()
        time.sleep(0.5)
        def child():
            try:
                bed().draw("gamma", width=300)
            except talus.Error as error:
                assert "spawn" in str(error), error
        for _ in range(5):
            in_child(child)
            time.sleep(0.02)
        """)


def test_a_signal_that_forks_steps_no_bed_in_the_child(tmp_path):
    script("""
        sim = large()
        sim.record("run.h5")
        children = []
        def fork(*_):
            children.append(os.fork())
        signal.signal(signal.SIGALRM, fork)
        signal.setitimer(signal.ITIMER_REAL, 0.2)
        try:
            sim.step(600 if not children else 0)
        except talus.Error as error:
            assert children == [0] and "use copy() to create one" in str(error), error
            sys.exit()
        while not children:
            time.sleep(0.01)
        if children == [0]:
            sys.exit()
        assert os.waitpid(children[0], 0)[1] == 0
        """, folder=tmp_path)


@pytest.mark.parametrize("way", ["plain", "recorded", "callback", "again and again", "drawing", "progress"])
def test_the_interpreter_ends_while_a_thread_is_busy(tmp_path, way):
    out = script("""
        sim = large(progress=sys.argv[1] == "progress")
        way = sys.argv[1]
        if way == "recorded":
            sim.record("run.h5")
        def steps():
            while True:
                sim.step(1)
        def draws():
            while True:
                sim.draw("gamma", width=300)
        def callback():
            time.sleep(0.01)
            return False
        target = {"callback": lambda: sim.run(until=callback), "again and again": steps, "drawing": draws}.get(way, sim.run)
        threading.Thread(target=target, daemon=True).start()
        time.sleep(0.3)
        print("end")
        """, way, folder=tmp_path)
    assert out == "end\n"
    if way == "recorded":
        talus.resume(tmp_path / "run.h5").step(3)


def test_no_daemon_thread_uses_files_once_the_interpreter_ends(tmp_path):
    """With the interpreter it would wait for the lock of HDF5, while h5py, which has it, waits for the interpreter."""
    script("""
        sim = bed()
        sim.record("run.h5")
        sim.step(3)
        talus._core._end_steps()  # as at exit
        thread = threading.Thread(target=sim.commit, daemon=True)
        thread.start()
        thread.join(0.5)
        assert thread.is_alive()
        sim.commit()  # the main thread may
        """, folder=tmp_path)


def test_what_a_daemon_thread_holds_is_committed_at_the_end(tmp_path):
    out = script("""
        def hold():
            sim = bed()
            sim.record("run.h5")
            sim.step(40)
            print(sim.step_count, flush=True)
            time.sleep(1000)
        threading.Thread(target=hold, daemon=True).start()
        time.sleep(3)
        """, folder=tmp_path)
    assert talus.resume(tmp_path / "run.h5").step_count == int(out) == 40


def test_a_callback_that_never_returns_keeps_nobody():
    script("""
        sim = bed()
        never = threading.Event()
        threading.Thread(target=lambda: sim.run(until=never.wait), daemon=True).start()
        time.sleep(0.1)
        sim.step(3)  # it is not stepped meanwhile
        signal.signal(signal.SIGALRM, signal.default_int_handler)
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        try:
            sim.run(until=never.wait)
        except KeyboardInterrupt:
            sim.step(3)
        else:
            sys.exit("not interrupted")
        """)


def test_interruptions_at_any_moment_leave_a_whole_run(tmp_path):
    script("""
        signal.signal(signal.SIGALRM, signal.default_int_handler)
        sim = bed()
        sim.record("run.h5")
        delay, interrupted = 0.0003, 0
        while not sim.done:
            try:
                signal.setitimer(signal.ITIMER_REAL, delay)
                sim.step(7)
                sim.grains.position.sum(), sim["kinetic_energy"], sim.grains["pressure"]
                sim.run(0.01, until=lambda: False)
                sim.draw("gamma", width=200)
                time.sleep(0.2)
            except KeyboardInterrupt:
                interrupted += 1
            delay = delay * 1.3 if delay < 0.1 else 0.0003
        assert interrupted > 10, interrupted
        whole = bed()
        whole.run()
        assert whole.state_hash == sim.state_hash
        """, folder=tmp_path)
    run_talus("replay", tmp_path / "run.h5")


def test_a_full_disk_is_an_error_after_which_all_goes_on(tmp_path):
    out = script("""
        import resource
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        def allow(size):
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, resource.RLIM_INFINITY))
        whole = bed()
        whole.run()
        sim = bed()
        allow(100)
        assert refused(lambda: sim.record("none.h5")) and not sim.recorded and not os.path.exists("none.h5.run/manifest")
        allow(resource.RLIM_INFINITY)
        sim.record("run.h5")
        errors = 0
        sizes = [3000, 10**4, 10**5]
        while not sim.done:
            allow(sizes[sim.step_count // 40 % 3])
            try:
                sim.step(40)
            except talus.Error as error:
                assert error.exit_code == 74, error
                errors += 1
        assert errors > 3 and sim.state_hash == whole.state_hash
        allow(100)
        if sim.recorded:
            refused(sim.commit)
        allow(resource.RLIM_INFINITY)
        sim.commit()
        print(errors, sim.recorded)
        """, folder=tmp_path)
    assert re.fullmatch(r"\d+ False\n", out), "once there is room, the run is packed"
    run_talus("info", tmp_path / "run.h5")
    assert "recomputed" in run_talus("replay", tmp_path / "run.h5")


def test_paths_of_any_bytes(tmp_path):
    script(r"""
        name = b"\xff\xe4.h5"
        sim = bed()
        sim.record(name)
        assert "exists already" in refused(lambda: bed().record(name))
        sim.run()
        sim = bed()
        assert "xff" in refused(lambda: sim.record(name))
        for wrong in ("a\0b.h5", b"a\0b.h5", "", b"", None, 3, "\ud800.h5"):
            refused(lambda: bed().record(wrong))
        assert os.listdir(b".") == [name]
        """, folder=tmp_path)

