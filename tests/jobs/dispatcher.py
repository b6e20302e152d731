#!/usr/bin/python3
"""Ranks of `pounding` that wait for jobs, so that tests start MPI once and not for every run.

    dispatcher.py PLACE [--while PROCESS]   serves until its standard input ends, or until PROCESS has ended
    dispatcher.py PLACE --start             the same in the background, for as long as the caller's parent lives
    dispatcher.py PLACE --stop              ends that one

PLACE is a folder; clients connect to PLACE/jobs, send one line of JSON (ranks, words, folder, environment, timeout) and
get one: statuses, stdout and stderr; or `crashed` with what mpirun said; or `late`. Jobs start in the order in which they
come, on the first free ranks: as many at once as there are processors, one of several ranks alone. Where a rank dies or
a job takes too long, the ranks are started anew; a job that ran beside the culprit is run again, alone.
"""
import collections
import json
import os
import pathlib
import select
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time

HERE = pathlib.Path(__file__).resolve()
SOURCE = HERE.parents[2]
BUILD = pathlib.Path(os.environ.get("POUNDING_BUILD", SOURCE / "build")).resolve()
RANKS = 3
PROCESSORS = len(os.sched_getaffinity(0))
PATIENCE = 60  # s for ranks to start


class Died(Exception):
    """A rank is gone."""


class Gone(Died):
    """The client is gone: nobody waits for the job."""


class NotStarted(Exception):
    """The ranks do not come up; it holds what mpirun said."""


class Connection:
    """A socket, line by line."""

    def __init__(self, connected):
        self.socket = connected
        self.lines = connected.makefile("rwb")

    def send(self, text):
        try:
            self.lines.write(text.encode() + b"\n")
            self.lines.flush()
        except OSError as error:
            raise Died from error

    def receive(self, seconds=None):
        self.socket.settimeout(seconds)
        try:
            line = self.lines.readline()
        except TimeoutError:
            raise
        except OSError as error:
            raise Died from error
        if not line.endswith(b"\n"):
            raise Died
        return line.decode()

    def end(self):
        """Nothing goes either way any more, whoever waits at it sees so."""
        try:
            self.socket.shutdown(socket.SHUT_RDWR)
        except OSError:
            pass

    def close(self):
        for thing in (self.lines, self.socket):
            try:
                thing.close()
            except OSError:
                pass


class Ranks:
    """One mpirun of job_server."""

    def __init__(self, place):
        path = str(place / "ranks")
        if os.path.exists(path):
            os.unlink(path)
        self.said = tempfile.TemporaryFile()
        meshes = place / "meshes"  # see kept_meshes.cpp
        meshes.mkdir(exist_ok=True)
        with socket.socket(socket.AF_UNIX) as listening:
            listening.bind(path)
            listening.listen(RANKS)
            listening.settimeout(PATIENCE)
            line = 'source run/environment && exec mpirun -n "$1" "$2" "$3"'
            self.process = subprocess.Popen(["bash", "-c", line, "bash", str(RANKS), str(BUILD / "tests" / "job_server"), path],
                                            cwd=SOURCE, stdin=subprocess.DEVNULL, stdout=self.said, stderr=self.said,
                                            env={**os.environ, "POUNDING_KEPT_MESHES": str(meshes)},
                                            start_new_session=True)
            found = {}
            self.connections = []
            try:
                while len(found) < RANKS:
                    connection = Connection(listening.accept()[0])
                    self.connections.append(connection)
                    found[int(connection.receive(PATIENCE))] = connection
            except (TimeoutError, Died) as error:
                raise NotStarted(self.kill()) from error
        self.connections = [found[rank] for rank in range(RANKS)]

    def kill(self):
        """Ends the ranks; returns what mpirun said."""
        for connection in self.connections:
            connection.end()
        try:
            self.process.wait(2)
        except subprocess.TimeoutExpired:
            pass
        try:
            os.killpg(self.process.pid, signal.SIGTERM)
            self.process.wait(5)
        except (ProcessLookupError, subprocess.TimeoutExpired):
            self.process.kill()
        self.process.wait()
        self.said.seek(0)
        return self.said.read().decode(errors="replace")


class Dispatcher:
    def __init__(self, place):
        self.place = place
        self.turn = threading.Condition()
        self.waiting = collections.deque()
        self.ranks = None
        self.free = set(range(RANKS))
        self.running = []  # jobs on the present ranks
        self.number = 0
        self.starts = 0

    def run(self, job, client):
        """The answer to a client; Died where it has not waited for it."""
        for alone in (False, True):
            try:
                ticket = self.enter(job, alone)
            except NotStarted as error:
                return {"crashed": True, "stdout": "", "stderr": f"the ranks did not start: {error}"}
            try:
                return self.run_on_ranks(ticket, job, client)
            except TimeoutError:
                self.restart(ticket)
                return {"late": True}
            except Gone:
                self.restart(ticket)
                raise
            except Died:
                said = self.restart(ticket)
                if ticket["was_alone"]:
                    return {"crashed": True, "stdout": ticket["out"].read_text(errors="replace"),
                            "stderr": ticket["err"].read_text(errors="replace") + said}
            finally:
                self.leave(ticket)
        raise AssertionError("a job that ran alone died beside another")

    def enter(self, job, alone):
        """Waits for its turn; a job of several ranks, and one that is run again, has all processors."""
        ticket = {"whole": alone or job["ranks"] > 1, "was_alone": True}
        with self.turn:
            self.waiting.append(ticket)
            while self.waiting[0] is not ticket or not self.has_room(ticket):
                self.turn.wait()
            self.waiting.popleft()
            if self.ranks is None:
                try:
                    self.ranks = Ranks(self.place)
                except NotStarted:
                    self.turn.notify_all()
                    raise
                self.free = set(range(RANKS))
                self.starts += 1
            self.number += 1
            ticket.update(number=self.number, ranks=sorted(self.free)[:job["ranks"]], on=self.ranks,
                          out=self.place / f"out-{self.number}", err=self.place / f"err-{self.number}")
            self.free -= set(ticket["ranks"])
            for other in self.running:
                other["was_alone"] = ticket["was_alone"] = False
            self.running.append(ticket)
            self.turn.notify_all()
        return ticket

    def has_room(self, ticket):
        if ticket["whole"] or any(other["whole"] for other in self.running):
            return not self.running
        return len(self.running) < PROCESSORS

    def run_on_ranks(self, ticket, job, client):
        for path in (ticket["out"], ticket["err"]):
            path.touch()
        words = {"ranks": ticket["ranks"], "number": ticket["number"], "words": job["words"], "folder": job["folder"],
                 "environment": job["environment"], "stdout": str(ticket["out"]), "stderr": str(ticket["err"])}
        chosen = [ticket["on"].connections[rank] for rank in ticket["ranks"]]
        for connection in chosen:
            connection.send(json.dumps(words))
        end = time.monotonic() + job["timeout"]
        statuses = []
        for connection in chosen:
            # A client says nothing more, so that a word from it is its end; what a rank says is one line.
            while not (said := select.select([connection.socket, client.socket], [], [], max(0.01, end - time.monotonic()))[0]):
                if time.monotonic() > end:
                    raise TimeoutError
            if connection.socket not in said:
                raise Gone
            statuses.append(int(connection.receive(PATIENCE)))
        return {"statuses": statuses, "stdout": ticket["out"].read_text(errors="replace"),
                "stderr": ticket["err"].read_text(errors="replace")}

    def restart(self, ticket):
        """Ends the ranks that a job was on, so that the next job starts others; returns what mpirun said."""
        with self.turn:
            said = ticket["on"].kill()
            if self.ranks is ticket["on"]:
                self.ranks = None
            return said

    def leave(self, ticket):
        with self.turn:
            self.running.remove(ticket)
            if self.ranks is ticket["on"]:
                self.free |= set(ticket["ranks"])
            self.turn.notify_all()
        for path in (ticket["out"], ticket["err"]):
            path.unlink(missing_ok=True)

    def answer(self, connection):
        try:
            job = json.loads(connection.receive())
            connection.send(json.dumps(self.run(job, connection)))
        except Died:
            pass
        finally:
            connection.close()

    def serve(self, goes_on):
        path = self.place / "jobs"
        with socket.socket(socket.AF_UNIX) as listening:
            listening.bind(str(path) + ".new")
            listening.listen(16)
            os.rename(str(path) + ".new", path)  # whoever finds it can connect
            listening.settimeout(0.5)
            while goes_on():
                try:
                    connected, _ = listening.accept()
                except TimeoutError:
                    continue
                connected.setblocking(True)
                threading.Thread(target=self.answer, args=(Connection(connected),), daemon=True).start()
        with self.turn:
            if self.ranks is not None:
                self.ranks.kill()
            (self.place / "jobs-run").write_text(f"{self.number} jobs, {self.starts} starts of the ranks\n")
        path.unlink(missing_ok=True)


def lives(process):
    """Whether a process is there, and not just a row of the table that nobody has read."""
    try:
        return pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def serve(place, process=None):
    place.mkdir(parents=True, exist_ok=True)
    stop = threading.Event()
    signal.signal(signal.SIGTERM, lambda *_: stop.set())
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if process is None:
        threading.Thread(target=lambda: (sys.stdin.read(), stop.set()), daemon=True).start()
    Dispatcher(place).serve(lambda: not stop.is_set() and (process is None or lives(process)))


def start(place):
    """In the background: ctest's own process is the parent of the test that starts it."""
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir(parents=True)
    with open(place / "log", "w") as log:
        served = subprocess.Popen([sys.executable, HERE, str(place), "--while", str(os.getppid())],
                                  stdin=subprocess.DEVNULL, stdout=log, stderr=log, start_new_session=True)
    (place / "process").write_text(str(served.pid))
    end = time.monotonic() + PATIENCE
    while not (place / "jobs").exists():
        if served.poll() is not None or time.monotonic() > end:
            sys.exit("the dispatcher did not start: " + (place / "log").read_text())
        time.sleep(0.02)


def stop(place):
    process = int((place / "process").read_text())
    if lives(process):
        os.kill(process, signal.SIGTERM)
    end = time.monotonic() + PATIENCE
    while lives(process):
        if time.monotonic() > end:
            sys.exit("the dispatcher does not end")
        time.sleep(0.05)
    print((place / "jobs-run").read_text(), end="")


def main(words):
    place = pathlib.Path(words[0])
    if words[1:] == ["--start"]:
        start(place)
    elif words[1:] == ["--stop"]:
        stop(place)
    else:
        serve(place, int(words[2]) if words[1:2] == ["--while"] else None)


if __name__ == "__main__":
    main(sys.argv[1:])
