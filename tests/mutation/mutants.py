"""What the mutation tests share: a broken copy of a file, compiled and linked with the unbroken others."""
import os
import pathlib
import shlex
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
CODEC = "bin/penumbra_image_codec.so"
BUILD = pathlib.Path(os.environ.get("PENUMBRA_BUILD", ROOT / "build" / "release"))
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


def commandsOf(program):
    """How the build makes a program: one command line for each step, linking last."""
    if not (BUILD / "bin" / program).exists():
        raise unittest.SkipTest(f"{BUILD} holds no {program}: build it first (./test does)")
    return subprocess.run(["ninja", "-C", BUILD, "-t", "commands", program], capture_output=True, text=True,
                          check=True).stdout.splitlines()


def withOutput(words, output):
    at = words.index("-o") + 1
    return [*words[:at], str(output), *words[at + 1:]]


class ArchiveMutations(unittest.TestCase):
    """Programs that need the whole library: only the broken file is compiled anew, as the build compiles it, and linked in front
    of the archives of a finished build. A subclass sets:"""
    mutations = {}  # name: (file or shader, unit program, filter of the tests that must fail, [(old, new), ...])
    unbroken = {}   # (program, filter): do they pass? Asked once.

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def compile(self, file, text, commands):
        """The object of `file`, as if it contained `text`."""
        source, made = self.folder / pathlib.Path(file).name, self.folder / "broken.o"
        source.write_text(text)
        line = next(command for command in commands if command.endswith(f"-c {ROOT / file}"))
        words = withOutput(shlex.split(line), made)
        words[words.index("-c") + 1] = str(source)
        words[words.index("-MF") + 1] = str(self.folder / "broken.d")
        subprocess.run([*words, "-O0", "-w"], cwd=BUILD, check=True, env={**os.environ, "CCACHE_DISABLE": "1"})
        return made

    def link(self, program, object_, commands):
        """The program with `object_` in the place of what the archives have under the same names."""
        words = next(part for part in commands[-1].split("&&") if " -o " in part)
        binary = self.folder / program
        words = withOutput(shlex.split(words), binary)
        at = words.index("-o")
        subprocess.run([*words[:at], object_, "-Wl,-z,muldefs", *words[at:]], cwd=BUILD, check=True)
        return binary

    def linkCodec(self, object_, commands):
        """The library that programs load to read and write pictures; it has one object."""
        line = next(part for command in commands for part in command.split("&&") if f" -o {CODEC}" in part)
        library = self.folder / pathlib.Path(CODEC).name
        words = [str(object_) if word.endswith("oiio_codec.cpp.o") else word
                 for word in withOutput(shlex.split(line), library)]
        subprocess.run(words, cwd=BUILD, check=True)
        return library

    def passes(self, binary, test, **environment):
        return passes(binary, f"--gtest_filter={test}", environment={**os.environ, **environment})

    def check(self, name):
        file, unit, test, replacements = self.mutations[name]
        program = f"unit_{unit}"
        commands = commandsOf(program)
        if (program, test) not in self.unbroken:
            self.unbroken[program, test] = self.passes(BUILD / "bin" / program, test)
        self.assertTrue(self.unbroken[program, test], f"{program} fails without any mutation")
        text = broken(self, name, file, replacements)
        if file.startswith("shaders/"):
            shutil.copytree(ROOT / "shaders", self.folder / "shaders")
            (self.folder / file).write_text(text)
            passed = self.passes(BUILD / "bin" / program, test, PENUMBRA_SHADERS=str(self.folder / "shaders"))
        elif file.startswith("common/image/oiio/"):
            codec = self.linkCodec(self.compile(file, text, commands), commands)
            passed = self.passes(BUILD / "bin" / program, test, PENUMBRA_IMAGE_CODEC=str(codec))
        else:
            passed = self.passes(self.link(program, self.compile(file, text, commands), commands), test)
        self.assertFalse(passed, f"{name}: {program} --gtest_filter={test} does not notice")
