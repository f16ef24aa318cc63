"""Input folders, options of batch and sweep, and validation, by the program itself.

usage: options_test.py PROGRAM SOURCE
"""

import csv
import ctypes
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from tiny_scenario import tiny_scenario

PROGRAM, SOURCE = sys.argv[1:3]
SWEEP = """scenario: scenarios/a.yaml
seeds: 1:3
parameters: [{path: avoidance.speed, from: 0.5, to: 2, count: 20}]
"""


class Program(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        for file in ("a.yaml", "b.yml", "sub/c.yaml"):
            self.write(f"scenarios/{file}", tiny_scenario(SOURCE, pathlib.Path(file).stem))
        self.write("sweep.yaml", SWEEP)

    def write(self, file, text):
        path = self.folder / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def hedgehop(self, arguments, status=0, before=()):
        end = subprocess.run([*before, PROGRAM, *arguments.split()], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(end.returncode, status, end.stdout + end.stderr)
        return end

    def rows(self, table):
        with (self.folder / table).open() as file:
            return list(csv.DictReader(file))

    def flights(self, out="out"):
        return json.loads((self.folder / out / "batch.json").read_text())["flights"]


class Folders(Program):
    def test_a_folder_has_both_endings_and_reports_the_rest(self):
        self.write("scenarios/notes.txt", "")
        end = self.hedgehop("batch scenarios --out out")
        self.assertEqual([flight["group"] for flight in self.flights()], ["a", "b"])
        self.assertIn("scenarios: left out: notes.txt (not .yaml or .yml); sub/ (1 YAML file; use --recursive)", end.stderr)

    def test_recursive_flies_subfolders_but_no_results(self):
        for _ in range(2):
            end = self.hedgehop("batch scenarios --recursive --out scenarios/out")
            self.assertEqual([flight["group"] for flight in self.flights("scenarios/out")], ["a", "b", "c"])
        self.assertIn("3 scenarios that flights wrote as results", end.stderr)

    def test_module_paths_of_a_campaign_are_relative_to_it(self):
        self.write("deep/campaign.yaml", "tuned_on: none\nflights:\n  - {scenario: ../scenarios/a.yaml, seeds: 1, set: ['avoidance="
                   "{python: mine.py, class: Mine}']}\n")
        end = self.hedgehop("batch deep/campaign.yaml --out out", status=2)
        self.assertIn("deep/mine.py", end.stderr)


class Validate(Program):
    def test_valid_files_exit_with_0_without_a_flight(self):
        end = self.hedgehop("validate scenarios sweep.yaml --recursive")
        self.assertIn("4 files: 4 valid, 0 invalid", end.stdout)
        self.assertFalse((self.folder / "out").exists())

    def test_each_error_has_its_place(self):
        self.write("scenarios/b.yml", tiny_scenario(SOURCE, "b") + "duratoin: 3\n")
        self.write("scenarios/inside.yaml", tiny_scenario(SOURCE, "inside") + "start: {altitude: 0.01}\n")
        end = self.hedgehop("validate scenarios", status=2)
        self.assertRegex(end.stderr, r"b\.yml:\d+:1: unknown key 'duratoin'")
        self.assertIn("collides at the start", end.stderr)
        self.assertIn("3 files: 1 valid, 2 invalid", end.stdout)
        self.assertIn("sub/ (1 YAML file; use --recursive)", end.stderr)

    def test_a_campaign_that_batch_refuses_is_invalid(self):
        campaign = "tuned_on: none\nflights: [{scenario: scenarios/a.yaml, seeds: '1:3'}]\n"
        self.write("campaign.yaml", campaign + "checks: [{check: success_rate, at_least: 0.4}]\n")
        self.hedgehop("validate campaign.yaml")
        for line, words in (("plan: missing.yaml", "missing.yaml"),
                            ("checks: [{check: no_worse, than: missing.json}]", "missing.json"),
                            ("checks: [{check: no_worse, than: b.json, confidence: 0.4}]", "must be >= 0.5"),
                            ("checks: [{check: success_rate, at_least: 1.0}]", "a rate of 1 cannot be shown"),
                            ("checks: [{check: success_rate, at_least: 0.9}]", "3 of 3 flights that pass cannot show")):
            self.write("campaign.yaml", campaign + line + "\n")
            self.assertIn(words, self.hedgehop("validate campaign.yaml", status=2).stderr)

    def test_a_sweep_is_validated_as_a_sweep(self):
        self.write("sweep.yaml", SWEEP.replace("avoidance.speed", "avoidance.sped"))
        self.assertIn("unknown key 'sped' in 'avoidance'", self.hedgehop("validate sweep.yaml", status=2).stderr)

    def test_a_paper_is_validated_as_a_paper(self):
        paper = ("title: T\nsource: S\ntuned_on: none\nflights: [{scenario: scenarios/a.yaml, seeds: 1:2}]\n"
                 "rows: [{claim: c, flights: [a], column: outcome, is: reached, statistic: count}]\n")
        self.write("paper.yaml", paper)
        self.assertIn("paper with 1 claim", self.hedgehop("validate paper.yaml").stdout)
        self.write("paper.yaml", paper.replace("statistic: count", "statistic: cuont"))
        self.assertIn("paper.yaml:5:", self.hedgehop("validate paper.yaml", status=2).stderr)

    def test_an_override_that_no_scenario_accepts_is_one_line(self):
        end = self.hedgehop("batch scenarios --recursive --set leaderboard.seeds=1:2 --out out", status=2)
        self.assertEqual(end.stderr.count("unknown key 'leaderboard'"), 1, end.stderr)

    def test_a_search_is_validated_as_a_search(self):
        search = SWEEP.partition("parameters:")[0] + "design: {budget: 4}\nparameters: [{path: avoidance.speed, from: 1, to: 2}]\n"
        self.write("search.yaml", search)
        self.assertIn("search of 4 flights of ", self.hedgehop("validate search.yaml").stdout)
        self.write("search.yaml", search.replace("speed", "sped"))
        self.assertIn("unknown key 'sped' in 'avoidance'", self.hedgehop("validate search.yaml", status=2).stderr)


def has_osmesa():
    try:
        ctypes.CDLL("libOSMesa.so.8")
        return True
    except OSError:
        return False


class BatchOptions(Program):
    @unittest.skipUnless(has_osmesa(), "OSMesa is not installed (Debian: apt install libosmesa6)")
    def test_renderer_applies_to_every_flight_and_its_re_run(self):
        self.hedgehop("batch scenarios/a.yaml --renderer osmesa --out out")
        flight, = self.flights()
        self.assertNotIn("tiles", flight["result"]["libraries"]["renderer"])
        self.assertIn("--set drawing.renderer=osmesa", flight["command"])

    def test_no_report_writes_no_page(self):
        self.hedgehop("batch scenarios/a.yaml --no-report --out out")
        self.assertFalse((self.folder / "out/report.html").exists())

    def test_keep_rejects_other_artifacts(self):
        for keep in ("report", "failed=", "failed=video", "all=film"):
            self.assertIn("failed=report,film,replay,csv", self.hedgehop(f"batch scenarios/a.yaml --keep {keep}", status=2).stderr)

    @unittest.skipUnless(has_osmesa(), "OSMesa is not installed (Debian: apt install libosmesa6)")
    def test_results_of_two_renderers_are_marked(self):
        self.write("both.yaml", "tuned_on: none\nflights:\n  - {scenario: scenarios/a.yaml, seeds: 1}\n"
                   "  - {scenario: scenarios/a.yaml, seeds: 1, set: [drawing.renderer=osmesa]}\n")
        end = self.hedgehop("batch both.yaml --out out")
        self.assertIn("Flights with 2 renderers, whose images differ: ", end.stdout)
        self.assertIn("Flights with 2 renderers", (self.folder / "out/report.html").read_text())
        rows = self.rows("out/batch.csv")
        self.assertEqual(rows[0]["renderer"], "tiles: Hedgehop")
        self.assertNotIn("tiles", rows[1]["renderer"])
        self.assertRegex(rows[0]["libraries"], "^OpenCV .*, SLEEF ")

    def test_results_of_two_versions_of_a_library_are_marked(self):
        self.hedgehop("batch scenarios --out out")
        file = self.folder / "out/a/seed1/result.json"
        result = json.loads(file.read_text())
        result["libraries"]["images"] = "OpenCV 3.0.0"
        file.write_text(json.dumps(result))
        end = self.hedgehop("batch scenarios --resume --out out")
        self.assertRegex(end.stdout, r"Flights with 2 versions of libraries: OpenCV 3.0.0, SLEEF [^;]*; OpenCV ")

    def test_flights_at_a_time_default_to_the_affinity(self):
        self.write("worker.sh", "#!/bin/sh\nmkdir running || touch two\nsleep 0.2\nrmdir running\nexit 3\n").chmod(0o755)
        first = min(os.sched_getaffinity(0))
        self.hedgehop(f"batch scenarios --seeds 1:3 --out out --program {self.folder}/worker.sh", status=1,
                      before=["taskset", "-c", str(first)])
        self.assertFalse((self.folder / "two").exists(), "two flights ran at a time on one core")


class SweepOptions(Program):
    def test_dry_run_never_flies(self):
        worker = self.write("worker.sh", "#!/bin/sh\ntouch flown\nexit 3\n")
        worker.chmod(0o755)
        end = self.hedgehop(f"sweep sweep.yaml --dry-run --program {worker}")
        self.assertIn("60 flights of 20 points; 0 have results in out/sweep", end.stdout)
        self.write("optimize.yaml", SWEEP.replace("count: 20", "") + "design: {type: optimize, minimize: flight_time_s, evaluations: 7}\n")
        self.assertIn("at most 7 points, 3 flights each", self.hedgehop("sweep optimize.yaml --dry-run").stdout)
        self.assertFalse((self.folder / "flown").exists())
        self.assertFalse((self.folder / "out").exists())

    def test_set_applies_to_every_point(self):
        self.write("sweep.yaml", SWEEP.replace("count: 20", "count: 2").replace("1:3", "1"))
        self.hedgehop("sweep sweep.yaml --set duration=0.2 --out out")
        rows = self.rows("out/sweep.csv")
        self.assertEqual([float(row["flight_time_s"]) for row in rows], [0.2, 0.2])
        self.assertIn("--set duration=0.2", rows[0]["command"])
        end = self.hedgehop("sweep sweep.yaml --set avoidance.speed=1", status=2)
        self.assertIn("--set avoidance.speed: is a parameter of sweep.yaml", end.stderr)

    def test_a_slurm_task_requests_one_core_and_has_all_options(self):
        slurm = "sweep sweep.yaml --on slurm --dry-run --set duration=0.2 --reuse-other-builds"
        scripts = self.hedgehop(slurm).stdout
        self.assertEqual(re.findall(r"--cpus-per-task=(\d+)", scripts), ["1", "1"])
        self.assertIn(" -j 1", scripts)
        commands = [line for line in scripts.splitlines() if " sweep " in line]
        self.assertEqual(len(commands), 3)
        for command in commands:
            self.assertIn("--reuse-other-builds --set duration=0.2", command)
        self.assertIn("--cpus-per-task=3", self.hedgehop(slurm + " -j 3").stdout)

    def test_a_message_of_slurm_is_one_line(self):
        self.write("bin/sbatch", "#!/bin/sh\necho first >&2\necho second >&2\nexit 1\n").chmod(0o755)
        end = self.hedgehop("sweep sweep.yaml --on slurm", status=3, before=["env", f"PATH={self.folder}/bin:/usr/bin:/bin"])
        self.assertRegex(end.stderr, r"first; second\n$")


    def test_the_number_of_a_slurm_job_is_found_among_notices(self):
        self.write("bin/sbatch", "#!/bin/sh\necho 'sbatch: Setting account: lab' >&2\necho \"$*\" >>calls\necho '4711;alpha'\n").chmod(0o755)
        end = self.hedgehop("sweep sweep.yaml --on slurm", before=["env", f"PATH={self.folder}/bin:/usr/bin:/bin"])
        self.assertIn("4711", end.stdout)
        array, merge = (self.folder / "calls").read_text().splitlines()
        self.assertRegex(array, r"^--parsable \S+array.sh$")
        self.assertRegex(merge, r"^--parsable --dependency=afterany:4711 \S+merge.sh$")

    def test_the_number_of_a_slurm_job_is_on_the_last_line(self):
        self.write("bin/sbatch", "#!/bin/sh\necho 'Welcome to the cluster'\necho 4711\necho\n").chmod(0o755)
        end = self.hedgehop("sweep sweep.yaml --on slurm", before=["env", f"PATH={self.folder}/bin:/usr/bin:/bin"])
        self.assertIn("submitted: job 4711;", end.stdout)
        self.write("bin/sbatch", "#!/bin/sh\necho accepted\n").chmod(0o755)
        end = self.hedgehop("sweep sweep.yaml --on slurm", status=3, before=["env", f"PATH={self.folder}/bin:/usr/bin:/bin"])
        self.assertRegex(end.stderr, r"array.sh printed no job number, so the job may be submitted: accepted\n$")

    def test_a_slurm_job_is_the_whole_sweep(self):
        for part in ("--missing", "--merge", "--shard 1/2"):
            end = self.hedgehop(f"sweep sweep.yaml --on slurm --dry-run {part}", status=2)
            self.assertIn("--on slurm submits the whole sweep: no --shard, --merge or --missing", end.stderr)


class MissedGoals(Program):
    def test_a_timeout_that_no_check_reports_is_a_warning(self):
        end = self.hedgehop("run scenarios/a.yaml --no-video --no-report --out out")
        self.assertIn("warning: a: timed out before the goal, and no check requires the goal", end.stderr)
        self.assertRegex(end.stdout, r"cause: in the whole 0.1 s the module reported .*; the flight covered 0.0 of [0-9.]+ m; ")
        self.assertTrue(json.loads((self.folder / "out/result.json").read_text())["goal_missed_unchecked"])
        batch = self.hedgehop("batch scenarios --out all")
        self.assertIn("warning: 2 of 2 flights timed out before the goal, and no check requires the goal", batch.stderr)
        self.write("scenarios/a.yaml", tiny_scenario(SOURCE, "a", "[{check: reached_goal}]"))
        end = self.hedgehop("run scenarios/a.yaml --no-video --no-report --out out", status=1)
        self.assertNotIn("warning", end.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
