"""What the mutation tests share: a broken copy of a file, compiled and linked with the unbroken others."""
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMPILER = os.environ.get("CXX", "c++")
FLAGS = ["-std=c++20", "-O1", "-ffp-contract=off", f'-DPENUMBRA_SOURCE_DIR="{ROOT}"']


def broken(test, name, file, replacements):
    """The text of `file` after `replacements`; fails `test` if one of them finds nothing to replace."""
    text = (ROOT / file).read_text()
    for old, new in replacements:
        test.assertTrue(old in text, f"{name}: {file} no longer contains '{old}'; adapt the mutation")
        text = text.replace(old, new)
    return text


def passes(binary, *arguments, environment=None):
    return subprocess.run([binary, *arguments, "--gtest_fail_fast"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                          env=environment, timeout=120).returncode == 0


def addTests(case):
    """A test for each of the mutations of `case`."""
    for name in case.mutations:
        setattr(case, f"test{name}", lambda self, name=name: self.check(name))


def compiled(source, output, *include):
    folders = [f"-I{folder}" for folder in (*include, ROOT)]
    subprocess.run([COMPILER, *FLAGS, *folders, "-c", source, "-o", output], check=True)
    return output


class LinkedMutations(unittest.TestCase):
    """Programs of few enough sources to be compiled here. A subclass sets:"""
    mutations = {}  # name: (file, program, [(old, new), ...])
    sources = []    # of all programs
    libraries = []

    def unitTestsOf(self, program):
        """The test files of a program."""
        return [f"tests/unit/{program}_test.cpp"]

    def mayInclude(self, source, header):
        """May `source` include `header` by its path from the root? Then it is compiled again."""
        return True

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.objects = {}

    def object(self, source):
        """The unbroken object of `source`, compiled once."""
        if source not in self.objects:
            self.objects[source] = compiled(ROOT / source, self.folder / (source.replace("/", "_") + ".o"))
        return self.objects[source]

    def brokenObject(self, source, folder, file):
        return compiled((folder if source == file else ROOT) / source, folder / (source.replace("/", "_") + ".o"), folder)

    def passes(self, program, folder=None, file=""):
        """Does `program` pass, with `file` from `folder` in place of the real one?"""
        changed = {source for source in [*self.unitTestsOf(program), *self.sources]
                   if source == file or (file.endswith(".h") and self.mayInclude(source, file))}
        objects = [self.brokenObject(source, folder, file) if source in changed else self.object(source)
                   for source in [*self.unitTestsOf(program), *self.sources]]
        binary = (folder or self.folder) / program
        subprocess.run([COMPILER, *objects, *self.libraries, "-o", binary], check=True)
        return passes(binary)

    def check(self, name):
        file, program, replacements = self.mutations[name]
        text = broken(self, name, file, replacements)
        folder = self.folder / name  # one folder, so that its headers come before the real ones
        (folder / file).parent.mkdir(parents=True)
        (folder / file).write_text(text)
        self.assertFalse(self.passes(program, folder, file), f"{name}: {self.unitTestsOf(program)} do not notice")

    def testUnbroken(self):
        for program in sorted({program for _, program, _ in self.mutations.values()}):
            self.assertTrue(self.passes(program), f"{self.unitTestsOf(program)} fail without any mutation")
