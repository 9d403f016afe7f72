"""Every command that a page tells the reader to type works as written."""
import os
import re
import shlex
import subprocess
import tempfile
import unittest
from contextlib import redirect_stderr
from io import StringIO
from pathlib import Path

from temporary_tree import ROOT

import regions
import run_command
import test_command

BIN = Path(os.environ.get("PENUMBRA_BIN", ROOT / "build" / "release" / "bin"))
FENCE = re.compile(r"^```sh\n(.*?)^```", re.DOTALL | re.MULTILINE)
INLINE = re.compile(r"`(\./(?:run|test)(?: [^`]*)?)`")
CAPTION = re.compile(r"<sub>.*?</sub>")  # written by docs/refresh, which ran the same command line


def commandsOf(text):
    text = CAPTION.sub("", text)
    lines = [line.strip() for block in FENCE.findall(text) for line in block.splitlines() if line.strip()]
    inline = [" ".join(command.split()) for command in INLINE.findall(FENCE.sub("", text))]
    return [command for command in dict.fromkeys(lines + inline) if not re.search(r"[A-Z]{4}", command)]


def problemWith(command, folder):
    """What is wrong with a command line, or None. Chapters are run in `folder`; of ./run and ./test the flags are read."""
    words = shlex.split(command)
    said = StringIO()
    try:
        with redirect_stderr(said):
            if words[0] == "./run":
                chapter, flags, _ = run_command.parse(words[1:])
                return problemWithRun([BIN / chapter, *flags], folder) if chapter else None
            if words[0] == "./test":
                test_command.parse(words[1:])
                return None
            if words[0].startswith("build/release/bin/"):
                return problemWithRun([BIN / Path(words[0]).name, *words[1:]], folder)
    except SystemExit as left:
        return None if left.code in (0, None) else said.getvalue().strip()
    return f"nobody knows how to test `{words[0]}`"


def problemWithRun(words, folder):
    environment = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
    if not words[0].is_file():
        return f"{words[0]} is not built"
    ran = subprocess.run(words, cwd=folder, env=environment, capture_output=True, text=True)
    if ran.returncode != 0:
        return f"status {ran.returncode}: {ran.stderr.strip()}"
    for flag, file in zip(words, words[1:]):
        if flag in ("--output", "--report") and not (Path(folder) / file).is_file():
            return f"{file} was not written"
    return None


class CommandsTest(unittest.TestCase):
    def testEveryCommandOfEveryPageWorks(self):
        with tempfile.TemporaryDirectory() as folder:
            for page in regions.trackedFiles(ROOT, "README.md", "CONTRIBUTING.md", "docs/*.md"):
                for command in commandsOf((ROOT / page).read_text()):
                    with self.subTest(f"{page}: {command}"):
                        self.assertIsNone(problemWith(command, folder))

    def testReadmeTellsTheTwoCommands(self):
        commands = commandsOf((ROOT / "README.md").read_text())
        self.assertIn("./run", commands)
        self.assertIn("./test", commands)

    def testFindsCommandsInBlocksAndSentences(self):
        text = "Type `./test 03`:\n```sh\n./run 03 --size 8x8\n```\nnot `./run NAME`.\n"
        self.assertEqual(commandsOf(text), ["./run 03 --size 8x8", "./test 03"])

    def testSeesWhatIsWrong(self):
        for command in ("./run 99", "./run --scen x", "./test 99", "./test --fsat", "./run 03 --no-such-flag",
                        "./run 03 --scene no_such_scene --output a.png", "make all"):
            with self.subTest(command), tempfile.TemporaryDirectory() as folder:
                self.assertTrue(problemWith(command, folder))


if __name__ == "__main__":
    unittest.main()
