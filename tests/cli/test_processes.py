#!/usr/bin/env python3
"""The program among other processes: signals, locks, streams that are closed, small limits of the system, leftovers.

The environment gives CONTACT_PROGRAM and CONTACT_SOURCE.
"""
import fcntl
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import socket
import subprocess
import tempfile
import time
import unittest

from small_case import case, endless

PROGRAM = os.environ["CONTACT_PROGRAM"]
SOURCE = pathlib.Path(os.environ["CONTACT_SOURCE"])
#: Sanitizers use unlimited address space and large stacks (tests/support/sanitize.sh sets this)
IS_INSTRUMENTED = "CONTACT_SLOWER" in os.environ


class Scratch(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")

    def start(self, *arguments, **options):
        settings = dict(cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        process = subprocess.Popen([PROGRAM, *arguments], **{**settings, **options})
        self.addCleanup(self.end, process)
        return process

    @staticmethod
    def end(process):
        if process.poll() is None:
            process.kill()
        process.communicate()

    def run_program(self, *arguments, **options):
        process = self.start(*arguments, **options)
        try:
            out, err = process.communicate(timeout=60)
        except subprocess.TimeoutExpired:
            self.fail("%s does not end" % (arguments,))
        return process.returncode, out or "", err or ""

    def wait_for(self, what, seconds=30.0):
        start = time.monotonic()
        while not what():
            self.assertLess(time.monotonic() - start, seconds, "waited in vain")
            time.sleep(0.002)

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())


class Signals(Scratch):
    def many(self, name="many", number=400):
        self.write(name + ".inp", case(40) * number + "0\n")

    def finished(self, name="many"):
        """Number of cases in the JSON file so far"""
        path = self.folder / (name + ".jsonl")
        return path.read_text(encoding="utf-8").count("\n") if path.exists() else 0

    def test_first_signal_ends_behind_the_case(self):
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            self.many()
            (self.folder / "many.jsonl").unlink(missing_ok=True)
            process = self.start("--json", "2", "many")
            self.wait_for(lambda: self.finished() >= 3)
            process.send_signal(number)
            out, err = process.communicate(timeout=60)
            self.assertEqual(process.returncode, 128 + number)
            name = signal.Signals(number).name[3:]
            self.assertIn("the run was ended by signal %s before case" % name, err)
            self.assertIn("a second signal ends it at once", err)
            lines = [json.loads(line) for line in (self.folder / "many.jsonl").read_text(encoding="utf-8").splitlines()]
            done = len([line for line in lines if line["case"] > 0])
            self.assertTrue(0 < done < 400, done)
            self.assertIn("%d cases: %d solved" % (done, done), out)
            report = (self.folder / "many.out").read_text(encoding="utf-8")
            self.assertEqual(report.count(" Case "), done)
            self.assertIn("ended by signal", report)
            self.assertEqual([name for name in self.names() if name.endswith((".lock", ".tmp"))], [])

    def test_second_signal_ends_at_once(self):
        self.write("long.inp", endless() + case() + "0\n")
        process = self.start("2", "long")
        self.wait_for(lambda: (self.folder / "long.out").exists())
        time.sleep(0.2)
        process.send_signal(signal.SIGTERM)
        with self.assertRaises(subprocess.TimeoutExpired):
            process.wait(0.3)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(5.0), 128 + signal.SIGINT)

    def test_ignored_signals_stay_ignored(self):
        self.many(number=20)
        process = self.start("2", "many", preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        self.wait_for(lambda: (self.folder / "many.out").exists())
        process.send_signal(signal.SIGHUP)
        out, err = process.communicate(timeout=60)
        self.assertEqual((process.returncode, err), (0, ""))
        self.assertIn("20 solved", out)

    def test_reader_of_the_output_goes_away(self):
        self.many()
        process = self.start("--json=-", "2", "many")
        process.stdout.readline()
        process.stdout.close()
        self.assertEqual(process.wait(60), 128 + signal.SIGPIPE)
        self.assertIn("signal PIPE", process.stderr.read())
        report = (self.folder / "many.out").read_text(encoding="utf-8")
        self.assertIn("signal PIPE", report)
        self.assertIn("CONTACT ended with errors", report)

    def test_a_question_ends_at_once(self):
        process = self.start(stdin=subprocess.PIPE)
        time.sleep(0.2)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(5.0), -signal.SIGINT)


class Locks(Scratch):
    def test_second_run_is_told_who_is_there(self):
        self.write("a.inp", endless() + "0\n")
        first = self.start("2", "a")
        self.wait_for(lambda: (self.folder / "a.out").exists() and (self.folder / "a.lock").read_text())
        before = (self.folder / "a.out").stat().st_ino
        status, _, err = self.run_program("--hdf5", "2", "a")
        self.assertEqual(status, 1)
        self.assertRegex(err, r"a\.lock: another run .*process %d on %s since 20\d\d-\d\d-\d\d \d\d:\d\d:\d\d; wait"
                         % (first.pid, socket.gethostname()))
        self.assertEqual((self.folder / "a.out").stat().st_ino, before)
        self.assertFalse((self.folder / "a.h5").exists())
        # checking writes nothing, another folder is another run, another experiment too
        self.assertEqual(self.run_program("3", "a")[0], 0)
        (self.folder / "out").mkdir()
        self.write("b.inp", case() + "0\n")
        self.assertEqual(self.run_program("2", "b")[0], 0)
        other = self.start("--output-dir", "out", "2", "a")
        self.wait_for(lambda: (self.folder / "out" / "a.out").exists())
        other.kill()
        # a killed run locks out no other, and its lock and its unfinished files are removed by the next one
        first.kill()
        first.wait()
        self.assertTrue((self.folder / "a.lock").exists())
        self.write("a.inp", case() + "0\n")
        ours = ["a.0001.mat.tmp", "a_re012.0002b.mat.tmp", "a.0001.block1.vts.tmp", "a.h5.tmp", "a.h5.part"]
        others = ["a.b.h5.tmp", "ab.0001.mat.tmp", "a.tmp", "a.0001.h5.tmp", "a.0001.mat.old", "a.0001.txt.tmp", "a.1.0001.mat.tmp"]
        for name in ours + others:
            self.write(name, "left behind")
        self.assertEqual(self.run_program("2", "a")[0], 0)
        self.assertEqual([name for name in ours if name in self.names()], [])
        self.assertEqual([name for name in others if name not in self.names()], [])
        self.assertNotIn("a.lock", self.names())

    def test_without_a_lock_the_run_goes_on(self):
        self.write("a.inp", case() + "0\n")
        (self.folder / "a.lock").mkdir()
        status, out, _ = self.run_program("2", "a")
        self.assertEqual(status, 0)
        self.assertIn("could not be locked", out)
        self.assertIn("could not be locked", (self.folder / "a.out").read_text(encoding="utf-8"))

    def test_a_lock_of_this_process_counts(self):
        self.write("a.inp", case() + "0\n")
        with open(self.folder / "a.lock", "w", encoding="utf-8") as file:
            fcntl.flock(file, fcntl.LOCK_EX)
            status, _, err = self.run_program("2", "a")
        self.assertEqual(status, 1)
        self.assertIn("a process that did not give its name", err)


class Surroundings(Scratch):
    def setUp(self):
        super().setUp()
        shutil.copy(SOURCE / "examples" / "cattaneo.inp", self.folder / "a.inp")

    def test_files_that_never_end(self):
        os.mkfifo(self.folder / "pipe.inp")
        os.symlink("/dev/zero", self.folder / "zero.inp")
        (self.folder / "folder.inp").mkdir()
        for name in ("pipe", "zero", "folder"):
            status, _, err = self.run_program("2", name)
            self.assertEqual(status, 1, name)
            self.assertIn("not a regular file", err, name)
        os.mkfifo(self.folder / "a.out")
        status, _, err = self.run_program("2", "a")
        self.assertEqual(status, 1)
        self.assertIn("not a regular file", err)

    def test_results_that_are_links_to_the_input(self):
        before = (self.folder / "a.inp").read_text(encoding="utf-8")
        for link in (os.symlink, os.link):
            for suffix in ("out", "jsonl", "pvd", "h5", "unfinished", "0002.mat", "0002.vts"):
                path = self.folder / ("a." + suffix)
                path.unlink(missing_ok=True)
                link(self.folder / "a.inp", path)
                status, _, err = self.run_program("--json", "--vtk", "--hdf5", "2", "a")
                self.assertEqual((self.folder / "a.inp").read_text(encoding="utf-8"), before, suffix)
                # others have a temporary name first, and replace the link
                if suffix in ("out", "jsonl", "pvd", "unfinished"):
                    self.assertEqual(status, 1, suffix)
                    self.assertIn("link to the input", err, suffix)
                    path.unlink()
                else:
                    self.assertEqual((status, err), (0, ""), suffix)
                    self.assertFalse(path.samefile(self.folder / "a.inp"), suffix)

    @unittest.skipIf(IS_INSTRUMENTED, "sanitizers need address space")
    def test_small_limits_of_the_system(self):
        def limited(*limits):
            def limit():
                for kind, value in limits:
                    resource.setrlimit(kind, (value, value))
            return limit
        # of the stack 57 (gfortran 12) to 65 kB (gfortran 14) are needed, with the environment, whatever the size of a problem
        for name, limits in (("memory", [(resource.RLIMIT_AS, 150000 * 1024)]), ("stack", [(resource.RLIMIT_STACK, 96 * 1024)]),
                             ("files", [(resource.RLIMIT_NOFILE, 16)])):
            status, _, err = self.run_program("2", "a", preexec_fn=limited(*limits))
            self.assertEqual((status, err), (0, ""), name)
        status, _, err = self.run_program("2", "a", env=dict(os.environ, OMP_STACKSIZE="64k"))
        self.assertEqual((status, err), (0, ""))
        # a file that may not grow is an error, not an end
        status, _, err = self.run_program("2", "a", preexec_fn=limited((resource.RLIMIT_FSIZE, 2000)))
        self.assertEqual(status, 1)
        self.assertIn("not complete", err)

    @unittest.skipIf(IS_INSTRUMENTED, "sanitizers need address space")
    def test_little_memory_for_a_wheel_with_hdf5(self):
        """Requests of HDF5 are not refused when the solver has run out of memory: its free lists do not stand that"""
        os.symlink(SOURCE / "examples" / "profiles", self.folder / "profiles")
        shutil.copy(SOURCE / "examples" / "single_wheel.inp", self.folder / "w.inp")
        for megabytes in range(42, 54):
            limit = 1000000 * megabytes
            status, _, err = self.run_program("--quiet", "--threads", "1", "--hdf5", "2", "w",
                                              preexec_fn=lambda at=limit: resource.setrlimit(resource.RLIMIT_AS, (at, at)))
            # 127: the system has not enough to load the program
            self.assertIn(status, (0, 1, 127), (megabytes, err[:200]))
            self.assertEqual(err == "", status == 0, megabytes)

    def test_variables_of_the_run_time_library(self):
        self.assertEqual(self.run_program("--json", "2", "a")[0], 0)

        def outputs():
            lines = (self.folder / "a.jsonl").read_text(encoding="utf-8").splitlines()
            return [{key: value for key, value in json.loads(line).items() if key != "seconds"} for line in lines]
        before = outputs()
        for variable in ("STDERR_UNIT=6", "STDOUT_UNIT=0", "STDIN_UNIT=6", "OPTIONAL_PLUS=1", "UNBUFFERED_ALL=1",
                         "CONVERT_UNIT=big_endian", "DEFAULT_RECL=20", "FORMATTED_BUFFER_SIZE=1", "LIST_SEPARATOR=x"):
            name, value = variable.split("=")
            status, _, err = self.run_program("--json", "2", "a", env=dict(os.environ, **{"GFORTRAN_" + name: value}))
            self.assertEqual((status, err), (0, ""), variable)
            self.assertEqual(outputs(), before, variable)

    def test_threads_wait_briefly(self):
        """libgomp tells its settings on request; a choice of the user counts, and the list of variables is not made longer"""
        def tests_before_sleep(**variables):
            run = subprocess.run([PROGRAM, "--version"], env=dict(variables, OMP_DISPLAY_ENV="verbose"), capture_output=True,
                                 text=True, timeout=60, check=True)
            found = re.search(r"GOMP_SPINCOUNT = '(\d+)'", run.stderr)
            if not found:
                self.skipTest("this OpenMP library does not tell how threads wait")
            return int(found[1])
        default = tests_before_sleep()
        for name in ("OLDPWD", "_", "SHLVL"):
            self.assertEqual(tests_before_sleep(**{name: "1"}), 1000, name)
            self.assertEqual(tests_before_sleep(**{name: "1", "GFORTRAN_CONVERT_UNIT": "big_endian"}), 1000, name)
        self.assertEqual(tests_before_sleep(MY_OLDPWD="1"), default)
        self.assertEqual(tests_before_sleep(OLDPWD="1", GOMP_SPINCOUNT="7"), 7)
        self.assertGreater(tests_before_sleep(OLDPWD="1", OMP_WAIT_POLICY="active"), 1000)

    def test_closed_streams(self):
        self.run_program("2", "a")
        before = (self.folder / "a.out").read_text(encoding="utf-8")

        def close(*streams):
            return lambda: [os.close(stream) for stream in streams]
        for streams in ((0,), (1,), (2,), (0, 1, 2)):
            status, _, _ = self.run_program("2", "a", preexec_fn=close(*streams))
            self.assertEqual(status, 0, streams)
            report = (self.folder / "a.out").read_text(encoding="utf-8")
            self.assertEqual(report.count("\n"), before.count("\n"), streams)
        for streams in ((0, 1, 2), (2,)):
            self.write("wrong.inp", "3\nnonsense\n")
            self.assertEqual(self.run_program("2", "wrong", preexec_fn=close(*streams))[0], 1, streams)
            self.assertNotIn("ERROR. wrong.inp", (self.folder / "wrong.inp").read_text(encoding="utf-8"))
        self.assertEqual(self.run_program(preexec_fn=close(0))[0], 1)
        self.assertEqual(self.run_program("--json=-", "2", "a", preexec_fn=close(1))[0], 1)

    def test_command_lines(self):
        """Arguments of an invalid command line, exit status, and a part of the message"""
        folder = self.folder
        for name in ("b c", "-dash", "ünïcode", "..", "new\nline", "x" * 200, "a;b", "$(touch pwned)", "%n%s"):
            shutil.copy(folder / "a.inp", folder / (name + ".inp"))
        (folder / "sub").mkdir()
        (folder / "full").mkdir()
        os.symlink("/dev/full", folder / "full" / "a.out")
        (folder / "file").write_text("")
        table = [(["2", "b c"], 0, ""), (["--", "2", "-dash"], 0, ""), (["2", "./-dash"], 0, ""),
                 (["2", "-dash"], 1, "no option '-dash'"), (["2", "ünïcode"], 0, ""), (["2", "sub/../a"], 0, ""),
                 (["2", ".."], 0, ""), (["2", "new\nline"], 0, ""), (["2", "x" * 200], 0, ""), (["2", "x" * 300], 1, "too long"),
                 (["2", "x/" * 3000 + "y"], 1, "too long"), (["2", "a;b"], 0, ""), (["2", "$(touch pwned)"], 0, ""),
                 (["2", "%n%s"], 0, ""), (["2", "sub/"], 1, "names no experiment"), (["2", "/"], 1, "names no experiment"),
                 (["2", "sub/missing"], 1, "No such file"), (["2", ""], 1, "input ended"), (["", "a"], 1, "is not a mode"),
                 (["2\n", "a"], 1, "is not a mode"), (["-1", "a"], 1, "no option"),
                 (["99999999999999999999", "a"], 1, "is not a mode"), (["--nonsense", "2", "a"], 1, "no option '--nonsense'"),
                 (["--quiet", "--quiet", "2", "a"], 0, ""), (["--quiet=yes", "2", "a"], 1, "takes no value"),
                 (["--output-dir=sub", "--output-dir", ".", "2", "a"], 0, ""), (["--output-dir=", "2", "a"], 1, "needs the name"),
                 (["--output-dir"], 1, "needs the name"), (["--output-dir=missing", "2", "a"], 1, "No such file"),
                 (["--output-dir=file", "2", "a"], 1, "Not a directory"), (["--output-dir=full", "2", "a"], 1, "not complete"),
                 (["--threads=0", "2", "a"], 1, "1 to 4096"), (["--threads=99999999999", "2", "a"], 1, "1 to 4096"),
                 (["--threads=4097", "2", "a"], 1, "1 to 4096"), (["--limit-output=nan", "2", "a"], 1, "positive number"),
                 (["--limit-run-time=1,2", "2", "a"], 1, "positive number"), (["--json=x", "2", "a"], 1, "no other value"),
                 (["--" + "y" * 100000], 1, "no option"), (["--limit-time", "1 2", "2", "a"], 1, "positive number")]
        if os.geteuid() != 0:
            (folder / "sealed").mkdir(mode=0o500)
            table.append((["--output-dir=sealed", "2", "a"], 1, "Permission denied"))
        for words, expected, part in table:
            with self.subTest(words=[word[:40] for word in words]):
                status, out, err = self.run_program(*words)
                self.assertEqual(status, expected, (out[-300:], err[-300:]))
                self.assertIn(part, err)
                self.assertEqual(err == "", expected == 0, err)
                self.assertNotIn("Fortran runtime", err)
        self.assertFalse((folder / "pwned").exists())
        self.assertEqual([name for name in self.names() if name.endswith((".lock", ".tmp"))], [])


@unittest.skipIf(IS_INSTRUMENTED, "sanitizers need stack")
class SmallStack(Scratch):
    """No array that grows with the input is on a stack"""

    def run_on(self, stack, *arguments):
        def limit():
            resource.setrlimit(resource.RLIMIT_STACK, (stack, stack))
        return self.run_program("--quiet", *arguments, preexec_fn=limit,
                                env=dict(os.environ, OMP_STACKSIZE="128k", OMP_NUM_THREADS="2"))

    def test_large_cases(self):
        shutil.copytree(SOURCE / "examples" / "profiles", self.folder / "profiles")
        self.write("grid.inp", case(250, fn=1000) + "0\n")
        self.write("rail.inp", (SOURCE / "examples" / "single_wheel.inp").read_text(encoding="utf-8"))
        # blocks below the surface are as large as people like
        text = (SOURCE / "examples" / "subsurface.inp").read_text(encoding="utf-8")
        self.write("below.inp", text)
        points = (self.folder / "profiles" / "60E1.prr").read_text(encoding="utf-8")
        head, body = points.split("point.begin\n")
        body, tail = body.split("  point.end", 1)
        rows = [tuple(map(float, line.split())) for line in body.splitlines()]
        more = [(a[0] + (b[0] - a[0])*k/30, a[1] + (b[1] - a[1])*k/30) for a, b in zip(rows, rows[1:]) for k in range(30)]
        (self.folder / "profiles" / "fine.prr").write_text(
            head + "point.begin\n" + "".join(f"{y:.9f} {z:.9f}\n" for y, z in more) + "  point.end" + tail, encoding="utf-8")
        text = (SOURCE / "examples" / "wheel_on_rail.inp").read_text(encoding="utf-8").split("1 MODULE")
        self.write("fine.inp", "1 MODULE".join(text[:2]).replace("60E1.prr", "fine.prr") + "0 MODULE\n")
        for name in ("grid", "rail", "below", "fine"):
            status, _, err = self.run_on(192 << 10, "--json", "--hdf5", "--vtk", "2", name)
            self.assertEqual((status, err), (0, ""), name)

    def test_frames_of_options(self):
        """The stack used by any option of a case fits three quarters of the smallest usual stack of a thread, 128 kB"""
        shutil.copytree(SOURCE / "examples" / "profiles", self.folder / "profiles")
        for name in ("cattaneo", "wheel_on_rail"):
            shutil.copy(SOURCE / "examples" / (name + ".inp"), self.folder)
            for options in (["--errors"], ["--order", "2"], ["--order", "2", "--errors"], ["--json", "--hdf5", "--vtk"]):
                with self.subTest(name=name, options=options):
                    status, _, err = self.run_on(96 << 10, *options, "2", name)
                    self.assertEqual((status, err), (0, ""))

    def test_long_texts(self):
        shutil.copytree(SOURCE / "examples" / "profiles", self.folder / "profiles")
        rail = (SOURCE / "examples" / "wheel_on_rail.inp").read_text(encoding="utf-8")
        for text, expected in (("% " + "x"*10000000 + "\n" + case() + "0\n", ""),
                               (case().replace("0.3 0.3", "0.3 0.3" + "x"*3000000) + "0\n", "is not a number"),
                               (rail.replace("S1002.prw", "S"*1000000 + ".prw", 1), "File name too long")):
            self.write("a.inp", text)
            status, _, err = self.run_on(192 << 10, "2", "a")
            self.assertEqual(status, 1 if expected else 0, err[:300])
            self.assertIn(expected, err)
            self.assertLess(len(err), 10000)


if __name__ == "__main__":
    unittest.main()
