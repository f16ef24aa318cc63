"""JUnit files of the program hold the rules of junit_rules.py, and two parsers read them.

usage: junit_test.py PROGRAM SOURCE [NODE FOLDER_OF_NODE_MODULES]
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

import junitparser

import junit_rules

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent))
from tiny_scenario import tiny_scenario  # noqa: E402

PROGRAM, SOURCE = sys.argv[1:3]
NODE, MODULES = sys.argv[3:5] if len(sys.argv) > 3 else (None, None)
HERE = pathlib.Path(__file__).parent

TWICE = """
  - {check: metric, name: jerk_rms, at_least: 0}
  - {check: metric, name: jerk_rms, at_most: 0}
  - {check: reached_goal}"""


class JUnit(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        folder = cls.folder = pathlib.Path(cls.scratch.name)
        (folder / "flüge").mkdir()
        for file, name, checks in (("a.yaml", "Straße ä", "[{check: no_collision}]"), ("b.yml", "飞行 <&> \\U0001F681", TWICE)):
            (folder / "flüge" / file).write_text(tiny_scenario(SOURCE, name, checks))
        cls.end = cls.hedgehop("batch", "flüge", "--seeds", "1:2", "--out", "out ü", "--junit", "ci/prüfung.xml", "--keep",
                               "failed=film,csv,report")
        cls.text = (folder / "ci/prüfung.xml").read_bytes()

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    @classmethod
    def hedgehop(cls, *arguments):
        return subprocess.run([PROGRAM, *arguments], cwd=cls.folder, capture_output=True, text=True)

    def cases(self, suite):
        return {case.get("name"): case for case in ElementTree.fromstring(self.text).iter("testcase")
                if case.get("classname") == suite}

    def test_a_file_holds_the_rules(self):
        self.assertEqual(self.end.returncode, 1, self.end.stderr)
        self.assertEqual(junit_rules.faults(self.text), [])

    def test_two_checks_of_a_metric_have_distinct_names(self):
        cases = self.cases("飞行_____🚁/seed1")
        self.assertEqual(list(cases), ["flight", "jerk_rms", "jerk_rms (2)", "reached_goal", "no_collision"])
        self.assertIsNone(cases["jerk_rms"].find("failure"))
        self.assertIsNotNone(cases["jerk_rms (2)"].find("failure"))

    def test_the_body_of_a_failure_has_figure_unit_cause_and_command(self):
        failure = self.cases("飞行_____🚁/seed2")["reached_goal"].find("failure")
        self.assertEqual(failure.get("type"), "failed_check")
        self.assertRegex(failure.text, r"^[0-9.]+ m, must be <= 1 m: distance at the end; .*\nflight: in .* the module reported `")
        self.assertRegex(failure.text, r"\nre-run: hedgehop run 'flüge/b.yml' --seed 2$")

    def test_text_keeps_utf_8(self):
        self.assertIn("Straße_ä/seed1", {suite.get("name") for suite in ElementTree.fromstring(self.text)})
        groups = {p.get("value") for p in ElementTree.fromstring(self.text).iter("property") if p.get("name") == "group"}
        self.assertEqual(groups, {"Straße ä", "飞行 <&> 🚁"})
        self.assertNotIn(b"?", self.text.replace(b"<?xml", b"").replace(b"?>", b""))

    def test_properties_name_scenario_seed_build_and_renderer(self):
        suite = ElementTree.fromstring(self.text)[0]
        properties = {p.get("name"): p.get("value") for p in suite.iter("property")}
        self.assertEqual(properties["scenario"], "flüge/a.yaml")
        self.assertEqual(properties["renderer"], "tiles: Hedgehop")
        self.assertLessEqual({"group", "seed", "build", "version", "libraries", "command"}, properties.keys())

    def test_attachments_are_relative_to_the_file(self):
        root = ElementTree.fromstring(self.text)
        text = "\n".join(out.text for out in root.iter("system-out"))
        paths = [line[len("[[ATTACHMENT|"):-2] for line in text.splitlines() if line.startswith("[[ATTACHMENT|")]
        names = {pathlib.PurePath(path).name for path in paths}
        self.assertLessEqual({"trajectory.csv", "decisions.csv", "video.webm"}, names)
        for path in paths:
            self.assertTrue((self.folder / "ci" / path).exists(), path)
            self.assertNotIn("Straße", path)  # its flights pass
        self.assertFalse(list((self.folder / "out ü").glob("Straße*/*/video.webm")))

    def test_the_report_is_the_first_attachment_of_each_failed_case(self):
        first = {name: re.search(r"\[\[ATTACHMENT\|(.+?)\]\]", case.find("system-out").text)  # as GitLab reads it
                 for name, case in self.cases("飞行_____🚁/seed1").items()}
        self.assertEqual({name for name in first if first[name]}, {"jerk_rms (2)", "reached_goal"})
        for name in ("jerk_rms (2)", "reached_goal"):
            self.assertTrue(first[name][1].endswith("seed1/report.html"), first[name][1])

    def test_debians_junitparser_reads_it(self):
        xml = junitparser.JUnitXml.fromstring(self.text)
        self.assertEqual((xml.tests, xml.failures, xml.errors), (14, 4, 0))
        failed = [case for suite in xml for case in suite if any(isinstance(r, junitparser.Failure) for r in case.result)]
        self.assertEqual([case.name for case in failed], ["jerk_rms (2)", "reached_goal"] * 2)
        self.assertTrue(all(r.text.strip() and r.type for case in failed for r in case.result))

    @unittest.skipUnless(NODE, "no npm")
    def test_junit2json_reads_it(self):
        reader = pathlib.Path(MODULES) / "read_junit.mjs"
        done = subprocess.run([NODE, reader, self.folder / "ci/prüfung.xml"], capture_output=True, text=True, check=True)
        suites = json.loads(done.stdout)["testsuite"]
        self.assertEqual(len(suites), 4)
        self.assertEqual({suite["name"] for suite in suites if suite.get("failures")},
                         {"飞行_____🚁/seed1", "飞行_____🚁/seed2"})

    def test_bad_input_is_an_error_of_its_own_suite(self):
        (self.folder / "typo.yaml").write_text("use: flüge/a.yaml\nduratoin: 3\navoidance: {sped: 1}\n")
        for arguments in (["batch", "typo.yaml"], ["batch", "flüge/a.yaml", "--seeds", "3:1"], ["batch", "absent.yaml"],
                          ["sweep", "typo.yaml"], ["validate", "typo.yaml"],
                          ["compare", "typo.yaml", "flüge/a.yaml", "--seeds", "1:2", "--until", "collision: better"]):
            with self.subTest(arguments=arguments):
                end = self.hedgehop(*arguments, *(["--out", "o"] if arguments[0] != "validate" else []), "--junit", "bad.xml")
                self.assertEqual(end.returncode, 2, end.stderr)
                text = (self.folder / "bad.xml").read_bytes()
                self.assertEqual(junit_rules.faults(text), [])
                suite = ElementTree.fromstring(text).find("testsuite")
                self.assertEqual(suite.get("name"), "input")
                errors = [error.text for error in suite.iter("error")]
                self.assertEqual(len(errors), len(end.stderr.splitlines()))
                for error, line in zip(errors, end.stderr.splitlines()):
                    self.assertEqual(error.strip(), line)
                (self.folder / "bad.xml").unlink()

    def test_a_bad_file_among_others_has_all_its_errors(self):
        (self.folder / "typo.yaml").write_text("use: flüge/a.yaml\nname: typo\nduratoin: 3\navoidance: {sped: 1}\n")
        self.hedgehop("batch", "typo.yaml", "flüge/a.yaml", "--out", "two", "--junit", "two.xml")
        text = (self.folder / "two.xml").read_bytes()
        self.assertEqual(junit_rules.faults(text), [])
        error = ElementTree.fromstring(text).find("testsuite[@name='typo/bad']/testcase/error")
        self.assertEqual(error.get("type"), "bad_input")
        self.assertIn("duratoin", error.text)
        self.assertIn("sped", error.text)


class Rules(unittest.TestCase):
    """Each rule rejects its fault."""

    GOOD = ("<testsuites name='a' time='1.5' tests='1' failures='1' errors='0'><testsuite name='a' tests='1' failures='1' "
            "errors='0' skipped='0' time='1.250' timestamp='2026-01-02T03:04:05' hostname='h'><properties/>"
            "<testcase classname='a' name='b' time='0'><failure type='t' message='m'>text</failure></testcase>"
            "</testsuite></testsuites>")

    def test_every_rule(self):
        self.assertEqual(junit_rules.faults(self.GOOD), [])
        for old, new in (("<testsuites ", "<testsuites skipped='0' "), ("1.250", "1.2504"), ("time='0'", "time='1e-05'"),
                         ("text</f", "</f"), (" type='t'", ""), (" hostname='h'", ""), ("01-02T", "01-02 "),
                         ("failures='1' errors='0' skipped", "failures='0' errors='0' skipped"),
                         ("<properties/>", "<hint/>"), ("name='b'", "name='b' file='x'"),
                         ("</testcase>", "</testcase><testcase classname='a' name='b'/>")):
            with self.subTest(new=new):
                self.assertIn(old, self.GOOD)
                self.assertNotEqual(junit_rules.faults(self.GOOD.replace(old, new)), [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
