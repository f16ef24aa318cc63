"""The jobs of docs/continuous-integration.md run as far as a shell can: apt-get is a stand-in, the services are absent.

usage: ci_jobs_test.py SOURCE PROGRAM
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import yaml

SOURCE, PROGRAM = (pathlib.Path(argument) for argument in sys.argv[1:3])
sys.path.insert(0, str(SOURCE / "tests/sim/batch/junit"))
import junit_rules  # noqa: E402

SCENARIO = f"""use: {SOURCE}/configs/garratt2009_room_0_light.yaml
name: NAME
duration: 0.2
scene: {{texture_size: 64}}
velocimeter: {{enabled: false}}
rig: {{cameras: [{{role: front, width: 16, height: 16, fov: 90, rate: 25, channel: grey}}]}}
avoidance: {{module: go_to_goal}}
goal: {{north: 5, east: 0, altitude: 1, radius: 1}}
checks: [CHECK]
drawing: {{renderer: tiles}}
"""


def jobs():
    """{file: job} of the page's blocks that begin with the name of a CI file."""
    text = (SOURCE / "docs/continuous-integration.md").read_text()
    blocks = re.findall(r"^```yaml\n# (\S+)\n(.*?)^```", text, re.S | re.M)
    return {file: yaml.safe_load(block) for file, block in blocks}


class Job(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        folder = self.folder = pathlib.Path(self.scratch.name)
        for name, check in (("good", "{check: no_collision}"), ("sub/bad", "{check: reached_goal}")):
            file = folder / "scenarios" / f"{name}.yml"
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(SCENARIO.replace("NAME", file.stem).replace("CHECK", check))
        (folder / "ci").mkdir()
        (folder / "ci/hedgehop_1_amd64.deb").write_text("")
        (folder / "bin").mkdir()
        apt = folder / "bin/apt-get"
        apt.write_text('#!/bin/sh\necho "$@" >> apt.log\n')
        apt.chmod(0o755)
        (folder / "bin/hedgehop").symlink_to(PROGRAM)

    def run_steps(self, scripts):
        """Runs scripts in one folder up to the first that fails, as a service does. @return the statuses."""
        environment = {**os.environ, "PATH": f"{self.folder}/bin:{os.environ['PATH']}"}
        statuses = []
        for script in scripts:
            done = subprocess.run(["bash", "-e", "-c", script], cwd=self.folder, env=environment, capture_output=True, text=True)
            self.assertIn(done.returncode, (0, 1), f"{script}\n{done.stdout}\n{done.stderr}")
            statuses.append(done.returncode)
            if done.returncode:
                break
        return statuses

    def check_results(self, statuses, scripts, junit, folder):
        self.assertEqual(statuses, [0] * (len(scripts) - 1) + [1], "the last command fails, because a flight fails")
        self.assertIn("install -y ./ci/hedgehop_1_amd64.deb", (self.folder / "apt.log").read_text())
        text = (self.folder / junit).read_bytes()
        self.assertEqual(junit_rules.faults(text), [])
        self.assertTrue((self.folder / folder / "batch.json").exists())
        attachments = re.findall(rb"\[\[ATTACHMENT\|(.*?)\]\]", text)
        self.assertEqual(len(set(attachments)), 12)  # four seeds, three kinds
        for path in attachments:
            self.assertTrue((self.folder / path.decode()).exists(), path)
            self.assertTrue(path.decode().startswith(f"{folder}/"), "inside the kept folder")
        for name in (b"good", b"bad"):
            self.assertTrue(re.search(name + rb"[^/\"]*/seed4", text), name)

    def test_github(self):
        workflow = jobs()[".github/workflows/flights.yml"]
        self.assertEqual(workflow[True], ["push", "pull_request"])  # YAML 1.1 reads `on` as true
        job = workflow["jobs"]["flights"]
        self.assertLessEqual({"runs-on", "steps"}, job.keys())
        for step in job["steps"]:
            self.assertEqual(("uses" in step) + ("run" in step), 1, step)
        scripts = [step["run"] for step in job["steps"] if "run" in step]
        uploads = {step["uses"].split("@")[0]: step for step in job["steps"] if "uses" in step}
        for name in ("actions/upload-artifact", "mikepenz/action-junit-report"):
            self.assertEqual(uploads[name]["if"], "always()", "after a failure, too")
        self.check_results(self.run_steps(scripts), scripts, uploads["mikepenz/action-junit-report"]["with"]["report_paths"],
                           uploads["actions/upload-artifact"]["with"]["path"])

    def test_gitlab(self):
        job = jobs()[".gitlab-ci.yml"]["flights"]
        self.assertEqual(job.keys(), {"image", "before_script", "script", "artifacts"})
        self.assertEqual(job["artifacts"]["when"], "always")
        scripts = job["before_script"] + job["script"]
        self.check_results(self.run_steps(scripts), scripts, job["artifacts"]["reports"]["junit"],
                           *job["artifacts"]["paths"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
