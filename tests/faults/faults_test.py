"""Faults while a run works: a rank killed, memory or disk used up, the folder gone, SIGTERM while a
checkpoint is written. The job ends everywhere within seconds with a status that is not zero and, where a
rank is left to speak, one line; the last checkpoint is whole and is gone on from; nothing of the ranks'
common memory is left. Each fault is tried POUNDING_FAULTS times (3), on 2 ranks; a table of counts is
printed."""
import atexit
import os
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
import zlib

import h5py

import program

PROCESSORS = 2  # killed ranks, sockets

TRIES = int(os.environ.get("POUNDING_FAULTS", "3"))
SECONDS = 60  # a job that has not ended by then hangs, also on a busy machine
RANKS = 2

BAR = ["-structures", "bar", "-bar_mesh", "tests/meshes/box.geo", "-bar_body_element", "hex8_full",
       "-bar_body_material", "soft", "-material_soft_young", 900, "-material_soft_poisson", 0.2,
       "-material_soft_density", 1, "-bar_damping_beta", 1e-4, "-bar_gravity", "0.1,0,-10",
       "-contacts", "stop", "-stop_secondary", "bar:z_min", "-stop_primary", "wall", "-stop_gap", 0.5,
       "-energy_interval", 400, "-probes", "top", "-top_structure", "bar", "-top_group", "z_max",
       "-modes", 0, "-spectra_frequencies", "1:20:5lin", "-end_time", 1e5]
SMALL = BAR + ["-bar_mesh_set", "lz=10,nz=20", "-output_interval", 0.02]
LARGE = BAR + ["-bar_mesh_set", "lx=4,ly=4,lz=10,nx=16,ny=16,nz=40", "-output_interval", 1]

# Where Open MPI keeps its own segments, so that those of other programs do not count.
SEGMENTS = tempfile.mkdtemp(prefix="pounding-segments-", dir="/dev/shm")
atexit.register(shutil.rmtree, SEGMENTS, ignore_errors=True)
ENVIRONMENT = {**program.ENVIRONMENT, "OMPI_MCA_btl_vader_backing_directory": SEGMENTS,
               "OMPI_MCA_btl_sm_backing_directory": SEGMENTS}  # by releases 4 and 5

TABLE = {}


def segments():
    """Segments of common memory that ranks have left."""
    return os.listdir(SEGMENTS)


def ranks_of(pid):
    with open(f"/proc/{pid}/task/{pid}/children") as file:
        return [int(child) for child in file.read().split()]


def is_sealed(path):
    with open(path, "rb") as file:
        head = file.read(512).rstrip(b"\0").decode()
        content = file.read()
    return head == f"pounding seal 1\nbytes {len(content)}\ncrc32 {zlib.crc32(content):08x}\n"


class Job:
    """The program at work, in a folder of its own."""

    def __init__(self, folder, arguments, before=()):
        words = program.words([*arguments, "-output", folder], RANKS)
        place = words.index(program.PROGRAM)
        self.folder = folder
        self.error = tempfile.TemporaryFile("w+")
        self.process = subprocess.Popen(words[:place] + list(before) + words[place:],
                                        cwd=program.SOURCE, env=ENVIRONMENT,
                                        stdout=subprocess.DEVNULL, stderr=self.error)

    def wait_for(self, *names, seconds=120):
        """Until one of the files is there, and the process works."""
        deadline = time.time() + seconds
        while not any(os.path.exists(os.path.join(self.folder, name)) for name in names):
            if self.process.poll() is not None or time.time() > deadline:
                raise AssertionError(f"no {names}: " + self.said())
            time.sleep(0.001)

    def ranks(self):
        return ranks_of(self.process.pid)

    def said(self):
        self.error.seek(0)
        return self.error.read()


class Sockets(unittest.TestCase):
    """What the ranks of this machine listen at, without the variables that run/environment sets."""

    def listening(self, ranks):
        """Ports at which processes of a run listen at any address, by the name of the process."""
        folder = tempfile.mkdtemp(prefix="pounding-sockets-")
        words = program.words([*SMALL, "-output", folder], ranks)
        plain = {name: value for name, value in program.ENVIRONMENT.items()
                 if not name.startswith(("OMPI_MCA_btl", "OMPI_MCA_pml", "OMPI_MCA_ess"))}
        with open(os.path.join(folder, "log"), "w") as log:
            job = subprocess.Popen(words if ranks > 1 else words[words.index(program.PROGRAM):], cwd=program.SOURCE, env=plain,
                                   stdout=log, stderr=log, start_new_session=True)
            try:
                deadline = time.time() + SECONDS
                while not os.path.exists(os.path.join(folder, "history.h5")):
                    self.assertLess(time.time(), deadline)
                    self.assertIsNone(job.poll())
                    time.sleep(0.01)
                return self.sockets_of([job.pid, *ranks_of(job.pid)])
            finally:
                os.killpg(job.pid, signal.SIGKILL)
                job.wait()

    def sockets_of(self, processes):
        any_address = {}
        for family in ("tcp", "tcp6"):
            with open(f"/proc/net/{family}") as table:
                for row in [line.split() for line in table][1:]:
                    if row[3] == "0A" and not row[1].startswith("0100007F:"):
                        any_address[f"socket:[{row[9]}]"] = int(row[1].split(":")[1], 16)
        found = {}
        for process in processes:
            with open(f"/proc/{process}/comm") as file:
                ports = found.setdefault(file.read().strip(), [])
            for name in os.listdir(f"/proc/{process}/fd"):
                target = os.readlink(f"/proc/{process}/fd/{name}")
                ports += [any_address[target]] if target in any_address else []
        return found

    def test_one_rank_listens_nowhere(self):
        self.assertEqual(self.listening(1), {"pounding": []})

    def test_nor_do_two(self):
        self.assertEqual(self.listening(2)["pounding"], [])  # mpirun itself does


class Faults(unittest.TestCase):
    def setUp(self):
        self.base = tempfile.mkdtemp(prefix="pounding-faults-")
        self.addCleanup(shutil.rmtree, self.base, ignore_errors=True)
        self.folder = os.path.join(self.base, "run")
        os.mkdir(self.folder)

    def ends(self, name, job, since, statuses, message):
        """Waits for the end of a job that met a fault at `since`; keeps what the table tells."""
        try:
            status = job.process.wait(SECONDS)
        except subprocess.TimeoutExpired:
            for pid in [*job.ranks(), job.process.pid]:
                os.kill(pid, signal.SIGKILL)
            self.fail(f"{name}: the job hangs after {SECONDS} s; {job.said()[-2000:]}")
        seconds = time.time() - since
        said = job.said()
        lines = [line for line in said.splitlines() if line.startswith("pounding: ")]
        row = TABLE.setdefault(name, {"tries": 0, "slowest": 0.0, "lines": 0, "whole": 0, "continued": 0,
                                      "statuses": set()})
        row["tries"] += 1
        row["slowest"] = max(row["slowest"], seconds)
        row["statuses"].add(status)
        self.assertNotEqual(status, 0, said)
        if statuses:
            self.assertIn(status, statuses, said[-2000:])
        if message:
            self.assertEqual(len(lines), 1, said[-4000:])
            self.assertIn(message, lines[0])
            self.assertNotIn("HDF5-DIAG", said)
            self.assertNotIn("PETSC ERROR", said)
            row["lines"] += 1
        self.assertFalse(os.path.exists(os.path.join(self.folder, "summary.json")))
        return row

    def goes_on(self, row, arguments):
        """The last checkpoint is whole; the run after it reads it and leaves no segment behind."""
        path = os.path.join(self.folder, "checkpoint.h5")
        self.assertTrue(is_sealed(path))
        row["whole"] += 1
        result = subprocess.run(program.words([*arguments, "-restart", path, "-dry_run"], RANKS),
                                cwd=program.SOURCE, env=ENVIRONMENT, capture_output=True, text=True,
                                timeout=120)
        self.assertEqual(result.returncode, 0, result.stderr)
        row["continued"] += 1
        self.assertEqual(segments(), [])

    def emptied(self):
        for name in os.listdir(self.folder):
            os.remove(os.path.join(self.folder, name))

    def test_a_rank_is_killed(self):
        case = SMALL + ["-checkpoint_steps", 500]
        for i in range(TRIES):
            job = Job(self.folder, case)
            job.wait_for("checkpoint.h5")
            time.sleep(0.01 * (i % 7))
            since = time.time()
            os.kill(job.ranks()[i % RANKS], signal.SIGKILL)
            self.goes_on(self.ends("a rank is killed", job, since, (), None), case)
            self.emptied()

    def test_sigterm_while_a_checkpoint_is_written(self):
        case = SMALL + ["-checkpoint_steps", 50]
        for i in range(TRIES):
            job = Job(self.folder, case)
            job.wait_for("checkpoint.h5")
            job.wait_for("checkpoint.h5.new")
            since = time.time()
            os.kill(job.ranks()[i % RANKS], signal.SIGTERM)
            row = self.ends("SIGTERM in a checkpoint", job, since, (2,), "stopped by SIGTERM")
            self.goes_on(row, case)
            self.emptied()

    def test_the_folder_vanishes(self):
        for _ in range(TRIES):
            job = Job(self.folder, SMALL + ["-checkpoint_steps", 2000])
            job.wait_for("checkpoint.h5")
            since = time.time()
            shutil.move(self.folder, self.folder + "-elsewhere")
            row = self.ends("the folder vanishes", job, since, (1,), "the checkpoint cannot be written")
            shutil.move(self.folder + "-elsewhere", self.folder)
            self.goes_on(row, SMALL)
            self.emptied()

    def fill_up(self, name):
        """The history grows until it cannot: of its rows, those that count are whole."""
        case = SMALL + ["-checkpoint_steps", 2000, "-output_interval", 0.004]
        for _ in range(TRIES):
            job = Job(self.folder, case)
            job.wait_for("checkpoint.h5")
            path = os.path.join(self.folder, "history.h5")
            size, since = -1, time.time()
            while job.process.poll() is None and time.time() < since + SECONDS:
                if os.path.getsize(path) != size:
                    size, since = os.path.getsize(path), time.time()
                time.sleep(0.1)
            row = self.ends(name, job, since, (1,), "is the disk full?")
            self.goes_on(row, case)
            with h5py.File(path, "r", swmr=True, libver="latest") as file:
                records = int(file["records"][0])
                self.assertEqual(file.attrs["complete"], 0)
                self.assertGreater(records, 0)
                times = file["time"][:records]
                self.assertTrue((times[1:] > times[:-1]).all())
                self.assertTrue((file["acceleration"][1:records, 2] != 0).all())
            self.emptied()

    def test_the_disk_is_full(self):
        self.mount("1000k")
        self.fill_up("the disk is full")

    def mount(self, size):
        """A small file system in the folder of the run."""
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "none", self.folder], capture_output=True)
        if mounted.returncode != 0:
            self.skipTest("no right to mount a small file system")
        self.addCleanup(subprocess.run, ["umount", "--lazy", self.folder], capture_output=True)

    def small_disks(self, name, arguments, sizes, ranks, last):
        """On a disk of any size a run ends well, or with one line, and without the file that it writes last."""
        row = TABLE.setdefault(name, {"tries": 0, "slowest": 0.0, "lines": 0, "whole": 0, "continued": 0, "statuses": set()})
        for size in sizes:
            self.mount(f"{size}k")
            since = time.time()
            result = program.run([*arguments, "-output", self.folder], ranks, 120, environment=ENVIRONMENT)
            row["tries"] += 1
            row["slowest"] = max(row["slowest"], time.time() - since)
            row["statuses"].add(result.returncode)
            if result.returncode != 0:
                self.assertEqual(result.returncode, 1, f"{size} kB: {result.stderr[-2000:]}")
                lines = program.error_lines(result)
                self.assertEqual(len(lines), 1, result.stderr[-2000:])
                self.assertRegex(lines[0], "disk|No space left")
                row["lines"] += 1
                self.assertFalse(os.path.exists(os.path.join(self.folder, last)), size)
            subprocess.run(["umount", self.folder], check=True)
        self.assertEqual(result.returncode, 0, result.stderr[-2000:])
        self.assertGreater(row["lines"], 0)

    def test_small_disks(self):
        short = BAR + ["-bar_mesh_set", "lz=4,nz=4", "-end_time", 2, "-output_interval", 0.02, "-fields_interval", 0.2,
                       "-write_model", "-checkpoint_steps", 200]
        self.small_disks("small disks", short, (8, 32, 64, 128, 192, 256, 4000), RANKS, "summary.json")

    def test_small_disks_of_ensembles(self):
        table = os.path.join(self.base, "members.csv")
        with open(table, "w") as file:
            file.write("motion_level\n" + "1\n2\n" * 20)
        wave = os.path.join(self.base, "wave.txt")
        with open(wave, "w") as file:
            file.writelines(f"{0.01 * i:.2f} {(-1) ** i}\n" for i in range(20))
        words = BAR + ["-bar_mesh_set", "lz=4,nz=4", "-bar_gravity", "0,0,0", "-bar_model", "modal", "-bar_modal_vectors", 6,
                       "-bar_allow_loose", "-ensemble", table, "-motion_x_record", wave, "-motion_x_unit", "m/s2",
                       "-end_time", 0.2, "-output_interval", 0.02]
        self.small_disks("small disks of ensembles", words, (8, 24, 48, 64, 4000), RANKS, "ensemble.csv")

    def test_no_addresses_for_the_blas(self):
        """OpenBLAS asks for its 128 MB for ever; what is left under the limit is a line at once."""
        words = [*SMALL, "-bar_damping_beta", 0, "-bar_damping_uniform", 0.05, "-bar_damping_band", "1,20", "-dry_run",
                 "-output", self.folder]
        result = subprocess.run(["prlimit", f"--as={300 << 20}", program.PROGRAM, *map(str, words)], cwd=program.SOURCE,
                                env=ENVIRONMENT, capture_output=True, text=True, timeout=SECONDS)
        self.assertEqual(result.returncode, 1, result.stderr)
        line, = program.error_lines(result)
        self.assertIn("out of memory on rank 0", line)

    def test_memory_runs_out(self):
        """Limits from what the small scene needs up to what the large one does."""
        job = Job(self.folder, SMALL)
        job.wait_for("history.h5")
        needed = []
        for pid in job.ranks():
            with open(f"/proc/{pid}/status") as file:
                needed += [int(line.split()[1]) << 10 for line in file if line.startswith("VmPeak")]
        for pid in job.ranks():
            os.kill(pid, signal.SIGTERM)
        job.process.wait(SECONDS)
        self.emptied()
        for i in range(TRIES):
            limit = max(needed) + (4 << 20) + i * (24 << 20) // TRIES
            since = time.time()
            job = Job(self.folder, LARGE, ["prlimit", f"--as={limit}"])
            self.ends("memory runs out", job, since, (), "out of memory on rank")
            self.emptied()
        after = Job(self.folder, SMALL)
        after.wait_for("history.h5")
        os.kill(after.ranks()[0], signal.SIGTERM)
        self.assertEqual(after.process.wait(SECONDS), 2)
        self.assertEqual(segments(), [])


def tearDownModule():
    print(f"\n{'fault':28} {'tried':>6} {'ended':>6} {'slowest s':>9} {'one line':>9} {'whole':>6} "
          f"{'gone on':>8}  status")
    for name, row in sorted(TABLE.items()):
        print(f"{name:28} {row['tries']:6} {row['tries']:6} {row['slowest']:9.1f} {row['lines']:9} "
              f"{row['whole']:6} {row['continued']:8}  {sorted(row['statuses'])}")


if __name__ == "__main__":
    unittest.main()
